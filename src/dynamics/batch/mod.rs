//! Batch of all contacts of an evaluation: those that touch are found, gathered by eights and evaluated together.
//!
//! Each ring has its own [`View`] of the balls: the scene's state where rings are parallel, else all balls turned into its frame, where
//! separate code adds the slip of balls that turn across its axis.
//!
//! Eights may be evaluated by several threads; since their members depend on the state alone and they are added
//! up in one order afterwards, the bits do not depend on the number of threads.

mod eight;
mod find;
mod single;
mod view;

use std::array::from_fn;

use nalgebra::Vector3;

use crate::base::pool::{self, Pool};
use crate::contact::BatchForces;
use crate::forces::Table;
use crate::model::{BodyId, DOFS, Dof, Model, Race};
use crate::simd::{LANES, Lanes};

use eight::{EvaluateEight, Group, ToScene, leave, mixes};
pub(crate) use eight::{SideConstants, Touching};
use find::{Find, Neighbours};
use single::Single;
pub(crate) use view::{RingView, View};

/// Force on each ring and moment about the origin of its frame, both in that frame \[N\], \[N m\].
pub(crate) type OnRings = [[Vector3<f64>; 2]; 2];

/// Guarantees of a reduction, so that a batch may use them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Guarantees {
    /// Guarantee that all bodies stay in the planes of their rows.
    pub symmetric: bool,
    /// The second row is an image of the first.
    pub mirrored: bool,
}

/// The memory for all contacts of a model, and their sums after an evaluation.
#[derive(Debug, Clone)]
pub(crate) struct Batch {
    kind: Guarantees,
    /// Number of the rows whose contacts are evaluated.
    rows: usize,
    /// The balls by eights, for the search.
    stretches: Vec<Neighbours>,
    /// Constants of the contacts with the outer and with the inner race.
    pub constants: [SideConstants; 2],
    /// Contacts of whole surfaces with the outer and with the inner ring in the order of the balls, by the class of their row.
    touching: Vec<[Vec<Touching>; 2]>,
    /// The same by eights: the first `active` of these.
    groups: Vec<Group>,
    active: usize,
    /// Whether contacts of a class with both rings may be side by side in one of these.
    mixed: Vec<bool>,
    /// Contacts that are evaluated one by one.
    singles: Vec<Single>,
    /// The first ball that has left its groove.
    lost: Option<usize>,
}

impl Batch {
    pub fn new(model: &Model, kind: Guarantees) -> Self {
        let constants: [SideConstants; 2] = Race::BOTH.map(|race| SideConstants::new(model, race));
        let mut stretches = Vec::new();
        let rows = if kind.mirrored { 1 } else { model.rows.len() };
        for (row, compiled) in model.rows[..rows].iter().enumerate() {
            for start in (0..compiled.count).step_by(LANES) {
                let (first, count) = (compiled.first + start, LANES.min(compiled.count - start));
                stretches.push(Neighbours::new(model, row, first, count));
            }
        }
        let balls = model.balls.len();
        let eights = model.classes().map(|class| model.eights(class));
        Self {
            groups: vec![Group::default(); 2 * eights.sum::<usize>()],
            kind,
            rows,
            stretches,
            constants,
            touching: (0..model.rows.len())
                .map(|_| from_fn(|_| Vec::with_capacity(balls)))
                .collect(),
            active: 0,
            mixed: (0..model.rows.len())
                .map(|class| mixes(model, class))
                .collect(),
            singles: Vec::with_capacity(2 * balls),
            lost: None,
        }
    }

    /// Takes over the radii of races whose films have changed.
    pub fn update_films(&mut self, model: &Model) {
        for race in Race::BOTH {
            self.constants[race].update_films(model, race);
        }
    }

