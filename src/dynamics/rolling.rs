//! Rows that turn as one body: from radii to positions, and from forces to accelerations of the radii.

use crate::forces::{State, Table};
use crate::model::Dof;
use crate::reduction::Reduction;

/// Directions of the balls of all rows that turn as one, at the last state.
#[derive(Debug, Clone, Default)]
pub(super) struct RollingRows {
    balls: Vec<RollingBall>,
}

/// A ball on its radius.
#[derive(Debug, Clone, Copy, Default)]
struct RollingBall {
    direction: [f64; 2],
    /// r ω² \[m/s²\].
    centrifugal: f64,
}

impl RollingRows {
    pub fn new(reduction: &Reduction) -> Self {
        let count = reduction
            .orbits()
            .map(|(orbit, _)| orbit.starts.len())
            .sum();
        Self {
            balls: vec![RollingBall::default(); count],
        }
    }

    /// Computes the places and speeds of balls whose radii are states in place of x.
    pub fn place(&mut self, reduction: &Reduction, t: f64, state: &mut State) {
        let mut balls = self.balls.iter_mut();
        for (orbit, _) in reduction.orbits() {
            let turn = orbit.turn(t);
            let bodies = orbit.first.range(orbit.starts.len());
            let [x, y, ..] = state.q.directions_mut().map(|of| &mut of[bodies.clone()]);
            let [vx, vy, ..] = state.v.directions_mut().map(|of| &mut of[bodies.clone()]);
            for (k, (start, ball)) in orbit.starts.iter().zip(balls.by_ref()).enumerate() {
                let [cos, sin] = turn.of(*start);
                let (r, v) = (x[k], vx[k]);
                let around = r * turn.speed;
                (x[k], y[k]) = (r * cos, r * sin);
                (vx[k], vy[k]) = (v * cos - around * sin, v * sin + around * cos);
                *ball = RollingBall {
                    direction: [cos, sin],
                    centrifugal: around * turn.speed,
                };
            }
        }
    }

    /// Second derivatives of the radii: r̈ = F_r / m + r ω².
    pub fn accelerate(
        &self,
        reduction: &Reduction,
        forces: &Table,
        mobility: &Table,
        accelerations: &mut [f64],
    ) {
        let mut balls = self.balls.iter();
        for (orbit, at) in reduction.orbits() {
            let count = orbit.starts.len();
            let bodies = orbit.first.range(count);
            let [x, y] = Dof::SYMMETRIC.map(|dof| &forces.along(dof)[bodies.clone()]);
            let m = &mobility.along(Dof::X)[bodies];
            for (k, ball) in balls.by_ref().take(count).enumerate() {
                let [cos, sin] = ball.direction;
                accelerations[at + k] = (x[k] * cos + y[k] * sin) * m[k] + ball.centrifugal;
            }
        }
    }
}
