//! The right-hand side: contacts, evaluated by eights, and all other forces, in one order.

mod arrow;
mod batch;
mod contacts;
mod energy;
mod grip;
mod implicit;
mod others;
mod stage;
mod sums;

use std::sync::Arc;

use rayon::ThreadPool;

use crate::contact::{Motion, Pair, Slices};
use crate::integrate::System;
use crate::model::{Model, RowModel};
use crate::scene::Drive;

pub use contacts::{ContactSummary, SliceForce};
pub use energy::Energy;

use batch::Batch;
use stage::Stage;
use sums::Named;

/// A model with the memory that evaluating it needs. One a thread of control.
#[derive(Debug)]
pub struct Dynamics<'m> {
    model: &'m Model,
    contacts: Batch,
    contact_torques: [f64; 2],
    forces: Vec<[f64; 4]>,
    pool: Option<Arc<ThreadPool>>,
    /// Memory of implicit stages, once there was one.
    implicit: Option<Box<Stage>>,
}

/// Names of the contributions of [`Dynamics::contributions`], in their order.
pub const CONTRIBUTIONS: [&str; 8] = [
    "contact", "damping", "friction", "cage", "support", "gravity", "load", "drive",
];

/// The body whose rotation a speed drives.
const INNER: usize = 1;

impl<'m> Dynamics<'m> {
    /// For evaluations on one thread.
    pub fn new(model: &'m Model) -> Self {
        Self {
            model,
            contacts: Batch::new(model),
            contact_torques: [0.0; 2],
            forces: vec![[0.0; 4]; model.bodies.len()],
            pool: None,
            implicit: None,
        }
    }

    /// Shares the balls of an evaluation among the threads of a pool.
    pub fn parallel(model: &'m Model, pool: Arc<ThreadPool>) -> Self {
        Self {
            pool: Some(pool),
            ..Self::new(model)
        }
    }

    /// The model.
    pub fn model(&self) -> &'m Model {
        self.model
    }

    /// Slices whose damping wanted to pull in the last evaluation.
    pub fn pulls(&self) -> usize {
        self.contacts.pulls()
    }

    /// Contacts cut off by a shoulder in the last evaluation.
    pub fn truncated(&self) -> usize {
        self.contacts.truncated()
    }

    /// The forces of the last evaluation on every body: x, y, z \[N\] and about z \[N m\]. For a direction
    /// that is fixed or driven their negative is what holds it.
    pub fn last_forces(&self) -> &[[f64; 4]] {
        &self.forces
    }

    /// Moment about z that the balls put on outer and inner ring in the last evaluation \[N m\].
    pub fn ring_torques(&self) -> [f64; 2] {
        self.contact_torques
    }

    fn sum(&mut self, t: f64, y: &[f64]) {
        self.contacts.fill(self.model, y, self.pool.as_deref());
        self.forces.fill([0.0; 4]);
        self.contacts.add_to(&mut self.forces);
        self.contact_torques = [0, 1].map(|ring| self.forces[ring][3]);
        self.others(t, y);
    }

    /// Adds the forces that are not contacts.
    fn others(&mut self, t: f64, y: &[f64]) {
        others::cage(self.model, y, &mut self.forces);
        others::supports(self.model, y, &mut self.forces);
        others::gravity(self.model, &mut self.forces);
        others::loads(self.model, t, y, &mut self.forces);
        others::drive(self.model, t, &mut self.forces);
    }

    /// M⁻¹ F of a body. Directions that are fixed do not accelerate; the driven ring's rotation accelerates as
    /// prescribed.
    fn acceleration(&self, t: f64, body: usize) -> [f64; 4] {
        let (force, mobility) = (&self.forces[body], &self.model.mobility[body]);
        let mut acceleration = std::array::from_fn(|i| force[i] * mobility[i]);
        if let (INNER, Drive::Speed(speed)) = (body, &self.model.scene.drive) {
            acceleration[3] = speed.rate(t);
        }
        acceleration
    }

    /// The same forces apart by origin, as in [`CONTRIBUTIONS`]: for each, four numbers a body.
    pub fn contributions(&self, t: f64, y: &[f64]) -> Vec<(&'static str, Vec<f64>)> {
        let model = self.model;
        let bodies = model.bodies.len();
        let mut parts = vec![vec![[0.0; 4]; bodies]; CONTRIBUTIONS.len()];
        let rings = [motion(y, 0), motion(y, 1)];
        for (j, ball) in model.balls.iter().enumerate() {
            for (side, pair) in model.rows[ball.row].pairs.iter().enumerate() {
                let mut named = Named::default();
                pair.evaluate(&ball.side, &motion(y, 2 + j), &rings[side], &mut named);
                for (part, (on_ball, on_ring)) in parts.iter_mut().zip(named.wrenches()) {
                    add(&mut part[2 + j], &on_ball);
                    add(&mut part[side], &on_ring);
                }
            }
        }
        others::cage(model, y, &mut parts[3]);
        others::supports(model, y, &mut parts[4]);
        others::gravity(model, &mut parts[5]);
        others::loads(model, t, y, &mut parts[6]);
        others::drive(model, t, &mut parts[7]);
        CONTRIBUTIONS
            .into_iter()
            .zip(parts.into_iter().map(|part| part.concat()))
            .collect()
    }
}

