//! What the forces of a contact add up to.

use nalgebra::Vector3;

use super::add;
use crate::contact::{Aside, LeaningRing, OilTouch, Sink, Touch, V2, Wrench};
use crate::model::DOFS;

/// Force and moment on ball and ring.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sum {
    pub ball: [f64; DOFS],
    pub ring: [f64; DOFS],
    pub pulls: u32,
    pub truncated: bool,
}

impl Sink for Sum {
    fn touch(&mut self, touch: &Touch) {
        let (ball, ring) = touch.wrenches(touch.normal, 1.0);
        add(&mut self.ball, &ball);
        add(&mut self.ring, &ring);
        self.pulls += u32::from(touch.pull);
    }

    fn aside(&mut self, force: &Aside) {
        let (ball, ring) = force.wrenches();
        add(&mut self.ball, &ball);
        add(&mut self.ring, &ring);
    }

    fn oil(&mut self, touch: &OilTouch) {
        let (ball, ring) = touch.wrenches();
        add(&mut self.ball, &ball);
        add(&mut self.ring, &ring);
    }

    fn truncated(&mut self) {
        self.truncated = true;
    }
}

/// What a contact does to its ball in space, in the frame of a ring that may tilt.
#[derive(Debug, Default)]
pub(super) struct Spatial {
    wrench: Wrench,
    /// Of the moment what turns caps of the ball across the ring's axis.
    on_caps: V2,
    pulls: u32,
    truncated: bool,
}

impl Spatial {
    /// The same on a ball at a place of the ring's frame, in the scene's frame, and on the ring, in its own; and moments about x and y
    /// on both. Moments on balls that do not spin freely act about the ring's axis, but for those on caps.
    pub fn on_bodies(&self, place: &Vector3<f64>, ring: &LeaningRing) -> (Sum, [[f64; 2]; 2]) {
        let (force, on_ring) = (&self.wrench.force, self.wrench.moment_on_ring(place));
        let [on_scene, on_ball] = self.wrench.on_ball(ring, &self.on_caps);
        let [x, y, z] = on_scene.into();
        let sum = Sum {
            ball: [x, y, z, on_ball.z],
            ring: [-force.x, -force.y, -force.z, on_ring.z],
            pulls: self.pulls,
            truncated: self.truncated,
        };
        (sum, [[on_ball.x, on_ball.y], [on_ring.x, on_ring.y]])
    }
}

impl Sink for Spatial {
    fn touch(&mut self, touch: &Touch) {
        self.wrench.add(&touch.on_ball(touch.normal, 1.0));
        self.on_caps += touch.on_cap(touch.normal);
        self.pulls += u32::from(touch.pull);
    }

    fn aside(&mut self, force: &Aside) {
        self.wrench.add(&force.on_ball());
        self.on_caps += force.on_cap();
    }

    fn oil(&mut self, touch: &OilTouch) {
        self.wrench.add(&touch.on_ball());
    }

    fn truncated(&mut self) {
        self.truncated = true;
    }
}

/// Force and moment on ball and ring, with the parts of elastic force, damping and friction apart.
#[derive(Default)]
pub(super) struct SumsByOrigin {
    ball: [[f64; DOFS]; 3],
    ring: [[f64; DOFS]; 3],
}

impl SumsByOrigin {
    /// Names of the three.
    pub const NAMES: [&str; 3] = ["contact", "damping", "friction"];

    /// (on the ball, on the ring) for elastic force, damping and friction.
    pub fn wrenches(self) -> impl Iterator<Item = ([f64; DOFS], [f64; DOFS])> {
        self.ball.into_iter().zip(self.ring)
    }
}

impl Sink for SumsByOrigin {
    fn touch(&mut self, touch: &Touch) {
        let parts = [
            (touch.elastic, 0.0),
            (touch.normal - touch.elastic, 0.0),
            (0.0, 1.0),
        ];
        for (i, (normal, friction)) in parts.into_iter().enumerate() {
            let (ball, ring) = touch.wrenches(normal, friction);
            add(&mut self.ball[i], &ball);
            add(&mut self.ring[i], &ring);
        }
    }

    fn aside(&mut self, force: &Aside) {
        let (ball, ring) = force.wrenches();
        add(&mut self.ball[0], &ball);
        add(&mut self.ring[0], &ring);
    }

    fn oil(&mut self, touch: &OilTouch) {
        let (ball, ring) = touch.wrenches();
        add(&mut self.ball[2], &ball);
        add(&mut self.ring[2], &ring);
    }
}
