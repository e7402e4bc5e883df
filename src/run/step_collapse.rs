//! Detects a collapse of the step size.

use crate::base::words::remembers;
use crate::model::Model;

/// Steps over which a collapse is seen.
const PATIENCE: usize = 1000;
/// Share of the contacts' 1/ω, or of a smaller largest step, below which steps lead nowhere: at 1e-5 a
/// millisecond takes more than ten million steps.
const HOPELESS: f64 = 1e-5;

/// Sees when steps are too small for the run to end in a useful time.
#[derive(Debug, Clone)]
pub(crate) struct StepCollapse {
    limit: f64,
    steps: usize,
    /// Time that they took the run on \[s\].
    progress: f64,
}

impl StepCollapse {
    pub fn new(model: &Model, max_step: f64) -> Self {
        Self {
            limit: HOPELESS * max_step.min(1.0 / model.scales.frequency),
            steps: 0,
            progress: 0.0,
        }
    }

    /// Whether the run is no longer worth waiting for after an accepted step.
    pub fn after(&mut self, step: f64) -> bool {
        self.steps += 1;
        self.progress += step;
        if self.steps < PATIENCE {
            return false;
        }
        let collapsed = self.progress < PATIENCE as f64 * self.limit;
        (self.steps, self.progress) = (0, 0.0);
        collapsed
    }
}

remembers!(StepCollapse: steps, progress; but limit);
