//! Which code an evaluation runs, in words.

use super::Dynamics;
use crate::contact::{Law, Pair, Slices};
use crate::model::Race;
use crate::scene::{Drive, TimeFunction};

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

impl Dynamics<'_> {
    /// The forces by name and what becomes of them.
    pub(crate) fn uses(&self) -> Vec<(&'static str, Use)> {
        let model = self.model;
        let when = |there: bool| if there { Use::Evaluated } else { Use::Absent };
        let fixed = |constant: bool, there: bool| match (there, constant) {
            (false, _) => Use::Absent,
            (true, true) => Use::Constant,
            (true, false) => Use::Evaluated,
        };
        let any = |of: fn(&Pair) -> bool| model.rows.iter().flat_map(|row| &row.pairs).any(of);
        let steady = |value: &TimeFunction| matches!(value, TimeFunction::Constant(_));
        let loads = model.loads.iter().filter(|load| load.force.peak() > 0.0);
        let torque = match &model.scene.drive {
            Drive::Torque { value, .. } => value.peak() > 0.0,
            Drive::Speed(_) => false,
        };
        vec![
            ("contact", Use::Evaluated),
            ("damping", when(any(|pair| pair.damping > 0.0))),
            ("friction", when(any(|pair| pair.friction.is_some()))),
            ("defects", when(!model.scene.defects.is_empty())),
            ("waviness", when(any(|pair| !pair.waves.is_round()))),
            ("cage", when(model.scene.cage.is_some())),
            ("support", when(!model.springs.is_empty())),
            ("gravity", fixed(true, model.scene.gravity != [0.0; 3])),
            (
                "load",
                fixed(
                    loads.clone().all(|load| steady(&load.force)),
                    loads.count() > 0,
                ),
            ),
            ("unbalance", when(!model.unbalances.is_empty())),
            ("drive", when(torque)),
        ]
    }

    /// Whether the contacts of a row have a part in the motion.
    pub(crate) fn evaluates(&self, row: usize) -> bool {
        self.contacts.rows().contains(&row) || self.contacts.is_mirrored()
    }

    /// How the contacts of a row with a race are evaluated where nothing is in their way.
    pub(crate) fn evaluation(&self, row: usize, race: Race) -> String {
        if !self.contacts.rows().contains(&row) {
            let instead = if self.contacts.is_mirrored() {
                "image of row 0"
            } else {
                "left out by request"
            };
            return instead.to_owned();
        }
        if self.contacts.is_closed(row, race) {
            return "closed form".to_owned();
        }
        let pair = &self.model.rows[row].pairs[race];
        let law = match pair.law {
            Law::Iso16281(_) => "ISO law",
            Law::Hertz(_) => "Hertz law",
        };
        let count = pair.slices.count();
        let slices = match &pair.slices {
            Slices::Fixed(_) => "slices",
            Slices::Fitted(_) => "nodes",
        };
        if self.contacts.is_plane() {
            let half = count.div_ceil(2);
            format!("{half} of {count} {slices} (mirror symmetry), {law}")
        } else {
            format!("{count} {slices}, {law}")
        }
    }
}
