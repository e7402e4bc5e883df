//! Loads: forces of fixed direction and a size that may change in time, at points of rings, and moments likewise.
//!
//! They do work on the bearing and store no energy.

use nalgebra::Vector3;

use super::{Force, Table, Use};
use crate::model::{Dof, LoadModel, Model, MomentModel, Race};
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
    let forces = model.loads.iter().map(|load| &load.force);
    let moments = model.moments.iter().map(|moment| &moment.moment);
    let mut sizes = forces.chain(moments).filter(|size| size.peak() > 0.0);
    let steady = |size: &TimeFunction| matches!(size, TimeFunction::Constant(_));
    if sizes.clone().all(steady) {
        Use::constant(sizes.next().is_some())
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
    if model.is_spatial() {
        // Moments come with those of all else.
        return;
    }
    for load in model.loads.iter().filter(|load| is_steady(load) == steady) {
        if let Some(arm) = &load.arm {
            *forces.get_mut(load.ring.ring(), Dof::Theta) += arm.cross(&at(load, t)).z;
        }
    }
    let is_steady = |of: &MomentModel| matches!(of.moment, TimeFunction::Constant(_));
    for moment in model.moments.iter().filter(|of| is_steady(of) == steady) {
        *forces.get_mut(moment.ring.ring(), Dof::Theta) +=
            moment.direction[2] * moment.moment.at(t);
    }
}

/// Of all loads and moments on a ring about its centre of mass at a time \[s\], in the scene's frame \[N m\]; `out` leads vectors of
/// the ring's frame there.
pub(crate) fn moment(
    model: &Model,
    t: f64,
    ring: Race,
    out: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> Vector3<f64> {
    let mut sum = Vector3::zeros();
    for load in model.loads.iter().filter(|load| load.ring == ring) {
        if let Some(arm) = &load.arm {
            sum += out(arm).cross(&at(load, t));
        }
    }
    for moment in model.moments.iter().filter(|moment| moment.ring == ring) {
        sum += Vector3::from(moment.direction) * moment.moment.at(t);
    }
    sum
}
