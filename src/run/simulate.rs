//! A run: scene → model → start → settle → integrate → signals.

use std::ops::ControlFlow;
use std::sync::Mutex;

use super::Run;
use super::budget;
use super::session::Session;
use crate::base::error::Result;
use crate::scene::Scene;
use crate::signals::{Block, BlockSink, Keep, Signals};

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
/// [`Error::Scene`], [`Error::Argument`] for bad input, [`Error::Memory`] for more samples than fit, [`Error::Equilibrium`] from the
/// start, [`Error::Integration`] where the integration cannot go on, [`Error::Budget`] where it costs more than the run
/// allows.
///
/// [`Error::Scene`]: crate::Error::Scene
/// [`Error::Argument`]: crate::Error::Argument
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
/// let rest = simulate_into(&scene, &run, &mut sink, &mut |_| Continue(())).unwrap();
/// assert_eq!((samples, rest.t.len()), (50, 0));
/// assert!(peak > 0.0 && rest.stats.accepted > 0);
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
    let keep = sink.map_or(Keep::All, |sink| Keep::Left(Mutex::new(sink)));
    let session = Session::begin(scene, run, keep, simulate_with_progress, progress)?;
    let settled = session.settled();
    let whole = settled + run.duration;
    let mut progress = |share: f64| progress((settled + share * run.duration) / whole);
    session.complete(&mut progress)
}
