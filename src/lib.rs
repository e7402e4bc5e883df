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
//! A [`Scene`] says what is simulated, a [`Run`] for how long and how well, and [`Signals`] are what comes of it;
//! [`simulate_into()`] hands a long record over in blocks, [`simulate_with_progress()`] may be stopped. [`equilibrium()`],
//! [`stiffness()`] and [`load_distribution()`] are static, [`explain()`] tells what a scene costs, [`campaign()`] runs many.
//!
//! # The rooms
//!
//! Data flows one way:
//!
//! ```text
//! scene  →  model  →  dynamics  →  integrate  →  signals
//! ```
//!
//! * [`simd`] — eight numbers at once, or a register full, compiled for three instruction sets.
//! * [`scene`] — what a user says: names, numbers, defaults; a serde document that is only validated.
//! * [`contact`] — one ball on one race: its shape, elastic, damping and traction laws, oil films, quadrature, fault circles, and the
//!   kernel, the one coding of an element's force, with its drivers; `contact/frames.rs` leads from the scene's frame to a
//!   ring's, which may lean, and the cage's. Numbers in, numbers out; no indices, no state.
//! * `tilt` — a ring that leans: its frame, which does not spin, and the equations of a symmetric rigid body.
//! * `model` ([`Model`]) — the scene compiled: bodies, races and directions ([`BodyId`], [`Race`], [`Dof`]) with the one
//!   place that turns them into offsets ([`Layout`]), arrays, scales. Never changed by a run.
//! * `forces` — cage, supports, gravity, loads, unbalance, drive, drag of oil: one file each, with force, energy or power, rate for step
//!   control, and what becomes of it in a run.
//! * [`inspect`] — questions about a state: what its contacts carry, its energies, its films, its stiffest elements.
//! * `reduction` ([`Reduction`]) — what a run leaves out, and why.
//! * [`dynamics`] — the right-hand side: touching contacts by eights of one class of rows, or whole rows where each is one
//!   formula, summed in one order; in the frames of rings that lean; smooth plane rows in one loop, without tables between; forces by origin.
//! * [`implicit`] — how contacts answer to velocities: the contacts held at their places, their slopes, an arrow of a matrix. By
//!   it the default method corrects velocities once a step; implicit steps solve for them by Newton's method.
//! * [`integrate`] — the default method, a predictor–corrector of one evaluation a step; Runge–Kutta pairs as data, step
//!   control, dense output. Knows no bearings.
//! * `equilibrium` ([`equilibrium()`], [`stiffness()`], [`load_distribution()`]) — the static solve and what follows
//!   from it, the places of defects among it; `start` ([`start()`]) — how a run begins.
//! * `kinematics` ([`RowKinematics`]) — how fast the balls of a run went round and spun, and how they would roll at rest.
//! * `touched` ([`Touched`]) — which defects balls met in a run, and what their contacts carried there.
//! * `signals` ([`Signals`]) — probes read from the dense output on a uniform grid, through a low-pass ([`Bandwidth`]);
//!   kept whole, or handed over in blocks ([`Block`]); reasons to look twice at them ([`Warning`]).
//! * `residual` — whether recorded accelerations belong to the recorded motion; `selftest` — whether this processor's vector
//!   instructions compute what they should, once a process.
//! * `run` ([`Run`], [`simulate()`]) — the run itself: its options, methods, tolerances, budgets and ends;
//!   `run/simulate.rs` has the lines to read first.
//! * `explain` ([`explain()`]) — what a scene is compiled to, what it costs, what would make it cheaper.
//! * `features` ([`Feature`]) — the few numbers a signal is known by: moments, fault lines, contact loads.
//! * `interrupt` ([`Interrupt`]), `memory` — what ends work from outside; what a run may set aside.
//! * `told` — numbers in messages, in units of their size.
//! * `campaign` ([`campaign()`]) — many cases on all cores; a case that fails is an outcome.
//! * The bindings for Python are a crate of their own in `src/python`, the only place that knows Python; what they use beside the interface is
//!   listed in `bindings` at the end of `lib.rs`.
//!
//! # To add
//!
//! | what | touch | prove |
//! |---|---|---|
//! | an elastic law | a file in `contact/laws/elastic/`, its variant in the `mod.rs` there, a variant in `scene/contact.rs` and its ranges in `scene/validate/contact.rs`, its name in `explain/law.rs`; for Python `python/ballrace/scene/contact.py` and `python/ballrace/report/words.py` | doctest values, `tests/analytic/contact.rs` |
//! | a traction law | a file in `contact/laws/traction/`, its variant in the `mod.rs` there, a variant with its numbers in `scene/contact.rs`; for Python as above | dissipation ≥ 0, its slope |
//! | an oil | an entry of `NAMED_OILS` in `scene/oils.rs` with its source | `tests/analytic/lubricant.rs` |
//! | what oil does | its formula in `contact/laws/film/`; what a contact has of it, `FilmEffect` there | a row of section 12.14, `tests/analytic/oil_contact.rs` |
//! | a force | a file in `forces/`, its entry in `forces/mod.rs`, which names its contribution, a line in `Dynamics::add_applied_forces` | `tests/analytic/energy.rs`, power balance |
//! | a direction of a body | `Dof` in `model/dof.rs`, `Layout` in `model/layout.rs`, mass and mount in `model/body.rs`; what carries the four numbers of a contact: `forces/state.rs`, `dynamics/sums.rs`, `dynamics/batch/`, `implicit/`; where a ring leans `dynamics/batch/view.rs`, `dynamics/leaning.rs` | `model/layout.rs`, momentum |
//! | what acts along z, or differs by row | `reduction/symmetry.rs`; what contacts share, `RowModel::is_like` | a hair of it in `tests/limits/reduction.rs`, `tests/limits/unlike_rows.rs` |
//! | an approximation | `scene/approximations.rs`, grounds and a reason in `reduction/`, an offer in `explain/variants.rs` | `tests/limits/approximations.rs`, a row in `benches/approximations.py` |
//! | a race profile | what can be said by points: a tabulation in `model/race.rs`; else a kind in `contact/scalar/shape.rs` with its contacts, fields in `scene/bearing.rs` and `scene/validate/race.rs` | `tests/analytic/profiles.rs`: gap against a closed form, energy |
//! | a defect shape | a constructor in `scene/defect.rs` | width or depth → 0 equals healthy |
//! | a Runge–Kutta method | a constant in `integrate/tableau_pairs.rs`, a variant in `scene/solver.rs`, an arm in `run/method.rs` and in `run/step_limit.rs` | row sums, order of convergence |
//! | a signal | a variant in `scene/probe.rs`, two arms in `signals/probes.rs` | unit, value at a known state; filtered or a reading of a state |
//! | a doubt | a check in `scene/doubt/`, with its source | `tests/reliability/doubts.rs`: told, and no ordinary bearing is |
//! | a feature | a file in `features/`, a line in its `mod.rs` | value of a synthetic signal |
//!
//! # Units and frames
//!
//! SI everywhere. Right-handed inertial frame: z along the bearing axis, x to the right, y up; angle 0 on +x,
//! counter-clockwise. A body has four degrees of freedom x, y, z, θ (about z): balls spin about z only, and rings stay parallel
//! unless a scene lets them tilt; then each has two more, behind all bodies (`tilt`).

