//! Velocities corrected by friction's matrix, once a step: what [`Adams`](crate::integrate::Adams) asks for.

use super::stage::Stage;
use super::stage_batch::Velocities;
use crate::dynamics::{Dynamics, RingView, View};
use crate::forces::State;
use crate::integrate::{LinearlyImplicit, System};
use crate::model::{BodyId, DOFS, Dof, RowModel};

/// Steps that a matrix serves at most. On 64 scenes (two presets, random bearings) 8, 32, 128 and 512 gave errors alike and
/// step counts within half a percent; a new one costs about six evaluations (a profile of the wheel bearing).
const SERVES: usize = 128;

/// A right-hand side with the matrix of its contacts' friction and damping, made now and then.
#[derive(Debug)]
pub(crate) struct Damped<'d, 'm> {
    pub dynamics: &'d mut Dynamics<'m>,
    /// None where no force of a contact depends on velocities.
    matrix: Option<Box<Matrix>>,
}

/// A matrix of all bodies, also where the run leaves some out.
#[derive(Debug)]
struct Matrix {
    stage: Stage,
    /// What each velocity of the run belongs to, but for turning about x and y, which stands behind.
    degrees: Vec<(BodyId, Dof)>,
    /// The last state of all bodies, as a run's vector and as the contacts read it.
    full: Vec<f64>,
    state: State,
    /// Where rings may tilt, all balls as these see them.
    rings: Option<[RingView; 2]>,
    /// Steps that it has served.
    served: usize,
}

impl<'d, 'm> Damped<'d, 'm> {
    pub fn new(dynamics: &'d mut Dynamics<'m>) -> Self {
        let model = dynamics.model();
        let resists = model.rows.iter().any(RowModel::resists_motion);
        let matrix = (resists && dynamics.is_cartesian()).then(|| {
            let state = dynamics.state().clone();
            let mut degrees = dynamics.degrees();
            degrees.retain(|(_, dof)| Dof::ALL.contains(dof));
            let mut full = vec![0.0; model.dim()];
            state.write(&mut full);
            Box::new(Matrix {
                stage: Stage::new(model, dynamics.rows_in_motion()),
                degrees,
                full,
                state,
                rings: RingView::both(model).filter(|_| dynamics.leans()),
                served: 0,
            })
        });
        Self { dynamics, matrix }
    }
}

impl System for Damped<'_, '_> {
    fn dim(&self) -> usize {
        self.dynamics.dim()
    }

    fn rhs(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        self.dynamics.rhs(t, y, dy);
    }
}

impl LinearlyImplicit for Damped<'_, '_> {
    fn damp(&mut self, t: f64, y: &[f64], gamma_h: f64, r: &mut [f64]) {
        let Some(matrix) = &mut self.matrix else {
            return;
        };
        if matrix.served >= SERVES || !matrix.stage.is_like(gamma_h) {
            matrix.renew(self.dynamics, t, y, gamma_h);
        }
        matrix.served += 1;
        matrix.solve(self.dynamics, r);
    }
}

impl Matrix {
    /// Takes the slopes of the contacts at a state of the run.
    ///
    /// Of rings that lean contacts are held in the rings' frames, and their slopes taken for those in the scene's: that is wrong by
    /// a share as small as the tilt. Tilts are not corrected. What is stiff is friction on balls, which are light; a ring's tilt dies
    /// away slower, as balls weigh less than the ring, and within what a step bears anyway.
    fn renew(&mut self, dynamics: &Dynamics<'_>, t: f64, y: &[f64], gamma_h: f64) {
        dynamics.expand(t, y, &mut self.full);
        self.state.read(&self.full);
        let views = match &mut self.rings {
            Some(rings) => RingView::look(rings, dynamics.model(), &self.state),
            None => View::parallel(&self.state),
        };
        self.stage.find_elements(dynamics, &views);
        self.stage.secant = false;
        self.stage.forces(dynamics, &Velocities::Seen(&views), true);
        self.stage.factorise(dynamics.model(), gamma_h);
        self.served = 0;
    }

    /// Directions that the run leaves out are not corrected. A singular matrix corrects nothing.
    fn solve(&mut self, dynamics: &Dynamics<'_>, r: &mut [f64]) {
        let residual = &mut self.stage.residual;
        residual.fill([0.0; DOFS]);
        for (r, (body, dof)) in r.iter().zip(&self.degrees) {
            residual[body.index()][*dof] = *r;
        }
        dynamics.mirror(residual.as_flattened_mut());
        if self.stage.correct(dynamics.model()) {
            for (r, (body, dof)) in r.iter_mut().zip(&self.degrees) {
                *r = self.stage.residual[body.index()][*dof];
            }
        }
    }
}
