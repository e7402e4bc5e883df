//! A film at a speed of the rings.

use super::damping::DampingNow;
use super::rolling::RollingNow;
use super::traction::TractionNow;

/// A film at a speed of the rings; with a steady drive it stays.
///
/// Of a contact it asks for r = half/half_ref, the cube root of its load over the reference load; r = 0 is a contact that just
/// begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmNow {
    /// h \[m\].
    pub(super) film: f64,
    /// h where it separates the surfaces, else 0 \[m\].
    pub(super) layer: f64,
    /// s_q \[m\].
    pub(super) roughness: f64,
    /// ũ \[m/s\].
    pub(super) entrainment: f64,
    pub(super) traction: TractionNow,
    pub(super) damping: DampingNow,
    pub(super) rolling: RollingNow,
}

impl FilmNow {
    /// Thickness h of the film on the ring \[m\]; 0 where the film is left out, though the other effects use it.
    pub fn thickness(&self) -> f64 {
        self.layer
    }

    /// Thickness h in the middle of a contact \[m\], also where the film is left out and only other effects use it.
    pub fn central(&self) -> f64 {
        self.film
    }

    /// Least thickness of the film, 0.8 h \[m\].
    pub fn minimum(&self) -> f64 {
        0.8 * self.film
    }

    /// λ = h/s_q.
    pub fn lambda(&self) -> f64 {
        self.film / self.roughness
    }

    /// Entrainment speed ũ \[m/s\] at which balls roll.
    pub fn entrainment(&self) -> f64 {
        self.entrainment
    }

    /// Friction coefficient μ at large slip.
    pub fn friction(&self) -> f64 {
        self.traction.friction
    }

    /// v \[m/s\]: friction is −μ F u⃗ / (v/2 + √(u² + v²/4)).
    pub fn slip_scale(&self, r: f64) -> f64 {
        2.0 * self.bend(r)
    }

    /// c = v/2 \[m/s\].
    pub(crate) fn bend(&self, r: f64) -> f64 {
        self.traction.bend(r)
    }

    /// F_R over the entrainment speed u of the contact \[N s/m\], of film and of steel.
    pub(crate) fn rolling_parts(&self, r: f64) -> [f64; 2] {
        self.rolling.parts(r)
    }
}
