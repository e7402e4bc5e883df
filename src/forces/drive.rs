//! The drive of the inner ring: a torque, or a prescribed speed, whose motion is known without a force.

use super::{Force, Table, Use};
use crate::model::{BodyId, Dof, Model};
use crate::scene::Drive;

pub(crate) const FORCE: Force = Force {
    name: "drive",
    contribution: "drive",
    used: |model| match &model.scene.drive {
        Drive::Torque { value, .. } => Use::evaluated(value.peak() > 0.0),
        Drive::Speed(_) => Use::Absent,
    },
    add: |model, t, _, forces| add(model, t, forces),
};

/// The torque on the inner ring.
#[inline]
pub(crate) fn add(model: &Model, t: f64, forces: &mut Table) {
    if let Drive::Torque { value, .. } = &model.scene.drive {
        *forces.get_mut(BodyId::INNER, Dof::Theta) += value.at(t);
    }
}

/// The angular acceleration of the inner ring where its speed is prescribed \[rad/s²\].
#[inline]
pub(crate) fn acceleration(model: &Model, t: f64) -> Option<f64> {
    match &model.scene.drive {
        Drive::Speed(speed) => Some(speed.rate(t)),
        Drive::Torque { .. } => None,
    }
}
