//! Gravity: F = m g on every body, energy −m g · r.

use super::{Account, Asymmetry, Damper, Force, ForceSums, RingWrench, Use};
use crate::model::{BodyId, BodyKind, Dof, Model, Race};

/// Weight of all bodies.
#[derive(Debug)]
pub(crate) struct Gravity;

impl Force for Gravity {
    fn name(&self) -> &'static str {
        "gravity"
    }

    fn used(&self, model: &Model) -> Use {
        Use::constant(model.scene.gravity != [0.0; 3])
    }

    fn add_constant(&self, model: &Model, sums: &mut ForceSums<'_>) {
        for body in model.layout().bodies() {
            for (dof, force) in Dof::TRANSLATIONS.into_iter().zip(on(model, body)) {
                *sums.on.get_mut(body, dof) += force;
            }
        }
    }

    fn account(&self, model: &Model, y: &[f64]) -> Account {
        Account {
            gravity: energy(model, y),
            ..Account::default()
        }
    }

    fn dampers(&self, _model: &Model) -> Vec<Damper> {
        Vec::new()
    }

    fn at_start(&self, model: &Model, race: Race) -> RingWrench {
        RingWrench {
            force: on(model, race.ring()).into(),
            ..RingWrench::default()
        }
    }

    fn asymmetry(&self, model: &Model) -> Asymmetry {
        Asymmetry {
            along_z: (model.scene.gravity[2] != 0.0).then(|| "gravity acts along z".to_owned()),
            ..Asymmetry::default()
        }
    }
}

/// Weight of a body along x, y and z \[N\]; none of a mode, whose place is that from its rest.
#[inline]
pub(crate) fn on(model: &Model, body: BodyId) -> [f64; 3] {
    if let BodyKind::Mode(_) = model.layout().kind(body) {
        return [0.0; 3];
    }
    let mass = &model.bodies[body].mass;
    Dof::TRANSLATIONS.map(|dof| mass[dof] * model.scene.gravity[dof.index()])
}

/// Weight of a body along a direction in the plane \[N\].
#[inline]
pub(crate) fn along(model: &Model, body: BodyId, [x, y]: [f64; 2]) -> f64 {
    let [gx, gy, _] = model.scene.gravity;
    model.bodies[body].mass[Dof::X] * (gx * x + gy * y)
}

/// Energy of all bodies, 0 at the origin \[J\].
fn energy(model: &Model, y: &[f64]) -> f64 {
    let mut energy = 0.0;
    for body in model.layout().bodies() {
        let place = model.layout().centre(y, body);
        for (force, place) in on(model, body).into_iter().zip(place) {
            energy -= force * place;
        }
    }
    energy
}
