//! The right-hand side: contacts, evaluated by eights, and all other forces, in one order.

mod accelerations;
mod batch;
mod contributions;
mod evaluation;
mod films;
#[cfg(test)]
mod forces_tests;
mod kept;
#[cfg(test)]
mod lost;
mod order;
#[cfg(test)]
mod spinning_tests;
mod sums;
mod tilted;
#[cfg(test)]
mod tilted_tests;

use crate::base::pool::Pool;
use crate::forces::cage::links::LinkForces;
use crate::forces::cage::ring::{self as cage_ring, CageRings};
use crate::forces::{self, Force, ForceSums, Instant, State, Table, Use};
use crate::integrate::System;
use crate::model::{BodyId, BodyKind, DOFS, Degree, Model, Race, Spring};
use crate::reduction::Reduction;

pub(crate) use batch::{Batch, Guarantees, RingView, SideConstants, Touching, View};
pub(crate) use contributions::contributions_with_films;
pub use contributions::{contribution_names, contributions};

use films::Films;
use kept::Kept;
use order::Order;
use tilted::SpatialWork;
pub(crate) use tilted::turning_accelerations;

/// The right-hand side of a model, with the memory that evaluating it needs. Each run has its own.
#[derive(Debug)]
pub struct Dynamics<'m> {
    model: &'m Model,
    order: Order,
    state: State,
    contacts: Batch,
    contact_torques: [f64; 2],
    forces: Table,
    /// Forces that have a part in the motion, beside contacts; apart those that depend on the sum of the others.
    acting: [Vec<&'static dyn Force>; 2],
    /// Part of the forces that stays the same.
    constant: Table,
    /// Supports of the directions that are integrated; the other directions never strain theirs.
    springs: Vec<Spring>,
    /// Inverse of the mass where a direction is free, 0 where it is not.
    mobility: Table,
    pool: Option<Pool>,
    /// Films that follow the rings' speed.
    films: Option<Films>,
    /// Rings that may tilt.
    tilted: Option<Box<SpatialWork>>,
}

impl<'m> Dynamics<'m> {
    /// The right-hand side for evaluations on one thread, of states as [`Model::names`] orders them.
    pub fn new(model: &'m Model) -> Self {
        Self::with(model, Order::Bodies, Guarantees::default())
    }

    /// The right-hand side for the states that a reduction keeps. `start` is a state of all bodies.
    ///
    /// # Panics
    /// If the length of `start` is not [`Model::dim`].
    pub fn reduced(model: &'m Model, reduction: Reduction, start: &[f64]) -> Self {
        let kind = Guarantees {
            symmetric: reduction.plane,
            mirrored: reduction.mirrored,
        };
        let driven = reduction
            .degrees()
            .enumerate()
            .filter_map(|(at, (body, dof))| {
                let BodyKind::Ring(race) = model.layout().kind(body) else {
                    return None;
                };
                (model.degree(race, dof) == Degree::Driven).then_some((at, race, dof))
            });
        let driven = driven.collect();
        let order = Order::Kept(Box::new(Kept { reduction, driven }));
        let mut dynamics = Self::with(model, order, kind);
        // Only scenes that stay in the plane are reduced: what tilts or spins freely in them rests.
        dynamics.tilted = None;
        dynamics.constant = constant(model, false);
        let kept = dynamics.degrees();
        dynamics
            .springs
            .retain(|spring| kept.contains(&(spring.body, spring.dof)));
        let mut places = start.to_vec();
        let kept = dynamics.compress(start);
        dynamics.expand(0.0, &kept, &mut places);
        dynamics.state.read(&places);
        dynamics
    }

    /// The right-hand side for a run from a state of all bodies, with what it leaves out.
    pub(crate) fn begin(model: &'m Model, reduction: Option<&Reduction>, start: &[f64]) -> Self {
        match reduction {
            Some(reduction) => Self::reduced(model, reduction.clone(), start),
            None => Self::new(model),
        }
    }

    fn with(model: &'m Model, order: Order, kind: Guarantees) -> Self {
        let bodies = model.bodies.len();
        let mut mobility = Table::zeros(bodies);
        for body in model.layout().bodies() {
            mobility.add(body, &model.mobility[body]);
        }
        Self {
            model,
            order,
            state: State::new(model),
            contacts: Batch::new(model, kind),
            contact_torques: [0.0; 2],
            forces: Table::zeros(bodies),
            acting: acting(model),
            constant: constant(model, model.is_spatial()),
            springs: model.springs.clone(),
            mobility,
            pool: None,
            films: Films::new(model),
            tilted: SpatialWork::new(model),
        }
    }

