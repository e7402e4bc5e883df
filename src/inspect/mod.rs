//! Questions about a state: what its contacts carry, what energy it holds, what its oil does, which elements are stiffest.

mod contacts;
mod energy;
mod films;
mod lubrication;
mod powers;
mod stiffest;

pub use contacts::{ContactSummary, SliceForce, contact, slice_forces};
pub(crate) use contacts::{film_slip, largest_pressure, pressure};
pub use energy::{Energy, cage_forces, energy};
pub(crate) use films::doubts;
pub use films::{RaceFilm, films};
pub use lubrication::{Lubrication, lubrication};
pub(crate) use stiffest::{Element, stiffest};
