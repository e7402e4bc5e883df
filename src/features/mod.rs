//! Features of a run: the few numbers a case of a campaign is known by.
//!
//! | name | what | source |
//! |---|---|---|
//! | `outer.ay.rms`, `.peak`, `.crest_factor`, `.kurtosis` | moments of a column | `moments.rs` |
//! | `outer.ay.row0.ftf`, `.bpfo`, `.bpfi`, `.2bsf` | amplitude of its line at a fault frequency of a row | `lines.rs` |
//! | `….bpfo_harmonics`, … | root of the sum of the squares of the line and its second and third harmonic | `lines.rs` |
//! | `….bpfi_sidebands`, `….2bsf_sidebands` | the same of the lines a shaft's, a cage's frequency beside it | `lines.rs` |
//! | `….bpfo_envelope`, `….bpfo_envelope_harmonics`, … | the same lines of its squared envelope | `lines.rs` |
//! | `row0.outer.load_max`, `.load_min` | extremes of the contact loads of a row \[N\] | `loads.rs` |
//! | `largest_pressure` | largest Hertz pressure of any contact at the start or the end of the run \[Pa\] | |
//!
//! A feature that a run cannot give (a line below the resolution of its record, a crest factor of silence) is
//! there without a value, so that a table of cases has the same columns throughout.

mod lines;
mod loads;
mod moments;
mod shaft;
mod spectrum;

use rustfft::FftPlanner;
use serde::Deserialize;

use crate::error::{Error, Result};
use crate::run::Run;
use crate::scene::Scene;
use crate::signals::{Signals, columns};
use shaft::Shaft;

pub(crate) use loads::{with_load_probes, without_load_probes};

/// What to compute the features of.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FeatureOptions {
    /// Columns such as `outer.ay`; absent: every acceleration \[m/s²\] that the probes record.
    pub columns: Option<Vec<String>>,
    /// Beginning of the run that is left out \[s\]. Default 0.
    pub skip: f64,
    /// Band of the envelope, lowest and highest frequency \[Hz\]; absent: all.
    pub band: Option<[f64; 2]>,
    /// Whether every contact load is read at every sample for its extremes, which costs as much as one
    /// evaluation of the right-hand side a sample. Default false.
    pub contact_loads: bool,
}

/// A number with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct Feature {
    /// Name, as in the table above.
    pub name: String,
    /// Value in the unit of its column, squared for an envelope; absent if the run cannot give it.
    pub value: Option<f64>,
}

impl Feature {
    fn new(name: String, value: f64) -> Self {
        let value = Some(value).filter(|x| x.is_finite());
        Self { name, value }
    }
}

/// Names of the columns whose features a scene gives.
///
/// # Errors
/// [`Error::Scene`] for a scene that is not usable, or a column that its probes do not record.
pub fn feature_columns(scene: &Scene, options: &FeatureOptions) -> Result<Vec<String>> {
    let columns = columns(scene)?;
    let Some(asked) = &options.columns else {
        let accelerations = columns.into_iter().filter(|c| c.unit == "m/s^2");
        return Ok(accelerations.map(|c| c.name).collect());
    };
    match asked.iter().find(|a| columns.iter().all(|c| c.name != **a)) {
        None => Ok(asked.clone()),
        Some(unknown) => {
            let known: Vec<_> = columns.iter().map(|c| c.name.as_str()).collect();
            let allowed = format!("columns of the scene's probes: {}", known.join(", "));
            Err(Error::scene("columns", unknown, allowed))
        }
    }
}

/// Checks the options against a run, before time is spent on it.
///
/// # Errors
/// [`Error::Scene`] names the option.
pub(crate) fn check(options: &FeatureOptions, run: &Run) -> Result<()> {
    if !(options.skip >= 0.0 && options.skip < run.duration) {
        let allowed = format!("from 0 to below the duration, {} s", run.duration);
        return Err(Error::scene("skip", options.skip, allowed));
    }
    match options.band {
        Some([low, high]) if !(0.0 <= low && low < high && high <= run.fs / 2.0) => {
            let allowed = format!("two rising frequencies from 0 to fs/2, {} Hz", run.fs / 2.0);
            Err(Error::scene("band", format!("[{low}, {high}]"), allowed))
        }
        _ => Ok(()),
    }
}

/// The features of the given columns, then the extremes of the contact loads if they were read, and the largest pressure.
pub(crate) fn features(
    signals: &Signals,
    columns: &[String],
    options: &FeatureOptions,
) -> Vec<Feature> {
    let first = signals.t.partition_point(|&t| t < options.skip);
    let count = signals.t.len() - first;
    let shaft = Shaft::of(&signals.scene, options.skip, count, signals.fs);
    // Twiddle factors cost more than the transforms that use them, and are the same for all columns.
    let mut planner = FftPlanner::new();
    let mut found = Vec::new();
    for name in columns {
        let Some(values) = signals.get(name) else {
            continue;
        };
        let x = &values[first..];
        found.extend(moments::of(name, x));
        found.extend(lines::of(
            &mut planner,
            name,
            x,
            (signals.fs, options.band),
            shaft.as_ref(),
            &signals.scene.rows,
        ));
    }
    found.extend(loads::extremes(signals, first));
    let pressure = signals.stats.largest_pressure;
    found.push(Feature::new("largest_pressure".to_owned(), pressure));
    found
}
