//! Damping after Hunt and Crossley: F = F_el (1 + 3/2 α_d v_n).

use crate::simd::Number;

/// Equations (2) and (4) of the paper.
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | α_d | coefficient | s/m |
/// | v_n | approach speed of the element | m/s |
///
/// Source: K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440: restitution is about 1 − α_d v.
///
/// ```
/// use ballrace::contact::Damping;
/// let law = Damping { coefficient: 0.2, clamp_pull: true };
/// assert_eq!(law.rate(), 0.2 * 1.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Damping {
    /// α_d \[s/m\].
    pub coefficient: f64,
    /// Whether an element that pulls is set to zero.
    pub clamp_pull: bool,
}

impl Damping {
    /// Force over elastic force and approach speed, 3/2 α_d \[s/m\].
    pub fn rate(&self) -> f64 {
        1.5 * self.coefficient
    }

    /// The factor on the elastic force at an approach speed.
    #[inline(always)]
    pub(crate) fn factor<T: Number>(&self, approach: T) -> T {
        approach * self.rate() + 1.0
    }

    /// The same with a film whose rate, 3/2 α_f, comes on top \[s/m\].
    #[inline(always)]
    pub(crate) fn factor_with<T: Number>(&self, approach: T, film: T) -> T {
        approach * (film + self.rate()) + 1.0
    }
}
