//! Interface of a method: what the driver asks of it.

use super::System;
use super::control::Controller;
use super::failure::Invalid;
use super::step::Stepper;
use super::tableau::Tableau;

/// Keeps [`StepMethod`] to the methods of this crate, so that the workspace of a step may change.
pub trait Sealed {}

impl Sealed for Tableau {}

/// A way to take one step; the driver does the rest.
///
/// Its implementations are the explicit [`Tableau`] for any system, and
/// the multistep [`Adams`](super::Adams) for systems with stiff velocities. There can be no others: a method of one's own is a
/// [`Tableau`].
pub trait StepMethod<S>: Sealed {
    /// Weights, error weights and dense output.
    fn tableau(&self) -> &Tableau;

    /// How the step follows the error.
    fn controller(&self) -> Controller {
        Controller::for_order(self.tableau().error_order)
    }

    /// Whether the method builds on the steps behind.
    fn is_multistep(&self) -> bool {
        false
    }

    /// Refuses a number of states that it does not take, and steps without an error estimate, unless they are fixed.
    ///
    /// # Errors
    /// What is wrong.
    fn check(&self, dim: usize, fixed: bool) -> Result<(), Invalid>;

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
        t: f64,
        t1: f64,
        h: f64,
        latest: f64,
    ) -> Result<(), usize>;
}

impl<S: System> StepMethod<S> for Tableau {
    fn tableau(&self) -> &Tableau {
        self
    }

    fn check(&self, _dim: usize, fixed: bool) -> Result<(), Invalid> {
        if !self.is_whole() {
            return Err(Invalid(
                "the coefficients of the method do not fit its stages",
            ));
        }
        if !fixed && self.b_err.iter().all(|weight| *weight == 0.0) {
            return Err(Invalid(
                "a method without an error estimate needs fixed_step",
            ));
        }
        Ok(())
    }

    fn attempt(
        &self,
        work: &mut Stepper<'_>,
        system: &mut S,
        t: f64,
        t1: f64,
        h: f64,
        latest: f64,
    ) -> Result<(), usize> {
        work.attempt(system, t, t1, h, latest)
    }
}
