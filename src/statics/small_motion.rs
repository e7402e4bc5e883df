//! Forces of a ball between a held outer and a moving inner ring under small, slow motion of the inner ring.
//!
//! In the cage's frame, which turns at ω_c, a ball has places a = (r, z), along its radius and along the axis, and speeds
//! b = (ṡ, R ω), along its orbit and of its rotation. Where it stands along the orbit is given by the cage; so is what it does on the
//! mean. With x the inner ring's places and tilts, about a state in which the ball is at rest in that frame,
//!
//! ```text
//! 0   = K_a a + C_a ȧ + C_b b + K_x x + C_x ẋ      forces on the ball, and moments over R
//! F   = the same row of the inner ring             what has to be added to it
//! ```
//!
//! K and C are differences of the forces of its contacts, with the ball's centrifugal and Coriolis force, and its gyroscopic moment
//! where it spins freely. Its inertia is left out: the motion is slow against the ball on its contacts and against friction that
//! takes its rotation along. First b is eliminated, then a, to first order in rates of change.

use nalgebra::{DMatrix, Matrix2x5, Matrix5, Matrix5x2, SMatrix, Vector3};

use super::steady;
use crate::contact::{Motion, TiltedRing, V2, Wrench, centrifugal};
use crate::inspect;
use crate::model::{BodyId, Dof, Model, Race};

/// Differences of places, over the typical approach: truncation 1e-6, noise 1e-9 of the stiffness.
const ASIDE: f64 = 1e-3;
/// Differences of speeds \[m/s\]: small against the slip over which friction bends, 1e-3 m/s and more.
const FASTER: f64 = 1e-6;
/// Resistance of friction that counts as none, over that of the ball's mass as its contacts vibrate: too weak to take it along.
const WEAK: f64 = 1e-6;
/// Stiffness of a ball between the races that counts as none, over the largest.
const NONE: f64 = 1e-9;

/// Number of motions: the ball's places and speeds along r, s and z, and its rotation about z, r and s times its radius; the inner
/// ring's places and their rates.
const MOVED: usize = 19;
const PLACES: usize = 0;
const SPEEDS: usize = 3;
const SPINS: usize = 6;
const RING: usize = 9;
const RING_RATES: usize = 14;
/// Forces on the ball along r, s and z, moments about z, r and s over its radius; forces and moments on the inner ring.
const FELT: usize = 11;
const ON_SPINS: usize = 3;
const ON_RING: usize = 6;

/// Answers of forces, by rows, to what is moved, by columns, with the sign of stiffnesses.
type Slopes = SMatrix<f64, FELT, MOVED>;

/// Stiffness and damping of a ball for the inner ring.
pub(super) struct SmallMotion {
    /// K of the inner ring with the ball where it follows it.
    pub stiffness: Matrix5<f64>,
    /// C, likewise.
    pub damping: Matrix5<f64>,
    /// How the ball follows, a = follow x.
    pub follow: Matrix2x5<f64>,
    /// The force on the inner ring by ȧ.
    pub by_following: Matrix5x2<f64>,
    /// ω_c \[rad/s\].
    pub orbit: f64,
}

/// A ball and the rings in a state.
struct BallInPlace<'m> {
    model: &'m Model,
    j: usize,
    ball: Motion,
    rings: [Motion; 2],
    tilts: [[[f64; 2]; 2]; 2],
    /// Axes along the ball's radius, its orbit, and the bearing's axis.
    axes: [Vector3<f64>; 3],
    orbit: f64,
    radius: f64,
}

impl SmallMotion {
    /// The small motion of a ball in a state of all bodies in motion; none where it does not touch the inner race.
    pub fn of(model: &Model, y: &[f64], j: usize) -> Option<Self> {
        if inspect::raw::contact(model, y, j, Race::Inner).load <= 0.0 {
            return None;
        }
        let place = BallInPlace::of(model, y, j);
        let slopes = place.slopes();
        let mobility = &model.mobility[BodyId::ball(j)];
        let moves = |dofs: &[Dof]| dofs.iter().all(|dof| mobility[*dof] > 0.0);
        let in_plane = moves(&Dof::SYMMETRIC);
        // Places and speeds that are free, by their numbers among forces and what is moved.
        let mut places = Vec::new();
        let mut speeds = Vec::new();
        if in_plane {
            places.push(0);
            speeds.push((1, SPEEDS + 1));
        }
        if moves(&[Dof::Z]) {
            places.push(2);
        }
        if moves(&[Dof::Theta]) {
            let axes = if model.balls_turn() { 3 } else { 1 };
            speeds.extend((0..axes).map(|i| (ON_SPINS + i, SPINS + i)));
        }
        let mass = model.bodies[BodyId::ball(j)].mass[Dof::X];
        let weak = WEAK * mass * model.scales.frequency;
        Some(Self {
            orbit: place.orbit,
            ..Self::condensed(&slopes, &places, &speeds, weak)
        })
    }

