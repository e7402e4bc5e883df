//! Newton's method on the rings, every ball condensed to a nonlinear spring.

use nalgebra::{DMatrix, DVector, SMatrix, Vector2};

use super::ball::least;
use super::cage::Hold;
use super::problem::Problem;
use super::search::search;
use super::unknowns::{self, OF_RINGS, RingStiffness, Rings};
use super::{FINE, STALLED};
use crate::base::error::{Error, Result};
use crate::base::interrupt;
use crate::base::quantities;
use crate::contact::V2;
use crate::model::{BodyId, Race};

/// Newton iterations of the rings before giving up.
const RING_ITERATIONS: usize = 200;
/// Iterations without halving the residual after which a small one is accepted.
const STALL: usize = 8;
/// The same before giving up.
const GIVE_UP: usize = 40;
/// Stiffness of a ball, over that of a typical contact, below which no race holds it.
const SOFT: f64 = 1e-4;
/// Precision to which balls settle at least.
const ROUGH: f64 = 1e-2;

/// The rings at some place, every ball in its own equilibrium.
pub(super) struct RingState {
    /// Places of the balls.
    pub(super) balls: Vec<Vector2<f64>>,
    /// Forces on the rings along their free directions, and the stiffness against them.
    residual: DVector<f64>,
    /// Precision to which the balls have settled.
    precision: f64,
    stiffness: DMatrix<f64>,
    /// How each ball follows the rings, as far as it does so smoothly.
    follow: Vec<SMatrix<f64, 2, OF_RINGS>>,
    /// How the races hold each ball.
    pub(super) holds: Vec<Hold>,
    /// Stiffness of the bearing alone, both rings free.
    pub(super) bearing: RingStiffness,
}

impl RingState {
    /// Places of the balls after a step of the rings, to first order.
    fn followed(&self, step: &Rings) -> Vec<Vector2<f64>> {
        let places = self.balls.iter().zip(&self.follow);
        places
            .map(|(place, follow)| place + follow * step)
            .collect()
    }
}

