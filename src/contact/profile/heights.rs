//! Heights around a circumference as a table: many waves at the cost of one.

use std::f64::consts::TAU;

use realfft::RealFftPlanner;
use realfft::num_complex::Complex64;

use super::Raise;
use crate::scene::Waviness;
use crate::simd::{LANES, Lanes, Number};

/// The periodic cubic B-spline w(φ) = Σ_k c_k B(Nφ/2π − k) through a sum of waves at N equally spaced knots.
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | N | knots, a power of two | |
/// | c_k | coefficients: of a wave of order n, its values over (2 + cos(2πn/N))/3 | m |
///
/// Height and slope are those of one spline, so forces that follow from them are conservative whatever its error. That is, of the
/// shortest wave's amplitude at N/n = 8, 12, 16, 32: height 1e-3, 2e-4, 6e-5, 4e-6, slope 4e-3, 1e-3, 5e-4, 6e-5 ([*Geometry of a
/// row*](crate::equations#geometry-of-a-row)).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HeightTable {
    /// c_{N−1}, c_0, …, c_{N−1}, c_0, c_1: the four that count anywhere lie side by side.
    coefficients: Vec<f64>,
    /// N/2π.
    per_radian: f64,
}

/// Knots over the highest order, at least.
const FINENESS: usize = 12;

/// Added to a number below 2⁵¹, leaves of it the nearest whole number, in the lowest bits; nothing below 1 has a place beside it.
const WHOLE: f64 = 6_755_399_441_055_744.0;

impl HeightTable {
    /// The table of waves, by the plans of Fourier transforms that a planner keeps.
    pub fn new(waves: &[Waviness], planner: &mut RealFftPlanner<f64>) -> Self {
        let knots = Self::knots_for(waves.iter().map(|wave| wave.order).max().unwrap_or(1));
        let plan = planner.plan_fft_inverse(knots);
        let mut lines = plan.make_input_vec();
        for wave in waves {
            let turn = TAU * f64::from(wave.order) / knots as f64;
            let size = 1.5 * wave.amplitude / (2.0 + turn.cos());
            lines[wave.order as usize] += Complex64::from_polar(size, wave.phase);
        }
        let mut values = plan.make_output_vec();
        let done = plan.process(&mut lines, &mut values);
        done.expect("buffers are of the plan's lengths");
        let (first, second, last) = (values[0], values[1], values[knots - 1]);
        let mut coefficients = Vec::with_capacity(knots + 3);
        coefficients.push(last);
        coefficients.append(&mut values);
        coefficients.extend([first, second]);
        Self {
            coefficients,
            per_radian: knots as f64 / TAU,
        }
    }

    /// N of a table whose highest order is this.
    pub fn knots_for(order: u32) -> usize {
        (FINENESS * order as usize).next_power_of_two()
    }

    /// N.
    fn knots(&self) -> usize {
        self.coefficients.len() - 3
    }

    /// Height and slope \[m\] at an angle \[rad\].
    #[inline(always)]
    pub fn raise(&self, angle: f64) -> Raise<f64> {
        let (at, t) = self.piece(angle);
        cubic::<_, false>(self.around(at), t, self.per_radian)
    }

    /// Raises at eight angles.
    #[inline(always)]
    pub fn raises<const FMA: bool>(&self, angle: Lanes) -> Raise<Lanes> {
        Self::each::<FMA>([self; LANES], angle)
    }

    /// Raises of eight tables of as many knots, each at its angle.
    #[inline(always)]
    pub fn each<const FMA: bool>(tables: [&Self; LANES], angle: Lanes) -> Raise<Lanes> {
        let x = angle * tables[0].per_radian;
        let whole = (x + -0.5) + WHOLE;
        let t = x - (whole - WHOLE);
        let mut c = [Lanes::ZERO; 4];
        for lane in 0..LANES {
            let own = tables[lane].around(whole[lane]);
            for i in 0..4 {
                c[i][lane] = own[i];
            }
        }
        cubic::<_, FMA>(c, t, tables[0].per_radian)
    }

    /// Second derivative by the angle \[m\].
    pub fn bend(&self, angle: f64) -> f64 {
        let (at, t) = self.piece(angle);
        let [a, b, c, d] = self.around(at);
        let (low, high) = (a - 2.0 * b + c, b - 2.0 * c + d);
        (low + (high - low) * t) * self.per_radian * self.per_radian
    }

    /// The piece at an angle, as [`Self::around`] takes it, and how far on it \[0, 1\].
    #[inline(always)]
    fn piece(&self, angle: f64) -> (f64, f64) {
        let x = angle * self.per_radian;
        let whole = (x + -0.5) + WHOLE;
        (whole, x - (whole - WHOLE))
    }

    /// The coefficients that count on a piece, whose number stands in the lowest bits.
    #[inline(always)]
    fn around(&self, piece: f64) -> [f64; 4] {
        // Knots are far fewer than a word counts.
        #[allow(clippy::cast_possible_truncation)]
        let at = piece.to_bits() as usize & (self.knots() - 1);
        let of = &self.coefficients[at..at + 4];
        [of[0], of[1], of[2], of[3]]
    }
}

/// The spline between its second and third coefficient.
#[inline(always)]
fn cubic<T: Number, const FMA: bool>([a, b, c, d]: [T; 4], t: T, per_radian: f64) -> Raise<T> {
    let linear = (c - a) * 0.5;
    let square = (a + c) * 0.5 - b;
    let cube = ((d - a) + (b - c) * 3.0) * (1.0 / 6.0);
    let start = ((a + c) - b * 2.0) * (1.0 / 6.0) + b;
    let height = cube
        .mul_add::<FMA>(t, square)
        .mul_add::<FMA>(t, linear)
        .mul_add::<FMA>(t, start);
    let slope = (cube * 3.0)
        .mul_add::<FMA>(t, square * 2.0)
        .mul_add::<FMA>(t, linear);
    Raise {
        height,
        slope: slope * per_radian,
    }
}
