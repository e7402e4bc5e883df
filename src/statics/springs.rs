//! Springs that stand for cage and contacts in a round of the solve.

use nalgebra::Vector3;

use crate::model::{Model, Race, RowModel};

/// The cage's hold on a ball along its radius: its pull at a radius, and a stiffness that keeps a loose ball from
/// jumping between the races from one round to the next.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct CageSpring {
    force: f64,
    stiffness: f64,
    radius: f64,
}

impl CageSpring {
    /// A pull at a radius, with a stiffness there.
    pub(super) fn held(force: f64, stiffness: f64, radius: f64) -> Self {
        Self {
            force,
            stiffness,
            radius,
        }
    }

    pub(super) fn pull(&self, radius: f64) -> f64 {
        self.force - self.stiffness * (radius - self.radius)
    }

    pub(super) fn stiffness(&self) -> f64 {
        self.stiffness
    }
}

/// The approach of both contacts of a row's balls by the force: a power law through the force at the scene's typical approach.
pub(super) struct RowSpring {
    /// Approach at the outer and at the inner race over the force to the power 1/exponent.
    give: [f64; 2],
    exponent: f64,
}

impl RowSpring {
    pub(super) fn of(model: &Model, row: &RowModel) -> Self {
        let scales = &model.scales;
        let side = &model.balls[row.first].side;
        // A slice's own power, and the zone's length goes with the root.
        let exponent = row.pairs[0].law.elastic.exponent() + 0.5;
        let give = row.pairs.each_ref().map(|pair| {
            let (distance, z) = pair.seat(side.radius, scales.approach);
            let place = Vector3::new(distance, 0.0, z);
            let force = pair.tangent(side, &place).force.norm();
            // A defect may lie there.
            let force = if force > 0.0 { force } else { scales.load };
            scales.approach / force.powf(1.0 / exponent)
        });
        Self { give, exponent }
    }

    /// Approach at a race under a force.
    pub(super) fn approach(&self, race: Race, force: f64) -> f64 {
        self.give[race] * force.powf(1.0 / self.exponent)
    }

    /// The outer race's share of the approach of both.
    pub(super) fn outer_share(&self) -> f64 {
        self.give[Race::Outer] / (self.give[0] + self.give[1])
    }

    /// Force at an approach of both races together, above 0, and its slope.
    pub(super) fn force(&self, approach: f64) -> (f64, f64) {
        let force = (approach / (self.give[0] + self.give[1])).powf(self.exponent);
        (force, self.exponent * force / approach)
    }
}
