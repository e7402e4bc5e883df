//! Follows a motion over a stretch of time, step by step, and detects when it is no longer physical.

use std::ops::ControlFlow;

use super::beyond::go_on;
use super::budget::StepBudget;
use super::ending::{Halt, broken};
use super::method::{self, Integration, Memory};
use super::orbit;
use super::runaway;
use super::settings::tolerance;
use super::step_collapse::StepCollapse;
use super::watch::{Progress, REPORT_EVERY, StepWatch};
use crate::base::clock;
use crate::base::error::{Error, Result};
use crate::base::words::{Remembered, Words};
use crate::dynamics::Dynamics;
use crate::forces::blame;
use crate::inspect;
use crate::integrate::{self, DenseStep, Observer, Options, StepStatistics};
use crate::model::Model;
use crate::signals::Statistics;

/// Number of steps after which the clock is read: of a small model's step that would take a fiftieth. One of a large model is long enough to ask
/// after each.
const ASK_EVERY: usize = 8;

/// A time to integrate over, on the integrator's clock, which was 0 at some time of the run \[s\].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Interval {
    pub zero: f64,
    pub from: f64,
    pub to: f64,
    /// Steps that it may take.
    pub max_steps: Option<usize>,
}

/// A motion that is followed over an interval, in pieces whose number and length have no effect on it.
#[derive(Debug, Clone)]
pub(crate) struct Trajectory {
    interval: Interval,
    /// States of all bodies where it begins, and where it stands.
    first: Vec<f64>,
    last: Vec<f64>,
    /// The run's own states where it stands, and the time \[s\].
    own: Vec<f64>,
    time: f64,
    /// Memory of the integration; none before its first step, and at its end.
    memory: Option<Memory>,
    /// Whether the watch is still to see its first state.
    is_unseen: bool,
    collapse: StepCollapse,
    steps: StepBudget,
    stats: StepStatistics,
    pulls: usize,
    truncated: usize,
    nfev_past_end: usize,
    wall_time: f64,
}

impl Trajectory {
    /// The motion from a state of all bodies. The watch sees it.
    pub fn new(model: &Model, y0: Vec<f64>, interval: Interval, max_step: f64) -> Self {
        Self {
            interval,
            last: y0.clone(),
            first: y0,
            own: Vec::new(),
            time: interval.from,
            memory: None,
            is_unseen: true,
            collapse: StepCollapse::new(model, max_step),
            steps: StepBudget::new(interval.max_steps),
            stats: StepStatistics::default(),
            pulls: 0,
            truncated: 0,
            nfev_past_end: 0,
            wall_time: 0.0,
        }
    }

    /// The motion from where this one stands, with another model: steps count on, the watch goes on.
    pub fn after(&self, model: &Model, y0: Vec<f64>, max_step: f64) -> Self {
        let from = self.time;
        Self {
            is_unseen: self.is_unseen,
            steps: self.steps,
            ..Self::new(
                model,
                y0,
                Interval {
                    from,
                    ..self.interval
                },
                max_step,
            )
        }
    }

    /// Beginning on the integrator's clock \[s\].
    pub fn begins(&self) -> f64 {
        self.interval.from
    }

    /// The states of all bodies where it begins.
    pub fn first(&self) -> &[f64] {
        &self.first
    }

    /// The states of all bodies where it stands.
    pub fn last(&self) -> &[f64] {
        &self.last
    }

