//! All contacts of an evaluation: those that touch are found, gathered by eights and evaluated together.
//!
//! Where a contact has a closed form all neighbours are evaluated as they stand: to gather would cost more.
//!
//! Eights may be evaluated by several threads; since their members depend on the state alone and they are added
//! up in one order afterwards, the bits do not depend on the number of threads.

use std::array::from_fn;

use rayon::ThreadPool;
use rayon::prelude::*;

use super::state::{State, Table};
use super::sums::Sum;
use crate::contact::{Closed, Constants, Motion, Octet, Places, Press};
use crate::model::{Ball, Model};
use crate::simd::{LANES, Lanes, Mask, Task};

/// What a batch may take for granted.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Kind {
    /// All bodies stay in the planes of their rows.
    pub plane: bool,
    /// The second row is an image of the first, and not evaluated.
    pub mirrored: bool,
    /// Closed forms are used where there are any.
    pub closed: bool,
}

/// The memory for all contacts of a model, and their sums after an evaluation.
#[derive(Debug, Clone)]
pub(super) struct Batch {
    kind: Kind,
    /// The balls of every row by eights, for the search.
    stretches: Vec<Stretch>,
    /// Closed forms by row, with the outer and the inner race.
    closed: Vec<[Option<Closed>; 2]>,
    /// Constants of the contacts with the outer and with the inner race.
    pub constants: [SideConstants; 2],
    /// Contacts of whole surfaces with the outer and with the inner ring, in the order of the balls.
    touching: [Vec<Touching>; 2],
    /// The same by eights: the first `active` of these.
    groups: Vec<Group>,
    active: usize,
    /// Contacts that are evaluated one by one.
    singles: Vec<Single>,
    /// The first ball that has left its groove.
    lost: Option<usize>,
    /// Forces on the two rings by closed forms, and slices there whose damping wanted to pull.
    rings: [[f64; 4]; 2],
    pulls: u32,
}

/// Up to eight neighbours of a row.
#[derive(Debug, Clone)]
struct Stretch {
    row: usize,
    first: usize,
    radius: Lanes,
    /// Which lanes are balls.
    filled: Mask,
    /// Which of them have defects of their own.
    faulted: Mask,
    /// Constants of their contacts with the outer and with the inner race.
    constants: [Constants<Lanes>; 2],
}

/// Constants of all contacts with one ring.
#[derive(Debug, Clone)]
pub(super) struct SideConstants {
    /// Those of every ball.
    balls: Vec<Constants<f64>>,
    /// Those of the first in all lanes.
    first: Constants<Lanes>,
    /// Whether all are the same but for the axial place, so that nothing else need be gathered.
    alike: bool,
}

#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Touching {
    pub ball: usize,
    /// Raise of the race there.
    pub wave: f64,
}

/// Up to eight contacts with one ring; the last one fills the lanes that are left.
#[derive(Debug, Clone, Copy, Default)]
struct Group {
    side: usize,
    contacts: [Touching; LANES],
    count: usize,
    press: Press,
}

#[derive(Debug, Clone, Copy)]
struct Single {
    side: usize,
    ball: usize,
    sum: Sum,
}

impl Batch {
    pub fn new(model: &Model, kind: Kind) -> Self {
        let constants: [SideConstants; 2] = from_fn(|side| SideConstants::new(model, side));
        let rows = if kind.mirrored { 1 } else { model.rows.len() };
        let mut stretches = Vec::new();
        for (row, compiled) in model.rows.iter().enumerate().take(rows) {
            for start in (0..compiled.count).step_by(LANES) {
                let (first, count) = (compiled.first + start, LANES.min(compiled.count - start));
                stretches.push(Stretch::new(model, &constants, row, first, count));
            }
        }
        let balls = model.balls.len();
        Self {
            kind,
            closed: (0..rows).map(|row| closed(model, row, kind)).collect(),
            stretches,
            constants,
            touching: from_fn(|_| Vec::with_capacity(balls)),
            groups: vec![Group::default(); 2 * balls.div_ceil(LANES)],
            active: 0,
            singles: Vec::with_capacity(2 * balls),
            lost: None,
            rings: [[0.0; 4]; 2],
            pulls: 0,
        }
    }

