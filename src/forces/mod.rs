//! Forces that are not contacts, one file each, and the one list of them.
//!
//! The trait [`Force`] is all that others need of a force: the force itself, the energy it stores and the power it dissipates, the rate
//! of its damping, its effect at rest, and the symmetries that it keeps. The right-hand side, contributions by origin, statics,
//! energies, scales, reductions and explanations go through [`ALL`]: a force that is entered there is in all of them, but for the scales of a model, which are estimated before ([`crate::model::Scales`]). Forces of a user's own code are one entry ([`outside`]).

pub(crate) mod blame;
pub(crate) mod cage;
pub(crate) mod drag;
pub(crate) mod drive;
pub(crate) mod gravity;
pub(crate) mod load;
pub(crate) mod outside;
mod rates;
pub(crate) mod squeeze;
mod state;
pub(crate) mod structure;
mod sums;
pub(crate) mod support;
pub(crate) mod tilted;
pub(crate) mod unbalance;

use std::fmt::Debug;
use std::ops::AddAssign;

use crate::model::{BodyId, DOFS, Model, Race};
use crate::scene::RingMotion;

pub(crate) use rates::damping;
pub(crate) use state::{State, Table};
pub(crate) use sums::{ForceSums, Instant, RingWrench};

/// The forces that are not contacts, in the order in which they are summed and listed.
pub(crate) const ALL: [&dyn Force; 11] = [
    &cage::links::LinkForces,
    &cage::ring::CageRings,
    &drag::Drag,
    &squeeze::SqueezeFilms,
    &support::Supports,
    &structure::Seat,
    &gravity::Gravity,
    &load::Loads,
    &drive::DriveTorque,
    &outside::Outside,
    &unbalance::Unbalances,
];

/// A force that is no contact: everything that is asked of it.
pub(crate) trait Force: Debug + Sync {
    /// Name of the force in an explanation.
    fn name(&self) -> &'static str;

    /// The name of the contribution that it counts to.
    fn contribution(&self) -> &'static str {
        self.name()
    }

    /// Whether few scenes have it: an explanation does not list it among what is absent.
    fn is_rare(&self) -> bool {
        false
    }

    /// Use of the force in a run.
    fn used(&self, model: &Model) -> Use;

    /// Adds the part that neither time nor state changes.
    fn add_constant(&self, _model: &Model, _sums: &mut ForceSums<'_>) {}

    /// Adds the rest of it.
    fn add(&self, _model: &Model, _at: &Instant<'_>, _sums: &mut ForceSums<'_>) {}

    /// Whether the force depends on the sum of all other forces on a ring, and is asked for by [`Force::given_others`].
    fn waits_for_others(&self) -> bool {
        false
    }

    /// The wrench on a ring, given all other forces on it along x, y, z and about z.
    fn given_others(
        &self,
        _model: &Model,
        _at: &Instant<'_>,
        _race: Race,
        _others: &[f64; DOFS],
    ) -> Option<RingWrench> {
        None
    }

    /// Energy that the force stores and power that it takes in a state.
    fn account(&self, model: &Model, y: &[f64]) -> Account;

    /// Dampers of the force, for the message of a run whose steps collapse.
    fn dampers(&self, model: &Model) -> Vec<Damper>;

    /// The wrench on a ring at the start, wherever the ring is: the force, and a moment in the ring's frame about its centre of
    /// mass. Springs of supports are no part of it.
    fn at_start(&self, model: &Model, race: Race) -> RingWrench;

    /// The wrench at the start on a ring that is elsewhere, of a force that depends on the ring's place.
    fn at_place(&self, _model: &Model, _race: Race, _ring: &RingMotion) -> RingWrench {
        RingWrench::default()
    }

    /// Effects of the force by which a run cannot leave out a degree of freedom or half of the bearing.
    fn asymmetry(&self, model: &Model) -> Asymmetry;
}

/// Effects of a force by which a run cannot leave out what it would without it.
#[derive(Debug, Default)]
pub(crate) struct Asymmetry {
    /// The part that acts along z, in words.
    pub along_z: Option<String>,
    /// The part that tilts a ring, in words.
    pub tilting: Option<String>,
    /// Whether the force depends on the angle of the inner ring.
    pub turns_with_ring: bool,
}

/// Use of a force in a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Use {
    /// A force that depends on the state or on time.
    Evaluated,
    /// A force that stays the same.
    Constant,
    /// The scene has none.
    Absent,
}

impl Use {
    /// The use of a force that depends on the state or on time, if there is one.
    pub fn evaluated(is_there: bool) -> Self {
        if is_there {
            Self::Evaluated
        } else {
            Self::Absent
        }
    }

    /// The use of a force that stays the same, if there is one.
    pub fn constant(is_there: bool) -> Self {
        if is_there {
            Self::Constant
        } else {
            Self::Absent
        }
    }
}

/// Account of a force: energy that it stores \[J\], by the field of [`crate::inspect::Energy`] that it counts to, and power that it takes \[W\].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Account {
    pub kinetic: f64,
    pub support: f64,
    pub cage: f64,
    pub gravity: f64,
    /// Dissipated in supports and cage.
    pub power: f64,
    /// Dissipated in squeeze films.
    pub damping: f64,
}

impl AddAssign for Account {
    fn add_assign(&mut self, other: Self) {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            kinetic,
            support,
            cage,
            gravity,
            power,
            damping,
        } = other;
        self.kinetic += kinetic;
        self.support += support;
        self.cage += cage;
        self.gravity += gravity;
        self.power += power;
        self.damping += damping;
    }
}

/// Damper of a body.
pub(crate) struct Damper {
    /// `row0.cage` or `outer.support`.
    pub name: String,
    /// A body it acts on.
    pub body: BodyId,
    /// Rate at which it ends the body's motion \[1/s\].
    pub rate: f64,
}
