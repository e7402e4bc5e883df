//! A record: signals of a run, or arrays of another program.

use crate::scene::Scene;
use crate::signals::Signals;
use crate::signals::kinematics::RowKinematics;

/// Columns of a run, by their names, all of the same length.
pub struct Recorded<'a> {
    /// The scene that was run.
    pub scene: &'a Scene,
    /// Sampling rate \[Hz\].
    pub fs: f64,
    /// Names and samples.
    pub columns: Vec<(&'a str, &'a [f64])>,
    /// Measured kinematics of the rows; for the others, lines are searched where balls would roll.
    pub kinematics: &'a [RowKinematics],
    /// Largest Hertz pressure of any contact at the start or the end of the run \[Pa\].
    pub largest_pressure: f64,
}

impl<'a> From<&'a Signals> for Recorded<'a> {
    fn from(signals: &'a Signals) -> Self {
        let columns = signals.columns.iter();
        Self {
            scene: &signals.scene,
            fs: signals.fs,
            columns: columns.map(|c| (c.name.as_str(), &*c.values)).collect(),
            kinematics: &signals.provenance.kinematics,
            largest_pressure: signals.stats.largest_pressure,
        }
    }
}

impl<'a> Recorded<'a> {
    /// The samples of a column.
    pub(super) fn get(&self, name: &str) -> Option<&'a [f64]> {
        let found = self.columns.iter().find(|(known, _)| *known == name);
        found.map(|(_, values)| *values)
    }

    /// Number of samples.
    pub(super) fn count(&self) -> usize {
        self.columns.first().map_or(0, |(_, values)| values.len())
    }
}
