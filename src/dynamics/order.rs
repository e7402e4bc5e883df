//! Conversion from the states of all bodies to those of a run, and back.

use super::Dynamics;
use super::kept::Kept;
use crate::model::{BodyId, Dof};

/// Order of the numbers of a state vector.
#[derive(Debug)]
pub(super) enum Order {
    /// Everything, body by body, as [`crate::model::Model::names`] says.
    Bodies,
    /// The directions that a reduction keeps, one by one.
    Kept(Box<Kept>),
}

impl Dynamics<'_> {
    /// Body and direction of each state of the first half of a state vector, in their order.
    pub(crate) fn degrees(&self) -> Vec<(BodyId, Dof)> {
        match &self.order {
            Order::Bodies => self.model.layout().degrees().collect(),
            Order::Kept(kept) => kept.reduction.degrees().collect(),
        }
    }

    /// The states of a run ([`crate::integrate::System::dim`] of them) out of those of all bodies ([`crate::model::Model::dim`]).
    ///
    /// # Panics
    /// If `full` is too short.
    pub fn compress(&self, full: &[f64]) -> Vec<f64> {
        match &self.order {
            Order::Bodies => full.to_vec(),
            Order::Kept(kept) => kept.reduction.compress(full),
        }
    }

    /// The states of all bodies at a time \[s\] from those of a run; `full` holds them from another time.
    ///
    /// # Panics
    /// If a length is wrong.
    pub fn expand(&self, t: f64, y: &[f64], full: &mut [f64]) {
        match &self.order {
            Order::Bodies => full.copy_from_slice(y),
            Order::Kept(kept) => kept.reduction.expand(self.model, t, y, full),
        }
    }

    /// The rates of all bodies' states at a time \[s\] from those of a run's states.
    ///
    /// # Panics
    /// If a length is wrong.
    pub fn expand_rates(&self, t: f64, dy: &[f64], full: &mut [f64]) {
        match &self.order {
            Order::Bodies => full.copy_from_slice(dy),
            Order::Kept(kept) => kept.reduction.expand_rates(self.model, t, dy, full),
        }
    }

    /// Symmetry of the run's rows: whether one stands for two.
    pub(crate) fn is_mirrored(&self) -> bool {
        self.contacts.is_mirrored()
    }

    /// Gives a second row that is the image of the first its changes of velocity, out of those of all bodies.
    pub(crate) fn mirror(&self, changes: &mut [f64]) {
        if let Order::Kept(kept) = &self.order {
            kept.reduction.mirror(self.model, changes);
        }
    }
}
