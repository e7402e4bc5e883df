//! Frames of reference, and transformations between them.
//!
//! * The **scene's** frame is inertial: x to the right, y up, z along the bearing's axis.
//! * A **ring's** frame has its origin at the ring's centre and moves with it. A contact is evaluated in it. Its axes keep the
//!   directions of the scene's, unless the ring tilts: then z is the ring's axis, and x and y are turned with it by the shortest
//!   way ([`TiltedRing`]). What is fixed to the ring, defects and waves, stands at angles from a mark that has turned by θ.
//! * The **cage's** frame turns about the bearing's axis at the orbit speed of the balls. A bearing that rolls steadily is at
//!   rest in it, under the centrifugal force.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::{V2, cross};
use crate::simd::Number;
use crate::tilt::{Frame, Rotation};

/// Place and motion of a body: x, y, z and the angle about z.
#[derive(Debug, Clone, Copy, Default)]
pub struct Motion {
    /// Centre in the plane \[m\].
    pub(crate) centre: V2,
    /// Axial place \[m\].
    pub(crate) z: f64,
    /// Angle about z \[rad\].
    pub(crate) theta: f64,
    /// Velocity in the plane \[m/s\].
    pub(crate) velocity: V2,
    /// Axial velocity \[m/s\].
    pub(crate) vz: f64,
    /// Angular speed about z \[rad/s\].
    pub(crate) omega: f64,
    /// Angular velocity about x and y \[rad/s\]: of a ball that spins freely, or as a ring sees it that tilts.
    pub(crate) across: V2,
    /// Euler parameters of a ball that spins freely and has a cap, of any length: how it has turned from its own frame into the
    /// scene's.
    pub(crate) attitude: Option<[f64; 4]>,
    /// Tilt of the ring in whose frame it is, if that is tilted.
    pub(crate) seen_by: Option<[f64; 2]>,
}

impl Motion {
    /// A motion from the four positions (x, y, z \[m\], θ \[rad\]) and the four velocities of a body.
    ///
    /// # Panics
    /// If either has less than four numbers.
    pub fn new(q: &[f64], v: &[f64]) -> Self {
        Self {
            centre: V2::new(q[0], q[1]),
            z: q[2],
            theta: q[3],
            velocity: V2::new(v[0], v[1]),
            vz: v[2],
            omega: v[3],
            across: V2::zeros(),
            attitude: None,
            seen_by: None,
        }
    }

    /// The same with an angular velocity about x and y \[rad/s\].
    #[must_use]
    pub(crate) fn turning_across(self, [x, y]: [f64; 2]) -> Self {
        Self {
            across: V2::new(x, y),
            ..self
        }
    }

    /// Angular velocity \[rad/s\].
    pub(crate) fn turning(&self) -> Vector3<f64> {
        Vector3::new(self.across.x, self.across.y, self.omega)
    }

    /// The body's centre \[m\].
    pub(crate) fn place(&self) -> Vector3<f64> {
        Vector3::new(self.centre.x, self.centre.y, self.z)
    }

    /// The body as seen by who moves with a ring's centre, but does not turn with it.
    #[inline]
    pub(crate) fn seen_from(&self, ring: &Self) -> Self {
        Self {
            centre: self.centre - ring.centre,
            z: self.z - ring.z,
            velocity: self.velocity - ring.velocity,
            vz: self.vz - ring.vz,
            ..*self
        }
    }

    /// A place as this ring sees it.
    #[inline(always)]
    pub(crate) fn place_from<T: Number>(&self, [x, y, z]: [T; 3]) -> [T; 3] {
        [x + -self.centre.x, y + -self.centre.y, z + -self.z]
    }

    /// The angle at this body, from its mark, of a direction \[rad\].
    #[inline]
    pub(crate) fn angle_of(&self, direction: f64) -> f64 {
        direction - self.theta
    }

    /// The direction of what is fixed to this body at an angle from its mark \[rad\].
    #[inline]
    pub(crate) fn direction_of(&self, angle: f64) -> f64 {
        self.theta + angle
    }

