//! Columns decimated during a run: every point of the grid is added at once to the samples that it contributes to, so
//! that only the points for the ends of the record are kept.

use std::collections::VecDeque;

use super::Column;
use super::filter::{SampleKind, Taps, signed};
use crate::base::words::{Remembered, Words};
use crate::simd::{InstructionSet, Task};

/// Columns on their way from the grid to their samples.
///
/// Beyond the first and the last point of the grid a signal goes on as its odd reflection there,
/// `x(2 t₀ − t) = 2 x(t₀) − x(t)`: value and slope are continuous, an acceleration is mirrored.
#[derive(Debug)]
pub(super) struct Decimator {
    taps: Taps,
    instructions: InstructionSet,
    /// The columns that are filtered, and how.
    columns: Vec<(usize, SampleKind)>,
    /// The point of the grid where row 0 of the columns stands.
    row0: i64,
    /// The first point, and the values there.
    first: Option<(i64, Vec<f64>)>,
    /// The last points, one more than the filter reaches.
    latest: VecDeque<f64>,
    next: i64,
}

impl Decimator {
    pub fn new(taps: Taps, columns: Vec<(usize, SampleKind)>) -> Self {
        Self {
            taps,
            instructions: InstructionSet::current(),
            columns,
            row0: 0,
            first: None,
            latest: VecDeque::new(),
            next: 0,
        }
    }

    /// Points from the middle of the filter to its last.
    pub fn reach(&self) -> i64 {
        self.taps.reach()
    }

    /// Samples that no later point counts for.
    pub fn finished(&self) -> usize {
        self.taps.finished(self.next)
    }

    /// Drops so many samples that have left the columns.
    pub fn drop_samples(&mut self, count: usize) {
        self.row0 += self.taps.points(count);
    }

    /// Takes the values at the next point of the grid, one a filtered column; the first may be any.
    pub fn push(&mut self, point: i64, values: &[f64], out: &mut [Column]) {
        self.spread(point, values, out);
        match &self.first {
            None => self.first = Some((point, values.to_vec())),
            Some((first, at)) if point - first <= self.taps.reach() => {
                let mirrored = mirror(at, values);
                self.spread(2 * first - point, &mirrored, out);
            }
            Some(_) => {}
        }
        self.next = point + 1;
        self.keep(values);
    }

    /// Goes on beyond the last point.
    pub fn finish(&mut self, out: &mut [Column]) {
        let latest: Vec<f64> = self.latest.drain(..).collect();
        let mut points = latest.chunks(self.columns.len().max(1)).rev();
        let Some(at) = points.next() else { return };
        for (point, values) in (self.next..).zip(points) {
            self.spread(point, &mirror(at, values), out);
        }
    }

    /// Passes on what later points depend on.
    pub fn pass_on(&mut self, words: &mut Words) {
        self.row0.pass(words);
        self.first.pass(words);
        self.latest.pass(words);
        self.next.pass(words);
    }

    fn spread(&self, point: i64, values: &[f64], out: &mut [Column]) {
        self.instructions.run(Spread {
            decimator: self,
            point,
            values,
            out,
        });
    }

    /// Keeps the values in the place of those that the end does not need any more.
    fn keep(&mut self, values: &[f64]) {
        if signed(self.latest.len()) > self.taps.reach() * signed(values.len()) {
            self.latest.drain(..values.len());
        }
        self.latest.extend(values);
    }
}

/// A point of the grid for the samples around it. No sum is fused with a product: all instruction sets give the same bits.
struct Spread<'a> {
    decimator: &'a Decimator,
    point: i64,
    values: &'a [f64],
    out: &'a mut [Column],
}

impl Task for Spread<'_> {
    type Output = ();

    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Decimator { taps, columns, .. } = self.decimator;
        let point = self.point - self.decimator.row0;
        for ((column, how), value) in columns.iter().zip(self.values) {
            taps.spread(*how, point, *value, &mut self.out[*column].values);
        }
    }
}

