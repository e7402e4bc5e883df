//! Signals over the angle of the shaft: orders instead of frequencies, whatever the speed does.
//!
//! An order is a multiple of the shaft's rate, so a line that follows the speed stands at one order throughout a run-up (computed order
//! tracking: K. R. Fyfe, E. D. S. Munck, Mech. Syst. Signal Process. 11 (1997) 187). Samples at equal angles are read between those at equal
//! times by a sinc under Kaiser's window (J. F. Kaiser, R. W. Schafer, IEEE Trans. Acoust. Speech Signal Process. 28 (1980) 105).

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use super::samples::check_samples;
use super::transform::amplitudes;
use crate::base::error::{Error, Result};

/// Samples to either side that a value is read from: exact to 1e-3 up to 0.4 of the sampling rate.
const REACH: usize = 16;

/// Shape β of Kaiser's window: ripple and leakage below 1e-4.
const SHAPE: f64 = 8.0;

/// Entries of the table of the kernel for each sample; what is between them is read linearly, to 2e-6.
const ENTRIES: usize = 512;

/// Samples over the angle, at least.
const FEWEST: f64 = 8.0;

/// Samples over the angle for each over time, at most.
const MOST: f64 = 64.0;

/// Part of the highest speed below which a shaft all but stands: a turn has 20 times the samples of the fastest.
const SLOWEST: f64 = 0.05;

/// A signal at equal steps of the shaft's angle: turns of the shaft since the first sample, and the signal there, in the unit of `x`.
///
/// `angle` is that of the shaft at the samples of `x`, rising throughout \[rad\]. The result has `per_turn` samples a turn, and holds orders up to half of
/// that; by default as many as the slowest turn has, so that nothing is lost. With fewer, what lies above is filtered off first.
///
/// ```
/// use std::f64::consts::TAU;
/// // Three waves a turn, while the shaft goes from 10 to 30 turns a second.
/// let turns: Vec<f64> = (0..8000).map(|i| f64::from(i) / 4000.0).map(|t| 10.0 * t + 5.0 * t * t).collect();
/// let x: Vec<f64> = turns.iter().map(|turn| (TAU * 3.0 * turn).cos()).collect();
/// let angle: Vec<f64> = turns.iter().map(|turn| TAU * turn).collect();
/// let (turn, value) = ballrace::by_order(&x, &angle, Some(64))?;
/// let off = turn.iter().zip(&value).map(|(turn, value)| (value - (TAU * 3.0 * turn).cos()).abs());
/// assert!(off.fold(0.0, f64::max) < 2e-3);
/// # Ok::<(), ballrace::Error>(())
/// ```
///
/// # Errors
/// [`Error::Record`] for samples that are not finite; [`Error::Argument`] for an angle that does not rise, is not as long as the signal, or
/// is so slow at places that a signal at equal steps would take 64 times the samples, and for fewer than 2 samples a turn.
pub fn by_order(x: &[f64], angle: &[f64], per_turn: Option<usize>) -> Result<(Vec<f64>, Vec<f64>)> {
    check_samples("x", x)?;
    let turns = checked_turns(angle, x.len())?;
    let rate = checked_rate(&turns, per_turn)?;
    let value = resampled(x, &turns, rate);
    let turn = (0..value.len()).map(|i| i as f64 / rate as f64).collect();
    Ok((turn, value))
}

/// The amplitude spectrum of a signal over the shaft's angle: orders, multiples of the shaft's rate, from 0 to half the samples a turn, and
/// amplitudes in the unit of `x`. Of a squared envelope it has the lines of a defect, at the same orders in a run-up as at constant speed.
///
/// # Errors
/// As [`by_order()`].
pub fn order_spectrum(
    x: &[f64],
    angle: &[f64],
    per_turn: Option<usize>,
) -> Result<(Vec<f64>, Vec<f64>)> {
    let (turn, value) = by_order(x, angle, per_turn)?;
    let found = amplitudes(&value, value.len());
    let spacing = 1.0 / (turn[1] * value.len() as f64);
    let order = (0..found.len()).map(|k| k as f64 * spacing).collect();
    Ok((order, found))
}

