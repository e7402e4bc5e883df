//! Gravity: F = m g on every body, energy −m g · r.

use super::{Force, Table, Use};
use crate::model::{BodyId, Dof, Model};

pub(crate) const FORCE: Force = Force {
    name: "gravity",
    contribution: "gravity",
    used: |model| Use::constant(model.scene.gravity != [0.0; 3]),
    add: |model, _, _, forces| add(model, forces),
};

/// On all bodies.
pub(crate) fn add(model: &Model, forces: &mut Table) {
    for body in model.layout().bodies() {
        for (dof, force) in Dof::TRANSLATIONS.into_iter().zip(on(model, body)) {
            *forces.get_mut(body, dof) += force;
        }
    }
}

/// On a body along x, y and z \[N\].
#[inline]
pub(crate) fn on(model: &Model, body: BodyId) -> [f64; 3] {
    let mass = &model.bodies[body].mass;
    Dof::TRANSLATIONS.map(|dof| mass[dof] * model.scene.gravity[dof.index()])
}

/// On a body along a direction in the plane \[N\].
#[inline]
pub(crate) fn along(model: &Model, body: BodyId, [x, y]: [f64; 2]) -> f64 {
    let [gx, gy, _] = model.scene.gravity;
    model.bodies[body].mass[Dof::X] * (gx * x + gy * y)
}

/// Energy of all bodies, 0 at the origin \[J\].
pub(crate) fn energy(model: &Model, y: &[f64]) -> f64 {
    let mut energy = 0.0;
    for body in model.layout().bodies() {
        let place = model.layout().centre(y, body);
        for (force, place) in on(model, body).into_iter().zip(place) {
            energy -= force * place;
        }
    }
    energy
}
