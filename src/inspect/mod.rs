//! Questions about a state: loads of its contacts, its energy, its films, the moments of its
//! rings, its stiffest elements.

mod checked;
mod contacts;
mod energy;
mod films;
mod lubrication;
mod moments;
mod powers;
mod stiffest;

pub use checked::{
    cage_forces, contact, energy, lubrication, moments, seat_force, sensor_acceleration,
    slice_forces, wrench,
};
pub use contacts::{ContactSummary, SliceForce};
pub(crate) use contacts::{film_slip, largest_pressure, pressure, visit};
pub use energy::Energy;
pub(crate) use films::doubts;
pub use films::{RaceFilm, films};
pub use lubrication::Lubrication;
pub(crate) use moments::{MOMENTS, MomentOnRing, between};
pub(crate) use stiffest::{StiffElement, stiffest};

/// The questions about a state that this crate has made, which needs no check.
pub(crate) mod raw {
    pub(crate) use super::contacts::{contact, slice_forces};
    pub(crate) use super::energy::{cage_forces, energy};
    pub(crate) use super::lubrication::lubrication;
    pub(crate) use super::moments::{moments, wrench};
}
