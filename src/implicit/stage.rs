//! What an implicit stage needs to know of the contacts: held at its places, and the matrix of their slopes.

use std::ops::Range;

use nalgebra::SVector;
use rayon::prelude::*;

use super::arrow::Arrow;
use super::stage_batch::{Meeting, StageBatch, Velocities};
use crate::dynamics::{Batch, Dynamics, Kind, View};
use crate::forces::Table;
use crate::model::{BodyId, DOFS, Degree, Dof, Layout, Model, Race};
use crate::simd::{LANES, Lanes, Task};

/// Relative change of γh up to which a matrix serves on.
const SAME: f64 = 0.2;

/// Memory of an implicit stage.
#[derive(Debug, Clone)]
pub(super) struct Stage<const N: usize> {
    /// Used to search what touches.
    search: Batch,
    /// What every ball may meet at both rings.
    meetings: Vec<[Meeting; 2]>,
    /// The balls that meet something, by eights: the first `active` of these.
    batches: Vec<StageBatch<N>>,
    active: usize,
    arrow: Arrow<N>,
    /// Residuals of all velocities, by body; after [`Stage::correct`] their corrections. What is behind the four of a ring is none.
    pub residual: Vec<[f64; N]>,
    /// Radii that make speeds of rotation comparable, by body.
    radii: Vec<f64>,
    /// Whether slopes are secants, since tangents led astray.
    pub secant: bool,
    /// γh of the matrix, as long as it serves.
    pub kept: Option<f64>,
    /// Which rings every ball met when it was made.
    kept_meetings: Vec<[bool; 2]>,
}

impl<const N: usize> Stage<N> {
    /// For the contacts of some rows.
    pub fn new(model: &Model, rows: Range<usize>) -> Self {
        let kind = Kind {
            rows,
            ..Kind::whole(model)
        };
        let balls = model.balls.len();
        let eights = model.classes().map(|class| model.eights(class)).sum();
        Self {
            search: Batch::new(model, kind),
            meetings: vec![<[Meeting; 2]>::default(); balls],
            batches: vec![StageBatch::default(); eights],
            active: 0,
            arrow: Arrow::new(eights),
            residual: vec![[0.0; N]; model.bodies.len()],
            radii: model.layout().bodies().map(|id| model.radius(id)).collect(),
            secant: false,
            kept: None,
            kept_meetings: vec![[false; 2]; balls],
        }
    }

