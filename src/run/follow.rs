//! Follows a motion over a stretch of time, step by step, and detects when it is no longer physical.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use super::budget::StepBudget;
use super::ending::{Halt, broken};
use super::method::{self, Integration};
use super::orbit;
use super::runaway;
use super::step_collapse::StepCollapse;
use super::step_limit;
use crate::base::error::{Error, Result};
use crate::dynamics::Dynamics;
use crate::forces::damping;
use crate::inspect;
use crate::integrate::{self, DenseStep, Options, Tolerance};
use crate::model::{BodyId, DOFS, Model};
use crate::scene::{Drive, Method};
use crate::signals::{Recorder, Statistics};

/// How often progress is reported, and after how many steps the clock is read: of a small model's step that would take a
/// fiftieth. One of a large model is long enough to ask after each.
const TELL_EVERY: Duration = Duration::from_millis(20);
const ASK_EVERY: usize = 8;
/// Largest steps between corners of a table from which a step ends on each: with fewer, that would cost many more steps.
const ROOM: f64 = 4.0;

/// A time to integrate over: it begins at 0 on the integrator's clock and, maybe before it, on that of the run \[s\].
#[derive(Clone, Copy)]
pub(crate) struct Interval {
    pub begins: f64,
    pub length: f64,
    /// Steps that it may take.
    pub max_steps: Option<usize>,
}

