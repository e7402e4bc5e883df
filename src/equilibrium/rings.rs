//! Newton's method on the rings, every ball condensed to a nonlinear spring.

use nalgebra::{DMatrix, DVector, Matrix2, SMatrix, SVector, Vector2};

use super::problem::{Eight, Problem};
use super::search::search;
use super::{STALLED, TOLERANCE};
use crate::contact::V2;
use crate::error::{Error, Result};
use crate::model::Degree;

/// Newton iterations of the rings before giving up.
const RING_ITERATIONS: usize = 200;
/// Iterations without halving the residual after which a small one is accepted.
const STALL: usize = 8;
/// The same before giving up.
const GIVE_UP: usize = 40;

/// The rings at some place, every ball in its own equilibrium.
struct RingState {
    residual: DVector<f64>,
    stiffness: DMatrix<f64>,
}

impl Problem<'_> {
    /// Newton's method on the rings' places; returns the number of iterations.
    pub(super) fn balance(
        &self,
        rings: &mut SVector<f64, 6>,
        balls: &mut Vec<Vector2<f64>>,
    ) -> Result<usize> {
        let mut state = self.rings(rings, balls)?;
        let mut best = (f64::INFINITY, 0);
        // As far as the balls can follow; further where nothing touches.
        let shortest = 0.02 * self.model.balls[0].side.radius;
        let mut longest = shortest;
        for iteration in 0..RING_ITERATIONS {
            let error = self.error(&state.residual);
            if error < 0.5 * best.0 {
                best = (error, iteration);
            }
            let stalled = iteration > best.1 + STALL;
            if error <= TOLERANCE || stalled && error <= STALLED {
                return self.check(&state, balls, rings).map(|()| iteration);
            }
            if stalled && iteration > best.1 + GIVE_UP {
                break;
            }
            let step = self.newton_step(&state, longest);
            let force = |state: &RingState| -> f64 {
                self.free
                    .iter()
                    .zip(&state.residual)
                    .map(|(&i, r)| r * step[i])
                    .sum()
            };
            let clipped = step.norm() > 0.99 * longest;
            let Some((moved, (trial_rings, trial_balls, trial))) = search(force(&state), |t| {
                let trial_rings = *rings + step * t;
                let mut trial_balls = balls.clone();
                let trial = self.rings(&trial_rings, &mut trial_balls).ok()?;
                Some((force(&trial), (t, (trial_rings, trial_balls, trial))))
            }) else {
                // Rounding, or a jump, leaves no better place: large forces of a misfit cancel to no more than this.
                if error <= STALLED {
                    return self.check(&state, balls, rings).map(|()| iteration);
                }
                break;
            };
            longest = if clipped && moved == 1.0 {
                2.0 * longest
            } else {
                shortest
            };
            (*rings, *balls, state) = (trial_rings, trial_balls, trial);
        }
        Err(Error::Equilibrium {
            reason: format!(
                "the load cannot be carried: {:.3e} of the load is not \
                 balanced; check loads, clearance, supports and contact angle, or start rolling",
                self.error(&state.residual)
            ),
        })
    }

    /// Lets every ball settle, and condenses it to forces and stiffness on the rings.
    fn rings(&self, rings: &SVector<f64, 6>, balls: &mut [Vector2<f64>]) -> Result<RingState> {
        let mut forces = self.loads;
        let mut stiffness = SMatrix::<f64, 6, 6>::zeros();
        for (j, ball) in balls.iter_mut().enumerate() {
            // A ball is seeded anew when the rings have moved far.
            let seed = self.seed(j, rings);
            if (seed - *ball).norm() > self.model.scales.approach {
                *ball = seed;
            }
            self.settle(j, rings, ball)?;
            let mut u = Eight::zeros();
            u.fixed_rows_mut::<2>(0).copy_from(ball);
            u.fixed_rows_mut::<6>(2).copy_from(rings);
            forces += self.ball_forces(j, &u).fixed_rows::<6>(2);
            let jacobian = self.ball_jacobian(j, &u, 8);
            let k = |row: usize, column: usize| -jacobian[(row, column)];
            let own = Matrix2::new(k(0, 0), k(0, 1), k(1, 0), k(1, 1));
            let to_rings = SMatrix::<f64, 6, 2>::from_fn(|a, b| k(2 + a, b));
            let from_rings = SMatrix::<f64, 2, 6>::from_fn(|a, b| k(a, 2 + b));
            stiffness += SMatrix::<f64, 6, 6>::from_fn(|a, b| k(2 + a, 2 + b));
            // A loose ball carries nothing and has no stiffness to condense.
            if let Some(inverse) = own.try_inverse().filter(|_| self.is_stiff(&own)) {
                stiffness -= to_rings * inverse * from_rings;
            }
        }
        for (b, body) in self.model.bodies[..2].iter().enumerate() {
            for i in 0..3 {
                if let Degree::Free { stiffness: k, .. } = body.degrees[i] {
                    forces[3 * b + i] -= k * rings[3 * b + i];
                    stiffness[(3 * b + i, 3 * b + i)] += k;
                }
            }
        }
        let n = self.free.len();
        Ok(RingState {
            residual: DVector::from_fn(n, |a, _| forces[self.free[a]]),
            stiffness: DMatrix::from_fn(n, n, |a, b| {
                let (a, b) = (self.free[a], self.free[b]);
                f64::midpoint(stiffness[(a, b)], stiffness[(b, a)])
            }),
        })
    }

    fn is_stiff(&self, own: &Matrix2<f64>) -> bool {
        (own + own.transpose()).symmetric_eigenvalues().min() / 2.0 > 1e-9 * self.stiffness()
    }

    fn newton_step(&self, state: &RingState, longest: f64) -> SVector<f64, 6> {
        let n = self.free.len();
        let mut step = SVector::<f64, 6>::zeros();
        if n == 0 {
            return step;
        }
        let least = state.stiffness.clone().symmetric_eigenvalues().min();
        let shift = (1e-6 * self.stiffness() - least).max(0.0);
        let shifted = &state.stiffness + DMatrix::identity(n, n) * shift;
        let solved = shifted
            .lu()
            .solve(&state.residual)
            .unwrap_or_else(|| DVector::zeros(n));
        let scale = (longest / solved.norm()).min(1.0);
        for (a, &i) in self.free.iter().enumerate() {
            step[i] = solved[a] * scale;
        }
        step
    }

    /// Refuses what balances without being stable, and balls that left their groove.
    fn check(
        &self,
        state: &RingState,
        balls: &[Vector2<f64>],
        rings: &SVector<f64, 6>,
    ) -> Result<()> {
        let n = self.free.len();
        if n > 0 && state.stiffness.clone().cholesky().is_none() {
            let eigen = state.stiffness.clone().symmetric_eigen();
            let weakest = eigen.eigenvectors.column(eigen.eigenvalues.imin()).iamax();
            let i = self.free[weakest];
            return Err(Error::Equilibrium {
                reason: format!(
                    "nothing holds {}.{} (tangent stiffness not positive definite); add a load or a support",
                    self.model.bodies[i / 3].name,
                    ["x", "y", "z"][i % 3]
                ),
            });
        }
        for (j, ball) in balls.iter().enumerate() {
            let compiled = &self.model.balls[j];
            for (race, pair) in self.model.rows[compiled.row].pairs.iter().enumerate() {
                let ring = SVector::<f64, 3>::new(
                    rings[3 * race],
                    rings[3 * race + 1],
                    rings[3 * race + 2],
                );
                let offset = ball.y - ring.z - pair.race.centre;
                let distance = ball.x - V2::new(ring.x, ring.y).dot(&self.directions[j]);
                let meridian = pair.race.meridian(distance, ball.y - ring.z, 0.0);
                // The contact point lies where the line of centres meets the groove.
                let point = offset / meridian.distance() * pair.race.r;
                let pressed = meridian.approach(compiled.side.radius) > 0.0;
                // Behind the groove's centre a ball is loose, as long as it is in the groove at all.
                let left = if meridian.e > 0.0 {
                    pressed && (point < pair.race.lowest || point > pair.race.highest)
                } else {
                    offset.abs() >= pair.race.r
                };
                if left {
                    return Err(Error::Equilibrium {
                        reason: format!(
                            "{} leaves the groove of the {} race: its contact lies {point:.3e} m from the groove's \
                             middle, which ends at {:.3e} and {:.3e}; lower the load or widen the groove",
                            self.model.bodies[2 + j].name,
                            ["outer", "inner"][race],
                            pair.race.lowest,
                            pair.race.highest
                        ),
                    });
                }
            }
        }
        Ok(())
    }
}
