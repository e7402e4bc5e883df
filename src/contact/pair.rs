//! One ball on one race: finds the zone that touches, and lets `walk` and `feature` do the rest.

use super::race::Raise;
use super::walk::Line;
use super::{Fault, Friction, Law, Motion, Sink, Slices, Torus, V2, Waves};

/// What all contacts of a row's balls with one race share.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The race.
    pub race: Torus,
    /// Its waviness.
    pub waves: Waves,
    /// Elastic law.
    pub law: Law,
    /// Where the ball is cut.
    pub slices: Slices,
    /// Hunt–Crossley α_d \[s/m\].
    pub damping: f64,
    /// Whether a slice that pulls is set to zero.
    pub clamp_pull: bool,
    /// Friction, if any.
    pub friction: Option<Friction>,
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
    /// All forces between a ball and the race of its ring.
    pub fn evaluate<S: Sink>(&self, ball: &BallSide, b: &Motion, r: &Motion, sink: &mut S) {
        let apart = b.centre - r.centre;
        let distance = apart.norm();
        if distance == 0.0 {
            return;
        }
        let n = apart / distance;
        let sigma = self.race.sigma;
        let needs_angle =
            !(self.waves.is_round() && self.faults.is_empty() && ball.faults.is_empty());
        let angle = if needs_angle { n.y.atan2(n.x) } else { 0.0 };
        let on_ring = angle - r.theta;
        let raise = self.waves.raise(on_ring);
        let meridian = self.race.meridian(distance, b.z - r.z, raise.height);
        if meridian.approach(ball.radius) <= 0.0 && meridian.e > 0.0 {
            return;
        }
        let on_ball = if sigma > 0.0 {
            angle
        } else {
            angle + std::f64::consts::PI
        } - b.theta;
        let ring_open = self.faults.iter().any(|fault| fault.in_reach(on_ring));
        let ball_near = ball.faults.iter().any(|fault| fault.in_reach(on_ball));
        let (line, common) = match &self.law {
            Law::Iso16281(_) => (Line::along_ball(&meridian, ball.radius), None),
            Law::Hertz(law) => (
                Line::along_tangent(law, &meridian, ball.radius),
                Some(meridian.normal()),
            ),
        };
        let Some(line) = line else { return };
        let contact = Contact {
            pair: self,
            ball,
            b,
            r,
            apart,
            distance,
            n,
            on_ring,
            raise,
            ring_open,
            // A ring edge is met in another direction than the race.
            ball_open: ball_near || ring_open && !ball.faults.is_empty(),
            common,
            centres: meridian.distance(),
        };
        contact.walk(&line, sink);
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
    /// Its unit vector.
    pub(super) n: V2,
    /// Direction of the ball in the ring's frame.
    pub(super) on_ring: f64,
    /// Of the race by its waves.
    pub(super) raise: Raise<f64>,
    pub(super) ring_open: bool,
    pub(super) ball_open: bool,
    /// (cos α', sin α') of the common normal for the Hertz law.
    pub(super) common: Option<(f64, f64)>,
    /// Distance of ball's and groove's centre in the meridional plane.
    pub(super) centres: f64,
}
