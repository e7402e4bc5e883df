//! Coulomb's friction.

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

    /// φ, and φ'(u)/u = −φ/(u² + v_s²): by hand with one division and one root, where differentiating takes two
    /// divisions more; implicit methods ask for it most.
    #[inline(always)]
    pub(super) fn factor_and_bend<T: Number>(&self, element: &Sliding<T>) -> (T, T) {
        let one = element.squared.same(1.0);
        let square = one / (element.squared + self.slip_speed * self.slip_speed);
        let factor = square.sqrt() * self.coefficient;
        (factor, -(factor * square))
    }
}
