//! A run: scene → model → start → settle → integrate → signals. The lines to read first.

use std::ops::ControlFlow;

use crate::accuracy;
use crate::budget;
use crate::dynamics::Dynamics;
use crate::equilibrium::compile;
use crate::equilibrium::place;
use crate::error::{Error, Result};
use crate::follow::{Stretch, follow, options, threads};
use crate::memory;
use crate::pool::on;
use crate::reduction::Reduction;
use crate::run::Run;
use crate::scene::{SCHEMA, Scene};
use crate::selftest;
use crate::settle;
use crate::signals::{Bandwidth, Demand, Provenance, Recorder, Sampling, Signals};
use crate::start::{Start, start};
use crate::step_limit;

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
/// [`Error::Scene`] for bad input, [`Error::Memory`] for more samples than fit, [`Error::Equilibrium`] from the
/// start, [`Error::Integration`] where the integration cannot go on, [`Error::Budget`] where it costs more than the run
/// allows, [`Error::Interrupted`] if `progress` broke off.
pub fn simulate(
    scene: &Scene,
    run: &Run,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Signals> {
    check(run)?;
    budget::within(run.time_limit, progress, |progress| {
        unlimited(scene, run, progress)
    })
}

/// Checks what can be said of a run without its scene.
pub(crate) fn check(run: &Run) -> Result<()> {
    samples(run)?;
    if let (Some(_), Some(rtol)) = (run.accuracy, run.rtol) {
        let allowed = "absent where `accuracy` is given, which chooses it";
        return Err(Error::scene("rtol", rtol, allowed));
    }
    budget::check(run.time_limit, run.max_steps)
}

/// Simulates for as long as it takes.
fn unlimited(
    scene: &Scene,
    run: &Run,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Signals> {
    let (scene, placed) = place(scene)?;
    let mut scene = scene.into_owned();
    scene.solver.rtol = run.rtol.unwrap_or(scene.solver.rtol);
    scene.solver.method = run.method.unwrap_or(scene.solver.method);
    if let Some(requested) = run.accuracy {
        accuracy::check(requested, &scene)?;
    }
    let count = samples(run)?;
    // Before anything is computed; once more when it is known how fine signals are read.
    check_memory(&scene, run, (count, 1))?;
    let settled = settle::settle(&scene, run, progress)?;
    let before = settled.seconds;
    let accuracy = run.accuracy.map(|requested| {
        let pilot = &mut |scene: &Scene, from: &Start| pilot(scene, from, run, progress);
        accuracy::choose(requested, &mut scene, &settled.from, pilot)
    });
    let accuracy = accuracy.transpose()?;
    let (model, distrust) = selftest::trusted(compile(&scene)?);
    let sampling = Sampling::new(run.bandwidth, run.fs, model.scales.frequency)?;
    check_memory(&scene, run, (count, sampling.oversampling))?;
    let mut recorder = Recorder::new(&model, sampling, count);
    let threads = threads(&model, run.threads)?;
    let options = options(&model)?;
    let y0 = start(&model, &settled.from)?;
    let reduction = Reduction::of(&model, &y0);
    let dynamics = Dynamics::begin(&model, reduction.as_ref(), &y0);
    recorder.prepare(&dynamics, &y0)?;
    let mut progress =
        |share: f64| progress((before + share * run.duration) / (before + run.duration));
    let stretch = Stretch {
        begins: 0.0,
        length: run.duration,
        max_steps: run.max_steps,
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
            step_limit: step_limit::largest(scene.solver.method, &model),
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
        // The clock of the run goes on.
        time_limit: None,
        ..run.clone()
    };
    let mut out = simulate(scene, &first, &mut |_| progress(0.0))?;
    Ok((out.columns.remove(0).values, out.stats.nfev))
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

/// Refuses what does not fit into memory: for so many samples, read so many times as fine.
fn check_memory(scene: &Scene, run: &Run, (count, oversampling): (usize, usize)) -> Result<()> {
    let demand = Demand::of(scene);
    memory::check(demand.bytes(count, oversampling), || {
        format!(
            "{count} samples of {} signals, and {} forces of slices; shorten duration = {} s, lower fs, or record fewer \
             probes",
            demand.columns, demand.slices, run.duration
        )
    })
}