/// The longest part of a record in which the shaft has at least a twentieth of its highest speed: of a run from rest, what [`by_order()`]
/// takes. `angle` is that of the shaft at equal steps of time \[rad\]; all samples where it does not go forwards.
pub fn turning(angle: &[f64]) -> Range<usize> {
    let speeds: Vec<f64> = angle.windows(2).map(|pair| pair[1] - pair[0]).collect();
    turning_part(&speeds).map_or(0..angle.len(), |part| part.start..part.end + 1)
}

/// The longest part in which speeds are at least a twentieth of the highest; none where one goes backwards faster than that, or none
/// goes forwards.
pub(super) fn turning_part(speeds: &[f64]) -> Option<Range<usize>> {
    let slowest = SLOWEST * speeds.iter().copied().fold(0.0, f64::max);
    if slowest <= 0.0 || speeds.iter().any(|speed| *speed < -slowest) {
        return None;
    }
    let mut longest = 0..0;
    let mut first = 0;
    for part in speeds.chunk_by(|a, b| (*a >= slowest) == (*b >= slowest)) {
        if part[0] >= slowest && part.len() > longest.len() {
            longest = first..first + part.len();
        }
        first += part.len();
    }
    Some(longest)
}

/// Turns since the first sample.
fn checked_turns(angle: &[f64], samples: usize) -> Result<Vec<f64>> {
    if angle.len() != samples {
        let allowed = format!("one angle a sample, {samples}");
        let found = format!("{} angles", angle.len());
        return Err(Error::argument("angle", found, allowed));
    }
    let rises = |pair: &[f64]| pair[1] > pair[0];
    if !(angle.iter().all(|angle| angle.is_finite()) && angle.windows(2).all(rises)) {
        let allowed =
            "finite, and rising from each sample to the next, as that of a ring that turns";
        return Err(Error::argument("angle", "not rising", allowed));
    }
    let first = angle.first().copied().unwrap_or(0.0);
    Ok(angle.iter().map(|angle| (angle - first) / TAU).collect())
}

/// Samples a turn.
fn checked_rate(turns: &[f64], per_turn: Option<usize>) -> Result<usize> {
    let all = turns.last().copied().unwrap_or(0.0);
    if let Some(given @ (0 | 1)) = per_turn {
        return Err(Error::argument("per_turn", given, "at least 2"));
    }
    // Without a turn there is no rate either.
    let needed = if all > 0.0 { of_the_slowest(turns) } else { 2 };
    let rate = per_turn.unwrap_or(needed);
    if rate as f64 * all < FEWEST {
        let allowed = format!("more; at {rate} samples a turn it gives fewer than {FEWEST}");
        return Err(Error::argument("angle", format!("{all:.3} turns"), allowed));
    }
    let read = rate as f64 * finer(needed, rate) as f64;
    if read * all > MOST * turns.len() as f64 {
        let found = format!("{needed} samples a turn where it is slowest");
        let allowed = "one without the time in which the shaft almost stands; turning(angle) returns the rest";
        return Err(Error::argument("angle", found, allowed));
    }
    Ok(rate)
}

/// As many samples a turn as the slowest turn has.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // above 0, and what is too large is refused
fn of_the_slowest(turns: &[f64]) -> usize {
    let steps = turns.windows(2).map(|pair| pair[1] - pair[0]);
    (1.0 / steps.fold(f64::INFINITY, f64::min)).ceil() as usize
}

/// How many times as many samples a turn are read as are kept.
fn finer(needed: usize, rate: usize) -> usize {
    needed.div_ceil(rate).max(1)
}

/// A signal at so many equal steps a turn from its first sample on; `turns` rises.
pub(super) fn resampled(x: &[f64], turns: &[f64], rate: usize) -> Vec<f64> {
    let finer = finer(of_the_slowest(turns), rate);
    let step = 1.0 / (rate * finer) as f64;
    let places = TurnPlaces::new(turns);
    let kernel = Kernel::new();
    let read: Vec<f64> = places.of(step).map(|place| kernel.read(x, place)).collect();
    if finer == 1 {
        read
    } else {
        kernel.thinned(&read, finer)
    }
}

/// The places in a record, in samples, at which the shaft has turned so far: on monotone cubics through the samples (F. N. Fritsch, J. Butland, SIAM
/// J. Sci. Stat. Comput. 5 (1984) 300).
struct TurnPlaces<'t> {
    turns: &'t [f64],
    /// Samples a turn at each sample.
    slopes: Vec<f64>,
}

