//! The wrench of a contact on its ball: a force through the ball's centre and a moment about it.
//!
//! Normal forces act through the ball's centre: at its own point, which lies in the race, that of a slice would turn the
//! ball about the direction of rolling, and no potential includes such a work. Friction acts at the contact. The remaining
//! forces, of waves and of the ends of defects, turn the ball about the ring's axis alone, as patches of a ball do; caps of a
//! ball turn it about all axes.

use nalgebra::Vector3;

use super::damage::WITH_RING_AXIS;
use super::{ContactForce, OilForce, PointForce, Sink, TiltedRing, V2, cross};

/// Force on a ball \[N\] and moment about its centre \[N m\], in the frame of its ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wrench {
    pub force: Vector3<f64>,
    pub moment: Vector3<f64>,
}

impl Default for Wrench {
    fn default() -> Self {
        Self {
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
        }
    }
}

impl Wrench {
    /// Adds another one.
    pub(crate) fn add(&mut self, other: &Self) {
        self.force += other.force;
        self.moment += other.moment;
    }

    /// The same in another frame, to which vectors are led.
    pub(crate) fn turned(&self, out: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Self {
        Self {
            force: out(&self.force),
            moment: out(&self.moment),
        }
    }

    /// Force, and of the moment the part about z: (x, y, z, θ).
    pub fn about_axis(&self) -> [f64; 4] {
        let [x, y, z] = self.force.into();
        [x, y, z, self.moment.z]
    }

    /// The wrench on the ring: the opposite, (6) and (7), about the ring's own point, from which the ball stands at a place.
    pub(crate) fn on_ring(&self, place: &Vector3<f64>) -> Self {
        Self {
            force: -self.force,
            moment: -place.cross(&self.force) - self.moment,
        }
    }
}

/// Wrench of a contact on its ball: the sum of its single forces, in the frame of a ring that may tilt.
#[derive(Debug, Default)]
pub(crate) struct WrenchSum {
    pub wrench: Wrench,
    /// Part of the moment that turns caps of the ball across the ring's axis.
    on_caps: V2,
    pub pulls: u32,
    pub truncated: bool,
}

impl WrenchSum {
    /// Wrenches on the ball, in the scene's frame, and on the ring about its own point, from which the ball stands at a place: in its own frame where
    /// it may tilt. Balls that do not spin freely turn about the ring's axis; what acts on their caps across it, in
    /// the ring's frame, turns with them about z of the scene.
    pub fn on_bodies(&self, place: &Vector3<f64>, ring: Option<&TiltedRing>) -> [Wrench; 2] {
        let (on_ball, on_ring) = (&self.wrench, self.wrench.on_ring(place));
        let Some(ring) = ring else {
            return [*on_ball, on_ring];
        };
        let (frame, Wrench { force, moment }) = (&ring.rotation.frame, on_ball);
        let moment = if ring.balls_turn() {
            frame.to_scene(moment)
        } else {
            let ([x, y], on_caps) = (frame.tilt, &self.on_caps);
            moment + Vector3::z() * (x * on_caps.y - y * on_caps.x)
        };
        let force = frame.to_scene(force);
        [Wrench { force, moment }, on_ring]
    }

    /// Adds a force for a share of its normal part given by its magnitude, and with friction scaled by `friction` (0 or 1).
    pub fn add(&mut self, force: &ContactForce, normal: f64, friction: f64) {
        self.wrench.add(&force.on_ball(normal, friction));
        self.on_caps += force.on_cap(normal);
    }
}

impl Sink for WrenchSum {
    fn force(&mut self, force: &ContactForce) {
        self.add(force, force.normal, 1.0);
        self.pulls += u32::from(force.pull);
    }

    fn point(&mut self, force: &PointForce) {
        self.wrench.add(&force.on_ball());
        self.on_caps += force.on_cap();
    }

    fn oil(&mut self, force: &OilForce) {
        self.wrench.add(&force.on_ball());
    }

    fn truncated(&mut self) {
        self.truncated = true;
    }
}

impl ContactForce {
    /// Friction on the ball along x, y and z \[N\].
    pub fn friction_on_ball(&self) -> [f64; 3] {
        [self.friction.x, self.friction.y, self.friction_z]
    }

    /// The wrench on the ball, for a share of the normal force given by its magnitude and with friction scaled by
    /// `friction` (0 or 1).
    pub(crate) fn on_ball(&self, normal: f64, friction: f64) -> Wrench {
        let pressing = self.n_e * (-normal * self.share.0);
        let friction = Vector3::from(self.friction_on_ball()) * friction;
        let arm = Vector3::new(self.arm_ball.x, self.arm_ball.y, self.zeta);
        let mut moment = arm.cross(&friction);
        // Nothing where the surface of the ball is whole.
        moment += self.turn_axis * cross(self.arm_ball, pressing);
        Wrench {
            force: Vector3::new(pressing.x, pressing.y, -normal * self.share.1) + friction,
            moment,
        }
    }

    /// The part of the moment across the ring's axis with which a share of the normal force turns a cap.
    fn on_cap(&self, normal: f64) -> V2 {
        self.turn_axis.xy() * cross(self.arm_ball, self.n_e * (-normal * self.share.0))
    }
}

impl PointForce {
    /// A force in the plane and along z at a point, given from the ball's centre.
    pub(crate) fn at(arm_ball: V2, plane: V2, axial: f64) -> Self {
        Self {
            plane,
            axial,
            arm_ball,
            turn_axis: WITH_RING_AXIS,
            across: V2::zeros(),
        }
    }

    /// The part of the moment across the ring's axis with which it turns a cap.
    fn on_cap(&self) -> V2 {
        self.turn_axis.xy() * cross(self.arm_ball, self.plane) + self.across
    }

    /// The wrench on the ball.
    pub(crate) fn on_ball(&self) -> Wrench {
        Wrench {
            force: Vector3::new(self.plane.x, self.plane.y, self.axial),
            moment: self.turn_axis * cross(self.arm_ball, self.plane)
                + Vector3::new(self.across.x, self.across.y, 0.0),
        }
    }
}

impl OilForce {
    /// The wrench of the rolling resistance on the ball.
    pub(crate) fn on_ball(&self) -> Wrench {
        Wrench {
            force: Vector3::new(self.force.x, self.force.y, 0.0),
            moment: Vector3::z() * self.moment,
        }
    }
}
