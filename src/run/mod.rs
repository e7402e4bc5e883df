//! A run: scene → model → start → settle → integrate → signals. Begin reading at `simulate`.
//!
//! * `options` ([`Run`]) — the options; `accuracy` finds nodes, tolerance and step cap for a requested accuracy.
//! * `method` — the method, and the switch between two of them; `step_limit` — the largest step of each.
//! * `session` — a run between its pieces; `simulation` ([`Simulation`]) — runs in pieces, with changes; `snapshot` — what a run needs to go on.
//! * `prepare` — what comes before: the scene as the run has it, memory, start; `provenance` — what is recorded about it.
//! * `settle` — the decay of the start's transient before t = 0; `follow` — steps over an interval of time, observed by `watch`, and
//!   `beyond` its end; `settings` — options of the integrator for a model.
//! * `budget`, `step_collapse`, `runaway`, `escape`, `orbit`, `ending` — when it stops, and its errors.

mod accuracy;
mod beyond;
mod budget;
mod ending;
mod escape;
mod follow;
pub(crate) mod method;
mod options;
mod orbit;
pub(crate) mod pool;
mod prepare;
mod provenance;
mod runaway;
mod selftest;
mod session;
mod settings;
mod settle;
mod simulate;
mod simulation;
mod snapshot;
mod step_collapse;
pub(crate) mod step_limit;
mod watch;

pub use options::Run;
pub(crate) use orbit::note;
pub(crate) use settings::{options, tolerance};
pub use simulate::{simulate, simulate_into, simulate_with_progress};
pub use simulation::Simulation;
pub use snapshot::Snapshot;
