//! A ball between rings that stand still.

use nalgebra::{Matrix2, SVector, Vector2};

use super::TOLERANCE;
use super::problem::{Eight, Problem};
use crate::contact::V2;
use crate::error::{Error, Result};
use crate::model::Degree;

/// Newton iterations of a ball before giving up.
const BALL_ITERATIONS: usize = 100;
/// The same for one ball, whose load is smaller.
const BALL_STALLED: f64 = 1e-2;

impl Problem<'_> {
    /// A ball on the line of the groove centres, sharing the approach; a loose ball on the outer race.
    pub(super) fn seed(&self, j: usize, rings: &SVector<f64, 6>) -> Vector2<f64> {
        let ball = &self.model.balls[j];
        let pairs = &self.model.rows[ball.row].pairs;
        let centre = |race: usize| {
            let shift = V2::new(rings[3 * race], rings[3 * race + 1]).dot(&self.directions[j]);
            let torus = &pairs[race].race;
            Vector2::new(torus.a + shift, torus.centre + rings[3 * race + 2])
        };
        let (outer, inner) = (centre(0), centre(1));
        let apart = inner - outer;
        let length = apart.norm();
        let reach = [0, 1].map(|race| pairs[race].race.r - ball.side.radius);
        let approach = ((length - reach[0] - reach[1]) / 2.0).max(0.0);
        let line = if length > 0.0 {
            apart / length
        } else {
            Vector2::x()
        };
        outer + line * (reach[0] + approach)
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
        let with = |ball: &Vector2<f64>| {
            let mut u = Eight::zeros();
            u.fixed_rows_mut::<2>(0).copy_from(ball);
            u.fixed_rows_mut::<6>(2).copy_from(rings);
            u
        };
        let residual = |ball: &Vector2<f64>| {
            self.ball_forces(j, &with(ball))
                .fixed_rows::<2>(0)
                .into_owned()
        };
        let scale = self.magnitude / self.model.balls.len() as f64;
        let tolerance = TOLERANCE * 1e-2 * scale;
        let longest = 0.02 * self.model.balls[j].side.radius;
        let mut r = residual(ball);
        let mut damping = 0.0;
        let mut stalled = 0;
        for _ in 0..BALL_ITERATIONS {
            if r.norm() <= tolerance || stalled > 12 {
                break;
            }
            let jacobian = self.ball_jacobian(j, &with(ball), 2);
            let stiffness = -jacobian.fixed_view::<2, 2>(0, 0).into_owned();
            // Where the ball is loose or would tip over, follow the force.
            let least = (stiffness + stiffness.transpose())
                .symmetric_eigenvalues()
                .min()
                / 2.0;
            let shift = damping + (1e-6 * self.stiffness() - least).max(0.0);
            let shifted = stiffness + Matrix2::identity() * shift;
            let Some(mut step) = shifted.lu().solve(&r) else {
                break;
            };
            if step.norm() > longest {
                step *= longest / step.norm();
            }
            let trial = *ball + step;
            let trial_r = residual(&trial);
            if trial_r.norm() < r.norm() {
                (*ball, r) = (trial, trial_r);
                damping *= 0.1;
                stalled = 0;
            } else {
                damping = (damping * 10.0).max(1e-4 * self.stiffness());
                stalled += 1;
            }
        }
        if r.norm() > BALL_STALLED * scale.max(self.contact_size(j, &with(ball))) {
            return Err(Error::Equilibrium {
                reason: format!(
                    "{} finds no place between the rings: {:.3e} N are not balanced",
                    body.name,
                    r.norm()
                ),
            });
        }
        Ok(())
    }

    /// Size of the contact forces at a ball.
    fn contact_size(&self, j: usize, u: &Eight) -> f64 {
        self.ball_forces(j, u).fixed_rows::<6>(2).norm()
    }
}
