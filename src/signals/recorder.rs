//! Reads the probes during a run.

use std::ops::ControlFlow;

use super::blocks::{Held, Keep};
use super::decimate::Decimator;
use super::filter::{HALF, Taps, signed};
use super::probes::{ProbeReader, Probes};
use super::{Block, Sampling, SliceRow};
use crate::base::error::{Error, Result};
use crate::base::memory;
use crate::base::words::{Remembered, Words};
use crate::dynamics::Dynamics;
use crate::inspect;
use crate::integrate::{DenseStep, System};
use crate::model::Model;
use crate::signals::kinematics::Orbits;
use crate::signals::residual::AccelerationResidual;
use crate::signals::touched::DefectWatch;

/// Reading at one kind of times: some readers, and the columns that theirs are.
#[derive(Default)]
struct Reading {
    readers: Vec<ProbeReader>,
    columns: Vec<usize>,
    values: Vec<f64>,
}

/// Reads the probes of a scene along a run: at the samples' times, and signals that are filtered on a finer grid.
///
/// Times may begin before 0: what is read there only feeds the filter.
pub(crate) struct Recorder<'s> {
    sampling: Sampling,
    /// Reading at the samples' times.
    points: Reading,
    /// Reading on the grid, and the filter from there to the samples.
    grid: Option<(Reading, Decimator)>,
    /// The next point of the grid; 0 stands at t = 0.
    next: i64,
    /// Whether the samples' own readings want accelerations, for which the model is evaluated.
    needs_rhs: bool,
    /// Whether accelerations are recorded at all, so that they are judged.
    judges: bool,
    /// Whether the right-hand side is needed on the grid.
    needs_rhs_on_grid: bool,
    listings: Vec<super::probes::Listing>,
    /// The run's own states at a sample, and their rates.
    own: (Vec<f64>, Vec<f64>),
    /// States of all bodies.
    y: Vec<f64>,
    dy: Vec<f64>,
    pub residual: AccelerationResidual,
    pub watch: DefectWatch,
    pub orbits: Orbits,
    pub held: Held<'s>,
    pub slices: Vec<SliceRow>,
}

impl<'s> Recorder<'s> {
    /// The recorder for `count` samples, kept in some way.
    pub fn new(model: &Model, sampling: Sampling, count: usize, keep: Keep<'s>) -> Self {
        let filtered = sampling.oversampling > 1;
        let probes = Probes::new(model);
        let (mut points, mut grid) = (Reading::default(), Reading::default());
        let (mut kinds, mut column) = (Vec::new(), 0);
        for (reader, width) in probes.readers {
            let columns = column..column + width;
            column += width;
            let on_grid = filtered && reader.is_signal();
            if on_grid {
                kinds.extend(columns.clone().filter_map(|c| Some((c, probes.kinds[c]?))));
            }
            let reading = if on_grid { &mut grid } else { &mut points };
            reading.readers.push(reader);
            reading.columns.extend(columns);
        }
        let needs_rhs_on_grid = grid
            .readers
            .iter()
            .any(|r| matches!(r, ProbeReader::Torque));
        let grid = (!kinds.is_empty()).then(|| {
            let taps = Taps::new(sampling.oversampling, sampling.fs);
            (grid, Decimator::new(taps, kinds))
        });
        Self {
            sampling,
            points,
            grid,
            next: 0,
            needs_rhs: probes.needs_rhs && !filtered,
            judges: probes.needs_rhs,
            needs_rhs_on_grid,
            listings: probes.listings,
            own: (Vec::new(), Vec::new()),
            y: Vec::new(),
            dy: Vec::new(),
            residual: AccelerationResidual::default(),
            watch: DefectWatch::new(model),
            orbits: Orbits::default(),
            held: Held::new(probes.columns, count, keep),
            slices: Vec::new(),
        }
    }

    /// Time until which a run of a duration is to be followed \[s\].
    pub fn until(&self, duration: f64) -> f64 {
        match self.grid {
            Some(_) => self.sampling.until(duration),
            None => duration,
        }
    }

