//! The programs of `examples/` run to their end; what each knows to be true it asserts itself.

#[path = "../../examples/blocks.rs"]
mod blocks;
#[path = "../../examples/campaign.rs"]
mod campaign;
#[path = "../../examples/cancel.rs"]
mod cancel;
#[path = "../../examples/own_bearing.rs"]
mod own_bearing;
#[path = "../../examples/own_ode.rs"]
mod own_ode;
#[cfg(feature = "catalogue")]
#[path = "../../examples/service.rs"]
mod service;

#[test]
fn blocks_runs() {
    blocks::main().unwrap();
}

#[test]
fn campaign_runs() {
    campaign::main().unwrap();
}

#[test]
fn cancel_runs() {
    cancel::main().unwrap();
}

#[test]
fn own_bearing_runs() {
    own_bearing::main().unwrap();
}

#[test]
fn own_ode_runs() {
    own_ode::main().unwrap();
}

#[cfg(feature = "catalogue")]
#[test]
fn service_runs() {
    service::main().unwrap();
}
