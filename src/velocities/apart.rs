//! Velocities of all bodies, where those of a run are not simply some of them.

use super::matrix::Velocity;
use crate::dynamics::Dynamics;
use crate::forces::State;
use crate::model::{BodyId, DOFS, Dof};

/// Velocities of all bodies, of runs whose balls follow their radii or whose rows are images of each other.
#[derive(Debug)]
pub(super) struct Apart<const N: usize> {
    /// The velocities of the run that are corrected, along axes and about them.
    corrected: Vec<Velocity>,
    /// Corrections along the radii of balls.
    radial: Vec<Radial>,
    residual: Vec<[f64; N]>,
}

/// The velocity of a ball along its radius, where its distance from the shaft is a state.
#[derive(Debug)]
struct Radial {
    /// Offset among the states of a run.
    at: usize,
    ball: BodyId,
    /// Direction of the radius, when the matrix was made.
    direction: [f64; 2],
}

impl<const N: usize> Apart<N> {
    /// The velocities, where a run needs them.
    pub fn of(dynamics: &Dynamics<'_>) -> Option<Self> {
        let radii = dynamics.radii();
        if radii.is_empty() && !dynamics.is_mirrored() {
            return None;
        }
        let degrees = dynamics.degrees().into_iter().enumerate();
        let is_radius = |at: usize| radii.iter().any(|(radius, _)| *radius == at);
        let along = degrees.filter(|(at, _)| !is_radius(*at));
        Some(Self {
            corrected: along
                .filter_map(|(at, (body, dof))| Velocity::of(at, body, dof))
                .collect(),
            radial: radii
                .iter()
                .map(|(at, ball)| Radial::new(*at, *ball))
                .collect(),
            residual: vec![[0.0; N]; dynamics.model().bodies.len()],
        })
    }

    /// Takes over the radii of balls.
    pub fn look(&mut self, state: &State) {
        for radial in &mut self.radial {
            radial.look(state);
        }
    }

    /// Takes over those of the run; returns those of all bodies.
    pub fn read(&mut self, dynamics: &Dynamics<'_>, r: &[f64]) -> &mut [f64] {
        self.residual.fill([0.0; N]);
        for Velocity { at, body, place } in &self.corrected {
            self.residual[body.index()][*place] = r[*at];
        }
        for radial in &self.radial {
            radial.put(r, &mut self.residual[radial.ball.index()]);
        }
        let all = self.residual.as_flattened_mut();
        if N == DOFS {
            dynamics.mirror(all);
        }
        all
    }

    /// Hands them back to the run.
    pub fn write(&self, r: &mut [f64]) {
        for Velocity { at, body, place } in &self.corrected {
            r[*at] = self.residual[body.index()][*place];
        }
        for radial in &self.radial {
            radial.take(&self.residual[radial.ball.index()], r);
        }
    }
}

impl Radial {
    fn new(at: usize, ball: BodyId) -> Self {
        Self {
            at,
            ball,
            direction: [1.0, 0.0],
        }
    }

    fn look(&mut self, state: &State) {
        let [x, y] = Dof::SYMMETRIC.map(|dof| state.q.get(self.ball, dof));
        let radius = x.hypot(y);
        self.direction = [x / radius, y / radius];
    }

    fn put(&self, r: &[f64], body: &mut [f64]) {
        // x and y stand first.
        for (to, direction) in body.iter_mut().zip(self.direction) {
            *to = r[self.at] * direction;
        }
    }

    fn take(&self, body: &[f64], r: &mut [f64]) {
        let along = body.iter().zip(self.direction);
        r[self.at] = along.map(|(from, direction)| from * direction).sum();
    }
}
