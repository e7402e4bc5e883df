//! A run: scene → model → start → settle → integrate → signals. The lines to read first.

mod settle;

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use crate::accuracy;
use crate::collapse::{Crawl, culprits};
use crate::dynamics::Dynamics;
use crate::error::{Error, Result};
use crate::integrate::{self, DenseStep, Failure, FailureKind, Options, Tolerance};
use crate::method::{self, Choice, Task};
use crate::model::{Model, Reduction};
use crate::pool::on;
use crate::scene::{Drive, Method, SCHEMA, Scene};
use crate::signals::{Provenance, Recorder, Signals, Statistics};
use crate::start::{Start, start};

/// What to run.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Simulated time \[s\].
    pub duration: f64,
    /// Sampling rate \[Hz\].
    pub fs: f64,
    /// How it begins.
    pub start: Start,
    /// Relative tolerance; absent: the scene's.
    pub rtol: Option<f64>,
    /// Relative error of accelerations to stay below, 1e-4 to 1e-1: chooses nodes, tolerance and step cap in
    /// place of the scene's, by pilot runs of the first 3 ms; absent: the scene's. See [`crate::Accuracy`].
    pub accuracy: Option<f64>,
    /// Method; absent: the scene's.
    pub method: Option<Method>,
    /// Threads that share the balls of one evaluation; 0: as many as pay. The bits are the same for any.
    pub threads: usize,
    /// Time before t = 0 in which what is left of the start dies down \[s\]; absent: as long as the scene needs from
    /// equilibrium, 0 from any other start. Loads and drive are then as at t = 0, and rings and cage are wound back, so
    /// that at t = 0 they stand where the scene says but for what the balls have slipped. From a given state nothing is
    /// wound back: that state is the one before.
    pub settle: Option<f64>,
}

impl Default for Run {
    /// 0.1 s at 50 kHz from equilibrium.
    fn default() -> Self {
        Self {
            duration: 0.1,
            fs: 50e3,
            start: Start::Equilibrium,
            rtol: None,
            accuracy: None,
            method: None,
            threads: 0,
            settle: None,
        }
    }
}

/// The most that the signals of one run may take \[bytes\].
const MEMORY_LIMIT: f64 = 8.0 * (1u64 << 30) as f64;

/// Share of the contact mode's 1/ω that a step may reach. Dormand–Prince is stable to 1 on the imaginary
/// axis and further when damped. Measured on the faulted wheel bearing, 6 ms with an impact, against a tenth
/// of the step at rtol 1e-9: at 1 the relative error of the outer ring's acceleration is 0.06–0.3 % for any
/// rtol from 1e-3 to 1e-6; without the cap it is 6 % at rtol 1e-3.
const STEP_SHARE: f64 = 1.0;

/// How often progress is told, and after how many steps the clock is asked: of a small model's step that would take a
/// fiftieth.
const TELL_EVERY: Duration = Duration::from_millis(20);
const ASK_EVERY: usize = 8;

