//! A run paused at a time: its compiled model, the state of the motion, and the record so far.

use std::collections::BTreeMap;

use super::Run;
use super::follow::{Interval, Trajectory};
use super::pool::on;
use super::prepare::{Prepared, Simulate, check_memory, compile_with, prepare};
use super::provenance::{Done, provenance};
use super::selftest;
use super::settings::{options, threads};
use super::snapshot::{Remembrance, refused_at};
use super::watch::Progress;
use crate::base::error::{Error, Result};
use crate::base::words::{Unfit, Words};
use crate::dynamics::Dynamics;
use crate::integrate::Options;
use crate::model::{Degree, Dof, Model, Placed, Race};
use crate::reduction::Reduction;
use crate::scene::{Profile, Scene, TimeFunction};
use crate::signals::{Keep, Recorder, Sampling, Signals, Statistics};
use crate::simd::Distrust;
use crate::statics::start::start;

/// A run between its pieces.
pub(super) struct Session<'s> {
    pub run: Run,
    pub prepared: Prepared,
    pub model: Model,
    distrust: Option<Distrust>,
    reduction: Option<Reduction>,
    pub sampling: Sampling,
    threads: usize,
    options: Options,
    pub trajectory: Trajectory,
    pub recorder: Recorder<'s>,
    /// Statistics of the run before its scene was changed.
    earlier: Option<Statistics>,
}

impl<'s> Session<'s> {
    /// A scene at t = 0, settled. `simulate` runs pilots.
    pub fn begin(
        scene: &Scene,
        run: &Run,
        keep: Keep<'s>,
        simulate: Simulate,
        progress: Progress<'_>,
    ) -> Result<Self> {
        let in_blocks = !keep.is_all();
        let prepared = prepare(scene, run, in_blocks, simulate, progress)?;
        let (model, distrust) = selftest::trusted(prepared.compile(run)?);
        let y0 = start(&model, &prepared.settled.from)?;
        let sampling = Sampling::new(run.bandwidth, run.fs, model.scales.frequency)?;
        let (count, oversampling) = (run.samples()?, sampling.oversampling);
        check_memory(&prepared.scene, run, count, oversampling, in_blocks)?;
        let options = options(&model);
        let trajectory = Trajectory::new(&model, y0, whole(run), options.max_step);
        Self::of(run, prepared, model, distrust, sampling, trajectory, keep)
    }

    /// The session of a run where it stood.
    pub fn restored(
        run: &Run,
        prepared: Prepared,
        remembered: &Remembrance,
        keep: Keep<'s>,
    ) -> Result<Self> {
        let (model, distrust) = selftest::trusted(prepared.compile(run)?);
        let options = options(&model);
        let y = vec![0.0; model.dim()];
        let mut trajectory = Trajectory::new(&model, y, whole(run), options.max_step);
        let unfit = |Unfit| {
            refused_at(
                "snapshot",
                "words of another run",
                "what a run has given".to_owned(),
            )
        };
        Words::load(&remembered.trajectory, &mut trajectory).map_err(unfit)?;
        if trajectory.first().len() != model.dim() {
            return Err(unfit(Unfit));
        }
        let sampling = Sampling::again(run.bandwidth, run.fs, remembered.oversampling);
        let mut made = Self::of(run, prepared, model, distrust, sampling, trajectory, keep)?;
        Words::load(&remembered.recorder, &mut made.recorder).map_err(unfit)?;
        made.earlier = remembered.earlier;
        Ok(made)
    }

    fn of(
        run: &Run,
        prepared: Prepared,
        model: Model,
        distrust: Option<Distrust>,
        sampling: Sampling,
        trajectory: Trajectory,
        keep: Keep<'s>,
    ) -> Result<Self> {
        let (from, first) = (trajectory.begins(), trajectory.first());
        let reduction = Reduction::since(&model, from, first);
        let mut recorder = Recorder::new(&model, sampling, run.samples()?, keep);
        recorder.prepare(&Dynamics::begin(&model, reduction.as_ref(), first), first)?;
        Ok(Self {
            run: run.clone(),
            prepared,
            threads: threads(&model, run.threads)?,
            options: options(&model),
            model,
            distrust,
            reduction,
            sampling,
            trajectory,
            recorder,
            earlier: None,
        })
    }

