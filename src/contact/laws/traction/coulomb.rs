//! Coulomb's friction.

// Into loops that are compiled for the instructions at hand.
#![allow(clippy::inline_always)]

use super::{Sliding, smoothed};
use crate::simd::Number;

/// μ constant (equation 8).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coulomb {
    /// μ.
    pub coefficient: f64,
    /// v_s, below which friction fades \[m/s\].
    pub slip_speed: f64,
}

impl Coulomb {
    #[inline(always)]
    pub(super) fn factor<T: Number>(&self, element: &Sliding<T>) -> T {
        smoothed(element.squared, self.slip_speed) * self.coefficient
    }
}
