//! Traction of an oil film.

use super::Sliding;
use crate::simd::Number;

/// μ F u⃗/(c + √(u² + c²)) ([*Film*](crate::equations#film)): smooth, with the slope μ/(2 c) where nothing slips.
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | μ | traction coefficient at large slip: of the film's limiting shear stress and of asperities | |
/// | c | half of the slip at which the film's compliance and asperities' creep give way to the limit | m/s |
///
/// Both are each contact's own; what stands here is that of the contact under the reference load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmTraction {
    /// μ.
    pub coefficient: f64,
    /// c at the reference load \[m/s\].
    pub bend: f64,
}

impl FilmTraction {
    #[inline(always)]
    pub(super) fn factor<T: Number>(element: &Sliding<T>) -> T {
        let c = element.bend;
        let root = (element.squared + c * c).sqrt();
        element.friction / (c + root)
    }

    /// φ, and φ'(u)/u = −φ/((c + ρ) ρ), ρ = √(u² + c²).
    #[inline(always)]
    pub(super) fn factor_and_bend<T: Number>(element: &Sliding<T>) -> (T, T) {
        let c = element.bend;
        let root = (element.squared + c * c).sqrt();
        let both = c + root;
        let factor = element.friction / both;
        (factor, -(factor / (both * root)))
    }
}
