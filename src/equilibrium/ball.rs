//! A ball between rings that stand still.

use nalgebra::{Matrix2, SVector, Vector2};

use super::TOLERANCE;
use super::problem::{Eight, Problem};
use super::search::search;
use crate::contact::V2;
use crate::error::{Error, Result};
use crate::model::Degree;

/// Newton iterations of a ball before giving up.
const BALL_ITERATIONS: usize = 100;
/// Residual of a ball, over its share of the load, that is accepted where a slice that enters a defect makes
/// the force jump.
const BALL_STALLED: f64 = 1e-2;

impl Problem<'_> {
    /// A ball on the line of the groove centres, sharing the approach or the gap; a loose ball where its own load presses
    /// it into the outer race, or into the inner one if it falls.
    pub(super) fn seed(&self, j: usize, rings: &SVector<f64, 6>) -> Vector2<f64> {
        let (centres, reach) = self.grooves(j, rings);
        let apart = centres[1] - centres[0];
        let length = apart.norm();
        let approach = (length - reach[0] - reach[1]) / 2.0;
        if approach > 0.0 || self.own_load(j).norm() == 0.0 {
            return centres[0] + apart * ((reach[0] + approach) / length);
        }
        self.seat(j, rings)
    }

    /// Where a loose ball's own load presses it: the normal of its only contact lies along the load.
    fn seat(&self, j: usize, rings: &SVector<f64, 6>) -> Vector2<f64> {
        let (centres, reach) = self.grooves(j, rings);
        let load = self.own_load(j);
        let race = usize::from(load.x < 0.0);
        let normal = load.try_normalize(0.0).unwrap_or_else(Vector2::x);
        centres[race] + normal * (reach[race] + 1e-3 * self.model.scales.approach)
    }

    /// Groove centres (radius, axial place) in the ball's meridional plane, and how far from them a ball that
    /// just touches has its centre.
    fn grooves(&self, j: usize, rings: &SVector<f64, 6>) -> ([Vector2<f64>; 2], [f64; 2]) {
        let ball = &self.model.balls[j];
        let pairs = &self.model.rows[ball.row].pairs;
        let centre = |race: usize| {
            let shift = V2::new(rings[3 * race], rings[3 * race + 1]).dot(&self.directions[j]);
            let torus = &pairs[race].race;
            Vector2::new(torus.a + shift, torus.centre + rings[3 * race + 2])
        };
        let reach = [0, 1].map(|race| pairs[race].race.r - ball.side.radius);
        ([centre(0), centre(1)], reach)
    }

    /// A ball between rings that stand still.
    pub(super) fn settle(
        &self,
        j: usize,
        rings: &SVector<f64, 6>,
        ball: &mut Vector2<f64>,
    ) -> Result<()> {
        let body = &self.model.bodies[2 + j];
        let holds = |i: usize| !matches!(body.degrees[i], Degree::Free { .. });
        if holds(0) || holds(1) || holds(2) {
            *ball = Vector2::new(body.nominal[0].hypot(body.nominal[1]), body.nominal[2]);
            return Ok(());
        }
        let scale = self.magnitude / self.model.balls.len() as f64;
        let mut left = 0.0;
        // Over a defect a ball may have lost one race, and lie far along the other.
        for start in [*ball, self.seat(j, rings)] {
            let (place, residual, contact) = self.relax(j, rings, start, scale);
            *ball = place;
            left = residual;
            if residual <= BALL_STALLED * scale.max(contact) {
                return Ok(());
            }
        }
        Err(Error::Equilibrium {
            reason: format!(
                "{} finds no place between the rings: {left:.3e} N are not balanced",
                body.name
            ),
        })
    }

    /// Newton's method from a place: where it ends, what is not balanced there, and the size of the contact forces.
    fn relax(
        &self,
        j: usize,
        rings: &SVector<f64, 6>,
        start: Vector2<f64>,
        scale: f64,
    ) -> (Vector2<f64>, f64, f64) {
        let mut ball = start;
        let with = |ball: &Vector2<f64>| {
            let mut u = Eight::zeros();
            u.fixed_rows_mut::<2>(0).copy_from(ball);
            u.fixed_rows_mut::<6>(2).copy_from(rings);
            u
        };
        let residual = |ball: &Vector2<f64>| {
            let forces = self.ball_forces(j, &with(ball));
            forces.fixed_rows::<2>(0).into_owned()
        };
        let tolerance = TOLERANCE * 1e-2 * scale;
        let longest = 0.02 * self.model.balls[j].side.radius;
        let mut r = residual(&ball);
        let mut best = (r.norm(), 0);
        for iteration in 0..BALL_ITERATIONS {
            if r.norm() < 0.5 * best.0 {
                best = (r.norm(), iteration);
            }
            if r.norm() <= tolerance || iteration > best.1 + 20 {
                break;
            }
            let jacobian = self.ball_jacobian(j, &with(&ball), 2);
            let stiffness = -jacobian.fixed_view::<2, 2>(0, 0).into_owned();
            // Where the ball is loose or would tip over, follow the force.
            let symmetric = (stiffness + stiffness.transpose()) / 2.0;
            let least = symmetric.symmetric_eigenvalues().min();
            let shift = (1e-6 * self.stiffness() - least).max(0.0);
            let shifted = symmetric + Matrix2::identity() * shift;
            let Some(mut step) = shifted.lu().solve(&r) else {
                break;
            };
            step *= (longest / step.norm()).min(1.0);
            let from = ball;
            (ball, r) = search(r.dot(&step), |t| {
                let trial = from + step * t;
                let residual = residual(&trial);
                Some((residual.dot(&step), (trial, residual)))
            })
            .unwrap_or((from, r));
        }
        (ball, r.norm(), self.contact_size(j, &with(&ball)))
    }

    /// Size of the contact forces at a ball.
    fn contact_size(&self, j: usize, u: &Eight) -> f64 {
        self.ball_forces(j, u).fixed_rows::<6>(2).norm()
    }
}
