//! The wrench of a contact on its ball: a force through the ball's centre and a moment about it.
//!
//! Normal forces act through the ball's centre: at its own point, which lies in the race, that of a slice would turn the
//! ball about the direction of rolling, and no potential includes such a work. Friction acts at the contact. The remaining
//! forces, of waves and of the ends of defects, turn the ball about the ring's axis alone, as patches of a ball do; caps of a
//! ball turn it about all axes.

use nalgebra::Vector3;

use super::{Aside, LeaningRing, OilTouch, Tangent, Touch, V2, cross};
use crate::tilt::Frame;

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
    pub fn add(&mut self, other: &Self) {
        self.force += other.force;
        self.moment += other.moment;
    }

    /// The same in another frame, to which vectors are led.
    pub fn turned(&self, out: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Self {
        Self {
            force: out(&self.force),
            moment: out(&self.moment),
        }
    }

    /// The same in the scene's frame, on a ball before a ring that may tilt: force, and moment about the ball's centre. Balls that do not
    /// spin freely turn about the ring's axis; what acts on their caps across it, in the ring's frame, turns with them about z of the
    /// scene.
    pub fn on_ball(&self, ring: &LeaningRing, on_caps: &V2) -> [Vector3<f64>; 2] {
        let frame = &ring.rotation.frame;
        let moment = if ring.balls_turn() {
            frame.to_scene(&self.moment)
        } else {
            let [x, y] = frame.tilt;
            self.moment + Vector3::z() * (x * on_caps.y - y * on_caps.x)
        };
        [frame.to_scene(&self.force), moment]
    }

    /// The moment about the ring's own point that the ball stands at a place from: what the opposite of this does there.
    pub fn moment_on_ring(&self, place: &Vector3<f64>) -> Vector3<f64> {
        -place.cross(&self.force) - self.moment
    }
}

impl Tangent {
    /// The same in the scene's frame, of a ring that tilts.
    pub(crate) fn turned(&self, frame: &Frame) -> Self {
        Self {
            force: frame.to_scene(&self.force),
            stiffness: self.stiffness.as_ref().map(|of| frame.matrix_to_scene(of)),
        }
    }
}

impl Touch {
    /// What it does to the ball, for a share of the normal force given by its magnitude and with friction scaled by
    /// `friction` (0 or 1).
    pub(crate) fn on_ball(&self, normal: f64, friction: f64) -> Wrench {
        let pressing = self.n_e * (-normal * self.share.0);
        let rubbing = Vector3::new(self.friction.x, self.friction.y, self.friction_z) * friction;
        let arm = Vector3::new(self.arm_ball.x, self.arm_ball.y, self.zeta);
        let mut moment = arm.cross(&rubbing);
        // Nothing where the surface of the ball is whole.
        moment += self.swing * cross(self.arm_ball, pressing);
        Wrench {
            force: Vector3::new(pressing.x, pressing.y, -normal * self.share.1) + rubbing,
            moment,
        }
    }

    /// The part of the moment across the ring's axis with which a share of the normal force turns a cap.
    pub(crate) fn on_cap(&self, normal: f64) -> V2 {
        self.swing.xy() * cross(self.arm_ball, self.n_e * (-normal * self.share.0))
    }
}

impl Aside {
    /// The part of the moment across the ring's axis with which it turns a cap.
    pub(crate) fn on_cap(&self) -> V2 {
        self.swing.xy() * cross(self.arm_ball, self.plane) + self.across
    }

    /// What it does to the ball.
    pub(crate) fn on_ball(&self) -> Wrench {
        Wrench {
            force: Vector3::new(self.plane.x, self.plane.y, self.axial),
            moment: self.swing * cross(self.arm_ball, self.plane)
                + Vector3::new(self.across.x, self.across.y, 0.0),
        }
    }
}

impl OilTouch {
    /// What its rolling resistance does to the ball.
    pub(crate) fn on_ball(&self) -> Wrench {
        Wrench {
            force: Vector3::new(self.force.x, self.force.y, 0.0),
            moment: Vector3::z() * self.moment,
        }
    }
}
