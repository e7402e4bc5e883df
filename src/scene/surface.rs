//! Surface of a defect, and its place along the axis.

use serde::{Deserialize, Serialize};

use super::word;

/// The surface that carries a defect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Surface {
    /// Outer race.
    OuterRace,
    /// Inner race.
    InnerRace,
    /// A ball.
    Ball,
}

/// Axial place of a defect's middle: a number, or `"contact"`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(untagged, expecting = r#"a number [m], or "contact""#)]
#[non_exhaustive]
pub enum AxialOffset {
    /// Offset from the row's plane (races) or the ball's centre \[m\].
    At(f64),
    /// Offset at which the most loaded of the contacts runs that meet the defect over a turn of the balls, at the static equilibrium of the
    /// healthy bearing under the largest value of every load: on the outer race that of a ball at the defect's own angle, on a
    /// ball that with the race that loads it more. Without equilibrium or load it is the place of the nominal contact
    /// angle. A run records the number, rounded to nanometres.
    #[default]
    #[serde(with = "word::contact")]
    Contact,
}

impl From<f64> for AxialOffset {
    fn from(value: f64) -> Self {
        Self::At(value)
    }
}

impl AxialOffset {
    /// The number \[m\], if it is one.
    pub fn number(self) -> Option<f64> {
        match self {
            Self::At(value) => Some(value),
            Self::Contact => None,
        }
    }
}
