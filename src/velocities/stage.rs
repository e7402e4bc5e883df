//! The contacts of an implicit stage, held at its positions, and the matrix of their slopes.

use std::ops::Range;

use rayon::prelude::*;

use super::arrow::{Arrow, EightOnRing};
use super::carrier::{Carrier, RingRotation};
use super::stage_batch::{Met, StageBatch};
use crate::contact::{AXIAL, Slopes};
use crate::dynamics::{Batch, Dynamics, Guarantees, HeldContacts, OnRings, View};
use crate::forces::Table;
use crate::model::{BodyId, DOFS, Dof, Layout, Model, Race};
use crate::simd::{LANES, Lanes, Task};

/// Relative change of γh up to which a matrix serves on.
const SAME: f64 = 0.2;

/// Memory of an implicit stage.
#[derive(Debug, Clone)]
pub(super) struct Stage<const N: usize> {
    /// Used to search what touches.
    search: Batch,
    /// What every ball may meet at both rings.
    meetings: Vec<[Met; 2]>,
    /// The balls that meet something, by eights: the first `active` of these.
    batches: Vec<StageBatch<N>>,
    active: usize,
    arrow: Arrow<N>,
    /// Residuals of all velocities, by body: along x, y and z, about z, and tilts of rings or turning about x and y of balls. After
    /// [`Stage::correct`] their corrections.
    pub residual: Vec<[f64; N]>,
    /// Radii that make speeds of rotation comparable, by body.
    radii: Vec<f64>,
    /// Which slopes are wanted; secants, once tangents led astray.
    pub slopes: Slopes,
    /// γh of the matrix, as long as it serves.
    pub kept: Option<f64>,
    /// Which rings every ball met when it was made.
    kept_meetings: Vec<[bool; 2]>,
}

impl<const N: usize> Stage<N> {
    /// For the contacts of some rows.
    pub fn new(model: &Model, rows: Range<usize>) -> Self {
        let kind = Guarantees {
            rows,
            ..Guarantees::whole(model)
        };
        let balls = model.balls.len();
        let eights = model.classes().map(|class| model.eights(class)).sum();
        Self {
            search: Batch::new(model, kind),
            meetings: vec![<[Met; 2]>::default(); balls],
            batches: vec![StageBatch::default(); eights],
            active: 0,
            arrow: Arrow::new(eights),
            residual: vec![[0.0; N]; model.bodies.len()],
            radii: model.layout().bodies().map(|id| model.radius(id)).collect(),
            slopes: Slopes::default(),
            kept: None,
            kept_meetings: vec![[false; 2]; balls],
        }
    }

