//! A ball between rings that stand still.

use nalgebra::{Matrix2, Vector2};

use super::problem::{BallState, Problem};
use super::search::search;
use super::springs::RowSpring;
use super::unknowns::{self, Rings};
use super::{FINE, TOLERANCE};
use crate::base::error::{Error, Result};
use crate::base::interrupt;
use crate::base::quantities;
use crate::contact::Pair;
use crate::model::{BodyId, Dof, Race};

/// Newton iterations of a ball before giving up.
const BALL_ITERATIONS: usize = 100;
/// Step of Newton's method, over the approach, after which the force is not evaluated again.
const LAST: f64 = 1e-2;
/// Residual of a ball, over the forces that press it, above which it has not settled, however small it is against the load.
const ROUGH: f64 = 0.1;
/// The highest precision that is asked for.
const FINEST: f64 = FINE * TOLERANCE;
/// Residual of a ball, over its share of the load, that is accepted where a slice that enters a defect makes
/// the force jump.
const BALL_STALLED: f64 = 1e-2;

impl Problem<'_> {
    /// A ball on the line of the groove centres, where both races press it alike, or in the gap; a loose ball where its
    /// own load presses it, as far as the other race lets it.
    pub(super) fn seed(&self, j: usize, rings: &Rings) -> Vector2<f64> {
        match self.loose(j, rings) {
            Some(ends) if self.own_load(j).norm() > 0.0 => {
                let seat = self.seat(j, rings);
                let race = self.towards(j);
                let (centres, reach) = self.grooves(j, rings);
                let other = race.other();
                let is_free = (seat - centres[other]).norm() <= reach[other];
                if is_free { seat } else { ends[race] }
            }
            _ => {
                let line = self.line(j, rings);
                let share = self.spring(j).outer_share();
                line.from + line.unit * (line.reach + share * line.approach)
            }
        }
    }

    /// Seat into which a loose ball's own load presses it: the normal of its only contact lies along the load.
    fn seat(&self, j: usize, rings: &Rings) -> Vector2<f64> {
        let (centres, reach) = self.grooves(j, rings);
        let load = self.own_load(j);
        let race = self.towards(j);
        let normal = load.try_normalize(0.0).unwrap_or_else(Vector2::x);
        let depth = self.spring(j).approach(race, load.norm());
        let depth = depth.max(1e-3 * self.model.scales.approach);
        centres[race] + normal * (reach[race] + depth)
    }

    /// The race that a loose ball's own load presses it against.
    pub(super) fn towards(&self, j: usize) -> Race {
        if self.own_load(j).x < 0.0 {
            Race::Inner
        } else {
            Race::Outer
        }
    }

    fn spring(&self, j: usize) -> &RowSpring {
        &self.springs[self.model.balls[j].row]
    }

    /// The line of the groove centres, of those flanks that press the ball most.
    fn line(&self, j: usize, rings: &Rings) -> CentreLine {
        let (centres, reach) = self.grooves(j, rings);
        CentreLine::between(centres, reach)
    }

    /// The lines between the centres of all grooves that may press a ball: one, or of gothic arches those whose ends lie on
    /// the flanks.
    pub(super) fn lines(&self, j: usize, rings: &Rings) -> impl Iterator<Item = CentreLine> {
        let all = self.groove_pairs(j, rings);
        all.filter(|grooves| grooves.meet)
            .map(|grooves| CentreLine::between(grooves.centres, grooves.reach))
    }

    /// How far out and in a ball between whole races can be; none for a ball that both press.
    pub(super) fn loose(&self, j: usize, rings: &Rings) -> Option<[Vector2<f64>; 2]> {
        let (centres, reach) = self.grooves(j, rings);
        let apart = centres[1] - centres[0];
        let length = apart.norm();
        if length >= reach[0] + reach[1] {
            return None;
        }
        Some(Race::BOTH.map(|race| {
            let outwards = race.sigma();
            let seat = centres[race] + Vector2::x() * (outwards * reach[race]);
            let other = race.other();
            if (seat - centres[other]).norm() <= reach[other] {
                return seat;
            }
            // The other race is in the way: where the ball touches both.
            let along =
                (length * length + reach[0] * reach[0] - reach[1] * reach[1]) / (2.0 * length);
            let aside = (reach[0] * reach[0] - along * along).max(0.0).sqrt();
            let unit = apart / length;
            let corner = |side: f64| {
                centres[0] + unit * along + Vector2::new(-unit.y, unit.x) * (side * aside)
            };
            let (a, b) = (corner(1.0), corner(-1.0));
            if (a.x - b.x) * outwards > 0.0 { a } else { b }
        }))
    }

    /// Groove centres (radius, axial place) in the ball's meridional plane, and how far from them a ball that
    /// just touches has its centre; of gothic arches those flanks that press the ball most.
    fn grooves(&self, j: usize, rings: &Rings) -> ([Vector2<f64>; 2], [f64; 2]) {
        let pressing = |of: &Grooves| {
            let apart = (of.centres[1] - of.centres[0]).norm() - of.reach[0] - of.reach[1];
            if of.meet { apart } else { f64::NEG_INFINITY }
        };
        let most = self
            .groove_pairs(j, rings)
            .reduce(|a, b| if pressing(&b) > pressing(&a) { b } else { a });
        let most = most.expect("a race has a groove");
        (most.centres, most.reach)
    }

    /// Every groove of the outer race with every one of the inner.
    fn groove_pairs(&self, j: usize, rings: &Rings) -> impl Iterator<Item = Grooves> {
        let ball = &self.model.balls[j];
        let [outer, inner] = &self.model.rows[ball.row].pairs;
        let pairs = outer
            .flanks()
            .flat_map(move |outer| inner.flanks().map(move |inner| [outer, inner]));
        let places = Race::BOTH.map(|race| {
            let ring = unknowns::of(rings, race);
            let place = Vector2::new(ring.xy().dot(&self.directions[j]), ring.z);
            place + Vector2::from(self.by_tilt(j, rings, race))
        });
        pairs.map(move |pair| Grooves::of(pair, places, ball.side.radius))
    }

    /// A ball between rings that stand still, sought from a place; the precision is a residual over the ball's share of
    /// the load.
    pub(super) fn settle(
        &self,
        j: usize,
        rings: &Rings,
        start: Vector2<f64>,
        precision: f64,
    ) -> Result<BallState> {
        let body = &self.model.bodies[BodyId::ball(j)];
        if self.is_held(j) {
            let [x, y, z] = Dof::TRANSLATIONS.map(|dof| body.nominal[dof]);
            let place = Vector2::new(x.hypot(y), z);
            return Ok(self.ball_at(j, rings, place));
        }
        // Beyond the axis its place is that of another ball.
        let accepted = |state: &BallState| {
            state.place.x > 0.0
                && state.force.norm() <= BALL_STALLED * self.share().max(state.pressed())
        };
        let found = self.relax(j, rings, start, precision)?;
        if accepted(&found) {
            return Ok(found);
        }
        // Over a defect a ball may have lost one race, and lie far along the other.
        let found = self.relax(j, rings, self.seat(j, rings), precision)?;
        if accepted(&found) {
            return Ok(found);
        }
        let why = if found.place.x > 0.0 {
            format!("{} are not balanced", quantities::force(found.force.norm()))
        } else {
            "the races lie beyond each other".to_owned()
        };
        Err(Error::Equilibrium {
            reason: format!("{} finds no place between the rings: {why}", body.name),
        })
    }

    /// A ball's share of the load.
    pub(super) fn share(&self) -> f64 {
        self.magnitude / self.model.balls.len() as f64
    }

    /// The last step of a settled ball, by the inverse of its stiffness: the error left is of second order.
    pub(super) fn last_step(&self, state: &BallState, inverse: &Matrix2<f64>) -> Vector2<f64> {
        let step = inverse * state.force;
        if step.norm() <= LAST * self.model.scales.approach {
            step
        } else {
            Vector2::zeros()
        }
    }

    /// Newton's method from a place: where it ends.
    fn relax(
        &self,
        j: usize,
        rings: &Rings,
        start: Vector2<f64>,
        precision: f64,
    ) -> Result<BallState> {
        let (tolerance, finest) = (precision * self.share(), FINEST * self.share());
        let own = self.own_load(j).norm();
        let longest = 0.02 * self.model.balls[j].side.radius;
        let mut state = self.ball_at(j, rings, start);
        let mut best = (state.force.norm(), 0);
        for iteration in 0..BALL_ITERATIONS {
            interrupt::check()?;
            let left = state.force.norm();
            if left < 0.5 * best.0 {
                best = (left, iteration);
            }
            let settled = left <= (ROUGH * (own + state.pressed())).clamp(finest, tolerance);
            if settled || iteration > best.1 + 20 {
                break;
            }
            // Not quite symmetric: the law's sums derive from a potential only as far as their nodes are exact, and
            // a loose ball is as soft as the rest.
            let stiffness = self.ball_stiffness(j, rings, &mut state);
            // Where the ball is loose or would tip over, follow the force.
            let shift = (1e-6 * self.stiffness() - least(&stiffness)).max(0.0);
            let shifted = stiffness + Matrix2::identity() * shift;
            let Some(inverse) = shifted.try_inverse() else {
                break;
            };
            let mut step = inverse * state.force;
            // Or the places do not differ in double precision.
            if step.norm() <= 4.0 * f64::EPSILON * state.place.norm() {
                break;
            }
            step *= (longest / step.norm()).min(1.0);
            let found = search(state.force.dot(&step), |t| {
                let trial = self.ball_at(j, rings, state.place + step * t);
                Some((trial.force.dot(&step), trial))
            });
            let Some(found) = found else { break };
            state = found;
        }
        Ok(state)
    }
}

