//! Features of signals: the few numbers that characterise a case of a campaign, a run or a measurement.
//!
//! | name | what | source |
//! |---|---|---|
//! | `outer.ay.rms`, `.peak`, `.crest_factor`, `.kurtosis` | moments of a column | `moments.rs` |
//! | `outer.ay.row0.ftf`, `.bpfo`, `.bpfi`, `.2bsf` | amplitude of its line at a fault frequency of a row | `lines.rs` |
//! | | … within 0.5 % of where balls of the run passed ([`crate::RowKinematics`]); without, 2 % of nominal rolling | `lines.rs` |
//! | `….bpfo_harmonics`, … | root of the sum of the squares of the line and its second and third harmonic | `lines.rs` |
//! | `….bpfi_sidebands`, `….2bsf_sidebands` | the same of the lines a shaft's, a cage's frequency beside it | `lines.rs` |
//! | `….bpfo_sidebands` | an outer ring's frequency beside it, of a scene that gives it a speed | `lines.rs` |
//! | `….bpfo_envelope`, `….bpfo_envelope_harmonics`, … | the same lines of its squared envelope | `lines.rs` |
//! | `outer.ay.lines_from` | of a run from rest: from when on its lines are \[s\], where the shaft has a twentieth of its highest speed | `shaft.rs` |
//! | `row0.outer.load_max`, `.load_min` | extremes of the contact loads of a row \[N\] | `loads.rs` |
//! | `oil.outer.film_min`, `.lambda_min`, `oil.friction_torque_mean`, `.slip_power_mean`, … | least films, mean torque and losses of a probe `oil` of a row's oil | `lubrication.rs` |
//! | `turns`, `row0.passes` | turns of the shaft over the record, and balls that passed a place of the outer race | `recorded.rs` |
//! | `batches` | parts of the record that standard errors come from; 0: too short, or the speed changes | `batches.rs` |
//! | `largest_pressure` | largest Hertz pressure of any contact at the start or the end of the run \[Pa\] | |
//!
//! Beside every feature of a signal stands its standard error, `outer.ay.rms_se` (`batches.rs`), without a value where the
//! record has fewer than 8 turns of the shaft and fewer than 8 passes, or its speed changes. Without a scene the duration of a
//! turn is unknown, and there are none.
//!
//! A feature that a run cannot give (a line below the resolution of its record, a crest factor of zeros) is
//! present without a value, so that all cases of a table have the same columns.

mod angular;
mod batches;
mod envelope;
mod frequencies;
mod lines;
pub(crate) mod loads;
pub(crate) mod lubrication;
mod moments;
#[cfg(test)]
mod noise;
mod record;
mod recorded;
mod samples;
mod shaft;
mod spectrum;
pub(crate) mod transform;

use serde::{Deserialize, Serialize};

use crate::base::error::{Error, Result};
use crate::run::Run;
use crate::scene::Scene;
use crate::signals::{Signals, columns};

pub use angular::{by_order, order_spectrum, turning};
pub use envelope::{squared_envelope, squared_envelope_spectrum};
pub use frequencies::{FaultFrequencies, fault_frequencies, frequencies_at, run_fault_frequencies};
pub(crate) use loads::{with_load_probes, without_load_probes};
pub use record::Recorded;
pub use recorded::{check_recorded, features_of, signal_features};
pub use samples::check_samples;

/// Options of features: what to compute them of.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, Serialize)]
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
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
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

    /// A feature and, where there is to be one, its standard error beside it.
    fn with_error(name: String, value: f64, error: Option<f64>) -> Vec<Self> {
        let error = error.map(|error| {
            let known = value.is_finite().then_some(error);
            Self::new(format!("{name}_se"), known.unwrap_or(f64::NAN))
        });
        std::iter::once(Self::new(name, value))
            .chain(error)
            .collect()
    }
}

/// Names of the columns whose features a scene gives.
///
/// # Errors
/// [`Error::Scene`] for a scene that is not usable; [`Error::Argument`] for a column that its probes do not record.
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
            Err(Error::argument("columns", unknown, allowed))
        }
    }
}

/// Checks the options against a run, before time is spent on it.
///
/// # Errors
/// [`Error::Argument`] names the option.
pub fn check(options: &FeatureOptions, run: &Run) -> Result<()> {
    check_record(options, run.duration, run.fs)
}

/// Checks the options against a record of a duration \[s\] and a sampling rate \[Hz\].
fn check_record(options: &FeatureOptions, duration: f64, fs: f64) -> Result<()> {
    if !(fs > 0.0 && fs.is_finite()) {
        return Err(Error::argument("fs", fs, "a finite number above 0 Hz"));
    }
    if !(options.skip >= 0.0 && options.skip < duration) {
        let allowed = format!("from 0 to below the duration, {duration} s");
        return Err(Error::argument("skip", options.skip, allowed));
    }
    match options.band {
        Some([low, high]) if !(0.0 <= low && low < high && high <= fs / 2.0) => {
            let allowed = format!("two rising frequencies from 0 to fs/2, {} Hz", fs / 2.0);
            Err(Error::argument("band", format!("[{low}, {high}]"), allowed))
        }
        _ => Ok(()),
    }
}

/// The features of a run: of its columns, of the contact loads if they were asked for, and the largest pressure.
///
/// ```
/// use ballrace::{FeatureOptions, Run, features, scene::presets, simulate};
///
/// let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
/// let run = Run { duration: 2e-3, ..Run::default() };
/// let out = simulate(&scene, &run)?;
/// let found = features(&out, &FeatureOptions::default())?;
/// assert!(found.iter().any(|feature| feature.name == "outer.ay.rms"));
/// # Ok::<(), ballrace::Error>(())
/// ```
///
/// # Errors
/// [`Error::Argument`] names an option that the signals do not give: a column that was not recorded, or contact loads that
/// no probe has recorded all of; or a column that is not as long as the others.
pub fn features(signals: &Signals, options: &FeatureOptions) -> Result<Vec<Feature>> {
    let columns = feature_columns(&signals.scene, options)?;
    let recorded = Recorded::from(signals);
    check_recorded(&recorded, options)?;
    Ok(features_of(&recorded, &columns, options))
}

/// The name of a feature of a column; of a signal without a name, what the feature itself is called.
fn named(column: &str, what: &str) -> String {
    if column.is_empty() {
        what.to_owned()
    } else {
        format!("{column}.{what}")
    }
}