    /// Present time on the integrator's clock \[s\].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Goes on to a time within the interval \[s\].
    pub fn advance(
        &mut self,
        dynamics: &mut Dynamics<'_>,
        watch: &mut dyn StepWatch,
        until: f64,
        options: &Options,
        progress: Progress<'_>,
    ) -> Result<()> {
        if self.time >= until {
            return Ok(());
        }
        let begun = clock::now();
        blame::forget();
        let model = dynamics.model();
        let tolerance = tolerance(dynamics)?;
        let y0 = dynamics.compress(&self.first);
        if self.own.is_empty() {
            self.own.clone_from(&y0);
        }
        if std::mem::take(&mut self.is_unseen) {
            watch.first(dynamics, &y0);
        }
        let Interval { zero, from, to, .. } = self.interval;
        let mut memory = self.memory.take();
        let mut follower = Follower {
            bounds: runaway::Bounds::new(dynamics, &self.first),
            ask_every: if model.is_large() { 1 } else { ASK_EVERY },
            reported: begun,
            halt: None,
            spent: false,
            paused: false,
            of: self,
            watch,
            until,
            progress,
        };
        let task = Integration {
            span: (from, to),
            y0: &y0,
            tolerance: &tolerance,
            options,
        };
        let solved = method::run(dynamics, task, &mut memory, &mut follower);
        let Follower {
            halt,
            spent,
            paused,
            ..
        } = follower;
        dynamics.expand(self.time, &self.own, &mut self.last);
        let solution =
            solved.map_err(|failure| blame::blamed(broken(model, &self.last, zero, &failure)))?;
        // Whoever was interrupted may go on.
        self.memory = memory;
        if let Some((step, why)) = halt {
            return Err(blame::blamed(why.error(
                model,
                &self.last,
                zero + self.time,
                step,
            )));
        }
        if spent {
            return Err(self.steps.error(zero + self.time));
        }
        if solution.interrupted && !paused {
            let time = zero + self.time;
            return Err(Error::Interrupted { time });
        }
        self.stats = solution.stats;
        self.wall_time += clock::since(begun);
        Ok(())
    }

    /// Ends it where it stands: follows the motion beyond for what the watch takes from there.
    pub fn finish(
        &mut self,
        dynamics: &mut Dynamics<'_>,
        watch: &mut dyn StepWatch,
        options: &Options,
        progress: Progress<'_>,
    ) -> Result<()> {
        let begun = clock::now();
        let tolerance = tolerance(dynamics)?;
        self.nfev_past_end = go_on(
            dynamics, watch, self.time, &self.own, &tolerance, options, progress,
        )?;
        if watch.finish().is_break() {
            let time = self.interval.zero + self.time;
            return Err(Error::Interrupted { time });
        }
        let _ = progress(1.0);
        self.wall_time += clock::since(begun);
        Ok(())
    }

    /// Statistics of the motion.
    pub fn statistics(&self, model: &Model) -> Statistics {
        Statistics {
            clamped_pulls: self.pulls,
            truncated_contacts: self.truncated,
            wall_time: self.wall_time,
            nfev_past_end: self.nfev_past_end,
            ..statistics(model, &self.stats, &self.first, &self.last)
        }
    }
}

impl Remembered for Trajectory {
    fn pass(&mut self, words: &mut Words) {
        self.interval.from.pass(words);
        self.interval.to.pass(words);
        self.first.pass(words);
        self.last.pass(words);
        self.own.pass(words);
        self.time.pass(words);
        self.memory.pass(words);
        self.is_unseen.pass(words);
        self.collapse.pass(words);
        self.steps.pass(words);
        self.stats.pass(words);
        self.pulls.pass(words);
        self.truncated.pass(words);
        self.nfev_past_end.pass(words);
    }
}

/// Sees the steps of a piece.
struct Follower<'a, 'w, 'p> {
    of: &'a mut Trajectory,
    watch: &'w mut dyn StepWatch,
    until: f64,
    bounds: runaway::Bounds,
    progress: Progress<'p>,
    ask_every: usize,
    reported: f64,
    /// Why it cannot go on, after a step \[s\].
    halt: Option<(f64, Halt)>,
    /// Whether all steps are spent.
    spent: bool,
    /// Whether the end of the piece has been reached within a step.
    paused: bool,
}

