//! Eight numbers at once, and the widest instructions that the processor has for them.
//!
//! `Lanes` are plain arrays with arithmetic; the compiler turns them into vector instructions of whatever set the code
//! around them is compiled for. `Vector`s are the registers themselves. [`InstructionSet`] compiles a task for three sets
//! into one program and picks one at run time.

mod angle;
mod choice;
mod curves;
mod inverse_root;
mod isa;
mod lanes;
mod number;
mod proof;
mod vector;

pub(crate) use angle::direction;
pub use choice::{Distrust, UnknownInstructionSet};
pub(crate) use curves::{arctan_over, ln};
pub(crate) use inverse_root::inverse_root;
pub use isa::InstructionSet;
pub(crate) use isa::Task;
pub(crate) use lanes::{Counters, LANES, Lanes, Mask, mul_add};
pub(crate) use number::{Decision, Number};
pub(crate) use vector::{Choice, Simd, Vector, Wide};
