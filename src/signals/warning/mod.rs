//! Warnings of a run that was completed.

mod text;

use std::f64::consts::PI;

use serde::Serialize;

use crate::inspect;
use crate::model::Placed;
use crate::scene::Doubt;
use crate::signals::kinematics::RowKinematics;
use crate::signals::touched::Touched;
use crate::signals::{Accuracy, Signals};
use crate::simd::Distrust;

/// Residual of the accelerations above which a run is warned of. Measured on the faulted wheel bearing in 140 runs
/// over slip speeds of 1e-4 to 0.1 m/s, damping of 0 to 20 s/m and rtol of 1e-7 to 1e-1: above it the error against
/// a converged run is 1.3 % and more, below it at most 0.8 %. Without the step cap an
/// undamped run with an error of 11 % stays below.
const LARGEST_RESIDUAL: f64 = 0.05;
/// The same where the band of the record chose the steps: most of it is noise beyond the band. Of 36 healthy bearings by chance on
/// their pedestals the largest was 0.22, of a 6205 under 1500 N it is 0.30, and their rings err by 0.3 and 0.9 % in the band; a wheel
/// whose heavy balls are wrong by 67 % has 0.53.
const LARGEST_BY_BAND: f64 = 0.4;

/// Share of the orbit's rate above which its loss is warned of: with friction balls slip by less than that.
const LARGEST_LOSS: f64 = 0.005;

/// Share by which the balls may go round faster or slower than predicted without a warning, beside what the play of a cage lets them crowd
/// in the loaded zone: half of it over the balls' pitch.
const LARGEST_LEAD: f64 = 0.005;

/// A reason to check the signals of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Warning {
    /// The recorded accelerations and the recorded motion do not belong together: the steps do not resolve the
    /// contacts, however small the error of the states.
    #[non_exhaustive]
    Accelerations {
        /// [`crate::Statistics::acceleration_residual`].
        residual: f64,
        /// [`crate::Statistics::stiff_share`].
        stiff_share: f64,
        /// Tolerance of the run.
        rtol: f64,
    },
    /// The requested accuracy cannot be reached: pilot runs differ by more however fine they are, since the motion is
    /// chaotic.
    AccuracyMissed(Accuracy),
    /// Contacts reached beyond a shoulder, or beyond the pole of ball and groove where a zone ends there: the model has no race there.
    #[non_exhaustive]
    Shoulders {
        /// [`crate::Statistics::truncated_contacts`].
        contacts: usize,
        /// Accepted steps.
        steps: usize,
    },
    /// Fault of the processor, which computes wrongly at an instruction set that it says it has; a narrower one was used.
    Instructions(Distrust),
    /// The line of a defect lies above half the sampling rate.
    #[non_exhaustive]
    SamplingRate {
        /// Sampling rate \[Hz\].
        fs: f64,
        /// The defect.
        defect: String,
        /// First line of the defect at the highest speed of the run: BPFO, BPFI or twice BSF \[Hz\].
        line: f64,
    },
    /// A number of the scene, or what follows from it, that no bearing is likely to have; a column that cannot change.
    Doubtful(Doubt),
    /// Balls passed a defect, and no contact was ever loaded within it.
    #[non_exhaustive]
    Untouched {
        /// [`crate::Touched::name`].
        defect: String,
        /// [`crate::Touched::passes`].
        passes: usize,
        /// [`crate::Touched::axial_offset`].
        axial_offset: f64,
        /// [`crate::Touched::contact_offset`].
        contact_offset: Option<f64>,
        /// [`crate::Touched::placed`].
        placed: Placed,
    },
    /// Defect that no ball passed: of its effect the run shows nothing.
    #[non_exhaustive]
    Unpassed {
        /// [`crate::Touched::name`].
        defect: String,
        /// Simulated time \[s\].
        duration: f64,
    },
    /// Nothing drives the balls along their orbit, and they have lost some of its rate.
    #[non_exhaustive]
    FreeOrbit {
        /// [`crate::Statistics::orbit_slowed`].
        slowed: f64,
    },
    /// The orbit speed of a row differs from rolling at the contact angle at rest.
    Kinematics(RowKinematics),
}

impl Warning {
    /// Subject of the warning: `accuracy` of the signals, or the `scene` that was asked for.
    pub fn category(&self) -> &'static str {
        match self {
            Self::Accelerations { .. }
            | Self::AccuracyMissed(_)
            | Self::Shoulders { .. }
            | Self::Instructions(_) => "accuracy",
            Self::SamplingRate { .. }
            | Self::Doubtful(_)
            | Self::Untouched { .. }
            | Self::Unpassed { .. }
            | Self::FreeOrbit { .. }
            | Self::Kinematics(_) => "scene",
        }
    }
}

