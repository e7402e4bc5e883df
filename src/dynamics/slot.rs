//! What a ball's two contacts put on the ball and on the rings.

use super::add;
use crate::contact::{Motion, Sink, Touch};
use crate::model::Model;

/// Sums of one ball's contacts: force and moment on the ball and on both rings.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Slot {
    pub ball: [f64; 4],
    pub rings: [[f64; 4]; 2],
    pub pulls: u32,
    pub truncated: u32,
}

impl Slot {
    pub fn fill(&mut self, model: &Model, j: usize, ball: &Motion, rings: &[Motion; 2]) {
        *self = Self::default();
        let compiled = &model.balls[j];
        for (side, pair) in model.rows[compiled.row].pairs.iter().enumerate() {
            let mut sum = Sum::default();
            pair.evaluate(&compiled.side, ball, &rings[side], &mut sum);
            add(&mut self.ball, &sum.ball);
            self.rings[side] = sum.ring;
            self.pulls += sum.pulls;
            self.truncated += u32::from(sum.truncated);
        }
    }
}

#[derive(Default)]
struct Sum {
    ball: [f64; 4],
    ring: [f64; 4],
    pulls: u32,
    truncated: bool,
}

impl Sink for Sum {
    fn touch(&mut self, touch: &Touch) {
        let (ball, ring) = touch.wrenches(touch.normal, 1.0);
        add(&mut self.ball, &ball);
        add(&mut self.ring, &ring);
        self.pulls += u32::from(touch.pull);
    }

    fn truncated(&mut self) {
        self.truncated = true;
    }
}

/// The same apart: elastic, damping, friction.
#[derive(Default)]
pub(super) struct Named {
    ball: [[f64; 4]; 3],
    ring: [[f64; 4]; 3],
}

impl Named {
    /// (on the ball, on the ring) for elastic force, damping and friction.
    pub fn wrenches(self) -> impl Iterator<Item = ([f64; 4], [f64; 4])> {
        self.ball.into_iter().zip(self.ring)
    }
}

impl Sink for Named {
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
}
