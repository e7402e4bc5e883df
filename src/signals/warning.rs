//! What a run that came to its end still has to say.

use serde::Serialize;

use crate::scene::Doubt;
use crate::signals::Signals;
use crate::simd::Distrust;
use crate::told::duration;
use crate::touched::Touched;

/// Residual of the accelerations above which a run is warned of. Measured on the faulted wheel bearing in 140 runs
/// over slip speeds of 1e-4 to 0.1 m/s, damping of 0 to 20 s/m and rtol of 1e-7 to 1e-1: above it the error against
/// a converged run is 1.3 % and more, below it at most 0.8 % (`benches/stability_map.py`). Without the step cap an
/// undamped run with an error of 11 % stays below.
const LARGEST_RESIDUAL: f64 = 0.05;

/// Share of the orbit's rate above which its loss is warned of: with friction balls slip by less than that.
const LARGEST_LOSS: f64 = 0.005;

/// A reason to look twice at the signals of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Warning {
    /// The recorded accelerations and the recorded motion do not belong together: the steps do not resolve the
    /// contacts, however small the error of the states.
    Accelerations {
        /// [`crate::Statistics::acceleration_residual`].
        residual: f64,
        /// [`crate::Statistics::stiff_share`].
        stiff_share: f64,
        /// Tolerance of the run.
        rtol: f64,
        /// The step of a method of fixed steps, which has no tolerance \[s\].
        fixed_step: Option<f64>,
    },
    /// Contacts reached beyond a shoulder, where the model has no race.
    Shoulders {
        /// [`crate::Statistics::truncated_contacts`].
        contacts: usize,
        /// Accepted steps.
        steps: usize,
    },
    /// This processor computes wrongly at an instruction set that it says it has; a narrower one was used.
    Instructions(Distrust),
    /// The line of a defect lies above half the sampling rate.
    SamplingRate {
        /// Sampling rate \[Hz\].
        fs: f64,
        /// The defect.
        defect: String,
        /// Its first line at the highest speed of the run: BPFO, BPFI or twice BSF \[Hz\].
        line: f64,
    },
    /// A number of the scene, or what follows from it, that no bearing is likely to have; a column that cannot change.
    Doubtful(Doubt),
    /// Balls passed a defect, and no contact was ever loaded within it.
    Untouched {
        /// [`crate::Touched::name`].
        defect: String,
        /// [`crate::Touched::passes`].
        passes: usize,
        /// [`crate::Touched::axial_offset`].
        axial_offset: f64,
        /// [`crate::Touched::contact_offset`].
        contact_offset: Option<f64>,
    },
    /// No ball passed a defect: of its effect the run shows nothing.
    Unpassed {
        /// [`crate::Touched::name`].
        defect: String,
        /// Simulated time \[s\].
        duration: f64,
    },
    /// The fixed step that was asked for is longer than the method bears in this scene.
    FixedStep {
        /// The step \[s\].
        step: f64,
        /// The longest by which the method is stable and accurate there \[s\].
        limit: f64,
    },
    /// Nothing drives the balls along their orbit, and they have lost some of its rate.
    FreeOrbit {
        /// [`crate::Statistics::orbit_slowed`].
        slowed: f64,
    },
}

impl Warning {
    /// What it is about: `accuracy` of the signals, or the `scene` that was asked for.
    pub fn category(&self) -> &'static str {
        match self {
            Self::Accelerations { .. }
            | Self::Shoulders { .. }
            | Self::Instructions(_)
            | Self::FixedStep { .. } => "accuracy",
            Self::SamplingRate { .. }
            | Self::Doubtful(_)
            | Self::Untouched { .. }
            | Self::Unpassed { .. }
            | Self::FreeOrbit { .. } => "scene",
        }
    }
}