/// Simulates a scene. `progress` is told the share done, 0 to 1, about every 20 ms, and may stop the run.
///
/// ```
/// use ballrace::{Run, scene::presets, simulate};
/// let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
/// let run = Run { duration: 1e-3, ..Run::default() };
/// let out = simulate(&scene, &run, &mut |_| std::ops::ControlFlow::Continue(())).unwrap();
/// assert_eq!(out.get("outer.ay").unwrap().len(), 50);
/// ```
///
/// # Errors
/// [`Error::Scene`] for bad input, [`Error::Equilibrium`] from the start, [`Error::Integration`] where the
/// integration cannot go on, [`Error::Interrupted`] if `progress` broke off.
pub fn simulate(
    scene: &Scene,
    run: &Run,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Signals> {
    let mut scene = scene.clone();
    scene.solver.rtol = run.rtol.unwrap_or(scene.solver.rtol);
    scene.solver.method = run.method.unwrap_or(scene.solver.method);
    if let (Some(_), Some(rtol)) = (run.accuracy, run.rtol) {
        let allowed = "absent where `accuracy` is given, which chooses it";
        return Err(Error::scene("rtol", rtol, allowed));
    }
    if let Some(requested) = run.accuracy {
        accuracy::check(requested, &scene)?;
    }
    let count = samples(run)?;
    let settled = settle::settle(&scene, run, progress)?;
    let before = settled.seconds;
    let accuracy = run.accuracy.map(|requested| {
        let pilot = &mut |scene: &Scene, from: &Start| pilot(scene, from, run, progress);
        accuracy::choose(requested, &mut scene, &settled.from, pilot)
    });
    let accuracy = accuracy.transpose()?;
    let model = Model::new(&scene)?;
    let mut recorder = Recorder::new(&model, run.fs, count);
    check_memory(run, count, recorder.width())?;
    let threads = threads(&model, run.threads)?;
    let options = options(&model)?;
    let y0 = start(&model, &settled.from)?;
    let reduction = model.reduction(&y0);
    let dynamics = Dynamics::begin(&model, reduction.as_ref(), &y0);
    recorder.prepare(&dynamics, &y0);
    let mut progress =
        |share: f64| progress((before + share * run.duration) / (before + run.duration));
    let stretch = Stretch {
        begins: 0.0,
        length: run.duration,
    };
    let (_, mut stats, choice) = on(threads, dynamics, &mut progress, |dynamics, progress| {
        follow(dynamics, &mut recorder, &y0, stretch, &options, progress)
    })?;
    stats.acceleration_residual = recorder.residual.value();
    (stats.settling_accepted, stats.settling_nfev) = (settled.accepted, settled.nfev);
    let start = match run.start {
        Start::Equilibrium => "equilibrium",
        Start::Rolling => "rolling",
        Start::State(_) => "state",
    };
    Ok(Signals {
        fs: run.fs,
        t: recorder.t,
        columns: recorder.columns,
        slices: recorder.slices,
        stats,
        provenance: Provenance {
            version: env!("CARGO_PKG_VERSION"),
            schema: SCHEMA,
            method: choice.to_string(),
            stiffness: choice.stiffness,
            rtol: scene.solver.rtol,
            accuracy,
            max_step: Some(options.max_step).filter(|h| h.is_finite()),
            start,
            duration: run.duration,
            threads,
            states: reduction.as_ref().map_or(model.dim(), Reduction::dim),
            left_out: reduction.map_or_else(Vec::new, |r| r.omissions().to_vec()),
            simd: model.level().name(),
            architecture: std::env::consts::ARCH,
            settled: before,
        },
        scene,
    })
}

/// The first milliseconds of a run: samples of its first column, and the evaluations.
fn pilot(
    scene: &Scene,
    from: &Start,
    run: &Run,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(Vec<f64>, usize)> {
    let first = Run {
        duration: run.duration.min(accuracy::HORIZON),
        fs: accuracy::FS,
        start: from.clone(),
        accuracy: None,
        settle: Some(0.0),
        ..run.clone()
    };
    let mut out = simulate(scene, &first, &mut |_| progress(0.0))?;
    Ok((out.columns.remove(0).values, out.stats.nfev))
}

/// A time to integrate over: it begins at 0 on the integrator's clock and, maybe before it, on that of the run \[s\].
#[derive(Clone, Copy)]
struct Stretch {
    begins: f64,
    length: f64,
}

/// Sees the first state of a stretch and every accepted step, on the integrator's clock.
trait Watch: Send {
    fn first(&mut self, dynamics: &mut Dynamics<'_>, y: &[f64]);
    fn step(&mut self, dynamics: &mut Dynamics<'_>, step: &DenseStep<'_>);
}

impl Watch for Recorder {
    fn first(&mut self, dynamics: &mut Dynamics<'_>, y: &[f64]) {
        Recorder::first(self, dynamics, y);
    }

    fn step(&mut self, dynamics: &mut Dynamics<'_>, step: &DenseStep<'_>) {
        Recorder::step(self, dynamics, step);
    }
}

/// Integrates over a stretch from a state of all bodies; returns the last one.
fn follow(
    mut dynamics: Dynamics<'_>,
    watch: &mut dyn Watch,
    y0: &[f64],
    stretch: Stretch,
    options: &Options,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(Vec<f64>, Statistics, Choice)> {
    let Stretch { begins, length } = stretch;
    let model = dynamics.model();
    let begun = Instant::now();
    let mut told = begun;
    let (mut pulls, mut truncated, mut halt) = (0, 0, None);
    let mut crawl = Crawl::new(model, options.max_step);
    let tolerance = tolerance(&dynamics)?;
    let own = dynamics.compress(y0);
    let (mut last, mut last_time) = (own.clone(), 0.0);
    watch.first(&mut dynamics, &own);
    let mut observe =
        |dynamics: &mut Dynamics<'_>, step: &DenseStep<'_>, stats: &integrate::Statistics| {
            // The last evaluation was at the accepted state.
            pulls += dynamics.pulls();
            truncated += dynamics.truncated();
            let lost = dynamics.lost();
            watch.step(dynamics, step);
            last.copy_from_slice(step.y1());
            last_time = step.t1();
            let crawls = crawl.after(step.h());
            if let Some(body) = lost {
                halt = Some((step.t1(), step.h(), Some(body), ESCAPED));
            } else if crawls {
                halt = Some((step.t1(), step.h(), None, CRAWLING));
            }
            if halt.is_some() {
                return ControlFlow::Break(());
            }
            if stats.accepted.is_multiple_of(ASK_EVERY) && told.elapsed() >= TELL_EVERY {
                told = Instant::now();
                return progress(step.t1() / length);
            }
            ControlFlow::Continue(())
        };
    let solved = method::run(
        &mut dynamics,
        Task {
            span: (0.0, length),
            y0: &own,
            tolerance: &tolerance,
            options,
        },
        &mut observe,
    );
    let mut full = y0.to_vec();
    dynamics.expand(last_time, &last, &mut full);
    let (solution, choice) = solved.map_err(|failure| broken(model, &full, begins, &failure))?;
    if let Some((time, step, body, reason)) = halt {
        return Err(stopped(model, &full, (begins + time, step), body, reason));
    }
    if solution.interrupted {
        let time = begins + solution.t;
        return Err(Error::Interrupted { time });
    }
    let _ = progress(1.0);
    let stats = solution.stats;
    let statistics = Statistics {
        accepted: stats.accepted,
        rejected: stats.rejected,
        nfev: stats.nfev,
        iterations: stats.iterations,
        smallest_step: Some(stats.smallest_step).filter(|h| h.is_finite()),
        smallest_step_time: Some(stats.smallest_step_time).filter(|t| t.is_finite()),
        largest_step: stats.largest_step,
        stiff_share: stats.share_stiff(),
        implicit_share: choice.implicit as f64 / stats.accepted.max(1) as f64,
        capped_share: stats.capped as f64 / stats.accepted.max(1) as f64,
        clamped_pulls: pulls,
        truncated_contacts: truncated,
        acceleration_residual: None,
        wall_time: begun.elapsed().as_secs_f64(),
        settling_accepted: 0,
        settling_nfev: 0,
    };
    Ok((full, statistics, choice))
}

/// Number of samples k / fs below the duration.
fn samples(run: &Run) -> Result<usize> {
    if !(run.duration > 0.0 && run.duration <= 1e6) {
        return Err(Error::scene(
            "duration",
            run.duration,
            "above 0 and at most 1e6 s",
        ));
    }
    if !(run.fs > 0.0 && run.fs <= 1e9) {
        return Err(Error::scene("fs", run.fs, "above 0 and at most 1e9 Hz"));
    }
    let count = (run.duration * run.fs).round();
    if count < 1.0 {
        return Err(Error::scene(
            "fs",
            run.fs,
            format!("at least one sample in {} s", run.duration),
        ));
    }
    // At most 1e15 by the limits above.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    Ok(count as usize)
}

fn check_memory(run: &Run, count: usize, width: usize) -> Result<()> {
    let bytes = 8.0 * count as f64 * (width + 1) as f64;
    if bytes > MEMORY_LIMIT {
        return Err(Error::scene(
            "duration",
            run.duration,
            format!(
                "at most {:.3} s: {count} samples of {width} signals would take {:.1} GiB, more than 8 GiB; \
                 record fewer probes or lower fs",
                run.duration * MEMORY_LIMIT / bytes,
                bytes / f64::from(1u32 << 30)
            ),
        ));
    }
    Ok(())
}

fn threads(model: &Model, asked: usize) -> Result<usize> {
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
pub(crate) fn options(model: &Model) -> Result<Options> {
    let scene = &model.scene;
    let solver = &scene.solver;
    let cap = if solver.frequency_cap {
        STEP_SHARE / model.scales.frequency
    } else {
        f64::INFINITY
    };
    let mut breakpoints: Vec<f64> = model
        .loads
        .iter()
        .flat_map(|load| load.force.breakpoints())
        .collect();
    breakpoints.extend(match &scene.drive {
        Drive::Speed(value) | Drive::Torque { value, .. } => value.breakpoints(),
    });
    let max_step = solver.max_step.unwrap_or(f64::INFINITY).min(cap);
    let fixed = method::is_fixed(solver.method);
    if fixed && max_step.is_infinite() {
        return Err(Error::scene(
            "solver.max_step",
            "absent",
            "a step [s], since the method has a fixed one and solver.frequency_cap is false",
        ));
    }
    Ok(Options {
        first_step: solver.first_step,
        max_step,
        fixed_step: fixed.then_some(max_step),
        breakpoints,
        ..Options::default()
    })
}

/// Every body is a group; lengths are measured by the contact's approach δ, speeds by δ ω of the highest
/// contact frequency, angles by the arc on a ball. A position itself (36 mm) says nothing about what error
/// of it matters.
pub(crate) fn tolerance(dynamics: &Dynamics<'_>) -> Result<Tolerance> {
    let model = dynamics.model();
    let (scales, rtol) = (&model.scales, model.scene.solver.rtol);
    let degrees = dynamics.degrees();
    let mut kept = vec![0; model.body_count()];
    for (body, _) in &degrees {
        kept[*body] += 1;
    }
    let half = |length: f64| {
        degrees.iter().map(move |&(body, direction)| {
            (
                body,
                if direction == 3 {
                    length / model.radius(body)
                } else {
                    length
                },
            )
        })
    };
    let length = rtol * scales.approach;
    let atol = half(length)
        .chain(half(length * scales.frequency))
        // What is left out has no error: it counts in a body's mean as if it were there.
        .map(|(body, atol)| atol * (4.0 / f64::from(kept[body])).sqrt())
        .collect();
    let bodies = degrees.iter().map(|(body, _)| *body);
    let group = bodies.clone().chain(bodies).collect();
    Tolerance::new(0.0, atol, &vec![false; 2 * degrees.len()], group)
        .map_err(|invalid| Error::scene("solver.rtol", rtol, invalid.to_string()))
}

/// Why a run ends though the integrator could go on.
const ESCAPED: &str =
    "the ball has left its groove; check loads, clearance and shoulders, or use a smaller rtol";
const CRAWLING: &str = "the step has collapsed to less than 1e-5 of the contacts' period and stays there; \
                        raise slip_speed, lower the damping, or soften the contacts";

fn broken(model: &Model, last: &[f64], begins: f64, failure: &Failure) -> Error {
    let reason = match failure.kind {
        FailureKind::NonFinite => "a force is not finite; check masses, stiffnesses and loads",
        FailureKind::TooSmall => {
            "the step fell below the resolution of time; soften contacts, raise slip_speed or rtol, or try another method"
        }
        FailureKind::Invalid(invalid) => invalid.0,
    };
    let when = (begins + failure.time, failure.step);
    stopped(model, last, when, Some(failure.group), reason)
}

/// The error with what held up the run in its last state: a body's contacts, or the fastest of all.
fn stopped(
    model: &Model,
    last: &[f64],
    (time, step): (f64, f64),
    body: Option<usize>,
    reason: &str,
) -> Error {
    let found = culprits(model, last, body);
    let listed: Vec<String> = found.iter().map(ToString::to_string).collect();
    let body = body.or(found.first().map(|first| first.body)).unwrap_or(0);
    Error::Integration {
        time,
        step,
        body: model.bodies[body].name.clone(),
        reason: if listed.is_empty() {
            format!("{reason} (no contact touches)")
        } else {
            format!("{reason}. Fastest: {}", listed.join(", "))
        },
        contacts: found.into_iter().map(|culprit| culprit.name).collect(),
    }
}
