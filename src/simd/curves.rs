//! Logarithm and arctangent by products and quotients: a library call for each number would spill all registers.

use std::f64::consts::{LN_2, SQRT_2};

use super::Number;

/// 2 artanh(t)/t by powers of t², |t| ≤ (√2 − 1)/(√2 + 1): interpolated at Chebyshev's points, to 1.5e-12.
const ARTANH: [f64; 5] = [
    2.000_000_000_008_4,
    0.666_666_652_474_7,
    0.400_003_846_746_8,
    0.285_350_509_137_3,
    0.236_163_612_027_7,
];

/// arctan(√v)/√v by powers of v, 0 ≤ v ≤ 1: likewise, to 3e-9.
const ARCTAN: [f64; 10] = [
    0.999_999_997_161,
    -0.333_332_762_920,
    0.199_980_752_811,
    -0.142_600_160_827,
    0.109_323_415_010,
    -0.083_497_249_674,
    0.057_089_555_914,
    -0.030_351_864_770,
    0.010_487_649_246,
    -0.001_701_170_062,
];

/// ln x of normal x > 0, to 1e-12.
#[inline(always)]
pub(crate) fn ln<T: Number, const FMA: bool>(x: T) -> T {
    let (exponent, mantissa) = x.exponent_and_mantissa();
    let t = (mantissa + -SQRT_2) / (mantissa + SQRT_2);
    let sum = polynomial::<T, FMA>(&ARTANH, t * t);
    (exponent + 0.5) * LN_2 + sum * t
}

/// arctan(z)/z of z = √square, to 3e-9: by the angle's half, whose tangent is z/(1 + √(1 + z²)).
#[inline(always)]
pub(crate) fn arctan_over<T: Number, const FMA: bool>(square: T) -> T {
    let one = square.same(1.0);
    let over = one / ((one + square).sqrt() + one);
    polynomial::<T, FMA>(&ARCTAN, square * over * over) * over * 2.0
}

#[inline(always)]
fn polynomial<T: Number, const FMA: bool>(powers: &[f64], x: T) -> T {
    // Even and odd powers beside each other, so that none waits for all above it.
    let square = x * x;
    let mut sums = [x.same(0.0); 2];
    for (k, power) in powers.iter().enumerate().rev() {
        sums[k % 2] = sums[k % 2].mul_add::<FMA>(square, x.same(*power));
    }
    sums[1].mul_add::<FMA>(x, sums[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Analytic: the library's functions, over all sizes that occur and far beyond.
    #[test]
    fn are_the_functions() {
        for k in 0..100_000 {
            let x = 10_f64.powf(f64::from(k) / 100_000.0 * 60.0 - 30.0);
            for found in [ln::<_, true>(x), ln::<_, false>(x)] {
                let error = (found - x.ln()).abs();
                assert!(error < 2e-12 * x.ln().abs().max(1.0), "ln {x}: {error:e}");
            }
            let wanted = x.atan() / x;
            for found in [
                arctan_over::<_, true>(x * x),
                arctan_over::<_, false>(x * x),
            ] {
                let error = (found / wanted - 1.0).abs();
                assert!(error < 4e-9, "arctan {x}: {error:e}");
            }
        }
        assert_eq!(arctan_over::<_, false>(0.0), ARCTAN[0]);
        assert!(ln::<_, false>(f64::NAN).is_nan());
    }
}
