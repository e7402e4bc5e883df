//! The inner loops: a base plus a weighted sum of stages, and other combinations of several vectors in one pass.

use std::ops::Range;

use crate::simd::{InstructionSet, Simd, Vector, Wide};

/// Most nonzero weights a row may have; one arm of the match below for each.
pub(super) const MAX_TERMS: usize = 8;

/// Writes `out[i] = base[i] + h Σⱼ weights[j] · k[j][i]` in a single pass.
///
/// Without a base, zero stands in for it. Zero weights cost nothing. The sum is
/// formed before the base is added, so that a step rounds the state only once.
///
/// # Panics
/// With more than eight nonzero weights, or with vectors shorter than `out`.
pub(super) fn combine<K: AsRef<[f64]>>(
    out: &mut [f64],
    base: Option<&[f64]>,
    h: f64,
    weights: &[f64],
    k: &[K],
) {
    InstructionSet::current().run_wide(Combination {
        out,
        base,
        h,
        weights,
        k,
    });
}

struct Combination<'a, K> {
    out: &'a mut [f64],
    base: Option<&'a [f64]>,
    h: f64,
    weights: &'a [f64],
    k: &'a [K],
}

impl<K: AsRef<[f64]>> Wide for Combination<'_, K> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut weights = [0.0; MAX_TERMS];
        let mut stages = [0; MAX_TERMS];
        let mut count = 0;
        for (stage, &weight) in self.weights[..self.weights.len().min(self.k.len())]
            .iter()
            .enumerate()
        {
            if weight != 0.0 {
                (weights[count], stages[count]) = (weight, stage);
                count += 1;
            }
        }
        let Self {
            out, base, h, k, ..
        } = self;
        let fused = FusedPass {
            out,
            h,
            weights: &weights,
            stages: &stages,
            k,
        };
        match base {
            Some(base) => fused.onto::<S, true>(simd, base, count),
            None => fused.onto::<S, false>(simd, &[], count),
        }
    }
}

/// The same with the zeros gone.
struct FusedPass<'a, K> {
    out: &'a mut [f64],
    h: f64,
    weights: &'a [f64; MAX_TERMS],
    stages: &'a [usize; MAX_TERMS],
    k: &'a [K],
}

impl<K: AsRef<[f64]>> FusedPass<'_, K> {
    #[inline(always)]
    fn onto<S: Simd, const BASE: bool>(self, simd: S, base: &[f64], terms: usize) {
        match terms {
            0 => self.sum::<0, BASE, S>(simd, base),
            1 => self.sum::<1, BASE, S>(simd, base),
            2 => self.sum::<2, BASE, S>(simd, base),
            3 => self.sum::<3, BASE, S>(simd, base),
            4 => self.sum::<4, BASE, S>(simd, base),
            5 => self.sum::<5, BASE, S>(simd, base),
            6 => self.sum::<6, BASE, S>(simd, base),
            7 => self.sum::<7, BASE, S>(simd, base),
            _ => self.sum::<8, BASE, S>(simd, base),
        }
    }

    /// The loop with the number of terms known, so that it is unrolled over the terms.
    #[inline(always)]
    fn sum<const N: usize, const BASE: bool, S: Simd>(self, simd: S, base: &[f64]) {
        let len = self.out.len();
        let whole = len / Vector::<S>::LANES;
        let zero = Vector::all(simd, 0.0);
        let h = Vector::all(simd, self.h);
        let mut weights = [zero; N];
        let mut registers: [&[S::f64s]; N] = [&[]; N];
        for j in 0..N {
            weights[j] = Vector::all(simd, self.weights[j]);
            registers[j] = Vector::<S>::registers(self.k[self.stages[j]].as_ref(), whole);
        }
        let bases = Vector::<S>::registers(base, if BASE { whole } else { 0 });
        let out = Vector::<S>::registers_mut(self.out, whole);
        for i in 0..whole {
            let mut sum = zero;
            for (weight, of) in weights.iter().zip(&registers) {
                sum = weight.mul_add(Vector::of(simd, of[i]), sum);
            }
            let base = if BASE {
                Vector::of(simd, bases[i])
            } else {
                zero
            };
            h.mul_add(sum, base).put(&mut out[i]);
        }
        for i in whole * Vector::<S>::LANES..len {
            let mut sum = zero;
            for (weight, stage) in weights.iter().zip(self.stages) {
                sum = weight.mul_add(Vector::all(simd, self.k[*stage].as_ref()[i]), sum);
            }
            let base = if BASE { base[i] } else { 0.0 };
            self.out[i] = h.mul_add(sum, Vector::all(simd, base)).first();
        }
    }
}