    /// Memory that the session needs to go on.
    pub fn remembered(&mut self) -> Remembrance {
        Remembrance {
            trajectory: Words::saved(&mut self.trajectory),
            recorder: Words::saved(&mut self.recorder),
            oversampling: self.sampling.oversampling,
            earlier: self.earlier,
        }
    }

    /// Time before t = 0 in which the start settled \[s\].
    pub fn settled(&self) -> f64 {
        self.prepared.settled.seconds
    }

    /// Goes on to the duration of the run, and ends there.
    pub fn complete(mut self, progress: Progress<'_>) -> Result<Signals> {
        self.go(self.run.duration, true, progress)?;
        Ok(self.into_signals())
    }

    /// Goes on to a time \[s\], at most the duration of the run, and ends there if asked to.
    pub fn go(&mut self, until: f64, ends: bool, progress: Progress<'_>) -> Result<()> {
        let first = self.trajectory.first();
        let dynamics = Dynamics::begin(&self.model, self.reduction.as_ref(), first);
        let (trajectory, recorder) = (&mut self.trajectory, &mut self.recorder);
        let options = &self.options;
        on(
            self.threads,
            dynamics,
            progress,
            |mut dynamics, progress| {
                let of = &mut dynamics;
                trajectory.advance(of, recorder, until, options, progress)?;
                if ends {
                    trajectory.finish(of, recorder, options, progress)?;
                }
                Ok(())
            },
        )
    }

    /// Goes on with another scene of the same bodies and probes from where it stands, defects placed, and with its model.
    pub fn change(&mut self, scene: Scene, placed: BTreeMap<String, Placed>) -> Result<()> {
        let compiled_with = self.held_motions(&scene);
        let model = compile_with(&scene, &compiled_with, &self.run)?;
        check_kept(&self.model, &model)?;
        (self.prepared.compiled_with, self.prepared.placed) = (compiled_with, placed);
        self.go_on_with(model, scene);
        Ok(())
    }

    /// Motions that were set and that another scene keeps, held where they are: what they were before a run's time has no meaning.
    fn held_motions(&self, scene: &Scene) -> BTreeMap<String, TimeFunction> {
        let (mut before, mut after) = (self.prepared.scene.clone(), scene.clone());
        let set = self.prepared.compiled_with.keys();
        let kept = set.filter_map(|path| {
            let before = before.given_motion(path)?;
            let held = TimeFunction::Constant(before.at(self.trajectory.time()));
            let is_kept = after.given_motion(path) == Some(before);
            is_kept.then(|| (path.clone(), held))
        });
        kept.collect()
    }

    /// Goes on with other sizes of constant loads, by their paths, and otherwise with the model as it is.
    pub fn set_loads(&mut self, loads: &[(&str, f64)]) -> Result<()> {
        let mut scene = self.prepared.scene.clone();
        let mut compiled = self.prepared.compiled_with.clone();
        for (path, size) in loads {
            let before = std::mem::replace(scene.constant_load(path)?, *size);
            compiled.entry((*path).to_owned()).or_insert(before.into());
        }
        self.go_on_loaded(scene, compiled)
    }

    /// Goes on with given motions that lead from where rings are to places with speeds at a time \[s\], by their paths.
    pub fn set_motions(&mut self, motions: &[(&str, [f64; 2])], until: f64) -> Result<()> {
        let now = self.trajectory.time();
        if !(until > now && until.is_finite()) {
            let allowed = format!("later than {now} s, where the simulation stands");
            return Err(Error::argument("until", until, allowed));
        }
        let mut scene = self.prepared.scene.clone();
        let mut compiled = self.prepared.compiled_with.clone();
        for (path, [place, speed]) in motions {
            let motion = scene.motion_to_set(path)?;
            let spline = Profile::Spline {
                times: vec![now, until],
                values: vec![motion.at(now), *place],
                rates: vec![motion.rate(now), *speed],
            };
            let before = std::mem::replace(motion, TimeFunction::Profile(spline));
            compiled.entry((*path).to_owned()).or_insert(before);
        }
        self.go_on_loaded(scene, compiled)
    }

