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
    /// Direction of the normal force: approach is its product with the twist.
    normal: Vector4<f64>,
    /// The two directions of slip.
    tangential: Vector4<f64>,
    meridional: Vector4<f64>,
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
    pub fn wrench_and_slope(
        &self,
        pair: &Pair,
        twist: &Vector4<f64>,
    ) -> (Vector4<f64>, Matrix4<f64>) {
        let (mut sum, mut slope) = (Vector4::zeros(), Matrix4::zeros());
        for slice in &self.slices {
            let (normal, rate) = slice.pressed(pair, twist);
            let mut along = slice.normal;
            if let Some(friction) = &pair.friction {
                slice.rub(friction, normal.max(0.0), twist, &mut along, &mut slope);
            }
            // `along` is now the slice's force over its normal force.
            sum -= along * normal;
            slope -= along * (slice.normal * rate).transpose();
        }
        (sum, slope)
    }
}

impl Slice {
    /// Normal force and its derivative by the approach.
    fn pressed(&self, pair: &Pair, twist: &Vector4<f64>) -> (f64, f64) {
        let factor = hunt_crossley(pair.damping, self.normal.dot(twist));
        if factor < 0.0 && pair.clamp_pull {
            (0.0, 0.0)
        } else {
            let slope = hunt_crossley(pair.damping, 1.0) - 1.0;
            (self.elastic * factor, self.elastic * slope)
        }
    }

    fn slip(&self, twist: &Vector4<f64>) -> (f64, f64) {
        (self.tangential.dot(twist), self.meridional.dot(twist))
    }

    /// Adds friction over normal force to `along`, and friction's slope at constant normal force to `slope`.
    fn rub(
        &self,
        friction: &Friction,
        normal: f64,
        twist: &Vector4<f64>,
        along: &mut Vector4<f64>,
        slope: &mut Matrix4<f64>,
    ) {
        let (u_t, u_m) = self.slip(twist);
        let (factor, bend) = friction.factor_and_bend(u_t.hypot(u_m));
        let rubbing = self.tangential * u_t + self.meridional * u_m;
        *along += rubbing * factor;
        // −N φ u⃗ by u⃗: −N (φ 1 + (φ'/u) u⃗ u⃗ᵀ).
        *slope -= self.tangential * (self.tangential * (normal * factor)).transpose()
            + self.meridional * (self.meridional * (normal * factor)).transpose()
            + rubbing * (rubbing * (normal * bend)).transpose();
    }
}

impl Sink for Grip {
    fn touch(&mut self, touch: &Touch) {
        // α of the slice: that of the place on the ball (flat contact), or of the force's direction.
        let (sin, cos) = if self.flat {
            let sin = touch.zeta / self.radius;
            (sin, (1.0 - sin * sin).sqrt())
        } else {
            let cos = 1.0 / touch.share.0.hypot(touch.share.1);
            (touch.share.1 * cos, cos)
        };
        let (n_e, t_e, arm) = (touch.n_e, turned(touch.n_e), touch.arm_ball);
        let plane = |d: V2| Vector4::new(d.x, d.y, 0.0, cross(arm, d));
        let mut normal = plane(n_e * touch.share.0);
        normal.z = touch.share.1;
        let mut meridional = plane(n_e * -sin);
        meridional.z = cos;
        self.slices.push(Slice {
            elastic: touch.elastic,
            normal,
            tangential: plane(t_e),
            meridional,
        });
    }
}

/// T of the twist w = v_b − T v_r, with (vx, vy, vz, θ̇) of ball and ring.
pub(super) fn carried(apart: V2) -> Matrix4<f64> {
    let mut carried = Matrix4::identity();
    carried[(0, 3)] = -apart.y;
    carried[(1, 3)] = apart.x;
    carried
}