    /// Evaluates all contacts as they are seen by rings that stand parallel, by the threads of a pool if there is one, and adds
    /// their sums to the forces on all bodies; returns the moments about z on the two rings.
    pub fn add_to(
        &mut self,
        forces: &mut Table,
        model: &Model,
        views: &[View<'_>; 2],
        pool: Option<&Pool>,
    ) -> [f64; 2] {
        self.fill(model, views, pool);
        let mut rings = self.add_balls(forces);
        for race in Race::BOTH {
            let sum = &mut rings[race];
            if self.kind.mirrored {
                // The mirror image adds the same in the plane, and the opposite along z.
                *sum = sum.map(|part| 2.0 * part);
                sum[Dof::Z] = 0.0;
            }
            forces.add(race.ring(), sum);
        }
        rings.map(|sum| sum[Dof::Theta])
    }

    /// The same for rings that may tilt, on which forces are returned and moments about the origins of their frames, both in these.
    pub fn add_tilted(
        &mut self,
        forces: &mut Table,
        model: &Model,
        views: &[View<'_>; 2],
        pool: Option<&Pool>,
    ) -> OnRings {
        self.fill(model, views, pool);
        let (rings, across) = (self.add_balls(forces), self.moments_across(views));
        Race::BOTH.map(|race| {
            let ([x, y, z, about], [about_x, about_y]) = (rings[race], across[race]);
            [Vector3::new(x, y, z), Vector3::new(about_x, about_y, about)]
        })
    }

    fn fill(&mut self, model: &Model, views: &[View<'_>; 2], pool: Option<&Pool>) {
        self.find(model, views);
        self.gather(views);
        if self.active > 0 || !self.singles.is_empty() {
            self.evaluate(model, views, pool);
        }
    }

    /// Evaluates what was found, by eights and one by one.
    fn evaluate(&mut self, model: &Model, views: &[View<'_>; 2], pool: Option<&Pool>) {
        let all = EvaluateEight {
            constants: &self.constants,
            symmetric: self.kind.symmetric,
            model,
            views,
        };
        let eight = |group: &mut Group| {
            let view = &views[group.race(0)];
            let Some(ring) = view.tilted else {
                all.run::<false>(group);
                return;
            };
            // Not in the kernel: where lanes are filled one by one the compiler splits whole registers.
            let balls = group.contacts.iter().map(|contact| contact.ball);
            group.turning = view.turning(balls);
            all.run::<true>(group);
            model.instructions.run(ToScene { group, ring });
        };
        let one = |single: &mut Single| single.evaluate(model, &views[single.race]);
        let (groups, singles) = (&mut self.groups[..self.active], &mut self.singles);
        pool::each(pool, groups, eight);
        leave(groups, singles);
        pool::each(pool, singles, one);
    }

    /// Finds the contacts that touch.
    pub fn find(&mut self, model: &Model, views: &[View<'_>; 2]) {
        let touching = self.touching.as_flattened_mut().iter_mut();
        touching.for_each(Vec::clear);
        self.singles.clear();
        self.lost = None;
        model.instructions.run(Find {
            batch: self,
            model,
            views,
        });
    }

    /// Contacts of whole surfaces with a ring, as last found.
    pub fn touching(&self, race: Race) -> impl Iterator<Item = &Touching> {
        self.touching.iter().flat_map(move |of| &of[race])
    }

    /// Race and ball of the contacts that may see a defect, as last found.
    pub fn defective(&self) -> impl Iterator<Item = (Race, usize)> {
        self.singles.iter().map(|single| (single.race, single.ball))
    }

    /// Gathers the contacts that touch by eights: those with both rings side by side where the equations allow it.
    fn gather(&mut self, views: &[View<'_>; 2]) {
        self.active = 0;
        let parallel = views.iter().all(|view| view.tilted.is_none());
        for (class, [outer, inner]) in self.touching.iter().enumerate() {
            let mut next = |contacts: [&[Touching]; 2]| {
                self.groups[self.active].take(class, contacts);
                self.active += 1;
            };
            let beside = if parallel && self.mixed[class] {
                outer.len() % LANES
            } else {
                0
            };
            let (whole, rest) = outer.split_at(outer.len() - beside);
            whole.chunks(LANES).for_each(|outer| next([outer, &[]]));
            let fill = inner.len().min(LANES - rest.len());
            let (first, others) = inner.split_at(if beside > 0 { fill } else { 0 });
            if beside > 0 {
                next([rest, first]);
            }
            others.chunks(LANES).for_each(|inner| next([&[], inner]));
        }
    }

    /// Adds the sums on balls; returns those on the rings.
    fn add_balls(&self, forces: &mut Table) -> [[f64; DOFS]; 2] {
        let mut rings = [[0.0; DOFS]; 2];
        for group in &self.groups[..self.active] {
            for (lane, contact) in group.contacts.iter().enumerate().take(group.count) {
                let BatchForces { ball, ring, .. } = &group.forces;
                let of =
                    |[x, y, z, theta]: &[Lanes; DOFS]| [x[lane], y[lane], z[lane], theta[lane]];
                forces.add(BodyId::ball(contact.ball), &of(ball));
                super::add(&mut rings[group.race(lane)], &of(ring));
            }
        }
        for single in &self.singles {
            forces.add(BodyId::ball(single.ball), &single.on_ball.about_axis());
            super::add(&mut rings[single.race], &single.on_ring.about_axis());
        }
        rings
    }

    /// Moments about x and y of the scene on balls that spin freely, where there are places for them.
    pub fn moments_on_balls(&self, to: &mut [[f64; 2]]) {
        if to.is_empty() {
            return;
        }
        to.fill([0.0; 2]);
        for group in &self.groups[..self.active] {
            let [[x, y], _] = &group.across;
            for (lane, contact) in group.contacts[..group.count].iter().enumerate() {
                super::add(&mut to[contact.ball], &[x[lane], y[lane]]);
            }
        }
        for single in &self.singles {
            super::add(&mut to[single.ball], &single.on_ball.moment.xy().into());
        }
    }

    /// Moments across the axes of rings that tilt, about the origins of their frames.
    fn moments_across(&self, views: &[View<'_>; 2]) -> [[f64; 2]; 2] {
        let mut rings = [[0.0; 2]; 2];
        let groups = self.groups[..self.active].iter();
        for group in groups.filter(|group| views[group.race(0)].tilted.is_some()) {
            let (sum, [_, [x, y]]) = (&mut rings[group.race(0)], &group.across);
            for lane in 0..group.count {
                super::add(sum, &[x[lane], y[lane]]);
            }
        }
        for single in &self.singles {
            super::add(&mut rings[single.race], &single.on_ring.moment.xy().into());
        }
        rings
    }

    /// Number of the rows that are evaluated, the first ones.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Whether one row stands for two.
    pub fn is_mirrored(&self) -> bool {
        self.kind.mirrored
    }

    /// Whether all bodies stay in the planes of their rows.
    pub fn is_symmetric(&self) -> bool {
        self.kind.symmetric
    }

    /// Slices whose damping wanted to pull.
    pub fn pulls(&self) -> usize {
        let grouped: u32 = self.groups[..self.active]
            .iter()
            .map(|group| group.forces.pulls)
            .sum();
        let single: u32 = self.singles.iter().map(|single| single.pulls).sum();
        (grouped + single) as usize * (1 + usize::from(self.kind.mirrored))
    }

    /// Contacts cut off by a shoulder.
    pub fn truncated(&self) -> usize {
        let cut = self.singles.iter().filter(|single| single.truncated);
        cut.count() * (1 + usize::from(self.kind.mirrored))
    }

    /// The first ball that is lost ([`crate::contact::Torus::farthest`]).
    pub fn lost(&self) -> Option<usize> {
        self.lost
    }
}
