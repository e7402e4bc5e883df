//! Kinds of damage: their sizes, each given by its name, their ranges and their forms.

use std::borrow::Cow;

use super::{About, DamageKind, Form};
use crate::scene::numbers::{BoundedNumber, POSITIVE};
use crate::scene::width::{Floor, Width};

/// Width that is the same along the length \[m\].
fn one_width(width: f64) -> BoundedNumber {
    Width::from(width).numbers()
}

/// Length of a patch \[m\].
fn length(length: f64) -> BoundedNumber {
    BoundedNumber::new("length", length, POSITIVE, "m")
}

/// Length of what is round without one \[m\].
fn length_across(length: Option<f64>) -> BoundedNumber {
    BoundedNumber::new("length", length, 0.0..=1.0, "m")
}

/// Radius of fault circles \[m\].
fn edge_radius(radius: f64) -> BoundedNumber {
    BoundedNumber::new("edge_radius", radius, POSITIVE, "m")
}

/// Damage in which the surface is absent over a length along the axis and a width along rolling; fault circles stand at its edges.
///
/// ```
/// use ballrace::scene::{Defect, Patch, Surface};
/// let spall = Patch::of_width(1e-3).length(2e-3).edge_radius(0.3e-3);
/// let spall = Defect::of(spall, Surface::InnerRace, 0.0);
/// assert_eq!((spall.damage.width(), spall.ball), (1e-3, None));
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Patch {
    /// Axial length L_f \[m\].
    pub length: f64,
    /// Width w, arc length along the surface \[m\]; a number or a profile along z.
    pub width: Width,
    /// Radius R_f of the fault circles at the edges \[m\].
    pub edge_radius: f64,
    /// Recessed circles between the edges; absent: no floor.
    pub floor: Option<Floor>,
}

impl Patch {
    /// A patch of a width \[m\], whose length and edge radius are to be given; without floor.
    pub fn of_width(width: impl Into<Width>) -> Self {
        Self {
            length: 0.0,
            width: width.into(),
            edge_radius: 0.0,
            floor: None,
        }
    }

    /// The same with an axial length \[m\].
    #[must_use]
    pub fn length(self, length: f64) -> Self {
        Self { length, ..self }
    }

    /// The same with fault circles of a radius \[m\].
    #[must_use]
    pub fn edge_radius(self, edge_radius: f64) -> Self {
        Self {
            edge_radius,
            ..self
        }
    }

    /// The same with a floor.
    #[must_use]
    pub fn floor(self, floor: Floor) -> Self {
        Self {
            floor: Some(floor),
            ..self
        }
    }
}

impl DamageKind for Patch {
    fn about(&self) -> About<'_> {
        About {
            word: "patch",
            form: Form::Slot {
                length: self.length,
                width: Cow::Borrowed(&self.width),
                edge_radius: Some(self.edge_radius),
                floor: self.floor.as_ref(),
            },
            numbers: vec![
                length(self.length),
                self.width.numbers(),
                edge_radius(self.edge_radius),
            ],
        }
    }

    fn set_width(&mut self, to: f64) {
        self.width = to.into();
    }
}

/// Damage between steep walls. A contact carries load until half of it is over the wall. Fault circles with a radius of a quarter of
/// the ball's diameter, further apart than `width` by the half-width of the most loaded contact that meets the defect at the
/// equilibrium, unload contacts as boundary-element solutions do: a scene that is compiled has that [`Patch`] in its place, and
/// a run records it. A defect narrower than 1.25 contacts is refused.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SteepPatch {
    /// Axial length L_f \[m\].
    pub length: f64,
    /// Width w from wall to wall, arc length along the surface \[m\].
    pub width: f64,
    /// Recessed circles between the edges; absent: no floor.
    pub floor: Option<Floor>,
}

impl SteepPatch {
    /// A patch of a width from wall to wall \[m\], whose length is to be given; without floor.
    pub fn of_width(width: f64) -> Self {
        Self {
            length: 0.0,
            width,
            floor: None,
        }
    }

    /// The same with an axial length \[m\].
    #[must_use]
    pub fn length(self, length: f64) -> Self {
        Self { length, ..self }
    }

    /// The same with a floor.
    #[must_use]
    pub fn floor(self, floor: Floor) -> Self {
        Self {
            floor: Some(floor),
            ..self
        }
    }
}

impl DamageKind for SteepPatch {
    fn about(&self) -> About<'_> {
        About {
            word: "patch",
            form: Form::Slot {
                length: self.length,
                width: Cow::Owned(self.width.into()),
                edge_radius: None,
                floor: self.floor.as_ref(),
            },
            numbers: vec![length(self.length), one_width(self.width)],
        }
    }

    fn set_width(&mut self, to: f64) {
        self.width = to;
    }
}

