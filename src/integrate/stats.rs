//! Counts of what happened.

use serde::{Deserialize, Serialize};

use super::stops::Plan;
use super::tableau::Tableau;
use crate::base::words::remembers;

/// Share of the stability limit above which a step counts as stiff: 3.25 for
/// Dormand–Prince, as in Hairer's program.
const STIFF_SHARE: f64 = 3.25 / 3.3066;

/// Effort of an integration so far, and what it has met.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct StepStatistics {
    /// Steps accepted.
    pub accepted: usize,
    /// Steps rejected, for their error or for a non-finite number.
    pub rejected: usize,
    /// Evaluations of the right-hand side by the integrator.
    pub nfev: usize,
    /// The smallest accepted step, leaving out those that were shortened only
    /// to land on a breakpoint or the end. Infinite if there was none.
    pub smallest_step: f64,
    /// The time at which the smallest step began; NaN if there was none.
    pub smallest_step_time: f64,
    /// The largest accepted step.
    pub largest_step: f64,
    /// Accepted steps whose stiffness quotient was near the stability limit
    /// (above 3.25 for Dormand–Prince): stability, not accuracy, held the step.
    pub stiff: usize,
    /// Accepted steps that the largest allowed step limited.
    pub capped: usize,
}

impl Default for StepStatistics {
    fn default() -> Self {
        Self {
            accepted: 0,
            rejected: 0,
            nfev: 0,
            smallest_step: f64::INFINITY,
            smallest_step_time: f64::NAN,
            largest_step: 0.0,
            stiff: 0,
            capped: 0,
        }
    }
}

impl StepStatistics {
    /// Share of the accepted steps that were stiff, 0 to 1; 0 without steps.
    #[must_use]
    pub fn share_stiff(&self) -> f64 {
        self.stiff as f64 / self.accepted.max(1) as f64
    }

    /// Adds those of the integration that went on from here.
    pub fn merge(&mut self, next: &Self) {
        if next.smallest_step < self.smallest_step {
            self.smallest_step = next.smallest_step;
            self.smallest_step_time = next.smallest_step_time;
        }
        self.largest_step = self.largest_step.max(next.largest_step);
        self.accepted += next.accepted;
        self.rejected += next.rejected;
        self.nfev += next.nfev;
        self.stiff += next.stiff;
        self.capped += next.capped;
    }

    /// Counts an accepted step that began at `t`.
    pub(super) fn accept(&mut self, tableau: &Tableau, t: f64, plan: &Plan, quotient: f64) {
        self.accepted += 1;
        self.largest_step = self.largest_step.max(plan.h);
        if !plan.shortened && plan.h < self.smallest_step {
            self.smallest_step = plan.h;
            self.smallest_step_time = t;
        }
        self.stiff += usize::from(quotient > STIFF_SHARE * tableau.stability_limit);
        self.capped += usize::from(plan.capped);
    }
}

remembers!(StepStatistics: accepted, rejected, nfev, smallest_step, smallest_step_time, largest_step, stiff, capped);