    /// Shares the balls of an evaluation among the threads of a pool.
    #[must_use]
    #[doc(hidden)] // for the benchmarks alone
    pub fn shared(self, pool: Pool) -> Self {
        Self {
            pool: Some(pool),
            ..self
        }
    }

    /// The model.
    pub fn model(&self) -> &'m Model {
        self.model
    }

    /// The model with the films of the last evaluation, for what is read of its state.
    pub(crate) fn current_model(&self) -> &Model {
        self.films.as_ref().map_or(self.model, Films::model)
    }

    /// Speed of the rings that films have which follow it, as of the last evaluation \[rad/s\].
    pub(crate) fn film_speed(&self) -> Option<f64> {
        self.films.as_ref().map(Films::speed)
    }

    /// Gives films that follow the rings' speed the one of another evaluation \[rad/s\].
    pub(crate) fn set_film_speed(&mut self, speed: Option<f64>) {
        if let Some((films, speed)) = self.films.as_mut().zip(speed) {
            films.set(speed, &mut self.contacts);
        }
    }

    /// The state that was read last.
    pub(crate) fn state(&self) -> &State {
        &self.state
    }

    /// Inverse of the mass where a direction may accelerate, else 0.
    pub(crate) fn mobility(&self) -> &Table {
        &self.mobility
    }

    /// The threads that share an evaluation, if there are more than one.
    pub(crate) fn pool(&self) -> Option<&Pool> {
        self.pool.as_ref()
    }

    /// Slices whose damping wanted to pull in the last evaluation.
    pub fn pulls(&self) -> usize {
        self.contacts.pulls()
    }

    /// Contacts cut off by a shoulder in the last evaluation.
    pub fn truncated(&self) -> usize {
        self.contacts.truncated()
    }

    /// The first body among the balls that had left its groove in the last evaluation, if any: pressed deeper than
    /// half its radius, beside the groove, or off the race ([`crate::contact::Torus::farthest`]).
    pub fn lost(&self) -> Option<BodyId> {
        self.contacts.lost().map(BodyId::ball)
    }

    /// The ball that was out of its pocket in the last evaluation, if any, by its number among all balls.
    pub(crate) fn out_of_pocket(&self) -> Option<usize> {
        cage_ring::out_of_pocket(self.model, &self.state, self.contacts.rows())
    }

    /// The forces on every body at a state of the run: x, y, z \[N\] and about z \[N m\]. For a direction that is fixed
    /// or driven their negative is what holds it. Bodies that a reduction leaves out have none.
    ///
    /// # Panics
    /// If the length of `y` is not [`System::dim`].
    pub fn forces(&mut self, t: f64, y: &[f64]) -> Vec<[f64; DOFS]> {
        self.read(t, y);
        self.sum(t);
        let bodies = self.model.layout().bodies();
        bodies.map(|body| self.forces.of(body)).collect()
    }

    /// Moment about z that the balls put on outer and inner ring in the last evaluation \[N m\].
    pub fn ring_torques(&self) -> [f64; 2] {
        self.contact_torques
    }

    /// Whether contacts are evaluated in the frames of rings that may tilt.
    pub(crate) fn tilts(&self) -> bool {
        self.tilted.is_some()
    }

    /// Takes over a state vector.
    pub(crate) fn read(&mut self, t: f64, y: &[f64]) {
        match &self.order {
            Order::Bodies => self.state.read(y),
            Order::Kept(kept) => kept.read(t, y, &mut self.state),
        }
    }

    fn sum(&mut self, t: f64) {
        self.forces.copy_from(&self.constant);
        self.evaluate_contacts();
        self.add_applied_forces(t);
    }

    /// Adds the forces of the contacts at the state last read.
    pub(crate) fn evaluate_contacts(&mut self) {
        let model = match &mut self.films {
            None => self.model,
            Some(films) => films.follow(&self.state, &mut self.contacts),
        };
        let (state, forces) = (&self.state, &mut self.forces);
        let (contacts, pool) = (&mut self.contacts, self.pool.as_ref());
        self.contact_torques = match &mut self.tilted {
            Some(tilted) => tilted.add_contacts(model, state, contacts, forces, pool),
            None => contacts.add_to(forces, model, &View::parallel(state), pool),
        };
    }

    /// Adds the forces of the cage at the state last read.
    pub(crate) fn evaluate_cage(&mut self) {
        self.apply(0.0, [&[&LinkForces, &CageRings], &[]]);
    }

    /// Adds the forces that are neither contacts nor constant.
    fn add_applied_forces(&mut self, t: f64) {
        let acting = std::mem::take(&mut self.acting);
        self.apply(t, acting.each_ref().map(Vec::as_slice));
        self.acting = acting;
    }

    fn apply(&mut self, t: f64, [first, last]: [&[&dyn Force]; 2]) {
        let (rings, moments) = match &mut self.tilted {
            Some(tilted) => tilted.rings_and_moments(),
            None => (None, None),
        };
        let at = Instant {
            t,
            state: &self.state,
            rows: self.contacts.rows(),
            times: if self.contacts.is_mirrored() {
                2.0
            } else {
                1.0
            },
            springs: &self.springs,
            rings,
        };
        let on = &mut self.forces;
        let mut sums = ForceSums { on, moments };
        for force in first {
            force.add(self.model, &at, &mut sums);
        }
        for force in last {
            for race in Race::BOTH {
                let others = sums.on.of(race.ring());
                if let Some(wrench) = force.given_others(self.model, &at, race, &others) {
                    sums.add(race, &wrench);
                }
            }
        }
    }
}

