//! A run in pieces, between which it can be inspected and changed.

use std::ops::ControlFlow;

use serde_json::Value;

use super::budget;
use super::session::Session;
use super::simulate::simulate_with_progress;
use super::{Run, Snapshot};
use crate::base::error::{Error, Result};
use crate::dynamics::at_films_of;
use crate::inspect::{self, ContactSummary};
use crate::model::{Model, Race};
use crate::scene::{RingName, Scene};
use crate::signals::{Block, Keep, Signals};
use crate::statics::place;

/// A run that goes on in pieces.
///
/// Its motion and its record are those of [`simulate`](crate::simulate()), bit by bit, whatever the pieces: a step of the integrator
/// is not shortened where one ends; states there are read within the step. Of a run that ends by [`Simulation::finish`] before its
/// duration, the last step is not shortened to that end either: samples that reach into it, where signals are filtered the last 14, differ
/// from those of [`simulate`](crate::simulate()) by less than the integration error.
///
/// ```
/// use ballrace::scene::{RingName, presets};
/// use ballrace::{Run, Simulation};
///
/// let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
/// // A run that ends when `finish` is called.
/// let run = Run { duration: Run::OPEN, ..Run::default() };
/// let mut simulation = Simulation::begin(&scene, &run)?;
/// while simulation.wrench(RingName::Outer)[1].abs() < 1000.0 {
///     let load = simulation.scene().loads["radial"].force.at(0.0);
///     simulation.change(&[("loads.radial.force", (load + 100.0).into())])?;
///     simulation.advance(2e-3)?;
/// }
/// let signals = simulation.finish()?;
/// assert!(signals.get("outer.ay").unwrap().len() >= 500);
/// # Ok::<(), ballrace::Error>(())
/// ```
///
/// [`change`](Self::change) says what may be changed between pieces, and what that costs.
pub struct Simulation {
    session: Session<'static>,
    /// Why it cannot go on.
    ended: Option<Error>,
}

impl std::fmt::Debug for Simulation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Simulation")
            .field("time", &self.time())
            .field("ended", &self.ended)
            .finish_non_exhaustive()
    }
}

impl Simulation {
    /// A scene at t = 0, settled as the run says. The duration of the run is where it ends by itself; [`Run::OPEN`] leaves that open.
    ///
    /// # Errors
    /// As [`simulate`](crate::simulate()), from before its first step.
    pub fn begin(scene: &Scene, run: &Run) -> Result<Self> {
        Self::begin_with_progress(scene, run, &mut |_| ControlFlow::Continue(()))
    }

