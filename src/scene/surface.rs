//! Surface of a defect, and its place along the axis.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::time::number_or_word;

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
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum AxialOffset {
    /// Offset from the row's plane (races) or the ball's centre \[m\].
    At(f64),
    /// Offset at which the most loaded of the contacts runs that meet the defect over a turn of the balls, at the static equilibrium of the
    /// healthy bearing under the largest value of every load: on the outer race that of a ball at the defect's own angle, on a
    /// ball that with the race that loads it more. Without equilibrium or load it is the place of the nominal contact
    /// angle. A run records the number, rounded to nanometres.
    #[default]
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

/// The word that a document has in place of a number.
const CONTACT: &str = "contact";

impl Serialize for AxialOffset {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::At(value) => serializer.serialize_f64(*value),
            Self::Contact => serializer.serialize_str(CONTACT),
        }
    }
}

impl<'de> Deserialize<'de> for AxialOffset {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        number_or_word(deserializer, CONTACT, Self::At, Self::Contact)
    }
}
