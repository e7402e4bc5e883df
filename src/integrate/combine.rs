//! The one inner loop: a base plus a weighted sum of stages.

use std::array::from_fn;

use crate::simd::{Level, Simd, Vector, Wide};

/// Most nonzero weights a row may have; one arm of the match below for each.
const MAX_TERMS: usize = 8;

type Term<'a> = (f64, &'a [f64]);

/// Writes `out[i] = base[i] + h Σⱼ weights[j] · k[j][i]` in a single pass.
///
/// Without a base, zero stands in for it. Zero weights cost nothing. The sum is
/// formed before the base is added, so that a step rounds the state only once.
///
/// # Panics
/// With more than eight nonzero weights, or with vectors shorter than `out`.
pub(super) fn combine(
    out: &mut [f64],
    base: Option<&[f64]>,
    h: f64,
    weights: &[f64],
    k: &[Vec<f64>],
) {
    Level::current().run_wide(Combination {
        out,
        base,
        h,
        weights,
        k,
    });
}

struct Combination<'a> {
    out: &'a mut [f64],
    base: Option<&'a [f64]>,
    h: f64,
    weights: &'a [f64],
    k: &'a [Vec<f64>],
}

impl Wide for Combination<'_> {
    type Output = ();

    // Compiled for the level that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut terms: [Term; MAX_TERMS] = [(0.0, &[]); MAX_TERMS];
        let mut count = 0;
        for (&weight, k) in self.weights.iter().zip(self.k) {
            if weight != 0.0 {
                terms[count] = (weight, k);
                count += 1;
            }
        }
        match count {
            0 => self.fused::<0, S>(simd, &terms),
            1 => self.fused::<1, S>(simd, &terms),
            2 => self.fused::<2, S>(simd, &terms),
            3 => self.fused::<3, S>(simd, &terms),
            4 => self.fused::<4, S>(simd, &terms),
            5 => self.fused::<5, S>(simd, &terms),
            6 => self.fused::<6, S>(simd, &terms),
            7 => self.fused::<7, S>(simd, &terms),
            _ => self.fused::<8, S>(simd, &terms),
        }
    }
}

impl Combination<'_> {
    /// The loop with the number of terms known, so that it is unrolled over the terms.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn fused<const N: usize, S: Simd>(self, simd: S, terms: &[Term; MAX_TERMS]) {
        let len = self.out.len();
        let k: [&[f64]; N] = from_fn(|j| &terms[j].1[..len]);
        let base = self.base.map(|base| &base[..len]);
        let lanes = Vector::<S>::LANES;
        let whole = len / lanes;
        let zero = Vector::all(simd, 0.0);
        let h = Vector::all(simd, self.h);
        let weights: [Vector<S>; N] = from_fn(|j| Vector::all(simd, terms[j].0));
        let registers: [&[S::f64s]; N] = from_fn(|j| Vector::<S>::registers(k[j], whole));
        let out = Vector::<S>::registers_mut(self.out, whole);
        let bases = base.map(|base| Vector::<S>::registers(base, whole));
        for i in 0..whole {
            let mut sum = zero;
            for j in 0..N {
                sum = weights[j].mul_add(Vector::of(simd, registers[j][i]), sum);
            }
            let base = match bases {
                Some(bases) => Vector::of(simd, bases[i]),
                None => zero,
            };
            h.mul_add(sum, base).put(&mut out[i]);
        }
        for i in whole * lanes..len {
            let mut sum = zero;
            for j in 0..N {
                sum = weights[j].mul_add(Vector::all(simd, k[j][i]), sum);
            }
            let base = base.map_or(0.0, |base| base[i]);
            self.out[i] = h.mul_add(sum, Vector::all(simd, base)).first();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Small integers are summed exactly, so the truth is integer arithmetic.
    #[test]
    fn every_count_of_terms_gives_the_written_sum() {
        let k: Vec<Vec<f64>> = (0..9)
            .map(|j| (0..5).map(|i| f64::from(10 * j + i)).collect())
            .collect();
        let base = [1.0, 2.0, 3.0, 4.0, 5.0];
        for count in 0..=MAX_TERMS {
            // A zero in second place shifts the terms and must be skipped.
            let mut weights = vec![1.0, 0.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
            weights.truncate(if count < 2 { count } else { count + 1 });
            for base in [None, Some(&base[..])] {
                let mut out = [f64::NAN; 5];
                combine(&mut out, base, 2.0, &weights, &k);
                for (i, out) in out.iter().enumerate() {
                    let sum: f64 = weights.iter().zip(&k).map(|(w, k)| w * k[i]).sum();
                    assert_eq!(*out, base.map_or(0.0, |b| b[i]) + 2.0 * sum);
                }
            }
        }
    }
}
