//! How balls spin.

use serde::{Deserialize, Serialize};

use super::Scene;

/// How the balls of all rows spin.
///
/// At a contact angle α, a ball that rolls about the bearing's axis pivots in both contacts, by about Ω sin α in
/// sum: friction torque under thrust is 4 to 10 times too high, and a ball's defect always meets the same places. The axis of a ball
/// that spins freely follows from friction. At α = 0 both are the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Spin {
    /// Spin about the bearing's axis, at contacts with a ring that tilts about that ring's axis: one state for each ball.
    #[default]
    Axial,
    /// Spin about any axis: the angular velocity is a vector, three states for each ball.
    Free,
}

impl Scene {
    /// Whether balls spin about any axis.
    pub(crate) fn balls_turn(&self) -> bool {
        self.spin == Some(Spin::Free)
    }
}