    /// A direction that is fixed in this body, given in its own frame: it turns about z of the scene by θ, or as the attitude says.
    pub(crate) fn carried(&self, own: &Vector3<f64>) -> Vector3<f64> {
        let in_scene = if let Some([w, x, y, z]) = self.attitude {
            UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)) * own
        } else {
            let (sin, cos) = self.theta.sin_cos();
            Vector3::new(own.x * cos - own.y * sin, own.x * sin + own.y * cos, own.z)
        };
        match self.seen_by {
            None => in_scene,
            Some(tilt) => Frame::new(tilt).to_ring(&in_scene),
        }
    }

    /// The direction from the axis to this body's centre \[rad\].
    #[inline]
    pub(crate) fn direction(&self) -> f64 {
        self.centre.y.atan2(self.centre.x)
    }

    /// Rate of that turning \[rad/s\]: the speed of the cage's frame, where a ball rests in it.
    pub(crate) fn orbit_speed(&self) -> f64 {
        cross(self.centre, self.velocity) / self.centre.norm_squared()
    }
}

/// A ring that may tilt, for its contacts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TiltedRing {
    pub rotation: Rotation,
    /// Centre of mass of the ring \[m\].
    centre: Vector3<f64>,
    /// Velocity of the centre of mass \[m/s\].
    velocity: Vector3<f64>,
    /// Angular velocity of the ring, in its own frame \[rad/s\].
    turning: Vector3<f64>,
    /// Axial place of the centre of mass in its frame \[m\].
    offset: f64,
    theta: f64,
    /// Whether the ring's balls spin freely.
    balls_turn: bool,
}

impl TiltedRing {
    /// The frame of a ring whose x, y and z are the displacement of its centre of mass, an axial place of the
    /// ring's frame \[m\]; its balls spin freely, or about its axis.
    pub fn new(motion: &Motion, rotation: Rotation, offset: f64, balls_turn: bool) -> Self {
        Self {
            rotation,
            centre: Vector3::new(motion.centre.x, motion.centre.y, motion.z + offset),
            velocity: Vector3::new(motion.velocity.x, motion.velocity.y, motion.vz),
            turning: rotation.frame.to_ring(&rotation.angular_velocity()),
            offset,
            theta: motion.theta,
            balls_turn,
        }
    }

    /// Whether the ring's balls spin freely.
    pub fn balls_turn(&self) -> bool {
        self.balls_turn
    }

    /// Vector from the centre of mass to a ball's centre, in the scene's frame \[m\].
    pub fn arm(&self, ball: &Motion) -> Vector3<f64> {
        ball.place() - self.centre
    }

    /// A ball and this ring, both as [`Self::see`] returns them; the ring's mark stands at θ.
    pub fn facing(&self, ball: &Motion) -> [Motion; 2] {
        let place = [ball.centre.x, ball.centre.y, ball.z];
        let velocity = [ball.velocity.x, ball.velocity.y, ball.vz];
        let spin = [ball.across.x, ball.across.y, ball.omega];
        let [place, velocity, spin] = self.see::<_, false>(place, velocity, spin);
        let seen = Motion {
            centre: V2::new(place[0], place[1]),
            z: place[2],
            theta: ball.theta,
            velocity: V2::new(velocity[0], velocity[1]),
            vz: velocity[2],
            omega: spin[2],
            across: V2::new(spin[0], spin[1]),
            attitude: ball.attitude,
            seen_by: Some(self.rotation.frame.tilt),
        };
        [seen, self.standing()]
    }

    /// Itself in its own frame, where it stands still.
    pub fn standing(&self) -> Motion {
        Motion {
            theta: self.theta,
            ..Motion::default()
        }
    }

