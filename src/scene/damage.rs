//! Kinds of damage of a surface, each with its numbers and what it may lie on; and the flat document that a defect is.
//!
//! A new kind is a variant here and a file in `contact/damage/`: the compiler asks for the rest.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::absent;
use super::numbers::BoundedNumber;
use super::surface::{AxialOffset, Surface};
use super::width::{Floor, Width};

/// Damage of a surface.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Damage {
    /// The surface is absent over a length along the axis and a width along rolling; fault circles stand at its edges.
    Patch {
        /// Axial length L_f \[m\].
        length: f64,
        /// Width w, arc length along the surface \[m\]; a number or a profile along z.
        width: Width,
        /// Radius R_f of the fault circles at the edges \[m\].
        edge_radius: f64,
        /// Recessed circles between the edges; absent: no floor.
        floor: Option<Floor>,
    },
    /// A patch between steep walls. A contact carries load until half of it is over the wall. Fault circles with a radius of a quarter of
    /// the ball's diameter, further apart than `width` by the half-width of the most loaded contact that meets the defect at the
    /// equilibrium, unload contacts as boundary-element solutions do: a scene that is compiled has that [`Self::Patch`] in its place, and
    /// a run records it. A defect narrower than 1.25 contacts is refused.
    SteepPatch {
        /// Axial length L_f \[m\].
        length: f64,
        /// Width w from wall to wall, arc length along the surface \[m\].
        width: f64,
        /// Recessed circles between the edges; absent: no floor.
        floor: Option<Floor>,
    },
    /// A circle on a ball's surface, `width` wide along the surface in every direction, less than the ball's radius, in which the surface
    /// is absent. The direction from the ball's centre to its middle is fixed in the ball: at `angle` about z, with `axial_offset` the
    /// axial place of the middle.
    Cap {
        /// Width along the surface \[m\].
        width: f64,
        /// Radius R_f of the fault circles at the rim \[m\].
        edge_radius: f64,
        /// Recessed circles within; absent: no floor.
        floor: Option<Floor>,
    },
    /// A hole smaller than its contact, into which the surfaces bulge so that the contact loses part of its load: an ellipse so deep that
    /// nothing meets its floor, with sharp edges.
    Pit {
        /// Extent along rolling \[m\].
        width: f64,
        /// Extent across \[m\]; absent: round.
        length: Option<f64>,
    },
    /// A dent with a raised rim, as a hard particle leaves it, smaller than its contact: an ellipse into which the surfaces bulge down to its
    /// floor, and around it, out to [`RIM`] times its size, what was pushed out of it.
    Dent {
        /// Extent along rolling at the level of the surface \[m\].
        width: f64,
        /// Extent across \[m\]; absent: round.
        length: Option<f64>,
        /// Depth in the middle \[m\].
        depth: f64,
        /// Height of the rim's crest \[m\]; 0: no rim.
        rim_height: f64,
    },
}

/// Size of a dent with its rim over that of the dent.
pub const RIM: f64 = 1.5;

/// Description of a kind of damage by itself.
struct About<'a> {
    /// Name of the kind.
    word: &'static str,
    lies: Lies,
    /// Size along rolling \[m\].
    width: Cow<'a, Width>,
    /// Size along the axis \[m\]; none of what is round.
    length: Option<f64>,
    /// Radius of its fault circles \[m\]; none of what has none, or not yet.
    edge_radius: Option<f64>,
    floor: Option<&'a Floor>,
    /// Finest length of what is smaller than the contacts that meet it: half of it along rolling \[m\].
    finest: Option<f64>,
    /// Size of all that is not level over its own.
    around: f64,
    /// Numbers beside width, length, edge radius and floor, with what is allowed.
    numbers: Vec<BoundedNumber>,
}

/// How a damage lies on a surface.
#[derive(PartialEq)]
enum Lies {
    /// Damage that lies with its length along the ring's axis, also on a ball.
    AlongAxis,
    /// Damage that lies anywhere on a race, or fixed in a ball.
    Anywhere,
    /// Fixed in a ball.
    OnBall,
}

