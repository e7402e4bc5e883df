//! The flat document that a defect is: the fields of its place, and beside them those of its damage.

use serde::{Deserialize, Serialize};

use super::{Cap, Damage, Dent, Patch, Pit, SteepPatch};
use crate::scene::absent;
use crate::scene::surface::{AxialOffset, Surface};
use crate::scene::width::{Floor, Width};

/// A defect in a document: the fields of its place, and beside them those of its damage, whose kind `shape` and `walls` say.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct DefectDocument {
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
pub(in crate::scene) type Misfit = (&'static str, &'static str);

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
            (Some(_), Some(WallsWord::Steep)) => {
                Err(("walls", "absent for a cap, a pit or a dent"))
            }
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
            Damage::Patch(_) => (None, None),
            Damage::SteepPatch(_) => (None, Some(WallsWord::Steep)),
            Damage::Cap(_) => (Some(ShapeWord::Cap), None),
            Damage::Pit(_) => (Some(ShapeWord::Pit), None),
            Damage::Dent(_) => (Some(ShapeWord::Dent), None),
        };
        let (depth, rim_height) = match damage {
            Damage::Dent(of) => (Some(of.depth), Some(of.rim_height)),
            Damage::Patch(_) | Damage::SteepPatch(_) | Damage::Cap(_) | Damage::Pit(_) => {
                (None, None)
            }
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
