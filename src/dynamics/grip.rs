//! A contact held still: its slices at one place of the bodies, ready for any velocities.
//!
//! With all of a slice's force at one point, slip and approach depend only on the relative twist
//! w = (v_b − v_r − θ̇_r ẑ × a, θ̇_b − θ̇_r), where a leads from the ring's centre to the ball's: four numbers a
//! contact. The wrench on the ball about its centre and its derivative by w say all about both bodies.

use nalgebra::{Matrix4, Vector4};

use crate::contact::{Friction, Pair, Sink, Touch, V2, cross, law::hunt_crossley, turned};

/// A slice: what of it does not depend on velocities.
#[derive(Debug, Clone, Copy)]
struct Slice {
    elastic: f64,
    n_e: V2,
    /// Moments about the ball's centre of unit forces along n_e and t_e.
    levers: (f64, f64),
    /// In-plane and axial part of the normal force over its magnitude.
    share: (f64, f64),
    /// sin α and cos α of the slice: the meridional direction is −sin α n_e + cos α ẑ.
    slope: (f64, f64),
}

/// The slices of one contact.
#[derive(Debug, Clone, Default)]
pub(super) struct Grip {
    slices: Vec<Slice>,
    radius: f64,
    flat: bool,
    /// From the ring's centre to the ball's.
    pub apart: V2,
}

impl Grip {
    /// Empties the grip for a contact of a ball of that radius; `flat` if all slices press along the common
    /// normal.
    pub fn open(&mut self, radius: f64, flat: bool, apart: V2) {
        self.slices.clear();
        self.radius = radius;
        self.flat = flat;
        self.apart = apart;
    }

    /// Whether nothing touches.
    pub fn is_empty(&self) -> bool {
        self.slices.is_empty()
    }

    /// Wrench on the ball about its centre for a relative twist, (x, y, z \[N\], about z \[N m\]), and its
    /// derivative by the twist.
    ///
    /// With `secant`, friction's slope is the steeper one through rest, φ for φ + φ'(u) u: from far away, where
    /// Newton's tangent leads across to the other side, iterations by it do not overshoot.
    pub fn wrench_and_slope(
        &self,
        pair: &Pair,
        twist: &Vector4<f64>,
        secant: bool,
    ) -> (Vector4<f64>, Matrix4<f64>) {
        let (mut wrench, mut slope) = (Vector4::zeros(), Matrix4::zeros());
        // On a whole race all slices share one direction.
        for slices in self.slices.chunk_by(|a, b| a.n_e == b.n_e) {
            let world_from_contact = turn(slices[0].n_e);
            let mut sum = Sum::default();
            let twist = world_from_contact.tr_mul(twist);
            for slice in slices {
                sum.add(slice, pair, &twist, secant);
            }
            let local = Matrix4::from_fn(|i, j| sum.slope[i][j]);
            wrench += world_from_contact * Vector4::from(sum.wrench);
            slope += world_from_contact * local * world_from_contact.transpose();
        }
        (wrench, slope)
    }
}

/// Sums in the contact's own frame: along n_e, t_e, ẑ and about ẑ.
#[derive(Default)]
struct Sum {
    wrench: [f64; 4],
    slope: [[f64; 4]; 4],
}

