//! A run: scene → model → start → settle → integrate → signals. The lines to read first.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use crate::accuracy;
use crate::collapse::Crawl;
use crate::dynamics::Dynamics;
use crate::ending::{self, broken, stopped};
use crate::equilibrium::place;
use crate::error::{Error, Result};
use crate::integrate::{self, DenseStep, Options, Tolerance};
use crate::method::{self, Choice, Task};
use crate::model::{Model, Reduction};
use crate::pool::on;
use crate::runaway;
use crate::scene::{Drive, Method, SCHEMA, Scene};
use crate::selftest;
use crate::settle;
use crate::signals::{Bandwidth, Provenance, Recorder, Sampling, Signals, Statistics};
use crate::start::{Start, start};
use crate::step_limit;

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
    /// Whether signals are filtered before they are sampled.
    pub bandwidth: Bandwidth,
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
            bandwidth: Bandwidth::Auto,
            settle: None,
        }
    }
}

/// The most that the signals of one run may take \[bytes\].
const MEMORY_LIMIT: f64 = 8.0 * (1u64 << 30) as f64;

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
    let (scene, placed) = place(scene)?;
    let mut scene = scene.into_owned();
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
    let (model, distrust) = selftest::trusted(Model::new(&scene)?);
    let sampling = Sampling::new(run.bandwidth, run.fs, model.scales.frequency)?;
    let mut recorder = Recorder::new(&model, sampling, count);
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
            distrust,
            architecture: std::env::consts::ARCH,
            bandwidth: sampling.bandwidth,
            oversampling: sampling.oversampling,
            settled: before,
            defects: recorder.watch.told(&model, &placed),
            step_limit: step_limit::largest(scene.solver.method, model.scales()),
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
        bandwidth: Bandwidth::Raw,
        settle: Some(0.0),
        ..run.clone()
    };
    let mut out = simulate(scene, &first, &mut |_| progress(0.0))?;
    Ok((out.columns.remove(0).values, out.stats.nfev))
}

/// A time to integrate over: it begins at 0 on the integrator's clock and, maybe before it, on that of the run \[s\].
#[derive(Clone, Copy)]
pub(crate) struct Stretch {
    pub begins: f64,
    pub length: f64,
}

/// Sees the first state of a stretch and every accepted step, on the integrator's clock.
pub(crate) trait Watch: Send {
    fn first(&mut self, dynamics: &mut Dynamics<'_>, y: &[f64]);
    fn step(&mut self, dynamics: &mut Dynamics<'_>, step: &DenseStep<'_>);

    /// Until when it wants to see steps of a stretch with this end \[s\].
    fn until(&self, end: f64) -> f64 {
        end
    }

    /// There are no more steps.
    fn finish(&mut self) {}
}

impl Watch for Recorder {
    fn first(&mut self, dynamics: &mut Dynamics<'_>, y: &[f64]) {
        Recorder::first(self, dynamics, 0.0, y);
    }

    fn step(&mut self, dynamics: &mut Dynamics<'_>, step: &DenseStep<'_>) {
        Recorder::step(self, dynamics, step);
    }

    fn until(&self, end: f64) -> f64 {
        Recorder::until(self, end)
    }

    fn finish(&mut self) {
        Recorder::finish(self);
    }
}

/// Integrates over a stretch from a state of all bodies; returns the last one.
pub(crate) fn follow(
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
    let bounds = runaway::Bounds::new(&dynamics, y0);
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
            let why = if let Some(body) = lost {
                Some((Some(body), ending::escaped(model, step.h())))
            } else if let Some((body, does)) = bounds.left(step.y1()) {
                Some((Some(body), ending::ran_away(model, &does, step.h())))
            } else {
                crawls.then(|| (None, ending::CRAWLING.to_owned()))
            };
            if let Some((body, reason)) = why {
                halt = Some((step.t1(), step.h(), body, reason));
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
        return Err(stopped(model, &full, (begins + time, step), body, &reason));
    }
    if solution.interrupted {
        let time = begins + solution.t;
        return Err(Error::Interrupted { time });
    }
    let end = (solution.t, &solution.y[..]);
    let nfev_past_end = go_on(&mut dynamics, watch, end, (&tolerance, options), progress)?;
    watch.finish();
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
        nfev_past_end,
        largest_pressure: model
            .largest_pressure(y0)
            .max(model.largest_pressure(&full)),
        settling_accepted: 0,
        settling_nfev: 0,
    };
    Ok((full, statistics, choice))
}

/// Follows the motion beyond the end of the run for what the last samples take from there; returns the evaluations.
/// Where it cannot go on, the samples make do with what there is.
fn go_on(
    dynamics: &mut Dynamics<'_>,
    watch: &mut dyn Watch,
    (end, y): (f64, &[f64]),
    (tolerance, options): (&Tolerance, &Options),
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<usize> {
    let until = watch.until(end);
    if until <= end {
        return Ok(0);
    }
    let mut crawl = Crawl::new(dynamics.model(), options.max_step);
    let (mut told, mut stopped) = (Instant::now(), false);
    let mut observe =
        |dynamics: &mut Dynamics<'_>, step: &DenseStep<'_>, _: &integrate::Statistics| {
            if dynamics.lost().is_some() || crawl.after(step.h()) {
                return ControlFlow::Break(());
            }
            watch.step(dynamics, step);
            if told.elapsed() >= TELL_EVERY {
                told = Instant::now();
                stopped = progress(1.0).is_break();
            }
            if stopped {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
    let task = Task {
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
pub(crate) fn options(model: &Model) -> Result<Options> {
    let scene = &model.scene;
    let solver = &scene.solver;
    let cap = if solver.frequency_cap {
        step_limit::largest(solver.method, &model.scales)
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
