//! Widths and floors of defects.

use std::ops::RangeInclusive;

use serde::{Deserialize, Deserializer, Serialize};

use super::numbers::BoundedNumber;
use super::time::number_or_map;

/// Width of a defect along its length.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
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
    /// Numbers of the profile whose range depends on no other.
    pub(super) fn numbers(&self) -> Vec<BoundedNumber> {
        BoundedNumber::each("widths", &self.widths, Width::WIDTHS, "m")
    }

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
    /// Widths that are allowed \[m\].
    const WIDTHS: RangeInclusive<f64> = 0.0..=10.0;

    /// The number that the width is, where it is one.
    pub(super) fn numbers(&self) -> BoundedNumber {
        let number = match self {
            Self::Constant(width) => Some(*width),
            Self::Profile(_) => None,
        };
        BoundedNumber::new("width", number, Self::WIDTHS, "m")
    }

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
    /// Numbers of the floor whose range depends on no other.
    pub(super) fn numbers(&self) -> [BoundedNumber; 1] {
        let elements = self.elements as f64;
        [BoundedNumber::new("elements", elements, 1.0..=1e3, "")]
    }

    /// Depth of the crests \[m\] and number of circles.
    pub fn new(depth: f64, elements: usize) -> Self {
        Self { depth, elements }
    }
}
