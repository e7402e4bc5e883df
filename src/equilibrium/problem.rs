//! What acts: loads of rings and balls, and the forces of a ball's contacts.

use nalgebra::{DVector, SMatrix, SVector, Vector2};

use super::cage::CageSpring;
use crate::contact::{Motion, Sink, Touch, V2};
use crate::model::{Degree, Model};

/// The two displacements of a ball and the six of the rings: radius and place z of the ball, then
/// x, y, z of outer and inner ring; and the forces along them.
pub(super) type Eight = SVector<f64, 8>;

pub(super) struct Problem<'m> {
    pub(super) model: &'m Model,
    /// Constant forces on each ball along its radius and along z: weight and centrifugal force.
    pub(super) ball_loads: Vec<Vector2<f64>>,
    pub(super) directions: Vec<V2>,
    /// The cage's hold on each ball.
    pub(super) cage_spring: Vec<CageSpring>,
    /// Free directions of the rings, as indices into the six.
    pub(super) free: Vec<usize>,
    /// Constant forces on the rings.
    pub(super) loads: SVector<f64, 6>,
    /// Sum of the magnitudes of what acts.
    pub(super) magnitude: f64,
}

impl<'m> Problem<'m> {
    pub(super) fn new(model: &'m Model) -> Self {
        let gravity = model.scene.gravity;
        let mut ball_loads = Vec::new();
        let mut directions = Vec::new();
        let mut magnitude = 0.0;
        for (j, ball) in model.balls.iter().enumerate() {
            let body = &model.bodies[2 + j];
            let place = V2::new(body.nominal[0], body.nominal[1]);
            let direction = place.normalize();
            let orbit = model.rolling_speeds(ball.row).0;
            let centrifugal = body.mass[0] * orbit * orbit * place.norm();
            let weight = body.mass[0] * (gravity[0] * direction.x + gravity[1] * direction.y);
            ball_loads.push(Vector2::new(
                centrifugal + weight,
                body.mass[0] * gravity[2],
            ));
            directions.push(direction);
            magnitude += centrifugal.abs() + weight.abs();
        }
        let mut loads = SVector::<f64, 6>::zeros();
        for load in &model.loads {
            for i in 0..3 {
                loads[3 * load.ring + i] += load.force.at(0.0) * load.direction[i];
            }
        }
        for ring in 0..2 {
            for i in 0..3 {
                loads[3 * ring + i] += model.bodies[ring].mass[i] * gravity[i];
            }
        }
        for unbalance in &model.unbalances {
            let speed = if unbalance.ring == 1 {
                model.scene.drive.initial_speed()
            } else {
                0.0
            };
            let force = unbalance.moment * speed * speed;
            loads[3 * unbalance.ring] += force * unbalance.angle.cos();
            loads[3 * unbalance.ring + 1] += force * unbalance.angle.sin();
        }
        let free = (0..6)
            .filter(|&i| matches!(model.bodies[i / 3].degrees[i % 3], Degree::Free { .. }))
            .collect();
        magnitude += loads.iter().map(|x| x.abs()).sum::<f64>();
        // Without any load, the contact scale keeps the tolerance from being zero.
        magnitude = magnitude.max(1e-6 * model.scales.load).max(1e-12);
        Self {
            model,
            ball_loads,
            cage_spring: vec![CageSpring::default(); directions.len()],
            directions,
            free,
            loads,
            magnitude,
        }
    }

    /// A typical contact stiffness.
    pub(super) fn stiffness(&self) -> f64 {
        self.model.scales.load / self.model.scales.approach
    }

    pub(super) fn error(&self, residual: &DVector<f64>) -> f64 {
        residual.iter().map(|x| x.abs()).fold(0.0, f64::max) / self.magnitude
    }

    /// Weight and centrifugal force of a ball along its radius and along z.
    pub(super) fn own_load(&self, j: usize) -> Vector2<f64> {
        self.ball_loads[j]
    }

    /// Forces on a ball (radial, axial) and on the rings from its contacts and its own load and support.
    pub(super) fn ball_forces(&self, j: usize, u: &Eight) -> Eight {
        let ball = &self.model.balls[j];
        let body = &self.model.bodies[2 + j];
        let direction = self.directions[j];
        let at = |centre: V2, z: f64| Motion {
            centre,
            z,
            theta: 0.0,
            velocity: V2::zeros(),
            vz: 0.0,
            omega: 0.0,
        };
        let place = at(direction * u[0], u[1]);
        let mut forces = Eight::zeros();
        for (race, pair) in self.model.rows[ball.row].pairs.iter().enumerate() {
            let k = 2 + 3 * race;
            let mut sum = Static::default();
            pair.evaluate(
                &ball.side,
                &place,
                &at(V2::new(u[k], u[k + 1]), u[k + 2]),
                &mut sum,
            );
            forces[0] += sum.plane.dot(&direction);
            forces[1] += sum.axial;
            forces[k] -= sum.plane.x;
            forces[k + 1] -= sum.plane.y;
            forces[k + 2] -= sum.axial;
        }
        let place = [place.centre.x, place.centre.y, place.z];
        for i in 0..3 {
            if let Degree::Free { stiffness, .. } = body.degrees[i] {
                let pull = -stiffness * (place[i] - body.nominal[i]);
                if i < 2 {
                    forces[0] += pull * direction[i];
                } else {
                    forces[1] += pull;
                }
            }
        }
        forces[0] += self.own_load(j).x + self.cage_spring[j].pull(u[0]);
        forces[1] += self.ball_loads[j].y;
        forces
    }

    /// Derivative of [`Self::ball_forces`] by central differences in the chosen columns.
    pub(super) fn ball_jacobian(&self, j: usize, u: &Eight, columns: usize) -> SMatrix<f64, 8, 8> {
        // A thousandth of the approach: truncation 1e-6, noise 1e-9 of the stiffness.
        let step = 1e-3 * self.model.scales.approach;
        let mut jacobian = SMatrix::<f64, 8, 8>::zeros();
        for i in 0..columns {
            let (mut up, mut down) = (*u, *u);
            up[i] += step;
            down[i] -= step;
            let slope = (self.ball_forces(j, &up) - self.ball_forces(j, &down)) / (2.0 * step);
            jacobian.set_column(i, &slope);
        }
        jacobian
    }

    pub(super) fn state(&self, rings: &SVector<f64, 6>, balls: &[Vector2<f64>]) -> Vec<f64> {
        let mut y = vec![0.0; self.model.dim()];
        for i in 0..6 {
            y[4 * (i / 3) + i % 3] = rings[i];
        }
        for (j, ball) in balls.iter().enumerate() {
            let place = self.directions[j] * ball.x;
            y[4 * (2 + j)..4 * (2 + j) + 3].copy_from_slice(&[place.x, place.y, ball.y]);
        }
        y
    }
}

/// Adds up the elastic forces on the ball.
struct Static {
    plane: V2,
    axial: f64,
}

impl Default for Static {
    fn default() -> Self {
        Self {
            plane: V2::zeros(),
            axial: 0.0,
        }
    }
}

impl Sink for Static {
    fn touch(&mut self, touch: &Touch) {
        self.plane -= touch.n_e * (touch.elastic * touch.share.0);
        self.axial -= touch.elastic * touch.share.1;
    }
}
