//! Names of the code that an evaluation runs.

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

    /// How the contacts of a row with a race are evaluated where no defect is in reach.
    pub(crate) fn evaluation(&self, row: usize, race: Race) -> String {
        if row >= self.contacts.rows() {
            return "image of row 0".to_owned();
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