    /// Finds the nodes of all contacts at a state of all bodies, as they are seen there.
    pub fn find_elements(&mut self, dynamics: &Dynamics<'_>, views: &[View<'_>; 2]) {
        let model = dynamics.model();
        self.search.find(None, model, views);
        self.gather(model);
        let constants = &self.search.constants;
        let find = |batch: &mut StageBatch<N>| batch.find_elements(model, constants, views);
        let batches = &mut self.batches[..self.active];
        match dynamics.pool() {
            Some(pool) => pool.install(|| batches.par_iter_mut().for_each(find)),
            None => batches.iter_mut().for_each(find),
        }
    }

    /// The balls that meet something, by eights of one class of rows: first those between both rings, so that others may go
    /// without one.
    fn gather(&mut self, model: &Model) {
        self.meetings.fill(<[Meeting; 2]>::default());
        for race in Race::BOTH {
            for contact in self.search.touching(race) {
                // The elements of a stage are those of a torus.
                let row = &model.rows[model.balls[contact.ball].row];
                self.meetings[contact.ball][race] = if row.pairs[race].shape.is_torus() {
                    Meeting::Whole(contact.raise)
                } else {
                    Meeting::Faulted
                };
            }
        }
        for (race, ball) in self.search.faulted() {
            self.meetings[ball][race] = Meeting::Faulted;
        }
        self.active = 0;
        for class in model.classes() {
            let mut taken = 0;
            for wanted in [2, 1] {
                for (ball, meetings) in self.meetings.iter().enumerate() {
                    let meets = |meeting: &&Meeting| **meeting != Meeting::Nothing;
                    let is_wanted = meetings.iter().filter(meets).count() == wanted;
                    if !is_wanted || model.rows[model.balls[ball].row].class != class {
                        continue;
                    }
                    let batch = &mut self.batches[self.active + taken / LANES];
                    if taken.is_multiple_of(LANES) {
                        batch.clear(class);
                    }
                    batch.push(ball, *meetings);
                    taken += 1;
                }
            }
            self.active += taken.div_ceil(LANES);
        }
    }

    /// Finds what the contacts do at some velocities, with slopes or without.
    pub fn forces(&mut self, dynamics: &Dynamics<'_>, velocities: &Velocities<'_>, slopes: bool) {
        let (model, secant) = (dynamics.model(), self.secant);
        let find = |batch: &mut StageBatch<N>| {
            if slopes {
                batch.forces_and_slopes(model, velocities, secant);
            } else {
                batch.forces(model, velocities);
            }
        };
        let batches = &mut self.batches[..self.active];
        match dynamics.pool() {
            Some(pool) => pool.install(|| batches.par_iter_mut().for_each(find)),
            None => batches.iter_mut().for_each(find),
        }
    }

    /// Adds the contacts' forces to those on all bodies.
    pub fn add_to(&self, forces: &mut Table) {
        for batch in &self.batches[..self.active] {
            for race in Race::BOTH {
                let side = &batch.sides[race];
                if !side.touches {
                    continue;
                }
                let (wrench, apart) = (&side.wrenches.wrench, side.apart());
                let [x, y, z, turn] = [0, 1, 2, 3].map(|i| wrench[i]);
                for (lane, ball) in batch.balls[..batch.count].iter().enumerate() {
                    let wrench = [x[lane], y[lane], z[lane], turn[lane]];
                    forces.add(BodyId::ball(*ball), &wrench);
                }
                // −Tᵀ of the wrench on the ball.
                let about = turn + y * apart[0] - x * apart[1];
                forces.add(race.ring(), &[x, y, z, about].map(|part| -part.sum()));
            }
        }
    }

    /// Makes the matrix of the last slopes.
    pub fn factorise(&mut self, model: &Model, gamma_h: f64) {
        model.instructions.run(Factorise {
            work: self,
            model,
            gamma_h,
        });
        self.kept = Some(gamma_h);
        for (kept, meetings) in self.kept_meetings.iter_mut().zip(&self.meetings) {
            *kept = meetings.map(|meeting| meeting != Meeting::Nothing);
        }
    }

    /// Whether the matrix that is there was made for nearly the same γh.
    pub fn is_like(&self, gamma_h: f64) -> bool {
        let same = |kept: f64| (gamma_h / kept - 1.0).abs() < SAME;
        self.kept.is_some_and(same)
    }

    /// Whether the matrix that is there was made for nearly the same equations.
    pub fn is_kept(&self, gamma_h: f64) -> bool {
        let meets = |meeting: Meeting| meeting != Meeting::Nothing;
        self.is_like(gamma_h)
            && self
                .kept_meetings
                .iter()
                .zip(&self.meetings)
                .all(|(kept, meetings)| *kept == meetings.map(meets))
    }

    /// Adds the corrections to the velocities, and tells the largest.
    pub fn apply(&self, velocities: &mut [f64]) -> Largest {
        let mut largest = Largest::default();
        let bodies = Layout::each_mut(velocities).iter_mut();
        let corrections = self.residual.iter().zip(&self.radii);
        for (b, (v, (correction, radius))) in bodies.zip(corrections).enumerate() {
            let mut levers = [1.0; DOFS];
            levers[Dof::Theta] = *radius;
            for (i, lever) in levers.into_iter().enumerate() {
                v[i] += correction[i];
                let size = correction[i].abs() * lever;
                if size > largest.size || size.is_nan() {
                    let velocity = DOFS * b + i;
                    largest = Largest { size, velocity };
                }
            }
        }
        largest
    }

    /// The balls that meet something, by eights.
    pub fn batches(&self) -> &[StageBatch<N>] {
        &self.batches[..self.active]
    }

    /// Solves for the correction of all velocities; `residual` is replaced by it. False if singular.
    pub fn correct(&mut self, model: &Model) -> bool {
        model.instructions.run(Correct { work: self })
    }
}

