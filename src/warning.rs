//! What a run that came to its end still has to say.

use serde::Serialize;

use crate::method;
use crate::signals::Signals;

/// Residual of the accelerations above which a run is warned of. Measured on the faulted wheel bearing in 140 runs
/// over slip speeds of 1e-4 to 0.1 m/s, damping of 0 to 20 s/m and rtol of 1e-7 to 1e-1: above it the error against
/// a converged run is 1.3 % and more, below it at most 0.8 % (`benches/stability_map.py`). Without the step cap an
/// undamped run with an error of 11 % stays below.
const LARGEST_RESIDUAL: f64 = 0.05;

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
    /// The fixed step that was asked for is longer than the method bears in this scene.
    FixedStep {
        /// The step \[s\].
        step: f64,
        /// The longest by which the method is stable and accurate there \[s\].
        limit: f64,
    },
}

impl Warning {
    /// What it is about: `accuracy` of the signals, or the `scene` that was asked for.
    pub fn category(&self) -> &'static str {
        match self {
            Self::Accelerations { .. } | Self::Shoulders { .. } | Self::FixedStep { .. } => {
                "accuracy"
            }
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
                 velocities. Use a max_step smaller than {step:.1e} s, or raise the friction's slip_speed",
                100.0 * residual
            ),
            Self::FixedStep { step, limit } => write!(
                f,
                "a fixed step of {step:.1e} s is longer than the {limit:.1e} s by which the method is stable and \
                 accurate in this scene. Use a smaller max_step, or keep solver.frequency_cap on"
            ),
            Self::Shoulders { contacts, steps } => write!(
                f,
                "contacts rode over a shoulder {contacts} times in {steps} steps: the part beyond it carries \
                 nothing, and the pressure at the edge is not modelled. Lower the axial load, raise the \
                 shoulders, or look at the truncated contacts"
            ),
        }
    }
}

impl Signals {
    /// Reasons to look twice; usually none.
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use ballrace::{Run, scene::presets, simulate};
    /// let mut scene = presets::wheel_bearing(3000.0);
    /// scene.contact.damping = 5.0;
    /// let run = Run { duration: 1e-3, rtol: Some(1e-3), ..Run::default() };
    /// let out = simulate(&scene, &run, &mut |_| ControlFlow::Continue(())).unwrap();
    /// assert!(out.warnings()[0].to_string().starts_with("accelerations are uncertain"));
    /// ```
    pub fn warnings(&self) -> Vec<Warning> {
        let stats = &self.stats;
        let fixed = method::is_fixed(self.scene.solver.method);
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
        let too_long = fixed_step
            .filter(|step| *step > limit)
            .map(|step| Warning::FixedStep { step, limit });
        let found = [accelerations, shoulders, too_long];
        found.into_iter().flatten().collect()
    }
}