/// A groove of the outer and one of the inner race in a ball's meridional plane.
struct Grooves {
    /// Centres of the grooves (radius, axial place).
    centres: [Vector2<f64>; 2],
    /// How far from them a ball that just touches has its centre.
    reach: [f64; 2],
    /// Whether the line of the centres meets both races on these flanks.
    meet: bool,
}

impl Grooves {
    /// The grooves of two races whose rings are at some places (along the ball's direction, axial).
    fn of(pair: [&Pair; 2], places: [Vector2<f64>; 2], radius: f64) -> Self {
        let centres = Race::BOTH.map(|race| {
            let (torus, shift) = (&pair[race].race, places[race]);
            Vector2::new(torus.a + shift.x, torus.centre + shift.y)
        });
        let apart = centres[1] - centres[0];
        let sine = apart.y / apart.norm();
        let meets = |race: Race| {
            let torus = &pair[race].race;
            !pair[race].is_beyond_cusp(torus.centre + torus.sigma * sine * torus.r)
        };
        Self {
            centres,
            reach: Race::BOTH.map(|race| pair[race].race.r - radius),
            meet: Race::BOTH.into_iter().all(meets),
        }
    }
}

/// The line of a ball's groove centres in its meridional plane, from the outer to the inner one.
pub(super) struct CentreLine {
    from: Vector2<f64>,
    pub(super) unit: Vector2<f64>,
    pub(super) length: f64,
    /// How far from the outer one a ball that just touches has its centre.
    reach: f64,
    /// Approach of both contacts of a ball on the line; negative: a gap.
    pub(super) approach: f64,
}

impl CentreLine {
    fn between(centres: [Vector2<f64>; 2], reach: [f64; 2]) -> Self {
        let apart = centres[1] - centres[0];
        let length = apart.norm();
        Self {
            from: centres[0],
            unit: apart / length,
            length,
            reach: reach[0],
            approach: length - reach[0] - reach[1],
        }
    }
}

/// Least eigenvalue of a matrix's symmetric part.
pub(super) fn least(matrix: &Matrix2<f64>) -> f64 {
    let half = (matrix[(0, 0)] - matrix[(1, 1)]) / 2.0;
    let mixed = f64::midpoint(matrix[(0, 1)], matrix[(1, 0)]);
    f64::midpoint(matrix[(0, 0)], matrix[(1, 1)]) - (half * half + mixed * mixed).sqrt()
}
