//! Probes read from the dense output of a run, as samples at a rate of their own.
//!
//! What a sensor would give (motion, forces of the cage, friction torques) has content far above half the sampling
//! rate: of a faulted 6205 most of the acceleration's power is above 6 kHz. Point samples would fold it into the
//! band below. So these columns are read on a finer grid, as fine as the steps, and decimated through a linear-phase
//! low-pass (`filter`, `decimate`); accelerations come from the velocities there, by the filter's derivative. Values
//! of a state (contacts, energies, forces by origin, slices) are read at the samples' own times and never filtered:
//! a contact angle does not exist without load, and energies and forces balance at an instant.
//!
//! A record is kept whole, or handed over in blocks (`blocks`) of samples that are final.

mod accuracy;
mod blocks;
mod decimate;
mod demand;
mod filter;
pub(crate) mod kinematics;
mod probes;
mod recorder;
mod residual;
mod sampling;
pub(crate) mod touched;
mod warning;

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::base::nulls;
use crate::inspect::RaceFilm;
use crate::reduction::Omission;
use crate::scene::{Doubt, RingName, Scene};
use crate::signals::kinematics::RowKinematics;
use crate::signals::touched::Touched;
use crate::simd::Distrust;
use crate::statics::AxisHeld;

pub use accuracy::Accuracy;
pub use blocks::Block;
pub(crate) use blocks::{BlockSink, Keep};
pub(crate) use demand::Demand;
pub(crate) use probes::columns;
pub(crate) use recorder::Recorder;
pub use sampling::Bandwidth;
pub(crate) use sampling::Sampling;
pub use warning::Warning;

/// Results of a run.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Signals {
    /// Sampling rate \[Hz\].
    pub fs: f64,
    /// Times k / fs from 0, the duration itself excluded; empty where blocks have taken them \[s\].
    pub t: Vec<f64>,
    /// The signals, each as long as `t`.
    pub columns: Vec<Column>,
    /// Forces of single slices at the times that probes asked for.
    pub slices: Vec<SliceRow>,
    /// The states of all bodies at the end, in the order of [`crate::Model::names`]: where a run begins that goes on
    /// ([`crate::Start::State`]).
    pub end_state: Vec<f64>,
    /// Effort of the integrator.
    pub stats: Statistics,
    /// Origin of the signals.
    pub provenance: Provenance,
    /// The scene.
    pub scene: Scene,
}

impl Signals {
    /// The values of a column by its name, such as `outer.ay`.
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        self.columns
            .iter()
            .find(|column| column.name == name)
            .map(|column| column.values.as_slice())
    }
}

/// Effort and mishaps of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Statistics {
    /// Steps accepted.
    pub accepted: usize,
    /// Steps rejected.
    pub rejected: usize,
    /// Evaluations of the right-hand side by the integrator; sampling of accelerations adds one a sample.
    pub nfev: usize,
    /// Smallest accepted step \[s\], not counting steps shortened to land on a breakpoint; absent without any.
    pub smallest_step: Option<f64>,
    /// Time at which the smallest step began \[s\].
    pub smallest_step_time: Option<f64>,
    /// Largest accepted step \[s\].
    pub largest_step: f64,
    /// Share of the accepted steps at the stability limit (stiffness quotient above 3.25), 0 to 1.
    pub stiff_share: f64,
    /// Share of the accepted steps that the step cap limited, 0 to 1.
    pub capped_share: f64,
    /// Slices at accepted steps whose damping wanted to pull and was clamped.
    pub clamped_pulls: usize,
    /// Contacts at accepted steps that were cut where the race ends: at a shoulder, or at the pole of ball and groove where a
    /// zone ends there (in a defect, on a curve through points, with fixed slices, pressed in by a twentieth of the ball's radius).
    pub truncated_contacts: usize,
    /// Relative difference (root mean square over the samples) between the recorded accelerations of the outer ring,
    /// or of the inner one where that is held, and the derivative of its recorded velocities; absent without
    /// accelerations. Of a filtered record at a tolerance of 1e-6 and below, the part of the difference within its band. A measure of their
    /// error: above 0.05 is warned of. Below 0.5 m/s² relative to that.
    pub acceleration_residual: Option<f64>,
    /// Wall time of the integration \[s\].
    pub wall_time: f64,
    /// Evaluations beyond the end of the run, for what the filter takes from there; not among `nfev`.
    pub nfev_past_end: usize,
    /// Largest Hertz pressure of any contact at the start or at the end of the run \[Pa\], at the zone's centre; that of
    /// the smooth race where the ball lies in a defect.
    pub largest_pressure: f64,
    /// Largest slip speed of a loaded contact under an oil film at the start or at the end of the run \[m/s\]; 0 without oil. Above 0.5
    /// is warned of.
    pub film_slip: f64,
    /// Largest tilt of a ring at the start or at the end of the run \[rad\]; 0 where none may tilt. Above 0.05 is
    /// warned of.
    pub largest_tilt: f64,
    /// Steps accepted before t = 0, while the start settled; counted nowhere else.
    pub settling_accepted: usize,
    /// Evaluations before t = 0, while the start settled; counted nowhere else.
    pub settling_nfev: usize,
    /// Share of their orbit rate that the balls lost in a run in which nothing drives them, for want of friction; absent in
    /// any other. Above 0.005 is warned of.
    pub orbit_slowed: Option<f64>,
}

