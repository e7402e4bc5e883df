//! The load of a contact within a defect.

use crate::contact::{BallSide, ContactForce, Motion, Pair, Sink, SurfaceDefect};

/// A defect as a contact sees it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DefectContact<'a> {
    pub defect: &'a SurfaceDefect,
    /// Whether the ball has it, and not the race.
    pub on_ball: bool,
    /// How far the contact's direction is from the defect's \[rad\].
    pub offset: f64,
    /// How the ball stands.
    pub ball: &'a Motion,
}

/// Normal force of a contact that stands over a defect \[N\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LoadWithin {
    /// Load of all slices.
    pub load: f64,
    /// Load of the slices where the surface is absent.
    pub within: f64,
    /// Axial place of the middle of all force, in the frame of the defect's body \[m\]; NaN without load.
    pub place: f64,
}

struct LoadSum<'a> {
    defect: &'a DefectContact<'a>,
    radius: f64,
    pair: &'a Pair,
    load: f64,
    within: f64,
    moment: f64,
}

impl Sink for LoadSum<'_> {
    fn force(&mut self, force: &ContactForce) {
        let (place, radius) = if self.defect.on_ball {
            let square = self.radius * self.radius - force.zeta * force.zeta;
            (force.zeta, square.max(0.0).sqrt())
        } else {
            let at = self.pair.radius_at(force.z);
            (force.z, at.unwrap_or(self.pair.race.a))
        };
        self.load += force.normal;
        self.moment += force.normal * place;
        let DefectContact {
            defect,
            offset,
            ball,
            ..
        } = self.defect;
        if defect.covers(place, radius, *offset, ball) {
            self.within += force.normal;
        }
    }
}

impl Pair {
    /// The load of a ball and the race of its ring, and how much of it is within a defect.
    pub(crate) fn load_within(
        &self,
        ball: &BallSide,
        b: &Motion,
        r: &Motion,
        defect: &DefectContact<'_>,
    ) -> LoadWithin {
        let mut sum = LoadSum {
            defect,
            radius: ball.radius,
            pair: self,
            load: 0.0,
            within: 0.0,
            moment: 0.0,
        };
        self.evaluate(ball, b, r, &mut sum);
        LoadWithin {
            load: sum.load,
            within: sum.within,
            place: sum.moment / sum.load,
        }
    }
}
