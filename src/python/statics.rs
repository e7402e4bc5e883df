//! Equilibria, and what follows from them; each crosses as JSON.

use pyo3::prelude::*;

use super::errors::{OrRaise, to_json};
use crate::Scene;

/// Static equilibrium.
#[pyfunction]
pub(super) fn equilibrium(py: Python<'_>, scene: &str) -> PyResult<String> {
    let scene = Scene::from_json(scene).or_raise(py)?;
    to_json(&py.detach(|| crate::equilibrium(&scene)).or_raise(py)?)
}

/// Tangent stiffness there.
#[pyfunction]
pub(super) fn stiffness(py: Python<'_>, scene: &str) -> PyResult<String> {
    let scene = Scene::from_json(scene).or_raise(py)?;
    to_json(&py.detach(|| crate::stiffness(&scene)).or_raise(py)?)
}

/// Loads at so many positions of the cage per pitch.
#[pyfunction]
pub(super) fn load_distribution(py: Python<'_>, scene: &str, positions: usize) -> PyResult<String> {
    let scene = Scene::from_json(scene).or_raise(py)?;
    to_json(
        &py.detach(|| crate::load_distribution(&scene, positions))
            .or_raise(py)?,
    )
}
