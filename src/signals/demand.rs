//! Memory for a run's record, computed before any of it is allocated.

use super::SliceRow;
use super::blocks::rows_in_memory;
use super::filter::HALF;
use crate::dynamics::contribution_names;
use crate::inspect::{Energy, Lubrication, MOMENTS};
use crate::model::{DOFS, RINGS};
use crate::scene::{Cage, ContactQuantity, Probe, Scene, Slices};

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
            let contacts = |row: usize, balls: Option<usize>, races: Option<usize>| {
                balls.unwrap_or(scene.rows[row].ball_count) * races.unwrap_or(RINGS)
            };
            demand.columns += match probe {
                Probe::Motion { body, components } => {
                    let all = scene.components_of(body).len();
                    components.as_ref().map_or(all, Vec::len)
                }
                Probe::Contacts {
                    row,
                    balls,
                    races,
                    quantities,
                } => {
                    let all = ContactQuantity::ALL.len();
                    contacts(
                        *row,
                        balls.as_ref().map(Vec::len),
                        races.as_ref().map(Vec::len),
                    ) * quantities.as_ref().map_or(all, Vec::len)
                }
                // Two balls have but one link.
                Probe::Cage { row } => match (&scene.cage, scene.rows[*row].ball_count) {
                    (Some(Cage::Ring { .. }), count) => 4 + count,
                    (None, _) | (_, 0 | 1) => 0,
                    (_, 2) => 1,
                    (_, count) => count,
                },
                Probe::Energy {} => Energy::default().entries().len(),
                Probe::Torque {} => RINGS,
                Probe::Moments {} => MOMENTS.len(),
                Probe::Lubrication { .. } => Lubrication::LABELS.len(),
                Probe::Forces { .. } => DOFS * contribution_names().len(),
                Probe::Slices {
                    row,
                    balls,
                    races,
                    times,
                } => {
                    demand.slices += times.len()
                        * nodes(*row)
                        * contacts(
                            *row,
                            balls.as_ref().map(Vec::len),
                            races.as_ref().map(Vec::len),
                        );
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
    use crate::scene::{Component, Lubricant, RingName, presets};
    use crate::statics::compile;

    /// Truth: the columns that are made.
    #[test]
    fn all_columns_are_counted() {
        let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        scene.lubricant = Some(Lubricant::named("vg68", 328.15));
        let body = || "outer".to_owned();
        let probes = [
            Probe::Motion {
                body: body(),
                components: None,
            },
            Probe::Motion {
                body: "row0.ball3".to_owned(),
                components: Some(vec![Component::Ay]),
            },
            Probe::Contacts {
                row: 0,
                balls: None,
                races: None,
                quantities: None,
            },
            Probe::Contacts {
                row: 0,
                balls: Some(vec![1, 2]),
                races: Some(vec![RingName::Inner]),
                quantities: Some(vec![ContactQuantity::Load]),
            },
            Probe::Cage { row: 0 },
            Probe::Energy {},
            Probe::Torque {},
            Probe::Moments {},
            Probe::Lubrication { row: 0 },
            Probe::Forces { body: body() },
            Probe::Slices {
                row: 0,
                balls: None,
                races: None,
                times: vec![0.0, 1e-3],
            },
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
