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
/// Tolerance of each setting over that of the one before.
const FINER_TOLERANCE: f64 = 0.1;
/// Step cap of each setting over that of the one before. With the cap as it is two neighbours that both follow it agree,
/// whatever it leaves: of 40 random bearings three then missed a request of 1e-3, by up to 2.3 times.
const FINER_CAP: f64 = 0.75;
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
    let settings = settings(requested, step_limit::cap(&model));
    scene.solver.frequency_cap = false;
    let mut pilots = Pilots::new(scene, &model, from, pilot)?;
    let share = SHARE * requested;
    let first = pilots.run(settings[0], NODES[0])?;
    let (steps, integration_error, first) =
        climb(&settings, first, share, |steps| pilots.run(steps, NODES[0]))?;
    let (mut nodes, mut node_error) = (NODES[0], None);
    if fitted {
        let (count, error, _) = climb(&NODES, first, share, |count| pilots.run(steps, count))?;
        (nodes, node_error) = (count, Some(error));
    }
    steps.put_into(scene);
    set_nodes(scene, nodes);
    Ok(Accuracy {
        requested,
        rtol: steps.rtol,
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

/// How long steps may be.
#[derive(Debug, Clone, Copy)]
struct Steps {
    rtol: f64,
    /// Longest \[s\]; infinite without a limit.
    cap: f64,
}

impl Steps {
    /// Puts them into a scene, so that it gives the same run again.
    fn put_into(self, scene: &mut Scene) {
        let solver = &mut scene.solver;
        solver.rtol = self.rtol.into();
        if self.cap.is_finite() {
            solver.max_step = Some(solver.max_step.map_or(self.cap, |step| step.min(self.cap)));
        }
    }
}

/// Settings for a request from the first, loosest one with a cap \[s\] down to the tightest tolerance.
fn settings(requested: f64, cap: f64) -> Vec<Steps> {
    let mut all = vec![Steps {
        rtol: FIRST * requested,
        cap,
    }];
    while let Some(&last) = all.last()
        && last.rtol > 1.001 * TIGHTEST
    {
        all.push(Steps {
            rtol: (FINER_TOLERANCE * last.rtol).max(TIGHTEST),
            cap: FINER_CAP * last.cap,
        });
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

    /// The acceleration with steps and nodes.
    fn run(&mut self, steps: Steps, nodes: usize) -> Result<Vec<f64>> {
        let mut scene = self.scene.clone();
        steps.put_into(&mut scene);
        set_nodes(&mut scene, nodes);
        let (values, evaluations) = (self.pilot)(&scene, &self.from)?;
        self.evaluations += evaluations;
        Ok(values)
    }
}