    /// Place, velocity and angular velocity of a ball, or of balls side by side, as who turns with this ring sees them in its frame.
    /// Where balls do not spin freely, each contact takes a ball's spin to be about the axis of the ring it touches.
    #[inline(always)]
    pub fn see<T: Number, const FMA: bool>(
        &self,
        place: [T; 3],
        velocity: [T; 3],
        spin: [T; 3],
    ) -> [[T; 3]; 3] {
        let (frame, turning) = (&self.rotation.frame, &self.turning);
        let (c, v) = (&self.centre, &self.velocity);
        let [x, y, z] =
            frame.all_to_ring::<_, FMA>([place[0] + -c.x, place[1] + -c.y, place[2] + -c.z]);
        let velocity = frame.all_to_ring::<_, FMA>([
            velocity[0] + -v.x,
            velocity[1] + -v.y,
            velocity[2] + -v.z,
        ]);
        // Less turning × place.
        let by = |a: f64, p: T, b: f64, q: T, from: T| {
            p.mul_add::<FMA>(p.same(-a), q.mul_add::<FMA>(q.same(b), from))
        };
        let velocity = [
            by(turning.y, z, turning.z, y, velocity[0]),
            by(turning.z, x, turning.x, z, velocity[1]),
            by(turning.x, y, turning.y, x, velocity[2]),
        ];
        let spin = if self.balls_turn {
            frame.all_to_ring::<_, FMA>(spin)
        } else {
            spin
        };
        let spin = [
            spin[0] + -turning.x,
            spin[1] + -turning.y,
            spin[2] + -turning.z,
        ];
        [[x, y, z + self.offset], velocity, spin]
    }

    /// Velocity of the origin of the ring's frame by turning about its centre of mass, both in that frame \[m/s\].
    pub fn moved_at_origin(&self, turning: &Vector3<f64>) -> Vector3<f64> {
        turning.cross(&(Vector3::z() * -self.offset))
    }

    /// A force on this ring and a moment about the origin of its frame, in the scene's frame and about the centre of mass.
    pub fn about_centre(&self, force: &Vector3<f64>, moment: &Vector3<f64>) -> [Vector3<f64>; 2] {
        let arm = Vector3::z() * -self.offset;
        let frame = &self.rotation.frame;
        [
            frame.to_scene(force),
            frame.to_scene(&(moment + arm.cross(force))),
        ]
    }
}

/// ½ ω e: how Euler parameters change with an angular velocity of the scene \[rad/s\].
pub(crate) fn attitude_rates(turning: &Vector3<f64>, [w, x, y, z]: [f64; 4]) -> [f64; 4] {
    let rates = Quaternion::from_imag(turning * 0.5) * Quaternion::new(w, x, y, z);
    [rates.w, rates.i, rates.j, rates.k]
}

/// How Euler parameters e of rates ė accelerate under an angular velocity and its rate:
///
/// ```text
/// ë = ½ ω̇ e − ¼ ω² e + 2 k (½ ω e − ė) − k² ½ (|e|² − 1) e
/// ```
///
/// The last two vanish in every motion with ė = ½ ω e and |e| = 1. They lead e and ė back there at a rate k \[1/s\], critically
/// damped, from where errors of steps would let them drift (J. Baumgarte, *Comput. Methods Appl. Mech. Eng.* 1, 1972).
pub(crate) fn attitude_accelerations(
    rates: &Vector3<f64>,
    turning: &Vector3<f64>,
    [e, changes]: [[f64; 4]; 2],
    k: f64,
) -> [f64; 4] {
    let (of_rates, of_turning) = (attitude_rates(rates, e), attitude_rates(turning, e));
    let excess = 0.5 * (e.iter().map(|e| e * e).sum::<f64>() - 1.0);
    let back = 0.25 * turning.norm_squared() + k * k * excess;
    std::array::from_fn(|i| of_rates[i] - back * e[i] + 2.0 * k * (of_turning[i] - changes[i]))
}

/// Centrifugal force on a mass \[kg\] that rests in the cage's frame, over its radius \[N/m\].
pub(crate) fn centrifugal(mass: f64, orbit_speed: f64) -> f64 {
    mass * orbit_speed * orbit_speed
}
