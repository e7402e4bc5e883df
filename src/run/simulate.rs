//! A run: scene → model → start → settle → integrate → signals.

use std::ops::ControlFlow;

use super::Run;
use super::budget;
use super::follow::{Interval, follow, options, threads};
use super::prepare::{Prepared, check_memory, prepare};
use super::provenance::{Done, provenance};
use crate::base::error::Result;
use crate::dynamics::Dynamics;
use crate::reduction::Reduction;
use crate::run::pool::on;
use crate::run::selftest;
use crate::scene::Scene;
use crate::signals::{Block, BlockSink, Recorder, Sampling, Signals};
use crate::statics::compile;
use crate::statics::start::start;

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

/// Simulates a scene as [`simulate`] does. `progress` receives the share done, 0 to 1, about every 20 ms, and may stop the
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
/// The signals that it returns have everything else: statistics, provenance, forces of slices, names and units of the
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
    sink: Option<BlockSink<'_>>,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Signals> {
    run.validate()?;
    scene.validate()?;
    budget::within(run.time_limit, progress, |progress| {
        unlimited(scene, run, sink, progress)
    })
}

/// Simulates for as long as it takes.
fn unlimited(
    scene: &Scene,
    run: &Run,
    sink: Option<BlockSink<'_>>,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Signals> {
    let in_blocks = sink.is_some();
    let prepared = prepare(scene, run, in_blocks, simulate_with_progress, progress)?;
    let Prepared { scene, settled, .. } = &prepared;
    let (model, distrust) = selftest::trusted(compile(scene)?);
    let y0 = start(&model, &settled.from)?;
    let reduction = Reduction::of(&model, &y0);
    let dynamics = Dynamics::begin(&model, reduction.as_ref(), &y0);

    let sampling = Sampling::new(run.bandwidth, run.fs, model.scales.frequency)?;
    let samples = (run.samples()?, sampling.oversampling);
    check_memory(scene, run, samples, in_blocks)?;
    let mut recorder = Recorder::new(&model, sampling, samples.0, sink);
    recorder.prepare(&dynamics, &y0)?;

    let threads = threads(&model, run.threads)?;
    let options = options(&model);
    let stretch = Interval {
        begins: 0.0,
        length: run.duration,
        max_steps: run.max_steps,
    };
    let whole = settled.seconds + run.duration;
    let mut progress = |share: f64| progress((settled.seconds + share * run.duration) / whole);
    let (_, mut stats, method) = on(threads, dynamics, &mut progress, |dynamics, progress| {
        follow(dynamics, &mut recorder, &y0, stretch, &options, progress)
    })?;

    stats.acceleration_residual = recorder.residual.value();
    (stats.settling_accepted, stats.settling_nfev) = (settled.accepted, settled.nfev);
    let done = Done {
        prepared: &prepared,
        model: &model,
        distrust,
        sampling,
        threads,
        options: &options,
        reduction,
        method,
        defects: recorder.watch.told(&model, &prepared.placed),
        kinematics: recorder.orbits.told(&model),
    };
    Ok(Signals {
        fs: run.fs,
        t: recorder.held.t,
        columns: recorder.held.columns,
        slices: recorder.slices,
        stats,
        provenance: provenance(run, done),
        scene: prepared.scene,
    })
}
