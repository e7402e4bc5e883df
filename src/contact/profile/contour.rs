//! Contact of a ball with a race that is given by points.
//!
//! A ball of radius R can touch a smooth curve at two places only across a *tight hollow*, whose curvature is above 1/R.
//! Between two touching points the curve's tangent turns as far as the ball's surface does; were its curvature nowhere above
//! the ball's, it would be longer than that and could not join the two. So the race falls into *parts* at its tight hollows
//! (a gothic arch has one in its middle), and each part has one contact at most: about its point nearest to the ball's
//! centre, the *foot*, where
//!
//! ```text
//! (z − z_b) − (d − R(z)) R'(z) = 0,     δ = R − distance of foot and centre
//! ```
//!
//! The circle of curvature at the foot is the torus that the contact sees: common normal and approach are exact, the ends of
//! the zone on its chord the first guess for those on the curve, which Newton's method finds. Penetrations are always those
//! into the curve itself.

use super::curve::Curve;
use super::meeting::{Meeting, Part, RaceSurface, STEPS};
use super::{Inclination, Section, Torus};
use crate::simd::{Lanes, Mask};

/// A race through points.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Contour {
    /// +1 for an outer, −1 for an inner race.
    sigma: f64,
    curve: Curve,
    parts: Vec<Part>,
    nominal: Option<Torus>,
    /// σ R of the race's bottom and of what stands out most towards the balls \[m\].
    bottom: f64,
    top: f64,
}

/// A ball before a race: its radius, its distance from the ring's axis less the race's waves, its axial place in the ring's
/// frame \[m\].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Before {
    pub radius: f64,
    pub d: f64,
    pub z: f64,
}

/// Radius of a circle of curvature over the ball's, beyond which a race counts as flat, and below which as that of a ball in it.
pub(in crate::contact) const FLAT: f64 = 1e3;
pub(in crate::contact) const SNUG: f64 = 1.02;
/// Distance beside it, over the ball's radius, at which a race is looked at for its nominal curvature.
const SMOOTH: f64 = 0.05;
/// Places at which a part that is not plain is looked at for its nearest point.
const LOOKS: usize = 24;
impl Contour {
    /// A curve, for balls of a radius whose contact normal is nominally inclined by an angle from the plane towards +z.
    pub fn new(sigma: f64, curve: Curve, radius: f64, angle: f64) -> Self {
        let nominal = nominal(&curve, sigma, radius, angle);
        let parts = parts(&curve, sigma, radius);
        let heights = || curve.knots().iter().map(|z| sigma * curve.at(*z).radius);
        let bottom = heights().fold(f64::NEG_INFINITY, f64::max);
        let top = heights().fold(f64::INFINITY, f64::min);
        Self {
            sigma,
            curve,
            parts,
            nominal,
            bottom,
            top,
        }
    }

    /// +1 for an outer, −1 for an inner race.
    pub fn sigma(&self) -> f64 {
        self.sigma
    }

    /// The race.
    pub fn curve(&self) -> &Curve {
        &self.curve
    }

    /// Ends of the race in its ring's frame \[m\].
    pub fn ends(&self) -> [f64; 2] {
        self.curve.ends()
    }

    /// Radius of the race \[m\]; none beyond its ends.
    pub fn radius(&self, z: f64) -> Option<f64> {
        let [low, high] = self.ends();
        (low..=high).contains(&z).then(|| self.curve.at(z).radius)
    }

    /// Whether balls touch it at one place at most, wherever they are, and only where it is hollow.
    pub fn is_hollow(&self) -> bool {
        matches!(&self.parts[..], [part] if part.plain)
    }

    /// Balls whose centres, so far from the ring's axis less the waves and at such axial places, are where no contact means anything:
    /// pressed into the race by half their radius or more, or beside it. What is not a number is.
    pub(in crate::contact) fn loses(&self, radius: Lanes, d: Lanes, z: Lanes) -> Mask {
        let [low, high] = self.ends().map(Lanes::all);
        let deepest = radius * -0.5 + self.bottom;
        let in_front = deepest.above(d * self.sigma);
        z.above(low).and(high.above(z)).and(in_front).not()
    }