impl<'t> TurnPlaces<'t> {
    fn new(turns: &'t [f64]) -> Self {
        let steps: Vec<f64> = turns.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let end = |near: f64, next: f64| {
            ((2.0 * near + next) / near - near / next).max(0.0) / (near + next)
        };
        let inner = steps.windows(2).map(|pair| {
            let (before, after) = (pair[0], pair[1]);
            let (w, v) = (2.0 * after + before, after + 2.0 * before);
            (w + v) / (w * before + v * after)
        });
        let last = steps.len() - 1;
        let next = |i: usize| steps[i.min(last)];
        let mut slopes = vec![end(steps[0], next(1))];
        slopes.extend(inner);
        slopes.push(end(steps[last], steps[last.saturating_sub(1)]));
        Self { turns, slopes }
    }

    /// The places at equal steps of the turns, from 0 on.
    fn of(&self, step: f64) -> impl Iterator<Item = f64> {
        let all = self.turns[self.turns.len() - 1];
        let mut before = 0;
        let turns = (0_u32..).map(move |i| f64::from(i) * step);
        turns.take_while(move |turn| *turn <= all).map(move |turn| {
            while before + 2 < self.turns.len() && self.turns[before + 1] <= turn {
                before += 1;
            }
            self.between(before, turn)
        })
    }

    fn between(&self, before: usize, turn: f64) -> f64 {
        let width = self.turns[before + 1] - self.turns[before];
        let s = (turn - self.turns[before]) / width;
        let [from, to] = [before, before + 1].map(|i| width * self.slopes[i]);
        let rise = s * s * (3.0 - 2.0 * s);
        before as f64 + rise + s * (1.0 - s) * (from * (1.0 - s) - to * s)
    }
}

/// A sinc under Kaiser's window, from its middle on.
struct Kernel(Vec<f64>);

impl Kernel {
    fn new() -> Self {
        let whole = bessel(SHAPE);
        let entry = |i: usize| {
            let t = i as f64 / ENTRIES as f64;
            let share = t / REACH as f64;
            let window = bessel(SHAPE * (1.0 - share * share).max(0.0).sqrt()) / whole;
            let sinc = if i == 0 {
                1.0
            } else {
                (PI * t).sin() / (PI * t)
            };
            window * sinc
        };
        Self((0..=REACH * ENTRIES).map(entry).collect())
    }

    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // from 0 to the end of the table
    fn at(&self, t: f64) -> f64 {
        let place = t.abs() * ENTRIES as f64;
        let before = place as usize;
        let Some(pair) = self.0.get(before..before + 2) else {
            return 0.0;
        };
        pair[0] + (place - before as f64) * (pair[1] - pair[0])
    }

    /// The mean of samples around a place, with weights of the kernel that is so many samples wide.
    #[allow(clippy::cast_possible_truncation, clippy::cast_possible_wrap)] // places in memory
    fn mean(&self, x: &[f64], place: f64, width: usize) -> f64 {
        let (middle, reach) = (place.floor() as isize, (REACH * width) as isize);
        let (mut sum, mut weights) = (0.0, 0.0);
        for k in middle - reach + 1..=middle + reach {
            let weight = self.at((place - k as f64) / width as f64);
            sum += weight * beyond(x, k);
            weights += weight;
        }
        sum / weights
    }

    /// The signal between its samples.
    fn read(&self, x: &[f64], place: f64) -> f64 {
        self.mean(x, place, 1)
    }

    /// One of so many samples, without what these few do not hold.
    fn thinned(&self, x: &[f64], by: usize) -> Vec<f64> {
        let kept = (0..x.len()).step_by(by);
        kept.map(|i| self.mean(x, i as f64, by)).collect()
    }
}

/// A sample; beyond its ends a record goes on as these point.
#[allow(clippy::cast_possible_wrap, clippy::cast_sign_loss)] // places in memory
fn beyond(x: &[f64], k: isize) -> f64 {
    let last = x.len() as isize - 1;
    let at = |k: isize| x[k.clamp(0, last) as usize];
    if k < 0 {
        2.0 * at(0) - at(-k)
    } else if k > last {
        2.0 * at(last) - at(2 * last - k)
    } else {
        at(k)
    }
}

