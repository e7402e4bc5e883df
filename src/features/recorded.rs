//! Features of a record: of a run's columns, or of one signal.

use super::batches::Batches;
use super::record::Recorded;
use super::samples::check_samples;
use super::shaft::{RingTurns, Shaft};
use super::{Feature, FeatureOptions, check_record, lines, loads, lubrication, moments, named};
use crate::base::error::{Error, Result};
use crate::scene::Scene;
use crate::signals::kinematics::RowKinematics;

/// Refuses options that a record does not give.
///
/// # Errors
/// [`crate::Error::Argument`] names the option.
pub fn check_recorded(recorded: &Recorded<'_>, options: &FeatureOptions) -> Result<()> {
    if options.contact_loads {
        loads::columns(recorded.scene)?;
    }
    let count = recorded.count();
    if let Some((name, values)) = recorded.columns.iter().find(|(_, x)| x.len() != count) {
        let allowed = format!("{count} samples, as {} has", recorded.columns[0].0);
        return Err(Error::argument(
            *name,
            format!("{} samples", values.len()),
            allowed,
        ));
    }
    let duration = count as f64 / recorded.fs;
    check_record(options, duration, recorded.fs)
}

/// The features of the given columns, then the extremes of the contact loads if they are asked for, what probes of oils
/// have recorded, and the largest pressure.
pub fn features_of(
    recorded: &Recorded<'_>,
    columns: &[String],
    options: &FeatureOptions,
) -> Vec<Feature> {
    let first = first_sample(options.skip, recorded.fs, recorded.count());
    let count = recorded.count() - first;
    let of = Analysis::new(
        Some((recorded.scene, recorded.kinematics)),
        recorded.fs,
        count,
        options,
    );
    let mut found = Vec::new();
    for name in columns {
        if let Some(values) = recorded.get(name) {
            found.extend(of.column(name, &values[first..]));
        }
    }
    if options.contact_loads {
        found.extend(loads::extremes(recorded, first, &of.batches));
    }
    found.extend(lubrication::of(recorded, first, &of.batches));
    found.extend(of.extent());
    let pressure = recorded.largest_pressure;
    found.push(Feature::new("largest_pressure".to_owned(), pressure));
    found
}

/// The features of one signal, simulated or measured: its moments, and with a scene, which has the rows of balls and the
/// speed of the shaft, the lines at their fault frequencies, standard errors, and how many turns and passes the signal has.
///
/// `fs` is the sampling rate \[Hz\]; features are called by the name of the column they are of, `outer.ay.rms`, and without a
/// name by their own, `rms`. Of the options `columns` and `contact_loads` do not count, of the scene all but its rows and speeds: it needs
/// no masses, loads or mounts with which it could run.
///
/// ```
/// use ballrace::{FeatureOptions, signal_features};
///
/// let x: Vec<f64> = (0..1000).map(|i| (0.1 * f64::from(i)).sin()).collect();
/// let found = signal_features(&x, 50e3, "sensor", None, &FeatureOptions::default())?;
/// assert_eq!(found[1].name, "sensor.peak");
/// # Ok::<(), ballrace::Error>(())
/// ```
///
/// # Errors
/// [`crate::Error::Argument`] names an option that the signal does not give, or a sampling rate that is none, [`crate::Error::Scene`] a field
/// of the scene's rows or speeds that is not usable, [`crate::Error::Record`] a sample that is not finite.
pub fn signal_features(
    x: &[f64],
    fs: f64,
    name: &str,
    scene: Option<&Scene>,
    options: &FeatureOptions,
) -> Result<Vec<Feature>> {
    scene.map_or(Ok(()), Scene::validate_kinematics)?;
    check_record(options, x.len() as f64 / fs, fs)?;
    check_samples("x", x)?;
    let x = &x[first_sample(options.skip, fs, x.len())..];
    let of = Analysis::new(scene.map(|scene| (scene, &[][..])), fs, x.len(), options);
    let mut found = of.column(name, x);
    found.extend(of.extent());
    Ok(found)
}