impl Damage {
    /// Answers of each kind, one arm for each: what the rest of a scene asks.
    fn about(&self) -> About<'_> {
        let plain = |word, lies, width: f64| About {
            word,
            lies,
            width: Cow::Owned(width.into()),
            length: None,
            edge_radius: None,
            floor: None,
            finest: None,
            around: 1.0,
            numbers: Vec::new(),
        };
        match self {
            Self::Patch {
                length,
                width,
                edge_radius,
                floor,
            } => About {
                width: Cow::Borrowed(width),
                length: Some(*length),
                edge_radius: Some(*edge_radius),
                floor: floor.as_ref(),
                ..plain("patch", Lies::AlongAxis, 0.0)
            },
            Self::SteepPatch {
                length,
                width,
                floor,
            } => About {
                length: Some(*length),
                floor: floor.as_ref(),
                ..plain("patch", Lies::AlongAxis, *width)
            },
            Self::Cap {
                width,
                edge_radius,
                floor,
            } => About {
                edge_radius: Some(*edge_radius),
                floor: floor.as_ref(),
                ..plain("cap", Lies::OnBall, *width)
            },
            Self::Pit { width, length } => About {
                length: *length,
                finest: Some(width / 2.0),
                ..plain("pit", Lies::Anywhere, *width)
            },
            Self::Dent {
                width,
                length,
                depth,
                rim_height,
            } => About {
                length: *length,
                finest: Some((RIM - 1.0) * width / 2.0),
                around: RIM,
                numbers: vec![
                    BoundedNumber::within("depth", *depth, 0.0..=1e-3, "m"),
                    BoundedNumber::within("rim_height", *rim_height, 0.0..=1e-4, "m"),
                ],
                ..plain("dent", Lies::Anywhere, *width)
            },
        }
    }

    /// Gives it an extent along rolling \[m\], the same over its length.
    pub fn set_width(&mut self, to: f64) {
        match self {
            Self::Patch { width, .. } => *width = to.into(),
            Self::SteepPatch { width, .. }
            | Self::Cap { width, .. }
            | Self::Pit { width, .. }
            | Self::Dent { width, .. } => *width = to,
        }
    }

    /// The largest extent along rolling \[m\].
    pub fn width(&self) -> f64 {
        self.about().width.largest()
    }

    /// The extent along rolling over the length.
    pub(crate) fn width_along(&self) -> Cow<'_, Width> {
        self.about().width
    }

    /// The length that it has beside its width \[m\]; none of what is round.
    pub(crate) fn length(&self) -> Option<f64> {
        self.about().length
    }

    /// Extent along the axis \[m\]; of a cap its width, which is a little more.
    pub(crate) fn extent(&self) -> f64 {
        self.length().unwrap_or_else(|| self.width())
    }

    /// Extents along rolling and along the axis, with all that is not level \[m\].
    pub(super) fn footprint(&self) -> [f64; 2] {
        [self.width(), self.extent()].map(|size| self.about().around * size)
    }

    /// Half of the finest length along rolling of what is smaller than the contacts that meet it: these bulge into it and keep most of
    /// their load, and steps must see it \[m\]. None of what is larger.
    pub(crate) fn finest(&self) -> Option<f64> {
        self.about().finest
    }

    /// Whether the damage is smaller than the contacts that meet it.
    pub(crate) fn is_small(&self) -> bool {
        self.finest().is_some()
    }

    /// Whether the damage has its length along the ring's axis, also on a ball.
    pub(crate) fn is_patch(&self) -> bool {
        self.about().lies == Lies::AlongAxis
    }

    /// Whether balls alone have it.
    pub(super) fn is_of_balls(&self) -> bool {
        self.about().lies == Lies::OnBall
    }

    /// Name of the damage's kind.
    pub(crate) fn word(&self) -> &'static str {
        self.about().word
    }

    /// Radius of its fault circles \[m\]; none of what has none, or not yet.
    pub(super) fn edge_radius(&self) -> Option<f64> {
        self.about().edge_radius
    }

    /// Floor of the damage.
    pub(super) fn floor(&self) -> Option<&Floor> {
        self.about().floor
    }

    /// Numbers of its own, in addition to width, length, edge radius and floor.
    pub(super) fn numbers(&self) -> Vec<BoundedNumber> {
        self.about().numbers
    }
}

/// A defect in a document: the fields of its place, and beside them those of its damage, whose kind `shape` and `walls` say.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DefectDocument {
    pub on: Surface,
    #[serde(default)]
    pub row: usize,
    #[serde(default)]
    pub ball: Option<usize>,
    pub angle: f64,
    #[serde(default)]
    pub axial_offset: AxialOffset,
    /// Absent: a patch.
    #[serde(default, skip_serializing_if = "absent::none")]
    shape: Option<ShapeWord>,
    /// 0 or absent for a cap, which is as long as it is wide, and for what is round.
    #[serde(default)]
    length: f64,
    width: Width,
    /// 0 or absent where the shape has none, and with walls, which set it.
    #[serde(default)]
    edge_radius: f64,
    /// Absent: a patch with the given edges.
    #[serde(default, skip_serializing_if = "absent::none")]
    walls: Option<WallsWord>,
    #[serde(default)]
    floor: Option<Floor>,
    #[serde(default, skip_serializing_if = "absent::none")]
    depth: Option<f64>,
    #[serde(default, skip_serializing_if = "absent::none")]
    rim_height: Option<f64>,
}

