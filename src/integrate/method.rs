//! What the driver asks of a method.

use super::System;
use super::control::Controller;
use super::step::Stepper;
use super::tableau::Tableau;

/// A way to take one step; the driver does the rest.
///
/// Its implementations are the explicit [`Tableau`] for any system, and
/// the multistep [`Adams`](super::Adams) for systems with stiff velocities.
pub trait StepMethod<S> {
    /// Weights, error weights and dense output.
    fn tableau(&self) -> &Tableau;

    /// How the step follows the error.
    fn controller(&self) -> Controller {
        Controller::for_order(self.tableau().error_order)
    }

    /// Whether it builds on the steps behind.
    fn is_multistep(&self) -> bool {
        false
    }

    /// Tries a step `h` from `(t, y)` to `t1`: fills the new state, the derivatives and the error.
    ///
    /// No evaluation sees a time beyond `latest`, and the last one is at the new state.
    ///
    /// # Errors
    /// The index of the first state that is not finite.
    fn attempt(
        &self,
        work: &mut Stepper<'_>,
        system: &mut S,
        span: (f64, f64),
        h: f64,
        latest: f64,
    ) -> Result<(), usize>;
}

impl<S: System> StepMethod<S> for Tableau {
    fn tableau(&self) -> &Tableau {
        self
    }

    fn attempt(
        &self,
        work: &mut Stepper<'_>,
        system: &mut S,
        span: (f64, f64),
        h: f64,
        latest: f64,
    ) -> Result<(), usize> {
        work.attempt(system, span, h, latest)
    }
}
