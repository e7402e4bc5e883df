//! Memory for a run's record, computed before any of it is allocated.

use super::SliceRow;
use super::blocks::rows_in_memory;
use super::filter::HALF;
use super::probes::{SEAT, SENSOR};
use crate::dynamics::contribution_names;
use crate::inspect::{Energy, Lubrication, MOMENTS};
use crate::model::{DOFS, RINGS};
use crate::scene::{Cage, ContactQuantity, Probe, RingName, Scene, Slices};

/// A column besides its values: its name twice, and what finds it \[bytes\]. An estimate, generous for names of some tens
/// of letters.
const COLUMN: f64 = 400.0;
/// A row of the table of slices: here, and while it is handed over column by column.
const ROW: f64 = (2 * size_of::<SliceRow>() + 64) as f64;

/// Pieces into which defects cut a contact's zone, as far as memory matters.
const PIECES: usize = 8;

/// How many columns and rows of the table of slices a scene asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Demand {
    pub columns: usize,
    /// Number of slices at most: slices that do not touch are not listed.
    pub slices: usize,
}

impl Demand {
    /// The demand of a valid scene.
    pub fn of(scene: &Scene) -> Self {
        let nodes = |row: usize| match scene.contact_of(&scene.rows[row]).slices {
            Slices::Fixed(count) => count,
            Slices::Fitted(count) => PIECES * count,
            Slices::Accuracy(_) => PIECES * 64,
        };
        let mut demand = Self {
            columns: 0,
            slices: 0,
        };
        for (_, probe) in scene.recorded().iter() {
            let contacts = |row: usize, balls: &Option<Vec<_>>, races: &Option<Vec<_>>| {
                let all = scene.rows[row].ball_count;
                balls.as_ref().map_or(all, Vec::<usize>::len)
                    * races.as_ref().map_or(RINGS, Vec::<RingName>::len)
            };
            demand.columns += match probe {
                Probe::Motion(of) => {
                    let all = scene.components_of(&of.body).len();
                    of.components.as_ref().map_or(all, Vec::len)
                }
                Probe::Contacts(of) => {
                    let all = ContactQuantity::ALL.len();
                    let quantities = of.quantities.as_ref().map_or(all, Vec::len);
                    contacts(of.row, &of.balls, &of.races) * quantities
                }
                // Two balls have but one link.
                Probe::Cage { row } => match (&scene.cage, scene.rows[*row].ball_count) {
                    (Some(Cage::Ring { .. }), count) => 4 + count,
                    (None, _) | (_, 0 | 1) => 0,
                    (_, 2) => 1,
                    (_, count) => count,
                },
                Probe::Structure { sensors } => {
                    let all = scene.structure.as_ref().map_or(0, |of| of.sensors().len());
                    SENSOR.len() * sensors.as_ref().map_or(all, Vec::len)
                }
                Probe::Seat {} => SEAT.len(),
                Probe::Energy {} => Energy::default().entries().len(),
                Probe::Torque {} => RINGS,
                Probe::Moments {} => MOMENTS.len(),
                Probe::Lubrication { .. } => Lubrication::LABELS.len(),
                Probe::Forces { .. } => DOFS * contribution_names().len(),
                Probe::Slices(of) => {
                    let contacts = contacts(of.row, &of.balls, &of.races);
                    demand.slices += of.times.len() * nodes(of.row) * contacts;
                    0
                }
            };
        }
        demand
    }

    /// Samples of a run that are in memory: all, or those of blocks where it leaves in blocks.
    pub fn rows(&self, count: usize, in_blocks: bool) -> usize {
        if in_blocks {
            rows_in_memory(self.columns, count)
        } else {
            count
        }
    }

    /// Memory for so many samples, of signals that are read so many times as fine: samples and their times, names, the table
    /// of slices, the filter's coefficients and what it keeps.
    pub fn bytes(&self, count: usize, oversampling: usize) -> f64 {
        let (columns, oversampling) = (self.columns as f64, oversampling as f64);
        let kept = (2.0 + columns) * 2.0 * HALF as f64 * oversampling;
        let values = (columns + 1.0) * count as f64 + kept;
        8.0 * values + COLUMN * columns + ROW * self.slices as f64
    }
}

#[cfg(test)]
mod tests {
    use super::super::probes::Probes;
    use super::*;
    use crate::scene::{
        Component, ContactsProbe, Lubricant, Mode, MotionProbe, RingName, SlicesProbe, Structure,
        presets,
    };
    use crate::statics::compile;

    /// Truth: the columns that are made.
    #[test]
    fn all_columns_are_counted() {
        let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        scene.lubricant = Some(Lubricant::named("vg68", 328.15));
        let foot = Mode::new(1200.0, 0.05, 2.0, [0.0, 1.0, 0.0]).sensor("top", [0.0, 1.0, 0.0]);
        scene.structure = Some(Structure::new(vec![foot.sensor("side", [1.0, 0.0, 0.0])]));
        let one = ContactsProbe::of_row(0)
            .balls([1, 2])
            .races([RingName::Inner])
            .quantities([ContactQuantity::Load]);
        let probes = [
            Probe::motion("outer"),
            MotionProbe::of("row0.ball3")
                .components([Component::Ay])
                .into(),
            ContactsProbe::of_row(0).into(),
            one.into(),
            Probe::cage(0),
            Probe::energy(),
            Probe::structure(),
            Probe::seat(),
            Probe::torque(),
            Probe::moments(),
            Probe::lubrication(0),
            Probe::forces("outer"),
            SlicesProbe::at([0.0, 1e-3]).into(),
        ];
        for (k, probe) in probes.into_iter().enumerate() {
            scene.probes.insert(format!("p{k}"), probe);
            let model = compile(&scene).unwrap();
            let demand = Demand::of(&scene);
            assert_eq!(demand.columns, Probes::new(&model).columns.len(), "p{k}");
        }
        assert_eq!(Demand::of(&scene).slices, 2 * 18 * PIECES * 6);
    }
}
