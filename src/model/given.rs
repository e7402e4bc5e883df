//! Directions of rings whose motion is given: it is integrated with everything else, from exact accelerations.
//!
//! ```text
//! q̈ = g̈(t) + 2 λ (ġ(t) − q̇) + λ² (g(t) − q)
//! ```
//!
//! The last two terms (Baumgarte's stabilisation) keep errors of steps from adding up: at a rate λ slow against steps and fast
//! against a run ([`Model::stabilisation_rate`]).

use super::{Degree, Dof, Model, Race};
use crate::scene::{Mount, Ring, TimeFunction};

/// The directions of a ring whose motion may be given, in their order.
const DOFS: [Dof; 5] = [Dof::X, Dof::Y, Dof::Z, Dof::TiltX, Dof::TiltY];

/// The given motions of a ring.
#[derive(Debug, Clone, Default)]
pub(crate) struct GivenMotions([Option<TimeFunction>; 5]);

impl GivenMotions {
    pub(super) fn new(ring: &Ring) -> Self {
        let support = &ring.support;
        let mounts = [
            &support.x,
            &support.y,
            &support.z,
            &support.tilt_x,
            &support.tilt_y,
        ];
        Self(mounts.map(|mount| match mount {
            Some(Mount::Given(motion)) => Some((**motion).clone()),
            _ => None,
        }))
    }

    /// The given motion along or about an axis.
    pub(crate) fn of(&self, dof: Dof) -> Option<&TimeFunction> {
        let at = DOFS.iter().position(|one| *one == dof)?;
        self.0[at].as_ref()
    }

    /// All given motions with their directions.
    pub(crate) fn all(&self) -> impl Iterator<Item = (Dof, &TimeFunction)> {
        let each = DOFS.into_iter().zip(&self.0);
        each.filter_map(|(dof, motion)| Some((dof, motion.as_ref()?)))
    }
}

impl Model {
    /// Whether a motion is given along the axis or about another.
    pub(crate) fn has_given_motions_off_plane(&self) -> bool {
        let given = self.rings.iter().flat_map(|ring| ring.given.all());
        given
            .into_iter()
            .any(|(dof, _)| !Dof::SYMMETRIC.contains(&dof))
    }

    /// Acceleration of a ring in a direction whose motion is given, from its place and speed.
    pub(crate) fn given_acceleration(
        &self,
        race: Race,
        dof: Dof,
        t: f64,
        [place, speed]: [f64; 2],
    ) -> Option<f64> {
        if self.degree(race, dof) != Degree::Driven {
            return None;
        }
        let motion = self.rings[race].given.of(dof)?;
        let rate = self.stabilisation_rate();
        let behind = motion.rate(t) - speed + 0.5 * rate * (motion.at(t) - place);
        Some(motion.curvature(t) + 2.0 * rate * behind)
    }

    /// Brings rings in a state to the places and speeds that they are given.
    pub(crate) fn follow_given(&self, t: f64, y: &mut [f64]) {
        for race in Race::BOTH {
            for (dof, motion) in self.rings[race].given.all() {
                let ring = race.ring();
                y[self.layout.at(ring, dof)] = motion.at(t);
                y[self.layout.speed_at(ring, dof)] = motion.rate(t);
            }
        }
    }
}
