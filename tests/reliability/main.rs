//! What users and contributors rely on: same bits on every level and thread count, refusals and doubts, campaigns, memory, the order of the modules.

#[path = "../common/mod.rs"]
mod common;

mod allocation;
mod architecture;
mod campaign;
mod determinism;
mod doubts;
mod examples;
mod levels;
mod pits;
mod public;
mod refusals;