impl System for Dynamics<'_> {
    fn dim(&self) -> usize {
        self.model.dim()
    }

    /// M q̈ = F(t, q, q̇) in state space (model section 1).
    fn rhs(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        self.sum(t, y);
        let half = y.len() / 2;
        let (rates, accelerations) = dy.split_at_mut(half);
        rates.copy_from_slice(&y[half..]);
        for (b, acceleration) in accelerations.as_chunks_mut().0.iter_mut().enumerate() {
            *acceleration = self.acceleration(t, b);
        }
    }
}

impl Model {
    /// Time derivative of a state vector, both of length [`Model::dim`]. Allocates its own memory; a run
    /// uses [`Dynamics`].
    ///
    /// # Panics
    /// If a length is wrong.
    pub fn rhs(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        assert!(
            y.len() == self.dim() && dy.len() == self.dim(),
            "a state has {} numbers",
            self.dim()
        );
        Dynamics::new(self).rhs(t, y, dy);
    }

    /// The forces on every body by origin (see [`CONTRIBUTIONS`]): x, y, z \[N\] and about z \[N m\] for each
    /// body in turn.
    ///
    /// # Panics
    /// If the length of `y` is wrong.
    pub fn forces(&self, t: f64, y: &[f64]) -> Vec<(&'static str, Vec<f64>)> {
        assert_eq!(y.len(), self.dim(), "length of the state");
        Dynamics::new(self).contributions(t, y)
    }
}

impl Model {
    /// The first body among the balls that has left its groove, if any: pressed deeper than half its radius,
    /// or beside the groove.
    pub(crate) fn escaped(&self, y: &[f64]) -> Option<usize> {
        let rings = [motion(y, 0), motion(y, 1)];
        (0..self.balls.len()).map(|j| 2 + j).find(|&body| {
            let ball = &self.balls[body - 2];
            let place = motion(y, body);
            self.rows[ball.row]
                .pairs
                .iter()
                .zip(&rings)
                .any(|(pair, ring)| {
                    let distance = (place.centre - ring.centre).norm();
                    let meridian = pair.race.meridian(distance, place.z - ring.z, 0.0);
                    // Negated, so that a position that is not a number counts as lost.
                    !(meridian.c.abs() < meridian.r
                        && meridian.approach(ball.side.radius) < 0.5 * ball.side.radius)
                })
        })
    }

    /// The radius that makes a length of a body's rotation \[m\]: a ball's own, half the pitch diameter of the
    /// first row for a ring.
    pub(crate) fn radius(&self, body: usize) -> f64 {
        match body.checked_sub(2) {
            Some(ball) => self.balls[ball].side.radius,
            None => self.scene.rows[0].pitch_diameter / 2.0,
        }
    }

    /// Whether sharing one evaluation among threads pays: below some 7 µs the wait for the last thread costs more
    /// (`cargo bench --bench layers -- threads`).
    pub(crate) fn is_large(&self) -> bool {
        /// Nodes of all contacts from which two threads were faster.
        const BREAK_EVEN: usize = 1500;
        let nodes = |row: &RowModel| -> usize {
            let of = |pair: &Pair| match &pair.slices {
                // About a third of the ball touches.
                Slices::Fixed(count) => count / 3,
                Slices::Fitted(rules) => rules.count(),
            };
            row.count * row.pairs.iter().map(of).sum::<usize>()
        };
        self.rows.iter().map(nodes).sum::<usize>() > BREAK_EVEN
    }
}

/// Motion of a body in a state vector.
pub(crate) fn motion(y: &[f64], body: usize) -> Motion {
    let half = y.len() / 2;
    Motion::new(
        &y[4 * body..4 * body + 4],
        &y[half + 4 * body..half + 4 * body + 4],
    )
}

fn add(sum: &mut [f64; 4], part: &[f64; 4]) {
    for (s, p) in sum.iter_mut().zip(part) {
        *s += p;
    }
}
