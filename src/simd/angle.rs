//! The direction of a point in the plane, by products and one quotient: a library call for each number would spill all registers.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use super::Lanes;

/// arctan(t) = t + t³ P(t²)/Q(t²), |t| ≤ 0.66, to 2e-16: S. L. Moshier, *Cephes*, `atan.c`; Q's highest power has the coefficient 1.
const P: [f64; 5] = [
    -6.485_021_904_942_025e1,
    -1.228_866_684_490_136_2e2,
    -7.500_855_792_314_705e1,
    -1.615_753_718_733_365_2e1,
    -8.750_608_600_031_904e-1,
];
const Q: [f64; 6] = [
    1.945_506_571_482_614e2,
    4.853_903_996_359_137e2,
    4.328_810_604_912_903e2,
    1.650_270_098_316_988_5e2,
    2.485_846_490_142_306_3e1,
    1.0,
];

/// Smaller over larger coordinate from which the difference from 45 degrees is taken instead.
const STEEP: f64 = 0.66;

/// Angles of eight points from the x axis \[rad\], −π to π, to rounding.
#[inline(always)]
pub(crate) fn direction<const FMA: bool>(x: Lanes, y: Lanes) -> Lanes {
    let (across, up) = (x.abs(), y.abs());
    let is_high = up.above(across);
    let (small, large) = (is_high.choose(across, up), is_high.choose(up, across));
    let is_steep = small.above(large * STEEP);
    let t = is_steep.choose(small - large, small) / is_steep.choose(small + large, large);
    let square = t * t;
    let over = polynomial::<FMA>(&P, square) / polynomial::<FMA>(&Q, square);
    let from = (t * square).mul_add::<FMA>(over, t);
    let angle = is_steep.choose(from + FRAC_PI_4, from);
    let angle = is_high.choose(-angle + FRAC_PI_2, angle);
    let angle = Lanes::ZERO.above(x).choose(-angle + PI, angle);
    Lanes::ZERO.above(y).choose(-angle, angle)
}

#[inline(always)]
fn polynomial<const FMA: bool>(powers: &[f64], x: Lanes) -> Lanes {
    let mut sum = Lanes::ZERO;
    for power in powers.iter().rev() {
        sum = sum.mul_add::<FMA>(x, Lanes::all(*power));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Analytic: the library's function, all the way round and on the axes.
    #[test]
    fn is_that_of_the_library() {
        for k in 0..80_000 {
            let angle = f64::from(k) / 80_000.0 * std::f64::consts::TAU;
            let radius = 10_f64.powf(f64::from(k % 13) - 6.0);
            let (x, y) = (radius * angle.cos(), radius * angle.sin());
            let all = [Lanes::all(x), Lanes::all(y)];
            for found in [
                direction::<true>(all[0], all[1])[3],
                direction::<false>(all[0], all[1])[5],
            ] {
                let error = (found - y.atan2(x)).abs();
                assert!(error < 1e-15, "{x}, {y}: {error:e}");
            }
        }
        for (x, y) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] {
            let found = direction::<false>(Lanes::all(x), Lanes::all(y))[0];
            assert_eq!(found.to_bits(), f64::atan2(y, x).to_bits());
        }
    }
}
