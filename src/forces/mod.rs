//! Forces that are not contacts, one file each: force, energy or power, rate for step control, and its part in a run.
//!
//! [`ALL`] lists them; contributions by origin, explanations and energies go through that list and these files.

pub(crate) mod cage;
pub(crate) mod drag;
pub(crate) mod drive;
pub(crate) mod gravity;
pub(crate) mod leaning;
pub(crate) mod load;
mod rates;
mod state;
pub(crate) mod support;
pub(crate) mod unbalance;

use nalgebra::Vector3;

use crate::model::Model;

pub(crate) use rates::damping;
pub(crate) use state::{State, Table};

/// A force as an entry of the lists.
pub(crate) struct Force {
    /// Its name in an explanation.
    pub name: &'static str,
    /// The name of the contribution that it counts to.
    pub contribution: &'static str,
    /// What becomes of it in a run.
    pub used: fn(&Model) -> Use,
    /// Adds it to the forces on all bodies at a time \[s\]; what depends on all other forces comes last.
    pub add: fn(&Model, f64, &State, &mut Table),
}

/// All of them, in the order in which they are listed.
pub(crate) const ALL: [Force; 7] = [
    cage::FORCE,
    drag::FORCE,
    support::FORCE,
    gravity::FORCE,
    load::FORCE,
    unbalance::FORCE,
    drive::FORCE,
];

/// What becomes of a force in a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Use {
    /// It depends on the state or on time.
    Evaluated,
    /// It stays the same.
    Constant,
    /// The scene has none.
    Absent,
}

impl Use {
    /// Of a force that depends on the state or on time, if there is one.
    pub fn evaluated(is_there: bool) -> Self {
        if is_there {
            Self::Evaluated
        } else {
            Self::Absent
        }
    }

    /// Of a force that stays the same, if there is one.
    pub fn constant(is_there: bool) -> Self {
        if is_there {
            Self::Constant
        } else {
            Self::Absent
        }
    }
}

/// Force on a ring's centre of mass \[N\] and moment about it \[N m\], in the scene's frame.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct RingWrench {
    pub force: Vector3<f64>,
    pub moment: Vector3<f64>,
}

/// What a force keeps and takes.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Account {
    /// Stored \[J\].
    pub energy: f64,
    /// Dissipated \[W\].
    pub power: f64,
}