    /// Balls that are not so far in front of the race that no point of it can be near.
    pub(in crate::contact) fn may_touch(&self, radius: Lanes, d: Lanes) -> Mask {
        // Between points the race may stand out a little more.
        let reach = d * self.sigma + radius * 1.001;
        Lanes::all(self.top).above(reach).not()
    }

    /// The torus of the circle of curvature where contacts nominally are; none where the race is not hollow there.
    pub fn nominal(&self) -> Option<&Torus> {
        self.nominal.as_ref()
    }

    /// The contacts of a ball, one a part that it touches.
    pub(in crate::contact) fn meetings(&self, ball: Before) -> impl Iterator<Item = Meeting<'_>> {
        self.parts.iter().filter_map(move |part| {
            let meeting = self.nearest(&ball, *part)?;
            // What is not a number touches, so that it shows.
            let is_clear = meeting.section.approach <= 0.0;
            (!is_clear).then_some(meeting)
        })
    }

    /// The largest approach of a ball to any part \[m\], negative without contact, and the place of its foot; minus its radius
    /// beside the race.
    pub fn approach(&self, ball: Before) -> (f64, f64) {
        let found = self
            .parts
            .iter()
            .filter_map(|part| self.nearest(&ball, *part));
        found
            .map(|meeting| (meeting.section.approach, meeting.foot))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((-ball.radius, ball.z))
    }

    /// The point of a part that is nearest to a ball, if the ball reaches so far along the axis.
    fn nearest(&self, ball: &Before, part: Part) -> Option<Meeting<'_>> {
        if part.low >= ball.z + ball.radius || part.high <= ball.z - ball.radius {
            return None;
        }
        let foot = self.foot(ball, part);
        let bend = self.curve.at(foot);
        let (out, along) = (self.sigma * (bend.radius - ball.d), foot - ball.z);
        let own = bend.normal(self.sigma);
        let (distance, projected) = (out.hypot(along), out * own.cos + along * own.sin);
        // Towards the foot, which is along the race's own normal unless the part ends there; that a ball is beyond the race
        // only the normal knows.
        let (normal, height) = if projected > 0.0 {
            let (cos, sin) = (out / distance, along / distance);
            (Inclination { cos, sin }, distance)
        } else {
            (own, projected)
        };
        let approach = ball.radius - height;
        let flattest = 1.0 / (FLAT * ball.radius);
        let r = (1.0 / bend.hollow(self.sigma).max(flattest)).max(SNUG * ball.radius);
        let l = approach + r - ball.radius;
        let (e, c) = (l * normal.cos, -l * normal.sin);
        let centre = ball.z + c;
        Some(Meeting {
            surface: RaceSurface {
                curve: &self.curve,
                part,
            },
            torus: Torus {
                sigma: self.sigma,
                a: ball.d - self.sigma * e,
                centre,
                r,
                // Where the race ends the surface does.
                lowest: f64::NEG_INFINITY,
                highest: f64::INFINITY,
            },
            section: Section {
                radius: ball.radius,
                r,
                e,
                c,
                l,
                normal,
                approach,
            },
            foot,
        })
    }

    /// Place where the distance from a ball's centre is least, by Newton's method within shrinking bounds.
    fn foot(&self, ball: &Before, part: Part) -> f64 {
        let (mut low, mut high, mut z) = self.bracket(ball, part);
        for _ in 0..STEPS {
            let at = self.curve.at(z);
            let short = ball.d - at.radius;
            let falls = (z - ball.z) - short * at.slope;
            let rate = 1.0 + at.slope * at.slope - short * at.bend;
            if falls > 0.0 {
                high = z;
            } else {
                low = z;
            }
            let newton = z - falls / rate;
            let next = if rate > 0.0 {
                newton.clamp(part.low, part.high)
            } else {
                f64::midpoint(low, high)
            };
            let next = if next < low || next > high {
                f64::midpoint(low, high)
            } else {
                next
            };
            let moved = (next - z).abs();
            z = next;
            // Newton's next step would be of this one's square.
            if moved <= 1e-7 * ball.radius && rate > 0.0 {
                break;
            }
        }
        z
    }

    /// Place where a ball would touch the nominal torus.
    fn ahead(&self, ball: &Before) -> f64 {
        let Some(torus) = &self.nominal else {
            return ball.z;
        };
        let (e, x) = (self.sigma * (ball.d - torus.a), ball.z - torus.centre);
        torus.centre + torus.r * x / e.hypot(x)
    }

    /// Bounds of the foot and a first guess: that of the nominal torus, or the nearest of some places of a part that may be near at
    /// several.
    fn bracket(&self, ball: &Before, part: Part) -> (f64, f64, f64) {
        let (low, high) = (
            part.low.max(ball.z - ball.radius),
            part.high.min(ball.z + ball.radius),
        );
        if part.plain {
            return (low, high, self.ahead(ball).clamp(low, high));
        }
        let step = (high - low) / LOOKS as f64;
        let place = |k: usize| low + step * k as f64;
        let square = |z: f64| (z - ball.z).powi(2) + (ball.d - self.curve.at(z).radius).powi(2);
        let nearest = (0..=LOOKS).min_by(|a, b| square(place(*a)).total_cmp(&square(place(*b))));
        let k = nearest.unwrap_or(0);
        (
            place(k.saturating_sub(1)),
            place((k + 1).min(LOOKS)),
            place(k),
        )
    }
}

