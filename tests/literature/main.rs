//! Published numbers: textbooks, standards, catalogues, measurements, each with its source.

#[path = "../common/mod.rs"]
mod common;

mod contacts;
mod dynamics;
mod moments;
mod spall;
mod statics;
mod stiffness;
mod tilt;
mod walls;
