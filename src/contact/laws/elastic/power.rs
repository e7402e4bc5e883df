//! x^{10/9} without a logarithm.

use crate::simd::mul_add;

/// Bits of 2^52 as a double: an integer below it stands in the mantissa as it is.
const INTEGER: f64 = (1u64 << 52) as f64;
/// Upper half of the bits of a guess for x^{−1/9} is this less a ninth of the upper half of x's: the exponent
/// and, linearly between powers of two, the mantissa. 10/9 of 1's own bits, lowered so that x y⁹ strays as far
/// above 1 as below: by 0.26.
const GUESS: f64 = 1_191_820_000.0;

/// x^{10/9} to about 2 units in the last place, for 0 and 1e-200 … 1e200.
///
/// y ≈ x^{−1/9} from the bits; with e = 1 − x y⁹, first y ← y (1 − e)^{−1/9}, then x^{10/9} = x² y⁸ (1 − e)^{−8/9},
/// both by four terms of their series. A NaN stays one.
#[inline(always)]
pub(in crate::contact) fn ten_ninths<const FMA: bool>(x: f64) -> f64 {
    let upper = f64::from_bits((x.to_bits() >> 32) | INTEGER.to_bits()) - INTEGER;
    let guess = mul_add::<FMA>(upper, -1.0 / 9.0, INTEGER + GUESS);
    let y = f64::from_bits(guess.to_bits() << 32);
    let (_, e) = remainder::<FMA>(x, y);
    let y = mul_add::<FMA>(y * e, series::<FMA>(&NINTH, e), y);
    let (eighth, e) = remainder::<FMA>(x, y);
    let power = x * x * eighth;
    mul_add::<FMA>(power * e, series::<FMA>(&EIGHT_NINTHS, e), power)
}

/// Coefficients of e, e², e³, e⁴ in (1 − e)^{−1/9} and in (1 − e)^{−8/9}.
const NINTH: [f64; 4] = binomial(1.0 / 9.0);
const EIGHT_NINTHS: [f64; 4] = binomial(8.0 / 9.0);

const fn binomial(exponent: f64) -> [f64; 4] {
    let first = exponent;
    let second = first * (exponent + 1.0) / 2.0;
    let third = second * (exponent + 2.0) / 3.0;
    [first, second, third, third * (exponent + 3.0) / 4.0]
}

/// y⁸ and 1 − x y⁹.
#[inline(always)]
fn remainder<const FMA: bool>(x: f64, y: f64) -> (f64, f64) {
    let square = y * y;
    let fourth = square * square;
    let eighth = fourth * fourth;
    (eighth, mul_add::<FMA>(-(x * y), eighth, 1.0))
}

/// c₁ + c₂ e + c₃ e² + c₄ e³, as two short chains that run side by side.
#[inline(always)]
fn series<const FMA: bool>(c: &[f64; 4], e: f64) -> f64 {
    let low = mul_add::<FMA>(e, c[1], c[0]);
    let high = mul_add::<FMA>(e, c[3], c[2]);
    mul_add::<FMA>(e * e, high, low)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Analytic: the ninth power of x^{1/9} is x, over all penetrations that occur and far beyond. (The library's
    /// `powf` takes a rounded 10/9, which costs it up to 27 units of these.)
    #[test]
    fn is_the_root_of_a_power() {
        let mut worst = [0.0_f64; 2];
        for k in 0..200_000 {
            let x = 10_f64.powf(f64::from(k) / 200_000.0 * 30.0 - 25.0);
            for (worst, power) in worst
                .iter_mut()
                .zip([ten_ninths::<true>(x), ten_ninths::<false>(x)])
            {
                let error = ((power / x).powi(9) / x - 1.0) / 9.0;
                *worst = worst.max(error.abs() / f64::EPSILON);
            }
        }
        println!("units in the last place, fused and not: {worst:.1?}");
        assert!(worst.iter().all(|w| *w < 4.0), "{worst:?}");
        assert_eq!(ten_ninths::<false>(0.0), 0.0);
        assert!(ten_ninths::<false>(f64::NAN).is_nan());
    }
}
