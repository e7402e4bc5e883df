//! When the step collapses.

use crate::model::Model;

/// Steps in a row below the limit that make a collapse.
const PATIENCE: usize = 1000;
/// Share of the contacts' 1/ω, or of a smaller largest step, below which a step leads nowhere: at 1e-5 a
/// millisecond takes more than ten million steps.
const HOPELESS: f64 = 1e-5;

/// Counts steps that are too small for the run to end in a useful time.
pub(crate) struct StepCollapse {
    limit: f64,
    steps: usize,
}

impl StepCollapse {
    pub fn new(model: &Model, max_step: f64) -> Self {
        Self {
            limit: HOPELESS * max_step.min(1.0 / model.scales.frequency),
            steps: 0,
        }
    }

    /// Whether the run is no longer worth waiting for after an accepted step.
    pub fn after(&mut self, step: f64) -> bool {
        self.steps = if step < self.limit { self.steps + 1 } else { 0 };
        self.steps >= PATIENCE
    }
}
