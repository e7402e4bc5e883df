//! The loop that joins the parts, and what it remembers between two steps.

use serde::Serialize;

use super::clock::{Clock, ulp};
use super::control::Control;
use super::failure::{Failure, FailureKind, Invalid};
use super::method::StepMethod;
use super::norm::{Norm, Tolerance, Worst};
use super::options::Options;
use super::start::first_step;
use super::stats::StepStatistics;
use super::step::Stepper;
use super::stops::{Plan, Stop, Stops};
use super::tableau::Tableau;
use super::{Observer, System};
use crate::base::words::{Remembered, Words, remembers};

/// A step below this many ulps of the time is too small.
const SMALLEST_ULPS: f64 = 16.0;

/// The end of an integration.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Solution {
    /// The time reached: the end of the span unless interrupted.
    pub t: f64,
    /// The state at that time.
    pub y: Vec<f64>,
    /// Effort and events of the integration.
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
///   a [`Tableau`] without an error estimate takes fixed steps only, one whose
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
    let mut integrator = Integrator::begin(system, method, t_span, y0, tolerance, options)?;
    let interrupted = integrator.run(system, method, observer)?;
    Ok(integrator.solution(interrupted))
}

/// An integration that stands after any of its steps, and goes on from there as if it had not stood.
#[derive(Debug)]
pub(crate) struct Integrator<'a> {
    tableau: &'a Tableau,
    tolerance: &'a Tolerance,
    stops: Stops,
    norm: Norm<'a>,
    control: Control,
    work: Stepper<'a>,
    clock: Clock,
    end: f64,
    fixed: bool,
    ceiling: f64,
    max_rejections: usize,
    /// The step size that the error alone asks for.
    free: f64,
    failures: usize,
    group: usize,
    /// The last step, as long as the next one does not begin at its end.
    accepted: Option<Accepted>,
    stats: StepStatistics,
}

/// A step that was accepted.
#[derive(Debug, Clone, Copy, Default)]
struct Accepted {
    h: f64,
    /// The clock at its end.
    end: Clock,
    /// Whether the step ends on a stop.
    lands: bool,
}

impl<'a> Integrator<'a> {
    /// The integration before its first step.
    ///
    /// # Errors
    /// As [`integrate`], of the start.
    pub fn begin<S: System, M: StepMethod<S>>(
        system: &mut S,
        method: &'a M,
        t_span: (f64, f64),
        y0: &[f64],
        tolerance: &'a Tolerance,
        options: &Options,
    ) -> Result<Self, Failure> {
        let mut made = Self::unbegun(system.dim(), method, t_span, y0, tolerance, options)?;
        let (t0, _) = t_span;
        let work = &mut made.work;
        work.restart(system, t0)
            .map_err(|i| not_finite(tolerance, t0, i))?;
        let given = options.fixed_step.or(options.first_step);
        made.free = given.unwrap_or_else(|| {
            let (stop, order) = (made.stops.next(), made.tableau.error_order);
            first_step(system, work, &mut made.norm, t0, stop, made.ceiling, order)
                .max(SMALLEST_ULPS * ulp(t0))
        });
        Ok(made)
    }

    /// The integration at the place of another one of the same task, which has remembered this.
    ///
    /// # Errors
    /// [`FailureKind::Invalid`] where it was another task.
    pub fn resumed<S: System, M: StepMethod<S>>(
        system: &S,
        method: &'a M,
        t_span: (f64, f64),
        remembered: &[u64],
        tolerance: &'a Tolerance,
        options: &Options,
    ) -> Result<Self, Failure> {
        let dim = system.dim();
        let zeros = vec![0.0; dim];
        let mut made = Self::unbegun(dim, method, t_span, &zeros, tolerance, options)?;
        Words::load(remembered, &mut made)
            .ok()
            .filter(|()| made.work.is_whole(dim))
            .ok_or_else(|| other_task(t_span.0))?;
        Ok(made)
    }

    fn unbegun<S: System, M: StepMethod<S>>(
        dim: usize,
        method: &'a M,
        t_span: (f64, f64),
        y0: &[f64],
        tolerance: &'a Tolerance,
        options: &Options,
    ) -> Result<Self, Failure> {
        let (t0, end) = t_span;
        check(dim, t_span, y0, tolerance)
            .and_then(|()| options.check())
            .and_then(|()| method.check(dim, options.fixed_step.is_some()))
            .map_err(|reason| Failure::invalid(t0, reason))?;
        let tableau = method.tableau();
        Ok(Self {
            tableau,
            tolerance,
            stops: Stops::new(&options.breakpoints, t0, end),
            norm: Norm::new(tolerance),
            control: Control::new(options.controller),
            work: Stepper::new(tableau, method.is_multistep(), y0),
            clock: Clock::at(t0),
            end,
            fixed: options.fixed_step.is_some(),
            ceiling: options
                .fixed_step
                .map_or(options.max_step, |_| f64::INFINITY),
            max_rejections: options.max_rejections,
            free: 0.0,
            failures: 0,
            group: 0,
            accepted: None,
            stats: StepStatistics::default(),
        })
    }

