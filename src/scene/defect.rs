//! Defects: the race or ball surface is absent over an arc, and fault circles stand at its edges.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::absent;
use super::time::{number_or_map, number_or_word};

/// A defect of one body (model section 7). It turns with its body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Defect {
    /// Which surface.
    pub on: Surface,
    /// Row, from 0.
    #[serde(default)]
    pub row: usize,
    /// Ball of the row, from 0; needed for a ball defect, absent otherwise.
    #[serde(default)]
    pub ball: Option<usize>,
    /// Angular place φ_f on the body, counter-clockwise from its own x axis \[rad\].
    pub angle: f64,
    /// Axial place of the middle \[m\], from the row's plane (races) or the ball's centre; by default where contacts run.
    #[serde(default)]
    pub axial_offset: AxialOffset,
    /// Outline; absent: a patch of `length` and `width`.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub shape: Option<DefectShape>,
    /// Axial length L_f \[m\]; 0 or absent for a cap, which is as long as it is wide, and for a round pit.
    #[serde(default)]
    pub length: f64,
    /// Width w, arc length along the surface \[m\]; a number or a profile along z.
    pub width: Width,
    /// Radius R_f of the fault circles at the edges \[m\]; absent for a pit, which has none, and with `walls`, which set it.
    #[serde(default)]
    pub edge_radius: f64,
    /// Walls from which distance and radius of the fault circles follow; absent: `width` and `edge_radius` are those given.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub walls: Option<Walls>,
    /// Recessed circles between the edges; absent: no floor.
    #[serde(default)]
    pub floor: Option<Floor>,
}

impl Defect {
    /// A defect of row 0 where contacts run, without floor: its surface, angle \[rad\], axial length \[m\], width \[m\] and
    /// edge radius \[m\].
    ///
    /// ```
    /// use ballrace::scene::{Defect, Surface};
    /// let spall = Defect::new(Surface::InnerRace, 0.0, 2e-3, 1e-3, 0.3e-3);
    /// let chip = Defect::new(Surface::Ball, 0.0, 2e-3, 1e-3, 0.3e-3).on_ball(4).at_offset(0.0);
    /// assert_eq!((spall.ball, chip.ball), (None, Some(4)));
    /// ```
    pub fn new(
        on: Surface,
        angle: f64,
        length: f64,
        width: impl Into<Width>,
        edge_radius: f64,
    ) -> Self {
        Self {
            on,
            row: 0,
            ball: None,
            angle,
            axial_offset: AxialOffset::Contact,
            shape: None,
            length,
            width: width.into(),
            edge_radius,
            walls: None,
            floor: None,
        }
    }

    /// A cap of ball 0 of row 0 where contacts run, without floor: its angle \[rad\], width \[m\] and edge radius \[m\].
    ///
    /// ```
    /// use ballrace::scene::Defect;
    /// let cap = Defect::cap(0.0, 1e-3, 0.3e-3).on_ball(4).at_offset(2e-3);
    /// assert_eq!((cap.ball, cap.length), (Some(4), 0.0));
    /// ```
    pub fn cap(angle: f64, width: f64, edge_radius: f64) -> Self {
        Self {
            ball: Some(0),
            shape: Some(DefectShape::Cap),
            ..Self::new(Surface::Ball, angle, 0.0, width, edge_radius)
        }
    }

    /// A round pit of row 0 where contacts run: its surface, angle \[rad\] and diameter \[m\].
    ///
    /// ```
    /// use ballrace::scene::{Defect, Surface};
    /// let pit = Defect::pit(Surface::OuterRace, -1.57, 0.178e-3);
    /// assert_eq!((pit.length, pit.edge_radius), (0.0, 0.0));
    /// ```
    pub fn pit(on: Surface, angle: f64, diameter: f64) -> Self {
        Self {
            shape: Some(DefectShape::Pit),
            ..Self::new(on, angle, 0.0, diameter, 0.0)
        }
    }

    /// The same in another row.
    #[must_use]
    pub fn in_row(self, row: usize) -> Self {
        Self { row, ..self }
    }

    /// The same on a ball of its row.
    #[must_use]
    pub fn on_ball(self, ball: usize) -> Self {
        Self {
            ball: Some(ball),
            ..self
        }
    }

    /// Whether it is a cap of a ball.
    pub(crate) fn is_cap(&self) -> bool {
        self.shape == Some(DefectShape::Cap)
    }

    /// Whether its walls are steep.
    pub(crate) fn is_steep(&self) -> bool {
        self.walls == Some(Walls::Steep)
    }

    /// Whether it is a pit.
    pub(crate) fn is_pit(&self) -> bool {
        self.shape == Some(DefectShape::Pit)
    }

    /// How far it reaches along the axis \[m\]; of a cap its width, which is a little more.
    pub(crate) fn extent(&self) -> f64 {
        if self.is_cap() || self.is_pit() && self.length == 0.0 {
            self.width.largest()
        } else {
            self.length
        }
    }

    /// The same at another angular place \[rad\].
    #[must_use]
    pub fn at_angle(self, angle: f64) -> Self {
        Self { angle, ..self }
    }

