//! The seat of the outer ring on a structure with modes ([*A structure with modes*](crate::equations#a-structure-with-modes)).
//!
//! ```text
//! u_s = Σ Φ_i q_i      F = K (u_r − u_s) + C (u̇_r − u̇_s)      −F on the ring, Φ_i · F on mode i
//! energy ½ (u_r − u_s)ᵀ K (u_r − u_s)                          power (u̇_r − u̇_s)ᵀ C (u̇_r − u̇_s)
//! ```
//!
//! Springs and dampers of the modes themselves are supports of their bodies, and are accounted for there.

use nalgebra::Vector3;

use super::{Account, Asymmetry, Damper, Force, ForceSums, Instant, RingWrench, Use};
use crate::model::{BodyId, Dof, Model, Race, StructureModel};

/// Seat of the outer ring.
#[derive(Debug)]
pub(crate) struct Seat;

impl Force for Seat {
    fn name(&self) -> &'static str {
        "structure"
    }

    fn contribution(&self) -> &'static str {
        "support"
    }

    fn is_rare(&self) -> bool {
        true
    }

    fn used(&self, model: &Model) -> Use {
        Use::evaluated(model.structure.is_some())
    }

    fn add(&self, model: &Model, at: &Instant<'_>, sums: &mut ForceSums<'_>) {
        let Some(structure) = &model.structure else {
            return;
        };
        let modes = model.layout().modes();
        let stretch = [&at.state.q, &at.state.v].map(|half| {
            let ring = Dof::TRANSLATIONS.map(|dof| half.get(BodyId::OUTER, dof));
            Vector3::from(ring) - structure.at_seat(half.along(Dof::X)[modes.clone()].iter())
        });
        let force = structure.force(stretch);
        for (dof, force) in Dof::TRANSLATIONS.into_iter().zip(force.iter()) {
            *sums.on.get_mut(BodyId::OUTER, dof) -= force;
        }
        let on_modes = &mut sums.on.along_mut(Dof::X)[modes];
        for (sum, mode) in on_modes.iter_mut().zip(&structure.modes) {
            *sum += mode.seat.dot(&force);
        }
    }

    fn account(&self, model: &Model, y: &[f64]) -> Account {
        let Some(structure) = &model.structure else {
            return Account::default();
        };
        let [stretch, rate] = structure.stretch(model.layout(), y);
        Account {
            support: 0.5 * stretch.dot(&(structure.stiffness * stretch)),
            power: rate.dot(&structure.damping.component_mul(&rate)),
            ..Account::default()
        }
    }

    /// Dampers of none: those of ring and modes are listed as their supports'.
    fn dampers(&self, _model: &Model) -> Vec<Damper> {
        Vec::new()
    }

    fn at_start(&self, _model: &Model, _race: Race) -> RingWrench {
        RingWrench::default()
    }

    fn asymmetry(&self, model: &Model) -> Asymmetry {
        let couples = model
            .structure
            .as_ref()
            .is_some_and(StructureModel::couples_z);
        Asymmetry {
            along_z: couples
                .then(|| "the structure moves the seat along z with its plane".to_owned()),
            ..Asymmetry::default()
        }
    }
}
