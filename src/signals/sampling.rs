//! How finely a run is read, and up to which frequency its samples are valid.

use super::filter::{FLAT, HALF};
use crate::base::error::{Error, Result};

/// Sampling rate over the highest contact frequency [1/rad] from which on nothing is left to filter. Of the
/// acceleration's power 1e-7 stands above half of it, for the faulted wheel bearing and a faulted 6205.
const FINE: f64 = 2.0;
/// The most points a sample: more would take memory for coefficients without effect.
const MOST: f64 = 1e5;
/// Relative error that products of times and rates may have.
const ROUNDING: f64 = 1e-12;
/// Largest share of a run by which it goes on past its end.
const PAST_END: f64 = 0.1;

/// Whether signals are filtered before they are sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Bandwidth {
    /// Motion, cage forces and friction torques pass a linear-phase low-pass: flat within 0.004 dB to 0.4 fs, 83 dB
    /// down beyond 0.6 fs, without delay. What jumps rings for some samples before and after, as in any such record.
    #[default]
    Auto,
    /// Point samples of the dense output in all columns, folded as they may be: for those who study the integrator.
    Raw,
}

impl Bandwidth {
    /// Frequency up to which a record at a sampling rate is not attenuated by the filter \[Hz\]; none without one.
    pub(crate) fn at(self, fs: f64) -> Option<f64> {
        (self == Self::Auto).then_some(FLAT * fs)
    }
}

/// Sampling rate, and the grid on which filtered signals are read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sampling {
    /// Sampling rate \[Hz\].
    pub fs: f64,
    /// Points of the grid a sample; 1: there is no filter.
    pub oversampling: usize,
    /// Frequency up to which signals are not attenuated \[Hz\]; absent for point samples, which may be aliased.
    pub bandwidth: Option<f64>,
}

impl Sampling {
    /// The sampling for contacts of an angular frequency of at most `frequency` \[rad/s\].
    ///
    /// # Errors
    /// [`Error::Argument`] where a sample would take too many points.
    pub fn new(bandwidth: Bandwidth, fs: f64, frequency: f64) -> Result<Self> {
        // A point of the grid a radian of the highest contact frequency, as the steps have.
        let wanted = if bandwidth == Bandwidth::Raw || fs >= FINE * frequency {
            1.0
        } else {
            (frequency / fs).ceil().max(2.0)
        };
        if wanted > MOST {
            let allowed = format!(
                "at least {:.3} Hz where signals are filtered, or point samples (no bandwidth)",
                frequency / MOST
            );
            return Err(Error::argument("fs", fs, allowed));
        }
        // From 1 to MOST.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let oversampling = wanted as usize;
        Ok(Self::again(bandwidth, fs, oversampling))
    }

    /// The sampling of a run that goes on, with so many points a sample.
    pub fn again(bandwidth: Bandwidth, fs: f64, oversampling: usize) -> Self {
        // A small whole number.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let oversampling = oversampling.clamp(1, MOST as usize);
        let share = if oversampling > 1 { FLAT } else { 0.5 };
        Self {
            fs,
            oversampling,
            bandwidth: (bandwidth == Bandwidth::Auto).then_some(share * fs),
        }
    }

    /// Rate of the grid \[Hz\].
    pub fn grid(&self) -> f64 {
        self.oversampling as f64 * self.fs
    }

    /// Samples before a time \[s\]; what rounding has made of the time of a sample is that time.
    pub fn before(&self, time: f64) -> usize {
        let samples = time * self.fs;
        let is_one = (samples - samples.round()).abs() < ROUNDING * samples;
        let count = if is_one {
            samples.round()
        } else {
            samples.ceil()
        };
        // At most 1e15 by the limits of duration and rate.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let count = count as usize;
        count
    }

    /// Time until which a run of a duration is followed, for what its last samples take from beyond the end \[s\].
    pub fn until(&self, duration: f64) -> f64 {
        if self.oversampling > 1 {
            duration + (HALF as f64 / self.fs).min(PAST_END * duration)
        } else {
            duration
        }
    }
}
