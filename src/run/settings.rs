//! Options of the integrator for a model: threads, step cap, breakpoints, tolerance.

use super::step_limit;
use crate::base::error::{Error, Result};
use crate::dynamics::Dynamics;
use crate::forces::damping;
use crate::integrate::{Options, Tolerance};
use crate::model::{DOFS, Model};
use crate::scene::Method;

/// Largest steps between corners of a table from which a step ends on each: with fewer, that would cost many more steps.
const ROOM: f64 = 4.0;

/// How many threads share an evaluation: one where the crate is built without any.
pub(crate) fn threads(model: &Model, asked: usize) -> Result<usize> {
    if asked > 1024 {
        return Err(Error::argument(
            "threads",
            asked,
            "0 to 1024; 0: chosen automatically",
        ));
    }
    if cfg!(not(feature = "parallel")) {
        return Ok(1);
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

/// Step cap, first step, breakpoints of loads, drive and given motions.
pub(crate) fn options(model: &Model) -> Options {
    let scene = &model.scene;
    let solver = &scene.solver;
    let cap = step_limit::cap(model);
    let max_step = solver.max_step.unwrap_or(f64::INFINITY).min(cap);
    let apart = if max_step.is_finite() {
        ROOM * max_step
    } else {
        0.0
    };
    let in_time = scene.values_in_time().into_iter();
    Options {
        first_step: solver.first_step,
        max_step,
        breakpoints: in_time
            .flat_map(|value| value.breakpoints_apart(apart))
            .collect(),
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

/// Factor by which the error estimate of the scene's method exceeds the error. Not under films, whose forces follow speeds so closely that
/// accelerations of a run-up would err by 3.7 instead of 1.2 % (`tests/analytic/oil_run.rs`), for steps that they hold short anyway. Nor where contacts vibrate
/// undamped and errors add up: 5.6 % in 3 ms of a 6205 (`tests/accuracy/method_defaults.rs`).
fn overestimate(model: &Model) -> f64 {
    let solver = &model.scene.solver;
    let is_damped = damping(model) > OVERDAMPED * model.scales.frequency;
    let is_undamped = damping(model) == 0.0;
    if solver.method != Method::Adams || model.has_films() || is_damped || is_undamped {
        return 1.0;
    }
    (EXACT / model.fineness.rtol)
        .powf(0.25)
        .clamp(1.0, MOST_OVERESTIMATED)
}

/// Every body is a group; lengths are measured by the contact's approach δ, speeds by δ ω of the highest
/// contact frequency, angles by the arc on a ball. A position itself (36 mm) says nothing about what error
/// of it matters.
pub(crate) fn tolerance(dynamics: &Dynamics<'_>) -> Result<Tolerance> {
    let model = dynamics.model();
    let (scales, rtol) = (&model.scales, model.fineness.rtol);
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
