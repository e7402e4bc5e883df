//! Questions about a state: loads of its contacts, its energy, its films, the moments of its
//! rings, its stiffest elements.

mod contacts;
mod energy;
mod films;
mod lubrication;
mod moments;
mod powers;
mod stiffest;

pub use contacts::{ContactSummary, SliceForce, contact, slice_forces};
pub(crate) use contacts::{film_slip, largest_pressure, pressure, visit};
pub use energy::{Energy, cage_forces, energy};
pub(crate) use films::doubts;
pub use films::{RaceFilm, films};
pub use lubrication::{Lubrication, lubrication};
pub(crate) use moments::{MOMENTS, MomentOnRing, between};
pub use moments::{moments, wrench};
pub(crate) use stiffest::{StiffElement, stiffest};
