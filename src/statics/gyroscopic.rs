//! Forces of the balls' motion in their balance: the centrifugal force of their orbit, and friction that turns the spin axes of balls
//! that spin freely (see [`steady`]).
//!
//! The alternative is race control: the outer race alone determines the ball's axis, and the ball does not pivot on it (Jones 1959;
//! Harris & Kotzalas, Essential Concepts of Bearing Technology). With N the direction of a contact from the ball's centre, friction of size T
//! along t × N gives the moment R T t, so R T = I ω_c ω_n, as far as friction can.

use nalgebra::{Vector2, Vector3};

use super::problem::Problem;
use super::rolling::{self, RaceControl};
use super::steady;
use super::unknowns::Rings;
use crate::contact::{Wrench, centrifugal};
use crate::inspect;
use crate::model::{BodyId, Dof, Race};

/// Largest centrifugal force, over the sum of all forces, below which nominal rolling gives it accurately enough: to some percent.
const FAST: f64 = 1e-3;
/// Slip speed at which friction slides, for its largest value \[m/s\].
const SLIDING: f64 = 1.0;

impl Problem<'_> {
    /// Takes centrifugal forces and friction from how the balls roll where they stand; returns the largest change of a force.
    pub(super) fn carry_round(&mut self, rings: &Rings, places: &[Vector2<f64>]) -> f64 {
        let model = self.model;
        if model.scene.ring_speeds(0.0) == [0.0; 2] {
            return 0.0;
        }
        let mut y = self.state(rings, places);
        let speeds = y.len() / 2;
        if self.speeds.is_empty() || self.control != RaceControl::Friction {
            rolling::at_contacts(model, self.control, &mut y);
        } else {
            y[speeds..].copy_from_slice(&self.speeds);
        }
        let outwards = |y: &[f64], j: usize| {
            let orbit = model.layout().motion(y, BodyId::ball(j)).orbit_speed();
            centrifugal(model.bodies[BodyId::ball(j)].mass[Dof::X], orbit)
        };
        let fastest = (0..places.len()).map(|j| outwards(&y, j) * places[j].x);
        if fastest.fold(0.0, f64::max) < FAST * self.magnitude {
            return 0.0;
        }
        let kept = match self.control {
            RaceControl::Friction => steady::keep(model, &mut y),
            RaceControl::Outer => (0..places.len()).collect(),
        };
        self.speeds = y[speeds..].to_vec();
        self.couples = [Vector3::zeros(); 2];
        let mut changed = 0.0_f64;
        for (j, place) in places.iter().enumerate() {
            let of = outwards(&y, j);
            changed = changed.max((of - self.outwards[j]).abs() * place.x);
            self.outwards[j] = of;
            let mut now = [Vector3::zeros(); 2];
            if model.balls_turn() && kept.contains(&j) {
                now = self.friction_in_section(j, &y);
            }
            for race in Race::BOTH {
                changed = changed.max((now[race] - self.friction[j][race]).norm());
            }
            self.friction[j] = now;
        }
        changed
    }

    /// Friction of both races on a ball in its section; the rings get what it turns them.
    fn friction_in_section(&mut self, j: usize, y: &[f64]) -> [Vector3<f64>; 2] {
        let n = Vector3::new(self.directions[j].x, self.directions[j].y, 0.0);
        let t = Vector3::z().cross(&n);
        let found = match self.control {
            RaceControl::Friction => steady::friction(self.model, y, j),
            RaceControl::Outer => self.by_outer(j, y, &t),
        };
        for (couple, of) in self.couples.iter_mut().zip(&found) {
            *couple -= t * of.moment.dot(&t);
        }
        found.map(|of| of.force - t * of.force.dot(&t))
    }

    /// Friction of the outer race that keeps up the spin axis of a ball, as far as it can; that of the inner does the rest.
    fn by_outer(&self, j: usize, y: &[f64], t: &Vector3<f64>) -> [Wrench; 2] {
        let (model, body) = (self.model, BodyId::ball(j));
        let ball = &model.balls[j];
        let motion = model.layout().motion(y, body);
        let outward = motion.across.dot(&self.directions[j]);
        let inertia = model.bodies[body].mass[Dof::Theta];
        let wanted = inertia * motion.orbit_speed() * outward / ball.side.radius;
        let mut left = wanted;
        Race::BOTH.map(|race| {
            let contact = inspect::raw::contact(model, y, j, race);
            let row = &model.rows[ball.row];
            let law = row.pairs[race].law.traction;
            let limit = law.map_or(0.0, |law| law.at(SLIDING) * SLIDING) * contact.load;
            if limit == 0.0 {
                return Wrench::default();
            }
            let size = left.clamp(-limit, limit);
            left -= size;
            let (sin, cos) = (contact.angle * row.side).sin_cos();
            let n = t.cross(&Vector3::z());
            let outward = (n * cos + Vector3::z() * sin) * race.sigma();
            Wrench {
                force: t.cross(&outward) * size,
                moment: t * (ball.side.radius * size),
            }
        })
    }
}
