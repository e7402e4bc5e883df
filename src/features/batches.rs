//! Standard errors of features: their scatter over records of the same length from starts that differ by less than can be
//! measured.
//!
//! Signals of impacts are random: a start that is moved by 1e-13 rad keeps their statistics and changes every sample after
//! some milliseconds. The record is cut into m batches of a whole number of shaft turns or, where there are fewer than 8 of
//! these, of passes of balls over a place of the outer race, so that what is periodic is the same in all of them:
//!
//! | of | standard error |
//! |---|---|
//! | means | √(Σ (bᵢ − b̄)² / (m (m − 1))) of the means bᵢ of the batches |
//! | rms, kurtosis | by the jackknife: √((m − 1)/m Σ (θᵢ − θ̄)²), θᵢ of the record without batch i, since both are no means but functions of several |
//! | extremes | √(Σ (bᵢ − b̄)² / (m − 1)) of the extremes bᵢ of the batches: of distributions with tails that fall as an exponential or faster the extreme of m batches scatters as that of one |
//! | crest factor | of peak and rms, as if these were independent |
//! | lines | of the noise beside them: see `spectrum.rs` |
//!
//! With 8 to 32 batches a standard error is itself known to 27 to 13 %; more would be shorter, and less independent of their
//! neighbours.
//!
//! Source: batch means B. W. Schmeiser, Oper. Res. 30 (1982) 556 (10 to 30 batches), A. M. Law, *Simulation Modeling and
//! Analysis*, chapter 9; jackknife over blocks H. R. Künsch, Ann. Stat. 17 (1989) 1217; extremes E. J. Gumbel, *Statistics
//! of Extremes* (1958), whose law keeps its width from batch to record.

use std::ops::Range;

/// Batches of a record, at least and at most.
const LEAST: f64 = 8.0;
const MOST: f64 = 32.0;

/// Batches of equal length from the record's beginning on; none where it is too short.
pub(super) struct Batches {
    ranges: Vec<Range<usize>>,
    /// Share of the record that they cover: what is left at its end is less than one of them.
    covered: f64,
}

impl Batches {
    /// The batches of so many samples that last for so many turns, or so many passes.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    pub fn new(count: usize, [turns, passes]: [f64; 2]) -> Self {
        let found = [turns, passes].into_iter().find(|units| *units >= LEAST);
        let Some(units) = found.filter(|units| units.is_finite()) else {
            return Self::none();
        };
        let each = (units.floor() / MOST).ceil();
        let number = (units / each).floor();
        let length = count as f64 * each / units;
        let edge = |i: usize| (length * i as f64).round() as usize;
        let ranges: Vec<_> = (0..number as usize).map(|i| edge(i)..edge(i + 1)).collect();
        if ranges.iter().any(Range::is_empty) {
            return Self::none();
        }
        Self {
            ranges,
            covered: number * each / units,
        }
    }

    /// The batches of a record that has no statistics of its own.
    pub fn none() -> Self {
        Self {
            ranges: Vec::new(),
            covered: 0.0,
        }
    }

    /// Number of batches.
    pub fn count(&self) -> usize {
        self.ranges.len()
    }

    /// Values of a function of each batch; nothing without batches.
    pub fn map<T>(&self, of: impl Fn(Range<usize>) -> T) -> Option<Vec<T>> {
        let all = || self.ranges.iter().cloned().map(of).collect();
        (!self.ranges.is_empty()).then(all)
    }

    /// Standard error of a mean over the record, from those of the batches.
    pub fn of_mean(&self, means: &[f64]) -> f64 {
        (self.covered / means.len() as f64 * variance(means)).sqrt()
    }

    /// Standard error of a feature of the record, from what it is without each of the batches.
    pub fn jackknife(&self, without: &[f64]) -> f64 {
        let count = without.len() as f64;
        (self.covered * (count - 1.0).powi(2) / count * variance(without)).sqrt()
    }

    /// Standard error of an extreme of the record, from those of the batches.
    pub fn of_extreme(extremes: &[f64]) -> f64 {
        variance(extremes).sqrt()
    }
}

/// Σ (x − x̄)² / (m − 1).
fn variance(x: &[f64]) -> f64 {
    let count = x.len() as f64;
    let mean = x.iter().sum::<f64>() / count;
    x.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (count - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 8 turns are cut by turns, fewer by passes, 100 by fours; what is left over is in none, and too little is not cut.
    #[test]
    fn batches_are_whole_turns_or_passes() {
        let cut = |turns: f64, passes: f64| {
            let batches = Batches::new(1000, [turns, passes]);
            let ends: Vec<usize> = batches.ranges.iter().map(|range| range.end).collect();
            (ends.len(), ends.first().copied(), ends.last().copied())
        };
        assert_eq!(cut(8.0, 30.0), (8, Some(125), Some(1000)));
        assert_eq!(cut(7.9, 28.0), (28, Some(36), Some(1000)));
        assert_eq!(cut(100.0, 358.0), (25, Some(40), Some(1000)));
        assert_eq!(cut(12.5, 40.0), (12, Some(80), Some(960)));
        assert_eq!(cut(2.0, 7.9), (0, None, None));
        assert_eq!(cut(f64::INFINITY, 8.0), (0, None, None));
    }
}
