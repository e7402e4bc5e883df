//! Defects: a damage and where it lies.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::damage::{Cap, Damage, DefectDocument, Patch, Pit};
use super::document::at_field;
use super::numbers::{ANGLES, BoundedNumber};
use super::surface::{AxialOffset, Surface};
use super::width::Width;

/// A defect of one body ([*Defects*](crate::equations#defects)). It turns with its body.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Defect {
    /// Surface on which the defect lies.
    pub on: Surface,
    /// Row, from 0.
    pub row: usize,
    /// Ball of the row, from 0; needed for a ball defect, absent otherwise.
    pub ball: Option<usize>,
    /// Angular place φ_f on the body, counter-clockwise from its own x axis \[rad\].
    pub angle: f64,
    /// Axial place of the middle \[m\], from the row's plane (races) or the ball's centre; by default where contacts run.
    pub axial_offset: AxialOffset,
    /// Damage that lies there. A document has its fields beside those of the place.
    pub damage: Damage,
}

impl Defect {
    /// Numbers of its place whose range depends on no other.
    pub(super) fn numbers(&self) -> [BoundedNumber; 1] {
        [BoundedNumber::new("angle", self.angle, ANGLES, "rad")]
    }

    /// A damage of row 0 where contacts run, of a ball on ball 0: its surface and angle \[rad\]. Sizes of the damage are given by their
    /// names.
    ///
    /// ```
    /// use ballrace::scene::{Defect, Patch, Pit, Surface};
    /// let spall = Patch::of_width(1e-3).length(2e-3).edge_radius(0.3e-3);
    /// let spall = Defect::of(spall, Surface::InnerRace, 0.0);
    /// let pit = Defect::of(Pit::of_width(0.2e-3), Surface::Ball, 0.0).on_ball(4);
    /// assert_eq!((spall.ball, pit.ball), (None, Some(4)));
    /// ```
    pub fn of(damage: impl Into<Damage>, on: Surface, angle: f64) -> Self {
        Self {
            on,
            row: 0,
            ball: (on == Surface::Ball).then_some(0),
            angle,
            axial_offset: AxialOffset::Contact,
            damage: damage.into(),
        }
    }

    /// A patch of row 0 where contacts run, without floor: its surface, angle \[rad\], axial length \[m\], width \[m\] and
    /// edge radius \[m\]. One of a ball needs [`Self::on_ball`].
    #[deprecated(
        since = "0.4.0",
        note = "is `Defect::of(Patch::of_width(…).length(…).edge_radius(…), on, angle)`, whose sizes have names; gone in 0.5"
    )]
    pub fn new(
        on: Surface,
        angle: f64,
        length: f64,
        width: impl Into<Width>,
        edge_radius: f64,
    ) -> Self {
        let patch = Patch::of_width(width)
            .length(length)
            .edge_radius(edge_radius);
        Self {
            ball: None,
            ..Self::of(patch, on, angle)
        }
    }

    /// A cap of ball 0 of row 0 where contacts run, without floor: its angle \[rad\], width \[m\] and edge radius \[m\].
    #[deprecated(
        since = "0.4.0",
        note = "is `Defect::of(Cap::of_width(…).edge_radius(…), Surface::Ball, angle)`, whose sizes have names; gone in 0.5"
    )]
    pub fn cap(angle: f64, width: f64, edge_radius: f64) -> Self {
        let cap = Cap::of_width(width).edge_radius(edge_radius);
        Self::of(cap, Surface::Ball, angle)
    }

    /// A round pit of row 0 where contacts run: its surface, angle \[rad\] and diameter \[m\]. One of a ball needs [`Self::on_ball`].
    #[deprecated(
        since = "0.4.0",
        note = "is `Defect::of(Pit::of_width(…), on, angle)`; gone in 0.5"
    )]
    pub fn pit(on: Surface, angle: f64, diameter: f64) -> Self {
        Self {
            ball: None,
            ..Self::of(Pit::of_width(diameter), on, angle)
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

impl Serialize for Defect {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self {
            on,
            row,
            ball,
            angle,
            axial_offset,
            ref damage,
        } = *self;
        DefectDocument::new(on, row, ball, angle, axial_offset, damage).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Defect {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let document = DefectDocument::deserialize(deserializer)?;
        let misfit = |(field, allowed): (_, &str)| at_field(field, allowed);
        Ok(Self {
            damage: document.damage().map_err(misfit)?,
            on: document.on,
            row: document.row,
            ball: document.ball,
            angle: document.angle,
            axial_offset: document.axial_offset,
        })
    }
}
