//! Friction of a film.

use super::conjunction::Conjunction;
use super::oil::Oil;
use crate::simd::{Lanes, Number};

/// Friction −μ F u⃗ / (c + √(u² + c²)) of an element that slides at u⃗, c = v/2.
///
/// ```text
/// p̃ = 0.82 p_0 r,   η(p) = η (1 + α_p p/16)^16                                          (12.5)
/// v_f = Λ [ p̃ h/η(p̃) + ũ h/(0.7 b r) + ũ b r/(2R_x) ]                                 (12.19)
/// v_b = μ_b ũ b r/(2R_x)                                                                 (12.20)
/// φ_a = (1 + h/(8 s_q))^{−16},   μ = φ_a μ_b + (1 − φ_a) Λ,   ψ = φ_a μ_b/μ             (12.21)
/// 1/v = ψ³/v_b + (1 − ψ³)/v_f,   then v ← v + v_0                                        (12.22)
/// ```
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | Λ, μ_b | traction coefficient of the film and friction of asperities, at large slip | 1 |
/// | v_f | slip scale of the film: viscous, elastic shear, creep of the steel, one after the other | m/s |
/// | v_b | slip scale of asperities: F. W. Carter's creep | m/s |
/// | φ_a | share of the load that asperities bear | 1 |
/// | v_0 | least slip scale, numerical | m/s |
///
/// Source: the limit Λ p of S. Bair and W. O. Winer; η(p) in the form of P. S. Y. Chu and A. Cameron; φ_a near R. S. Zhou
/// and M. R. Hoeprich. Without heat: too high above 0.5 to 1 m/s of slip.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct TractionNow<T = f64> {
    /// μ.
    pub friction: T,
    /// ψ³, share of the asperities in the stiffness at small slip.
    boundary_share: T,
    /// v_b/r \[m/s\].
    boundary: T,
    /// Λ p̃ h/(η r), Λ ũ h/(0.7 b) and Λ ũ b/(2R_x): the parts of v_f without r \[m/s\].
    viscous: T,
    shear: T,
    creep: T,
    /// α_p p̃/(16 r).
    piezo: T,
    /// v_0/2 \[m/s\].
    floor: T,
}

/// Mean pressure that traction sees, over the largest.
const PRESSURE_SHARE: f64 = 0.82;

impl TractionNow {
    /// The traction at an entrainment speed ũ \[m/s\] and a film h \[m\].
    pub fn new(oil: &Oil, at: &Conjunction, entrainment: f64, film: f64) -> Self {
        let (limit, boundary) = (oil.limiting_stress, oil.boundary_friction);
        let asperities = asperity_share(film / oil.roughness);
        let friction = asperities * boundary + (1.0 - asperities) * limit;
        let pressure = PRESSURE_SHARE * at.pressure;
        let creep = entrainment * at.half_width / (2.0 * at.radii[0]);
        Self {
            friction,
            // Above 0, so that v at r = 0 is 0 and not 0/0.
            boundary_share: (asperities * boundary / friction).powi(3).max(1e-100),
            boundary: boundary * creep,
            viscous: limit * pressure * film / oil.viscosity,
            shear: limit * entrainment * film / (0.7 * at.half_width),
            creep: limit * creep,
            piezo: oil.pressure_viscosity * pressure / 16.0,
            floor: 0.5 * oil.slip_floor,
        }
    }
}

impl<T: Number> TractionNow<T> {
    /// c = v/2 \[m/s\]. Numerator and denominator of v are taken times r η(p̃)/η, which leaves one division.
    #[inline(always)]
    pub fn bend(&self, r: T) -> T {
        let root = r * self.piezo + 1.0;
        let thickening = fourth(fourth(root));
        let square = r * r;
        let film = square * self.viscous + thickening * (square * self.creep + self.shear);
        let boundary = r * self.boundary;
        let both =
            film * self.boundary_share + boundary * r * thickening * (-self.boundary_share + 1.0);
        boundary * film / both * 0.5 + self.floor
    }
}

impl TractionNow<Lanes> {
    /// Takes the numbers of one contact into a lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, of: &TractionNow) {
        self.friction[lane] = of.friction;
        self.boundary_share[lane] = of.boundary_share;
        self.boundary[lane] = of.boundary;
        self.viscous[lane] = of.viscous;
        self.shear[lane] = of.shear;
        self.creep[lane] = of.creep;
        self.piezo[lane] = of.piezo;
        self.floor[lane] = of.floor;
    }
}

/// φ_a by λ = h/s_q.
fn asperity_share(lambda: f64) -> f64 {
    (1.0 + lambda / 8.0).powi(-16)
}

#[inline(always)]
fn fourth<T: Number>(x: T) -> T {
    let square = x * x;
    square * square
}

#[cfg(test)]
mod tests {
    use super::asperity_share;

    /// Numbers computed from the equation above.
    #[test]
    fn asperities_bear_less_under_thicker_films() {
        for (lambda, share) in [(0.5, 0.38), (1.0, 0.15), (2.0, 0.028), (3.0, 0.006)] {
            let found = asperity_share(lambda);
            assert!((found - share).abs() < 0.03 * share, "{lambda}: {found}");
        }
    }
}
