//! Features of what is recorded: of a run's columns, or of one signal.

use super::record::Recorded;
use super::shaft::Shaft;
use super::{Feature, FeatureOptions, check_record, lines, loads, lubrication, moments, named};
use crate::error::Result;
use crate::kinematics::RowKinematics;
use crate::scene::Scene;

/// Refuses options that a record does not give.
///
/// # Errors
/// [`crate::Error::Scene`] names the option.
pub fn check_recorded(recorded: &Recorded<'_>, options: &FeatureOptions) -> Result<()> {
    if options.contact_loads {
        loads::columns(recorded.scene)?;
    }
    let duration = recorded.count() as f64 / recorded.fs;
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
    let of = Analysis {
        kinematics: recorded.kinematics,
        ..Analysis::new(
            Some(recorded.scene),
            recorded.fs,
            recorded.count() - first,
            options,
        )
    };
    let mut found = Vec::new();
    for name in columns {
        if let Some(values) = recorded.get(name) {
            found.extend(of.column(name, &values[first..]));
        }
    }
    if options.contact_loads {
        found.extend(loads::extremes(recorded, first));
    }
    found.extend(lubrication::of(recorded, first));
    let pressure = recorded.largest_pressure;
    found.push(Feature::new("largest_pressure".to_owned(), pressure));
    found
}

/// The features of one signal, whoever recorded it: its moments, and with a scene, which tells the rows of balls and the
/// speed of the shaft, the lines at their fault frequencies.
///
/// `fs` is the sampling rate \[Hz\]; features are called by the name of the column they are of, `outer.ay.rms`, and without a
/// name by their own, `rms`. Of the options `columns` and `contact_loads` do not count.
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
/// [`crate::Error::Scene`] names an option that the signal does not give.
pub fn signal_features(
    x: &[f64],
    fs: f64,
    name: &str,
    scene: Option<&Scene>,
    options: &FeatureOptions,
) -> Result<Vec<Feature>> {
    check_record(options, x.len() as f64 / fs, fs)?;
    let x = &x[first_sample(options.skip, fs, x.len())..];
    Ok(Analysis::new(scene, fs, x.len(), options).column(name, x))
}

/// The first sample that is not left out: samples stand at k / fs.
fn first_sample(skip: f64, fs: f64, count: usize) -> usize {
    let counted = (0..count).find(|k| *k as f64 / fs >= skip);
    counted.unwrap_or(count)
}

/// What the features of all columns of a record share.
struct Analysis<'a> {
    scene: Option<&'a Scene>,
    kinematics: &'a [RowKinematics],
    shaft: Option<Shaft>,
    fs: f64,
    /// Time of the first sample \[s\].
    start: f64,
    band: Option<[f64; 2]>,
}

impl<'a> Analysis<'a> {
    /// Of so many samples.
    fn new(scene: Option<&'a Scene>, fs: f64, count: usize, options: &FeatureOptions) -> Self {
        Self {
            scene,
            kinematics: &[],
            shaft: scene.and_then(|scene| Shaft::of(scene, options.skip, count, fs)),
            fs,
            start: options.skip,
            band: options.band,
        }
    }

    fn column(&self, name: &str, x: &[f64]) -> Vec<Feature> {
        let mut found = Vec::from(moments::of(name, x));
        if let Some(scene) = self.scene {
            let course = (self.fs, self.band);
            let shaft = self.shaft.as_ref();
            found.extend(lines::of(
                name,
                x,
                course,
                shaft,
                (&scene.rows, self.kinematics),
            ));
            if let Some(first) = shaft.map(Shaft::first).filter(|first| *first > 0) {
                let from = self.start + first as f64 / self.fs;
                found.push(Feature::new(named(name, "lines_from"), from));
            }
        }
        found
    }
}
