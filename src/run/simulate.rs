//! A run: scene → model → start → settle → integrate → signals. The lines to read first.

use std::ops::ControlFlow;

use super::Run;
use super::accuracy;
use super::budget;
use super::follow::{Stretch, follow, options, threads};
use super::settle;
use super::step_limit;
use crate::dynamics::Dynamics;
use crate::equilibrium::compile;
use crate::equilibrium::place;
use crate::error::Result;
use crate::memory;
use crate::pool::on;
use crate::reduction::Reduction;
use crate::scene::{SCHEMA, Scene};
use crate::selftest;
use crate::signals::{Bandwidth, Block, Demand, Provenance, Recorder, Sampling, Signals, Sink};
use crate::start::{Start, start};

/// Simulates a scene.
///
/// ```
/// use ballrace::{Run, scene::presets, simulate};
/// let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
/// let run = Run { duration: 1e-3, ..Run::default() };
/// let out = simulate(&scene, &run).unwrap();
/// assert_eq!(out.get("outer.ay").unwrap().len(), 50);
/// ```
///
/// # Errors
/// [`Error::Scene`] for bad input, [`Error::Memory`] for more samples than fit, [`Error::Equilibrium`] from the
/// start, [`Error::Integration`] where the integration cannot go on, [`Error::Budget`] where it costs more than the run
/// allows.
///
/// [`Error::Scene`]: crate::Error::Scene
/// [`Error::Memory`]: crate::Error::Memory
/// [`Error::Equilibrium`]: crate::Error::Equilibrium
/// [`Error::Integration`]: crate::Error::Integration
/// [`Error::Budget`]: crate::Error::Budget
pub fn simulate(scene: &Scene, run: &Run) -> Result<Signals> {
    simulate_with_progress(scene, run, &mut |_| ControlFlow::Continue(()))
}

/// Simulates a scene as [`simulate`] does. `progress` is told the share done, 0 to 1, about every 20 ms, and may stop the
/// run.
///
/// # Errors
/// As [`simulate`]; [`Error::Interrupted`] if `progress` broke off.
///
/// [`Error::Interrupted`]: crate::Error::Interrupted
pub fn simulate_with_progress(
    scene: &Scene,
    run: &Run,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Signals> {
    limited(scene, run, None, progress)
}

/// Simulates a scene as [`simulate`] does, bit by bit, and hands its record to `sink` in blocks of at most 65 536
/// samples, so that memory does not grow with the duration. `sink` is called on a thread of the run, which waits for it,
/// and may stop the run.
///
/// ```
/// use std::ops::ControlFlow::Continue;
/// use ballrace::{Block, Run, scene::presets, simulate_into};
/// let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
/// let run = Run { duration: 1e-3, ..Run::default() };
/// let (mut samples, mut peak) = (0, 0.0_f64);
/// let mut sink = |block: Block| {
///     samples += block.t.len();
///     let ay = block.columns.iter().find(|column| column.name == "outer.ay").unwrap();
///     peak = ay.values.iter().fold(peak, |peak, a| peak.max(a.abs()));
///     Continue(())
/// };
/// let told = simulate_into(&scene, &run, &mut sink, &mut |_| Continue(())).unwrap();
/// assert_eq!((samples, told.t.len()), (50, 0));
/// assert!(peak > 0.0 && told.stats.accepted > 0);
/// ```
///
/// The signals that it returns tell everything else: statistics, provenance, forces of slices, names and units of the
/// columns, which are empty.
///
/// # Errors
/// As [`simulate`]; [`Error::Memory`] where a block does not fit, [`Error::Interrupted`] also if `sink` broke off.
///
/// [`Error::Memory`]: crate::Error::Memory
/// [`Error::Interrupted`]: crate::Error::Interrupted
pub fn simulate_into<'a>(
    scene: &Scene,
    run: &Run,
    sink: &'a mut (dyn FnMut(Block) -> ControlFlow<()> + Send + 'a),
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Signals> {
    limited(scene, run, Some(sink), progress)
}

/// Simulates within the limits of the run.
fn limited(
    scene: &Scene,
    run: &Run,
    sink: Option<Sink<'_>>,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Signals> {
    run.validate()?;
    budget::within(run.time_limit, progress, |progress| {
        unlimited(scene, run, sink, progress)
    })
}

/// Simulates for as long as it takes.
fn unlimited(
    scene: &Scene,
    run: &Run,
    sink: Option<Sink<'_>>,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Signals> {
    let (scene, placed) = place(scene)?;
    let mut scene = scene.into_owned();
    scene.solver.rtol = run.rtol.unwrap_or(scene.solver.rtol);
    scene.solver.method = run.method.unwrap_or(scene.solver.method);
    if run.accuracy.is_some() {
        accuracy::check(&scene)?;
    }
    let count = run.samples()?;
    // Before anything is computed; once more when it is known how fine signals are read.
    let in_blocks = sink.is_some();
    check_memory(&scene, run, (count, 1), in_blocks)?;
    let settled = settle::settle(&scene, run, progress)?;
    let before = settled.seconds;
    let accuracy = run.accuracy.map(|requested| {
        let pilot = &mut |scene: &Scene, from: &Start| pilot(scene, from, run, progress);
        accuracy::choose(requested, &mut scene, &settled.from, pilot)
    });
    let accuracy = accuracy.transpose()?;
    let (model, distrust) = selftest::trusted(compile(&scene)?);
    let sampling = Sampling::new(run.bandwidth, run.fs, model.scales.frequency)?;
    check_memory(&scene, run, (count, sampling.oversampling), in_blocks)?;
    let mut recorder = Recorder::new(&model, sampling, count, sink);
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
        t: recorder.held.t,
        columns: recorder.held.columns,
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
            simd: model.instructions().name(),
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
    let mut out = simulate_with_progress(scene, &first, &mut |_| progress(0.0))?;
    Ok((out.columns.remove(0).values, out.stats.nfev))
}

/// Refuses what does not fit into memory: for so many samples, read so many times as fine, kept or leaving in blocks.
fn check_memory(
    scene: &Scene,
    run: &Run,
    (count, oversampling): (usize, usize),
    in_blocks: bool,
) -> Result<()> {
    let demand = Demand::of(scene);
    let rows = demand.rows(count, in_blocks);
    memory::check(demand.bytes(rows, oversampling), || {
        let less = if in_blocks {
            "record fewer probes".to_owned()
        } else {
            format!(
                "shorten duration = {} s, lower fs, record fewer probes, or let a single run write its record to a file \
                 as it goes on (out)",
                run.duration
            )
        };
        format!(
            "{rows} samples of {} signals, and {} forces of slices; {less}",
            demand.columns, demand.slices
        )
    })
}
