//! Squeeze film: what grease or oil between a ball and a race takes from their approach, whether they touch or not.

use crate::simd::Number;

/// x = c v/(1 + |g|/h), and of a film that is pulled apart at most p: F = x for x ≥ 0, x/(1 + |x|/p) below.
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | g | gap of ball and race, their approach δ where it is negative | m |
/// | v | speed at which it closes | m/s |
/// | c | damping where they just touch | N s/m |
/// | h | thickness of the film | m |
/// | p | largest pull, by which the film holds them together | N |
///
/// Source: the squeeze film of a parabolic gap, c = 12π η (R_x R_y)^{3/2}/((R_x + R_y) h), which is 310 to 1000 N s/m for a 6205's
/// outer race that is flooded (η from 0.03 to 0.1 Pa s, h = 0.3 µm) and far less where it is starved.
///
/// ```
/// use ballrace::contact::Squeeze;
/// let film = Squeeze { damping: 15.0, thickness: 3e-7, pull: 0.02 };
/// assert_eq!(film.force(0.0, 0.01), 0.15);
/// assert_eq!(film.force(3e-7, 0.01), 0.075);
/// assert!(film.force(0.0, -10.0) > -0.02);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Squeeze {
    /// c \[N s/m\].
    pub damping: f64,
    /// h \[m\].
    pub thickness: f64,
    /// p \[N\], above 0.
    pub pull: f64,
}

impl Squeeze {
    /// Force \[N\] that presses the surfaces apart, at a gap \[m\] that closes at a speed \[m/s\].
    pub fn force(&self, gap: f64, closing: f64) -> f64 {
        self.force_of(gap, closing)
    }

    /// Force on the surfaces at gaps that close at speeds, of numbers of any kind \[N\].
    #[inline(always)]
    pub(crate) fn force_of<T: Number>(&self, gap: T, closing: T) -> T {
        let thinned = gap.abs() * (1.0 / self.thickness) + 1.0;
        let force = closing * self.damping / thinned;
        let pull = force.abs() - force;
        force / (pull * (0.5 / self.pull) + 1.0)
    }
}
