//! One ball on one race: finds the zone that touches, and cuts it into slices.

mod slices;

pub(super) use slices::{Line, Node};

use super::laws::traction::Rolling;
use super::profile::{Raise, Section};
use super::{Cut, Fault, Law, Motion, Sink, Slices, Torus, V2, Waves, turned};

/// What all contacts of a row's balls with one race share.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The race.
    pub race: Torus,
    /// Its waviness.
    pub waves: Waves,
    /// What they follow.
    pub law: Law,
    /// Slices or nodes of a contact.
    pub slices: Slices,
    /// Defects of the race, in the ring's frame.
    pub faults: Vec<Fault>,
}

/// What belongs to the ball.
#[derive(Debug, Clone, PartialEq)]
pub struct BallSide {
    /// Radius \[m\].
    pub radius: f64,
    /// Defects of the ball, in its frame.
    pub faults: Vec<Fault>,
}

impl Pair {
    /// Whether friction asks how the surfaces roll: only then it is found out.
    pub(super) fn reads_rolling(&self) -> bool {
        self.law.traction.is_some_and(|law| law.reads_rolling())
    }

    /// All forces between a ball and the race of its ring.
    pub fn evaluate<S: Sink>(&self, ball: &BallSide, b: &Motion, r: &Motion, sink: &mut S) {
        let seen = b.seen_from(r);
        let apart = seen.centre;
        let distance = apart.norm();
        if distance == 0.0 {
            return;
        }
        let n = apart / distance;
        let sigma = self.race.sigma;
        let needs_angle =
            !(self.waves.is_round() && self.faults.is_empty() && ball.faults.is_empty());
        let angle = if needs_angle { seen.direction() } else { 0.0 };
        let on_ring = r.angle_of(angle);
        let raise = self.waves.raise(on_ring);
        let section = self
            .race
            .section(ball.radius, distance, seen.z, raise.height);
        if section.is_clear() {
            return;
        }
        let on_ball = b.angle_of(if sigma > 0.0 {
            angle
        } else {
            angle + std::f64::consts::PI
        });
        let ring_open = self.faults.iter().any(|fault| fault.in_reach(on_ring));
        let ball_near = ball.faults.iter().any(|fault| fault.in_reach(on_ball));
        let line = match self.law.cut() {
            Cut::BallSurface => Some(Line::along_ball(&section)),
            Cut::CommonTangent { curvature } => Line::along_tangent(curvature, &section),
        };
        let Some(line) = line else { return };
        let across = seen.velocity.dot(&turned(n));
        let contact = Contact {
            pair: self,
            ball,
            b,
            r,
            apart,
            distance,
            z: seen.z,
            n,
            on_ring,
            raise,
            ring_open,
            // A ring edge is met in another direction than the race.
            ball_open: ball_near || ring_open && !ball.faults.is_empty(),
            section,
            rolling: if self.reads_rolling() {
                Rolling::new(distance, across, [b.omega, r.omega])
            } else {
                Rolling::resting(distance)
            },
        };
        contact.slices(&line, sink);
    }
}

/// A contact being evaluated.
pub(super) struct Contact<'a> {
    pub(super) pair: &'a Pair,
    pub(super) ball: &'a BallSide,
    pub(super) b: &'a Motion,
    pub(super) r: &'a Motion,
    /// From the ring's centre to the ball's.
    pub(super) apart: V2,
    pub(super) distance: f64,
    /// Axial place of the ball in the ring's frame.
    pub(super) z: f64,
    /// Its unit vector.
    pub(super) n: V2,
    /// Direction of the ball in the ring's frame.
    pub(super) on_ring: f64,
    /// Of the race by its waves.
    pub(super) raise: Raise<f64>,
    pub(super) ring_open: bool,
    pub(super) ball_open: bool,
    pub(super) section: Section<f64>,
    pub(super) rolling: Rolling<f64>,
}

impl Contact<'_> {
    /// (cos α', sin α') of the common normal, where all elements press along it.
    pub(super) fn common(&self) -> Option<(f64, f64)> {
        let is_flat = self.pair.law.cut().is_flat();
        is_flat.then_some(self.section.normal)
    }
}
