//! Kinematic orders, spectra and features of plain arrays.
//!
//! Arrays are copied before the GIL is released: other threads may write to them meanwhile.

// Arguments from Python come by value.
#![allow(clippy::needless_pass_by_value)]

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use super::errors::{OrRaise, to_json};
use ballrace::RowKinematics;
use ballrace::bindings::{self, Recorded, check_recorded, features_of};
use ballrace::contact::hertz::Hertz;
use ballrace::scene::{Material, Orders, RowGeometry};
use ballrace::{Error, FaultFrequencies, Feature, FeatureOptions, Scene};

type Array<'py> = PyReadonlyArray1<'py, f64>;

/// An array that Python gets.
type NumpyRow<'py> = Bound<'py, PyArray1<f64>>;

/// Names and values; `None` where a signal cannot give one.
type Named = Vec<(String, Option<f64>)>;

/// FTF, BPFO, BPFI and BSF in orders.
#[pyfunction]
pub(super) fn orders(
    ball_count: f64,
    ball_diameter: f64,
    pitch_diameter: f64,
    contact_angle: f64,
) -> (f64, f64, f64, f64) {
    let row = RowGeometry {
        ball_count,
        ball_diameter,
        pitch_diameter,
        contact_angle,
    };
    let Orders {
        ftf,
        bpfo,
        bpfi,
        bsf,
        ..
    } = row.orders();
    (ftf, bpfo, bpfi, bsf)
}

/// Fault frequencies of balls that roll at a contact angle, at speeds of outer and inner ring \[Hz\], as JSON.
#[pyfunction]
pub(super) fn rolling_frequencies(
    ball_count: f64,
    ball_diameter: f64,
    pitch_diameter: f64,
    contact_angle: f64,
    speeds: [f64; 2],
) -> PyResult<String> {
    let row = RowGeometry {
        ball_count,
        ball_diameter,
        pitch_diameter,
        contact_angle,
    };
    to_json(&FaultFrequencies::rolling(&row, speeds))
}

/// Refuses samples that are not finite, or too large.
#[pyfunction]
pub(super) fn check_samples(py: Python<'_>, name: &str, x: Array<'_>) -> PyResult<()> {
    let x = copied(&x);
    py.detach(|| bindings::check_samples(name, &x)).or_raise(py)
}

/// Axis of a contact's ellipse across the rolling direction over that along it, on a race of sense σ (+1 outer); materials do
/// not change it.
#[pyfunction]
pub(super) fn axis_ratio(
    sigma: f64,
    ball_diameter: f64,
    pitch_diameter: f64,
    conformity: f64,
    contact_angle: f64,
) -> f64 {
    let steel = Material::default();
    let ellipse = Hertz::new(
        sigma,
        ball_diameter,
        pitch_diameter,
        conformity,
        contact_angle,
        &steel,
        &steel,
    );
    ellipse.half_length / ellipse.half_width
}

/// Squared envelope within a band.
#[pyfunction]
pub(super) fn squared_envelope<'py>(
    py: Python<'py>,
    x: Array<'py>,
    fs: f64,
    band: Option<[f64; 2]>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let x = copied(&x);
    let found = py.detach(|| ballrace::squared_envelope(&x, fs, band));
    Ok(found.or_raise(py)?.into_pyarray(py))
}

/// A signal at equal steps of the shaft's angle \[rad\]: turns and values.
#[pyfunction]
pub(super) fn by_order<'py>(
    py: Python<'py>,
    x: Array<'py>,
    angle: Array<'py>,
    per_turn: Option<usize>,
) -> PyResult<(NumpyRow<'py>, NumpyRow<'py>)> {
    let (x, angle) = (copied(&x), copied(&angle));
    let found = py.detach(|| ballrace::by_order(&x, &angle, per_turn));
    let (turn, value) = found.or_raise(py)?;
    Ok((turn.into_pyarray(py), value.into_pyarray(py)))
}