/// Operation on the numbers of several vectors at each place.
pub(super) trait Each<const IN: usize, const OUT: usize> {
    /// The new number at a place, from what stands there and further numbers. Wants `#[inline(always)]`.
    fn of<S: Simd>(&self, there: [Vector<S>; OUT], from: [Vector<S>; IN]) -> [Vector<S>; OUT];
}

/// Applies an operation at every place of vectors as long as the first.
///
/// # Panics
/// With vectors shorter than that.
pub(super) fn pass<E: Each<IN, OUT>, const IN: usize, const OUT: usize>(
    each: &E,
    to: [&mut [f64]; OUT],
    from: [&[f64]; IN],
) {
    InstructionSet::current().run_wide(OnePass { each, to, from });
}

struct OnePass<'a, E, const IN: usize, const OUT: usize> {
    each: &'a E,
    to: [&'a mut [f64]; OUT],
    from: [&'a [f64]; IN],
}

impl<E: Each<IN, OUT>, const IN: usize, const OUT: usize> Wide for OnePass<'_, E, IN, OUT> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let len = self.to[0].len();
        let whole = len / Vector::<S>::LANES;
        self.registers(simd, whole);
        self.numbers(simd, whole * Vector::<S>::LANES..len);
    }
}

// Loops, not closures: those would be calls, compiled for the baseline.
#[allow(clippy::needless_range_loop)]
impl<E: Each<IN, OUT>, const IN: usize, const OUT: usize> OnePass<'_, E, IN, OUT> {
    #[inline(always)]
    fn registers<S: Simd>(&mut self, simd: S, count: usize) {
        let zero = Vector::all(simd, 0.0);
        let (mut there, mut from) = ([zero; OUT], [zero; IN]);
        let mut sources: [&[S::f64s]; IN] = [&[]; IN];
        for j in 0..IN {
            sources[j] = Vector::<S>::registers(self.from[j], count);
        }
        for i in 0..count {
            for j in 0..OUT {
                there[j] = Vector::of(simd, Vector::<S>::registers(self.to[j], count)[i]);
            }
            for j in 0..IN {
                from[j] = Vector::of(simd, sources[j][i]);
            }
            let found = self.each.of(there, from);
            for j in 0..OUT {
                found[j].put(&mut Vector::<S>::registers_mut(self.to[j], count)[i]);
            }
        }
    }

    #[inline(always)]
    fn numbers<S: Simd>(&mut self, simd: S, at: Range<usize>) {
        let zero = Vector::all(simd, 0.0);
        let (mut there, mut from) = ([zero; OUT], [zero; IN]);
        for i in at {
            for j in 0..OUT {
                there[j] = Vector::all(simd, self.to[j][i]);
            }
            for j in 0..IN {
                from[j] = Vector::all(simd, self.from[j][i]);
            }
            let found = self.each.of(there, from);
            for j in 0..OUT {
                self.to[j][i] = found[j].first();
            }
        }
    }
}

/// Positions and velocities.
pub(super) fn halves(state: &mut [f64]) -> [&mut [f64]; 2] {
    state.split_at_mut(state.len() / 2).into()
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
