//! A run: scene → model → start → settle → integrate → signals. Begin reading at `simulate`.
//!
//! * `options` ([`Run`]) — the options; `accuracy` finds nodes, tolerance and step cap for a requested accuracy.
//! * `method` — the method, and the switch between two of them; `step_limit` — the largest step of each.
//! * `prepare` — what comes before: the scene as the run has it, memory, start; `provenance` — what is recorded about it.
//! * `settle` — the decay of the start's transient before t = 0; `follow` — steps over a stretch of time.
//! * `budget`, `step_collapse`, `runaway`, `escape`, `orbit`, `ending` — when it stops, and its errors.

mod accuracy;
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
mod settle;
mod simulate;
mod step_collapse;
pub(crate) mod step_limit;

pub(crate) use follow::{options, tolerance};
pub use options::Run;
pub(crate) use orbit::note;
pub use simulate::{simulate, simulate_into, simulate_with_progress};
