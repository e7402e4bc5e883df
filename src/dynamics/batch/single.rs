//! Contacts that are evaluated one by one, since a defect or an end of a race cuts their zone.

use super::View;
use crate::dynamics::sums::{Spatial, Sum};
use crate::model::{Model, Race};

/// A contact that is evaluated by itself.
#[derive(Debug, Clone, Copy)]
pub(super) struct Single {
    pub race: Race,
    pub ball: usize,
    pub sum: Sum,
    /// Moments about x and y on a ball that spins freely, in the scene's frame, and on a ring that may tilt, in its own about its
    /// origin.
    pub across: [[f64; 2]; 2],
}

impl Single {
    pub fn new(race: Race, ball: usize) -> Self {
        Self {
            race,
            ball,
            sum: Sum::default(),
            across: [[0.0; 2]; 2],
        }
    }

    pub fn evaluate(&mut self, model: &Model, view: &View<'_>) {
        let ball = &model.balls[self.ball];
        let pair = &model.rows[ball.row].pairs[self.race];
        let motion = view.ball(self.ball);
        let Some(leaning) = view.leaning else {
            pair.evaluate_into(&ball.side, &motion, &view.ring, &mut self.sum);
            return;
        };
        let mut spatial = Spatial::default();
        pair.evaluate_into(&ball.side, &motion, &view.ring, &mut spatial);
        (self.sum, self.across) = spatial.on_bodies(&motion.place(), &leaning.ring);
    }
}
