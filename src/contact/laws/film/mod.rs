//! Oil between ball and race: thickness of the film, its damping, friction and rolling resistance ([*Film*](crate::equations#film)).
//!
//! [`Oil`] is an oil at its temperature, [`Film`] what is constant of a race of a row, [`FilmNow`] what depends on the
//! rings' speed only; of a contact it then asks one number, r = half/half_ref, which is the cube root of its load over the
//! reference load. `thickness`, `damping`, `traction` and `rolling` have a formula each with its source.
//!
//! Symbols throughout: R_x, R_y effective radii along the race and across it; a, b half-length and half-width of the
//! ellipse at the reference load, ε = b/a; w the rings' relative speed over the reference speed, w̃ = √(w² + 1/400); u_ref
//! the entrainment speed of pure rolling at w = 1, ũ = w̃ u_ref; ζ_h = h/δ_ref film over approach at the reference load.

mod conjunction;
mod constants;
mod damping;
mod in_contact;
mod now;
mod oil;
mod rolling;
mod speed;
#[cfg(test)]
mod tests;
mod thickness;
mod traction;

pub use conjunction::LubricatedRace;
pub use constants::{Effects, Film, Limits, Reference};
#[doc(hidden)]
pub use in_contact::Oiled;
pub(crate) use in_contact::{FilmEffect, FilmNumbers};
pub use now::FilmNow;
pub use oil::Oil;