    /// Sets memory aside for the samples of a run from a state of all bodies.
    ///
    /// # Errors
    /// [`Error::Memory`] where the system does not give it.
    pub fn prepare(&mut self, dynamics: &Dynamics<'_>, start: &[f64]) -> Result<()> {
        let values = self.held.rows() as f64 * (self.held.columns.len() + 1) as f64;
        self.held.reserve().map_err(|_| Error::Memory {
            needed: 8.0 * values,
            available: memory::available(),
            what: "the signals; the system did not grant it: shorten the run, lower fs, or record fewer probes"
                .to_owned(),
        })?;
        let zeros = vec![0.0; dynamics.dim()];
        self.own = (zeros.clone(), zeros);
        (self.y, self.dy) = (start.to_vec(), vec![0.0; start.len()]);
        let filtered = self.grid.as_ref().map(|_| self.sampling.fs);
        self.residual = AccelerationResidual::new(dynamics, filtered);
        self.watch.prepare(start);
        self.orbits.prepare(start);
        self.open(0.0);
        Ok(())
    }

    /// Opens sums for all samples that a point of the grid until `t` counts for.
    fn open(&mut self, t: f64) {
        if let Some((reading, _)) = &self.grid {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let sample = (t * self.sampling.fs) as usize;
            self.held.open(&reading.columns, sample + 2 * HALF);
        }
    }

    /// The run's states where it begins.
    pub fn first(&mut self, dynamics: &mut Dynamics<'_>, t: f64, y: &[f64]) {
        self.own.0.copy_from_slice(y);
        if let Some((_, decimator)) = &self.grid {
            // What lies further back than the filter reaches is of no use to sample 0.
            let begin = (t * self.sampling.grid()).ceil();
            #[allow(clippy::cast_possible_truncation)]
            let begin = (begin as i64).max(-decimator.reach());
            self.next = begin;
            if t == self.grid_time() {
                self.grid_point(dynamics, t);
            }
        }
        if t == 0.0 {
            self.sample(dynamics, t, false);
        }
        self.list(dynamics, t, |_, _| {});
    }

    /// Records all samples within an accepted step and until a time \[s\]; for the rest of it, it is called again. Breaks off where a block was
    /// taken with the wish to.
    pub fn step(
        &mut self,
        dynamics: &mut Dynamics<'_>,
        step: &DenseStep<'_>,
        until: f64,
    ) -> ControlFlow<()> {
        let is_whole = until >= step.t1();
        let until = until.min(step.t1());
        // What the filter still sees beyond the end is no part of the run.
        if is_whole && step.t0() * self.sampling.fs < self.held.count() as f64 {
            self.watch.step(dynamics, step);
            self.orbits.step(dynamics, step);
        }
        self.open(until);
        while self.grid.is_some() && self.grid_time() <= until && self.next <= self.last() {
            let t = self.grid_time();
            step.interpolate(t, &mut self.own.0);
            self.grid_point(dynamics, t);
        }
        while self.held.sampled() < self.held.count() {
            let t = self.held.sampled() as f64 / self.sampling.fs;
            if t > until {
                break;
            }
            step.interpolate(t, &mut self.own.0);
            let judged = self.judges && AccelerationResidual::wants(self.held.sampled());
            self.sample(dynamics, t, judged);
            if judged {
                self.residual.add(step, t, &self.own.1);
            }
        }
        self.list(dynamics, until, |t, y| step.interpolate(t, y));
        self.leave(self.finished())
    }

    /// Samples that nothing changes any more.
    fn finished(&self) -> usize {
        let sampled = self.held.sampled();
        match &self.grid {
            Some((_, decimator)) => decimator.finished().min(sampled),
            None => sampled,
        }
    }

    /// Samples before a time \[s\] that nothing changes any more and that were not taken yet.
    pub fn take(&mut self, time: f64) -> Block {
        let finished = self.finished();
        let block = self.held.take(finished, self.sampling.before(time));
        if let Some((_, decimator)) = &mut self.grid {
            decimator.drop_samples(block.t.len());
        }
        block
    }

    /// Ends the record at a time \[s\].
    pub fn end_at(&mut self, time: f64) {
        self.held.end_at(self.sampling.before(time));
    }

    /// Goes on with another model of the same probes, from a state of all bodies.
    pub fn change(&mut self, dynamics: &Dynamics<'_>, start: &[f64]) {
        let zeros = vec![0.0; dynamics.dim()];
        self.own = (zeros.clone(), zeros);
        (self.y, self.dy) = (start.to_vec(), vec![0.0; start.len()]);
        self.residual.change(dynamics);
        self.watch.change(dynamics.model(), start);
    }

