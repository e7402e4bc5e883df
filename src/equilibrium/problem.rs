//! What acts: loads of rings and balls, and the forces of a ball's contacts.

use nalgebra::{DVector, Matrix2, Matrix3, SMatrix, SVector, Vector2, Vector3};

use super::cage::CageSpring;
use super::guess::RowSpring;
use crate::contact::{Tangent, V2};
use crate::model::{Degree, Model};

pub(super) struct Problem<'m> {
    pub(super) model: &'m Model,
    /// m ω_c² of each ball: its centrifugal force over its radius \[N/m\].
    centrifugal: Vec<f64>,
    pub(super) directions: Vec<V2>,
    /// The cage's hold on each ball.
    pub(super) cage_spring: Vec<CageSpring>,
    /// Stiffness of each ball's hold over what a row's cage has against all balls moving out together; at least what
    /// it has against one of them.
    pub(super) cage_share: f64,
    /// Free directions of the rings, as indices into the six.
    pub(super) free: Vec<usize>,
    /// Constant forces on the rings.
    pub(super) loads: SVector<f64, 6>,
    /// Sum of the magnitudes of what acts.
    pub(super) magnitude: f64,
    /// How far the contacts of each row's balls give.
    pub(super) springs: Vec<RowSpring>,
    /// Axial places that outer ring, inner ring and the rows keep, where they do.
    pub(super) levels: Option<Vec<f64>>,
}

impl<'m> Problem<'m> {
    pub(super) fn new(model: &'m Model) -> Self {
        let gravity = model.scene.gravity;
        let mut centrifugal = Vec::new();
        let mut directions = Vec::new();
        let mut magnitude = 0.0;
        for (j, ball) in model.balls.iter().enumerate() {
            let body = &model.bodies[2 + j];
            let place = V2::new(body.nominal[0], body.nominal[1]);
            let direction = place.normalize();
            let orbit = model.rolling_speeds(ball.row).0;
            let weight = body.mass[0] * (gravity[0] * direction.x + gravity[1] * direction.y);
            centrifugal.push(body.mass[0] * orbit * orbit);
            directions.push(direction);
            magnitude += centrifugal[j] * place.norm() + weight.abs();
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
            centrifugal,
            cage_spring: vec![CageSpring::default(); directions.len()],
            cage_share: 0.0,
            directions,
            free,
            loads,
            magnitude,
            springs: model
                .rows
                .iter()
                .map(|row| RowSpring::of(model, row))
                .collect(),
            levels: None,
        }
    }

    /// The same where rings and rows keep their axial places: the outer ring's, the inner one's, the rows'.
    pub(super) fn in_planes(model: &'m Model, levels: Vec<f64>) -> Self {
        let mut problem = Self::new(model);
        problem.free.retain(|i| i % 3 != 2);
        problem.levels = Some(levels);
        problem
    }

    /// The axial place that a ball keeps, if it does.
    fn level(&self, j: usize) -> Option<f64> {
        let row = self.model.balls[j].row;
        self.levels.as_ref().map(|levels| levels[2 + row])
    }

    /// A typical contact stiffness.
    pub(super) fn stiffness(&self) -> f64 {
        self.model.scales.load / self.model.scales.approach
    }

    pub(super) fn error(&self, residual: &DVector<f64>) -> f64 {
        residual.iter().map(|x| x.abs()).fold(0.0, f64::max) / self.magnitude
    }

    /// Weight and centrifugal force of a ball along its radius and along z, near its nominal place.
    pub(super) fn own_load(&self, j: usize) -> Vector2<f64> {
        let [x, y, ..] = self.model.bodies[2 + j].nominal;
        self.own_load_at(j, x.hypot(y))
    }

    /// The same at a radius, at the angle where the cage holds it.
    pub(super) fn own_load_at(&self, j: usize, radius: f64) -> Vector2<f64> {
        let mass = self.model.bodies[2 + j].mass[0];
        let (g, direction) = (self.model.scene.gravity, self.directions[j]);
        let weight = mass * (g[0] * direction.x + g[1] * direction.y);
        Vector2::new(self.centrifugal[j] * radius + weight, mass * g[2])
    }

