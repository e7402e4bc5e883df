//! What a run that came to its end still has to say.

use serde::Serialize;

use crate::signals::Signals;

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
    },
    /// Contacts reached beyond a shoulder, where the model has no race.
    Shoulders {
        /// [`crate::Statistics::truncated_contacts`].
        contacts: usize,
        /// Accepted steps.
        steps: usize,
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
            Self::Accelerations { .. } | Self::Shoulders { .. } => "accuracy",
            Self::FreeOrbit { .. } => "scene",
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
            } => write!(
                f,
                "accelerations are uncertain by about {:.0} %: they differ that much from the derivative of the \
                 velocities; {:.0} % of the steps stood at the stability limit (rtol = {rtol:e}). Use a smaller \
                 rtol, keep solver.frequency_cap on, or raise the friction's slip_speed",
                100.0 * residual,
                100.0 * stiff_share
            ),
            Self::Shoulders { contacts, steps } => write!(
                f,
                "contacts rode over a shoulder {contacts} times in {steps} steps: the part beyond it carries \
                 nothing, and the pressure at the edge is not modelled. Lower the axial load, raise the \
                 shoulders, or look at the truncated contacts"
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
        let accelerations = stats
            .acceleration_residual
            .filter(|residual| *residual > LARGEST_RESIDUAL)
            .map(|residual| Warning::Accelerations {
                residual,
                stiff_share: stats.stiff_share,
                rtol: self.provenance.rtol,
            });
        let shoulders = (stats.truncated_contacts > 0).then_some(Warning::Shoulders {
            contacts: stats.truncated_contacts,
            steps: stats.accepted,
        });
        let orbit = stats
            .orbit_slowed
            .filter(|slowed| *slowed > LARGEST_LOSS)
            .map(|slowed| Warning::FreeOrbit { slowed });
        let all = accelerations.into_iter().chain(shoulders);
        all.chain(orbit).collect()
    }
}