impl std::fmt::Display for Warning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Accelerations {
                residual,
                stiff_share,
                rtol,
                fixed_step: None,
            } => write!(
                f,
                "accelerations are uncertain by about {:.0} %: they differ that much from the derivative of the \
                 velocities; {:.0} % of the steps stood at the stability limit (rtol = {rtol:e}). Use a smaller \
                 rtol, keep solver.frequency_cap on, or raise the friction's slip_speed",
                100.0 * residual,
                100.0 * stiff_share
            ),
            Self::Accelerations {
                residual,
                fixed_step: Some(step),
                ..
            } => write!(
                f,
                "accelerations are uncertain by about {:.0} %: they differ that much from the derivative of the \
                 velocities. Use a max_step smaller than {}, or raise the friction's slip_speed",
                100.0 * residual,
                duration(*step)
            ),
            Self::FixedStep { step, limit } => write!(
                f,
                "a fixed step of {} is longer than the {} by which the method is stable and \
                 accurate in this scene. Use a smaller max_step, or keep solver.frequency_cap on",
                duration(*step),
                duration(*limit)
            ),
            Self::Shoulders { contacts, steps } => write!(
                f,
                "contacts rode over a shoulder {contacts} times in {steps} steps: the part beyond it carries \
                 nothing, and the pressure at the edge is not modelled. Lower the axial load, raise the \
                 shoulders, or look at the truncated contacts"
            ),
            Self::Instructions(Distrust {
                instructions,
                primitive,
                used,
            }) => write!(
                f,
                "this processor offers the instruction set {instructions}, but its `{primitive}` gives wrong \
                 results; the run used {used}. Please report it, with the processor's name"
            ),
            Self::SamplingRate { fs, defect, line } => write!(
                f,
                "fs = {fs} Hz shows nothing of defects.{defect}: its line, at {line:.1} Hz, lies above fs/2. Use an \
                 fs well above {:.0} Hz",
                2.0 * line
            ),
            Self::Doubtful(doubt) => doubt.fmt(f),
            Self::Untouched {
                defect,
                passes,
                axial_offset,
                contact_offset: Some(place),
            } => write!(
                f,
                "defect {defect:?} was never touched: balls passed it {passes} times, but contacts ran at \
                 {:.3} mm and its middle lies at {:.3} mm (axial_offset); give \"contact\" to place it where \
                 they run at equilibrium, or a greater length",
                1e3 * place,
                1e3 * axial_offset
            ),
            Self::Untouched { defect, passes, .. } => write!(
                f,
                "defect {defect:?} was never touched: balls passed it {passes} times, but none was loaded there; \
                 move it by its angle, or change the loads"
            ),
            Self::Unpassed { defect, duration } => write!(
                f,
                "no ball passed defect {defect:?} in {duration} s: the signals show nothing of it; simulate for \
                 longer, or move it by its angle"
            ),
            Self::FreeOrbit { slowed } => write!(
                f,
                "nothing drives the balls along their orbit, since contacts have no friction: they lost {:.1} % of its rate, \
                 and fault frequencies moved with them. Give the scene a friction, or approximations.rolling, which keeps the \
                 orbit kinematic",
                100.0 * slowed
            ),
        }
    }
}

impl Signals {
    /// Reasons to look twice; usually none.
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
        let stats = &self.stats;
        let fixed = self.scene.solver.method.is_fixed();
        let fixed_step = self.provenance.max_step.filter(|_| fixed);
        let limit = self.provenance.step_limit;
        let accelerations = stats
            .acceleration_residual
            .filter(|residual| *residual > LARGEST_RESIDUAL)
            .map(|residual| Warning::Accelerations {
                residual,
                stiff_share: stats.stiff_share,
                rtol: self.provenance.rtol,
                fixed_step,
            });
        let shoulders = (stats.truncated_contacts > 0).then_some(Warning::Shoulders {
            contacts: stats.truncated_contacts,
            steps: stats.accepted,
        });
        let unheard = self
            .scene
            .highest_fault_line(self.provenance.duration)
            .filter(|(_, line)| self.fs < 2.0 * line)
            .map(|(defect, line)| Warning::SamplingRate {
                fs: self.fs,
                defect: defect.to_owned(),
                line,
            });
        let instructions = self.provenance.distrust.map(Warning::Instructions);
        let pressure = Doubt::pressure(stats.largest_pressure);
        let doubts = self.scene.doubts().into_iter().chain(pressure);
        let defects = self.provenance.defects.iter();
        let untouched = defects.filter_map(|of| not_touched(of, self.provenance.duration));
        let too_long = fixed_step
            .filter(|step| *step > limit)
            .map(|step| Warning::FixedStep { step, limit });
        let orbit = stats
            .orbit_slowed
            .filter(|slowed| *slowed > LARGEST_LOSS)
            .map(|slowed| Warning::FreeOrbit { slowed });
        [
            accelerations,
            shoulders,
            too_long,
            instructions,
            unheard,
            orbit,
        ]
        .into_iter()
        .flatten()
        .chain(untouched)
        .chain(doubts.map(Warning::Doubtful))
        .collect()
    }
}

/// What is to be said of a defect that nothing touched.
fn not_touched(of: &Touched, duration: f64) -> Option<Warning> {
    let defect = of.name.clone();
    match (of.passes, of.touched) {
        (0, _) => Some(Warning::Unpassed { defect, duration }),
        (passes, 0) => Some(Warning::Untouched {
            defect,
            passes,
            axial_offset: of.axial_offset,
            contact_offset: of.contact_offset,
        }),
        _ => None,
    }
}
