//! Contacts that are evaluated one by one, since a defect or an end of a race cuts their zone.

use super::View;
use crate::contact::{Wrench, WrenchSum};
use crate::model::{Model, Race};

/// A contact that is evaluated by itself.
#[derive(Debug, Clone, Copy)]
pub(super) struct Single {
    pub race: Race,
    pub ball: usize,
    /// Wrench on the ball in the scene's frame.
    pub on_ball: Wrench,
    /// Wrench on the ring about its point, in its own frame where it may tilt.
    pub on_ring: Wrench,
    pub pulls: u32,
    pub truncated: bool,
}

impl Single {
    pub fn new(race: Race, ball: usize) -> Self {
        Self {
            race,
            ball,
            on_ball: Wrench::default(),
            on_ring: Wrench::default(),
            pulls: 0,
            truncated: false,
        }
    }

    pub fn evaluate(&mut self, model: &Model, view: &View<'_>) {
        let ball = &model.balls[self.ball];
        let pair = &model.rows[ball.row].pairs[self.race];
        let motion = view.ball(self.ball);
        let mut sum = WrenchSum::default();
        pair.evaluate_into(&ball.side, &motion, &view.ring, &mut sum);
        let place = motion.seen_from(&view.ring).place();
        [self.on_ball, self.on_ring] = sum.on_bodies(&place, view.tilted.map(|of| &of.ring));
        (self.pulls, self.truncated) = (sum.pulls, sum.truncated);
    }
}
