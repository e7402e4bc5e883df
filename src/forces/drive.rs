//! Drive of the rings: a torque on the inner ring, or prescribed speeds, whose motion is known without a force.

use super::{Account, Asymmetry, Damper, Force, ForceSums, Instant, RingWrench, Use};
use crate::model::{Model, Race};
use crate::scene::Drive;

/// The torque on the inner ring.
#[derive(Debug)]
pub(crate) struct DriveTorque;

impl Force for DriveTorque {
    fn name(&self) -> &'static str {
        "drive"
    }

    fn used(&self, model: &Model) -> Use {
        match &model.scene.drive {
            Drive::Torque { value, .. } => Use::evaluated(value.peak() > 0.0),
            Drive::Speed(_) => Use::Absent,
        }
    }

    fn add(&self, model: &Model, at: &Instant<'_>, sums: &mut ForceSums<'_>) {
        if let Drive::Torque { value, .. } = &model.scene.drive {
            let moment = at.frame(Race::Inner).axis() * value.at(at.t);
            let torque = RingWrench {
                moment,
                ..RingWrench::default()
            };
            sums.add(Race::Inner, &torque);
        }
    }

    /// Account of nothing: a torque does work, and stores and takes nothing.
    fn account(&self, _model: &Model, _y: &[f64]) -> Account {
        Account::default()
    }

    fn dampers(&self, _model: &Model) -> Vec<Damper> {
        Vec::new()
    }

    fn at_start(&self, _model: &Model, _race: Race) -> RingWrench {
        RingWrench::default()
    }

    fn asymmetry(&self, _model: &Model) -> Asymmetry {
        Asymmetry::default()
    }
}

/// The angular acceleration of a ring whose speed is prescribed \[rad/s²\].
#[inline]
pub(crate) fn acceleration(model: &Model, race: Race, t: f64) -> Option<f64> {
    let speed = model.scene.given_speed(race.into())?;
    Some(speed.rate(t))
}
