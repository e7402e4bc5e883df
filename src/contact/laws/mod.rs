//! The laws of a contact: where it is cut, elastic force of an element, damping, friction, oil.
//!
//! Each law is written once, for any kind of number: for one contact, for eight side by side, and with derivatives.

pub mod cut;
#[doc(hidden)]
pub mod damping;
pub mod elastic;
pub mod film;
pub mod squeeze;
#[doc(hidden)]
pub mod traction;

pub use cut::Cut;
#[doc(hidden)]
pub use damping::Damping;
pub use elastic::Elastic;
#[doc(hidden)]
pub use squeeze::Squeeze;
#[doc(hidden)]
pub use traction::Traction;

use film::Oiled;

/// The laws that all contacts of a row's balls with one race follow.
#[doc(hidden)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Law {
    /// Elastic force of an element by its penetration.
    pub elastic: Elastic,
    /// Damping of the approach.
    pub damping: Damping,
    /// Friction, if any.
    pub traction: Option<Traction>,
    /// The oil film, if any.
    pub film: Option<Oiled>,
}

impl Law {
    /// An elastic law alone.
    pub fn elastic(elastic: Elastic) -> Self {
        Self {
            elastic,
            damping: Damping {
                coefficient: 0.0,
                clamp_pull: true,
            },
            traction: None,
            film: None,
        }
    }

    /// Whether friction and films follow the same equations as another law's: numbers of films may differ.
    pub(crate) fn rubs_like(&self, other: &Self) -> bool {
        let effects = |law: &Self| law.film.map(|oiled| oiled.film.effects());
        let films = |law: &Self| law.traction.is_some_and(|traction| traction.is_film());
        effects(self) == effects(other)
            && (self.traction == other.traction || films(self) && films(other))
    }

    /// Whether forces along the race turn balls: friction's, or rolling resistance.
    pub(crate) fn turns_balls(&self) -> bool {
        self.traction.is_some() || self.film.is_some_and(|oiled| oiled.film.effects().rolling)
    }

    /// Whether friction is that of a film.
    pub(crate) fn rubs_by_film(&self) -> bool {
        self.traction.is_some_and(|law| law.is_film())
    }

    /// Whether the approach is damped, by the steel or by a film.
    pub(crate) fn damps(&self) -> bool {
        let by_film = self.film.is_some_and(|oiled| oiled.film.effects().damping);
        self.damping.rate() > 0.0 || by_film
    }

    /// Whether motion is resisted at all.
    pub(crate) fn takes_energy(&self) -> bool {
        self.turns_balls() || self.damps()
    }

    /// The cut of the ball, by the elastic law.
    pub fn cut(&self) -> Cut {
        self.elastic.cut()
    }
}
