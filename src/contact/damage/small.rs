//! Places of damages that are smaller than their contacts.

use nalgebra::Vector3;

use super::hole::PittedContact;
use super::{Bed, MARGIN, SurfaceDefect};

/// Place of a damage that is smaller than its contacts.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SmallBed {
    /// Contacts with the outer and the inner race, where the damage can meet them.
    pub contacts: [PittedContact; 2],
    /// Radius of the surface there \[m\].
    pub radius: f64,
    /// Half of the damage along rolling \[m\].
    along: f64,
    /// Half of the angle over which a contact as wide as under the typical load meets it \[rad\].
    pub span: f64,
}

impl SmallBed {
    /// The bed of a damage that is so long along rolling from its middle \[m\].
    pub fn new(along: f64, bed: &Bed) -> Self {
        Self {
            contacts: bed.contacts,
            radius: bed.radius,
            along,
            span: along / bed.radius,
        }
    }

    /// How far a damage is looked for in its bed \[rad\].
    pub fn reach(&self) -> f64 {
        MARGIN * self.along / self.radius
    }

    /// Takes over the half-width of contacts under a typical load \[m\]: the damage is met from so far away on, and looked for from twice as
    /// far, as under eight times the load \[rad\].
    pub fn widened(&mut self, half_width: f64) -> f64 {
        self.span = (self.along + half_width) / self.radius;
        (self.along + 2.0 * half_width) / self.radius
    }

    /// The direction of a ball's damage in the ball's frame.
    pub fn pole(&self, of: &SurfaceDefect) -> Vector3<f64> {
        let along = of.middle / self.radius;
        let across = (1.0 - along * along).max(0.0).sqrt();
        let (sin, cos) = of.angle.sin_cos();
        Vector3::new(across * cos, across * sin, along)
    }
}

/// Half-axes across the race and along rolling of an ellipse of a width and, unless it is round, a length \[m\].
pub(super) fn half_axes(width: f64, length: Option<f64>) -> [f64; 2] {
    let along = width / 2.0;
    [length.map_or(along, |length| length / 2.0), along]
}
