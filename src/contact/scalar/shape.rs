//! Races other than one torus: a curve through points, or the two flanks of a gothic arch.
//!
//! The flanks of an arch are two tori, each up to the cusp where they meet, and a ball has a contact with each that it touches:
//!
//! ```text
//! flank towards ±z:  centre at  ∓ (r − R) sin α_s,   a = d_m/2 − σ (r − R) cos α_s + σ P_d/4
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | α_s | shim angle: inclination of the normals of a ball that rests on both flanks at zero clearance | rad |
//! | r, R | radii of the flank's groove and of the ball | m |
//! | a | radius of the circle of groove centres | m |
//! | d_m, P_d | pitch diameter, and the play of a ball that touches both flanks of both races | m |
//! | σ | +1 for the outer, −1 for the inner race | |
//!
//! Under thrust such a bearing is an angular-contact bearing of contact angle α_s, whose free angle is
//! cos α = cos α_s − P_d/(2 A), A = r_o + r_i − 2 R. Source: T. A. Harris, *Rolling Bearing Analysis*, ch. 2 (split inner rings, where
//! P_d is that of the groove before it was split). Validity: a zone that reaches over the cusp ends there, as on a shoulder,
//! and goes on on the other flank.

use std::sync::Arc;

use super::Pair;
use crate::contact::Torus;
use crate::contact::profile::{Before, Contour};
use crate::simd::{Lanes, Mask};

/// The shape of a race. By default it is the torus that its [`Pair`] names.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Shape(pub(in crate::contact) Kind);

/// Kinds of shapes.
#[derive(Debug, Clone, Default, PartialEq)]
pub(in crate::contact) enum Kind {
    /// The torus itself, which every driver of the kernel takes.
    #[default]
    Torus,
    /// A curve through points; the torus is that of its circle of curvature where the contact nominally is.
    Points { contour: Arc<Contour>, angle: f64 },
    /// A flank of a gothic arch: the torus up to the cusp.
    Flank(Box<Flank>),
}

/// A flank of a gothic arch, whose two grooves are struck from centres that lie apart along the axis, so that a ball that rests
/// in it touches both at the shim angle.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::contact) struct Flank {
    /// Inclination of the normal of a resting ball towards +z \[rad\]: the shim angle, or less than 0 for the flank at −z.
    pub angle: f64,
    /// Place where the flank meets the other in the ring's frame \[m\].
    pub cusp: f64,
    /// The other flank, on the first of the two: a race with laws of its own, since it may have another radius.
    pub other: Option<Pair>,
}

impl Flank {
    /// Whether a place lies on the other side of the cusp.
    pub fn is_beyond(&self, z: f64) -> bool {
        (z - self.cusp) * self.angle < 0.0
    }
}

impl Shape {
    /// A curve through points whose contacts are nominally inclined by an angle towards +z \[rad\].
    pub(crate) fn points(contour: Contour, angle: f64) -> Self {
        let contour = Arc::new(contour);
        Self(Kind::Points { contour, angle })
    }

    /// Whether the race is one torus and no more.
    pub fn is_torus(&self) -> bool {
        matches!(self.0, Kind::Torus)
    }

    /// Name of contacts on it in reports; none for a torus.
    pub(crate) fn name(&self) -> &'static str {
        match &self.0 {
            Kind::Torus => "",
            Kind::Points { .. } => " on a curve through points",
            Kind::Flank(_) => " on each flank of a gothic arch",
        }
    }

    /// Whether no ball touches it at two places and it bends away from none.
    pub(crate) fn is_hollow(&self) -> bool {
        match &self.0 {
            Kind::Points { contour, .. } => contour.is_hollow(),
            Kind::Torus | Kind::Flank(_) => true,
        }
    }

    pub(in crate::contact) fn kind(&self) -> &Kind {
        &self.0
    }

    fn flank(&self) -> Option<&Flank> {
        match &self.0 {
            Kind::Flank(flank) => Some(flank),
            _ => None,
        }
    }
}

impl Pair {
    /// The two flanks of a gothic arch as one race, from pairs whose tori are those of the flanks towards −z and +z; none
    /// where these do not meet between balls that rest on them.
    pub(crate) fn arch([mut low, mut high]: [Self; 2], angle: f64) -> Option<Self> {
        let cusp = cusp(&low, &high)?;
        // A slice in the cusp belongs to one of them.
        low.race.highest = (cusp - low.race.centre).next_down();
        high.race.lowest = cusp - high.race.centre;
        let flank = |angle: f64, other: Option<Pair>| {
            let flank = Flank { angle, cusp, other };
            Shape(Kind::Flank(Box::new(flank)))
        };
        low.shape = flank(-angle, None);
        high.shape = flank(angle, Some(low));
        Some(high)
    }

