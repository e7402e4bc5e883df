//! The integrated states of a reduced run: from their vector to all bodies, and from forces to their rates.

use crate::forces::{State, Table};
use crate::model::{Dof, Race};
use crate::reduction::Reduction;

/// Directions that a reduction keeps, and how they are evaluated.
#[derive(Debug)]
pub(super) struct Kept {
    pub reduction: Reduction,
    /// Places of the directions of rings whose motion or speed is given, as far as they are among the states.
    pub driven: Vec<(usize, Race, Dof)>,
}

impl Kept {
    /// Takes over a state vector.
    pub fn read(&self, t: f64, y: &[f64], state: &mut State) {
        let (q, v) = y.split_at(y.len() / 2);
        for s in self.reduction.stretches() {
            let (to, from) = (s.bodies(), s.states());
            state.q.along_mut(s.dof)[to.clone()].copy_from_slice(&q[from.clone()]);
            state.v.along_mut(s.dof)[to].copy_from_slice(&v[from]);
        }
        for motion in self.reduction.felt() {
            let (place, speed) = motion.course.at(t);
            *state.q.get_mut(motion.body, motion.dof) = place;
            *state.v.get_mut(motion.body, motion.dof) = speed;
        }
    }

    /// M⁻¹ F of what is kept; the acceleration of driven directions is left to the caller.
    pub fn accelerate(&self, forces: &Table, mobility: &Table, accelerations: &mut [f64]) {
        for s in self.reduction.stretches() {
            let force = &forces.along(s.dof)[s.bodies()];
            let mobility = &mobility.along(s.dof)[s.bodies()];
            let to = &mut accelerations[s.states()];
            for ((a, f), m) in to.iter_mut().zip(force).zip(mobility) {
                *a = f * m;
            }
        }
    }
}