    fn go_on_loaded(
        &mut self,
        scene: Scene,
        compiled_with: BTreeMap<String, TimeFunction>,
    ) -> Result<()> {
        if scene == self.prepared.scene {
            return Ok(());
        }
        scene.validate()?;
        self.prepared.compiled_with = compiled_with;
        self.go_on_with(self.model.loaded(&scene), scene);
        Ok(())
    }

    fn go_on_with(&mut self, model: Model, scene: Scene) {
        let (model, distrust) = selftest::trusted(model);
        let (time, mut y) = (self.trajectory.time(), self.trajectory.last().to_vec());
        for race in Race::BOTH {
            let [before, after] =
                [&self.prepared.scene, &scene].map(|of| of.given_speed(race.into()));
            if let Some(speed) = after.filter(|_| before != after) {
                y[model.layout().speed_at(race.ring(), Dof::Theta)] = speed.at(time);
            }
        }
        let is_moved = self.prepared.scene.outer_ring != scene.outer_ring
            || self.prepared.scene.inner_ring != scene.inner_ring;
        if is_moved {
            model.follow_given(time, &mut y);
        }
        self.earlier = Some(self.statistics());
        self.options = options(&model);
        self.reduction = Reduction::since(&model, time, &y);
        let dynamics = Dynamics::begin(&model, self.reduction.as_ref(), &y);
        self.recorder.change(&dynamics, &y);
        self.trajectory = self.trajectory.after(&model, y, self.options.max_step);
        self.prepared.scene = scene;
        (self.model, self.distrust) = (model, distrust);
    }

    /// Effort and mishaps until where it stands.
    fn statistics(&self) -> Statistics {
        let now = self.trajectory.statistics(&self.model);
        self.earlier.map_or(now, |earlier| earlier.and(&now))
    }

    /// Signals that the run has given.
    pub fn into_signals(self) -> Signals {
        let mut stats = self.statistics();
        stats.acceleration_residual = self.recorder.residual.value();
        let settled = &self.prepared.settled;
        (stats.settling_accepted, stats.settling_nfev) = (settled.accepted, settled.nfev);
        let done = Done {
            prepared: &self.prepared,
            model: &self.model,
            distrust: self.distrust,
            sampling: self.sampling,
            threads: self.threads,
            options: &self.options,
            reduction: self.reduction,
            defects: self
                .recorder
                .watch
                .results(&self.model, &self.prepared.placed),
            kinematics: self.recorder.orbits.results(&self.model),
        };
        Signals {
            fs: self.run.fs,
            t: self.recorder.held.t,
            columns: self.recorder.held.columns,
            slices: self.recorder.slices,
            end_state: self.trajectory.last().to_vec(),
            stats,
            provenance: provenance(&self.run, done),
            scene: self.prepared.scene,
        }
    }
}

/// Refuses a model that has other bodies, directions, or columns.
fn check_kept(before: &Model, after: &Model) -> Result<()> {
    let others =
        "changes that keep bodies, held directions and probes; begin another simulation for others";
    let refuse = |what: &str| Err(Error::argument("changes", what, others));
    let held = |model: &Model| -> Vec<bool> {
        let held = |race: Race| move |dof: Dof| model.rings[race].given.of(dof).is_some();
        let degrees = model.bodies.iter().flat_map(|body| body.degrees);
        let fixed = degrees.map(|degree| degree == Degree::Fixed);
        let given = Race::BOTH.map(|race| Dof::TRANSLATIONS.map(held(race)));
        fixed.chain(given.into_iter().flatten()).collect()
    };
    let rows = |model: &Model| -> Vec<usize> { model.rows.iter().map(|row| row.count).collect() };
    if before.layout() != after.layout() || rows(before) != rows(after) {
        return refuse("other bodies or directions");
    }
    if held(before) != held(after) {
        return refuse("other directions that are held");
    }
    let recorded = |model: &Model| {
        let scene = model.scene();
        (scene.recorded().into_owned(), scene.cage.is_some())
    };
    if recorded(before) != recorded(after) {
        return refuse("other probes");
    }
    Ok(())
}

/// Interval of a whole run.
fn whole(run: &Run) -> Interval {
    Interval {
        zero: 0.0,
        from: 0.0,
        to: run.duration,
        max_steps: run.max_steps,
    }
}