/// First sample and end of the part in which a shaft turns, by its angle \[rad\].
#[pyfunction]
pub(super) fn turning(angle: Array<'_>) -> (usize, usize) {
    let part = ballrace::turning(&copied(&angle));
    (part.start, part.end)
}

/// Amplitudes under a Hann window, of a signal padded with zeros to a length.
#[pyfunction]
pub(super) fn amplitudes<'py>(
    py: Python<'py>,
    x: Array<'py>,
    length: usize,
) -> Bound<'py, PyArray1<f64>> {
    let x = copied(&x);
    let found = py.detach(|| bindings::amplitudes(&x, length));
    found.into_pyarray(py)
}

/// A signal without its mean under a Hann window.
#[pyfunction]
pub(super) fn hann_weighted<'py>(py: Python<'py>, x: Array<'py>) -> Bound<'py, PyArray1<f64>> {
    let x = copied(&x);
    py.detach(|| bindings::hann_weighted(&x)).into_pyarray(py)
}

/// Columns whose features a scene gives, for options as JSON.
#[pyfunction]
pub(super) fn feature_columns(py: Python<'_>, scene: &str, options: &str) -> PyResult<Vec<String>> {
    let scene = Scene::from_json(scene).or_raise(py)?;
    let options = options_from(options).or_raise(py)?;
    ballrace::feature_columns(&scene, &options).or_raise(py)
}

/// Features of a run whose columns a mapping holds.
#[pyfunction]
pub(super) fn run_features(
    py: Python<'_>,
    columns: &Bound<'_, PyAny>,
    fs: f64,
    scene: &str,
    largest_pressure: Option<f64>,
    kinematics: &str,
    options: &str,
) -> PyResult<Named> {
    let scene = Scene::from_json(scene).or_raise(py)?;
    let options = options_from(options).or_raise(py)?;
    let kinematics: Vec<RowKinematics> = serde_json::from_str(kinematics)
        .map_err(|e| Error::argument("kinematics", kinematics, e.to_string()))
        .or_raise(py)?;
    let asked = ballrace::feature_columns(&scene, &options).or_raise(py)?;
    let mut needed = asked.clone();
    if options.contact_loads {
        needed.extend(bindings::load_columns(&scene).or_raise(py)?);
    }
    needed.extend(bindings::lubrication_columns(&scene));
    let mut held = Vec::new();
    for name in needed {
        let values: Array<'_> = columns.get_item(&name)?.extract()?;
        held.push((name, copied(&values)));
    }
    let found = py.detach(|| {
        let recorded = Recorded {
            scene: &scene,
            fs,
            columns: held.iter().map(|(name, x)| (&**name, &**x)).collect(),
            kinematics: &kinematics,
            largest_pressure: largest_pressure.unwrap_or(f64::NAN),
        };
        check_recorded(&recorded, &options)?;
        Ok(features_of(&recorded, &asked, &options))
    });
    Ok(named(found.or_raise(py)?))
}

/// Features of one signal; of its moments alone without a scene.
#[pyfunction]
pub(super) fn signal_features(
    py: Python<'_>,
    x: Array<'_>,
    fs: f64,
    name: &str,
    scene: Option<&str>,
    options: &str,
) -> PyResult<Named> {
    let scene = scene.map(Scene::from_json).transpose().or_raise(py)?;
    let options = options_from(options).or_raise(py)?;
    let x = copied(&x);
    let found = py.detach(|| ballrace::signal_features(&x, fs, name, scene.as_ref(), &options));
    Ok(named(found.or_raise(py)?))
}

/// Options of the features from JSON.
pub(super) fn options_from(text: &str) -> ballrace::Result<FeatureOptions> {
    serde_json::from_str(text).map_err(|e| Error::argument("features", text, e.to_string()))
}

fn copied(x: &Array<'_>) -> Vec<f64> {
    x.as_array().iter().copied().collect()
}

fn named(features: Vec<Feature>) -> Named {
    features.into_iter().map(|f| (f.name, f.value)).collect()
}
