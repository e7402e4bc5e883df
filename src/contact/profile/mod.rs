//! Races as functions R(z), and a ball at one in their meridional plane.
//!
//! A race is a torus ([*Geometry of a row*](crate::equations#geometry-of-a-row)), a curve through points (`curve`; `contour` finds the
//! contacts with it, `meeting` their zones). A gothic arch is two tori; see `scalar/shape.rs`.

mod contour;
mod curve;
mod heights;
mod meeting;
mod raise;
mod section;
mod waves;
mod zone;

pub(crate) use contour::{Before, Contour};
pub(super) use contour::{FLAT, SNUG};
pub(crate) use curve::Curve;
pub(crate) use heights::HeightTable;
pub(super) use meeting::{Meeting, REACH, RaceSurface};
pub(crate) use raise::Raise;
pub(crate) use section::{Inclination, Section};
pub use waves::Waves;
pub(super) use zone::{Chord, Ends, SHALLOW, SurfacePoint, Zone};

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
    /// End of the race towards −z, from the groove's centre \[m\].
    pub lowest: f64,
    /// End of the race towards +z, from the groove's centre \[m\].
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
        self.groove(z).map(|height| self.a + self.sigma * height)
    }

    /// Height of the groove over its centre, √(r² − (z − z₀)²) \[m\]; none where there is none.
    pub(crate) fn groove(&self, z: f64) -> Option<f64> {
        let x = z - self.centre;
        let square = self.r * self.r - x * x;
        (square > 0.0).then(|| square.sqrt())
    }

    /// dR/dz at an axial place where the race has this radius.
    pub fn slope(&self, z: f64, radius: f64) -> f64 {
        (self.centre - z) / (radius - self.a)
    }

    /// Whether no shoulder cuts the race off before that axial place.
    pub fn reaches(&self, z: f64) -> bool {
        let x = z - self.centre;
        // A groove without a shoulder ends where it turns back.
        (x >= self.lowest || self.lowest <= -self.r)
            && (x <= self.highest || self.highest >= self.r)
    }

    /// A ball of some radius in the groove's meridional plane, at distance `d` from the ring's axis and at axial place
    /// `z`, the race raised by `wave` \[m\].
    pub(crate) fn section(&self, radius: f64, d: f64, z: f64, wave: f64) -> Section<f64> {
        let e = self.sigma * (d - self.a - wave);
        Section::new::<false, false>(radius, self.r, e, self.centre - z)
    }
}
