//! Moments on the rings about x and y, which the constraint of a ring that is held parallel carries.

use nalgebra::Vector3;

use super::contacts::{ContactSummary, Summary, visit};
use crate::contact::{
    ContactForce, Motion, OilForce, PointForce, Sink, TiltedRing, Wrench, WrenchSum,
};
use crate::forces::load;
use crate::model::{BodyId, Model, Race};

/// Names of the columns of [`moments`].
pub(crate) const MOMENTS: [&str; 4] = ["outer.x", "outer.y", "inner.x", "inner.y"];

/// Moments about x and y that balls and loads put on outer and inner ring at a time \[s\], each about its centre of mass and across
/// its axis \[N m\]: of the balls a sum over contacts of −(c_b − c_r) × f, less what turns them. What keeps the ring from tilting
/// carries them.
pub(crate) fn moments(model: &Model, t: f64, y: &[f64]) -> [[f64; 2]; 2] {
    Race::BOTH.map(|race| {
        let mut sum = MomentOnRing::new(model, y, race);
        for j in 0..model.balls.len() {
            let mut on_ball = WrenchSum::default();
            visit(model, y, j, race, &mut on_ball);
            sum.add(y, j, &on_ball.wrench);
        }
        sum.with_loads(t)
    })
}

/// Wrench of the balls on a ring in a state of all bodies: force along x, y and z \[N\], moment about the ring's centre of mass \[N m\].
pub(crate) fn wrench(model: &Model, y: &[f64], race: Race) -> [f64; 6] {
    let mut sum = MomentOnRing::new(model, y, race);
    let mut force = Vector3::zeros();
    for j in 0..model.balls.len() {
        let mut on_ball = WrenchSum::default();
        visit(model, y, j, race, &mut on_ball);
        force -= sum.ring.rotation.frame.to_scene(&on_ball.wrench.force);
        sum.add(y, j, &on_ball.wrench);
    }
    let [x, y, z] = force.into();
    let [about_x, about_y, about_z] = sum.sum.into();
    [x, y, z, about_x, about_y, about_z]
}

/// Wrenches of a contact on ball `j` and on its ring, wherever both are and however they move, in the scene's frame: on the ball about
/// its centre, on the ring about its centre of mass.
pub(crate) fn between(
    model: &Model,
    j: usize,
    race: Race,
    ball: &Motion,
    ring: &TiltedRing,
) -> [Wrench; 2] {
    let compiled = &model.balls[j];
    let [at, standing] = ring.facing(ball);
    let mut sum = WrenchSum::default();
    model.rows[compiled.row].pairs[race].evaluate(&compiled.side, &at, &standing, &mut sum);
    let [on_ball, _] = sum.on_bodies(&at.place(), Some(ring));
    let in_scene = sum.wrench.turned(|v| ring.rotation.frame.to_scene(v));
    [on_ball, in_scene.on_ring(&ring.arm(ball))]
}

/// The moment on a ring, ball by ball.
pub(crate) struct MomentOnRing<'m> {
    model: &'m Model,
    race: Race,
    ring: TiltedRing,
    sum: Vector3<f64>,
}

impl<'m> MomentOnRing<'m> {
    /// The sum without any ball yet.
    pub fn new(model: &'m Model, y: &[f64], race: Race) -> Self {
        Self {
            model,
            race,
            ring: model.tilted(y, race),
            sum: Vector3::zeros(),
        }
    }

    fn add(&mut self, y: &[f64], j: usize, on_ball: &Wrench) {
        let ball = self.model.layout().motion(y, BodyId::ball(j));
        let frame = &self.ring.rotation.frame;
        let on_ball = on_ball.turned(|v| frame.to_scene(v));
        self.sum += on_ball.on_ring(&self.ring.arm(&ball)).moment;
    }

    /// Adds a ball, and returns the few numbers of its contact.
    pub fn add_and_summarise(&mut self, y: &[f64], j: usize) -> ContactSummary {
        let mut both = Both::default();
        let side = visit(self.model, y, j, self.race, &mut both);
        self.add(y, j, &both.on_ball.wrench);
        both.summary.contact_summary(self.race, side)
    }

    /// The moments with the loads at a time \[s\], about x and y and across the ring's axis \[N m\].
    pub fn with_loads(&self, t: f64) -> [f64; 2] {
        let frame = &self.ring.rotation.frame;
        let loads = load::moment(self.model, t, self.race, |arm| frame.to_scene(arm));
        let (sum, axis) = (self.sum + loads, frame.axis());
        let across = sum - axis * sum.dot(&axis);
        [across.x, across.y]
    }
}

/// A contact in a few numbers, and what it does to its ball.
#[derive(Default)]
struct Both {
    summary: Summary,
    on_ball: WrenchSum,
}

impl Sink for Both {
    fn force(&mut self, force: &ContactForce) {
        self.summary.force(force);
        self.on_ball.force(force);
    }

    fn point(&mut self, force: &PointForce) {
        self.on_ball.point(force);
    }

    fn oil(&mut self, oil: &OilForce) {
        self.on_ball.oil(oil);
    }
}
