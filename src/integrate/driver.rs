//! The loop that joins the parts.

use serde::Serialize;

use std::ops::ControlFlow;

use super::clock::{Clock, ulp};
use super::control::Control;
use super::failure::{Failure, FailureKind, Invalid};
use super::method::StepMethod;
use super::norm::{Norm, Tolerance, Worst};
use super::options::Options;
use super::start::first_step;
use super::stats::StepStatistics;
use super::step::Stepper;
use super::stops::{Plan, Stops};
use super::{Observer, System};

/// A step below this many ulps of the time is too small.
const SMALLEST_ULPS: f64 = 16.0;

/// Where an integration ended.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Solution {
    /// The time reached: the end of the span unless interrupted.
    pub t: f64,
    /// The state at that time.
    pub y: Vec<f64>,
    /// What it has cost.
    pub stats: StepStatistics,
    /// Whether the observer ended it.
    pub interrupted: bool,
}

/// Integrates `system` from `y0` over `t_span`, forwards in time.
///
/// The step size follows the error and stops for nothing but breakpoints and
/// the end: output at given times is the observer's, by
/// [`DenseStep::interpolate`](super::DenseStep::interpolate). A stop closer than
/// two steps is reached in two equal ones, after which the step size from before
/// is taken up again.
///
/// # Errors
/// A [`Failure`], with the last accepted time:
/// * [`FailureKind::Invalid`] — the lengths of `y0` or `tolerance` are not
///   [`System::dim`], the span is not finite or runs backwards, `options`
///   hold a step or a breakpoint that is no such thing, or the method cannot do it:
///   a [`Tableau`](super::Tableau) without an error estimate takes fixed steps only, one whose
///   coefficients are incomplete none, and [`Adams`](super::Adams) has states \[q, v\], an even number;
/// * [`FailureKind::NonFinite`] — the derivative at the start or after a
///   breakpoint is not finite, or [`Options::max_rejections`] ever smaller steps
///   in a row met a non-finite number or an implicit stage without a solution;
/// * [`FailureKind::TooSmall`] — the step fell below 16 ulps of the time.
pub fn integrate<S: System, M: StepMethod<S>, O: Observer<S>>(
    system: &mut S,
    method: &M,
    t_span: (f64, f64),
    y0: &[f64],
    tolerance: &Tolerance,
    options: &Options,
    observer: &mut O,
) -> Result<Solution, Failure> {
    let tableau = method.tableau();
    let (t0, end) = t_span;
    check(system.dim(), t_span, y0, tolerance)
        .and_then(|()| options.check())
        .and_then(|()| method.check(system.dim(), options.fixed_step.is_some()))
        .map_err(|reason| Failure::invalid(t0, reason))?;

    let mut clock = Clock::at(t0);
    let mut stops = Stops::new(&options.breakpoints, t0, end);
    let mut norm = Norm::new(tolerance);
    let mut control = Control::new(&options.controller);
    let mut work = Stepper::new(tableau, method.is_multistep(), y0);
    let mut stats = StepStatistics::default();
    let mut interrupted = false;

    let not_finite = |time, i| fail(time, 0.0, tolerance.group_of(i), FailureKind::NonFinite);
    work.restart(system, t0).map_err(|i| not_finite(t0, i))?;

    let fixed = options.fixed_step.is_some();
    let ceiling = options
        .fixed_step
        .map_or(options.max_step, |_| f64::INFINITY);
    // The step size that the error alone asks for.
    let given = options.fixed_step.or(options.first_step);
    let mut free = given.unwrap_or_else(|| {
        let ahead = (t0, stops.next());
        let order = tableau.error_order;
        first_step(system, &mut work, &mut norm, ahead, ceiling, order).max(SMALLEST_ULPS * ulp(t0))
    });
    let mut failures = 0;
    let mut group = 0;

    while !interrupted && clock.now() < end {
        let (t, stop) = (clock.now(), stops.next());
        let plan = Plan::new(t, stop.time, free, ceiling);
        if !plan.lands && plan.h < SMALLEST_ULPS * ulp(t) {
            return Err(fail(t, plan.h, group, FailureKind::TooSmall));
        }

        let next = if plan.lands {
            Clock::at(stop.time)
        } else {
            clock.advanced(plan.h)
        };
        let at = (t, next.now());
        let error = match method.attempt(&mut work, system, at, plan.h, stop.latest()) {
            Ok(()) => norm.measure(&work.y, &work.y1, &work.error),
            Err(i) => no_error(tolerance.group_of(i)),
        };
        let finite = error.value.is_finite();
        group = error.group;
        if !finite || !(fixed || error.value <= 1.0) {
            stats.rejected += 1;
            // A finite error has no such limit: at a jump of the derivative many small steps back are needed.
            failures = if finite { 0 } else { failures + 1 };
            if fixed || failures >= options.max_rejections {
                return Err(fail(t, plan.h, group, FailureKind::NonFinite));
            }
            free = plan.h * control.rejected(error.value);
            continue;
        }

        failures = 0;
        if !fixed {
            free = after(&plan, free, control.accepted(error.value, plan.shortened));
        }
        let stiffness = work.stiffness(plan.h, norm.weights());
        stats.accept(tableau, t, &plan, stiffness);
        stats.nfev = work.calls;

        let step = work.dense(t, next.now(), plan.h);
        interrupted = observer.accepted(system, &step, &stats) == ControlFlow::Break(());
        work.advance();
        clock = next;

        if plan.lands {
            stops.pass();
            if stop.jumps && !interrupted && clock.now() < end {
                work.restart(system, stop.time)
                    .map_err(|i| not_finite(stop.time, i))?;
            }
        }
    }
    stats.nfev = work.calls;
    Ok(Solution {
        t: clock.now(),
        y: work.y,
        stats,
        interrupted,
    })
}

fn fail(time: f64, step: f64, group: usize, kind: FailureKind) -> Failure {
    Failure {
        time,
        step,
        group,
        kind,
    }
}

/// The error of a step that has none, since a group of states was not finite.
fn no_error(group: usize) -> Worst {
    Worst {
        value: f64::INFINITY,
        group,
    }
}

/// The step size that the error asks for after an accepted step, from that before it and the controller's factor.
fn after(plan: &Plan, free: f64, factor: f64) -> f64 {
    let wish = plan.h * factor;
    // A shortened step is no reason to forget the size from before it.
    let restore = plan.shortened && factor >= 1.0;
    if restore { free.max(wish) } else { wish }
}

/// Whether the pieces of the problem fit each other.
fn check(
    dim: usize,
    (t0, end): (f64, f64),
    y0: &[f64],
    tolerance: &Tolerance,
) -> Result<(), Invalid> {
    if y0.len() != dim || tolerance.dim() != dim {
        return Err(Invalid("state, tolerance and system differ in length"));
    }
    if !(t0.is_finite() && end.is_finite() && t0 <= end) {
        return Err(Invalid("the time span must be finite and run forwards"));
    }
    Ok(())
}