impl System for Dynamics<'_> {
    fn dim(&self) -> usize {
        match &self.order {
            Order::Bodies => self.model.dim(),
            Order::Kept(kept) => kept.reduction.dim(),
        }
    }

    /// M q̈ = F(t, q, q̇) in state space ([*Bodies and frames*](crate::equations#bodies-and-frames)).
    fn rhs(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        self.read(t, y);
        self.sum(t);
        let half = y.len() / 2;
        let (rates, accelerations) = dy.split_at_mut(half);
        rates.copy_from_slice(&y[half..]);
        match &self.order {
            Order::Bodies => self.accelerate(t, accelerations),
            Order::Kept(kept) => {
                kept.accelerate(&self.forces, &self.mobility, accelerations);
                for &(at, race, dof) in &kept.driven {
                    if let Some(prescribed) = self.prescribed(t, race, dof) {
                        accelerations[at] = prescribed;
                    }
                }
            }
        }
    }
}

/// Reads a state of all bodies of a model whose films are those of the state.
pub(crate) fn at_films_of<T>(model: &Model, y: &[f64], read: impl FnOnce(&Model) -> T) -> T {
    let films = Films::of(model, y);
    read(films.as_ref().map_or(model, Films::model))
}

/// The forces that a scene has, beside contacts; apart those that depend on the sum of the others.
fn acting(model: &Model) -> [Vec<&'static dyn Force>; 2] {
    let all = forces::ALL.into_iter();
    let (last, first) = all
        .filter(|force| force.used(model) != Use::Absent)
        .partition(|force| force.waits_for_others());
    [first, last]
}

/// Forces that stay the same, with moments about z where rings stay parallel.
fn constant(model: &Model, spatial: bool) -> Table {
    let mut on = Table::zeros(model.bodies.len());
    let mut moments = Default::default();
    let mut sums = ForceSums {
        on: &mut on,
        moments: spatial.then_some(&mut moments),
    };
    for force in forces::ALL {
        force.add_constant(model, &mut sums);
    }
    on
}

/// Time derivative of a state vector, both of length [`Model::dim`]. Allocates its own memory; a run uses [`Dynamics`].
///
/// # Panics
/// If a length is wrong.
pub fn rhs(model: &Model, t: f64, y: &[f64], dy: &mut [f64]) {
    let dim = model.dim();
    assert!(
        y.len() == dim && dy.len() == dim,
        "a state has {dim} numbers"
    );
    Dynamics::new(model).rhs(t, y, dy);
}

fn add<const N: usize>(sum: &mut [f64; N], part: &[f64; N]) {
    for (s, p) in sum.iter_mut().zip(part) {
        *s += p;
    }
}