/// The word for a kind that is no patch.
#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum ShapeWord {
    Cap,
    Pit,
    Dent,
}

/// The word for walls of a patch.
#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum WallsWord {
    Steep,
}

/// A field that a kind of damage does not have as it is given, and what is allowed of it.
pub(super) type Misfit = (&'static str, &'static str);

impl DefectDocument {
    /// Damage that lies there.
    pub fn damage(&self) -> Result<Damage, Misfit> {
        let is_dent = matches!(self.shape, Some(ShapeWord::Dent));
        for (field, given) in [("depth", self.depth), ("rim_height", self.rim_height)] {
            if given.is_some() && !is_dent {
                return Err((field, "absent but for a dent"));
            }
        }
        match (self.shape, self.walls) {
            (None, None) => Ok(Damage::Patch {
                length: self.length,
                width: self.width.clone(),
                edge_radius: self.edge_radius,
                floor: self.floor.clone(),
            }),
            (None, Some(WallsWord::Steep)) => {
                let allowed = "absent with steep walls, from which it follows";
                self.is_without_edge(allowed)?;
                Ok(Damage::SteepPatch {
                    length: self.length,
                    width: self.one_width("one number with steep walls")?,
                    floor: self.floor.clone(),
                })
            }
            (Some(_), Some(WallsWord::Steep)) => {
                Err(("walls", "absent for a cap, a pit or a dent"))
            }
            (Some(ShapeWord::Cap), None) => {
                if self.length != 0.0 {
                    let allowed = "absent for a cap, which is as long as it is wide";
                    return Err(("length", allowed));
                }
                Ok(Damage::Cap {
                    width: self.one_width("one number for a cap")?,
                    edge_radius: self.edge_radius,
                    floor: self.floor.clone(),
                })
            }
            (Some(ShapeWord::Pit), None) => {
                self.is_without_edge("absent for a pit, whose edge is sharp")?;
                self.is_without_floor("absent for a pit, whose floor no contact meets")?;
                Ok(Damage::Pit {
                    width: self.one_width("one number for a pit")?,
                    length: self.length_if_any(),
                })
            }
            (Some(ShapeWord::Dent), None) => {
                self.is_without_edge("absent for a dent, which has a rim")?;
                self.is_without_floor("absent for a dent, whose floor is its depth")?;
                Ok(Damage::Dent {
                    width: self.one_width("one number for a dent")?,
                    length: self.length_if_any(),
                    depth: self.depth.ok_or(("depth", "the depth of the dent [m]"))?,
                    rim_height: self.rim_height.unwrap_or(0.0),
                })
            }
        }
    }

    /// The width of what has the same along its length.
    fn one_width(&self, allowed: &'static str) -> Result<f64, Misfit> {
        match self.width {
            Width::Constant(width) => Ok(width),
            Width::Profile(_) => Err(("width", allowed)),
        }
    }

    fn is_without_edge(&self, allowed: &'static str) -> Result<(), Misfit> {
        if self.edge_radius == 0.0 {
            Ok(())
        } else {
            Err(("edge_radius", allowed))
        }
    }

    fn is_without_floor(&self, allowed: &'static str) -> Result<(), Misfit> {
        if self.floor.is_none() {
            Ok(())
        } else {
            Err(("floor", allowed))
        }
    }

    /// The length of what is round without one.
    fn length_if_any(&self) -> Option<f64> {
        (self.length != 0.0).then_some(self.length)
    }
}

impl DefectDocument {
    /// The record of a place, surface, row, ball, angle and axial place, and what lies there.
    pub fn new(
        on: Surface,
        row: usize,
        ball: Option<usize>,
        angle: f64,
        axial_offset: AxialOffset,
        damage: &Damage,
    ) -> Self {
        let (shape, walls) = match damage {
            Damage::Patch { .. } => (None, None),
            Damage::SteepPatch { .. } => (None, Some(WallsWord::Steep)),
            Damage::Cap { .. } => (Some(ShapeWord::Cap), None),
            Damage::Pit { .. } => (Some(ShapeWord::Pit), None),
            Damage::Dent { .. } => (Some(ShapeWord::Dent), None),
        };
        let (depth, rim_height) = match *damage {
            Damage::Dent {
                depth, rim_height, ..
            } => (Some(depth), Some(rim_height)),
            Damage::Patch { .. }
            | Damage::SteepPatch { .. }
            | Damage::Cap { .. }
            | Damage::Pit { .. } => (None, None),
        };
        Self {
            on,
            row,
            ball,
            angle,
            axial_offset,
            shape,
            length: damage.length().unwrap_or(0.0),
            width: damage.width_along().into_owned(),
            edge_radius: damage.edge_radius().unwrap_or(0.0),
            walls,
            floor: damage.floor().cloned(),
            depth,
            rim_height,
        }
    }
}
