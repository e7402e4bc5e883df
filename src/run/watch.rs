//! Observers of a run's steps, and what they report.

use std::ops::ControlFlow;

use crate::dynamics::Dynamics;
use crate::integrate::DenseStep;
use crate::signals::Recorder;

/// How often progress is reported \[s\].
pub(super) const REPORT_EVERY: f64 = 0.02;

/// Sees the first state of a run and every accepted step, on the integrator's clock.
pub(crate) trait StepWatch: Send {
    fn first(&mut self, dynamics: &mut Dynamics<'_>, y: &[f64]);

    /// A step as far as a time \[s\]; what follows of it is seen later. Breaks off to end the stretch.
    fn step(
        &mut self,
        dynamics: &mut Dynamics<'_>,
        step: &DenseStep<'_>,
        until: f64,
    ) -> ControlFlow<()>;

    /// Time until which it wants to see steps of a stretch with this end \[s\].
    fn until(&self, end: f64) -> f64 {
        end
    }

    /// Ends the watch: there are no more steps. Breaks off where what is left is not wanted.
    fn finish(&mut self) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl StepWatch for Recorder<'_> {
    fn first(&mut self, dynamics: &mut Dynamics<'_>, y: &[f64]) {
        Recorder::first(self, dynamics, 0.0, y);
    }

    fn step(
        &mut self,
        dynamics: &mut Dynamics<'_>,
        step: &DenseStep<'_>,
        until: f64,
    ) -> ControlFlow<()> {
        Recorder::step(self, dynamics, step, until)
    }

    fn until(&self, end: f64) -> f64 {
        Recorder::until(self, end)
    }

    fn finish(&mut self) -> ControlFlow<()> {
        Recorder::finish(self)
    }
}

/// Question of a motion to whoever drives it: whether it may go on, by the share of the interval that is done.
pub(crate) type Progress<'a> = &'a mut dyn FnMut(f64) -> ControlFlow<()>;