    /// Evaluates all contacts at a state, by the threads of a pool if there is one, and adds their sums to the forces
    /// on all bodies; returns the moments about z on the two rings.
    pub fn add_to(
        &mut self,
        forces: &mut Table,
        model: &Model,
        state: &State,
        pool: Option<&ThreadPool>,
    ) -> [f64; 2] {
        self.fill(forces, model, state, pool);
        self.sum(forces)
    }

    fn fill(
        &mut self,
        forces: &mut Table,
        model: &Model,
        state: &State,
        pool: Option<&ThreadPool>,
    ) {
        let rings = [state.motion(0), state.motion(1)];
        self.find(Some(forces), model, state, &rings);
        self.gather();
        let (constants, plane) = (&self.constants, self.kind.plane);
        let eight = |group: &mut Group| {
            model.level.run(Eight {
                group,
                constants,
                plane,
                model,
                state,
                rings: &rings,
            });
        };
        let one = |single: &mut Single| {
            let ball = &model.balls[single.ball];
            let motion = state.motion(2 + single.ball);
            model.rows[ball.row].pairs[single.side].evaluate(
                &ball.side,
                &motion,
                &rings[single.side],
                &mut single.sum,
            );
        };
        let (groups, singles) = (&mut self.groups[..self.active], &mut self.singles);
        if let Some(pool) = pool {
            // From inside the pool, where a run lives, this is a plain call.
            pool.install(|| {
                groups.par_iter_mut().for_each(eight);
                leave(groups, singles);
                singles.par_iter_mut().for_each(one);
            });
        } else {
            groups.iter_mut().for_each(eight);
            leave(groups, singles);
            singles.iter_mut().for_each(one);
        }
    }

    /// Finds what touches; what has a closed form puts its forces where it is told.
    pub fn find(
        &mut self,
        forces: Option<&mut Table>,
        model: &Model,
        state: &State,
        rings: &[Motion; 2],
    ) {
        model.level.run(Find {
            batch: self,
            forces,
            model,
            state,
            rings,
        });
    }

    /// Contacts of whole surfaces with a ring, as last found.
    pub fn touching(&self, side: usize) -> &[Touching] {
        &self.touching[side]
    }

    /// Ring and ball of the contacts that may see a defect, as last found.
    pub fn faulted(&self) -> impl Iterator<Item = (usize, usize)> {
        self.singles.iter().map(|single| (single.side, single.ball))
    }

    /// What touches, by eights.
    fn gather(&mut self) {
        self.active = 0;
        for (side, touching) in self.touching.iter().enumerate() {
            for contacts in touching.chunks(LANES) {
                let group = &mut self.groups[self.active];
                self.active += 1;
                (group.side, group.count) = (side, contacts.len());
                group.contacts[..contacts.len()].copy_from_slice(contacts);
                group.contacts[contacts.len()..].fill(contacts[contacts.len() - 1]);
            }
        }
    }

    fn sum(&self, forces: &mut Table) -> [f64; 2] {
        let mut rings = self.rings;
        for group in &self.groups[..self.active] {
            for (lane, contact) in group.contacts.iter().enumerate().take(group.count) {
                let Press { ball, ring, .. } = &group.press;
                let of = |[x, y, z, theta]: &[Lanes; 4]| [x[lane], y[lane], z[lane], theta[lane]];
                forces.add(2 + contact.ball, &of(ball));
                super::add(&mut rings[group.side], &of(ring));
            }
        }
        for single in &self.singles {
            forces.add(2 + single.ball, &single.sum.ball);
            super::add(&mut rings[single.side], &single.sum.ring);
        }
        for (ring, mut sum) in rings.into_iter().enumerate() {
            if self.kind.mirrored {
                // What the image adds; along z it takes all.
                sum = [2.0 * sum[0], 2.0 * sum[1], 0.0, 2.0 * sum[3]];
            }
            forces.add(ring, &sum);
        }
        rings.map(|sum| sum[3] * self.times())
    }

    /// Rows that are evaluated.
    pub fn rows(&self) -> usize {
        self.closed.len()
    }

    /// Whether the contacts of a row with a race are evaluated in closed form.
    pub fn is_closed(&self, row: usize, side: usize) -> bool {
        self.closed[row][side].is_some()
    }

    /// Whether all bodies stay in the planes of their rows.
    pub fn is_plane(&self) -> bool {
        self.kind.plane
    }

    /// How many contacts one stands for.
    fn times(&self) -> f64 {
        if self.kind.mirrored { 2.0 } else { 1.0 }
    }

