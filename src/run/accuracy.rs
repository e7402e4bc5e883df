//! Tolerance and nodes for a requested accuracy of the accelerations, chosen by pilot runs.
//!
//! What a scene needs cannot be seen from its numbers: a small signal under heavy loads needs many nodes, a light bearing
//! whose balls rattle a tight tolerance and few nodes. So the first milliseconds are run with one
//! setting and with the next finer one, until the two agree to a third of the request: first for the tolerance, then
//! for the nodes. The difference of neighbours is the error of the coarser, for the finer is several times better.

use super::step_limit;
use crate::base::error::{Error, Result};
use crate::model::{Body, Dof, Model};
use crate::scene::{Component, Contact, Method, MotionProbe, Scene, Slices};
use crate::signals::{Accuracy, Bandwidth};
use crate::statics::compile;
use crate::statics::start::{Start, start};

/// Length of a pilot run \[s\]: the horizon.
pub(crate) const HORIZON: f64 = 3e-3;
/// Sampling rate at which pilot runs without a band are compared \[Hz\].
const FS: f64 = 100e3;
/// Samples of a pilot run below which it is sampled faster.
const SAMPLES: f64 = 10.0;
/// Share of the request that tolerance and nodes may each use.
const SHARE: f64 = 1.0 / 3.0;
/// First tolerance tried over the request: for 1 % that of records in a band.
const FIRST: f64 = 1e-2;
/// The tightest.
const TIGHTEST: f64 = 1e-11;
/// Numbers of nodes tried: the default, then each about half as many again as the one before.
const NODES: [usize; 7] = [6, 8, 12, 18, 26, 38, 64];

/// Runs a scene from a state for the horizon, or less if the run is shorter: samples of its only probe's only column,
/// and the evaluations that it took.
pub(crate) type Pilot<'a> = dyn FnMut(&Scene, &Start) -> Result<(Vec<f64>, usize)> + 'a;

/// Puts tolerance, nodes and step cap into a scene, for a given start.
pub(crate) fn choose(
    requested: f64,
    scene: &mut Scene,
    from: &Start,
    pilot: &mut Pilot<'_>,
) -> Result<Accuracy> {
    let fitted = scene.contacts_mut().any(|contact| is_fitted(contact));
    let mut finest = scene.clone();
    set_nodes(&mut finest, NODES[NODES.len() - 1]);
    let model = compile(&finest)?;
    cap(scene, &model);
    let mut pilots = Pilots::new(scene, &model, from, pilot)?;
    let share = SHARE * requested;
    let tolerances = tolerances(requested);
    let first = pilots.run(tolerances[0], NODES[0])?;
    let (rtol, integration_error, first) =
        climb(&tolerances, first, share, |rtol| pilots.run(rtol, NODES[0]))?;
    let (mut nodes, mut node_error) = (NODES[0], None);
    if fitted {
        let (count, error, _) = climb(&NODES, first, share, |count| pilots.run(rtol, count))?;
        (nodes, node_error) = (count, Some(error));
    }
    scene.solver.rtol = rtol.into();
    set_nodes(scene, nodes);
    Ok(Accuracy {
        requested,
        rtol,
        nodes: compile(scene)?.slices(),
        integration_error,
        node_error,
        pilot_evaluations: pilots.evaluations,
    })
}

/// Sampling rate of a pilot run of a duration \[s\], of a run at a rate \[Hz\]: in a band that of the run, as long as there are some
/// samples; of point samples one which is exceeded only by the usual one.
pub(crate) fn sampling_rate(duration: f64, of_run: f64, bandwidth: Bandwidth) -> f64 {
    match bandwidth {
        Bandwidth::Auto => of_run.max(SAMPLES / duration),
        Bandwidth::Raw => (SAMPLES / duration).clamp(FS, FS.max(of_run)),
    }
}

