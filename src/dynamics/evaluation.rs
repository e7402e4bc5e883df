//! Names of the code that an evaluation runs.

use std::ops::Range;

use super::Dynamics;
use crate::contact::{Pair, ZoneSlices};
use crate::forces::{self, Use};
use crate::model::Race;

impl Dynamics<'_> {
    /// Uses of all forces by name: what becomes of each in a run.
    pub(crate) fn uses(&self) -> Vec<(&'static str, Use)> {
        let model = self.model;
        let any = |of: fn(&Pair) -> bool| {
            let mut pairs = model.rows.iter().flat_map(|row| &row.pairs);
            Use::evaluated(pairs.any(of))
        };
        let contacts = [
            ("contact", Use::Evaluated),
            ("damping", any(|pair| pair.law.damps())),
            ("friction", any(|pair| pair.law.turns_balls())),
            ("defects", Use::evaluated(!model.scene.defects.is_empty())),
            ("waviness", any(|pair| !pair.waves.is_round())),
        ];
        let oil = model
            .is_lubricated()
            .then_some(("oil film", Use::Evaluated));
        let forces = forces::ALL.into_iter().filter_map(|force| {
            let used = force.used(model);
            let is_listed = !force.is_rare() || used != Use::Absent;
            is_listed.then_some((force.name(), used))
        });
        contacts.into_iter().chain(oil).chain(forces).collect()
    }

    /// The rows whose contacts have a part in the motion.
    pub(crate) fn rows_in_motion(&self) -> Range<usize> {
        if self.contacts.is_mirrored() {
            0..self.model.rows.len()
        } else {
            self.contacts.rows()
        }
    }

    /// Whether the contacts of a row have a part in the motion.
    pub(crate) fn evaluates(&self, row: usize) -> bool {
        self.rows_in_motion().contains(&row)
    }

    /// How the contacts of a row with a race are evaluated where no defect is in reach.
    pub(crate) fn evaluation(&self, row: usize, race: Race) -> String {
        if !self.contacts.rows().contains(&row) {
            let instead = if self.contacts.is_mirrored() {
                "image of row 0"
            } else {
                "left out by request"
            };
            return instead.to_owned();
        }
        let pair = &self.model.rows[row].pairs[race];
        let law = pair.law.elastic.name();
        let count = pair.slices.count();
        let slices = match &pair.slices {
            ZoneSlices::Fixed(_) => "slices",
            ZoneSlices::Fitted(_) => "nodes",
        };
        if self.contacts.is_symmetric() {
            let half = count.div_ceil(2);
            format!("{half} of {count} {slices} (mirror symmetry), {law}")
        } else {
            let shape = pair.shape.name();
            format!("{count} {slices}{shape}, {law}")
        }
    }
}