/// The largest correction \[m/s\], or one that is not a number, and of which velocity it is.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Largest {
    pub size: f64,
    pub velocity: usize,
}

/// Makes the matrix.
struct Factorise<'a, const N: usize> {
    work: &'a mut Stage<N>,
    model: &'a Model,
    gamma_h: f64,
}

impl<const N: usize> Task for Factorise<'_, N> {
    type Output = ();

    // Compiled for the instruction set that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let (model, gamma_h) = (self.model, self.gamma_h);
        let Stage {
            arrow,
            batches,
            active,
            ..
        } = self.work;
        arrow.begin();
        for (eight, batch) in batches[..*active].iter().enumerate() {
            let mut scale = [Lanes::ZERO; N];
            for (lane, ball) in batch.balls.iter().enumerate() {
                let mobility = &model.mobility[BodyId::ball(*ball)];
                for (i, scale) in scale.iter_mut().enumerate() {
                    // A sphere turns about all axes alike.
                    scale[lane] = gamma_h * mobility[i.min(Dof::Theta.index())];
                }
            }
            let contacts = batch
                .sides
                .each_ref()
                .map(|side| side.touches.then(|| (&side.wrenches.slope, side.apart())));
            arrow.eliminate::<FMA>(eight, &contacts, &scale);
        }
        let layout = model.layout();
        let scale = SVector::from_fn(|i, _| {
            let (body, dof) = layout.degree(i);
            gamma_h * model.mobility[body][dof]
        });
        let diagonal = SVector::from_fn(|i, _| {
            let (body, dof) = layout.degree(i);
            match model.bodies[body].degrees[dof] {
                Degree::Free { damping, .. } => 1.0 + scale[i] * damping,
                Degree::Fixed | Degree::Driven => 1.0,
            }
        });
        arrow.factorise(&diagonal, &scale);
    }
}

/// Solves for the corrections.
struct Correct<'a, const N: usize> {
    work: &'a mut Stage<N>,
}

impl<const N: usize> Task for Correct<'_, N> {
    type Output = bool;

    // Compiled for the instruction set that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn run<const FMA: bool>(self) -> bool {
        let Stage {
            arrow,
            residual,
            batches,
            active,
            ..
        } = self.work;
        let batches = &batches[..*active];
        arrow.begin_right();
        for (eight, batch) in batches.iter().enumerate() {
            let mut right = [Lanes::ZERO; N];
            for (lane, ball) in batch.balls.iter().enumerate() {
                let residual = &residual[BodyId::ball(*ball)];
                for i in 0..N {
                    right[i][lane] = residual[i];
                }
            }
            arrow.eliminate_right::<FMA>(eight, &right);
        }
        let right = SVector::from_fn(|i, _| residual[i / DOFS][i % DOFS]);
        let Some(rings) = arrow.rings(&right) else {
            return false;
        };
        for (i, found) in rings.iter().enumerate() {
            residual[i / DOFS][i % DOFS] = *found;
        }
        for (eight, batch) in batches.iter().enumerate() {
            let balls = arrow.balls::<FMA>(eight, &rings);
            for (lane, ball) in batch.balls[..batch.count].iter().enumerate() {
                let residual = &mut residual[BodyId::ball(*ball)];
                for i in 0..N {
                    residual[i] = balls[i][lane];
                }
            }
        }
        true
    }
}
