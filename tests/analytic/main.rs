//! Truths that need no other program: closed forms, conservation, symmetry.

#[path = "../common/mod.rs"]
mod common;

mod balance;
mod cage_ring;
mod caps;
mod coefficients;
mod contact;
mod dents;
mod energy;
mod equilibrium;
mod fitted;
mod friction;
mod given_motion;
mod laws;
mod lubricant;
mod lubrication;
mod oil_contact;
mod oil_run;
mod pits;
mod profiles;
mod records;
mod ring_force;
mod squeeze;
mod start;
mod structure;
mod texture;
mod tilt;
mod tilt_random;
