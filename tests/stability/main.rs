//! Where methods fail: each test names the failure, shows it, and shows what happens here instead.

#[path = "../common/mod.rs"]
mod common;

mod contact;
mod defects;
mod extremes;
mod friction;
mod geometry;
mod limits;
