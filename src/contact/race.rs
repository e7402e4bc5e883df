//! Races as functions R(z): the torus (model section 2).

use crate::scene::Waviness;
use crate::simd::Lanes;

/// A groove that is part of a torus: R(z) = a ± √(r² − (z − z₀)²), + for the outer race.
///
/// ```
/// use ballrace::contact::Torus;
/// let outer = Torus { sigma: 1.0, a: 30e-3, centre: 0.0, r: 6e-3, lowest: -6e-3, highest: 6e-3 };
/// assert!((outer.radius(0.0).unwrap() - 36e-3).abs() < 1e-15);
/// assert!(outer.radius(6e-3).is_none());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torus {
    /// +1 for an outer, −1 for an inner race.
    pub sigma: f64,
    /// Radius of the circle of groove centres a_o or a_i \[m\].
    pub a: f64,
    /// Axial place of the groove's centre z_o or z_i in the ring's frame \[m\].
    pub centre: f64,
    /// Groove radius r \[m\].
    pub r: f64,
    /// Where the race ends towards −z, from the groove's centre \[m\].
    pub lowest: f64,
    /// Where the race ends towards +z, from the groove's centre \[m\].
    pub highest: f64,
}

/// Share of its radius by which a ball is pressed into a race, or past the point where it would touch behind the
/// groove's centre, when it is lost.
const LOST: f64 = 0.5;

impl Torus {
    /// Distance \[m\] from the groove's centre, in the meridional plane, at which the centre of a ball of some radius is
    /// lost. Whichever way it went, no contact means anything from there on: it is pressed into the race by half its
    /// radius, stands beside the groove, or is off the race and half out at the other side.
    ///
    /// ```
    /// use ballrace::contact::Torus;
    /// let outer = Torus { sigma: 1.0, a: 30e-3, centre: 0.0, r: 6e-3, lowest: -6e-3, highest: 6e-3 };
    /// assert!((outer.farthest(5e-3) - 3.5e-3).abs() < 1e-15);
    /// ```
    pub fn farthest(&self, radius: f64) -> f64 {
        self.r - LOST * radius
    }

    /// Race radius \[m\] at an axial place of the ring's frame \[m\], whether or not a shoulder has
    /// cut it off; none where |z − z₀| ≥ r.
    pub fn radius(&self, z: f64) -> Option<f64> {
        let x = z - self.centre;
        let square = self.r * self.r - x * x;
        (square > 0.0).then(|| self.a + self.sigma * square.sqrt())
    }

    /// dR/dz at an axial place where the race has this radius.
    pub fn slope(&self, z: f64, radius: f64) -> f64 {
        (self.centre - z) / (radius - self.a)
    }

    /// Whether the race reaches to that axial place.
    pub fn reaches(&self, z: f64) -> bool {
        let x = z - self.centre;
        x >= self.lowest && x <= self.highest
    }

    /// The ball in the groove's meridional plane, for a ball at distance `d` from the ring's axis and at
    /// axial place `z`, the race raised by `wave` \[m\].
    pub fn meridian(&self, d: f64, z: f64, wave: f64) -> Meridian {
        Meridian {
            e: self.sigma * (d - self.a - wave),
            c: self.centre - z,
            r: self.r,
        }
    }
}

/// Ball and groove as two circles in the meridional plane: the ball's centre is the origin, the groove's
/// centre lies at axial place c and at −e along the outward normal; both races look alike here.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Meridian {
    /// Distance of the ball's centre from the groove's centre along n_e \[m\].
    pub e: f64,
    /// Axial place of the groove's centre from the ball's \[m\].
    pub c: f64,
    /// Groove radius \[m\].
    pub r: f64,
}

impl Meridian {
    /// Distance of the two centres \[m\].
    pub fn distance(&self) -> f64 {
        (self.e * self.e + self.c * self.c).sqrt()
    }

    /// Normal approach δ of a ball of the given radius; negative without contact \[m\].
    pub fn approach(&self, radius: f64) -> f64 {
        self.distance() + radius - self.r
    }

    /// (cos α', sin α') of the common normal, out of the ball.
    pub fn normal(&self) -> (f64, f64) {
        let l = self.distance();
        (self.e / l, -self.c / l)
    }