/// Modified Bessel function I₀, by its series.
fn bessel(x: f64) -> f64 {
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1..40 {
        term *= (x / (2.0 * f64::from(k))).powi(2);
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    const FS: f64 = 8000.0;

    /// From 10 to 30 turns a second in 4 s.
    fn run_up() -> Vec<f64> {
        let times = (0..32_000).map(|i| f64::from(i) / FS);
        times.map(|t| 10.0 * t + 2.5 * t * t).collect()
    }

    fn waves(turns: &[f64], order: f64) -> Vec<f64> {
        turns
            .iter()
            .map(|turn| (TAU * order * turn).sin())
            .collect()
    }

    fn angle(turns: &[f64]) -> Vec<f64> {
        turns.iter().map(|turn| 0.7 + TAU * turn).collect()
    }

    /// Analytic: waves of an order are that at equal angles, up to 0.4 of the sampling rate where the shaft is fastest.
    #[test]
    fn waves_of_an_order_stay_so() {
        let turns = run_up();
        for (order, most) in [(1.0, 1e-4), (20.0, 1e-4), (80.0, 3e-4), (106.0, 2e-3)] {
            let (turn, value) = by_order(&waves(&turns, order), &angle(&turns), None).unwrap();
            let truth = waves(&turn, order);
            let inner = turn.len() / 20..turn.len() - turn.len() / 20;
            let off = inner
                .map(|i| (value[i] - truth[i]).abs())
                .fold(0.0, f64::max);
            assert!(off < most, "{order}: {off}");
            // As many samples a turn as the slowest turn has.
            assert!((1.0 / turn[1] - FS / 10.0).abs() < 1.0);
        }
    }

    /// Analytic: what few samples a turn cannot hold is filtered off, not folded.
    #[test]
    fn few_samples_a_turn_fold_nothing() {
        let turns = run_up();
        let (_, value) = by_order(&waves(&turns, 50.0), &angle(&turns), Some(64)).unwrap();
        let inner = &value[value.len() / 20..value.len() - value.len() / 20];
        assert!(inner.iter().all(|x| x.abs() < 1e-3));
        let (order, kept) = order_spectrum(&waves(&turns, 10.0), &angle(&turns), Some(64)).unwrap();
        let top = (0..kept.len())
            .max_by(|i, j| kept[*i].total_cmp(&kept[*j]))
            .unwrap();
        assert!((order[top] - 10.0).abs() < order[1] && (kept[top] - 1.0).abs() < 0.15);
    }

    #[test]
    fn what_is_no_angle_of_a_shaft_that_turns_is_refused() {
        let refused = |angle: &[f64], per_turn| {
            by_order(&[0.0; 100], angle, per_turn)
                .unwrap_err()
                .to_string()
        };
        let even: Vec<f64> = (0..100).map(f64::from).collect();
        assert!(
            refused(&even[..99], None).starts_with("angle = 99 angles: one angle a sample, 100")
        );
        let still = vec![1.0; 100];
        assert!(refused(&still, None).starts_with("angle = not rising: finite, and rising"));
        assert!(refused(&even, Some(1)).starts_with("per_turn = 1: at least 2"));
        let short: Vec<f64> = even.iter().map(|x| 1e-3 * x).collect();
        assert!(refused(&short, Some(64)).contains("it gives fewer than 8"));
        let mut almost = even.clone();
        almost[1] = 1e-6;
        assert!(refused(&almost, None).contains("samples a turn where it is slowest"));
        assert!(by_order(&[], &[], None).is_err() && by_order(&[1.0], &[1.0], None).is_err());
    }

    /// Analytic: from t² the shaft has a twentieth of its last speed after a twentieth of the time.
    #[test]
    fn a_run_from_rest_turns_after_its_begin() {
        let angle: Vec<f64> = (0..=8000).map(|i| f64::from(i * i) / 1e6).collect();
        assert_eq!(turning(&angle), 400..8001);
        assert_eq!(turning(&[2.0, 1.0, 0.0]), 0..3);
        assert_eq!(turning(&[]), 0..0);
    }
}