    /// Finds the nodes of all contacts at a state of all bodies, as they are seen there.
    pub fn find_elements(&mut self, dynamics: &Dynamics<'_>, views: &[View<'_>; 2]) {
        let model = dynamics.coated();
        if model.has_films_in_motion() {
            self.search.coat(model);
        }
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
        self.meetings.fill(<[Met; 2]>::default());
        for race in Race::BOTH {
            for contact in self.search.touching(race) {
                // The elements of a stage are those of a torus.
                let row = &model.rows[model.balls[contact.ball].row];
                self.meetings[contact.ball][race] = if row.pairs[race].shape.is_torus() {
                    Met::Whole([contact.raise, contact.swell])
                } else {
                    Met::Faulted
                };
            }
        }
        for (race, ball) in self.search.faulted() {
            self.meetings[ball][race] = Met::Faulted;
        }
        self.active = 0;
        for class in model.classes() {
            let mut taken = 0;
            for wanted in [2, 1] {
                for (ball, meetings) in self.meetings.iter().enumerate() {
                    let meets = |meeting: &&Met| **meeting != Met::Nothing;
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

    /// Finds what the contacts do at the velocities that are seen, with slopes or without.
    pub fn forces(&mut self, dynamics: &Dynamics<'_>, views: &[View<'_>; 2], slopes: bool) {
        let (model, wanted) = (dynamics.coated(), self.slopes);
        let find = |batch: &mut StageBatch<N>| {
            if slopes {
                batch.forces_and_slopes(model, views, wanted);
            } else {
                batch.forces(model, views);
            }
        };
        let batches = &mut self.batches[..self.active];
        match dynamics.pool() {
            Some(pool) => pool.install(|| batches.par_iter_mut().for_each(find)),
            None => batches.iter_mut().for_each(find),
        }
    }

    /// Makes the matrix of the last slopes.
    pub fn factorise(&mut self, dynamics: &Dynamics<'_>, views: &[View<'_>; 2], gamma_h: f64) {
        dynamics.model().instructions.run(Factorise {
            work: self,
            dynamics,
            views,
            gamma_h,
        });
        self.kept = Some(gamma_h);
        for (kept, meetings) in self.kept_meetings.iter_mut().zip(&self.meetings) {
            *kept = meetings.map(|meeting| meeting != Met::Nothing);
        }
    }

    /// Whether the matrix that is there was made for nearly the same γh.
    pub fn is_like(&self, gamma_h: f64) -> bool {
        let same = |kept: f64| (gamma_h / kept - 1.0).abs() < SAME;
        self.kept.is_some_and(same)
    }

    /// Whether the matrix that is there was made for nearly the same equations.
    pub fn is_kept(&self, gamma_h: f64) -> bool {
        let meets = |meeting: Met| meeting != Met::Nothing;
        self.is_like(gamma_h)
            && self
                .kept_meetings
                .iter()
                .zip(&self.meetings)
                .all(|(kept, meetings)| *kept == meetings.map(meets))
    }

    /// Adds the corrections to the velocities of all bodies, and returns the largest; `across` are those beside the directions that every
    /// body has.
    pub fn apply(&self, velocities: &mut [f64], across: &[Velocity]) -> Largest {
        let mut largest = Largest::default();
        let bodies = Layout::each_mut(velocities).iter_mut();
        let corrections = self.residual.iter().zip(&self.radii);
        for (b, (v, (correction, radius))) in bodies.zip(corrections).enumerate() {
            let mut levers = [1.0; DOFS];
            levers[Dof::Theta] = *radius;
            for (i, lever) in levers.into_iter().enumerate() {
                v[i] += correction[i];
                largest.take(correction[i] * lever, DOFS * b + i);
            }
        }
        for Velocity { at, body, place } in across {
            let correction = self.residual[body.index()][*place];
            velocities[*at] += correction;
            largest.take(correction * self.radii[body.index()], *at);
        }
        largest
    }

    /// Solves for the correction of all velocities; `residual` is replaced by it. False if singular.
    pub fn correct(&mut self, model: &Model) -> bool {
        model.instructions.run(Correct { work: self })
    }
}

impl<const N: usize> HeldContacts for Stage<N> {
    fn add_to(&self, forces: &mut Table) {
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

    fn add_leaning(
        &self,
        views: &[View<'_>; 2],
        forces: &mut Table,
        across: &mut [[f64; 2]],
    ) -> OnRings {
        let mut on_rings = OnRings::default();
        for batch in &self.batches[..self.active] {
            for race in Race::BOTH {
                let side = &batch.sides[race];
                if !side.touches {
                    continue;
                }
                for (lane, ball) in batch.balls[..batch.count].iter().enumerate() {
                    let (wrench, place, on_cap) = side.of(lane);
                    let [force, about] = &mut on_rings[race];
                    *force -= wrench.force;
                    *about += wrench.moment_on_ring(&place);
                    let [force, moment] = match views[race].leaning {
                        Some(view) => wrench.on_ball(&view.ring, &on_cap),
                        None => [wrench.force, wrench.moment],
                    };
                    let on_ball = [force.x, force.y, force.z, moment.z];
                    forces.add(BodyId::ball(*ball), &on_ball);
                    if let Some(across) = across.get_mut(*ball) {
                        across[0] += moment.x;
                        across[1] += moment.y;
                    }
                }
            }
        }
        on_rings
    }
}

/// The largest correction \[m/s\], or one that is not a number, and of which velocity it is.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Largest {
    pub size: f64,
    pub velocity: usize,
}

impl Largest {
    fn take(&mut self, correction: f64, velocity: usize) {
        let size = correction.abs();
        if size > self.size || size.is_nan() {
            *self = Self { size, velocity };
        }
    }
}

/// Where a velocity stands: among those of a run, and among those of its body in a [`Stage`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Velocity {
    pub at: usize,
    pub body: BodyId,
    pub place: usize,
}

impl Velocity {
    /// That of a direction, of which there is none for the rates of Euler parameters: they follow from how a ball turns.
    pub fn of((at, (body, dof)): (usize, (BodyId, Dof))) -> Option<Self> {
        let place = match dof {
            Dof::TiltX | Dof::TurnX => AXIAL,
            Dof::TiltY | Dof::TurnY => AXIAL + 1,
            _ => Dof::ALL.iter().position(|known| *known == dof)?,
        };
        Some(Self { at, body, place })
    }
}

/// Makes the matrix.
struct Factorise<'a, const N: usize> {
    work: &'a mut Stage<N>,
    dynamics: &'a Dynamics<'a>,
    views: &'a [View<'a>; 2],
    gamma_h: f64,
}

impl<const N: usize> Task for Factorise<'_, N> {
    type Output = ();

    // Compiled for the instruction set that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let (dynamics, views, gamma_h) = (self.dynamics, self.views, self.gamma_h);
        let (model, mobilities) = (dynamics.model(), dynamics.mobility());
        let Stage {
            arrow,
            batches,
            active,
            ..
        } = self.work;
        arrow.begin();
        let turns = Race::BOTH.map(|race| views[race].leaning.map(RingRotation::new));
        let turning = if model.balls_turn() { gamma_h } else { 0.0 };
        for (eight, batch) in batches[..*active].iter().enumerate() {
            let mut scale = [Lanes::ZERO; N];
            for (lane, ball) in batch.balls.iter().enumerate() {
                let mobility = mobilities.of(BodyId::ball(*ball));
                for i in 0..DOFS {
                    scale[i][lane] = gamma_h * mobility[i];
                }
                for scale in &mut scale[DOFS..] {
                    // A sphere turns about all axes alike.
                    scale[lane] = turning * mobility[Dof::Theta];
                }
            }
            let contacts = Race::BOTH.map(|race| {
                let (side, turn) = (&batch.sides[race], turns[race]);
                let (slope, apart) = (&side.wrenches.slope, side.apart());
                side.touches.then_some(EightOnRing { slope, apart, turn })
            });
            arrow.eliminate::<FMA>(eight, &contacts, &scale);
        }
        let carriers = Race::BOTH.map(|race| {
            let mobility = mobilities.of(race.ring());
            Carrier::new(model, (race, mobility), &views[race], gamma_h)
        });
        let diagonal = Race::BOTH.map(|race| carriers[race].diagonal(model, race));
        arrow.factorise(&diagonal, &carriers);
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
        let right = Race::BOTH.map(|race| residual[race.ring()]);
        let Some(rings) = arrow.rings(&right) else {
            return false;
        };
        for race in Race::BOTH {
            residual[race.ring()] = rings[race];
        }
        let seen = arrow.seen(&rings);
        for (eight, batch) in batches.iter().enumerate() {
            let balls = arrow.balls::<FMA>(eight, &seen);
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
