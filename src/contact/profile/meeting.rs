//! A contact of a ball with a race through points: the ends of its zone.

use super::curve::{Curve, RacePoint};
use super::zone::{Ends, Zone};
use super::{Chord, Inclination, SHALLOW, Section, Torus};

/// Steps of Newton's method that are always enough; three are the rule.
pub(super) const STEPS: usize = 40;
/// Largest distance along a chord, over the ball's radius, at which its surface is looked at.
pub(in crate::contact) const REACH: f64 = 0.98;

/// A stretch of the race that a ball touches at one place at most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::contact) struct Part {
    pub low: f64,
    /// Belongs to the next part, if there is one.
    pub high: f64,
    /// Whether the part is hollow all along, so that there is one nearest point only.
    pub plain: bool,
}

/// The part of a race that a contact is with.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct RaceSurface<'a> {
    pub curve: &'a Curve,
    pub part: Part,
}

impl RaceSurface<'_> {
    /// The race at a place of the ring's frame; none outside the part.
    #[inline]
    pub fn at(&self, z: f64) -> Option<RacePoint> {
        // What is not a number is not outside, so that it shows.
        let outside = z < self.part.low || z >= self.part.high;
        (!outside).then(|| self.curve.at(z))
    }
}

/// A contact of a ball with a race through points.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Meeting<'a> {
    pub surface: RaceSurface<'a>,
    /// The circle of curvature at the foot, as a race.
    pub torus: Torus,
    /// The ball before it.
    pub section: Section<f64>,
    /// Place of the foot \[m\].
    pub foot: f64,
}

impl Meeting<'_> {
    /// The chord that the contact is cut along and the ends of its zone.
    pub fn chord(&self) -> (Chord, Ends) {
        let section = &self.section;
        let radius = section.radius;
        let chord = Chord {
            radius,
            normal: section.normal,
        };
        let guess = Zone::on_chord(section).half.min(REACH * radius);
        if section.e > 0.0 && section.approach < (1.0 - SHALLOW) * radius {
            let ends = [-1.0, 1.0].map(|side| self.end(&chord, side, guess));
            if let [Some(low), Some(high)] = ends {
                return (chord, [low, high]);
            }
        }
        // The race hugs the ball, or the ball is not in front of it: let every slice decide for itself.
        let along_axis = Chord {
            radius,
            normal: Inclination { cos: 1.0, sin: 0.0 },
        };
        (along_axis, [(-radius, false), (radius, false)])
    }

    /// Whether the race ends within a zone, or cuts it off.
    pub fn ends_within(&self, [low, high]: [f64; 2]) -> bool {
        let ([first, last], place) = (self.surface.curve.ends(), self.place());
        let rounding = 1e-12 * self.section.radius;
        place + low <= first + rounding || place + high >= last - rounding
    }

    /// |u| of the ball's equator, on the side of a u; the ball does not end on the other side.
    fn equator(&self, u: f64) -> f64 {
        let Inclination { cos, sin } = self.section.normal;
        if u * sin > 0.0 {
            self.section.radius * cos
        } else {
            f64::INFINITY
        }
    }

    /// The end of the zone towards a side, and whether the penetration vanishes there: else the part or the ball itself ends;
    /// none where the zone reaches around the ball.
    fn end(&self, chord: &Chord, side: f64, guess: f64) -> Option<(f64, bool)> {
        let part = &self.surface.part;
        let last = if side < 0.0 { part.low } else { part.high };
        let of_part = chord
            .u(last - self.place())
            .map_or(f64::INFINITY, |u| side * u);
        let of_ball = self.equator(side).min(REACH * chord.radius);
        let limit = of_part.min(of_ball);
        if limit <= 0.0 {
            return Some((side * limit, false));
        }
        let (mut low, mut high, mut u) = (0.0, limit, guess.min(limit));
        for _ in 0..STEPS {
            let (depth, slope) = self.depth(chord, side * u);
            if u == limit && depth >= 0.0 {
                let around = limit < of_part && limit < self.equator(side);
                return (!around).then_some((side * limit, false));
            }
            if depth > 0.0 {
                low = u;
            } else {
                high = u;
            }
            let newton = u - depth / (side * slope);
            let next = if newton > low && newton < high {
                newton
            } else if high == limit && newton >= limit {
                limit
            } else {
                f64::midpoint(low, high)
            };
            let moved = (next - u).abs();
            u = next;
            if moved <= 1e-7 * guess && u < limit {
                break;
            }
        }
        Some((side * u, true))
    }

    /// Axial place of the ball's centre in the ring's frame.
    fn place(&self) -> f64 {
        self.torus.centre - self.section.c
    }

    /// Penetration in the plane at u on the chord, and its slope.
    fn depth(&self, chord: &Chord, u: f64) -> (f64, f64) {
        let (Inclination { cos, sin }, radius) = (chord.normal, chord.radius);
        let height = (radius * radius - u * u).sqrt();
        let (zeta, rho) = (height * sin + u * cos, height * cos - u * sin);
        let falls = u / height;
        let at = self.surface.curve.at(self.place() + zeta);
        let sigma = self.torus.sigma;
        let groove = sigma * (at.radius - self.torus.a);
        let slope = -sigma * at.slope * (cos - falls * sin) - falls * cos - sin;
        (self.section.penetration(rho, groove), slope)
    }
}