impl Signals {
    /// Reasons to check the signals; usually none.
    ///
    /// ```
    /// use ballrace::{Run, scene::presets, simulate};
    /// let mut scene = presets::wheel_bearing(3000.0);
    /// scene.contact.damping = 5.0;
    /// let run = Run { duration: 1e-3, rtol: Some(1e-3), settle: Some(0.0), ..Run::default() };
    /// let out = simulate(&scene, &run).unwrap();
    /// assert!(out.warnings()[0].to_string().starts_with("accelerations are uncertain"));
    /// ```
    pub fn warnings(&self) -> Vec<Warning> {
        let of_contacts = inspect::doubts(self.stats.largest_pressure, &self.provenance.films);
        let of_slip = Doubt::film_slip(self.stats.film_slip);
        let doubts = self
            .scene
            .doubts()
            .into_iter()
            .chain(of_contacts)
            .chain(of_slip)
            .chain(Doubt::tilt(self.stats.largest_tilt))
            .chain(self.provenance.at_rest.iter().cloned());
        let defects = self.provenance.defects.iter();
        let doubts = doubts.chain(defects.clone().filter_map(|of| of.doubt(&self.scene)));
        let untouched = defects.filter_map(|of| not_touched(of, self.provenance.duration));
        [
            self.accelerations(),
            self.accuracy_missed(),
            self.shoulders(),
            self.provenance.distrust.clone().map(Warning::Instructions),
            self.undersampled(),
            self.lost_orbit(),
        ]
        .into_iter()
        .flatten()
        .chain(untouched)
        .chain(self.off_prediction())
        .chain(doubts.map(Warning::Doubtful))
        .collect()
    }

    fn accelerations(&self) -> Option<Warning> {
        let residual = self.stats.acceleration_residual?;
        let largest = if self.provenance.by_band {
            LARGEST_BY_BAND
        } else {
            LARGEST_RESIDUAL
        };
        (residual > largest).then_some(Warning::Accelerations {
            residual,
            stiff_share: self.stats.stiff_share,
            rtol: self.provenance.rtol,
        })
    }

    fn accuracy_missed(&self) -> Option<Warning> {
        let of = self.provenance.accuracy?;
        let error = of.integration_error + of.node_error.unwrap_or(0.0);
        (error > of.requested).then_some(Warning::AccuracyMissed(of))
    }

    fn shoulders(&self) -> Option<Warning> {
        let contacts = self.stats.truncated_contacts;
        let steps = self.stats.accepted;
        (contacts > 0).then_some(Warning::Shoulders { contacts, steps })
    }

    fn undersampled(&self) -> Option<Warning> {
        let (defect, line) = self.scene.highest_fault_line(self.provenance.duration)?;
        (self.fs < 2.0 * line).then(|| Warning::SamplingRate {
            fs: self.fs,
            defect: defect.to_owned(),
            line,
        })
    }

    /// Rows whose orbit speed differs from the prediction; where nothing drives the balls another warning says so.
    fn off_prediction(&self) -> impl Iterator<Item = Warning> {
        let play = self.scene.cage_links().map_or(0.0, |cage| cage.play);
        let is_off = move |of: &RowKinematics| {
            let row = &self.scene.rows[of.row];
            let pitch = PI * row.pitch_diameter / row.ball_count as f64;
            let allowed = LARGEST_LEAD + 0.5 * play / pitch;
            of.ahead().is_some_and(|share| share.abs() > allowed)
        };
        let is_driven = self.stats.orbit_slowed.is_none();
        let rows = self.provenance.kinematics.iter().copied();
        rows.filter(move |of| is_driven && is_off(of))
            .map(Warning::Kinematics)
    }

    fn lost_orbit(&self) -> Option<Warning> {
        let slowed = self.stats.orbit_slowed?;
        (slowed > LARGEST_LOSS).then_some(Warning::FreeOrbit { slowed })
    }
}

/// The warning of a defect that nothing touched.
fn not_touched(of: &Touched, duration: f64) -> Option<Warning> {
    let defect = of.name.clone();
    match (of.passes, of.touched) {
        (0, _) => Some(Warning::Unpassed { defect, duration }),
        (passes, 0) => Some(Warning::Untouched {
            defect,
            passes,
            axial_offset: of.axial_offset,
            contact_offset: of.contact_offset,
            placed: of.placed,
        }),
        _ => None,
    }
}