impl Sum {
    #[inline]
    fn add(&mut self, slice: &Slice, pair: &Pair, twist: &Vector4<f64>, secant: bool) {
        let ((lever_n, lever_t), (sin, cos)) = (slice.levers, slice.slope);
        let v_n = twist.x + lever_n * twist.w;
        let u_t = twist.y + lever_t * twist.w;
        let u_m = twist.z * cos - v_n * sin;
        let factor = hunt_crossley(pair.damping, slice.share.0 * v_n + slice.share.1 * twist.z);
        let (normal, rate) = if factor < 0.0 && pair.clamp_pull {
            (0.0, 0.0)
        } else {
            // The derivative of the factor by the approach.
            let rate = hunt_crossley(pair.damping, 1.0) - 1.0;
            (slice.elastic * factor, slice.elastic * rate)
        };
        let (factor, bend) = rubbing(pair.friction.as_ref(), u_t * u_t + u_m * u_m);
        let bend = if secant { 0.0 } else { bend };
        // The slice's force on the ball over −(normal force), along n_e, t_e and ẑ.
        let (f_t, f_m) = (factor * u_t, factor * u_m);
        let force = [slice.share.0 - sin * f_m, f_t, slice.share.1 + cos * f_m];
        // Friction by slip at constant normal force: −N (φ 1 + (φ'/u) u⃗ u⃗ᵀ).
        let pressed = normal.max(0.0);
        let tt = pressed * (factor + bend * u_t * u_t);
        let tm = pressed * bend * u_t * u_m;
        let mm = pressed * (factor + bend * u_m * u_m);
        // By the velocities along n_e, t_e and ẑ, with damping.
        let (by_n, by_z) = (rate * slice.share.0, rate * slice.share.1);
        let slope = [
            [
                force[0] * by_n + mm * sin * sin,
                -tm * sin,
                force[0] * by_z - mm * sin * cos,
            ],
            [force[1] * by_n - tm * sin, tt, force[1] * by_z + tm * cos],
            [
                force[2] * by_n - mm * sin * cos,
                tm * cos,
                force[2] * by_z + mm * cos * cos,
            ],
        ];
        let moment = |column: usize| lever_n * slope[0][column] + lever_t * slope[1][column];
        let turning = |row: &[f64; 3]| lever_n * row[0] + lever_t * row[1];
        for (i, row) in slope.iter().enumerate() {
            self.wrench[i] -= normal * force[i];
            for (j, entry) in row.iter().enumerate() {
                self.slope[i][j] -= entry;
            }
            self.slope[i][3] -= turning(row);
            self.slope[3][i] -= moment(i);
        }
        self.wrench[3] -= normal * (lever_n * force[0] + lever_t * force[1]);
        self.slope[3][3] -= lever_n * moment(0) + lever_t * moment(1);
    }
}

/// φ and φ'(u)/u of a friction that may be none.
fn rubbing(friction: Option<&Friction>, square: f64) -> (f64, f64) {
    friction.map_or((0.0, 0.0), |friction| friction.factor_and_bend(square))
}

impl Sink for Grip {
    fn touch(&mut self, touch: &Touch) {
        // α of the slice: that of the place on the ball (flat contact), or of the force's direction.
        let slope = if self.flat {
            let sin = touch.zeta / self.radius;
            (sin, (1.0 - sin * sin).sqrt())
        } else {
            let tan = touch.share.1 / touch.share.0;
            let cos = 1.0 / (1.0 + tan * tan).sqrt();
            (tan * cos, cos)
        };
        let (n_e, arm) = (touch.n_e, touch.arm_ball);
        self.slices.push(Slice {
            elastic: touch.elastic,
            n_e,
            levers: (cross(arm, n_e), cross(arm, turned(n_e))),
            share: touch.share,
            slope,
        });
    }
}

/// Turns (n_e, t_e, ẑ, about ẑ) into (x, y, z, about z).
fn turn(n_e: V2) -> Matrix4<f64> {
    let mut turn = Matrix4::identity();
    (turn[(0, 0)], turn[(1, 0)]) = (n_e.x, n_e.y);
    (turn[(0, 1)], turn[(1, 1)]) = (-n_e.y, n_e.x);
    turn
}

/// T of the twist w = v_b − T v_r, with (vx, vy, vz, θ̇) of ball and ring.
pub(super) fn carried(apart: V2) -> Matrix4<f64> {
    let mut carried = Matrix4::identity();
    carried[(0, 3)] = -apart.y;
    carried[(1, 3)] = apart.x;
    carried
}