    /// Completes the last samples where the run has ended before the grid.
    pub fn finish(&mut self) -> ControlFlow<()> {
        if let Some((reading, decimator)) = &mut self.grid {
            self.held.open(&reading.columns, self.held.count());
            decimator.finish(&mut self.held.columns);
        }
        self.leave(self.held.sampled())
    }

    /// Hands over samples that nothing changes any more.
    fn leave(&mut self, finished: usize) -> ControlFlow<()> {
        let left = self.held.leave(finished)?;
        if let Some((_, decimator)) = &mut self.grid {
            decimator.drop_samples(left);
        }
        ControlFlow::Continue(())
    }

    /// Time of the next point of the grid \[s\].
    fn grid_time(&self) -> f64 {
        self.next as f64 / self.sampling.grid()
    }

    /// The last point of the grid that any sample needs.
    fn last(&self) -> i64 {
        let reach = self.grid.as_ref().map_or(0, |(_, d)| d.reach());
        signed((self.held.count() - 1) * self.sampling.oversampling) + reach
    }

    /// Accelerations are the derivatives of the velocities, which the filter takes.
    fn grid_point(&mut self, dynamics: &mut Dynamics<'_>, t: f64) {
        let (y, dy) = &mut self.own;
        dynamics.expand(t, y, &mut self.y);
        if self.needs_rhs_on_grid {
            dynamics.rhs(t, y, dy);
        }
        let Some((reading, decimator)) = &mut self.grid else {
            return;
        };
        let velocities = &self.y[self.y.len() / 2..];
        reading.read(dynamics, t, &self.y, velocities);
        decimator.push(self.next, &reading.values, &mut self.held.columns);
        self.next += 1;
    }

    /// The accelerations are the model's at the interpolated state; they are found where a reading or the judge wants them.
    fn sample(&mut self, dynamics: &mut Dynamics<'_>, t: f64, judged: bool) {
        let (y, dy) = &mut self.own;
        dynamics.expand(t, y, &mut self.y);
        if self.needs_rhs || judged {
            dynamics.rhs(t, y, dy);
        }
        if self.needs_rhs {
            dynamics.expand_rates(t, dy, &mut self.dy);
        }
        self.held.t.push(t);
        let accelerations = &self.dy[self.dy.len() / 2..];
        let points = &mut self.points;
        points.read(dynamics, t, &self.y, accelerations);
        for (column, value) in points.columns.iter().zip(&points.values) {
            self.held.columns[*column].values.push(*value);
        }
    }

    fn list(&mut self, dynamics: &Dynamics<'_>, until: f64, interpolate: impl Fn(f64, &mut [f64])) {
        let model = dynamics.current_model();
        while let Some(listing) = self.listings.pop_if(|listing| listing.time <= until) {
            interpolate(listing.time, &mut self.own.0);
            dynamics.expand(listing.time, &self.own.0, &mut self.y);
            for (j, race) in listing.contacts {
                let ball = &model.balls[j];
                for slice in inspect::raw::slice_forces(model, &self.y, j, race) {
                    self.slices.push(SliceRow {
                        probe: listing.probe.clone(),
                        time: listing.time,
                        row: ball.row,
                        ball: ball.index,
                        race: race.into(),
                        zeta: slice.zeta,
                        z: slice.z,
                        width: slice.width,
                        penetration: slice.penetration,
                        force: slice.force,
                    });
                }
            }
        }
    }
}

impl Remembered for Recorder<'_> {
    fn pass(&mut self, words: &mut Words) {
        if let Some((_, decimator)) = &mut self.grid {
            decimator.pass_on(words);
        }
        self.next.pass(words);
        let mut left = self.listings.len();
        left.pass(words);
        self.listings.truncate(left);
        self.residual.pass(words);
        self.watch.pass(words);
        self.orbits.pass(words);
        self.held.pass(words);
    }
}

impl Reading {
    /// Reads a value for each of its columns; see [`ProbeReader::read`].
    fn read(&mut self, dynamics: &Dynamics<'_>, t: f64, y: &[f64], accelerations: &[f64]) {
        self.values.clear();
        for reader in &self.readers {
            reader.read(dynamics, t, y, accelerations, &mut self.values);
        }
    }
}

#[cfg(test)]
mod tests;