    /// Begins as [`Self::begin`]; `progress` may stop it.
    ///
    /// # Errors
    /// As [`Self::begin`]; [`Error::Interrupted`] if `progress` broke off.
    pub fn begin_with_progress(
        scene: &Scene,
        run: &Run,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Self> {
        run.validate()?;
        let session = budget::within(run.time_limit, progress, |progress| {
            Session::begin(scene, run, Keep::Taken, simulate_with_progress, progress)
        })?;
        Ok(Self {
            session,
            ended: None,
        })
    }

    /// Goes on where a snapshot was taken.
    ///
    /// ```
    /// use ballrace::scene::{RingName, presets};
    /// use ballrace::{Run, Simulation};
    ///
    /// let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    /// let mut simulation = Simulation::begin(&scene, &Run { duration: Run::OPEN, ..Run::default() })?;
    /// simulation.advance(2e-3)?;
    /// let before = simulation.snapshot();
    /// simulation.change(&[("loads.radial.force", 2000.0.into())])?;
    /// simulation.advance(2e-3)?;
    /// let pushed = simulation.wrench(RingName::Outer); // N and N m, by the balls
    /// let again = Simulation::restore(&before)?;
    /// assert!(again.time() == 2e-3 && pushed[1].abs() > again.wrench(RingName::Outer)[1].abs());
    /// let signals = simulation.finish()?;
    /// assert_eq!(signals.get("outer.ay").unwrap().len(), 200);
    /// # Ok::<(), ballrace::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Snapshot`] where it is not what a run has given.
    pub fn restore(snapshot: &Snapshot) -> Result<Self> {
        let (run, prepared) = (snapshot.run(), snapshot.prepared());
        run.validate()?;
        let session = Session::restored(run, prepared, snapshot.remembered(), Keep::Taken)?;
        Ok(Self {
            session,
            ended: None,
        })
    }

    /// Snapshot of what the run needs to go on from here.
    pub fn snapshot(&mut self) -> Snapshot {
        let remembered = self.session.remembered();
        let Session { run, prepared, .. } = &self.session;
        Snapshot::new(self.time(), run, prepared, remembered)
    }

    /// The time that it has reached \[s\].
    pub fn time(&self) -> f64 {
        self.session.trajectory.time()
    }

    /// The scene as it is now, every defect at its number.
    pub fn scene(&self) -> &Scene {
        &self.session.prepared.scene
    }

    /// The run.
    pub fn run(&self) -> &Run {
        &self.session.run
    }

    /// The compiled scene, for [`crate::inspect`] and [`crate::dynamics`].
    pub fn model(&self) -> &Model {
        &self.session.model
    }

    /// The states of all bodies, in the order of [`Model::names`].
    pub fn state(&self) -> &[f64] {
        self.session.trajectory.last()
    }

    /// The contacts of every ball with outer and inner race.
    pub fn contacts(&self) -> Vec<[ContactSummary; 2]> {
        let (balls, y) = (0..self.model().balls.len(), self.state());
        at_films_of(self.model(), y, |model| {
            let of = |ball| Race::BOTH.map(|race| inspect::raw::contact(model, y, ball, race));
            balls.map(of).collect()
        })
    }

    /// Wrench of the balls on a ring: force along x, y and z \[N\], moment about the ring's centre of mass \[N m\].
    pub fn wrench(&self, ring: RingName) -> [f64; 6] {
        let y = self.state();
        at_films_of(self.model(), y, |model| {
            inspect::raw::wrench(model, y, ring.into())
        })
    }

    /// Goes on by a time \[s\].
    ///
    /// # Errors
    /// As [`Self::advance_to`].
    pub fn advance(&mut self, dt: f64) -> Result<()> {
        self.advance_to(self.time() + dt)
    }

    /// Goes on to a time \[s\].
    ///
    /// # Errors
    /// [`Error::Argument`] for a time that is over or beyond the duration of the run; [`Error::Integration`] where the motion
    /// cannot go on, and [`Error::Budget`] where it may not: then for good.
    pub fn advance_to(&mut self, time: f64) -> Result<()> {
        self.advance_with_progress(time, &mut |_| ControlFlow::Continue(()))
    }

    /// Goes on to a time \[s\]. `progress` receives the share done, 0 to 1, about every 20 ms, and may stop it; it then stands at a
    /// time before, and may go on.
    ///
    /// # Errors
    /// As [`Self::advance_to`]; [`Error::Interrupted`] if `progress` broke off.
    pub fn advance_with_progress(
        &mut self,
        time: f64,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<()> {
        let (now, end) = (self.time(), self.run().duration);
        if !(time >= now && time <= end) {
            let allowed =
                format!("from {now} s, where the simulation stands, to its end at {end} s");
            return Err(Error::argument("t", time, allowed));
        }
        let begins = self.session.trajectory.begins();
        self.go(time, false, &mut |share| {
            let reached = begins + share * (end - begins);
            progress(((reached - now) / (time - now)).min(1.0))
        })
    }

    /// The samples that are final and were not taken yet, before the time reached. Where signals are filtered, the last 14 become
    /// final later. Samples that nobody takes stay in memory until [`Self::finish`].
    pub fn take_block(&mut self) -> Block {
        let time = self.time();
        self.session.recorder.take(time)
    }

    /// Changes fields of the scene by their paths, as [`Scene::with`] does: loads, moments, the drive, gravity, clearances, defects,
    /// friction, whatever leaves bodies, their directions and probes as they are.
    ///
    /// The scene is compiled anew and the integrator starts anew, as at a corner of a table; the motion goes on from where it is. Tables
    /// in time go on with the time of the run. A new driving speed holds at once: to change it smoothly, give a ramp or a table. A clearance that is
    /// smaller may press balls into races.
    ///
    /// # Errors
    /// [`Error::Scene`] names the field, [`Error::Argument`] what cannot be changed; the simulation is then as it was.
    pub fn change(&mut self, changes: &[(&str, Value)]) -> Result<()> {
        self.check()?;
        let scene = self.scene().with(changes)?;
        let (scene, placed) = place(&scene)?;
        self.session.change(scene.into_owned(), placed)
    }

    /// Sets the sizes of constant loads and moments, and of a constant torque of the drive, by their paths: `loads.radial.force`,
    /// `moments.tilt.moment`, `drive.torque.value`. They hold until they are set again.
    ///
    /// For forces from another simulation, which exchanges them every few microseconds: the integrator starts anew, as in
    /// [`Self::change`], but nothing is compiled. Tolerances, step limits, films, textures and places of defects stay those of the loads that
    /// the scene was compiled with; give it loads of the size that is to come, or [`Self::change`] it. Sizes that are those before leave
    /// the motion as it is, bit by bit.
    ///
    /// ```
    /// use ballrace::scene::presets;
    /// use ballrace::{Run, Simulation};
    ///
    /// let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    /// let mut simulation = Simulation::begin(&scene, &Run { duration: Run::OPEN, ..Run::default() })?;
    /// let y = simulation.model().names().iter().position(|name| name == "inner.y").unwrap();
    /// // A belt pulls the inner ring down by 500 N, and by 50 N/µm more as it is stretched; held for 10 µs each.
    /// let rest = simulation.state()[y];
    /// for step in 1..=100 {
    ///     let stretch = simulation.state()[y] - rest;
    ///     simulation.set_loads(&[("loads.radial.force", 500.0 + 5e7 * stretch)])?;
    ///     simulation.advance_to(1e-5 * f64::from(step))?;
    /// }
    /// assert!((simulation.state()[y] - rest).abs() < 1e-6);
    /// # Ok::<(), ballrace::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Scene`] names the path that is none of these, or whose size changes in time; the simulation is then as it was.
    pub fn set_loads(&mut self, loads: &[(&str, f64)]) -> Result<()> {
        self.check()?;
        self.session.set_loads(loads)
    }

    /// Moves rings whose motion the scene gives from where they are to places \[m\] or tilts \[rad\] with speeds \[m/s\], \[rad/s\] at a
    /// time \[s\], by the paths of their motions: `inner_ring.support.x.given`. After that time they go on with these speeds, until they are
    /// moved again.
    ///
    /// For rings that are part of another simulation, which says before each piece where they will be at its end. Places and speeds
    /// are continuous: a cubic leads from one to the other. The integrator starts anew, as in [`Self::change`], but nothing is
    /// compiled.
    ///
    /// ```
    /// use ballrace::scene::{Mount, RingName, presets};
    /// use ballrace::{Run, Simulation};
    ///
    /// let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    /// // The shaft of another program carries the inner ring.
    /// let support = &mut scene.inner_ring.support;
    /// (support.x, support.y) = (Some(Mount::given(0.0)), Some(Mount::given(-2e-5)));
    /// let mut simulation = Simulation::begin(&scene, &Run { duration: Run::OPEN, ..Run::default() })?;
    /// let before = simulation.wrench(RingName::Inner)[1];
    /// for step in 1..=10 {
    ///     let t = 1e-4 * f64::from(step);
    ///     // Down by another 5 µm in 1 ms.
    ///     simulation.set_motions(&[("inner_ring.support.y.given", [-2e-5 - 5e-3 * t, -5e-3])], t)?;
    ///     simulation.advance_to(t)?;
    /// }
    /// assert!(simulation.wrench(RingName::Inner)[1] > before + 100.0);
    /// # Ok::<(), ballrace::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Scene`] names the path that is no given motion, or a place that is too far, [`Error::Argument`] a time that is over; the simulation
    /// is then as it was.
    pub fn set_motions(&mut self, motions: &[(&str, [f64; 2])], until: f64) -> Result<()> {
        self.check()?;
        self.session.set_motions(motions, until)
    }

    /// Ends the run here: the samples that were not taken, statistics and provenance.
    ///
    /// # Errors
    /// [`Error::Argument`] before the first sample, else as [`Self::advance_to`].
    pub fn finish(self) -> Result<Signals> {
        self.finish_with_progress(&mut |_| ControlFlow::Continue(()))
    }

    /// Finishes as [`Self::finish`]; `progress` may stop it.
    ///
    /// # Errors
    /// As [`Self::finish`]; [`Error::Interrupted`] if `progress` broke off.
    pub fn finish_with_progress(
        mut self,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Signals> {
        self.check_end()?;
        let time = self.time();
        if time < self.run().duration {
            self.session.recorder.end_at(time);
            self.session.run.duration = time;
        }
        self.go(time, true, progress)?;
        Ok(self.session.into_signals())
    }

    /// Whether the run can be ended here, which takes it.
    ///
    /// # Errors
    /// As [`Self::finish`], from before its last steps.
    pub fn check_end(&self) -> Result<()> {
        self.check()?;
        if self.time() > 0.0 {
            return Ok(());
        }
        let allowed = "above 0, where there is a record: advance it first";
        Err(Error::argument("t", self.time(), allowed))
    }

    fn go(
        &mut self,
        until: f64,
        ends: bool,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<()> {
        self.check()?;
        let (limit, session) = (self.session.run.time_limit, &mut self.session);
        let gone = budget::within(limit, progress, |progress| {
            session.go(until, ends, progress)
        });
        if let Err(error @ (Error::Integration { .. } | Error::Budget { .. })) = &gone
            && !matches!(
                error,
                Error::Budget {
                    name: "time_limit",
                    ..
                }
            )
        {
            self.ended = Some(error.clone());
        }
        gone
    }

    fn check(&self) -> Result<()> {
        self.ended.clone().map_or(Ok(()), Err)
    }
}