/// The odd reflection of values about those at an end.
fn mirror(at: &[f64], values: &[f64]) -> Vec<f64> {
    at.iter().zip(values).map(|(a, x)| 2.0 * a - x).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    const FS: f64 = 1000.0;
    const OVER: usize = 8;
    const COUNT: usize = 200;

    /// Samples of a signal and of its derivative, read on the grid from `first` to `last`.
    fn decimated(x: impl Fn(f64) -> f64, first: i64, last: i64) -> [Vec<f64>; 2] {
        let column = || Column {
            name: String::new(),
            unit: "".into(),
            values: vec![0.0; COUNT],
        };
        let mut out = vec![column(), column()];
        let columns = vec![(0, SampleKind::Smooth), (1, SampleKind::Slope)];
        let mut decimator = Decimator::new(Taps::new(OVER, FS), columns);
        for point in first..=last {
            let x = x(point as f64 / (OVER as f64 * FS));
            decimator.push(point, &[x, x], &mut out);
        }
        decimator.finish(&mut out);
        let slope = out.pop().unwrap().values;
        [out.pop().unwrap().values, slope]
    }

    /// Record with data on both sides of all samples.
    fn whole(x: impl Fn(f64) -> f64) -> [Vec<f64>; 2] {
        let reach = Taps::new(OVER, FS).reach();
        decimated(x, -reach, signed((COUNT - 1) * OVER) + reach)
    }

    fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
        a.iter()
            .zip(b)
            .fold(0.0, |most, (a, b)| most.max((a - b).abs()))
    }

    /// Analytic: a sine in the band comes out as it is, phase and all, and so does its derivative; one above the band
    /// does not come out at all.
    #[test]
    fn a_sine_passes_without_delay_or_not_at_all() {
        let times = (0..COUNT).map(|k| k as f64 / FS);
        for f in [3.0, 130.0, 399.0] {
            let wave = |t: f64| (TAU * f * t + 0.3).sin();
            let slope = |t: f64| TAU * f * (TAU * f * t + 0.3).cos();
            let [value, rate] = whole(wave);
            let [expected_value, expected_rate]: [Vec<f64>; 2] = [
                times.clone().map(wave).collect(),
                times.clone().map(slope).collect(),
            ];
            assert!(largest_difference(&value, &expected_value) < 1e-4, "{f}");
            assert!(
                largest_difference(&rate, &expected_rate) < 4e-4 * TAU * f,
                "{f}"
            );
        }
        for f in [601.0, 1003.0, 2500.0, 3900.0] {
            let [value, rate] = whole(|t| (TAU * f * t).sin());
            let silence = vec![0.0; COUNT];
            assert!(largest_difference(&value, &silence) < 1e-4, "{f}");
            assert!(largest_difference(&rate, &silence) < 1e-4 * TAU * f, "{f}");
        }
    }

    /// Analytic: where a record ends, a signal that is odd about its ends comes out as if it went on, and a ramp with it;
    /// samples further from an end than the filter reaches do not depend on it.
    #[test]
    fn ends_are_continued_oddly() {
        let last = signed((COUNT - 1) * OVER);
        let end = (COUNT - 1) as f64 / FS;
        let odd = |t: f64| 2.0 + 5.0 * t + (TAU * 20.0 / end * t).sin();
        let ([all, all_slope], [cut, cut_slope]) = (whole(odd), decimated(odd, 0, last));
        assert!(largest_difference(&all, &cut) < 1e-12);
        assert!(largest_difference(&all_slope, &cut_slope) < 1e-8);
        let any = |t: f64| (TAU * 90.0 * t + 1.0).sin();
        let ([all, _], [cut, _]) = (whole(any), decimated(any, 0, last));
        let inside = super::super::filter::HALF..COUNT - super::super::filter::HALF;
        assert!(largest_difference(&all[inside.clone()], &cut[inside]) < 1e-14);
        assert!(largest_difference(&all, &cut) > 1e-3);
    }
}