impl Problem<'_> {
    /// Newton's method on the rings' places, to a residual over the sum of the acting forces; returns the number of
    /// iterations. Balls that are out of balance by some share of these forces settle much closer than that at once:
    /// what they left would look like a residual of the rings.
    pub(super) fn balance(
        &self,
        rings: &mut Rings,
        starts: &[Vector2<f64>],
        unbalanced: f64,
        tolerance: f64,
    ) -> Result<(RingState, usize)> {
        let fine = FINE * tolerance;
        let first = (FINE * unbalanced).clamp(fine, ROUGH);
        let mut state = self.rings(rings, starts, 0.0, first)?;
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
            if state.precision > fine && (error <= tolerance || stalled) {
                state = self.rings(rings, &state.balls, 0.0, fine)?;
                continue;
            }
            if error <= tolerance || stalled && error <= STALLED {
                return Ok((state, iteration));
            }
            if stalled && iteration > best.1 + GIVE_UP {
                break;
            }
            let step = self.newton_step(&state.stiffness, &state.residual, longest);
            let force = |state: &RingState| -> f64 {
                self.free
                    .iter()
                    .zip(&state.residual)
                    .map(|(&i, r)| r * step[i])
                    .sum()
            };
            // What a ball leaves is of second order, as is what the step leaves: fine where the next should be the last.
            let precision = if error * error <= tolerance {
                fine
            } else {
                error.clamp(fine, ROUGH)
            };
            let clipped = unknowns::length(&step) > 0.99 * longest;
            let found = search(force(&state), |t| {
                let moved = step * t;
                let starts = state.followed(&moved);
                let trial = self
                    .rings(
                        &(*rings + moved),
                        &starts,
                        unknowns::length(&moved),
                        precision,
                    )
                    .ok()?;
                Some((force(&trial), (t, trial)))
            });
            // To the search it looks like places that cannot be.
            interrupt::check()?;
            let Some((share, trial)) = found else {
                if state.precision > fine {
                    state = self.rings(rings, &state.balls, 0.0, fine)?;
                    continue;
                }
                // Rounding, or a jump, leaves no better place: large forces of a misfit cancel to no more than this.
                if error <= STALLED {
                    return Ok((state, iteration));
                }
                break;
            };
            longest = if clipped && share == 1.0 {
                2.0 * longest
            } else {
                shortest
            };
            *rings += step * share;
            state = trial;
        }
        Err(Error::Equilibrium {
            reason: format!(
                "the load cannot be carried: {} % of the load is not \
                 balanced; check loads, clearance, supports and contact angle, or use start = \"rolling\"",
                quantities::number(100.0 * self.error(&state.residual))
            ),
        })
    }

    /// Lets every ball settle to a precision, and condenses it to forces and stiffness on the rings, which have moved so
    /// far.
    pub(super) fn rings(
        &self,
        rings: &Rings,
        starts: &[Vector2<f64>],
        moved: f64,
        precision: f64,
    ) -> Result<RingState> {
        let mut forces = self.loads;
        let mut bearing = RingStiffness::zeros();
        let mut balls = Vec::with_capacity(starts.len());
        let mut follow = Vec::with_capacity(starts.len());
        let mut holds = vec![Hold::default(); starts.len()];
        for (j, &start) in starts.iter().enumerate() {
            let start = self.refreshed(j, rings, start, moved);
            let mut ball = self.settle(j, rings, start, precision)?;
            let contacts = self.contact_stiffness(j, rings, &mut ball);
            ball.press(&mut forces);
            for race in Race::BOTH {
                ball.stiffen(race, &contacts[race], &mut bearing);
            }
            let (pulled, pulling) = self.coupling(j, &ball, &contacts);
            let own = self.ball_stiffness(j, rings, &mut ball);
            // A loose ball carries nothing and has no stiffness to condense.
            let stiff = !self.is_held(j) && least(&own) > 1e-9 * self.stiffness();
            let mut followed = SMatrix::<f64, 2, OF_RINGS>::zeros();
            if let Some(inverse) = own.try_inverse().filter(|_| stiff) {
                followed = SMatrix::<f64, 2, OF_RINGS>::from_fn(|a, b| {
                    inverse[(a, 0)] * pulled[(0, b)] + inverse[(a, 1)] * pulled[(1, b)]
                });
                let radial = 1.0 / inverse[(0, 0)] - self.cage_spring[j].stiffness();
                if radial > SOFT * self.stiffness() {
                    holds[j] = Hold {
                        stiffness: radial,
                        slope: inverse[(1, 0)] / inverse[(0, 0)],
                    };
                }
                let last = self.last_step(&ball, &inverse);
                forces += pulling * last;
                ball.place += last;
            }
            unknowns::condense(&mut bearing, &pulling, &followed, self.spatial);
            balls.push(ball.place);
            follow.push(followed);
        }
        bearing = (bearing + bearing.transpose()) / 2.0;
        let mut held = bearing;
        for (a, ..) in unknowns::all() {
            forces[a] -= self.resistance(a, rings);
        }
        self.stiffen(&mut held);
        self.apply(rings, &mut forces, &mut held);
        let n = self.free.len();
        Ok(RingState {
            balls,
            residual: DVector::from_fn(n, |a, _| forces[self.free[a]]),
            precision,
            stiffness: DMatrix::from_fn(n, n, |a, b| held[(self.free[a], self.free[b])]),
            follow,
            holds,
            bearing,
        })
    }

    /// How far a ball is from a ring's axis, and where along it.
    fn before(&self, j: usize, rings: &Rings, race: Race, ball: &Vector2<f64>) -> [f64; 2] {
        if self.model.tilts() {
            let n = self.directions[j] * ball.x;
            let seen = self.seen(rings, race, &nalgebra::Vector3::new(n.x, n.y, ball.y));
            return [seen.xy().norm(), seen.z];
        }
        let ring = unknowns::of(rings, race);
        let distance = ball.x - V2::new(ring.x, ring.y).dot(&self.directions[j]);
        [distance, ball.y - ring.z]
    }

    /// A ball's place to start from: it is seeded anew when the rings have moved far.
    fn refreshed(&self, j: usize, rings: &Rings, start: Vector2<f64>, moved: f64) -> Vector2<f64> {
        let approach = self.model.scales.approach;
        if moved <= approach {
            return start;
        }
        let seed = self.seed(j, rings);
        if (seed - start).norm() > approach {
            seed
        } else {
            start
        }
    }

    /// Newton's step along the free directions, at most so long.
    pub(super) fn newton_step(
        &self,
        stiffness: &DMatrix<f64>,
        residual: &DVector<f64>,
        longest: f64,
    ) -> Rings {
        let n = self.free.len();
        let mut step = Rings::zeros();
        if n == 0 {
            return step;
        }
        // Positive definite by some margin: as it is. Else shifted until it is.
        let margin = 1e-6 * self.stiffness();
        let shifted = |by: f64| stiffness + DMatrix::identity(n, n) * by;
        let shift = if shifted(-margin).cholesky().is_some() {
            0.0
        } else {
            (margin - stiffness.symmetric_eigenvalues().min()).max(0.0)
        };
        let solved = shifted(shift)
            .lu()
            .solve(residual)
            .unwrap_or_else(|| DVector::zeros(n));
        let scale = (longest / solved.norm()).min(1.0);
        for (a, &i) in self.free.iter().enumerate() {
            step[i] = solved[a] * scale;
        }
        step
    }

    /// A step off a place where the rings balance without being stable, as on top of a single ball that carries all of a light load: along
    /// the direction that nothing holds, a quarter of the clearance and an approach. None of a stable place.
    pub(super) fn off_saddle(&self, state: &RingState) -> Option<Rings> {
        if self.free.is_empty() || state.stiffness.clone().cholesky().is_some() {
            return None;
        }
        let eigen = state.stiffness.clone().symmetric_eigen();
        let weakest = eigen.eigenvectors.column(eigen.eigenvalues.imin());
        let rows = self.model.scene.rows.iter();
        let clearance = rows.map(|row| row.clearance.abs()).fold(0.0, f64::max);
        let size = 0.25 * clearance + self.model.scales.approach;
        let mut step = Rings::zeros();
        for (a, &i) in self.free.iter().enumerate() {
            step[i] = weakest[a] * size;
        }
        Some(step)
    }

    /// Refuses what balances without being stable, and balls that left their groove.
    pub(super) fn check(&self, state: &RingState, rings: &Rings) -> Result<()> {
        let n = self.free.len();
        if n > 0 && state.stiffness.clone().cholesky().is_none() {
            let eigen = state.stiffness.clone().symmetric_eigen();
            let weakest = eigen.eigenvectors.column(eigen.eigenvalues.imin()).iamax();
            let (race, dof) = unknowns::degree(self.free[weakest]);
            return Err(Error::Equilibrium {
                reason: format!(
                    "nothing holds {}.{} (tangent stiffness not positive definite); add a load or a support",
                    race.name(),
                    dof.name()
                ),
            });
        }
        for (j, ball) in state.balls.iter().enumerate() {
            let compiled = &self.model.balls[j];
            for race in Race::BOTH {
                let pair = &self.model.rows[compiled.row].pairs[race];
                let [distance, z] = self.before(j, rings, race, ball);
                let left = pair.left(compiled.side.radius, distance, z);
                if let Some((point, [lowest, highest])) = left {
                    return Err(Error::Equilibrium {
                        reason: format!(
                            "{} leaves the groove of the {} race: its contact lies {} from the groove's \
                             middle, which ends at {} and {}; lower the load or widen the groove",
                            self.model.bodies[BodyId::ball(j)].name,
                            race.name(),
                            quantities::length(point),
                            quantities::length(lowest),
                            quantities::length(highest)
                        ),
                    });
                }
            }
        }
        Ok(())
    }
}
