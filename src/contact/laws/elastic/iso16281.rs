//! The paper's law, after the roller slices of ISO/TS 16281: F = (C/D) Σ s^{10/9} Δζ.

use super::ElasticLaw;
use super::power::ten_ninths;
use crate::simd::Number;

/// Exponent of the penetration.
pub const EXPONENT: f64 = 10.0 / 9.0;

/// Equations (2) and (3) without damping.
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | C | constant · (L_el)^{8/9}, with 35948 N/mm² and L_el = D/2 in the paper | N/m^{10/9} |
/// | s | penetration of a slice | m |
/// | Δζ | width of a slice; n of them make D | m |
///
/// The exponent 8/9 is lost in the paper's print. 35948 is the constant of a roller between *both*
/// raceways; for one contact of the pair it would be 35948·2^{10/9}.
///
/// ```
/// use ballrace::contact::{Elastic, iso16281::Iso16281};
/// // D = 11.9 mm: C = 35948 · 5.95^{8/9} = 175 457 N/mm^{10/9}; a 0.119 mm slice at 0.02 mm carries 22.72 N.
/// let law = Elastic::Iso16281(Iso16281::new(3.5948e10, 0.5, 11.9e-3));
/// assert!((law.force(20e-6, 0.119e-3) - 22.72).abs() < 0.01);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Iso16281 {
    /// C/D \[N m^{−19/9}\].
    density: f64,
}

impl Iso16281 {
    /// The law from the constant \[N/m²\], L_el/D and the ball diameter \[m\].
    pub fn new(constant: f64, length_ratio: f64, ball_diameter: f64) -> Self {
        Self {
            density: constant * (length_ratio * ball_diameter).powf(8.0 / 9.0) / ball_diameter,
        }
    }

    /// C/D \[N m^{−19/9}\].
    pub(crate) fn density(self) -> f64 {
        self.density
    }

    /// Elastic energy per width \[J/m\] at a penetration ≥ 0 \[m\].
    pub(super) fn energy(self, depth: f64) -> f64 {
        self.density * (9.0 / 19.0) * depth.powf(19.0 / 9.0)
    }
}

impl ElasticLaw for Iso16281 {
    const FLAT: bool = false;

    /// (C/D) s^{10/9}.
    #[inline(always)]
    fn load<T: Number, const FMA: bool>(density: T, depth: T) -> T {
        let slope = |s: f64, power: f64| if s > 0.0 { EXPONENT * power / s } else { 0.0 };
        density * depth.curve(ten_ninths::<FMA>, slope)
    }
}
