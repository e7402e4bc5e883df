//! Damage of surfaces: one file for each form behind the trait [`CompiledForm`], and what a contact meets where a surface is damaged.
//!
//! A damage acts in one of two ways ([`Acts`]): the surface is absent over arcs at whose ends fault circles stand
//! ([*Defects*](crate::equations#defects)), or the contact keeps whole surfaces and changes its energy, and with it its force. [`Facing`]
//! is a ball before a race: `surfaces` has what a slice meets there, fault circles too, `gradient` what makes their forces conservative,
//! `released` the energy of what is smaller than the contact.

mod arc;
mod cap;
mod depth;
mod direction;
mod facing;
mod gradient;
mod hole;
mod patch;
mod recess;
mod released;
mod small;
mod surfaces;

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::{Motion, V2, wrapped};
use crate::contact::hertz::Hertz;
use crate::scene::{Defect, Form, Row};
pub(super) use arc::WITH_RING_AXIS;
use arc::{Arc, Station};
use cap::CompiledCap;
use patch::{CircleEdges, CompiledPatch};
use recess::CompiledRecess;

pub(super) use depth::{Depth, Sloped};
pub(super) use facing::{Facing, Node, SurfaceSide};
pub(super) use gradient::{BESIDE, Owner};
pub(super) use hole::PittedContact;
pub(super) use hole::Unloading;
pub(super) use released::Moving;
pub(crate) use released::{MOST_AT_ONCE, met_at_once};
pub(super) use surfaces::{RingSurface, SurfacePair, WaveSlope};

pub(crate) use direction::ContactDirection;

/// Factor on the largest half-angle within which a defect is looked for: a race's radius changes by films, by some ten-thousandths.
const MARGIN: f64 = 1.01;

/// A defect of a surface, compiled: places in the frame of its body.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceDefect {
    /// Angular place on the body \[rad\].
    angle: f64,
    /// Axial place of the middle, in the ring's frame or from the ball's centre \[m\].
    middle: f64,
    /// Thickness of the oil film on fault circles \[m\].
    pub(super) film_layer: f64,
    /// The largest half-angle, and a little more: a contact further away never meets the defect \[rad\]. Of a cap while its ball is as at
    /// the start.
    pub(crate) reach: f64,
    form: AnyForm,
}

/// The surface in which a damage lies.
pub(super) struct Bed {
    /// Axial place of the damage's middle, in the ring's frame or from the ball's centre \[m\].
    pub middle: f64,
    /// Radius of the race there or of the ball \[m\].
    pub radius: f64,
    /// The least radius over the damage's length \[m\].
    pub least: f64,
    /// Contacts with the outer and the inner race, where they can meet it.
    pub contacts: [PittedContact; 2],
}

impl Bed {
    /// The bed of a surface that has the same radius over the damage's length.
    pub fn round(middle: f64, radius: f64, contacts: [PittedContact; 2]) -> Self {
        Self {
            middle,
            radius,
            least: radius,
            contacts,
        }
    }
}

/// A compiled damage of any form.
#[derive(Debug, Clone, PartialEq)]
enum AnyForm {
    Patch(CompiledPatch),
    Cap(CompiledCap),
    Recess(CompiledRecess),
}

impl AnyForm {
    /// A form compiled in its bed.
    ///
    /// # Panics
    /// For steep walls, in whose place a scene gets a patch before it is compiled.
    fn new(form: &Form<'_>, bed: &Bed) -> Self {
        match *form {
            Form::Slot {
                length,
                ref width,
                edge_radius,
                floor,
            } => {
                let radius =
                    edge_radius.expect("steep walls are placed before a scene is compiled");
                let edges = CircleEdges::new(radius, floor);
                Self::Patch(CompiledPatch::new(length, width, edges))
            }
            Form::Circle {
                width,
                edge_radius,
                floor,
            } => {
                let edges = CircleEdges::new(edge_radius, floor);
                Self::Cap(CompiledCap::new(width, bed.radius, edges))
            }
            Form::Recess {
                width,
                length,
                depth,
                rim_height,
            } => Self::Recess(CompiledRecess::new(width, length, depth, rim_height, bed)),
        }
    }

    fn get(&self) -> &dyn CompiledForm {
        match self {
            Self::Patch(form) => form,
            Self::Cap(form) => form,
            Self::Recess(form) => form,
        }
    }

    fn get_mut(&mut self) -> &mut dyn CompiledForm {
        match self {
            Self::Patch(form) => form,
            Self::Cap(form) => form,
            Self::Recess(form) => form,
        }
    }
}

/// Questions to a form of damage. Where `e` is given, it is the direction of the damage's middle in the frame in which the ball that
/// has it is seen.
trait CompiledForm {
    /// The largest half-angle at which a contact may meet it in its bed, and a little more \[rad\].
    fn reach(&self, angle: f64, bed: &Bed) -> f64;

    /// The direction of its middle in the frame of the ball that has it, of what turns with a ball in every direction.
    fn pole(&self, of: &SurfaceDefect) -> Option<Vector3<f64>>;