    /// The same at an axial place of its middle \[m\].
    #[must_use]
    pub fn at_offset(self, axial_offset: impl Into<AxialOffset>) -> Self {
        Self {
            axial_offset: axial_offset.into(),
            ..self
        }
    }
}

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

/// Outline of a defect that is not a patch of its length and width.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum DefectShape {
    /// A circle on a ball's surface, `width` wide along the surface in every direction, less than the ball's radius. The direction from
    /// the ball's centre to its middle is fixed in the ball: at `angle` about z, with `axial_offset` the axial place of the middle.
    Cap,
    /// A hole smaller than its contact, into which the surfaces bulge so that the contact loses part of its load: an ellipse of `width`
    /// along rolling and `length` across, round without a length, so deep that nothing meets its floor, with sharp edges.
    Pit,
}

/// Walls of a patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Walls {
    /// Steep ones. A contact carries load until half of it is over the wall. Fault circles with a radius of a quarter of the ball's
    /// diameter, further apart than `width` by the half-width of the most loaded contact that meets the defect at the equilibrium,
    /// unload contacts as boundary-element solutions do. A defect narrower than 1.25 contacts is refused. A run records both numbers.
    Steep,
}

/// Axial place of a defect's middle: a number, or `"contact"`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum AxialOffset {
    /// From the row's plane (races) or the ball's centre \[m\].
    At(f64),
    /// Where the most loaded of the contacts runs that meet the defect over a turn of the balls, at the static equilibrium of the
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

/// Fault circles of the edge radius, evenly spaced between the edges, their crests at a depth. Their
/// forces are a bare sum: a bed of bumps rather than a smooth floor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Floor {
    /// Depth of the crests below the surface \[m\].
    pub depth: f64,
    /// Number of circles, 1 to 1000.
    pub elements: usize,
}

impl Floor {
    /// Depth of the crests \[m\] and number of circles.
    pub fn new(depth: f64, elements: usize) -> Self {
        Self { depth, elements }
    }
}

/// Width of a defect along its length.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Width {
    /// The same over the whole length \[m\].
    Constant(f64),
    /// Linear between points.
    Profile(WidthProfile),
}

/// Width given at axial places, linear between them, constant beyond.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct WidthProfile {
    /// Axial places from the defect's middle, increasing \[m\].
    pub positions: Vec<f64>,
    /// Widths \[m\].
    pub widths: Vec<f64>,
}

impl WidthProfile {
    /// Widths \[m\] at axial places from the defect's middle \[m\].
    pub fn new(positions: Vec<f64>, widths: Vec<f64>) -> Self {
        Self { positions, widths }
    }
}

impl From<WidthProfile> for Width {
    fn from(profile: WidthProfile) -> Self {
        Self::Profile(profile)
    }
}

impl From<f64> for Width {
    fn from(value: f64) -> Self {
        Self::Constant(value)
    }
}

impl Width {
    /// Width \[m\] and its slope along z at an axial place from the defect's middle \[m\]; NaN where a profile lacks widths, which
    /// [`crate::Scene::validate`] refuses.
    ///
    /// ```
    /// use ballrace::scene::{Width, WidthProfile};
    /// let w = Width::from(WidthProfile::new(vec![-1e-3, 1e-3], vec![0.0, 2e-3]));
    /// assert_eq!(w.at(0.0), (1e-3, 1.0));
    /// assert_eq!(w.at(5e-3), (2e-3, 0.0));
    /// ```
    pub fn at(&self, z: f64) -> (f64, f64) {
        match self {
            Self::Constant(width) => (*width, 0.0),
            Self::Profile(WidthProfile { positions, widths }) => {
                let width = |i: usize| widths.get(i).copied().unwrap_or(f64::NAN);
                let after = positions.partition_point(|&x| x <= z);
                if after == 0 {
                    (width(0), 0.0)
                } else if after == positions.len() {
                    (width(after - 1), 0.0)
                } else {
                    let slope = (width(after) - width(after - 1))
                        / (positions[after] - positions[after - 1]);
                    (width(after - 1) + slope * (z - positions[after - 1]), slope)
                }
            }
        }
    }

    /// The same in a mirror, z → −z.
    pub(crate) fn reversed(&self) -> Self {
        match self {
            Self::Constant(width) => Self::Constant(*width),
            Self::Profile(WidthProfile { positions, widths }) => Self::Profile(WidthProfile {
                positions: positions.iter().rev().map(|z| -z).collect(),
                widths: widths.iter().rev().copied().collect(),
            }),
        }
    }

    /// The largest width \[m\].
    pub fn largest(&self) -> f64 {
        match self {
            Self::Constant(width) => *width,
            Self::Profile(profile) => profile.widths.iter().copied().fold(0.0, f64::max),
        }
    }
}

impl Serialize for Width {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Constant(width) => serializer.serialize_f64(*width),
            Self::Profile(profile) => profile.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Width {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        number_or_map(
            deserializer,
            "a number, or { positions = [ … ], widths = [ … ] }",
            Self::Constant,
            Self::Profile,
        )
    }
}

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
