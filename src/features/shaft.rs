//! The motion of the shaft over a record, of the inner ring against the outer: its frequency, or the angle over which a run-up is
//! resampled.

use std::borrow::Cow;
use std::f64::consts::TAU;

use super::angular::{resampled, turning_part};
use crate::scene::{RingName, Scene};

/// A line is sought this far from its kinematic frequency: the operating contact angle differs from the
/// nominal one, by 10° at most, and the balls slip a little.
pub(super) const SHARE: f64 = 0.02;

/// Turns of the rings over a record, over those of the inner ring against the outer.
#[derive(Debug, Clone, Copy)]
pub(super) struct RingTurns {
    /// Absent where its speed is not given.
    pub outer: Option<f64>,
    pub inner: f64,
}

impl RingTurns {
    /// The shaft where the outer ring stands.
    pub const INNER: Self = Self {
        outer: None,
        inner: 1.0,
    };

    /// The shaft over so many samples from a time on.
    pub fn of(scene: &Scene, from: f64, count: usize, fs: f64) -> Self {
        if scene.outer_speed.is_none() {
            return Self::INNER;
        }
        let mut sums = [0.0; 2];
        for speeds in (0..count).map(|i| scene.ring_speeds(from + i as f64 / fs)) {
            sums[0] += speeds[0];
            sums[1] += speeds[1];
        }
        let relative = sums[1] - sums[0];
        Self {
            outer: Some(sums[0] / relative),
            inner: sums[1] / relative,
        }
    }
}

/// Abscissa over which a spectrum is taken.
pub(super) enum Shaft {
    /// Time: the speed changes by less than the width in which a line is sought; its frequency \[Hz\].
    Steady(f64),
    /// The angle, as long as the shaft does not all but stand.
    Varying {
        /// The sample from which on.
        first: usize,
        /// Turns of the shaft at every sample from there, from 0.
        turns: Vec<f64>,
    },
}

impl Shaft {
    /// The shaft over so many samples from a time on. Absent where the speed is not given, or the shaft stands still or turns back.
    /// Of a run from rest, or to it, over the longest part in which it has a twentieth of its highest speed.
    pub fn of(scene: &Scene, from: f64, count: usize, fs: f64) -> Option<Self> {
        scene.given_speed(RingName::Inner)?;
        let speeds: Vec<f64> = (0..count)
            .map(|i| scene.relative_speed(from + i as f64 / fs) / TAU)
            .collect();
        let mean = speeds.iter().sum::<f64>() / speeds.len() as f64;
        let within = |share: f64| {
            let near = |s: &f64| (s - mean).abs() <= share * mean.abs();
            speeds.iter().all(near)
        };
        if within(SHARE) {
            return (mean != 0.0).then_some(Self::Steady(mean.abs()));
        }
        let forwards: Vec<f64> = speeds.iter().map(|s| s * mean.signum()).collect();
        if mean == 0.0 {
            return None;
        }
        let part = turning_part(&forwards).filter(|part| part.len() > 1)?;
        let first = part.start;
        let mut turns = vec![0.0];
        for pair in forwards[part].windows(2) {
            let last = turns[turns.len() - 1];
            turns.push(last + (pair[0] + pair[1]) / (2.0 * fs));
        }
        Some(Self::Varying { first, turns })
    }

    /// The sample from which on the spectrum is.
    pub fn first(&self) -> usize {
        match self {
            Self::Steady(_) => 0,
            Self::Varying { first, .. } => *first,
        }
    }

    /// How many turns the spectrum is over, of so many samples.
    pub fn turns(&self, count: usize, fs: f64) -> f64 {
        match self {
            Self::Steady(frequency) => frequency * count as f64 / fs,
            Self::Varying { turns, .. } => turns[turns.len() - 1],
        }
    }

    /// Whether the speed is the same all the time, within the width in which a line is sought.
    pub fn is_steady(&self) -> bool {
        matches!(self, Self::Steady(_))
    }

    /// Frequency of the shaft over the spectrum's abscissa: in Hz, or once a turn.
    pub fn frequency(&self) -> f64 {
        match self {
            Self::Steady(frequency) => *frequency,
            Self::Varying { .. } => 1.0,
        }
    }

    /// A signal at equal distances of the spectrum's abscissa, and how many of these a unit has: over the angle as many as it has over time
    /// on average.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // samples of a turn
    pub fn by_angle<'x>(&self, x: &'x [f64], fs: f64) -> (Cow<'x, [f64]>, f64) {
        let Self::Varying { first, turns } = self else {
            return (x.into(), fs);
        };
        let x = &x[*first..*first + turns.len()];
        let all = turns[turns.len() - 1];
        let rate = (x.len() as f64 / all).ceil() as usize;
        (resampled(x, turns, rate).into(), rate as f64)
    }
}