impl Statistics {
    /// Statistics of a run that went on from here with another scene.
    #[must_use]
    pub(crate) fn and(self, next: &Self) -> Self {
        let accepted = self.accepted + next.accepted;
        let share = |before: f64, after: f64| {
            (before * self.accepted as f64 + after * next.accepted as f64) / accepted.max(1) as f64
        };
        let is_smaller = |of: &Self| of.smallest_step.unwrap_or(f64::INFINITY);
        let smallest = if is_smaller(next) < is_smaller(&self) {
            next
        } else {
            &self
        };
        Self {
            accepted,
            rejected: self.rejected + next.rejected,
            nfev: self.nfev + next.nfev,
            smallest_step: smallest.smallest_step,
            smallest_step_time: smallest.smallest_step_time,
            largest_step: self.largest_step.max(next.largest_step),
            stiff_share: share(self.stiff_share, next.stiff_share),
            capped_share: share(self.capped_share, next.capped_share),
            clamped_pulls: self.clamped_pulls + next.clamped_pulls,
            truncated_contacts: self.truncated_contacts + next.truncated_contacts,
            wall_time: self.wall_time + next.wall_time,
            largest_pressure: self.largest_pressure.max(next.largest_pressure),
            film_slip: self.film_slip.max(next.film_slip),
            largest_tilt: self.largest_tilt.max(next.largest_tilt),
            ..*next
        }
    }
}

/// Origin of signals: version, scene, options, machine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Provenance {
    /// Version of this crate.
    pub version: Cow<'static, str>,
    /// Version of the scene document.
    pub schema: u32,
    /// Method.
    pub method: String,
    /// Relative tolerance.
    pub rtol: f64,
    /// Whether the band of the record chose tolerance and step cap.
    #[serde(default)]
    pub by_band: bool,
    /// Choice for a requested accuracy, where there was one.
    pub accuracy: Option<Accuracy>,
    /// Step cap \[s\]; absent: none.
    pub max_step: Option<f64>,
    /// Start of the run.
    pub start: Cow<'static, str>,
    /// Simulated time \[s\].
    pub duration: f64,
    /// Threads used.
    pub threads: usize,
    /// States that were integrated.
    pub states: usize,
    /// Parts that were left out since they do not change the motion.
    pub left_out: Vec<Omission>,
    /// The instruction set.
    pub simd: Cow<'static, str>,
    /// Fault of the instruction set that would have been used; absent where there was none.
    pub distrust: Option<Distrust>,
    /// Processor architecture.
    pub architecture: Cow<'static, str>,
    /// Frequency up to which motion, cage forces and friction torques are not attenuated \[Hz\]: 0.4 fs behind the
    /// low-pass, fs/2 where fs is above the rate of the steps and takes none; absent for point samples.
    pub bandwidth: Option<f64>,
    /// Points a sample at which filtered signals are read; 1: there is no filter.
    pub oversampling: usize,
    /// Time before t = 0 in which the start settled \[s\]; 0: not at all.
    pub settled: f64,
    /// Record of the defects that have a width.
    pub defects: Vec<Touched>,
    /// Mean speeds of the loaded rows; empty of a run of less than a turn of the inner ring.
    pub kinematics: Vec<RowKinematics>,
    /// The films of rows with an oil, at the load and the speed that they are computed for.
    pub films: Vec<RaceFilm>,
    /// Largest step by which the method is stable and accurate in this scene \[s\]; `frequency_cap` keeps below it.
    #[serde(deserialize_with = "nulls::number")]
    pub step_limit: f64,
    /// Changes at rest by holding the balls' axis along the bearing's; absent where nothing turns or rubs, or without an equilibrium.
    pub axis: Option<AxisHeld>,
    /// Doubts at rest about the balls at their speed.
    pub at_rest: Vec<Doubt>,
}

/// A signal with its name and unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Column {
    /// `<probe>.<quantity>`.
    pub name: String,
    /// Unit, such as `m/s^2`.
    pub unit: Cow<'static, str>,
    /// A value a sample.
    #[serde(deserialize_with = "nulls::numbers")]
    pub values: Vec<f64>,
}

/// The force of one slice at one time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SliceRow {
    /// The probe that asked.
    pub probe: String,
    /// Time \[s\].
    pub time: f64,
    /// Row, from 0.
    pub row: usize,
    /// Ball of the row, from 0.
    pub ball: usize,
    /// The race.
    pub race: RingName,
    /// Place of the slice along the ball \[m\].
    pub zeta: f64,
    /// Axial place in the ring's frame \[m\].
    pub z: f64,
    /// Width of the slice \[m\].
    pub width: f64,
    /// Penetration \[m\].
    pub penetration: f64,
    /// Normal force \[N\].
    pub force: f64,
}