    /// The other flank of a gothic arch.
    pub(crate) fn other_flank(&self) -> Option<&Self> {
        self.shape.flank()?.other.as_ref()
    }

    /// The race, or both flanks of a gothic arch.
    pub(crate) fn flanks(&self) -> impl Iterator<Item = &Self> {
        std::iter::once(self).chain(self.other_flank())
    }

    /// Whether the shape is a curve through points.
    pub(crate) fn is_through_points(&self) -> bool {
        matches!(self.shape.0, Kind::Points { .. })
    }

    /// Changes the race, then the other flank of a gothic arch, each by itself.
    pub(crate) fn change_each(&mut self, mut change: impl FnMut(&mut Self)) {
        change(self);
        if let Kind::Flank(flank) = &mut self.shape.0
            && let Some(other) = &mut flank.other
        {
            change(other);
        }
    }

    /// Changes the race, and the other flank of a gothic arch alike.
    pub(crate) fn change(&mut self, change: impl Fn(&mut Self)) {
        change(self);
        if let Kind::Flank(flank) = &mut self.shape.0
            && let Some(other) = &mut flank.other
        {
            change(other);
        }
    }

    /// Radius of the race at an axial place of the ring's frame \[m\], whether or not a shoulder has cut it off; none where
    /// there is no race.
    pub(crate) fn radius_at(&self, z: f64) -> Option<f64> {
        match &self.shape.0 {
            Kind::Torus => self.race.radius(z),
            Kind::Points { contour, .. } => contour.radius(z),
            Kind::Flank(flank) => match &flank.other {
                Some(other) if flank.is_beyond(z) => other.race.radius(z),
                _ => self.race.radius(z),
            },
        }
    }

    /// Radius of the race at a place \[m\], and the least over a length about it, to the step of a fine grid: one groove has it at an
    /// end or in its middle, a curve through points anywhere.
    pub(crate) fn radii(&self, middle: f64, length: f64) -> [f64; 2] {
        const PLACES: u32 = 64;
        let place = |k: u32| middle + length * (f64::from(k) / f64::from(PLACES) - 0.5);
        // Validation keeps the middle of a defect inside the groove.
        let radius = self.radius_at(middle).unwrap_or(self.race.a);
        let radii = (0..=PLACES).filter_map(|k| self.radius_at(place(k)));
        [radius, radii.fold(radius, f64::min)]
    }

    /// Distance from the ring's axis and axial place \[m\] of a ball that is pressed into the race by an approach where its
    /// contact nominally is: at the bottom of a torus.
    pub(crate) fn seat(&self, radius: f64, approach: f64) -> (f64, f64) {
        let race = &self.race;
        let angle = self.nominal_angle();
        let l = race.r - radius + approach;
        if angle == 0.0 {
            return (race.a + race.sigma * l, race.centre);
        }
        let (sin, cos) = angle.sin_cos();
        (race.a + race.sigma * (l * cos), race.centre + l * sin)
    }

    /// Nominal inclination of the normal towards +z, from the bottom of a torus \[rad\].
    pub(crate) fn nominal_angle(&self) -> f64 {
        match &self.shape.0 {
            Kind::Torus => 0.0,
            Kind::Points { angle, .. } => *angle,
            Kind::Flank(flank) => flank.angle,
        }
    }

    /// The largest normal approach \[m\] of a ball to the race, negative without contact, and where the common normal meets
    /// the race, in the ring's frame; for a ball at a distance `d` from the ring's axis, where the race is raised by a wave.
    pub(crate) fn foot(&self, radius: f64, d: f64, z: f64, wave: f64) -> (f64, f64) {
        let of_torus = |pair: &Self| {
            let race = &pair.race;
            let section = race.section(radius, d, z, wave);
            let point = race.centre + (z - race.centre) / section.l * race.r;
            (section.approach, point)
        };
        match &self.shape.0 {
            Kind::Torus => of_torus(self),
            Kind::Points { contour, .. } => {
                let d = d - wave;
                contour.approach(Before { radius, d, z })
            }
            Kind::Flank(_) => {
                let own = |pair: &&Self| !pair.is_beyond_cusp(of_torus(pair).1);
                let found = self.flanks().filter(own).map(of_torus);
                // In front of the cusp a ball is clear of both.
                found
                    .max_by(|a, b| a.0.total_cmp(&b.0))
                    .unwrap_or_else(|| (-radius, z))
            }
        }
    }