/// Sees the first state of a stretch and every accepted step, on the integrator's clock.
pub(crate) trait StepWatch: Send {
    fn first(&mut self, dynamics: &mut Dynamics<'_>, y: &[f64]);

    /// Breaks off to end the stretch.
    fn step(&mut self, dynamics: &mut Dynamics<'_>, step: &DenseStep<'_>) -> ControlFlow<()>;

    /// Until when it wants to see steps of a stretch with this end \[s\].
    fn until(&self, end: f64) -> f64 {
        end
    }

    /// There are no more steps. Breaks off where what is left is not wanted.
    fn finish(&mut self) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl StepWatch for Recorder<'_> {
    fn first(&mut self, dynamics: &mut Dynamics<'_>, y: &[f64]) {
        Recorder::first(self, dynamics, 0.0, y);
    }

    fn step(&mut self, dynamics: &mut Dynamics<'_>, step: &DenseStep<'_>) -> ControlFlow<()> {
        Recorder::step(self, dynamics, step)
    }

    fn until(&self, end: f64) -> f64 {
        Recorder::until(self, end)
    }

    fn finish(&mut self) -> ControlFlow<()> {
        Recorder::finish(self)
    }
}

/// Integrates over a stretch from a state of all bodies; returns the last one.
pub(crate) fn follow(
    mut dynamics: Dynamics<'_>,
    watch: &mut dyn StepWatch,
    y0: &[f64],
    stretch: Interval,
    options: &Options,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(Vec<f64>, Statistics, &'static str)> {
    let Interval {
        begins,
        length,
        max_steps,
    } = stretch;
    let model = dynamics.model();
    let begun = Instant::now();
    let mut told = begun;
    let (mut pulls, mut truncated, mut halt) = (0, 0, None);
    let mut collapse = StepCollapse::new(model, options.max_step);
    let (mut steps, mut spent) = (StepBudget::new(max_steps), false);
    let ask_every = if model.is_large() { 1 } else { ASK_EVERY };
    let bounds = runaway::Bounds::new(&dynamics, y0);
    let tolerance = tolerance(&dynamics)?;
    let own = dynamics.compress(y0);
    let (mut last, mut last_time) = (own.clone(), 0.0);
    watch.first(&mut dynamics, &own);
    let mut observe =
        |dynamics: &mut Dynamics<'_>, step: &DenseStep<'_>, stats: &integrate::StepStatistics| {
            // The last evaluation was at the accepted state.
            pulls += dynamics.pulls();
            truncated += dynamics.truncated();
            let lost = dynamics.lost().and_then(BodyId::as_ball);
            let watched = watch.step(dynamics, step);
            last.copy_from_slice(step.y1());
            last_time = step.t1();
            let crawls = collapse.after(step.h());
            let left = || bounds.left(step.y1());
            let why = lost
                .map(Halt::Escaped)
                .or_else(|| left().map(|(body, does)| Halt::RanAway(body, does)))
                .or_else(|| crawls.then_some(Halt::Crawls));
            if let Some(why) = why {
                halt = Some((step.t1(), step.h(), why));
                return ControlFlow::Break(());
            }
            spent = steps.spent(stats) && step.t1() < length;
            if spent || watched.is_break() {
                return ControlFlow::Break(());
            }
            if stats.accepted.is_multiple_of(ask_every) && told.elapsed() >= TELL_EVERY {
                told = Instant::now();
                return progress(step.t1() / length);
            }
            ControlFlow::Continue(())
        };
    let solved = method::run(
        &mut dynamics,
        Integration {
            span: (0.0, length),
            y0: &own,
            tolerance: &tolerance,
            options,
        },
        &mut observe,
    );
    let mut full = y0.to_vec();
    dynamics.expand(last_time, &last, &mut full);
    let (solution, method) = solved.map_err(|failure| broken(model, &full, begins, &failure))?;
    if let Some((time, step, why)) = halt {
        return Err(why.error(model, &full, (begins + time, step)));
    }
    if spent {
        return Err(steps.error(begins + solution.t));
    }
    if solution.interrupted {
        let time = begins + solution.t;
        return Err(Error::Interrupted { time });
    }
    let end = (solution.t, &solution.y[..]);
    let nfev_past_end = go_on(&mut dynamics, watch, end, (&tolerance, options), progress)?;
    finish(watch, begins + length)?;
    let _ = progress(1.0);
    let statistics = Statistics {
        clamped_pulls: pulls,
        truncated_contacts: truncated,
        wall_time: begun.elapsed().as_secs_f64(),
        nfev_past_end,
        ..statistics(model, &solution.stats, (y0, &full))
    };
    Ok((full, statistics, method))
}

/// Results of a stretch from the integration and from the states of all bodies at its start and end.
fn statistics(
    model: &Model,
    stats: &integrate::StepStatistics,
    (first, last): (&[f64], &[f64]),
) -> Statistics {
    let share = |steps: usize| steps as f64 / stats.accepted.max(1) as f64;
    Statistics {
        accepted: stats.accepted,
        rejected: stats.rejected,
        nfev: stats.nfev,
        smallest_step: Some(stats.smallest_step).filter(|h| h.is_finite()),
        smallest_step_time: Some(stats.smallest_step_time).filter(|t| t.is_finite()),
        largest_step: stats.largest_step,
        stiff_share: stats.share_stiff(),
        capped_share: share(stats.capped),
        clamped_pulls: 0,
        truncated_contacts: 0,
        acceleration_residual: None,
        wall_time: 0.0,
        nfev_past_end: 0,
        largest_pressure: inspect::largest_pressure(model, first)
            .max(inspect::largest_pressure(model, last)),
        film_slip: inspect::film_slip(model, first).max(inspect::film_slip(model, last)),
        largest_tilt: model.largest_tilt(first).max(model.largest_tilt(last)),
        settling_accepted: 0,
        settling_nfev: 0,
        orbit_slowed: orbit::slowed(model, first, last),
    }
}

/// Follows the motion beyond the end of the run for what the last samples take from there; returns the evaluations.
/// Where it cannot go on, the samples make do with what there is.
fn go_on(
    dynamics: &mut Dynamics<'_>,
    watch: &mut dyn StepWatch,
    (end, y): (f64, &[f64]),
    (tolerance, options): (&Tolerance, &Options),
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<usize> {
    let until = watch.until(end);
    if until <= end {
        return Ok(0);
    }
    let mut collapse = StepCollapse::new(dynamics.model(), options.max_step);
    let (mut told, mut stopped) = (Instant::now(), false);
    let mut observe =
        |dynamics: &mut Dynamics<'_>, step: &DenseStep<'_>, _: &integrate::StepStatistics| {
            if dynamics.lost().is_some() || collapse.after(step.h()) {
                return ControlFlow::Break(());
            }
            stopped = watch.step(dynamics, step).is_break();
            if told.elapsed() >= TELL_EVERY {
                told = Instant::now();
                stopped |= progress(1.0).is_break();
            }
            if stopped {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
    let task = Integration {
        span: (end, until),
        y0: y,
        tolerance,
        options,
    };
    let beyond = method::run(dynamics, task, &mut observe);
    if stopped {
        return Err(Error::Interrupted { time: end });
    }
    Ok(beyond.map_or(0, |(solution, _)| solution.stats.nfev))
}

/// There are no more steps of a stretch that ends at a time \[s\].
fn finish(watch: &mut dyn StepWatch, time: f64) -> Result<()> {
    match watch.finish() {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::Interrupted { time }),
    }
}

/// How many threads share an evaluation.
pub(crate) fn threads(model: &Model, asked: usize) -> Result<usize> {
    if asked > 1024 {
        return Err(Error::scene("threads", asked, "at most 1024; 0 chooses"));
    }
    if asked > 0 {
        return Ok(asked);
    }
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    Ok(if model.is_large() {
        cores.min(model.balls.len())
    } else {
        1
    })
}

/// Step cap, first step, breakpoints of loads and drive.
pub(crate) fn options(model: &Model) -> Options {
    let scene = &model.scene;
    let solver = &scene.solver;
    let cap = if solver.frequency_cap {
        step_limit::largest(solver.method, model)
    } else {
        f64::INFINITY
    };
    let max_step = solver.max_step.unwrap_or(f64::INFINITY).min(cap);
    let apart = if max_step.is_finite() {
        ROOM * max_step
    } else {
        0.0
    };
    let mut breakpoints: Vec<f64> = model
        .loads
        .iter()
        .map(|load| &load.force)
        .chain(model.moments.iter().map(|moment| &moment.moment))
        .flat_map(|size| size.breakpoints_apart(apart))
        .collect();
    breakpoints.extend(match &scene.drive {
        Drive::Speed(value) | Drive::Torque { value, .. } => value.breakpoints_apart(apart),
    });
    Options {
        first_step: solver.first_step,
        max_step,
        breakpoints,
        ..Options::default()
    }
}

/// Tolerance from which on the error estimate of Adams' method exceeds what a step leaves. The estimate is that of the corrector of order
/// three, the step is of order four: one over the other falls like h, which is the fourth root of the tolerance. At the default
/// of 1e-7 that is five: 42 random bearings take 72 700 instead of 88 500 evaluations for a whole error of 0.10 instead of 0.06 % in the
/// median, 0.52 instead of 0.37 in nine of ten (`tests/accuracy/defaults.rs`).
/// No more is used at tighter ones, which are asked for to be safe.
const EXACT: f64 = 6.25e-5;
const MOST_OVERESTIMATED: f64 = 5.0;
/// Damping over contact frequency above which velocities decay within a step, so that orders say nothing.
const OVERDAMPED: f64 = 10.0;

/// By how much the error estimate of the scene's method exceeds the error. Not under films, whose forces follow speeds so closely that
/// accelerations of a run-up would err by 3.7 instead of 1.2 % (`tests/analytic/oil_run.rs`), for steps that they hold short anyway. Nor where contacts vibrate
/// undamped and errors add up: 5.6 % in 3 ms of a 6205 (`tests/accuracy/method_defaults.rs`).
fn overestimate(model: &Model) -> f64 {
    let solver = &model.scene.solver;
    let is_damped = damping(model) > OVERDAMPED * model.scales.frequency;
    let is_undamped = damping(model) == 0.0;
    if solver.method != Method::Adams || model.has_films() || is_damped || is_undamped {
        return 1.0;
    }
    (EXACT / solver.rtol)
        .powf(0.25)
        .clamp(1.0, MOST_OVERESTIMATED)
}

/// Every body is a group; lengths are measured by the contact's approach δ, speeds by δ ω of the highest
/// contact frequency, angles by the arc on a ball. A position itself (36 mm) says nothing about what error
/// of it matters.
pub(crate) fn tolerance(dynamics: &Dynamics<'_>) -> Result<Tolerance> {
    let model = dynamics.model();
    let (scales, rtol) = (&model.scales, model.scene.solver.rtol);
    let degrees = dynamics.degrees();
    let mut kept = vec![0_u32; model.body_count()];
    for (body, _) in &degrees {
        kept[*body] += 1;
    }
    let half = |length: f64| {
        let degrees = degrees.iter();
        degrees.map(move |&(body, dof)| (body, length / model.lever(body, dof)))
    };
    let length = overestimate(model) * rtol * scales.approach;
    let atol = half(length)
        .chain(half(length * scales.frequency))
        // What is left out has no error: it counts in a body's mean as if it were there.
        .map(|(body, atol)| atol * (DOFS as f64 / f64::from(kept[body])).sqrt())
        .collect();
    let bodies = degrees.iter().map(|(body, _)| body.index());
    let group = bodies.clone().chain(bodies).collect();
    Tolerance::new(0.0, atol, &vec![false; 2 * degrees.len()], group)
        .map_err(|invalid| Error::scene("solver.rtol", rtol, invalid.to_string()))
}