/// The torus of the circle of curvature where a race's normal is inclined by an angle from the plane towards +z.
fn nominal(curve: &Curve, sigma: f64, radius: f64, angle: f64) -> Option<Torus> {
    let z = inclined(curve, sigma, angle)?;
    let hollow = curve.smoothed(z, SMOOTH * radius).hollow(sigma);
    if hollow <= 0.0 {
        return None;
    }
    let (r, at) = (1.0 / hollow, curve.at(z));
    let Inclination { cos, sin } = at.normal(sigma);
    let centre = z - r * sin;
    let [low, high] = curve.ends();
    Some(Torus {
        sigma,
        a: at.radius - sigma * r * cos,
        centre,
        r,
        lowest: low - centre,
        highest: high - centre,
    })
}

/// Place where a race's normal is inclined by an angle, as near to its bottom as possible.
fn inclined(curve: &Curve, sigma: f64, angle: f64) -> Option<f64> {
    let slope = -sigma * angle.tan();
    let off = |z: f64| curve.at(z).slope - slope;
    let brackets = curve.knots().windows(2).filter(|z| {
        let (a, b) = (off(z[0]), off(z[1]));
        a == 0.0 || a * b < 0.0
    });
    let places = brackets.map(|z| bisected(off, z[0], z[1]));
    let height = |z: &f64| sigma * curve.at(*z).radius;
    places.max_by(|a, b| height(a).total_cmp(&height(b)))
}

/// Cuts a race at its tight hollows.
fn parts(curve: &Curve, sigma: f64, radius: f64) -> Vec<Part> {
    let [first, last] = curve.ends();
    let tightest = 1.0 / radius;
    let knots = curve.knots();
    let hollow = |z: &f64| curve.at(*z).hollow(sigma);
    let mut cuts = Vec::new();
    let mut tight: Option<f64> = None;
    for z in knots {
        let is_tight = hollow(z) > tightest;
        tight = match tight {
            Some(so_far) if is_tight => Some(if hollow(z) > hollow(&so_far) {
                *z
            } else {
                so_far
            }),
            None if is_tight => Some(*z),
            Some(so_far) => {
                cuts.push(so_far);
                None
            }
            None => None,
        };
    }
    cuts.extend(tight);
    cuts.retain(|cut| *cut > first && *cut < last);
    let starts = std::iter::once(first).chain(cuts.iter().copied());
    let ends = cuts.iter().copied().chain([last]);
    let part = |(low, high): (f64, f64)| {
        let inside = |z: &&f64| **z >= low && **z <= high;
        Part {
            low,
            high,
            plain: knots.iter().filter(inside).all(|z| hollow(z) > 0.0),
        }
    };
    starts.zip(ends).map(part).collect()
}

/// A zero between two places of opposite sign.
fn bisected(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let rises = f(b) > 0.0;
    for _ in 0..60 {
        let middle = f64::midpoint(a, b);
        if (f(middle) > 0.0) == rises {
            b = middle;
        } else {
            a = middle;
        }
    }
    f64::midpoint(a, b)
}