    /// Slices whose damping wanted to pull.
    pub fn pulls(&self) -> usize {
        let grouped: u32 = self.groups[..self.active]
            .iter()
            .map(|group| group.press.pulls)
            .sum();
        let single: u32 = self.singles.iter().map(|single| single.sum.pulls).sum();
        (self.pulls + grouped + single) as usize * (1 + usize::from(self.kind.mirrored))
    }

    /// Contacts cut off by a shoulder.
    pub fn truncated(&self) -> usize {
        let cut = self.singles.iter().filter(|single| single.sum.truncated);
        cut.count() * (1 + usize::from(self.kind.mirrored))
    }

    /// The first ball that has left its groove: pressed deeper than half its radius, or beside the groove.
    pub fn lost(&self) -> Option<usize> {
        self.lost
    }
}

/// Closed forms of a row's contacts.
fn closed(model: &Model, row: usize, kind: Kind) -> [Option<Closed>; 2] {
    let compiled = &model.rows[row];
    let mut radii = model.balls[compiled.first..][..compiled.count]
        .iter()
        .map(|ball| ball.side.radius);
    let radius = radii.next().filter(|first| radii.all(|r| r == *first));
    from_fn(|side| {
        let radius = radius.filter(|_| kind.closed)?;
        Closed::new(&compiled.pairs[side], radius, kind.plane)
    })
}

impl Stretch {
    fn new(
        model: &Model,
        constants: &[SideConstants; 2],
        row: usize,
        first: usize,
        count: usize,
    ) -> Self {
        let lane = |lane: usize| first + lane.min(count - 1);
        Self {
            row,
            first,
            radius: Lanes::from_fn(|i| model.balls[lane(i)].side.radius),
            filled: Mask::from_fn(|i| i < count),
            faulted: Mask::from_fn(|i| !model.balls[lane(i)].side.faults.is_empty()),
            constants: from_fn(|side| {
                let mut all = Constants::default();
                (0..LANES).for_each(|i| all.set(i, &constants[side].balls[lane(i)]));
                all
            }),
        }
    }

    /// Numbers of its balls along one direction; in lanes that are left, of whatever comes next.
    // Into what is compiled for the level that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn lanes(&self, of: &Table, direction: usize) -> Lanes {
        of.eight(2 + self.first, direction)
    }
}

impl SideConstants {
    fn new(model: &Model, side: usize) -> Self {
        let of = |ball: &Ball| model.rows[ball.row].pairs[side].constants(ball.side.radius);
        let balls: Vec<_> = model.balls.iter().map(of).collect();
        let mut first = Constants::default();
        (0..LANES).for_each(|lane| first.set(lane, &balls[0]));
        let alike = balls.iter().all(|other| {
            let centre = balls[0].centre;
            Constants { centre, ..*other } == balls[0]
        });
        Self {
            balls,
            first,
            alike,
        }
    }

    /// Eight contacts at a state.
    // Compiled for the level that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    pub fn octet(&self, contacts: &[Touching; LANES], state: &State) -> Octet {
        let State { q, v } = state;
        let (q, v) = (
            [0, 1, 2].map(|k| q.along(k)),
            [0, 1, 2, 3].map(|k| v.along(k)),
        );
        let mut octet = Octet {
            constants: self.first,
            ..Octet::default()
        };
        for (lane, contact) in contacts.iter().enumerate() {
            let of = &self.balls[contact.ball];
            if self.alike {
                octet.constants.centre[lane] = of.centre;
            } else {
                octet.constants.set(lane, of);
            }
            octet.wave[lane] = contact.wave;
            let body = 2 + contact.ball;
            for (to, from) in octet.q.iter_mut().zip(q) {
                to[lane] = from[body];
            }
            for (to, from) in octet.v.iter_mut().zip(v) {
                to[lane] = from[body];
            }
        }
        octet
    }
}

impl Single {
    fn new(side: usize, ball: usize) -> Self {
        Self {
            side,
            ball,
            sum: Sum::default(),
        }
    }
}

/// Leaves to themselves the contacts that were not simple.
fn leave(groups: &[Group], singles: &mut Vec<Single>) {
    for group in groups {
        let lanes = group
            .press
            .careful
            .lanes()
            .filter(|lane| *lane < group.count);
        singles.extend(lanes.map(|lane| Single::new(group.side, group.contacts[lane].ball)));
    }
}

