//! How film and steel resist rolling.

use std::f64::consts::PI;

use super::conjunction::{Conjunction, Groups};
use super::speed::SpeedPowers;
use crate::simd::{Lanes, Number};

/// Rolling resistance of a race of a row, by the rings' speed.
///
/// ```text
/// A = 1.8 β_H^{−1/4} U_s^{3/4} Y,   B = 0.77 β_H^{−1/3} ε^{0.12} U_s^{2/3} X,
/// β_H = (4/π) Ê/(1 + R_x/R_y),   X = w̃^{2/3},   Y = w̃^{3/4}                             (12.23)
/// M = β_H^{1/4} ε W U_s^{−3/4} r³/Y
/// F_hd = 2 a r E'R_x [A + (B − A)/(1 + M/6.6)] · r²/(r² + ζ_h)
///        · φ_S/(1 + 0.29 L_T^0.78 w̃^{3/2})                                               (12.24)
/// φ_S = (S² + 162.8 S)/(S² + 193.1 S + 1257),  S = h_oil/(0.8 h_f);  flooded: 1
/// F_h = (3/32) α_h Q_ref r³ · b r/R_x                                                     (12.25)
/// F_R = (F_hd + F_h) u/ũ                                                                  (12.26)
/// ```
///
/// Source: N. Biboulet, L. Houpert, Proc. IMechE J 224 (2010), parts 1 and 2, from the hydrodynamic to the
/// elastohydrodynamic asymptote; heat of the inlet after S. Aihara 1987; hysteresis after K. L. Johnson. That the film's
/// part ends smoothly, r²/(r² + ζ_h), is this model's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FilmRolling {
    /// 2 a E'R_x \[N\].
    scale: f64,
    /// A/Y and B/X.
    elastic: f64,
    rigid: f64,
    /// M Y/(6.6 r³).
    transition: f64,
    /// 0.29 L_T^0.78.
    heat: f64,
    /// F_h/r⁴ \[N\].
    hysteresis: f64,
}

impl FilmRolling {
    pub fn new(at: &Conjunction, groups: &Groups, hysteresis: f64) -> Self {
        let [along, across] = at.radii;
        let (epsilon, speed) = (at.axis_ratio, groups.sum_speed());
        let beta = 4.0 / PI * at.elliptic / (1.0 + along / across);
        Self {
            scale: 2.0 * at.half_length * at.modulus * along,
            elastic: 1.8 * beta.powf(-0.25) * speed.powf(0.75),
            rigid: 0.77 * beta.powf(-1.0 / 3.0) * epsilon.powf(0.12) * speed.powf(2.0 / 3.0),
            transition: beta.powf(0.25) * epsilon * groups.load * speed.powf(-0.75) / 6.6,
            heat: 0.29 * groups.heat.powf(0.78),
            hysteresis: 3.0 / 32.0 * hysteresis * at.load * at.half_width / along,
        }
    }

    /// The part that depends on the rings' speed: ũ \[m/s\], ζ_h, and S, oil in front of the contact over the film's
    /// minimum; none: flooded.
    pub fn at(
        &self,
        powers: &SpeedPowers,
        entrainment: f64,
        gap: f64,
        supply: Option<f64>,
    ) -> RollingNow {
        let SpeedPowers {
            ratio,
            two_thirds,
            three_quarters,
        } = *powers;
        let heat = 1.0 + self.heat * ratio * ratio.sqrt();
        let scale = self.scale * supply.map_or(1.0, starvation) / (heat * entrainment);
        let transition = self.transition / three_quarters;
        RollingNow {
            rigid: scale * self.rigid * two_thirds,
            elastic: scale * self.elastic * three_quarters * transition,
            transition,
            gap,
            hysteresis: self.hysteresis / entrainment,
        }
    }
}

/// φ_S.
fn starvation(supply: f64) -> f64 {
    // Over S², so that no supply is too large.
    let thin = 1.0 / supply;
    (1.0 + 162.8 * thin) / (1.0 + thin * (193.1 + 1257.0 * thin))
}

/// Rolling resistance by the load measure r.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct RollingNow<T = f64> {
    /// 2 a E'R_x φ_S B/(heat ũ) \[N s/m\].
    rigid: T,
    /// The same with A in place of B, times M/(6.6 r³) \[N s/m\].
    elastic: T,
    /// M/(6.6 r³).
    transition: T,
    /// ζ_h.
    gap: T,
    /// F_h/(r⁴ ũ) \[N s/m\].
    hysteresis: T,
}

impl RollingNow {
    /// No rolling resistance.
    pub const NONE: Self = Self {
        rigid: 0.0,
        elastic: 0.0,
        transition: 0.0,
        gap: 1.0,
        hysteresis: 0.0,
    };
}

impl<T: Number> RollingNow<T> {
    /// F_hd/ũ and F_h/ũ \[N s/m\]: A + (B − A)/(1 + m r³) = (B + A m r³)/(1 + m r³) leaves one division.
    #[inline(always)]
    pub fn parts(&self, r: T) -> [T; 2] {
        let square = r * r;
        let cube = square * r;
        let ends = (cube * self.transition + 1.0) * (square + self.gap);
        let film = cube * (cube * self.elastic + self.rigid) / ends;
        [film, square * square * self.hysteresis]
    }
}

impl RollingNow<Lanes> {
    /// Takes the numbers of one contact into a lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, of: &RollingNow) {
        self.rigid[lane] = of.rigid;
        self.elastic[lane] = of.elastic;
        self.transition[lane] = of.transition;
        self.gap[lane] = of.gap;
        self.hysteresis[lane] = of.hysteresis;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::laws::elastic::{elliptic, hertz::Hertz};

    /// Literature: the elastohydrodynamic asymptote that Biboulet and Houpert print in part 2 for ε = 0.01,
    /// U_s = 1e-11, W = 1e-5: 10.9e-9 E'R_x².
    #[test]
    fn asymptote_is_as_printed() {
        // Of R_x = 1 and E' = 1, and the R_y that makes such an ellipse.
        let epsilon = 0.01_f64;
        let m = 1.0 - epsilon * epsilon;
        let (k, e) = elliptic::complete(m);
        let across = (k - e) / (e / (1.0 - m) - k);
        let hertz = Hertz::of_curvatures(1.0, across, 0.5);
        let load = 1e-5_f64;
        let at = Conjunction {
            radii: [1.0, 1.0 / across],
            half_length: hertz.half_length * load.cbrt(),
            half_width: hertz.half_width * load.cbrt(),
            axis_ratio: epsilon,
            elliptic: e,
            pressure: hertz.pressure(load),
            load,
            modulus: 1.0,
            entrainment: 1.0,
        };
        let groups = Groups {
            speed: 0.5e-11,
            material: 1.0,
            load,
            heat: 0.0,
        };
        let rolling = FilmRolling::new(&at, &groups, 0.0);
        let found = rolling.scale * rolling.elastic;
        assert!((found / 10.97e-9 - 1.0).abs() < 1e-3, "{found:e}");
        assert!((found / 10.9e-9 - 1.0).abs() < 1e-2, "{found:e}");
    }

    /// Limits: enough oil is flooded, none resists nothing.
    #[test]
    fn starvation_goes_from_none_to_one() {
        assert!((starvation(1e9) - 1.0).abs() < 1e-7);
        assert!(starvation(1e-9) < 1e-9);
        assert!(starvation(10.0) < starvation(100.0));
    }
}
