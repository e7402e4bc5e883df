//! Tolerances, and the norm that weighs an error against them.

use std::ops::Range;

use super::failure::Invalid;
use crate::simd::{InstructionSet, Simd, Vector, Wide};

/// Tolerance of each state: which error is acceptable, and which states belong together.
///
/// The scale of state `i` is `atol[i]`, plus `rtol · max(|y0|, |y1|)` if the
/// state is relative. The norm is the largest, over the groups, of the group's
/// root mean square of scaled errors: a mean over all states would drown the
/// impact of one body in the calm of the others.
#[derive(Debug, Clone, PartialEq)]
pub struct Tolerance {
    atol: Vec<f64>,
    /// Relative tolerance by state; 0 where only the absolute one counts.
    rtol: Vec<f64>,
    group: Vec<usize>,
    /// Inverse of the number of states of each group; 0 for an empty one.
    share: Vec<f64>,
}

impl Tolerance {
    /// Tolerances for `atol.len()` states.
    ///
    /// `atol` is in the states' own units; `relative` says whether `rtol` counts
    /// for a state too (an angle that only grows must not be relative); `group`
    /// numbers the bodies from 0 in any order.
    ///
    /// # Errors
    /// [`Invalid`] if the lengths differ or are zero, if an `atol` is not
    /// positive and finite, or if `rtol` is negative or not finite.
    pub fn new(
        rtol: f64,
        atol: Vec<f64>,
        relative: &[bool],
        group: Vec<usize>,
    ) -> Result<Self, Invalid> {
        if atol.is_empty() || relative.len() != atol.len() || group.len() != atol.len() {
            return Err(Invalid("tolerances need one entry per state"));
        }
        if !atol.iter().all(|&a| a > 0.0 && a.is_finite()) {
            return Err(Invalid("absolute tolerances must be positive and finite"));
        }
        if !(rtol >= 0.0 && rtol.is_finite()) {
            return Err(Invalid(
                "the relative tolerance must be finite and not negative",
            ));
        }
        let mut size = vec![0.0; group.iter().max().map_or(0, |most| most + 1)];
        for &group in &group {
            size[group] += 1.0;
        }
        Ok(Self {
            rtol: relative
                .iter()
                .map(|&r| if r { rtol } else { 0.0 })
                .collect(),
            share: size
                .iter()
                .map(|&n| if n > 0.0 { 1.0 / n } else { 0.0 })
                .collect(),
            atol,
            group,
        })
    }

    /// The same tolerance for `dim` relative states, all in one group.
    ///
    /// # Errors
    /// As [`Tolerance::new`].
    pub fn uniform(dim: usize, rtol: f64, atol: f64) -> Result<Self, Invalid> {
        Self::new(rtol, vec![atol; dim], &vec![true; dim], vec![0; dim])
    }

    /// Number of states.
    #[must_use]
    pub fn dim(&self) -> usize {
        self.atol.len()
    }

    /// The group of a state.
    ///
    /// # Panics
    /// If there is no such state.
    #[must_use]
    pub fn group_of(&self, state: usize) -> usize {
        self.group[state]
    }
}

/// A norm and the group that set it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Worst {
    /// The norm; infinite if anything measured was not finite.
    pub(super) value: f64,
    /// The group with the largest, or the first non-finite, contribution.
    pub(super) group: usize,
}

/// A tolerance with the memory to measure by it.
#[derive(Debug)]
pub(super) struct Norm<'a> {
    tolerance: &'a Tolerance,
    weight: Vec<f64>,
    square: Vec<f64>,
    sum: Vec<f64>,
    /// Groups of the states as far as each belongs to the one after that of its neighbour.
    stretches: Vec<Range<usize>>,
}

impl<'a> Norm<'a> {
    pub(super) fn new(tolerance: &'a Tolerance) -> Self {
        let mut stretches: Vec<Range<usize>> = Vec::new();
        for &group in &tolerance.group {
            match stretches.last_mut() {
                Some(last) if last.end == group => last.end += 1,
                _ => stretches.push(group..group + 1),
            }
        }
        Self {
            stretches,
            tolerance,
            weight: vec![0.0; tolerance.dim()],
            square: vec![0.0; tolerance.dim()],
            sum: vec![0.0; tolerance.share.len()],
        }
    }

    /// The norm of `x`, scaled for a step from `y0` to `y1`.
    ///
    /// A non-finite `y1` counts as a non-finite `x`: it would otherwise make
    /// the scale infinite and the error vanish.
    pub(super) fn measure(&mut self, y0: &[f64], y1: &[f64], x: &[f64]) -> Worst {
        InstructionSet::current().run_wide(Scaling {
            norm: self,
            y0,
            y1,
            x,
        });
        self.add_up();
        let mut worst = Worst {
            value: 0.0,
            group: 0,
        };
        for (group, (sum, share)) in self.sum.iter().zip(&self.tolerance.share).enumerate() {
            let mean = sum * share;
            if !mean.is_finite() {
                return Worst {
                    value: f64::INFINITY,
                    group,
                };
            }
            if mean > worst.value {
                worst = Worst { value: mean, group };
            }
        }
        worst.value = worst.value.sqrt();
        worst
    }

    /// Sums the squares by group.
    fn add_up(&mut self) {
        self.sum.fill(0.0);
        let mut squares = &self.square[..];
        for groups in &self.stretches {
            let (here, rest) = squares.split_at(groups.len());
            for (sum, square) in self.sum[groups.clone()].iter_mut().zip(here) {
                *sum += square;
            }
            squares = rest;
        }
    }