/// Damage of a ball: a circle on its surface, `width` wide along the surface in every direction, less than the ball's radius, in which the
/// surface is absent. The direction from the ball's centre to its middle is fixed in the ball: at the defect's angle about z, with its
/// axial offset the axial place of the middle.
///
/// ```
/// use ballrace::scene::{Cap, Defect, Surface};
/// let cap = Defect::of(Cap::of_width(1e-3).edge_radius(0.3e-3), Surface::Ball, 0.0);
/// let other = cap.clone().on_ball(4).at_offset(2e-3);
/// assert_eq!((cap.ball, other.ball), (Some(0), Some(4)));
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Cap {
    /// Width along the surface \[m\].
    pub width: f64,
    /// Radius R_f of the fault circles at the rim \[m\].
    pub edge_radius: f64,
    /// Recessed circles within; absent: no floor.
    pub floor: Option<Floor>,
}

impl Cap {
    /// A cap of a width \[m\], whose edge radius is to be given; without floor.
    pub fn of_width(width: f64) -> Self {
        Self {
            width,
            edge_radius: 0.0,
            floor: None,
        }
    }

    /// The same with fault circles of a radius \[m\].
    #[must_use]
    pub fn edge_radius(self, edge_radius: f64) -> Self {
        Self {
            edge_radius,
            ..self
        }
    }

    /// The same with a floor.
    #[must_use]
    pub fn floor(self, floor: Floor) -> Self {
        Self {
            floor: Some(floor),
            ..self
        }
    }
}

impl DamageKind for Cap {
    fn about(&self) -> About<'_> {
        About {
            word: "cap",
            form: Form::Circle {
                width: self.width,
                edge_radius: self.edge_radius,
                floor: self.floor.as_ref(),
            },
            numbers: vec![edge_radius(self.edge_radius), one_width(self.width)],
        }
    }

    fn set_width(&mut self, to: f64) {
        self.width = to;
    }
}

/// Damage smaller than its contact, a hole into which the surfaces bulge so that the contact loses part of its load: an ellipse so deep
/// that nothing meets its floor, with sharp edges.
///
/// ```
/// use ballrace::scene::{Defect, Pit, Surface};
/// let pit = Defect::of(Pit::of_width(0.178e-3), Surface::OuterRace, -1.57);
/// assert_eq!(pit.damage, Pit::of_width(0.178e-3).into());
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Pit {
    /// Extent along rolling \[m\].
    pub width: f64,
    /// Extent across \[m\]; absent: round.
    pub length: Option<f64>,
}

impl Pit {
    /// A round pit of a diameter \[m\].
    pub fn of_width(width: f64) -> Self {
        Self {
            width,
            length: None,
        }
    }

    /// The same with an extent across \[m\].
    #[must_use]
    pub fn length(self, length: f64) -> Self {
        Self {
            length: Some(length),
            ..self
        }
    }
}

impl DamageKind for Pit {
    fn about(&self) -> About<'_> {
        About {
            word: "pit",
            form: Form::Recess {
                width: self.width,
                length: self.length,
                depth: f64::INFINITY,
                rim_height: None,
            },
            numbers: vec![length_across(self.length), one_width(self.width)],
        }
    }

    fn set_width(&mut self, to: f64) {
        self.width = to;
    }
}

/// Damage with a raised rim, a dent as a hard particle leaves it, smaller than its contact: an ellipse into which the surfaces bulge down
/// to its floor, and around it, out to [`RIM`](super::RIM) times its size, what was pushed out of it.
///
/// ```
/// use ballrace::scene::{Defect, Dent, Surface};
/// let dent = Dent::of_width(0.2e-3).depth(8e-6).rim_height(0.3e-6);
/// assert_eq!(Defect::of(dent, Surface::InnerRace, 0.0).damage.width(), 0.2e-3);
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Dent {
    /// Extent along rolling at the level of the surface \[m\].
    pub width: f64,
    /// Extent across \[m\]; absent: round.
    pub length: Option<f64>,
    /// Depth in the middle \[m\].
    pub depth: f64,
    /// Height of the rim's crest \[m\]; 0: no rim.
    pub rim_height: f64,
}

impl Dent {
    /// A round dent of a diameter at the level of the surface \[m\], whose depth is to be given; without rim.
    pub fn of_width(width: f64) -> Self {
        Self {
            width,
            length: None,
            // Which a scene refuses: 0 would be a dent that does nothing.
            depth: f64::NAN,
            rim_height: 0.0,
        }
    }

    /// The same with an extent across \[m\].
    #[must_use]
    pub fn length(self, length: f64) -> Self {
        Self {
            length: Some(length),
            ..self
        }
    }

    /// The same with a depth in the middle \[m\].
    #[must_use]
    pub fn depth(self, depth: f64) -> Self {
        Self { depth, ..self }
    }

    /// The same with a rim whose crest has a height \[m\].
    #[must_use]
    pub fn rim_height(self, rim_height: f64) -> Self {
        Self { rim_height, ..self }
    }
}

impl DamageKind for Dent {
    fn about(&self) -> About<'_> {
        About {
            word: "dent",
            form: Form::Recess {
                width: self.width,
                length: self.length,
                depth: self.depth,
                rim_height: Some(self.rim_height),
            },
            numbers: vec![
                length_across(self.length),
                one_width(self.width),
                BoundedNumber::new("depth", self.depth, 0.0..=1e-3, "m"),
                BoundedNumber::new("rim_height", self.rim_height, 0.0..=1e-4, "m"),
            ],
        }
    }

    fn set_width(&mut self, to: f64) {
        self.width = to;
    }
}
