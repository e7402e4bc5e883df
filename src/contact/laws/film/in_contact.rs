//! The film of a race, and what it does in a contact as a whole.

// Into loops that are compiled for the instructions at hand.
#![allow(clippy::inline_always)]

use super::{Film, FilmNow};
use crate::simd::Number;

/// The film of a race of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oiled {
    /// What stays during a run.
    pub film: Film,
    /// What it is at the present speed of the rings.
    pub now: FilmNow,
    /// Radius of the groove without the coat \[m\].
    pub bare_radius: f64,
}

impl Oiled {
    /// At the rings' speed against each other \[rad/s\].
    pub fn new(film: Film, bare_radius: f64, speed: f64) -> Self {
        Self {
            film,
            now: film.at(speed / film.reference().speed),
            bare_radius,
        }
    }
}

/// What the film of a contact does.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct FilmEffect<T> {
    /// Half of the slip speed at which traction bends \[m/s\].
    pub bend: T,
    /// 3/2 α_f \[s/m\].
    pub damping: T,
    /// Rolling resistance over the entrainment speed \[N s/m\].
    pub rolling: T,
}

impl<T: Number> FilmEffect<T> {
    /// None.
    #[inline(always)]
    pub fn none(like: T) -> Self {
        let zero = like.same(0.0);
        Self {
            bend: zero,
            damping: zero,
            rolling: zero,
        }
    }

    /// In a contact whose zone is half as long as this \[m\]; none without a film.
    #[inline(always)]
    pub fn of(film: Option<&Oiled>, half: T) -> Self {
        match film {
            None => Self::none(half),
            Some(oiled) => Self::at(oiled, half * (1.0 / oiled.film.reference().half_length)),
        }
    }

    /// In a contact by the cube root r of its load over the reference load.
    #[inline(always)]
    pub fn at(oiled: &Oiled, r: T) -> Self {
        Self {
            bend: oiled.now.bend(r),
            damping: oiled.now.damping(r),
            rolling: oiled.now.rolling(r),
        }
    }
}
