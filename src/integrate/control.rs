//! Step-size control: an error goes in, a factor for the step comes out.

use crate::base::words::remembers;

/// Settings of the step-size controller.
///
/// With `e` the error norm (1 = just acceptable) and `e₋` that of the accepted
/// step before, the next step is the present one times
/// `safety · e^−error_exponent · e₋^memory_exponent`. The memory damps the
/// sawtooth of a plain controller where stability bounds the step.
///
/// Source: Hairer & Wanner, volume II, section IV.2; Gustafsson (1991). The
/// default exponents are 0.7/5 and 0.4/5, for a pair with a fourth-order error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Controller {
    /// Share of the predicted step that is taken; larger means fewer steps and
    /// more rejections. Default 0.9.
    pub safety: f64,
    /// Exponent of the present error. Default 0.14.
    pub error_exponent: f64,
    /// Exponent of the error before it; 0 switches the memory off. Default 0.08.
    pub memory_exponent: f64,
    /// Exponent of the error after a rejection, without memory. Default 1/5.
    pub rejection_exponent: f64,
    /// Smallest factor, and the factor after a non-finite step. Default 0.2.
    pub min_factor: f64,
    /// Largest factor. Default 10.
    pub max_factor: f64,
    /// A step that could grow by a smaller factor stays as it is: for methods that keep something of steps alike. Default 1.
    pub least_growth: f64,
    /// Errors below this are remembered as this. Default 1e-4.
    pub memory_floor: f64,
}

impl Default for Controller {
    fn default() -> Self {
        Self {
            safety: 0.9,
            error_exponent: 0.14,
            memory_exponent: 0.08,
            rejection_exponent: 0.2,
            min_factor: 0.2,
            max_factor: 10.0,
            least_growth: 1.0,
            memory_floor: 1e-4,
        }
    }
}

impl Controller {
    /// The default for an embedded solution of another order: its exponents times 5/(order + 1).
    #[must_use]
    pub fn for_order(error_order: u32) -> Self {
        let default = Self::default();
        let scale = 5.0 / f64::from(error_order + 1);
        Self {
            error_exponent: scale * default.error_exponent,
            memory_exponent: scale * default.memory_exponent,
            rejection_exponent: scale * default.rejection_exponent,
            ..default
        }
    }

    /// Whether factors can follow from it.
    pub(super) fn is_usable(&self) -> bool {
        let positive = [
            self.safety,
            self.min_factor,
            self.max_factor,
            self.least_growth,
            self.memory_floor,
        ];
        let exponents = [
            self.error_exponent,
            self.memory_exponent,
            self.rejection_exponent,
        ];
        let is_finite = |x: &f64| x.is_finite();
        positive.iter().all(|x| *x > 0.0 && x.is_finite()) && exponents.iter().all(is_finite)
    }
}

/// The controller at work: settings and what it remembers.
#[derive(Debug)]
pub(super) struct Control {
    settings: Controller,
    memory: f64,
    just_rejected: bool,
}

impl Control {
    pub(super) fn new(settings: Controller) -> Self {
        Self {
            settings,
            memory: settings.memory_floor,
            just_rejected: false,
        }
    }

    /// Factor after an accepted step; at most 1 right after a rejection.
    ///
    /// The error of a step `shortened` to meet a stop is small for that reason
    /// alone. It is not remembered: after the step size is restored it would
    /// look like a sudden growth of the error.
    pub(super) fn accepted(&mut self, error: f64, shortened: bool) -> f64 {
        let s = &self.settings;
        let factor = s.safety * error.powf(-s.error_exponent) * self.memory.powf(s.memory_exponent);
        let most = if self.just_rejected {
            1.0
        } else {
            s.max_factor
        };
        self.just_rejected = false;
        if !shortened {
            self.memory = error.max(s.memory_floor);
        }
        if (1.0..s.least_growth).contains(&factor) {
            return 1.0;
        }
        factor.max(s.min_factor).min(most)
    }

    /// Factor after a rejected step; an infinite error gives the smallest.
    pub(super) fn rejected(&mut self, error: f64) -> f64 {
        let s = &self.settings;
        self.just_rejected = true;
        let factor = s.safety * error.powf(-s.rejection_exponent);
        factor.max(s.min_factor).min(1.0)
    }
}

remembers!(Control: memory, just_rejected; but settings);

/// The truth is the formula above, evaluated by hand.
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formula_with_memory_and_floor() {
        let settings = Controller::default();
        let mut control = Control::new(settings);
        let first = control.accepted(0.5, false);
        let expected = 0.9 * 0.5_f64.powf(-0.14) * 1e-4_f64.powf(0.08);
        assert!((first - expected).abs() < 1e-15);
        let second = control.accepted(1e-3, false);
        let expected = 0.9 * 1e-3_f64.powf(-0.14) * 0.5_f64.powf(0.08);
        assert!((second - expected).abs() < 1e-15);
        control.accepted(1e-9, false);
        let expected = 0.9 * 1e-4_f64.powf(0.08);
        assert!((control.accepted(1.0, false) - expected).abs() < 1e-15);
    }

    #[test]
    fn clamped_at_both_ends() {
        let settings = Controller::default();
        let mut control = Control::new(settings);
        assert_eq!(control.accepted(0.0, false), 10.0);
        assert_eq!(control.rejected(1e9), 0.2);
        assert_eq!(control.rejected(f64::INFINITY), 0.2);
        let near = 0.9 * 1.5_f64.powf(-0.2);
        assert!((control.rejected(1.5) - near).abs() < 1e-15);
    }

    #[test]
    fn no_growth_right_after_a_rejection_only() {
        let settings = Controller::default();
        let mut control = Control::new(settings);
        control.rejected(3.0);
        assert_eq!(control.accepted(1e-9, false), 1.0);
        assert!(control.accepted(1e-9, false) > 1.0);
    }

    #[test]
    fn steps_stay_that_could_grow_by_little() {
        let settings = Controller {
            least_growth: 1.2,
            memory_exponent: 0.0,
            ..Controller::default()
        };
        let mut control = Control::new(settings);
        let error = |factor: f64| (0.9 / factor).powf(1.0 / 0.14);
        assert_eq!(control.accepted(error(1.19), false), 1.0);
        assert!((control.accepted(error(1.21), false) - 1.21).abs() < 1e-12);
        assert!((control.accepted(error(0.95), false) - 0.95).abs() < 1e-12);
    }

    #[test]
    fn a_shortened_step_leaves_the_memory_alone() {
        let settings = Controller::default();
        let mut control = Control::new(settings);
        control.accepted(0.5, false);
        control.accepted(1e-8, true);
        let expected = 0.9 * 0.5_f64.powf(0.08);
        assert!((control.accepted(1.0, false) - expected).abs() < 1e-15);
    }
}
