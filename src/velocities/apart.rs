//! Velocities of all bodies, where those of a run are not simply some of them.

use super::matrix::Velocity;
use crate::dynamics::Dynamics;

/// Velocities of all bodies, of runs whose rows are images of each other.
#[derive(Debug)]
pub(super) struct Apart<const N: usize> {
    /// The velocities of the run that are corrected.
    corrected: Vec<Velocity>,
    residual: Vec<[f64; N]>,
}

impl<const N: usize> Apart<N> {
    /// The velocities, where a run needs them.
    pub fn of(dynamics: &Dynamics<'_>) -> Option<Self> {
        dynamics.is_mirrored().then(|| Self {
            corrected: (dynamics.degrees().into_iter().enumerate())
                .filter_map(|(at, (body, dof))| Velocity::of(at, body, dof))
                .collect(),
            residual: vec![[0.0; N]; dynamics.model().bodies.len()],
        })
    }

    /// Takes over those of the run; returns those of all bodies.
    pub fn read(&mut self, dynamics: &Dynamics<'_>, r: &[f64]) -> &mut [f64] {
        self.residual.fill([0.0; N]);
        for Velocity { at, body, place } in &self.corrected {
            self.residual[body.index()][*place] = r[*at];
        }
        let all = self.residual.as_flattened_mut();
        dynamics.mirror(all);
        all
    }

    /// Hands them back to the run.
    pub fn write(&self, r: &mut [f64]) {
        for Velocity { at, body, place } in &self.corrected {
            r[*at] = self.residual[body.index()][*place];
        }
    }
}
