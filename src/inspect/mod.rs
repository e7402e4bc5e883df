//! Questions about a state: what its contacts carry, what energy it holds, which elements are stiffest.

mod contacts;
mod energy;
mod stiffest;

pub use contacts::{ContactSummary, SliceForce, contact, slice_forces};
pub(crate) use contacts::{largest_pressure, pressure};
pub use energy::{Energy, cage_forces, energy};
pub(crate) use stiffest::{Element, stiffest};
