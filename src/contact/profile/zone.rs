//! The zone of contact in closed form: where the two circles of ball and groove cut.

use super::{Inclination, Section};
use crate::simd::Number;

/// Height of a chord over the ball's centre, as a share of its radius, below which a zone is not cut along it.
pub(in crate::contact) const SHALLOW: f64 = 0.2;

/// A zone that no shoulder cuts.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Zone<T> {
    /// Half of the zone's length along the common tangent \[m\].
    pub half: T,
    /// Height over the ball's centre of the line that it is cut along: of the common chord, or of the tangent \[m\].
    pub height: T,
}

impl<T: Number> Zone<T> {
    /// The zone on the chord that both circles have in common: where the ball's surface is in the race.
    #[inline(always)]
    pub fn on_chord(of: &Section<T>) -> Self {
        // The chord stands at R − sum from the ball's centre; without the cancellation in l² + R² − r².
        let sum = of.approach * (of.l + of.radius + of.r) * 0.5 / of.l;
        let half = (sum * (of.radius + of.radius - sum)).or_zero().sqrt();
        Self {
            half,
            height: of.radius - sum,
        }
    }

    /// The zone on the common tangent, where the gap grows by κ u²/2.
    #[inline(always)]
    pub fn on_tangent(of: &Section<T>, half_curvature: T) -> Self {
        Self {
            half: (of.approach / half_curvature).or_zero().sqrt(),
            height: of.radius,
        }
    }

    /// The zone's ends along ζ, for a normal at α'.
    #[inline(always)]
    pub fn ends(&self, Inclination { cos, sin }: Inclination<T>) -> (T, T) {
        let (middle, reach) = (self.height * sin, self.half * cos);
        (middle - reach, middle + reach)
    }

    /// Height of its lower end above the ball's equator: not positive where the ball ends before the zone.
    #[inline(always)]
    pub fn lowest(&self, Inclination { cos, sin }: Inclination<T>) -> T {
        self.height * cos - (self.half * sin).abs()
    }
}

/// A point of the ball's surface.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct SurfacePoint<T> {
    /// ζ/R and ρ/R.
    pub sin: T,
    pub cos: T,
    /// Ratio of sine and cosine, tan α of the slice.
    pub tan: T,
    /// Width along ζ of a unit along the line that the surface is cut along.
    pub stretch: T,
}

impl<T: Number> SurfacePoint<T> {
    /// The slope over u/R on a chord with some normal.
    #[inline(always)]
    pub fn over<const FMA: bool>(normal: Inclination<T>, u: T) -> Self {
        let height = (-u).mul_add::<FMA>(u, u.same(1.0)).sqrt();
        let sin = u.mul_add::<FMA>(normal.cos, height * normal.sin);
        let cos = height * normal.cos - u * normal.sin;
        // One division for 1/height and 1/cos.
        let over = u.same(1.0) / (height * cos);
        Self {
            sin,
            cos,
            tan: sin * (height * over),
            stretch: cos * (cos * over),
        }
    }
}

/// Ends of a zone along a chord, and whether the penetration vanishes there: else the ball itself ends.
pub(in crate::contact) type Ends = [(f64, bool); 2];

/// The line along which the ball's surface is cut: u runs along it, and the surface stands over it at √(R² − u²).
///
/// Both circles are symmetric about the common normal, so on the common chord the penetration is very nearly even in u,
/// and quadrature converges faster than along ζ, on which the zone of an inclined contact is lopsided.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Chord {
    /// Ball radius \[m\].
    pub radius: f64,
    /// The chord's normal.
    pub normal: Inclination<f64>,
}

impl Chord {
    /// The chord of a contact and the ends of its zone on it; along ζ itself where the common chord is none or a groove
    /// hugs the ball.
    pub fn of(section: &Section<f64>) -> (Self, Ends) {
        let radius = section.radius;
        let along_axis = Self {
            radius,
            normal: Inclination { cos: 1.0, sin: 0.0 },
        };
        if section.e <= 0.0 {
            // The ball is not in front of the groove's bottom: let every slice decide for itself.
            return (along_axis, [(-radius, false), (radius, false)]);
        }
        let zone = Zone::on_chord(section);
        let Inclination { cos, sin } = section.normal;
        if zone.height < SHALLOW * radius {
            let end = |side: f64| {
                let rho = zone.height * cos - side * zone.half * sin;
                if rho > 0.0 {
                    (zone.height * sin + side * zone.half * cos, true)
                } else {
                    (side * radius, false)
                }
            };
            return (along_axis, [end(-1.0), end(1.0)]);
        }
        let end = |side: f64| {
            // The ball ends at its equator, ρ = 0, towards which the normal is inclined.
            let equator = radius * cos;
            if side * sin > 0.0 && zone.half > equator {
                (side * equator, false)
            } else {
                (side * zone.half, true)
            }
        };
        let common = Self {
            radius,
            normal: section.normal,
        };
        (common, [end(-1.0), end(1.0)])
    }

    /// Place ζ of a point of the ball's surface, and dζ/du.
    pub fn zeta(&self, u: f64) -> (f64, f64) {
        let point = SurfacePoint::over::<false>(self.normal, u / self.radius);
        (self.radius * point.sin, point.stretch)
    }

    /// u of the point at a place ζ; none beyond the ball.
    pub fn u(&self, zeta: f64) -> Option<f64> {
        let Inclination { cos, sin } = self.normal;
        let square = self.radius * self.radius - zeta * zeta;
        (square > 0.0).then(|| zeta * cos - square.sqrt() * sin)
    }
}