    /// Steps until the observer breaks off or the end is there; whether it was the observer. One that has broken off sees the same
    /// step first when the integration goes on.
    ///
    /// # Errors
    /// As [`integrate`].
    pub fn run<S: System, M: StepMethod<S>, O: Observer<S>>(
        &mut self,
        system: &mut S,
        method: &M,
        observer: &mut O,
    ) -> Result<bool, Failure> {
        loop {
            if let Some(accepted) = self.accepted {
                let step = self
                    .work
                    .dense(self.clock.now(), accepted.end.now(), accepted.h);
                if observer.accepted(system, &step, &self.stats).is_break() {
                    return Ok(true);
                }
                self.advance(system, accepted)?;
            }
            if self.clock.now() >= self.end {
                return Ok(false);
            }
            self.step(system, method)?;
        }
    }

    /// The solution so far.
    pub fn solution(self, interrupted: bool) -> Solution {
        let (t, y) = match self.accepted {
            Some(accepted) => (accepted.end.now(), self.work.y1),
            None => (self.clock.now(), self.work.y),
        };
        let stats = StepStatistics {
            nfev: self.work.calls,
            ..self.stats
        };
        Solution {
            t,
            y,
            stats,
            interrupted,
        }
    }

    /// Tries steps until one is accepted.
    fn step<S: System, M: StepMethod<S>>(
        &mut self,
        system: &mut S,
        method: &M,
    ) -> Result<(), Failure> {
        loop {
            let (t, stop) = (self.clock.now(), self.stops.next());
            let plan = Plan::new(t, stop.time, self.free, self.ceiling);
            if !plan.lands && plan.h < SMALLEST_ULPS * ulp(t) {
                return Err(fail(t, plan.h, self.group, FailureKind::TooSmall));
            }
            let end = if plan.lands {
                Clock::at(stop.time)
            } else {
                self.clock.advanced(plan.h)
            };
            let error = self.attempt(system, method, t, end.now(), plan.h, stop);
            if !self.keeps(t, &plan, error)? {
                continue;
            }
            let stiffness = self.work.stiffness(plan.h, self.norm.weights());
            self.stats.accept(self.tableau, t, &plan, stiffness);
            self.stats.nfev = self.work.calls;
            self.accepted = Some(Accepted {
                h: plan.h,
                end,
                lands: plan.lands,
            });
            return Ok(());
        }
    }

    /// The error of a step that was tried.
    fn attempt<S: System, M: StepMethod<S>>(
        &mut self,
        system: &mut S,
        method: &M,
        t: f64,
        t1: f64,
        h: f64,
        stop: Stop,
    ) -> Worst {
        let work = &mut self.work;
        match method.attempt(work, system, t, t1, h, stop.latest()) {
            Ok(()) => self.norm.measure(&work.y, &work.y1, &work.error),
            Err(i) => no_error(self.tolerance.group_of(i)),
        }
    }

    /// Whether a step with such an error is accepted; chooses the size of the next one.
    fn keeps(&mut self, t: f64, plan: &Plan, error: Worst) -> Result<bool, Failure> {
        let finite = error.value.is_finite();
        self.group = error.group;
        if !finite || !(self.fixed || error.value <= 1.0) {
            self.stats.rejected += 1;
            // A finite error has no such limit: at a jump of the derivative many small steps back are needed.
            self.failures = if finite { 0 } else { self.failures + 1 };
            if self.fixed || self.failures >= self.max_rejections {
                return Err(fail(t, plan.h, self.group, FailureKind::NonFinite));
            }
            self.free = plan.h * self.control.rejected(error.value);
            return Ok(false);
        }
        self.failures = 0;
        if !self.fixed {
            let factor = self.control.accepted(error.value, plan.shortened);
            self.free = after(plan, self.free, factor);
        }
        Ok(true)
    }

    /// Makes the end of the accepted step the beginning of the next one.
    fn advance<S: System>(&mut self, system: &mut S, accepted: Accepted) -> Result<(), Failure> {
        self.accepted = None;
        self.work.advance();
        self.clock = accepted.end;
        if accepted.lands {
            let stop = self.stops.next();
            self.stops.pass();
            if stop.jumps && self.clock.now() < self.end {
                self.work
                    .restart(system, stop.time)
                    .map_err(|i| not_finite(self.tolerance, stop.time, i))?;
            }
        }
        Ok(())
    }
}

impl Remembered for Integrator<'_> {
    fn pass(&mut self, words: &mut Words) {
        self.stops.pass_on(words);
        self.control.pass(words);
        self.work.pass(words);
        self.clock.pass(words);
        self.free.pass(words);
        self.failures.pass(words);
        self.group.pass(words);
        self.accepted.pass(words);
        self.stats.pass(words);
    }
}

remembers!(Accepted: h, end, lands);

/// The failure of a memory that is of another task than the one that begins at a time.
pub(crate) fn other_task(begins: f64) -> Failure {
    Failure::invalid(
        begins,
        Invalid("the saved state belongs to another system or method"),
    )
}

fn not_finite(tolerance: &Tolerance, time: f64, i: usize) -> Failure {
    fail(time, 0.0, tolerance.group_of(i), FailureKind::NonFinite)
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
