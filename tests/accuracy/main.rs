//! Errors of methods and defaults against better solutions.

#[path = "../common/mod.rs"]
mod common;

mod convergence;
mod defaults;
mod knob;
mod method_defaults;
mod methods;
mod methods_refused;
mod stability_region;