    /// The touching zone of a ball of the given radius, in closed form: where the two circles cut. None without
    /// contact.
    pub fn zone(&self, radius: f64) -> Option<Chord> {
        if self.e <= 0.0 {
            // The ball is not in front of the groove's bottom: let every slice decide for itself.
            return Some(Chord {
                radius,
                normal: (1.0, 0.0),
                ends: [(-radius, false), (radius, false)],
            });
        }
        let l = self.distance();
        if l + radius <= self.r {
            return None;
        }
        let (cos, sin) = self.normal();
        // The chord stands at R − sum from the ball's centre; without the cancellation in l² + R² − r².
        let sum = (l + radius - self.r) * (l + radius + self.r) / (2.0 * l);
        let height = radius - sum;
        let half = (sum * (2.0 * radius - sum)).max(0.0).sqrt();
        if height < SHALLOW * radius {
            // A groove that hugs the ball: the zone goes round it, and ζ itself is the better line.
            let end = |side: f64| {
                let rho = height * cos - side * half * sin;
                if rho > 0.0 {
                    (height * sin + side * half * cos, true)
                } else {
                    (side * radius, false)
                }
            };
            return Some(Chord {
                radius,
                normal: (1.0, 0.0),
                ends: [end(-1.0), end(1.0)],
            });
        }
        let end = |side: f64| {
            // The ball ends at its equator, ρ = 0, towards which the normal leans.
            let equator = radius * cos;
            if side * sin > 0.0 && half > equator {
                (side * equator, false)
            } else {
                (side * half, true)
            }
        };
        Some(Chord {
            radius,
            normal: (cos, sin),
            ends: [end(-1.0), end(1.0)],
        })
    }
}

/// Height of a chord over the ball's centre, as a share of its radius, below which a zone is not cut along it.
pub(super) const SHALLOW: f64 = 0.2;

/// A zone along the chord that ball and groove have in common: u runs along the common tangent, and the ball's
/// surface stands over it at √(R² − u²).
///
/// Both circles are symmetric about the common normal, so the penetration is very nearly even in u, and quadrature
/// converges faster than along ζ, on which the zone of an inclined contact is lopsided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chord {
    /// Ball radius \[m\].
    pub radius: f64,
    /// (cos α', sin α') of the common normal.
    pub normal: (f64, f64),
    /// Ends of u, and whether the penetration vanishes there: else the ball itself ends.
    pub ends: [(f64, bool); 2],
}

impl Chord {
    /// Place ζ of a point of the ball's surface, and dζ/du.
    pub fn zeta(&self, u: f64) -> (f64, f64) {
        let (cos, sin) = self.normal;
        let height = (self.radius * self.radius - u * u).sqrt();
        let rho = height * cos - u * sin;
        (height * sin + u * cos, rho / height)
    }

    /// u of the point at a place ζ; none beyond the ball.
    pub fn u(&self, zeta: f64) -> Option<f64> {
        let (cos, sin) = self.normal;
        let square = self.radius * self.radius - zeta * zeta;
        (square > 0.0).then(|| zeta * cos - square.sqrt() * sin)
    }
}

/// How waves raise a race under a ball, or under eight \[m\].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Raise<T> {
    /// Of the radius.
    pub height: T,
    /// Its derivative by the angle R'(φ).
    pub slope: T,
}

impl Raise<Lanes> {
    /// Eight places one by one.
    pub(super) fn each(of: impl Fn(usize) -> Raise<f64>) -> Self {
        let mut slope = Lanes::ZERO;
        let height = Lanes::from_fn(|lane| {
            let raise = of(lane);
            slope[lane] = raise.slope;
            raise.height
        });
        Self { height, slope }
    }

    /// Takes over a place into a lane.
    pub(crate) fn set(&mut self, lane: usize, of: Raise<f64>) {
        (self.height[lane], self.slope[lane]) = (of.height, of.slope);
    }
}

/// The harmonics of a race's radius.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Waves(pub Vec<Waviness>);

impl Waves {
    /// Whether the race is round.
    pub fn is_round(&self) -> bool {
        self.0.is_empty()
    }

    /// Raise of the radius \[m\] at an angle in the ring's own frame \[rad\].
    pub fn at(&self, angle: f64) -> f64 {
        self.0
            .iter()
            .map(|w| w.amplitude * (f64::from(w.order) * angle + w.phase).cos())
            .sum()
    }

    /// The same with its derivative by the angle.
    pub fn raise(&self, angle: f64) -> Raise<f64> {
        let mut raise = Raise::default();
        for w in &self.0 {
            let order = f64::from(w.order);
            let (sin, cos) = (order * angle + w.phase).sin_cos();
            raise.height += w.amplitude * cos;
            raise.slope -= w.amplitude * order * sin;
        }
        raise
    }

    /// Second derivative of the radius by the angle \[m\].
    pub fn bend(&self, angle: f64) -> f64 {
        let of = |w: &Waviness| {
            let order = f64::from(w.order);
            -order * order * w.amplitude * (order * angle + w.phase).cos()
        };
        self.0.iter().map(of).sum()
    }
}
