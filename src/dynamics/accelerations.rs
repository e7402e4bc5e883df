//! Accelerations of bodies from the forces on them, and of rings from their given motions.

use super::Dynamics;
use crate::forces::drive;
use crate::model::{BodyId, BodyKind, DOFS, Dof, Layout, Race};

impl Dynamics<'_> {
    /// M⁻¹ F of all bodies.
    pub(crate) fn accelerate(&self, t: f64, accelerations: &mut [f64]) {
        let bodies = Layout::each_mut(accelerations).iter_mut();
        for (acceleration, body) in bodies.zip(self.model.layout().bodies()) {
            *acceleration = self.acceleration(t, body);
        }
        if let Some(tilted) = &self.tilted {
            tilted.accelerate(self.model, t, &self.state, accelerations);
        }
    }

    /// Acceleration of a ring along the axes or about its own where its motion or speed is given.
    pub(super) fn prescribed(&self, t: f64, race: Race, dof: Dof) -> Option<f64> {
        if dof == Dof::Theta {
            return drive::acceleration(self.model, race, t);
        }
        let state = [&self.state.q, &self.state.v].map(|half| half.get(race.ring(), dof));
        self.model.given_acceleration(race, dof, t, state)
    }

    /// M⁻¹ F of a body. Directions that are fixed do not accelerate; a ring accelerates as prescribed where its motion or speed
    /// is given.
    fn acceleration(&self, t: f64, body: BodyId) -> [f64; DOFS] {
        let (force, mobility) = (self.forces.of(body), &self.model.mobility[body]);
        let mut acceleration = std::array::from_fn(|i| force[i] * mobility[i]);
        if let BodyKind::Ring(race) = self.model.layout().kind(body) {
            for dof in Dof::ALL {
                if let Some(prescribed) = self.prescribed(t, race, dof) {
                    acceleration[dof] = prescribed;
                }
            }
        }
        acceleration
    }
}
