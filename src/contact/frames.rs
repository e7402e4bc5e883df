//! Frames of reference, and what changes from one to the other.
//!
//! * The **scene's** frame is inertial: x to the right, y up, z along the bearing's axis.
//! * A **ring's** frame has its origin at the ring's centre and moves with it. A contact is evaluated in it. Its axes keep the
//!   directions of the scene's, unless the ring leans: then z is the ring's axis, and x and y are turned with it by the shortest
//!   way ([`LeaningRing`]). What is fixed to the ring, defects and waves, stands at angles from a mark that has turned by θ.
//! * The **cage's** frame turns about the bearing's axis at the orbit speed of the balls. A bearing that rolls evenly rests
//!   in it, under the centrifugal force.

// Into loops that are compiled for the instructions at hand.
#![allow(clippy::inline_always)]

use nalgebra::Vector3;

use super::{V2, cross};
use crate::simd::Number;
use crate::tilt::{Frame, Rotation};

/// Where a body is and how it moves: x, y, z and the angle about z.
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
    /// Angular velocity across z \[rad/s\]: of a ball as a ring sees it that tilts.
    pub(crate) across: V2,
    /// Tilt of the ring that sees it so, where that leans.
    pub(crate) seen_by: Option<[f64; 2]>,
}

impl Motion {
    /// From the four positions (x, y, z \[m\], θ \[rad\]) and the four velocities of a body.
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
            seen_by: None,
        }
    }

    /// This body as seen by who moves with a ring's centre, but does not turn with it.
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

    /// A velocity as seen by who moves with this ring's centre.
    #[inline(always)]
    pub(crate) fn velocity_from<T: Number>(&self, [x, y, z]: [T; 3]) -> [T; 3] {
        [x + -self.velocity.x, y + -self.velocity.y, z + -self.vz]
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

    /// A direction that is fixed in this body, given in its own frame: it turns about z of the scene by θ.
    pub(crate) fn carried(&self, own: &Vector3<f64>) -> Vector3<f64> {
        let (sin, cos) = self.theta.sin_cos();
        let [x, y] = [own.x * cos - own.y * sin, own.x * sin + own.y * cos];
        let in_scene = Vector3::new(x, y, own.z);
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

    /// How fast that turns \[rad/s\]: the speed of the cage's frame, where a ball rests in it.
    pub(crate) fn orbit_speed(&self) -> f64 {
        cross(self.centre, self.velocity) / self.centre.norm_squared()
    }
}

/// A ring that may lean, as its contacts meet it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LeaningRing {
    pub rotation: Rotation,
    /// Its centre of mass \[m\].
    centre: Vector3<f64>,
    /// Of the centre of mass \[m/s\].
    velocity: Vector3<f64>,
    /// Its angular velocity, in its own frame \[rad/s\].
    turning: Vector3<f64>,
    /// Axial place of the centre of mass in its frame \[m\].
    offset: f64,
    theta: f64,
}

impl LeaningRing {
    /// Of a ring whose places x, y and z tell how far its centre of mass is from where it nominally is, an axial place of the
    /// ring's frame \[m\].
    pub fn new(motion: &Motion, rotation: Rotation, offset: f64) -> Self {
        Self {
            rotation,
            centre: Vector3::new(motion.centre.x, motion.centre.y, motion.z + offset),
            velocity: Vector3::new(motion.velocity.x, motion.velocity.y, motion.vz),
            turning: rotation.frame.to_ring(&rotation.angular_velocity()),
            offset,
            theta: motion.theta,
        }
    }

    /// From the centre of mass to a ball's centre, in the scene's frame \[m\].
    pub fn arm(&self, ball: &Motion) -> Vector3<f64> {
        Vector3::new(ball.centre.x, ball.centre.y, ball.z) - self.centre
    }

    /// What a moment across the ring's axis, in its frame, does about z of the scene: there a ball's caps turn with it.
    pub fn across(&self, moment: &V2) -> f64 {
        let [x, y] = self.rotation.frame.tilt;
        x * moment.y - y * moment.x
    }

    /// A ball, whose spin each of its contacts takes to be about the axis of the ring it touches, and this ring, both as who
    /// turns with the ring sees them in its frame: the ring stands still, its mark at θ.
    pub fn facing(&self, ball: &Motion) -> [Motion; 2] {
        let frame = &self.rotation.frame;
        let place = frame.to_ring(&self.arm(ball));
        let velocity = Vector3::new(ball.velocity.x, ball.velocity.y, ball.vz) - self.velocity;
        let velocity = frame.to_ring(&velocity) - self.turning.cross(&place);
        let seen = Motion {
            centre: place.xy(),
            z: place.z + self.offset,
            theta: ball.theta,
            velocity: velocity.xy(),
            vz: velocity.z,
            omega: ball.omega - self.turning.z,
            across: -self.turning.xy(),
            seen_by: Some(frame.tilt),
        };
        let own = Motion {
            theta: self.theta,
            ..Motion::default()
        };
        [seen, own]
    }
}

/// Centrifugal force on a mass \[kg\] that rests in the cage's frame, over its radius \[N/m\].
pub(crate) fn centrifugal(mass: f64, orbit_speed: f64) -> f64 {
    mass * orbit_speed * orbit_speed
}