mod campaign;
pub mod contact;
pub mod dynamics;
mod equilibrium;
mod error;
mod explain;
mod features;
mod forces;
pub mod implicit;
pub mod inspect;
pub mod integrate;
mod interrupt;
mod kinematics;
mod memory;
mod model;
mod pool;
mod reduction;
mod residual;
mod run;
pub mod scene;
mod selftest;
mod signals;
pub mod simd;
mod start;
mod tilt;
mod told;
mod touched;

pub use campaign::{Case, Finished, Outcome, campaign, stream};
pub use equilibrium::{
    BallEquilibrium, ContactEquilibrium, Equilibrium, EquivalentLoads, LoadDistribution, Placed,
    RaceControl, Stiffness, compile, equilibrium, equilibrium_under, load_distribution, stiffness,
};
pub use error::{Error, Result};
pub use explain::{
    ContactKind, Cost, Explanation, LawExplanation, OilExplanation, Variant, explain,
};
pub use features::{Feature, FeatureOptions, feature_columns, features, signal_features};
pub use interrupt::Interrupt;
pub use kinematics::RowKinematics;
pub use model::{Body, BodyId, BodyKind, DOFS, Degree, Dof, Layout, Model, Race, Scales};
pub use reduction::{Obstacle, Omission, Reduction};
pub use run::{Run, simulate, simulate_into, simulate_with_progress};
pub use scene::Scene;
pub use signals::{
    Accuracy, Bandwidth, Block, Column, Provenance, Signals, SliceRow, Statistics, Warning,
};
pub use start::{Start, start};
pub use touched::Touched;

/// What the bindings for Python (`src/python`) use beside the interface. Nobody else should: it changes without notice.
#[doc(hidden)]
pub mod bindings {
    pub use crate::equilibrium::place;
    pub use crate::features::loads::columns as load_columns;
    pub use crate::features::lubrication::columns as lubrication_columns;
    pub use crate::features::transform::{amplitudes, hann_weighted, squared_envelope};
    pub use crate::features::{Recorded, check as check_features, check_recorded, features_of};
    pub use crate::kinematics::{RowRolling, rolling};
    pub use crate::memory::{available, within};
    pub use crate::model::layout_of;
    pub use crate::pool::STACK;
    pub use crate::start::check_length;
}
