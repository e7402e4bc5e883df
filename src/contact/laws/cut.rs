//! Cut of a contact into elements, and the direction of their normal forces.

/// The line along which elements lie.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Cut {
    /// Slices of the ball's surface, each of which presses along its own normal by its penetration in the plane,
    /// s = σ (d − R(z)) + ρ ([*Slices*](crate::equations#slices)). The line is the chord that ball and groove have in common.
    BallSurface,
    /// Elements of the common tangent, which all press along the common normal by δ − κ u²/2 ([*Normal
    /// force*](crate::equations#normal-force)).
    CommonTangent {
        /// κ, curvature of the gap that the zone sees \[1/m\].
        curvature: f64,
    },
}

impl Cut {
    /// κ/2 \[1/m\]; 0 where there is none.
    pub(crate) fn half_curvature(&self) -> f64 {
        match self {
            Self::BallSurface => 0.0,
            Self::CommonTangent { curvature } => 0.5 * curvature,
        }
    }

    /// Whether all elements press along the common normal.
    pub(crate) fn is_flat(&self) -> bool {
        matches!(self, Self::CommonTangent { .. })
    }
}