fn is_fitted(contact: &Contact) -> bool {
    !matches!(contact.slices, Slices::Fixed(_))
}

/// Gives all contacts that are cut at nodes so many of them.
fn set_nodes(scene: &mut Scene, count: usize) {
    for contact in scene.contacts_mut().filter(|contact| is_fitted(contact)) {
        contact.slices = Slices::Fitted(count);
    }
}

/// Refuses what cannot be asked for, of this scene.
pub(crate) fn check(scene: &Scene) -> Result<()> {
    if scene.solver.method != Method::Adams {
        let allowed = "adams where `accuracy` is given: its choice is measured on that method";
        return Err(Error::scene("method", scene.solver.method, allowed));
    }
    Ok(())
}

/// Puts the step cap into the scene, so that it gives the same run again.
fn cap(scene: &mut Scene, model: &Model) {
    let solver = &mut scene.solver;
    if solver.frequency_cap {
        let cap = step_limit::largest(solver.method, model);
        solver.max_step = Some(solver.max_step.map_or(cap, |step| step.min(cap)));
        solver.frequency_cap = false;
    }
}

/// Tolerances from the first one down to the tightest, by tens.
fn tolerances(requested: f64) -> Vec<f64> {
    let mut all = vec![FIRST * requested];
    while let Some(&last) = all.last()
        && last > 1.001 * TIGHTEST
    {
        all.push((0.1 * last).max(TIGHTEST));
    }
    all
}

/// The first candidate that differs from the next by no more than a share, or the last one; that difference; and what its
/// pilot gave. `now` is what the first candidate gave.
fn climb<T: Copy>(
    candidates: &[T],
    mut now: Vec<f64>,
    share: f64,
    mut pilot: impl FnMut(T) -> Result<Vec<f64>>,
) -> Result<(T, f64, Vec<f64>)> {
    let mut error = f64::INFINITY;
    for pair in candidates.windows(2) {
        let next = pilot(pair[1])?;
        error = apart(&now, &next);
        if error <= share {
            return Ok((pair[0], error, now));
        }
        now = next;
    }
    Ok((candidates[candidates.len() - 1], error, now))
}

/// Relative difference in the L2 norm.
fn apart(x: &[f64], truth: &[f64]) -> f64 {
    let square = |values: &mut dyn Iterator<Item = f64>| values.map(|v| v * v).sum::<f64>();
    let difference = square(&mut x.iter().zip(truth).map(|(a, b)| a - b));
    if difference == 0.0 {
        return 0.0;
    }
    (difference / square(&mut truth.iter().copied())).sqrt()
}

/// Runs of the first milliseconds from one state.
struct Pilots<'a, 'b> {
    scene: Scene,
    from: Start,
    pilot: &'a mut Pilot<'b>,
    evaluations: usize,
}

impl<'a, 'b> Pilots<'a, 'b> {
    /// `model` gives the state from which they start, where none is given.
    fn new(scene: &Scene, model: &Model, from: &Start, pilot: &'a mut Pilot<'b>) -> Result<Self> {
        let mut scene = scene.clone();
        let moves = |body: &&Body| body.degrees[Dof::Y].is_free();
        let body = model.bodies.iter().find(moves);
        let body = &body.unwrap_or(&model.bodies[0]).name;
        let probe = MotionProbe::of(body).components([Component::Ay]);
        scene.probes = [("pilot".to_owned(), probe.into())].into();
        Ok(Self {
            scene,
            from: Start::State(start(model, from)?),
            pilot,
            evaluations: 0,
        })
    }

    /// The acceleration with a tolerance and nodes.
    fn run(&mut self, rtol: f64, nodes: usize) -> Result<Vec<f64>> {
        self.scene.solver.rtol = rtol.into();
        set_nodes(&mut self.scene, nodes);
        let (values, evaluations) = (self.pilot)(&self.scene, &self.from)?;
        self.evaluations += evaluations;
        Ok(values)
    }
}
