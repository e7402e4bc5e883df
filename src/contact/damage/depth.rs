//! Depth of one element behind another: a number, or one with the slopes that its gradient needs.

use crate::contact::dual::Dual;
use std::ops::{Add, Sub};

/// Distance by which an element stands behind another \[m\], or a penetration: alone, or with what its gradient needs.
pub(in crate::contact) trait Depth:
    Copy + Add<Output = Self> + Sub<Output = Self>
{
    /// Whether the depth has slopes.
    const SLOPES: bool;
    /// Depth out of reach.
    const NEVER: Self;

    /// A depth from its value and slopes.
    fn new(value: f64, by_z: f64, by_zeta: f64) -> Self;

    fn value(self) -> f64;

    /// The same with another slope along the ball.
    fn along_ball(self, by_zeta: f64) -> Self;
}

impl Depth for f64 {
    const SLOPES: bool = false;
    const NEVER: Self = Self::INFINITY;

    fn new(value: f64, _by_z: f64, _by_zeta: f64) -> Self {
        value
    }

    fn value(self) -> f64 {
        self
    }

    fn along_ball(self, _by_zeta: f64) -> Self {
        self
    }
}

/// A depth with its derivatives by the place z in the ring's frame, at a fixed slice of the ball, and by the slice ζ, at a fixed
/// place in the ring's frame.
pub(in crate::contact) type Sloped = Dual<f64, 2>;

impl Depth for Sloped {
    const SLOPES: bool = true;
    const NEVER: Self = Self {
        value: f64::INFINITY,
        slopes: [0.0; 2],
    };

    fn new(value: f64, by_z: f64, by_zeta: f64) -> Self {
        let slopes = [by_z, by_zeta];
        Self { value, slopes }
    }

    fn value(self) -> f64 {
        self.value
    }

    fn along_ball(self, by_zeta: f64) -> Self {
        let slopes = [self.slopes[0], by_zeta];
        Self { slopes, ..self }
    }
}