/// Finds what touches, and evaluates what has a closed form.
struct Find<'a> {
    batch: &'a mut Batch,
    forces: Option<&'a mut Table>,
    model: &'a Model,
    state: &'a State,
    rings: &'a [Motion; 2],
}

impl Task for Find<'_> {
    type Output = ();

    // Compiled for the level that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Self {
            batch,
            mut forces,
            model,
            state,
            rings,
        } = self;
        batch.touching.iter_mut().for_each(Vec::clear);
        batch.singles.clear();
        (batch.lost, batch.pulls) = (None, 0);
        let mut on_rings = [[Lanes::ZERO; 3]; 2];
        for stretch in &batch.stretches {
            let q = [
                stretch.lanes(&state.q, 0),
                stretch.lanes(&state.q, 1),
                stretch.lanes(&state.q, 2),
            ];
            let places = Places {
                radius: stretch.radius,
                q,
            };
            let mut lost = Mask::default();
            for (side, pair) in model.rows[stretch.row].pairs.iter().enumerate() {
                let near = pair.near::<FMA>(&places, &rings[side]);
                lost = lost.or(near.lost);
                let touching = near.touching.and(stretch.filled);
                if !touching.any() {
                    continue;
                }
                let faulted = near.faulted.or(stretch.faulted).and(touching);
                let closed = batch.closed[stretch.row][side].as_ref();
                if let Some((closed, forces)) = closed.zip(forces.as_deref_mut()) {
                    let skip = faulted.or(touching.not());
                    let (vx, vy) = (stretch.lanes(&state.v, 0), stretch.lanes(&state.v, 1));
                    let ring = &rings[side];
                    let (ball, pulls, careful) = if batch.kind.plane {
                        let level = pair.press_level::<FMA>(closed, &near, [vx, vy], ring, skip);
                        let [x, y] = level.ball;
                        ([x, y, Lanes::ZERO], level.pulls, level.careful)
                    } else {
                        let octet = Octet {
                            constants: stretch.constants[side],
                            wave: near.wave,
                            q,
                            v: [vx, vy, stretch.lanes(&state.v, 2), Lanes::ZERO],
                        };
                        let press = pair.press::<FMA, false>(&octet, ring, skip, Some(closed));
                        let [x, y, z, _] = press.ball;
                        ([x, y, z], press.pulls, press.careful)
                    };
                    for (i, force) in ball.into_iter().enumerate() {
                        forces.add_eight(2 + stretch.first, i, force);
                        on_rings[side][i] += force;
                    }
                    batch.pulls += pulls;
                    let careful = careful.or(faulted).and(touching);
                    if careful.any() {
                        for lane in careful.lanes() {
                            batch.singles.push(Single::new(side, stretch.first + lane));
                        }
                    }
                    continue;
                }
                for lane in touching.lanes() {
                    let ball = stretch.first + lane;
                    if faulted.lane(lane) {
                        batch.singles.push(Single::new(side, ball));
                    } else {
                        let wave = near.wave[lane];
                        batch.touching[side].push(Touching { ball, wave });
                    }
                }
            }
            let lost = lost.and(stretch.filled);
            if lost.any() && batch.lost.is_none() {
                batch.lost = lost.lanes().map(|lane| stretch.first + lane).next();
            }
        }
        for (ring, [x, y, z]) in batch.rings.iter_mut().zip(on_rings) {
            *ring = [-x.sum(), -y.sum(), -z.sum(), 0.0];
        }
    }
}

/// Evaluates a group.
struct Eight<'a> {
    group: &'a mut Group,
    constants: &'a [SideConstants; 2],
    plane: bool,
    model: &'a Model,
    state: &'a State,
    rings: &'a [Motion; 2],
}

impl Task for Eight<'_> {
    type Output = ();

    // Compiled for the level that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let group = self.group;
        let side = group.side;
        let mut octet = self.constants[side].octet(&group.contacts, self.state);
        // Lanes left over must not count as pulling.
        for lane in group.count..LANES {
            octet.constants.radius[lane] *= 0.5;
        }
        let pair = &self.model.rows[0].pairs[side];
        let (ring, skip) = (&self.rings[side], Mask::default());
        group.press = if self.plane {
            pair.press::<FMA, true>(&octet, ring, skip, None)
        } else {
            pair.press::<FMA, false>(&octet, ring, skip, None)
        };
    }
}
