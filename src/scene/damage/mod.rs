//! Damage of a surface: kinds with their numbers, each of which has one of few forms; and the flat document that a defect is.
//!
//! A kind is what a user says, its [`Form`] what contacts meet: `contact/damage/` compiles forms. A new kind of a form that is there is a
//! struct in `kinds` and a variant here, with its words and fields in a document: the compiler asks for these.

mod kinds;

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::absent;
use super::numbers::{BoundedNumber, PartNumbers, UNSAID};
use super::surface::{AxialOffset, Surface};
use super::width::{Floor, Width};

pub use kinds::*;

/// Damage of a surface.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Damage {
    /// A surface that is absent between fault circles.
    Patch(Patch),
    /// A patch between steep walls.
    SteepPatch(SteepPatch),
    /// A circle on a ball in which its surface is absent.
    Cap(Cap),
    /// A hole smaller than its contact.
    Pit(Pit),
    /// A dent with a raised rim.
    Dent(Dent),
}

/// Size of a dent with its rim over that of the dent.
pub const RIM: f64 = 1.5;

/// A kind of damage: all that the rest of a scene asks of it.
trait DamageKind {
    /// Description of it.
    fn about(&self) -> About<'_>;

    /// Gives it an extent along rolling \[m\], the same over its length.
    fn set_width(&mut self, to: f64);
}

/// Description of a kind of damage by itself.
struct About<'a> {
    /// Name of the kind.
    word: &'static str,
    form: Form<'a>,
    /// Numbers of its own, but for a width along its length and a floor.
    numbers: Vec<BoundedNumber>,
}

/// Form of a damage, by which it acts on contacts.
pub(crate) enum Form<'a> {
    /// The surface is absent over a length along the ring's axis, also on a ball, and a width along rolling \[m\], between fault
    /// circles; their radius \[m\] is absent as long as it follows from walls.
    Slot {
        length: f64,
        width: Cow<'a, Width>,
        edge_radius: Option<f64>,
        floor: Option<&'a Floor>,
    },
    /// The surface is absent within a circle that is fixed in a ball, so wide along its surface, between fault circles \[m\].
    Circle {
        width: f64,
        edge_radius: f64,
        floor: Option<&'a Floor>,
    },
    /// An ellipse smaller than its contact, anywhere on a race or fixed in a ball: its size along rolling and, unless it is round, across,
    /// its depth, infinite where nothing meets its floor, and the height of a rim out to [`RIM`] times its size, if it has one \[m\].
    Recess {
        width: f64,
        length: Option<f64>,
        depth: f64,
        rim_height: Option<f64>,
    },
}

/// Says of each kind what has an arm for each.
macro_rules! kinds {
    ($($kind:ident),*) => {
        $(impl From<$kind> for Damage {
            fn from(of: $kind) -> Self {
                Self::$kind(of)
            }
        })*

        impl Damage {
            fn kind(&self) -> &dyn DamageKind {
                match self {
                    $(Self::$kind(of) => of,)*
                }
            }

            fn kind_mut(&mut self) -> &mut dyn DamageKind {
                match self {
                    $(Self::$kind(of) => of,)*
                }
            }
        }

        /// Numbers of all kinds, for the schema.
        pub(super) fn parts() -> Vec<PartNumbers> {
            vec![$((stringify!($kind), $kind::of_width(UNSAID).about().numbers)),*]
        }
    };
}

kinds!(Patch, SteepPatch, Cap, Pit, Dent);

impl Damage {
    /// Gives it an extent along rolling \[m\], the same over its length.
    pub fn set_width(&mut self, to: f64) {
        self.kind_mut().set_width(to);
    }

    /// The largest extent along rolling \[m\].
    pub fn width(&self) -> f64 {
        self.width_along().largest()
    }

