//! Ball bearings simulated in three dimensions: slices, fault circles, adaptive steps.
//!
//! After P. Tkachuk, J. Strackeljan, *A 3D-ball bearing model for simulation of axial load variations*
//! (Otto-von-Guericke-Universität Magdeburg); equation numbers in brackets are that paper's.
//!
//! ```
//! use ballrace::{Run, scene::presets, simulate};
//!
//! let scene = presets::wheel_bearing(3000.0);
//! let run = Run { duration: 1e-3, ..Run::default() };
//! let out = simulate(&scene, &run)?;
//! let ay = out.get("outer.ay").unwrap(); // m/s², 50 kHz
//! assert_eq!(ay.len(), 50);
//! # Ok::<(), ballrace::Error>(())
//! ```
//!
//! A [`Scene`] is what is simulated: bearing, loads, drive, defects, probes; [`scene`] has its parts, [`scene::presets`] examples. A [`Run`] says
//! for how long, from which start, and how accurately. [`Signals`] are the result: columns with names and units, statistics,
//! provenance and warnings. [`simulate_into()`] hands a long record over in blocks; [`simulate_with_progress()`] can be stopped.
//!
//! | question | function |
//! |---|---|
//! | How does a run go on, with loads and speeds that change between its pieces? | [`Simulation`] |
//! | What does every ball carry at rest, and how stiff is the bearing? | [`equilibrium()`], [`stiffness()`], [`load_distribution()`] |
//! | What stiffness and damping does it have in a rotor? | [`dynamic_coefficients()`] |
//! | What does a run integrate and leave out, and what does it cost? | [`explain()`] |
//! | Which features has the record, and which of many records? | [`features()`], [`campaign()`] |
//! | What does a measured record show, and where? | [`signal_features()`], [`squared_envelope_spectrum()`], [`order_spectrum()`], [`fault_frequencies()`], [`run_fault_frequencies()`], [`scene::RowGeometry`] |
//! | What are the equations, for an integrator of one's own? | [`compile()`], [`dynamics`], [`integrate`] |
//! | What holds in a given state: loads, energies, films? | [`inspect`] |
//! | Which bearing is a 6205? | `scene::catalogue`, by the feature of that name |
//! | How does a force of my own act on a ring? | [`scene::RingForce`], [`scene::TableForce`] |
//!
//! Bad input is refused by one [`Error`] that names the field, the value and what is allowed; its variants say whether a scene, a record, a
//! snapshot or a force of the caller's is at fault. [`equations`] has the model, its equations and their sources.
//!
//! # Units and frames
//!
//! SI throughout. Right-handed inertial frame: z along the bearing axis, x to the right, y up; angle 0 on +x,
//! counter-clockwise. A body has four degrees of freedom x, y, z, θ (about z): balls spin about z and rings stay parallel, unless
//! a scene lets balls spin freely or rings tilt; then each of these has two more, behind all bodies in the state vector.

#[doc = include_str!("equations.md")]
pub mod equations {}

mod base;
mod campaign;
pub mod contact;
pub mod dynamics;
mod explain;
mod features;
mod forces;
pub mod inspect;
pub mod integrate;
mod model;
mod reduction;
mod run;
pub mod scene;
mod signals;
mod simd;
mod statics;
mod tilt;
mod velocities;

pub use base::clock::set_clock;
pub use base::error::{Error, Result};
pub use base::interrupt::Interrupt;
pub use campaign::{Case, Finished, Outcome, campaign, stream};
pub use explain::{
    ContactKind, Cost, Explanation, LawExplanation, OilExplanation, PitExplanation,
    TextureExplanation, Variant, explain,
};
pub use features::{
    FaultFrequencies, Feature, FeatureOptions, by_order, fault_frequencies, feature_columns,
    features, order_spectrum, run_fault_frequencies, signal_features, squared_envelope,
    squared_envelope_spectrum, turning,
};
pub use model::{Body, BodyId, BodyKind, DOFS, Degree, Dof, Layout, Model, Placed, Race, Scales};
pub use reduction::{Obstacle, Omission, Reduction};
pub use run::{Run, Simulation, Snapshot, simulate, simulate_into, simulate_with_progress};
pub use scene::Scene;
pub use signals::kinematics::RowKinematics;
pub use signals::touched::Touched;
pub use signals::{
    Accuracy, Bandwidth, Block, Column, Provenance, Signals, SliceRow, Statistics, Warning,
};
pub use simd::{Distrust, InstructionSet, UnknownInstructionSet};
pub use statics::start::{Start, start};
pub use statics::{
    AxisHeld, BallEquilibrium, ContactEquilibrium, DynamicCoefficients, Equilibrium,
    EquivalentLoads, LoadDistribution, RaceControl, Stiffness, axis_held, compile,
    dynamic_coefficients, equilibrium, equilibrium_under, load_distribution, stiffness,
};

/// Interface of the bindings for Python (`src/python`) and the FMU (`fmu`) beside the public one. No other program should use it: it changes without notice.
#[doc(hidden)]
pub mod bindings {
    pub use crate::base::memory::{available, within};
    pub use crate::base::pool::{Pool, STACK};
    pub use crate::features::loads::columns as load_columns;
    pub use crate::features::lubrication::columns as lubrication_columns;
    pub use crate::features::transform::{amplitudes, hann_weighted};
    pub use crate::features::{
        Recorded, check as check_features, check_recorded, check_samples, features_of,
        frequencies_at,
    };
    pub use crate::model::layout_of;
    pub use crate::signals::kinematics::{RowRolling, rolling};
    pub use crate::statics::place;
    pub use crate::statics::start::check_length;
}