/// The first sample that is not left out: samples stand at k / fs.
fn first_sample(skip: f64, fs: f64, count: usize) -> usize {
    let counted = (0..count).find(|k| *k as f64 / fs >= skip);
    counted.unwrap_or(count)
}

/// Analysis that the features of all columns of a record share.
struct Analysis<'a> {
    scene: Option<&'a Scene>,
    kinematics: &'a [RowKinematics],
    shaft: Option<Shaft>,
    ring_turns: RingTurns,
    /// Turns of the shaft against the outer ring, where its speed is known.
    turns: Option<f64>,
    batches: Batches,
    fs: f64,
    /// Time of the first sample \[s\].
    start: f64,
    band: Option<[f64; 2]>,
}

impl<'a> Analysis<'a> {
    /// The analysis of so many samples of a bearing, and of what its rows did.
    fn new(
        bearing: Option<(&'a Scene, &'a [RowKinematics])>,
        fs: f64,
        count: usize,
        options: &FeatureOptions,
    ) -> Self {
        let (scene, kinematics) = bearing.unzip();
        let shaft = scene.and_then(|scene| Shaft::of(scene, options.skip, count, fs));
        let turns = shaft.as_ref().map(|shaft| shaft.turns(count, fs));
        let mut of = Self {
            scene,
            kinematics: kinematics.unwrap_or_default(),
            shaft,
            ring_turns: scene.map_or(RingTurns::INNER, |scene| {
                RingTurns::of(scene, options.skip, count, fs)
            }),
            turns,
            batches: Batches::none(),
            fs,
            start: options.skip,
            band: options.band,
        };
        if let Some(turns) = of.turns.filter(|_| of.is_steady()) {
            // Those of the row whose balls come by least often.
            let passes = of.passes().flatten().fold(f64::INFINITY, f64::min);
            of.batches = Batches::new(count, [turns, passes]);
        }
        of
    }

    /// Whether the record has statistics of its own: where the speed changes, so do they.
    fn is_steady(&self) -> bool {
        self.shaft.as_ref().is_some_and(Shaft::is_steady)
    }

    /// Balls of every row that passed a place of the outer race.
    fn passes(&self) -> impl Iterator<Item = Option<f64>> {
        let rows = self.scene.iter().flat_map(|scene| &scene.rows).enumerate();
        rows.map(|(at, row)| {
            let did = self.kinematics.iter().find(|did| did.row == at);
            let [_, outer, ..] = lines::faults(row, did, self.ring_turns);
            self.turns.map(|turns| turns * outer.order)
        })
    }

    /// How long the record is, by what passes in it.
    fn extent(&self) -> Vec<Feature> {
        if self.scene.is_none() {
            return Vec::new();
        }
        let feature = |what: &str, value: Option<f64>| {
            Feature::new(what.to_owned(), value.unwrap_or(f64::NAN))
        };
        let mut found = vec![feature("turns", self.turns)];
        let rows = self.passes().enumerate();
        found.extend(rows.map(|(row, passes)| feature(&format!("row{row}.passes"), passes)));
        found.push(feature("batches", Some(self.batches.count() as f64)));
        found
    }

    fn column(&self, name: &str, x: &[f64]) -> Vec<Feature> {
        let Some(scene) = self.scene else {
            return moments::of(name, x, None);
        };
        let mut found = moments::of(name, x, Some(&self.batches));
        let shaft = self.shaft.as_ref();
        let search = lines::LineSearch {
            rows: &scene.rows,
            kinematics: self.kinematics,
            turns: self.ring_turns,
            shaft,
            fs: self.fs,
            band: self.band,
            certain: self.batches.count() > 0,
        };
        found.extend(lines::of(name, x, &search));
        if let Some(first) = shaft.map(Shaft::first).filter(|first| *first > 0) {
            let from = self.start + first as f64 / self.fs;
            found.push(Feature::new(named(name, "lines_from"), from));
        }
        found
    }
}
