//! All contacts of an evaluation: those that touch are found, gathered by eights and evaluated together.
//!
//! Eights may be evaluated by several threads; since their members depend on the state alone and they are added
//! up in one order afterwards, the bits do not depend on the number of threads.

use std::array::from_fn;

use rayon::ThreadPool;
use rayon::prelude::*;

use super::sums::Sum;
use super::{add, motion};
use crate::contact::{Constants, Motion, Octet, Places, Press};
use crate::model::{Ball, Model};
use crate::simd::{LANES, Lanes, Mask, Task};

/// The memory for all contacts of a model, and their sums after an evaluation.
#[derive(Debug, Clone)]
pub(super) struct Batch {
    /// The balls of every row by eights, for the search.
    stretches: Vec<Stretch>,
    /// Constants of the contacts with the outer and with the inner race.
    pub constants: [SideConstants; 2],
    /// Contacts of whole surfaces with the outer and with the inner ring, in the order of the balls.
    touching: [Vec<Touching>; 2],
    /// The same by eights: the first `active` of these.
    groups: Vec<Group>,
    active: usize,
    /// Contacts that are evaluated one by one.
    singles: Vec<Single>,
}

/// Up to eight neighbours of a row.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    row: usize,
    first: usize,
    count: usize,
    radius: Lanes,
    /// Which of them have defects of their own.
    faulted: Mask,
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
    pub fn new(model: &Model) -> Self {
        let mut stretches = Vec::new();
        for (row, compiled) in model.rows.iter().enumerate() {
            for start in (0..compiled.count).step_by(LANES) {
                let (first, count) = (compiled.first + start, LANES.min(compiled.count - start));
                let ball = |lane: usize| &model.balls[first + lane.min(count - 1)].side;
                stretches.push(Stretch {
                    row,
                    first,
                    count,
                    radius: Lanes::from_fn(|lane| ball(lane).radius),
                    faulted: Mask::from_fn(|lane| !ball(lane).faults.is_empty()),
                });
            }
        }
        let balls = model.balls.len();
        Self {
            stretches,
            constants: from_fn(|side| SideConstants::new(model, side)),
            touching: from_fn(|_| Vec::with_capacity(balls)),
            groups: vec![Group::default(); 2 * balls.div_ceil(LANES)],
            active: 0,
            singles: Vec::with_capacity(2 * balls),
        }
    }

    /// Evaluates all contacts at a state, by the threads of a pool if there is one.
    pub fn fill(&mut self, model: &Model, y: &[f64], pool: Option<&ThreadPool>) {
        let rings = [motion(y, 0), motion(y, 1)];
        self.find(model, y, &rings);
        self.gather();
        let constants = &self.constants;
        let eight = |group: &mut Group| {
            model.level.run(Eight {
                group,
                constants,
                model,
                y,
                rings: &rings,
            });
        };
        let one = |single: &mut Single| {
            let ball = &model.balls[single.ball];
            let motion = motion(y, 2 + single.ball);
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

    /// Finds what touches.
    pub fn find(&mut self, model: &Model, y: &[f64], rings: &[Motion; 2]) {
        model.level.run(Find {
            batch: self,
            model,
            y,
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

    /// Adds the sums to the forces on all bodies.
    pub fn add_to(&self, forces: &mut [[f64; 4]]) {
        for group in &self.groups[..self.active] {
            for (lane, contact) in group.contacts.iter().enumerate().take(group.count) {
                let of = |sums: [Lanes; 4]| sums.map(|sum| sum[lane]);
                add(&mut forces[2 + contact.ball], &of(group.press.ball));
                add(&mut forces[group.side], &of(group.press.ring));
            }
        }
        for single in &self.singles {
            add(&mut forces[2 + single.ball], &single.sum.ball);
            add(&mut forces[single.side], &single.sum.ring);
        }
    }

    /// Slices whose damping wanted to pull.
    pub fn pulls(&self) -> usize {
        let grouped: u32 = self.groups[..self.active]
            .iter()
            .map(|group| group.press.pulls)
            .sum();
        let single: u32 = self.singles.iter().map(|single| single.sum.pulls).sum();
        (grouped + single) as usize
    }

    /// Contacts cut off by a shoulder.
    pub fn truncated(&self) -> usize {
        self.singles
            .iter()
            .filter(|single| single.sum.truncated)
            .count()
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
    pub fn octet(&self, contacts: &[Touching; LANES], y: &[f64]) -> Octet {
        let (q, v) = y.split_at(y.len() / 2);
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
            let body = 4 * (2 + contact.ball);
            for k in 0..3 {
                octet.q[k][lane] = q[body + k];
            }
            for k in 0..4 {
                octet.v[k][lane] = v[body + k];
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

/// Finds what touches.
struct Find<'a> {
    batch: &'a mut Batch,
    model: &'a Model,
    y: &'a [f64],
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
            model,
            y,
            rings,
        } = self;
        batch.touching.iter_mut().for_each(Vec::clear);
        batch.singles.clear();
        for stretch in &batch.stretches {
            let last = stretch.count - 1;
            let bodies = &y[4 * (2 + stretch.first)..][..4 * stretch.count];
            let places = Places {
                radius: stretch.radius,
                q: from_fn(|k| Lanes::from_fn(|lane| bodies[4 * lane.min(last) + k])),
            };
            for (side, pair) in model.rows[stretch.row].pairs.iter().enumerate() {
                let near = pair.near::<FMA>(&places, &rings[side]);
                if !near.touching.any() {
                    continue;
                }
                let faulted = near.faulted.or(stretch.faulted);
                for lane in near.touching.lanes().filter(|lane| *lane <= last) {
                    let ball = stretch.first + lane;
                    if faulted.lane(lane) {
                        batch.singles.push(Single::new(side, ball));
                    } else {
                        let wave = near.wave[lane];
                        batch.touching[side].push(Touching { ball, wave });
                    }
                }
            }
        }
    }
}

/// Evaluates a group.
struct Eight<'a> {
    group: &'a mut Group,
    constants: &'a [SideConstants; 2],
    model: &'a Model,
    y: &'a [f64],
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
        let mut octet = self.constants[side].octet(&group.contacts, self.y);
        // Lanes left over must not count as pulling.
        for lane in group.count..LANES {
            octet.constants.radius[lane] *= 0.5;
        }
        let pair = &self.model.rows[0].pairs[side];
        group.press = pair.press::<FMA>(&octet, &self.rings[side]);
    }
}
