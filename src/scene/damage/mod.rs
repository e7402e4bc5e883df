//! Kinds of damage of a surface, each with its numbers and what it may lie on; and the flat document that a defect is.
//!
//! A new kind is a variant here and a file in `contact/damage/`: the compiler asks for the rest.

mod document;
mod kinds;

use std::borrow::Cow;

use super::numbers::{BoundedNumber, POSITIVE};
use super::width::{Floor, Width};

pub(super) use document::DefectDocument;
pub use kinds::{Cap, Dent, Patch, Pit, SteepPatch};

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

impl From<Patch> for Damage {
    fn from(of: Patch) -> Self {
        Self::Patch(of)
    }
}

impl From<SteepPatch> for Damage {
    fn from(of: SteepPatch) -> Self {
        Self::SteepPatch(of)
    }
}

impl From<Cap> for Damage {
    fn from(of: Cap) -> Self {
        Self::Cap(of)
    }
}

impl From<Pit> for Damage {
    fn from(of: Pit) -> Self {
        Self::Pit(of)
    }
}

impl From<Dent> for Damage {
    fn from(of: Dent) -> Self {
        Self::Dent(of)
    }
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
    /// Numbers of its own.
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
        let width = |of: f64| Width::from(of).numbers();
        let length = |of: f64| BoundedNumber::new("length", of, POSITIVE, "m");
        let short = |of: Option<f64>| BoundedNumber::new("length", of, 0.0..=1.0, "m");
        let edge = |of: f64| BoundedNumber::new("edge_radius", of, POSITIVE, "m");
        match self {
            Self::Patch(of) => About {
                width: Cow::Borrowed(&of.width),
                length: Some(of.length),
                edge_radius: Some(of.edge_radius),
                floor: of.floor.as_ref(),
                numbers: vec![length(of.length), of.width.numbers(), edge(of.edge_radius)],
                ..plain("patch", Lies::AlongAxis, 0.0)
            },
            Self::SteepPatch(of) => About {
                length: Some(of.length),
                floor: of.floor.as_ref(),
                numbers: vec![length(of.length), width(of.width)],
                ..plain("patch", Lies::AlongAxis, of.width)
            },
            Self::Cap(of) => About {
                edge_radius: Some(of.edge_radius),
                floor: of.floor.as_ref(),
                numbers: vec![edge(of.edge_radius), width(of.width)],
                ..plain("cap", Lies::OnBall, of.width)
            },
            Self::Pit(of) => About {
                length: of.length,
                finest: Some(of.width / 2.0),
                numbers: vec![short(of.length), width(of.width)],
                ..plain("pit", Lies::Anywhere, of.width)
            },
            Self::Dent(of) => About {
                length: of.length,
                finest: Some((RIM - 1.0) * of.width / 2.0),
                around: RIM,
                numbers: vec![
                    short(of.length),
                    width(of.width),
                    BoundedNumber::new("depth", of.depth, 0.0..=1e-3, "m"),
                    BoundedNumber::new("rim_height", of.rim_height, 0.0..=1e-4, "m"),
                ],
                ..plain("dent", Lies::Anywhere, of.width)
            },
        }
    }

    /// Gives it an extent along rolling \[m\], the same over its length.
    pub fn set_width(&mut self, to: f64) {
        match self {
            Self::Patch(of) => of.width = to.into(),
            Self::SteepPatch(of) => of.width = to,
            Self::Cap(of) => of.width = to,
            Self::Pit(of) => of.width = to,
            Self::Dent(of) => of.width = to,
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

    /// Numbers of its own, but for a width along its length and a floor.
    pub(super) fn numbers(&self) -> Vec<BoundedNumber> {
        self.about().numbers
    }
}
