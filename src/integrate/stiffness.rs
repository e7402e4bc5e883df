//! The stiffness quotient.

use crate::simd::{InstructionSet, LANES, Task};

/// `h · ‖k1 − k0‖ / ‖y1 − y0‖`, an estimate of `h·|λ|` for the dominant
/// eigenvalue λ, from two states `y` at the same time and their derivatives
/// `k`. Zero if the states agree.
///
/// The norm is Euclidean with the given weights (one over the tolerance scale),
/// so that states of different units mix sensibly.
///
/// Source: Hairer & Wanner, volume II, section IV.2, equation (2.26).
pub(super) fn quotient(h: f64, y: [&[f64]; 2], k: [&[f64]; 2], weights: &[f64]) -> f64 {
    let (num, den) = (distance(k, weights), distance(y, weights));
    if den > 0.0 {
        h * (num / den).sqrt()
    } else {
        0.0
    }
}

/// The weighted sum of squared differences.
fn distance(x: [&[f64]; 2], weights: &[f64]) -> f64 {
    InstructionSet::current().run(Distance { x, weights })
}

struct Distance<'a> {
    x: [&'a [f64]; 2],
    weights: &'a [f64],
}

impl Task for Distance<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<const FMA: bool>(self) -> f64 {
        let term = |x0: f64, x1: f64, w: f64| ((x1 - x0) * w) * ((x1 - x0) * w);
        let (x0, rest0) = self.x[0].as_chunks::<LANES>();
        let (x1, rest1) = self.x[1].as_chunks::<LANES>();
        let (w, rest_w) = self.weights.as_chunks::<LANES>();
        let mut sums = [0.0; LANES];
        for ((x0, x1), w) in x0.iter().zip(x1).zip(w) {
            for lane in 0..LANES {
                sums[lane] += term(x0[lane], x1[lane], w[lane]);
            }
        }
        let mut sum: f64 = sums.iter().sum();
        for ((x0, x1), w) in rest0.iter().zip(rest1).zip(rest_w) {
            sum += term(*x0, *x1, *w);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The quotient is `h|λ|` with `k = λy`, whatever the states and weights.
    #[test]
    fn finds_the_eigenvalue_of_a_linear_system() {
        let y0: Vec<f64> = (0..11).map(|i| f64::from(i).sin()).collect();
        let y1: Vec<f64> = (0..11).map(|i| f64::from(i).cos()).collect();
        let weights: Vec<f64> = (0..11).map(|i| f64::from(i + 1)).collect();
        let slope = |y: &[f64]| -> Vec<f64> { y.iter().map(|y| -300.0 * y).collect() };
        let (k0, k1) = (slope(&y0), slope(&y1));
        let found = quotient(0.01, [&y0, &y1], [&k0, &k1], &weights);
        assert!((found - 3.0).abs() < 1e-13);
        assert_eq!(quotient(0.01, [&y0, &y0], [&k0, &k1], &weights), 0.0);
    }
}