    /// Eliminates speeds, which are not led where friction is weaker \[N s/m\], then places.
    fn condensed(slopes: &Slopes, places: &[usize], speeds: &[(usize, usize)], weak: f64) -> Self {
        let rows: Vec<usize> = places.iter().copied().chain(ON_RING..FELT).collect();
        let still = places.iter().map(|i| PLACES + i).chain(RING..RING_RATES);
        let moving = places.iter().map(|i| SPEEDS + i).chain(RING_RATES..MOVED);
        let (of_speeds, by_speeds): (Vec<_>, Vec<_>) = speeds.iter().copied().unzip();
        let part = |rows: &[usize], columns: &[usize]| -> DMatrix<f64> {
            DMatrix::from_fn(rows.len(), columns.len(), |i, k| {
                slopes[(rows[i], columns[k])]
            })
        };
        let resisted = part(&of_speeds, &by_speeds);
        let led = part(&rows, &by_speeds) * inverse(resisted, weak);
        let without_speeds =
            |columns: Vec<usize>| part(&rows, &columns) - &led * part(&of_speeds, &columns);
        let stiffness = without_speeds(still.collect());
        let damping = without_speeds(moving.collect());
        let count = places.len();
        let own = stiffness.view((0, 0), (count, count)).into_owned();
        let yielding = inverse(own, NONE * stiffness.amax());
        let follow = -&yielding * stiffness.view((0, count), (count, 5));
        let passed = -stiffness.view((count, 0), (5, count)) * yielding;
        let on_ring =
            |of: &DMatrix<f64>| -> DMatrix<f64> { of.rows(count, 5) + &passed * of.rows(0, count) };
        let condensed = on_ring(&damping);
        let by_following = condensed.columns(0, count).into_owned();
        let by_rates = condensed.columns(count, 5) + &by_following * &follow;
        let by_places = stiffness.view((count, count), (5, 5))
            + stiffness.view((count, 0), (5, count)) * &follow;
        let mut found = Self {
            stiffness: Matrix5::from_fn(|i, k| by_places[(i, k)]),
            damping: Matrix5::from_fn(|i, k| by_rates[(i, k)]),
            follow: Matrix2x5::zeros(),
            by_following: Matrix5x2::zeros(),
            orbit: 0.0,
        };
        for (at, place) in places.iter().enumerate() {
            let of = place / 2;
            for i in 0..5 {
                found.follow[(of, i)] = follow[(at, i)];
                found.by_following[(i, of)] = by_following[(i, at)];
            }
        }
        found
    }
}

/// The inverse of a matrix where it is larger than a bound.
fn inverse(of: DMatrix<f64>, bound: f64) -> DMatrix<f64> {
    if of.is_empty() {
        return of;
    }
    of.pseudo_inverse(bound).expect("the bound is not negative")
}

impl<'m> BallInPlace<'m> {
    fn of(model: &'m Model, y: &[f64], j: usize) -> Self {
        let (layout, ball) = (model.layout(), BodyId::ball(j));
        let rings = Race::BOTH.map(|race| layout.motion(y, race.ring()));
        let motion = layout.motion(y, ball);
        let from: V2 = motion.centre - rings[Race::Outer].centre;
        let (out, along) = (from.normalize(), Vector3::z());
        let radial = Vector3::new(out.x, out.y, 0.0);
        Self {
            model,
            j,
            ball: motion,
            rings,
            tilts: Race::BOTH.map(|race| model.tilt(y, race)),
            axes: [radial, along.cross(&radial), along],
            orbit: steady::orbit(layout, y, ball),
            radius: model.radius(ball),
        }
    }

