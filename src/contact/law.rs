//! The elastic laws behind one door.

use super::{hertz, iso16281};

/// Elastic force of a slice from its penetration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// The paper's law.
    Iso16281(iso16281::Iso16281),
    /// Hertz's law.
    Hertz(hertz::Hertz),
}

impl Law {
    /// Power of the penetration that the force goes with.
    pub fn exponent(&self) -> f64 {
        match self {
            Self::Iso16281(_) => iso16281::EXPONENT,
            Self::Hertz(_) => hertz::EXPONENT,
        }
    }

    /// Force of a slice \[N\] at a penetration \[m\], 0 where it is not positive.
    #[inline]
    pub fn force(&self, depth: f64, width: f64) -> f64 {
        if depth <= 0.0 {
            return 0.0;
        }
        match self {
            Self::Iso16281(law) => law.force(depth, width),
            Self::Hertz(law) => law.force(depth, width),
        }
    }

    /// Elastic energy of a slice \[J\]; its derivative is the force.
    pub fn energy(&self, depth: f64, width: f64) -> f64 {
        if depth <= 0.0 {
            return 0.0;
        }
        match self {
            Self::Iso16281(law) => law.energy(depth, width),
            Self::Hertz(law) => law.energy(depth, width),
        }
    }
}

/// Hunt–Crossley factor on the elastic force, 1 + 1.5 α_d v_n (equations 2 and 4).
///
/// K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440: restitution is about 1 − α_d v.
///
/// ```
/// assert_eq!(ballrace::contact::law::hunt_crossley(0.2, 1.0), 1.3);
/// ```
#[inline]
pub fn hunt_crossley(damping: f64, approach: f64) -> f64 {
    1.0 + 1.5 * damping * approach
}
