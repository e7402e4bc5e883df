//! Adaptive integration of a smooth-by-pieces system of ordinary differential
//! equations: by Runge–Kutta pairs, or by Adams' formulae over the previous steps.
//!
//! The module does not depend on what it integrates. Its parts are independent of each other:
//!
//! | file           | what it holds                                             |
//! |----------------|-----------------------------------------------------------|
//! | `tableau*.rs`  | methods, as data: coefficients in constants                |
//! | `method.rs`    | what the driver asks of a method                           |
//! | `adams.rs`     | Adams' predictor–corrector, linearly implicit in velocities |
//! | `blended.rs`   | the same for velocities that decay within a step           |
//! | `multistep.rs` | the previous steps, and the polynomial through their accelerations |
//! | `combine.rs`   | base + h · weighted sum of stages, in one pass             |
//! | `step.rs`      | one step of any tableau, in preallocated memory            |
//! | `norm.rs`      | tolerances and the worst group's scaled error              |
//! | `control.rs`   | error in, step-size factor out                             |
//! | `start.rs`     | the first step size                                        |
//! | `stops.rs`     | breakpoints, and how a step is fitted in front of them     |
//! | `clock.rs`     | time that does not drift over 10⁸ additions                |
//! | `dense.rs`     | an accepted step as a polynomial in time                   |
//! | `stiffness.rs` | the stiffness quotient                                     |
//! | `stats.rs`     | counts of what happened                                    |
//! | `options.rs`   | what the caller may choose                                 |
//! | `failure.rs`   | how it can end badly                                       |
//! | `driver.rs`    | the loop that joins them                                   |
//!
//! All of it is free of units: time, states and tolerances are in whatever
//! units the [`System`] uses.
//!
//! ```
//! use ballrace::integrate::{DORMAND_PRINCE, Options, System, Tolerance, integrate};
//!
//! struct Decay;
//! impl System for Decay {
//!     fn dim(&self) -> usize {
//!         1
//!     }
//!     fn rhs(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
//!         dy[0] = -y[0];
//!     }
//! }
//!
//! let tolerance = Tolerance::uniform(1, 1e-8, 1e-10)?;
//! let end = integrate(
//!     &mut Decay, &DORMAND_PRINCE, (0.0, 1.0), &[1.0], &tolerance, &Options::default(), &mut (),
//! )?;
//! assert!((end.y[0] - (-1.0_f64).exp()).abs() < 1e-7);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Source throughout: Hairer, Nørsett, Wanner, *Solving Ordinary Differential
//! Equations I*, 2nd ed., sections II.4–II.6, and volume II, section IV.2, for
//! the step-size control with memory and the stiffness quotient.

mod adams;
mod blended;
mod clock;
mod combine;
mod control;
mod dense;
mod driver;
mod failure;
mod method;
mod multistep;
mod norm;
mod options;
mod start;
mod stats;
mod step;
mod stiffness;
mod stops;
mod tableau;
mod tableau_verner;

pub use adams::Adams;
pub use control::Controller;
pub use dense::DenseStep;
pub(crate) use driver::{Integrator, other_task};
pub use driver::{Solution, integrate};
pub use failure::{Failure, FailureKind, Invalid};
pub use method::StepMethod;
pub use norm::Tolerance;
pub use options::Options;
pub use stats::StepStatistics;
pub use tableau::{DORMAND_PRINCE, Tableau};
pub use tableau_verner::VERNER;

use std::ops::ControlFlow;

/// The right-hand side of `y' = f(t, y)`.
///
/// `f` is smooth between the breakpoints given in [`Options::breakpoints`] and
/// right-continuous at them. It may answer with non-finite numbers where it is
/// not defined: the step is then rejected and tried again smaller.
pub trait System {
    /// Number of states.
    fn dim(&self) -> usize;

    /// Writes `f(t, y)` into `dy`; both slices have [`System::dim`] entries.
    ///
    /// Every entry of `dy` must be written: it holds old numbers on entry.
    fn rhs(&mut self, t: f64, y: &[f64], dy: &mut [f64]);
}

/// A second-order system that knows roughly how its accelerations answer to velocities and places.
///
/// The state is \[q, v\], each half of [`System::dim`].
pub trait LinearlyImplicit: System {
    /// Makes ready the matrix 1 − γh (∂a/∂v + ρ ∂a/∂q), with derivatives from the state `y` or one not long before. ρ is the
    /// `reach`: how far a place is corrected with its velocity \[s\].
    fn prepare(&mut self, t: f64, y: &[f64], gamma_h: f64, reach: f64);

    /// Replaces r by the solution x of matrix · x = r. Leaving r as it is makes the method explicit.
    fn solve(&mut self, r: &mut [f64]);

    /// The rate at which the fastest velocity decays, by the matrix that was made last \[1/s\].
    fn relaxation(&self) -> f64;

    /// The longest step that oscillations allow \[s\]: where steps are much shorter, velocities that decay may be what holds them so.
    fn longest(&self) -> f64;
}

/// Sees every accepted step: samples, records, or ends the run.
///
/// `()` watches nothing; a closure of the method's signature is an observer.
pub trait Observer<S> {
    /// Called once after each accepted step, in order of time.
    ///
    /// The last [`System::rhs`] call before this one was at the accepted state
    /// `(step.t1(), step.y1())`, so whatever `system` remembers of its last
    /// evaluation belongs to that state ([`Adams`]: to the
    /// state predicted, a fraction of the error away). If the step ended on a breakpoint, the
    /// call was at `(t1.next_down(), y1)`: the limit from the left.
    ///
    /// The observer may call [`System::rhs`] itself; the integrator relies on
    /// nothing that `system` remembers, and does not count those calls.
    /// [`ControlFlow::Break`] ends the run with [`Solution::interrupted`] set.
    fn accepted(
        &mut self,
        system: &mut S,
        step: &DenseStep<'_>,
        stats: &StepStatistics,
    ) -> ControlFlow<()>;
}

impl<S> Observer<S> for () {
    fn accepted(&mut self, _: &mut S, _: &DenseStep<'_>, _: &StepStatistics) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl<S, F> Observer<S> for F
where
    F: FnMut(&mut S, &DenseStep<'_>, &StepStatistics) -> ControlFlow<()>,
{
    fn accepted(
        &mut self,
        system: &mut S,
        step: &DenseStep<'_>,
        stats: &StepStatistics,
    ) -> ControlFlow<()> {
        self(system, step, stats)
    }
}