impl<'m> Observer<Dynamics<'m>> for Follower<'_, '_, '_> {
    fn accepted(
        &mut self,
        dynamics: &mut Dynamics<'m>,
        step: &DenseStep<'_>,
        stats: &StepStatistics,
    ) -> ControlFlow<()> {
        // Of a step in which the last piece has ended the rest is left.
        let is_new = stats.accepted > self.of.stats.accepted;
        let lost = if is_new { self.count(dynamics) } else { None };
        let watched = self.watch.step(dynamics, step, self.until);
        self.of.own.copy_from_slice(step.y1());
        self.of.time = step.t1();
        if is_new {
            self.of.stats = *stats;
            self.judge(step, lost)?;
            // What a force gave in steps that were rejected has passed.
            blame::forget();
            self.spent = self.of.steps.spent(stats) && step.t1() < self.of.interval.to;
        }
        if self.spent || watched.is_break() {
            return ControlFlow::Break(());
        }
        self.pause(step)?;
        self.report(step, stats)
    }
}

impl Follower<'_, '_, '_> {
    /// Counts what the evaluation at the accepted state, the last one, has met; why the run ends with it.
    fn count(&mut self, dynamics: &Dynamics<'_>) -> Option<Halt> {
        self.of.pulls += dynamics.pulls();
        self.of.truncated += dynamics.truncated();
        let layout = dynamics.model().layout();
        let lost = dynamics.lost().and_then(|body| layout.as_ball(body));
        lost.map(Halt::Escaped)
            .or_else(|| dynamics.out_of_pocket().map(Halt::OutOfPocket))
    }

    /// Breaks off where the motion is no longer worth following.
    fn judge(&mut self, step: &DenseStep<'_>, lost: Option<Halt>) -> ControlFlow<()> {
        let crawls = self.of.collapse.after(step.h());
        let left = || self.bounds.left(step.y1());
        let why = lost
            .or_else(|| left().map(|(body, does)| Halt::RanAway(body, does)))
            .or_else(|| crawls.then_some(Halt::Crawls));
        match why {
            Some(why) => {
                self.halt = Some((step.h(), why));
                ControlFlow::Break(())
            }
            None => ControlFlow::Continue(()),
        }
    }

    /// Breaks off where the piece ends within the step, or with it but for the whole interval.
    fn pause(&mut self, step: &DenseStep<'_>) -> ControlFlow<()> {
        if step.t1() < self.until || self.until >= self.of.interval.to {
            return ControlFlow::Continue(());
        }
        if self.until < step.t1() {
            step.interpolate(self.until, &mut self.of.own);
            self.of.time = self.until;
        }
        self.paused = true;
        ControlFlow::Break(())
    }

    fn report(&mut self, step: &DenseStep<'_>, stats: &StepStatistics) -> ControlFlow<()> {
        if !stats.accepted.is_multiple_of(self.ask_every)
            || clock::since(self.reported) < REPORT_EVERY
        {
            return ControlFlow::Continue(());
        }
        self.reported = clock::now();
        let Interval { from, to, .. } = self.of.interval;
        (self.progress)((step.t1() - from) / (to - from))
    }
}

/// Results of a stretch from the integration and from the states of all bodies at its start and end.
fn statistics(
    model: &Model,
    stats: &integrate::StepStatistics,
    first: &[f64],
    last: &[f64],
) -> Statistics {
    let share = |steps: usize| steps as f64 / stats.accepted.max(1) as f64;
    Statistics {
        accepted: stats.accepted,
        rejected: stats.rejected,
        nfev: stats.nfev,
        smallest_step: Some(stats.smallest_step).filter(|h| h.is_finite()),
        smallest_step_time: Some(stats.smallest_step_time).filter(|t| t.is_finite()),
        largest_step: stats.largest_step,
        stiff_share: stats.share_stiff(),
        capped_share: share(stats.capped),
        clamped_pulls: 0,
        truncated_contacts: 0,
        acceleration_residual: None,
        wall_time: 0.0,
        nfev_past_end: 0,
        largest_pressure: inspect::largest_pressure(model, first)
            .max(inspect::largest_pressure(model, last)),
        film_slip: inspect::film_slip(model, first).max(inspect::film_slip(model, last)),
        largest_tilt: model.largest_tilt(first).max(model.largest_tilt(last)),
        settling_accepted: 0,
        settling_nfev: 0,
        orbit_slowed: orbit::slowed(model, first, last),
    }
}
