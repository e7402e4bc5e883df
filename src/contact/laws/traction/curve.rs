//! A traction curve of a lubricated contact.

use super::{Sliding, smoothed};
use crate::simd::Number;

/// μ(u) = (A + B u) exp(−C u) + D.
///
/// Source: P. K. Gupta, *Advanced Dynamics of Rolling Elements*, Springer 1984.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TractionCurve {
    /// A.
    pub a: f64,
    /// B \[s/m\].
    pub b: f64,
    /// C \[s/m\].
    pub c: f64,
    /// D.
    pub d: f64,
    /// v_s, below which friction fades \[m/s\].
    pub slip_speed: f64,
}

impl TractionCurve {
    #[inline]
    pub(super) fn factor<T: Number>(&self, element: &Sliding<T>) -> T {
        let slip = element.squared.sqrt();
        let mu = (slip * self.b + self.a) * (slip * -self.c).exp() + self.d;
        mu * smoothed(element.squared, self.slip_speed)
    }
}