    /// Differences of all forces, with what turning with the cage adds.
    fn slopes(&self) -> Slopes {
        let model = self.model;
        let lever = model.radius(BodyId::INNER);
        let mut slopes = Slopes::zeros();
        for moved in 0..MOVED {
            let is_place = moved < SPEEDS || (RING..RING_RATES).contains(&moved);
            let step = if is_place {
                ASIDE * model.scales.approach
            } else {
                FASTER
            };
            let tilts = [RING + 3, RING + 4, RING_RATES + 3, RING_RATES + 4].contains(&moved);
            let step = if tilts { step / lever } else { step };
            let felt = |by: f64| {
                let mut all = [0.0; MOVED];
                all[moved] = by;
                self.felt(&all, moved < RING)
            };
            let slope = (felt(-step) - felt(step)) / (2.0 * step);
            slopes.set_column(moved, &slope);
        }
        let body = &model.bodies[BodyId::ball(self.j)];
        let (mass, inertia) = (body.mass[Dof::X], body.mass[Dof::Theta]);
        // m (δ̈ + 2 ω_c ẑ × δ̇ − ω_c² δ) = F, of r and s.
        slopes[(0, PLACES)] -= centrifugal(mass, self.orbit);
        slopes[(0, SPEEDS + 1)] -= 2.0 * mass * self.orbit;
        slopes[(1, SPEEDS)] += 2.0 * mass * self.orbit;
        // I (ω̇ + ω_c ẑ × ω) = M; speeds are R ω, moments over R.
        let turning = inertia * self.orbit / (self.radius * self.radius);
        slopes[(ON_SPINS + 1, SPINS + 2)] -= turning;
        slopes[(ON_SPINS + 2, SPINS + 1)] += turning;
        slopes
    }

    /// The forces with something moved; the outer ring's where the ball moves.
    fn felt(&self, by: &[f64; MOVED], by_ball: bool) -> SMatrix<f64, FELT, 1> {
        let ball = self.moved_ball(by);
        let mut felt = SMatrix::<f64, FELT, 1>::zeros();
        let mut add = |on_ball: &Wrench| {
            for (i, axis) in self.axes.iter().enumerate() {
                felt[i] += on_ball.force.dot(axis);
            }
            // About z first: balls that do not spin freely have that alone.
            for (i, at) in [2, 0, 1].into_iter().enumerate() {
                felt[ON_SPINS + i] += on_ball.moment.dot(&self.axes[at]) / self.radius;
            }
        };
        if by_ball {
            let [outer, _] = self.rings;
            let ring = self
                .model
                .tilted_as(Race::Outer, &outer, self.tilts[Race::Outer]);
            let [on_ball, _] = inspect::between(self.model, self.j, Race::Outer, &ball, &ring);
            add(&on_ball);
        }
        let [on_ball, on_ring] =
            inspect::between(self.model, self.j, Race::Inner, &ball, &self.inner(by));
        add(&on_ball);
        for i in 0..3 {
            felt[ON_RING + i] = on_ring.force[i];
        }
        for i in 0..2 {
            felt[ON_RING + 3 + i] = on_ring.moment[i];
        }
        felt
    }

    /// The ball with places and speeds moved; as it moves out, it keeps going round as fast.
    fn moved_ball(&self, by: &[f64; MOVED]) -> Motion {
        let along = |of: [f64; 3]| -> Vector3<f64> { (0..3).map(|i| self.axes[i] * of[i]).sum() };
        let place = along([by[PLACES], by[PLACES + 1], by[PLACES + 2]]);
        let carried = Vector3::z().cross(&place) * self.orbit;
        let speed = along([by[SPEEDS], by[SPEEDS + 1], by[SPEEDS + 2]]) + carried;
        let spin = along([by[SPINS + 1], by[SPINS + 2], by[SPINS]]) / self.radius;
        let at = &self.ball;
        Motion {
            centre: at.centre + place.xy(),
            z: at.z + place.z,
            velocity: at.velocity + speed.xy(),
            vz: at.vz + speed.z,
            omega: at.omega + spin.z,
            across: at.across + spin.xy(),
            ..*at
        }
    }

    /// The inner ring with places and their rates moved.
    fn inner(&self, by: &[f64; MOVED]) -> TiltedRing {
        let ([_, at], [_, [tilt, rates]]) = (self.rings, self.tilts);
        let (place, rate) = (&by[RING..RING_RATES], &by[RING_RATES..]);
        let moved = Motion {
            centre: at.centre + V2::new(place[0], place[1]),
            z: at.z + place[2],
            velocity: at.velocity + V2::new(rate[0], rate[1]),
            vz: at.vz + rate[2],
            ..at
        };
        let tilts = [
            [tilt[0] + place[3], tilt[1] + place[4]],
            [rates[0] + rate[3], rates[1] + rate[4]],
        ];
        self.model.tilted_as(Race::Inner, &moved, tilts)
    }
}
