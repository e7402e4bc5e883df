//! Options that the caller may choose.

use super::control::Controller;
use super::failure::Invalid;

/// Settings of an integration. Times are in the system's unit of time.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// First step to try. Default `None`: found from the derivatives at the
    /// start, for one more evaluation.
    pub first_step: Option<f64>,
    /// Largest step. It also bounds what the error estimate can step over
    /// unseen. Default infinite.
    pub max_step: f64,
    /// A step size to keep, without error control and regardless of
    /// `first_step` and `max_step`; only the stops shorten it. A non-finite
    /// number is then a failure at once. For convergence studies. Default
    /// `None`.
    pub fixed_step: Option<f64>,
    /// Times at which the right-hand side may jump or have a kink. A step ends
    /// on each exactly, no stage of it sees that time, and the derivative is
    /// evaluated anew there. In any order; those outside the span are ignored.
    /// Default none.
    pub breakpoints: Vec<f64>,
    /// Steps in a row that meet a non-finite number and make a failure. Default 10.
    pub max_rejections: usize,
    /// Step-size control.
    pub controller: Controller,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            first_step: None,
            max_step: f64::INFINITY,
            fixed_step: None,
            breakpoints: Vec::new(),
            max_rejections: 10,
            controller: Controller::default(),
        }
    }
}

impl Options {
    /// Whether the settings make sense at all.
    pub(super) fn check(&self) -> Result<(), Invalid> {
        let step = |h: Option<f64>| h.is_none_or(|h| h > 0.0 && h.is_finite());
        if !step(self.first_step) || !step(self.fixed_step) {
            return Err(Invalid("a step size must be positive and finite"));
        }
        if self.max_step.is_nan() || self.max_step <= 0.0 {
            return Err(Invalid("the largest step must be positive"));
        }
        if !self.controller.is_usable() {
            return Err(Invalid(
                "the controller's numbers must be finite, its factors and safety positive",
            ));
        }
        if !self.breakpoints.iter().all(|t| t.is_finite()) {
            return Err(Invalid("breakpoints must be finite"));
        }
        Ok(())
    }
}
