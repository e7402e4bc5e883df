//! Losses of contacts, by cause.

use crate::contact::{OilTouch, Touch};

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
    pub fn touch(&mut self, touch: &Touch) {
        self.slip += touch.friction_power;
        self.damping += (touch.normal - touch.elastic) * touch.approach;
    }

    /// Adds those of the oil in a contact.
    pub fn oil(&mut self, oil: &OilTouch) {
        self.rolling += oil.power.iter().sum::<f64>();
    }
}
