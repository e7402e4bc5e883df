//! Scenes as JSON text, read and checked by serde.

use numpy::{IntoPyArray, PyArray1, PyArrayMethods};
use pyo3::prelude::*;

use super::errors::OrRaise;
use ballrace::scene::{TimeFunction, presets};
use ballrace::{Error, Scene};

/// Read a checked scene from TOML and return it as JSON with every field written out.
#[pyfunction]
pub(super) fn scene_from_toml(py: Python<'_>, text: &str) -> PyResult<String> {
    Ok(Scene::from_toml(text).or_raise(py)?.to_json())
}

/// Read a checked scene from JSON and return it as JSON with every field written out.
#[pyfunction]
pub(super) fn scene_from_json(py: Python<'_>, text: &str) -> PyResult<String> {
    Ok(Scene::from_json(text).or_raise(py)?.to_json())
}

/// Turn a scene from JSON into TOML.
#[pyfunction]
pub(super) fn scene_to_toml(py: Python<'_>, text: &str) -> PyResult<String> {
    Ok(Scene::from_json(text).or_raise(py)?.to_toml())
}

/// Doubts about a scene's numbers and probes, a text each.
#[pyfunction]
pub(super) fn scene_doubts(py: Python<'_>, text: &str) -> PyResult<Vec<String>> {
    let scene = Scene::from_json(text).or_raise(py)?;
    Ok(scene.doubts().iter().map(ToString::to_string).collect())
}

/// Replace fields by dotted paths; `changes` is a JSON list of pairs of path and value.
#[pyfunction]
pub(super) fn scene_replace(py: Python<'_>, text: &str, changes: &str) -> PyResult<String> {
    let changes: Vec<(String, serde_json::Value)> = serde_json::from_str(changes)
        .map_err(|e| Error::argument("changes", changes, e.to_string()))
        .or_raise(py)?;
    let changes: Vec<_> = changes
        .iter()
        .map(|(path, value)| (path.as_str(), value.clone()))
        .collect();
    let scene = Scene::from_json(text).or_raise(py)?;
    Ok(scene.with(&changes).or_raise(py)?.to_json())
}

/// The values of a function of time, given as JSON, at times \[s\].
#[pyfunction]
pub(super) fn time_values<'py>(
    py: Python<'py>,
    function: &str,
    times: &Bound<'py, PyArray1<f64>>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let function: TimeFunction = serde_json::from_str(function)
        .map_err(|e| Error::argument("function", function, e.to_string()))
        .or_raise(py)?;
    let values: Vec<f64> = times
        .readonly()
        .as_array()
        .iter()
        .map(|t| function.at(*t))
        .collect();
    Ok(values.into_pyarray(py))
}

/// Ranges of the numbers of all parts of a scene, as JSON.
#[pyfunction]
pub(super) fn scene_ranges() -> String {
    // Plain numbers and names.
    serde_json::to_string(&ballrace::scene::ranges()).unwrap_or_default()
}

/// The preset `wheel_bearing` as JSON.
#[pyfunction]
pub(super) fn preset_wheel_bearing(py: Python<'_>, axial_load: f64) -> PyResult<String> {
    checked(py, &presets::wheel_bearing(axial_load))
}

/// The preset `cornering_wheel` as JSON.
#[pyfunction]
pub(super) fn preset_cornering_wheel(py: Python<'_>, lateral: f64) -> PyResult<String> {
    checked(py, &presets::cornering_wheel(lateral))
}

/// The preset `angular_contact_pair` as JSON, face to face or back to back.
#[pyfunction]
pub(super) fn preset_angular_contact_pair(
    py: Python<'_>,
    face_to_face: bool,
    radial_load: f64,
    axial_load: f64,
    speed_rpm: f64,
) -> PyResult<String> {
    let arrangement = if face_to_face {
        presets::Arrangement::FaceToFace
    } else {
        presets::Arrangement::BackToBack
    };
    let scene = presets::angular_contact_pair(arrangement, radial_load, axial_load, speed_rpm);
    checked(py, &scene)
}

/// The preset `deep_groove_6205` as JSON.
#[pyfunction]
pub(super) fn preset_deep_groove_6205(
    py: Python<'_>,
    radial_load: f64,
    axial_load: f64,
    speed_rpm: f64,
) -> PyResult<String> {
    checked(
        py,
        &presets::deep_groove_6205(radial_load, axial_load, speed_rpm),
    )
}

fn checked(py: Python<'_>, scene: &Scene) -> PyResult<String> {
    scene.validate().or_raise(py)?;
    Ok(scene.to_json())
}