    /// Form of the damage, by which it acts on contacts.
    pub(crate) fn form(&self) -> Form<'_> {
        self.kind().about().form
    }

    /// The extent along rolling over the length.
    pub(crate) fn width_along(&self) -> Cow<'_, Width> {
        match self.form() {
            Form::Slot { width, .. } => width,
            Form::Circle { width, .. } | Form::Recess { width, .. } => Cow::Owned(width.into()),
        }
    }

    /// The length that it has beside its width \[m\]; none of what is round.
    pub(crate) fn length(&self) -> Option<f64> {
        match self.form() {
            Form::Slot { length, .. } => Some(length),
            Form::Circle { .. } => None,
            Form::Recess { length, .. } => length,
        }
    }

    /// Extent along the axis \[m\]; of a cap its width, which is a little more.
    pub(crate) fn extent(&self) -> f64 {
        self.length().unwrap_or_else(|| self.width())
    }

    /// Extents along rolling and along the axis, with all that is not level \[m\].
    pub(super) fn footprint(&self) -> [f64; 2] {
        let around = match self.form() {
            Form::Recess {
                rim_height: Some(_),
                ..
            } => RIM,
            Form::Slot { .. } | Form::Circle { .. } | Form::Recess { .. } => 1.0,
        };
        [self.width(), self.extent()].map(|size| around * size)
    }

    /// Half of the finest length along rolling of what is smaller than the contacts that meet it: these bulge into it and keep most of
    /// their load, and steps must see it \[m\]. None of what is larger.
    pub(crate) fn finest(&self) -> Option<f64> {
        match self.form() {
            Form::Slot { .. } | Form::Circle { .. } => None,
            Form::Recess {
                width, rim_height, ..
            } => Some(rim_height.map_or(width / 2.0, |_| (RIM - 1.0) * width / 2.0)),
        }
    }

    /// Whether the damage is smaller than the contacts that meet it.
    pub(crate) fn is_small(&self) -> bool {
        self.finest().is_some()
    }

    /// Whether the damage has its length along the ring's axis, also on a ball.
    pub(crate) fn is_patch(&self) -> bool {
        matches!(self.form(), Form::Slot { .. })
    }

    /// Whether balls alone have it.
    pub(super) fn is_of_balls(&self) -> bool {
        matches!(self.form(), Form::Circle { .. })
    }

    /// Name of the damage's kind.
    pub(crate) fn word(&self) -> &'static str {
        self.kind().about().word
    }

    /// Radius of its fault circles \[m\]; none of what has none, or not yet.
    pub(super) fn edge_radius(&self) -> Option<f64> {
        match self.form() {
            Form::Slot { edge_radius, .. } => edge_radius,
            Form::Circle { edge_radius, .. } => Some(edge_radius),
            Form::Recess { .. } => None,
        }
    }

    /// Floor of the damage.
    pub(super) fn floor(&self) -> Option<&Floor> {
        match self.form() {
            Form::Slot { floor, .. } | Form::Circle { floor, .. } => floor,
            Form::Recess { .. } => None,
        }
    }

    /// Numbers of its own, but for a width along its length and a floor.
    pub(super) fn numbers(&self) -> Vec<BoundedNumber> {
        self.kind().about().numbers
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
            (None, None) => Ok(Damage::Patch(Patch {
                length: self.length,
                width: self.width.clone(),
                edge_radius: self.edge_radius,
                floor: self.floor.clone(),
            })),
            (None, Some(WallsWord::Steep)) => {
                let allowed = "absent with steep walls, from which it follows";
                self.is_without_edge(allowed)?;
                Ok(Damage::SteepPatch(SteepPatch {
                    length: self.length,
                    width: self.one_width("one number with steep walls")?,
                    floor: self.floor.clone(),
                }))
            }
            (Some(_), Some(WallsWord::Steep)) => Err(("walls", "absent where a shape is given")),
            (Some(ShapeWord::Cap), None) => {
                if self.length != 0.0 {
                    let allowed = "absent for a cap, which is as long as it is wide";
                    return Err(("length", allowed));
                }
                Ok(Damage::Cap(Cap {
                    width: self.one_width("one number for a cap")?,
                    edge_radius: self.edge_radius,
                    floor: self.floor.clone(),
                }))
            }
            (Some(ShapeWord::Pit), None) => {
                self.is_without_edge("absent for a pit, whose edge is sharp")?;
                self.is_without_floor("absent for a pit, whose floor no contact meets")?;
                Ok(Damage::Pit(Pit {
                    width: self.one_width("one number for a pit")?,
                    length: self.length_if_any(),
                }))
            }
            (Some(ShapeWord::Dent), None) => {
                self.is_without_edge("absent for a dent, which has a rim")?;
                self.is_without_floor("absent for a dent, whose floor is its depth")?;
                Ok(Damage::Dent(Dent {
                    width: self.one_width("one number for a dent")?,
                    length: self.length_if_any(),
                    depth: self.depth.ok_or(("depth", "the depth of the dent [m]"))?,
                    rim_height: self.rim_height.unwrap_or(0.0),
                }))
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

    /// The record of a place, surface, row, ball, angle and axial place, and what lies there.
    pub fn new(
        on: Surface,
        row: usize,
        ball: Option<usize>,
        angle: f64,
        axial_offset: AxialOffset,
        damage: &Damage,
    ) -> Self {
        let bare = Self {
            on,
            row,
            ball,
            angle,
            axial_offset,
            shape: None,
            length: 0.0,
            width: damage.width_along().into_owned(),
            edge_radius: 0.0,
            walls: None,
            floor: None,
            depth: None,
            rim_height: None,
        };
        // What `damage` reads of each kind, and nothing else.
        match damage {
            Damage::Patch(of) => Self {
                length: of.length,
                edge_radius: of.edge_radius,
                floor: of.floor.clone(),
                ..bare
            },
            Damage::SteepPatch(of) => Self {
                walls: Some(WallsWord::Steep),
                length: of.length,
                floor: of.floor.clone(),
                ..bare
            },
            Damage::Cap(of) => Self {
                shape: Some(ShapeWord::Cap),
                edge_radius: of.edge_radius,
                floor: of.floor.clone(),
                ..bare
            },
            Damage::Pit(of) => Self {
                shape: Some(ShapeWord::Pit),
                length: of.length.unwrap_or(0.0),
                ..bare
            },
            Damage::Dent(of) => Self {
                shape: Some(ShapeWord::Dent),
                length: of.length.unwrap_or(0.0),
                depth: Some(of.depth),
                rim_height: Some(of.rim_height),
                ..bare
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Analytic: a document says of every kind all that there is.
    #[test]
    fn every_kind_is_what_its_document_says() {
        let all: [Damage; 5] = [
            Patch::of_width(1e-3).length(2e-3).edge_radius(3e-4).into(),
            SteepPatch::of_width(1e-3)
                .length(2e-3)
                .floor(Floor::new(1e-5, 3))
                .into(),
            Cap::of_width(1e-3).edge_radius(3e-4).into(),
            Pit::of_width(1e-4).length(2e-4).into(),
            Dent::of_width(1e-4).depth(8e-6).rim_height(3e-7).into(),
        ];
        assert_eq!(all.len(), parts().len(), "a kind is not here");
        for damage in all {
            let written =
                DefectDocument::new(Surface::Ball, 0, None, 0.0, AxialOffset::Contact, &damage);
            assert_eq!(written.damage(), Ok(damage));
        }
    }
}
