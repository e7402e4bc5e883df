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

impl LoadModel {
    /// Whether it stays the same.
    pub fn is_steady(&self) -> bool {
        matches!(self.force, TimeFunction::Constant(_))
    }

    /// At a time \[s\], along x, y and z \[N\].
    pub fn at(&self, t: f64) -> Vector3<f64> {
        Vector3::from(self.direction) * self.force.at(t)
    }
}

fn used(model: &Model) -> Use {
    let mut loads = model.loads.iter().filter(|load| load.force.peak() > 0.0);
    if loads.clone().all(LoadModel::is_steady) {
        Use::constant(loads.next().is_some())
    } else {
        Use::Evaluated
    }
}

/// Loads that stay the same, or those that change.
pub(crate) fn add(model: &Model, steady: bool, t: f64, forces: &mut Table) {
    for load in model.loads.iter().filter(|load| load.is_steady() == steady) {
        let force = load.at(t);
        forces.add(load.ring.ring(), &[force.x, force.y, force.z, 0.0]);
    }
}