    /// Inverse of the scale of each state, as of the last measurement.
    pub(super) fn weights(&self) -> &[f64] {
        &self.weight
    }
}

/// Weights and scaled squares of every state.
struct Scaling<'n, 'a> {
    norm: &'n mut Norm<'a>,
    y0: &'n [f64],
    y1: &'n [f64],
    x: &'n [f64],
}

impl Wide for Scaling<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Norm {
            tolerance,
            weight,
            square,
            ..
        } = self.norm;
        let (n, lanes) = (weight.len(), Vector::<S>::LANES);
        let whole = n / lanes;
        let of = |of| Vector::<S>::registers(of, whole);
        let (atol, rtol) = (of(&tolerance.atol), of(&tolerance.rtol));
        let [y0, y1, x] = [self.y0, self.y1, self.x].map(of);
        let weights = Vector::<S>::registers_mut(weight, whole);
        let squares = Vector::<S>::registers_mut(square, whole);
        for i in 0..whole {
            let [atol, rtol, y0, y1, x] =
                [atol[i], rtol[i], y0[i], y1[i], x[i]].map(|of| Vector::of(simd, of));
            let (weight, square) = scaled([atol, rtol], [y0, y1, x]);
            weight.put(&mut weights[i]);
            square.put(&mut squares[i]);
        }
        for i in whole * lanes..n {
            let tolerances = [tolerance.atol[i], tolerance.rtol[i]];
            let states = [self.y0[i], self.y1[i], self.x[i]];
            let found = scaled(
                tolerances.map(|of| Vector::all(simd, of)),
                states.map(|of| Vector::all(simd, of)),
            );
            (weight[i], square[i]) = (found.0.first(), found.1.first());
        }
    }
}

/// Weight and scaled square of an error `x` between two states.
#[inline(always)]
fn scaled<S: Simd>(
    [atol, rtol]: [Vector<S>; 2],
    [y0, y1, x]: [Vector<S>; 3],
) -> (Vector<S>, Vector<S>) {
    let size = y0.abs().or_more(y1.abs());
    let weight = y0.same(1.0) / rtol.mul_add(size, atol);
    let scaled = x * weight;
    // What is not finite in y1 makes the scale infinite, and must show.
    (weight, scaled.mul_add(scaled, y1 * y1.same(0.0)))
}

/// The truth is the definition, worked by hand on small numbers.
#[cfg(test)]
mod tests {
    use super::*;

    fn two_bodies() -> Tolerance {
        let relative = [true, false, true, true];
        Tolerance::new(0.1, vec![1.0, 2.0, 1.0, 1.0], &relative, vec![0, 1, 1, 0]).unwrap()
    }

    #[test]
    fn largest_group_mean_square_wins() {
        let tolerance = two_bodies();
        let mut norm = Norm::new(&tolerance);
        // Scales: 1 + 0.1·10 = 2, 2 (absolute), 1 + 0.1·30 = 4, 1.
        let (y0, y1) = ([-10.0, 1e9, 0.0, 0.0], [5.0, 1e9, -30.0, 0.0]);
        let worst = norm.measure(&y0, &y1, &[2.0, 4.0, 8.0, 0.5]);
        assert_eq!(
            worst,
            Worst {
                value: 2.0,
                group: 1
            }
        );
        assert_eq!(norm.weights(), [0.5, 0.5, 0.25, 1.0]);
        let worst = norm.measure(&y0, &y1, &[6.0, 0.0, 0.0, 4.0]);
        assert_eq!(worst.group, 0);
        assert!((worst.value - 12.5_f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn groups_in_turn_are_summed_the_same() {
        let tolerance = Tolerance::new(0.0, vec![1.0; 4], &[false; 4], vec![0, 1, 0, 1]).unwrap();
        let mut norm = Norm::new(&tolerance);
        assert_eq!(norm.stretches, [0..2, 0..2]);
        assert_eq!(Norm::new(&two_bodies()).stretches, [0..2, 1..2, 0..1]);
        let worst = norm.measure(&[0.0; 4], &[0.0; 4], &[3.0, 1.0, 5.0, 7.0]);
        let value = 25.0_f64.sqrt();
        assert_eq!(worst, Worst { value, group: 1 });
    }

    #[test]
    fn nothing_non_finite_passes() {
        let tolerance = two_bodies();
        let mut norm = Norm::new(&tolerance);
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let zero = [0.0; 4];
            let with = [0.0, 0.0, bad, 0.0];
            let expected = Worst {
                value: f64::INFINITY,
                group: 1,
            };
            assert_eq!(norm.measure(&zero, &zero, &with), expected);
            assert_eq!(norm.measure(&zero, &with, &zero), expected);
        }
    }

    #[test]
    fn impossible_tolerances_are_refused() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Tolerance::uniform(2, 1e-6, bad).is_err());
        }
        assert!(Tolerance::uniform(2, -1.0, 1.0).is_err());
        assert!(Tolerance::uniform(2, f64::NAN, 1.0).is_err());
        assert!(Tolerance::uniform(0, 1e-6, 1.0).is_err());
        assert!(Tolerance::new(0.0, vec![1.0; 2], &[true], vec![0; 2]).is_err());
    }
}