    /// Place where the common normal of a ball that has left the race meets it, and where the race ends: from the middle of its groove,
    /// or from its own; none for a ball that is in it.
    pub(crate) fn left(&self, radius: f64, d: f64, z: f64) -> Option<(f64, [f64; 2])> {
        let race = &self.race;
        let (approach, foot) = self.foot(radius, d, z, 0.0);
        let middle = match &self.shape.0 {
            Kind::Flank(flank) => flank.cusp,
            Kind::Torus | Kind::Points { .. } => race.centre,
        };
        let [lowest, highest] = self.ends().map(|end| end - middle);
        let (point, pressed) = (foot - middle, approach > 0.0);
        // A curve's nearest point is its end.
        let rounding = match &self.shape.0 {
            Kind::Points { .. } => 1e-9 * radius,
            Kind::Torus | Kind::Flank(_) => 0.0,
        };
        let in_front = !self.shape.is_torus() || race.section(radius, d, z, 0.0).e > 0.0;
        // Behind the groove's centre a ball is loose, as long as it is in the groove at all.
        let left = if in_front {
            pressed && (point < lowest + rounding || point > highest - rounding)
        } else {
            (z - race.centre).abs() >= race.r
        };
        left.then_some((point, [lowest, highest]))
    }

    /// Ends of the race in its ring's frame \[m\].
    fn ends(&self) -> [f64; 2] {
        let Torus {
            centre,
            lowest,
            highest,
            ..
        } = self.race;
        match &self.shape.0 {
            Kind::Torus => [centre + lowest, centre + highest],
            Kind::Points { contour, .. } => contour.ends(),
            Kind::Flank(flank) => {
                let other = flank
                    .other
                    .as_ref()
                    .map_or(flank.cusp, |other| other.race.centre + other.race.lowest);
                [other, centre + highest]
            }
        }
    }

    /// Masks of eight balls, so far from the ring's axis less the race's waves and at such axial places, that may touch a race that is no
    /// torus, and which of them are where no contact means anything. What is not a number does and is.
    pub(in crate::contact) fn near_shape(&self, radius: Lanes, d: Lanes, z: Lanes) -> [Mask; 2] {
        if let Kind::Points { contour, .. } = &self.shape.0 {
            return [contour.may_touch(radius, d), contour.loses(radius, d, z)];
        }
        let section =
            |pair: &Self, lane: usize| pair.race.section(radius[lane], d[lane], z[lane], 0.0);
        let touches = |lane| self.flanks().any(|flank| !section(flank, lane).is_clear());
        let within = |lane| section(self, lane).l < self.race.farthest(radius[lane]);
        [Mask::from_fn(touches), Mask::from_fn(within).not()]
    }

    /// Whether contacts with it are evaluated by eights.
    pub(in crate::contact) fn goes_by_eights(&self) -> bool {
        self.shape.is_torus() || self.hollow_curve().is_some()
    }

    /// The curve of a race whose contacts are evaluated by eights: hollow all along, so that each is one.
    pub(crate) fn hollow_curve(&self) -> Option<&Contour> {
        match &self.shape.0 {
            Kind::Points { contour, .. } if contour.is_hollow() => Some(contour),
            _ => None,
        }
    }

    /// Whether a place of the ring's frame lies on the other side of the cusp from this flank.
    pub(crate) fn is_beyond_cusp(&self, z: f64) -> bool {
        self.shape.flank().is_some_and(|flank| flank.is_beyond(z))
    }
}

/// Place where two flanks meet: between their centres, where their circles cut.
fn cusp(low: &Pair, high: &Pair) -> Option<f64> {
    let apart =
        |z: f64| Some(low.race.groove(z)? * low.race.sigma + low.race.a - high.race.radius(z)?);
    // The flank at −z is struck from a centre at +z.
    let (mut a, mut b) = (high.race.centre, low.race.centre);
    let (at_a, at_b) = (apart(a)? * low.race.sigma, apart(b)? * low.race.sigma);
    if at_a >= 0.0 || at_b <= 0.0 {
        return None;
    }
    for _ in 0..60 {
        let middle = f64::midpoint(a, b);
        if apart(middle)? * low.race.sigma < 0.0 {
            a = middle;
        } else {
            b = middle;
        }
    }
    Some(f64::midpoint(a, b))
}
