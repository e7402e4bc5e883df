//! The film of a race, and its effect on a whole contact.

use super::damping::DampingNow;
use super::rolling::RollingNow;
use super::traction::TractionNow;
use super::{Film, FilmNow};
use crate::simd::{Lanes, Number};

/// The film of a race of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oiled {
    /// The film, which stays during a run.
    pub film: Film,
    /// The film at the present speed of the rings.
    pub now: FilmNow,
    /// Radius of the groove without the film \[m\].
    pub bare_radius: f64,
}

impl Oiled {
    /// A film at the rings' speed against each other \[rad/s\].
    pub fn new(film: Film, bare_radius: f64, speed: f64) -> Self {
        Self {
            film,
            now: film.at(speed / film.reference().speed),
            bare_radius,
        }
    }
}

/// The numbers of a film that contacts ask for, or of the films of eight contacts.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct FilmNumbers<T> {
    /// 1/half_ref \[1/m\].
    shortness: T,
    traction: TractionNow<T>,
    damping: DampingNow<T>,
    rolling: RollingNow<T>,
}

impl FilmNumbers<f64> {
    /// The numbers of a race's film.
    pub fn new(oiled: &Oiled) -> Self {
        Self {
            shortness: 1.0 / oiled.film.reference().half_length,
            traction: oiled.now.traction,
            damping: oiled.now.damping,
            rolling: oiled.now.rolling,
        }
    }
}

impl FilmNumbers<Lanes> {
    /// Takes the numbers of one contact into a lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, of: &FilmNumbers<f64>) {
        self.shortness[lane] = of.shortness;
        self.traction.set(lane, &of.traction);
        self.damping.set(lane, &of.damping);
        self.rolling.set(lane, &of.rolling);
    }
}

/// Effect of a contact's film.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct FilmEffect<T> {
    /// Friction coefficient μ at large slip.
    pub friction: T,
    /// Half of the slip speed at which traction bends \[m/s\].
    pub bend: T,
    /// 3/2 α_f \[s/m\].
    pub damping: T,
    /// Rolling resistance over the entrainment speed \[N s/m\].
    pub rolling: T,
}

impl<T> FilmEffect<T> {
    /// Each of its numbers by a function.
    #[inline(always)]
    pub fn map<U>(&self, f: impl Fn(&T) -> U) -> FilmEffect<U> {
        FilmEffect {
            friction: f(&self.friction),
            bend: f(&self.bend),
            damping: f(&self.damping),
            rolling: f(&self.rolling),
        }
    }
}

impl<T: Number> FilmEffect<T> {
    /// The effect in a contact whose zone is half as long as this \[m\]; none without a film.
    #[inline(always)]
    pub fn of(film: Option<&FilmNumbers<T>>, half: T) -> Self {
        match film {
            None => FilmEffect::<f64>::default().map(|none| half.same(*none)),
            Some(film) => Self::at(film, half * film.shortness),
        }
    }

    /// The effect in a contact by the cube root r of its load over the reference load.
    #[inline(always)]
    pub fn at(film: &FilmNumbers<T>, r: T) -> Self {
        let [oil, steel] = film.rolling.parts(r);
        Self {
            friction: film.traction.friction,
            bend: film.traction.bend(r),
            damping: film.damping.rate(r),
            rolling: oil + steel,
        }
    }
}
