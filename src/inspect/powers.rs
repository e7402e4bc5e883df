//! Losses of contacts, by cause.

use crate::contact::{ContactForce, OilForce};

/// Powers that contacts take out \[W\].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct ContactPowers {
    /// Power lost by slip.
    pub slip: f64,
    /// Power lost by damping, of steel and film.
    pub damping: f64,
    /// Power lost by rolling resistance, of film and steel.
    pub rolling: f64,
}

impl ContactPowers {
    /// Adds those of a single force.
    pub fn force(&mut self, force: &ContactForce) {
        self.slip += force.friction_power;
        self.damping += (force.normal - force.elastic) * force.approach;
    }

    /// Adds those of the oil in a contact.
    pub fn oil(&mut self, oil: &OilForce) {
        self.rolling += oil.power.iter().sum::<f64>();
    }
}
