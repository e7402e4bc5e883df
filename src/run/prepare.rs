//! Preparation of a run: its own settings in the scene, memory for its record, a settled start, nodes and tolerance.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use super::Run;
use super::accuracy;
use super::settle::{self, Settled};
use crate::base::error::Result;
use crate::base::memory;
use crate::model::{Model, Placed};
use crate::scene::{Scene, TimeFunction};
use crate::signals::{Accuracy, Demand, Signals};
use crate::statics::start::Start;
use crate::statics::{compile, place};

/// A scene as it will run.
#[derive(Debug, Clone)]
pub(super) struct Prepared {
    pub scene: Scene,
    /// Loads and given motions with which the scene was compiled, by their paths, of those that were set since.
    pub compiled_with: BTreeMap<String, TimeFunction>,
    /// The defects by name, and where the contact runs that they were placed by.
    pub placed: BTreeMap<String, Placed>,
    pub settled: Settled,
    /// Choice for a requested accuracy.
    pub accuracy: Option<Accuracy>,
}

impl Prepared {
    /// Compiles it for a run, as it was before loads and motions were set.
    pub fn compile(&self, run: &Run) -> Result<Model> {
        compile_with(&self.scene, &self.compiled_with, run)
    }
}

/// Compiles a scene for a run with some loads and given motions, by their paths, and then gives it its own.
pub(super) fn compile_with(
    scene: &Scene,
    with: &BTreeMap<String, TimeFunction>,
    run: &Run,
) -> Result<Model> {
    if with.is_empty() {
        return Ok(compile(scene)?.recorded_to(run.band()));
    }
    let mut before = scene.clone();
    for (path, of) in with {
        if let Some(place) = before.in_time(path) {
            place.clone_from(of);
        }
    }
    Ok(compile(&before)?.recorded_to(run.band()).loaded(scene))
}

/// How pilot runs are simulated.
pub(super) type Simulate =
    fn(&Scene, &Run, &mut dyn FnMut(f64) -> ControlFlow<()>) -> Result<Signals>;

/// Prepares a run, whose record stays or leaves in blocks.
pub(super) fn prepare(
    scene: &Scene,
    run: &Run,
    in_blocks: bool,
    simulate: Simulate,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Prepared> {
    let (scene, placed) = place(scene)?;
    let mut scene = scene.into_owned();
    if let Some(rtol) = run.rtol {
        scene.solver.rtol = rtol.into();
    }
    scene.solver.method = run.method.unwrap_or(scene.solver.method);
    if run.accuracy.is_some() {
        accuracy::check(&scene)?;
    }
    // Before anything is computed; once more when it is known how fine signals are read.
    check_memory(&scene, run, run.samples()?, 1, in_blocks)?;
    let settled = settle::settle(&scene, run, progress)?;
    let accuracy = run.accuracy.map(|requested| {
        let pilot = &mut |scene: &Scene, from: &Start| pilot(scene, from, run, simulate, progress);
        accuracy::choose(requested, &mut scene, &settled.from, pilot)
    });
    Ok(Prepared {
        accuracy: accuracy.transpose()?,
        scene,
        compiled_with: BTreeMap::new(),
        placed,
        settled,
    })
}

/// The first milliseconds of a run: samples of its first column, and the evaluations.
fn pilot(
    scene: &Scene,
    from: &Start,
    run: &Run,
    simulate: Simulate,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(Vec<f64>, usize)> {
    let duration = run.duration.min(accuracy::HORIZON);
    let first = Run {
        duration,
        fs: accuracy::sampling_rate(duration, run.fs, run.bandwidth),
        start: from.clone(),
        accuracy: None,
        settle: Some(0.0),
        // The clock of the run goes on.
        time_limit: None,
        ..run.clone()
    };
    let mut out = simulate(scene, &first, &mut |_| progress(0.0))?;
    Ok((out.columns.remove(0).values, out.stats.nfev))
}

/// Refuses what does not fit into memory: for so many samples, read so many times as fine, kept or leaving in blocks.
pub(super) fn check_memory(
    scene: &Scene,
    run: &Run,
    count: usize,
    oversampling: usize,
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
