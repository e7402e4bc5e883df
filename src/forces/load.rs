//! Loads: forces of fixed direction and a size that may change in time, at the centres of rings.
//!
//! They do work on the bearing and store nothing.

use nalgebra::Vector3;

use super::{Force, Table, Use};
use crate::model::{LoadModel, Model};
use crate::scene::TimeFunction;

pub(crate) const FORCE: Force = Force {
    name: "load",
    contribution: "load",
    used,
    add: |model, t, _, forces| {
        add(model, true, 0.0, forces);
        add(model, false, t, forces);
    },
};

/// Whether one stays the same.
#[inline]
pub(crate) fn is_steady(load: &LoadModel) -> bool {
    matches!(load.force, TimeFunction::Constant(_))
}

/// One at a time \[s\], along x, y and z \[N\].
#[inline]
pub(crate) fn at(load: &LoadModel, t: f64) -> Vector3<f64> {
    Vector3::from(load.direction) * load.force.at(t)
}

fn used(model: &Model) -> Use {
    let mut loads = model.loads.iter().filter(|load| load.force.peak() > 0.0);
    if loads.clone().all(is_steady) {
        Use::constant(loads.next().is_some())
    } else {
        Use::Evaluated
    }
}

/// Loads that stay the same, or those that change.
#[inline]
pub(crate) fn add(model: &Model, steady: bool, t: f64, forces: &mut Table) {
    for load in model.loads.iter().filter(|load| is_steady(load) == steady) {
        let force = at(load, t);
        forces.add(load.ring.ring(), &[force.x, force.y, force.z, 0.0]);
    }
}
