//! Friction that falls from rest to sliding.

use super::{Sliding, smoothed};
use crate::simd::Number;

/// μ(u) = μ_k + (μ_s − μ_k) exp(−(u/v_St)²).
///
/// Source: R. Stribeck 1902; the exponential after L. C. Bo, D. Pavelescu, Wear 82 (1982) 277.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stribeck {
    /// μ_s at rest.
    pub static_coefficient: f64,
    /// μ_k at large slip.
    pub kinetic_coefficient: f64,
    /// v_St \[m/s\].
    pub decay_speed: f64,
    /// v_s, below which friction fades \[m/s\].
    pub slip_speed: f64,
}

impl Stribeck {
    #[inline]
    pub(super) fn factor<T: Number>(&self, element: &Sliding<T>) -> T {
        let fade = (element.squared * -self.decay_speed.powi(-2)).exp();
        let mu =
            fade * (self.static_coefficient - self.kinetic_coefficient) + self.kinetic_coefficient;
        mu * smoothed(element.squared, self.slip_speed)
    }
}