    /// A ball at a radius and an axial place between the rings: what acts on it there.
    pub(super) fn ball_at(
        &self,
        j: usize,
        rings: &SVector<f64, 6>,
        place: Vector2<f64>,
    ) -> BallState {
        let ball = &self.model.balls[j];
        let direction = self.directions[j];
        let level = self.level(j);
        let place = Vector2::new(place.x, level.unwrap_or(place.y));
        let centre = Vector3::new(direction.x * place.x, direction.y * place.x, place.y);
        let from_rings = [0, 3].map(|k| centre - rings.fixed_rows::<3>(k));
        let contacts = [0, 1].map(|race| {
            self.model.rows[ball.row].pairs[race].tangent(
                self.model.level,
                &ball.side,
                &from_rings[race],
            )
        });
        let pressed = contacts[0].force + contacts[1].force;
        let own = self.own_load_at(j, place.x);
        let mut force = Vector2::new(
            pressed.xy().dot(&direction) + own.x + self.cage_spring[j].pull(place.x),
            pressed.z + own.y,
        );
        let body = &self.model.bodies[2 + j];
        for i in 0..3 {
            let pull = body.degrees[i].stiffness() * (body.nominal[i] - centre[i]);
            if i < 2 {
                force.x += pull * direction[i];
            } else {
                force.y += pull;
            }
        }
        if level.is_some() {
            // What keeps the ball in its plane.
            force.y = 0.0;
        }
        BallState {
            place,
            force,
            from_rings,
            contacts,
        }
    }

    /// Stiffness of each of a ball's contacts; differences are taken once.
    pub(super) fn contact_stiffness(&self, j: usize, state: &mut BallState) -> [Matrix3<f64>; 2] {
        let ball = &self.model.balls[j];
        // A thousandth of the approach: truncation 1e-6, noise 1e-9 of the stiffness.
        let step = 1e-3 * self.model.scales.approach;
        [0, 1].map(|race| {
            *state.contacts[race].stiffness.get_or_insert_with(|| {
                let pair = &self.model.rows[ball.row].pairs[race];
                pair.stiffness_by_differences(&ball.side, &state.from_rings[race], step)
            })
        })
    }

    /// Stiffness of a ball along its radius and z between rings that stand still.
    pub(super) fn ball_stiffness(&self, j: usize, state: &mut BallState) -> Matrix2<f64> {
        let [outer, inner] = self.contact_stiffness(j, state);
        let k = outer + inner;
        let (x, y) = (self.directions[j].x, self.directions[j].y);
        let mut radial = x * x * k[(0, 0)] + y * y * k[(1, 1)] + x * y * (k[(0, 1)] + k[(1, 0)]);
        let mut axial = k[(2, 2)];
        let degrees = &self.model.bodies[2 + j].degrees;
        for (degree, share) in degrees.iter().zip([x * x, y * y]) {
            radial += degree.stiffness() * share;
        }
        axial += degrees[2].stiffness();
        // The centrifugal force grows with the radius.
        radial += self.cage_spring[j].stiffness() - self.centrifugal[j];
        if self.level(j).is_some() {
            return Matrix2::from_diagonal(&Vector2::new(radial, self.stiffness()));
        }
        Matrix2::new(
            radial,
            x * k[(0, 2)] + y * k[(1, 2)],
            x * k[(2, 0)] + y * k[(2, 1)],
            axial,
        )
    }

    /// Stiffness of a ball (radius, z) against the six places of the rings, and of these against the ball.
    pub(super) fn coupling(
        &self,
        j: usize,
        contacts: &[Matrix3<f64>; 2],
    ) -> (SMatrix<f64, 2, 6>, SMatrix<f64, 6, 2>) {
        let (x, y) = (self.directions[j].x, self.directions[j].y);
        let mut pulled = SMatrix::<f64, 2, 6>::zeros();
        let mut pulling = SMatrix::<f64, 6, 2>::zeros();
        for (race, k) in contacts.iter().enumerate() {
            for i in 0..3 {
                let a = 3 * race + i;
                (pulled[(0, a)], pulled[(1, a)]) = (x * k[(0, i)] + y * k[(1, i)], k[(2, i)]);
                (pulling[(a, 0)], pulling[(a, 1)]) = (x * k[(i, 0)] + y * k[(i, 1)], k[(i, 2)]);
            }
        }
        if self.level(j).is_some() {
            pulled.row_mut(1).fill(0.0);
            pulling.column_mut(1).fill(0.0);
        }
        (pulled, pulling)
    }

    /// Whether a support holds a ball at its nominal place.
    pub(super) fn is_held(&self, j: usize) -> bool {
        let degrees = &self.model.bodies[2 + j].degrees[..3];
        degrees.iter().any(|d| !matches!(d, Degree::Free { .. }))
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

/// A ball at a place between the rings.
#[derive(Debug, Clone)]
pub(super) struct BallState {
    /// Its radius and axial place.
    pub(super) place: Vector2<f64>,
    /// Force on it along these.
    pub(super) force: Vector2<f64>,
    /// Its place from the centres of outer and inner ring.
    from_rings: [Vector3<f64>; 2],
    /// What the races do to it.
    pub(super) contacts: [Tangent; 2],
}

impl BallState {
    /// Size of the contact forces.
    pub(super) fn pressed(&self) -> f64 {
        let [outer, inner] = &self.contacts;
        outer.force.norm().hypot(inner.force.norm())
    }
}