    /// Half of the angle over which it may be met \[rad\].
    fn half(&self, of: &SurfaceDefect, e: Option<&Vector3<f64>>) -> f64;

    /// Whether a contact in this direction may meet it.
    fn is_near(
        &self,
        of: &SurfaceDefect,
        direction: &ContactDirection,
        e: Option<&Vector3<f64>>,
    ) -> bool;

    /// Takes over the half-width of contacts under a typical load \[m\]; how far it is looked for then \[rad\], where that changes.
    fn widened(&mut self, half_width: f64) -> Option<f64>;

    /// The same in a mirror, z → −z.
    fn mirrored(&self) -> AnyForm;

    /// Action of the damage on contacts.
    fn acts(&self) -> Acts<'_>;
}

/// How a damage acts on contacts.
enum Acts<'a> {
    /// The surface is absent over arcs.
    Cuts(&'a dyn Cuts),
    /// Surfaces stay whole, and the energy of the contact changes.
    Releases(&'a CompiledRecess),
}

/// A damage with arcs over which the surface is absent.
trait Cuts {
    /// The arc at an axial place, its middle at an angle from where it is seen \[rad\].
    fn arc(
        &self,
        of: &SurfaceDefect,
        at: &Station,
        middle: f64,
        e: Option<&Vector3<f64>>,
    ) -> Option<Arc>;

    /// Length between its two axial ends \[m\]; none of what has none.
    fn length(&self) -> Option<f64>;

    /// Places ζ between which it has taken away what stands in a direction, of what is fixed in a ball \[m\].
    fn crossings(&self, e: &Vector3<f64>, n: V2) -> Option<[f64; 2]>;

    /// Depth \[m\] and number of the recessed circles.
    fn floor(&self) -> Option<(f64, usize)>;
}

/// Directions in the frame of the scene: those whose component along the middle, over their length, is above a bound.
pub(crate) struct AngularReach {
    pub middle: [f64; 2],
    pub bound: f64,
}

impl SurfaceDefect {
    /// A defect whose middle lies at `middle` on a surface of a radius \[m\], the same over its length, that no contact bulges into.
    pub fn new(defect: &Defect, middle: f64, radius: f64) -> Self {
        let contacts = [PittedContact::default(); 2];
        Self::within(defect, &Bed::round(middle, radius, contacts))
    }

    /// A defect of a race of a row, on which balls press by a stiffness. `radii` has the race's radius at a place \[m\], and the least
    /// over a length about it.
    pub(crate) fn of_race(
        defect: &Defect,
        row: &Row,
        hertz: &Hertz,
        radii: impl Fn(f64, f64) -> [f64; 2],
    ) -> Self {
        let middle = row.axial_position + offset(defect);
        let [radius, least] = radii(middle, defect.damage.length().unwrap_or(0.0));
        let bed = Bed {
            middle,
            radius,
            least,
            contacts: [PittedContact::of(hertz); 2],
        };
        Self::within(defect, &bed)
    }

    /// A defect of a ball of this radius, with its contacts with both races.
    pub(crate) fn of_ball(defect: &Defect, radius: f64, hertz: &[Hertz; 2]) -> Self {
        let reach = offset(defect).abs() + defect.damage.length().unwrap_or(0.0) / 2.0;
        let bed = Bed {
            middle: offset(defect),
            radius,
            least: (radius * radius - reach * reach).max(0.0).sqrt(),
            contacts: hertz.each_ref().map(PittedContact::of),
        };
        Self::within(defect, &bed)
    }

    /// A defect in its bed.
    pub(super) fn within(defect: &Defect, bed: &Bed) -> Self {
        let form = AnyForm::new(&defect.damage.form(), bed);
        Self {
            angle: defect.angle,
            middle: bed.middle,
            film_layer: 0.0,
            reach: form.get().reach(defect.angle, bed),
            form,
        }
    }

    /// The direction of the middle of what turns with its ball, in the frame in which the ball is seen.
    fn pole(&self, ball: &Motion) -> Option<Vector3<f64>> {
        let pole = self.form.get().pole(self)?;
        Some(ball.carried(&pole))
    }

    /// Whether another defect is this one's mirror image about the plane at half of `sum` along z, to a rounding
    /// \[m\].
    pub(crate) fn is_image(&self, other: &Self, sum: f64, rounding: f64) -> bool {
        let image = Self {
            middle: self.middle,
            reach: self.reach,
            form: other.form.get().mirrored(),
            ..*other
        };
        (self.middle + other.middle - sum).abs() <= rounding
            // Each found it on its own race.
            && (self.reach - other.reach).abs() <= 1e-12 * self.reach
            && *self == image
    }

    /// The directions of contacts that may meet the defect, while its body is turned by an angle.
    pub(crate) fn angular_reach(&self, turned: f64) -> AngularReach {
        let (sin, cos) = (self.angle + turned).sin_cos();
        AngularReach {
            middle: [cos, sin],
            // A little more than the reach, for rounding.
            bound: self.reach.min(PI).cos() - 1e-12,
        }
    }

    /// Whether a contact in this direction may meet the defect.
    pub(crate) fn in_reach(&self, direction: &ContactDirection) -> bool {
        let e = direction.pole(self);
        self.form.get().is_near(self, direction, e.as_ref())
    }

    /// Whether the surface is absent over arcs, and not whole.
    pub(super) fn cuts(&self) -> bool {
        self.as_cuts().is_some()
    }

    fn as_cuts(&self) -> Option<&dyn Cuts> {
        match self.form.get().acts() {
            Acts::Cuts(cuts) => Some(cuts),
            Acts::Releases(_) => None,
        }
    }

    fn as_releases(&self) -> Option<&CompiledRecess> {
        match self.form.get().acts() {
            Acts::Cuts(_) => None,
            Acts::Releases(releases) => Some(releases),
        }
    }

    /// The damage's two axial ends, in the ring's frame or from the ball's centre \[m\]; none of what has none.
    pub(super) fn ends(&self) -> impl Iterator<Item = f64> + Clone + use<> {
        let length = self.as_cuts().and_then(Cuts::length);
        let (middle, sides) = (
            self.middle,
            length.map(|length| [-0.5, 0.5].map(|of| (of, length))),
        );
        let ends = sides.into_iter().flatten();
        ends.map(move |(share, length)| middle + share * length)
    }

    /// Places ζ between which a damage that is fixed in the ball has taken away what stands in a direction \[m\].
    fn crossings(&self, ball: &Motion, n: V2) -> Option<[f64; 2]> {
        let cuts = self.as_cuts()?;
        cuts.crossings(&self.pole(ball)?, n)
    }

    /// Whether the surface is absent at an axial place where it has this radius, or a contact met there, in a direction this far from the
    /// defect's own \[rad\]; `ball` is the orientation of the ball that has it.
    pub(crate) fn covers(&self, z: f64, radius: f64, offset: f64, ball: &Motion) -> bool {
        let cuts = match self.form.get().acts() {
            Acts::Cuts(cuts) => cuts,
            Acts::Releases(small) => return offset.abs() <= small.bed.span,
        };
        let at = Station {
            z,
            beside: 0.0,
            radius,
        };
        let e = self.pole(ball);
        let middle = match e {
            None => wrapped(self.angle - (self.angle + offset)),
            Some(_) => -offset,
        };
        let arc = cuts.arc(self, &at, middle, e.as_ref());
        arc.is_some_and(|arc| arc.low.angle <= 0.0 && arc.high.angle >= 0.0)
    }

    /// The arc at an axial place, seen from a direction.
    fn arc(&self, at: &Station, direction: &ContactDirection) -> Option<Arc> {
        let cuts = self.as_cuts()?;
        let e = direction.pole(self);
        let middle = match &e {
            None => wrapped(self.angle - direction.angle),
            Some(e) => direction.angle_to(e),
        };
        cuts.arc(self, at, middle, e.as_ref())
    }

    /// Depth \[m\] and number of the recessed circles.
    fn floor(&self) -> Option<(f64, usize)> {
        self.as_cuts()?.floor()
    }

    /// Takes over the half-width of contacts under a typical load \[m\].
    pub(crate) fn widen(&mut self, half_width: f64) {
        if let Some(reach) = self.form.get_mut().widened(half_width) {
            self.reach = reach;
        }
    }

    /// Whether the defect is smaller than its contacts.
    pub(crate) fn is_small(&self) -> bool {
        self.as_releases().is_some()
    }

    /// Whether what should be smaller than its contact is too large for it under a load \[N\]: longer than nine tenths of it, or releasing
    /// 1.8 times its energy, beyond which a solver by boundary elements loses something else.
    pub(crate) fn outgrows(&self, race: usize, contact: &Hertz, load: f64) -> bool {
        const LONGEST: f64 = 0.9;
        const MOST_RELEASED: f64 = 1.8;
        let (Some(small), Some((_, released))) =
            (self.as_releases(), self.takes(race, contact, load))
        else {
            return false;
        };
        small.across() > LONGEST * contact.half_length * load.cbrt() || released > MOST_RELEASED
    }

    /// Load that a damage smaller than its contact with the outer (0) or the inner race (1) takes at its middle, at one and the same
    /// approach \[N\], and X.
    pub(crate) fn takes(&self, race: usize, contact: &Hertz, load: f64) -> Option<(f64, f64)> {
        let (small, depth) = (self.as_releases()?, contact.approach(load));
        let released = small.released(race, depth, [0.0; 2]);
        let of = &small.bed.contacts[race];
        let found = Unloading::of(of, 0.4 * load * depth, &[released]);
        Some((load * (1.0 - found.share), found.exponent))
    }
}

/// Axial place of a defect's middle, from the row's plane or the ball's centre \[m\].
fn offset(defect: &Defect) -> f64 {
    let number = defect.axial_offset.number();
    number.expect("defects are placed before a scene is compiled")
}
