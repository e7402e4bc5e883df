//! The direction from a body's centre to a contact.

use nalgebra::Vector3;

use super::SurfaceDefect;
use crate::contact::{Motion, V2, cross, wrapped};

/// A direction in which a ball or a race is met, as its defects are asked about it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactDirection<'a> {
    /// Angle from the body's mark \[rad\].
    pub(super) angle: f64,
    /// Direction in the ring's frame.
    pub(super) n: V2,
    /// The ball that it goes out from; none of a race.
    ball: Option<&'a Motion>,
}

impl<'a> ContactDirection<'a> {
    /// The direction of a race, at an angle from the ring's mark \[rad\].
    pub fn race(angle: f64) -> Self {
        Self {
            angle,
            n: V2::zeros(),
            ball: None,
        }
    }

    /// The direction of a ball, in the ring's frame with its angle \[rad\].
    pub fn ball(ball: &'a Motion, n: V2, direction: f64) -> Self {
        Self {
            angle: ball.angle_of(direction),
            n,
            ball: Some(ball),
        }
    }

    /// The direction e of the middle of a ball's defect that turns with the ball in every direction.
    pub(super) fn pole(&self, defect: &SurfaceDefect) -> Option<Vector3<f64>> {
        defect.pole(self.ball?)
    }

    /// The angle from here to a direction e of the ball \[rad\].
    pub(super) fn angle_to(&self, e: &Vector3<f64>) -> f64 {
        cross(self.n, e.xy()).atan2(self.n.dot(&e.xy()))
    }

    /// Distance of the direction from a defect's middle \[rad\].
    pub fn offset(&self, defect: &SurfaceDefect) -> f64 {
        match self.pole(defect) {
            None => wrapped(self.angle - defect.angle),
            Some(e) => -self.angle_to(&e),
        }
    }

    /// Half of the angle over which a defect may be met \[rad\].
    pub fn half(&self, defect: &SurfaceDefect) -> f64 {
        defect.form.get().half(defect, self.pole(defect).as_ref())
    }

    /// How fast a defect turns about the ring's axis \[rad/s\], of a body with this angular speed about it.
    pub fn turning(&self, defect: &SurfaceDefect, omega: f64) -> f64 {
        match (self.pole(defect), self.ball) {
            (Some(e), Some(ball)) => omega - ball.across.dot(&e.xy()) * e.z / e.xy().norm_squared(),
            _ => omega,
        }
    }
}
