//! Height and slope of a surface over its round shape, at a place.

use crate::simd::Lanes;

/// How waves raise a race under a ball, or a ball before a race, or eight of them \[m\].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Raise<T> {
    /// Height over the radius.
    pub height: T,
    /// Derivative of the height by the angle, R'(φ).
    pub slope: T,
}

impl Raise<Lanes> {
    /// The place in a lane.
    #[inline(always)]
    pub(crate) fn of(&self, lane: usize) -> Raise<f64> {
        Raise {
            height: self.height[lane],
            slope: self.slope[lane],
        }
    }

    /// Takes over a place into a lane.
    pub(crate) fn set(&mut self, lane: usize, of: Raise<f64>) {
        (self.height[lane], self.slope[lane]) = (of.height, of.slope);
    }
}
