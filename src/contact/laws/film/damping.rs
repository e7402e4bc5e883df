//! How a film damps the approach.

use std::f64::consts::TAU;

use super::conjunction::{Conjunction, Groups};
use crate::simd::{Lanes, Number};

/// Damping of a film at the reference load and speed, in the form of Hunt and Crossley: F = F_el (1 + 3/2 α_f v_n).
///
/// ```text
/// α_f = (2/3)(c_ref/Q_ref) X^{−1/2} / (r² + ζ_h)²                                       (12.15)
/// c_ref = C (Q_ref/δ_ref)(b/u_ref),   C = (0.98 − L/60) N^{−0.83 − 0.008 L}             (12.16)
/// U_s = 2U,  L = G U_s^{1/4},  N = √(R_x/R_y) W U_s^{−3/4}
/// c_ref + c_0/(1 + 1.4 (2π f_d b/u_ref)²),
/// c_0 = 0.46 h₁ b (1.5 Q_ref/δ_ref)²/(Q_ref u_ref),  h₁ = h at w = 1                    (12.17)
/// ```
///
/// Source: Y. H. Wijnant 1998; Y. H. Wijnant, J. A. Wensing, G. C. van Nijen, J. Sound Vib. 222 (1999) 579, for L from 2
/// to 20; that it ends at separation, and the slow part c_0, are this model's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FilmDamping {
    /// c_ref \[N s/m\], with the slow part where a frequency asks for it.
    pub coefficient: f64,
}

impl FilmDamping {
    /// The damping of a conjunction with approach δ_ref \[m\], a film of h₁ \[m\] and f_d \[Hz\].
    pub fn new(
        at: &Conjunction,
        groups: &Groups,
        approach: f64,
        film: f64,
        frequency: Option<f64>,
    ) -> Self {
        let (load, width, speed) = (at.load, at.half_width, at.entrainment);
        let fast = wijnant(at, groups) * (load / approach) * (width / speed);
        let slow = 0.46 * film * width * (1.5 * load / approach).powi(2) / (load * speed);
        let share = frequency.map_or(0.0, |frequency| {
            1.0 / (1.0 + 1.4 * (TAU * frequency * width / speed).powi(2))
        });
        Self {
            coefficient: fast + slow * share,
        }
    }

    /// The part that depends on the rings' speed, by w̃ and ζ_h.
    pub fn at(self, load: f64, speed_ratio: f64, gap: f64) -> DampingNow {
        DampingNow {
            // X^{−1/2} = w̃^{−1/3}.
            rate: self.coefficient / (load * speed_ratio.cbrt()),
            gap,
        }
    }
}

/// C of (12.16).
fn wijnant(at: &Conjunction, groups: &Groups) -> f64 {
    let moes = groups.moes();
    let [along, across] = at.radii;
    let load = (along / across).sqrt() * groups.load * groups.sum_speed().powf(-0.75);
    (0.98 - moes / 60.0) * load.powf(-0.83 - 0.008 * moes)
}

/// Damping by the load measure r.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct DampingNow<T = f64> {
    /// 3/2 α_f (r² + ζ_h)² \[s/m\].
    rate: T,
    /// ζ_h.
    gap: T,
}

impl DampingNow {
    /// No damping.
    pub const NONE: Self = Self {
        rate: 0.0,
        gap: 1.0,
    };
}

impl<T: Number> DampingNow<T> {
    /// 3/2 α_f \[s/m\].
    #[inline(always)]
    pub fn rate(&self, r: T) -> T {
        let approach = r * r + self.gap;
        self.rate / (approach * approach)
    }
}

impl DampingNow<Lanes> {
    /// Takes the numbers of one contact into a lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, of: &DampingNow) {
        self.rate[lane] = of.rate;
        self.gap[lane] = of.gap;
    }
}
