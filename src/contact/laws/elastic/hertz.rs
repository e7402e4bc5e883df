//! Hertz's point contact, cut into slices along the common normal.

use super::{ElasticLaw, elliptic};
use crate::scene::Material;
use crate::simd::Number;

/// Exponent of the local penetration.
pub const EXPONENT: f64 = 1.0;

/// The slice law q(τ) = k' (δ − κ τ²/2) dτ ([*Normal force*](crate::equations#normal-force)), which integrates to F = K δ^{3/2} over a
/// half-length a = c_a F^{1/3}.
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | K | stiffness of the contact | N/m^{3/2} |
/// | c_a | half-length along the groove over F^{1/3} | m/N^{1/3} |
/// | k' = 3 K^{2/3} / (4 c_a) | stiffness a length | N/m² |
/// | κ = 2 / (c_a² K^{2/3}) | curvature of the gap that the zone sees | 1/m |
/// | c_b | half-width along the race over F^{1/3} | m/N^{1/3} |
///
/// Source: H. Hertz 1881; exact elliptic integrals as in T. A. Harris, *Rolling Bearing Analysis*, ch. 6.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hertz {
    /// K \[N/m^{3/2}\].
    pub stiffness: f64,
    /// c_a \[m/N^{1/3}\].
    pub half_length: f64,
    /// k' \[N/m²\].
    pub slope: f64,
    /// κ \[1/m\].
    pub curvature: f64,
    /// c_b \[m/N^{1/3}\].
    pub half_width: f64,
}

impl Hertz {
    /// A ball of diameter `d` on a race of sign σ (+1 outer), conformity `f`, at the nominal contact angle.
    ///
    /// ```
    /// use ballrace::{contact::hertz::Hertz, scene::Material};
    /// // 209 deep groove: D 12.7, d_m 65, grooves of 6.6 mm: K inner 1.020e6 N/mm^1.5.
    /// let steel = Material::default();
    /// let inner = Hertz::new(-1.0, 12.7e-3, 65e-3, 6.6 / 12.7, 0.0, &steel, &steel);
    /// assert!((inner.stiffness / 1e9f64.sqrt() / 1.020e6 - 1.0).abs() < 1e-3);
    /// ```
    pub fn new(
        sigma: f64,
        ball_diameter: f64,
        pitch_diameter: f64,
        conformity: f64,
        contact_angle: f64,
        ball: &Material,
        race: &Material,
    ) -> Self {
        let d = ball_diameter;
        let gamma = d * contact_angle.cos() / pitch_diameter;
        // Principal curvatures: across the groove and along the race.
        let across = 2.0 / d - 1.0 / (conformity * d);
        let along = 2.0 / d - sigma * 2.0 * gamma / (d * (1.0 + sigma * gamma));
        let modulus = 1.0
            / ((1.0 - ball.poisson_ratio.powi(2)) / ball.youngs_modulus
                + (1.0 - race.poisson_ratio.powi(2)) / race.youngs_modulus);
        Self::of_curvatures(along, across, modulus)
    }

    /// The law from the curvatures along the race and across the groove \[1/m\], and 1/Σ((1 − ν²)/E) of both materials \[Pa\].
    pub(in crate::contact) fn of_curvatures(along: f64, across: f64, modulus: f64) -> Self {
        // Ellipse of axis ratio b/a = k' (a along the groove): along/across from the integrals,
        //   across ∝ (K − E)/m, along ∝ (E/(1 − m) − K)/m with m = 1 − (b/a)²; bisection in b/a.
        let ratio = along / across;
        let (mut low, mut high) = (1e-9_f64, 1.0_f64);
        for _ in 0..200 {
            let middle = (low * high).sqrt();
            if Self::curvature_ratio(middle) > ratio {
                low = middle;
            } else {
                high = middle;
            }
        }
        let b_over_a = (low * high).sqrt();
        let m = 1.0 - b_over_a * b_over_a;
        let (k, e) = elliptic::complete(m);
        // K. L. Johnson, Contact Mechanics, section 4.2, for p = p0 √(1 − x²/a² − y²/b²):
        //   across/2 = p0 b/(E' e² a²) (K − E), δ = p0 b K / E', F = 2π a b p0 / 3.
        // With F = 1: a³ = 3 (K − E) / (π E' m across).
        let a = (3.0 * (k - e) / (std::f64::consts::PI * modulus * m * across)).cbrt();
        let approach = 3.0 * k / (2.0 * std::f64::consts::PI * modulus * a);
        let stiffness = approach.powf(-1.5);
        let root = stiffness.powf(2.0 / 3.0);
        Self {
            stiffness,
            half_length: a,
            slope: 3.0 * root / (4.0 * a),
            curvature: 2.0 / (a * a * root),
            half_width: b_over_a * a,
        }
    }

    /// Curvature along over across of an ellipse with the given axis ratio b/a below 1.
    fn curvature_ratio(b_over_a: f64) -> f64 {
        let m = 1.0 - b_over_a * b_over_a;
        if m < 1e-12 {
            return 1.0;
        }
        let (k, e) = elliptic::complete(m);
        (e / (1.0 - m) - k) / (k - e)
    }

    /// Approach \[m\] under a force ≥ 0 \[N\].
    pub fn approach(&self, force: f64) -> f64 {
        (force / self.stiffness).powf(2.0 / 3.0)
    }

    /// Largest pressure \[Pa\] under a force ≥ 0 \[N\], at the zone's centre: p₀ = 3 F / (2π a b), half as much again as
    /// the mean.
    pub fn pressure(&self, force: f64) -> f64 {
        1.5 * force.cbrt() / (std::f64::consts::PI * self.half_length * self.half_width)
    }

    /// Half-length of the zone along the common tangent at an approach δ ≥ 0 \[m\].
    pub fn half_zone(&self, approach: f64) -> f64 {
        (2.0 * approach / self.curvature).sqrt()
    }

    /// Elastic energy per length \[J/m\] at a local penetration ≥ 0 \[m\].
    pub(super) fn energy(&self, depth: f64) -> f64 {
        0.5 * self.slope * depth * depth
    }
}

impl ElasticLaw for Hertz {
    const FLAT: bool = true;

    /// k' p.
    #[inline(always)]
    fn load<T: Number, const FMA: bool>(slope: T, depth: T) -> T {
        depth * slope
    }
}
