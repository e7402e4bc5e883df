//! Velocities corrected by friction's matrix, once a step: what [`Adams`](crate::integrate::Adams) asks for.

use super::stage::{Stage, Velocity};
use crate::contact::{AXIAL, FREE};
use crate::dynamics::{Dynamics, RingView, View};
use crate::forces::State;
use crate::integrate::{LinearlyImplicit, System};
use crate::model::{DOFS, RowModel};

/// Steps that a matrix serves at most. On 64 scenes (two presets, random bearings) 8, 32, 128 and 512 gave errors alike and
/// step counts within half a percent; a new one costs about six evaluations (a profile of the wheel bearing).
const SERVES: usize = 128;

/// A right-hand side with the matrix of its contacts' friction and damping, made now and then.
#[derive(Debug)]
pub(crate) struct Damped<'d, 'm> {
    pub dynamics: &'d mut Dynamics<'m>,
    /// None where no force of a contact depends on velocities.
    matrix: Option<Box<dyn Corrects>>,
}

/// Friction's matrix, of balls of any number of directions.
trait Corrects: std::fmt::Debug {
    /// As [`LinearlyImplicit::damp`].
    fn damp(&mut self, dynamics: &Dynamics<'_>, t: f64, y: &[f64], gamma_h: f64, r: &mut [f64]);
}

/// A matrix of all bodies, also where the run leaves some out.
#[derive(Debug)]
struct Matrix<const N: usize> {
    stage: Stage<N>,
    /// The velocities of the run that are corrected.
    corrected: Vec<Velocity>,
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
            if dynamics.leans() {
                Matrix::<FREE>::boxed(dynamics)
            } else {
                Matrix::<AXIAL>::boxed(dynamics)
            }
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
        matrix.damp(self.dynamics, t, y, gamma_h, r);
    }
}

impl<const N: usize> Corrects for Matrix<N> {
    fn damp(&mut self, dynamics: &Dynamics<'_>, t: f64, y: &[f64], gamma_h: f64, r: &mut [f64]) {
        if self.served >= SERVES || !self.stage.is_like(gamma_h) {
            self.renew(dynamics, t, y, gamma_h);
        }
        self.served += 1;
        self.solve(dynamics, r);
    }
}

impl<const N: usize> Matrix<N> {
    fn boxed(dynamics: &Dynamics<'_>) -> Box<dyn Corrects> {
        let (model, state) = (dynamics.model(), dynamics.state().clone());
        let mut full = vec![0.0; model.dim()];
        state.write(&mut full);
        let degrees = dynamics.degrees().into_iter().enumerate();
        Box::new(Self {
            stage: Stage::new(model, dynamics.rows_in_motion()),
            corrected: degrees.filter_map(Velocity::of).collect(),
            full,
            state,
            rings: RingView::both(model).filter(|_| dynamics.leans()),
            served: 0,
        })
    }

    /// Takes the slopes of the contacts at a state of the run.
    fn renew(&mut self, dynamics: &Dynamics<'_>, t: f64, y: &[f64], gamma_h: f64) {
        dynamics.expand(t, y, &mut self.full);
        self.state.read(&self.full);
        let views = match &mut self.rings {
            Some(rings) => RingView::look(rings, dynamics.model(), &self.state),
            None => View::parallel(&self.state),
        };
        self.stage.find_elements(dynamics, &views);
        self.stage.secant = false;
        self.stage.forces(dynamics, &views, true);
        self.stage.factorise(dynamics.model(), &views, gamma_h);
        self.served = 0;
    }

    /// Directions that the run leaves out are not corrected. A singular matrix corrects nothing.
    fn solve(&mut self, dynamics: &Dynamics<'_>, r: &mut [f64]) {
        let residual = &mut self.stage.residual;
        residual.fill([0.0; N]);
        for Velocity { at, body, place } in &self.corrected {
            residual[body.index()][*place] = r[*at];
        }
        if N == DOFS {
            dynamics.mirror(residual.as_flattened_mut());
        }
        if self.stage.correct(dynamics.model()) {
            for Velocity { at, body, place } in &self.corrected {
                r[*at] = self.stage.residual[body.index()][*place];
            }
        }
    }
}

/// The truth is the right-hand side itself.
#[cfg(test)]
mod tests {
    use super::*;
    use crate::implicit::tests::{compiled, oiled_wheel, rolling, scenes, state};
    use crate::scene::Spin;

    /// (1 − γh ∂a/∂v) x = r holds for the correction x of any r, with ∂a/∂v by central differences, where balls spin freely.
    #[test]
    fn free_balls_are_corrected_by_the_derivative() {
        for mut scene in scenes().into_iter().chain([oiled_wheel(), rolling()]) {
            scene.spin = Some(Spin::Free);
            let model = compiled(&scene);
            let y = state(&model);
            let half = y.len() / 2;
            let mut dynamics = Dynamics::new(&model);
            let gamma_h = 1e-6;
            let r: Vec<f64> = (0..half).map(|i| (1.0 + i as f64).sin()).collect();
            let mut x = r.clone();
            Damped::new(&mut dynamics).damp(0.0, &y, gamma_h, &mut x);
            let size = x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let mut at = |step: f64| {
                let mut moved = y.clone();
                for (v, x) in moved[half..].iter_mut().zip(&x) {
                    *v += step * x / size;
                }
                let mut rates = vec![0.0; y.len()];
                dynamics.rhs(0.0, &moved, &mut rates);
                rates.split_off(half)
            };
            let step = 1e-5;
            for (i, (up, down)) in at(step).into_iter().zip(at(-step)).enumerate() {
                let slope = (up - down) / (2.0 * step) * size;
                let off = x[i] - gamma_h * slope - r[i];
                let (body, dof) = model.layout().degree(i);
                assert!(
                    off.abs() < 1e-5 * size,
                    "{} {body:?} {dof:?}: {off:e} of {size}",
                    scene.name
                );
            }
        }
    }
}
