//! Moments on the rings about x and y: what holds a ring parallel has to carry them.

use nalgebra::Vector3;

use super::contacts::visit;
use crate::contact::{Aside, OilTouch, Sink, Touch, Wrench};
use crate::forces::load;
use crate::model::{BodyId, Model, Race};

/// What a contact does to its ball.
#[derive(Default)]
struct OnBall(Wrench);

impl Sink for OnBall {
    fn touch(&mut self, touch: &Touch) {
        self.0.add(&touch.on_ball(touch.normal, 1.0));
    }

    fn aside(&mut self, force: &Aside) {
        self.0.add(&force.on_ball());
    }

    fn oil(&mut self, oil: &OilTouch) {
        self.0.add(&oil.on_ball());
    }
}

/// Names of the columns of [`moments`].
pub(crate) const MOMENTS: [&str; 4] = ["outer.x", "outer.y", "inner.x", "inner.y"];

/// Moments about x and y that balls and loads put on outer and inner ring at a time \[s\], each about its centre of mass and across
/// its axis \[N m\]: of the balls a sum over contacts of −(c_b − c_r) × f, less what turns them. What keeps the ring from tilting
/// carries them.
pub fn moments(model: &Model, t: f64, y: &[f64]) -> [[f64; 2]; 2] {
    Race::BOTH.map(|race| {
        let ring = model.leaning(y, race);
        let frame = ring.rotation.frame;
        let out = |v: &Vector3<f64>| frame.to_scene(v);
        let mut sum = Vector3::zeros();
        for j in 0..model.balls.len() {
            let mut on_ball = OnBall::default();
            visit(model, y, j, race, &mut on_ball);
            let ball = model.layout().motion(y, BodyId::ball(j));
            sum += on_ball.0.turned(out).moment_on_ring(&ring.arm(&ball));
        }
        sum += load::moment(model, t, race, out);
        let axis = frame.axis();
        let across = sum - axis * sum.dot(&axis);
        [across.x, across.y]
    })
}
