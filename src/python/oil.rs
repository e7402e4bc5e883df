//! Oils as JSON text: the named ones, and the properties of a lubricant at its temperature.

use pyo3::prelude::*;
use serde_json::json;

use super::errors::OrRaise;
use ballrace::contact::film::Oil;
use ballrace::scene::{Lubricant, NAMED_OILS};

/// The oils that a lubricant may name, a list of their data sheets in SI.
#[pyfunction]
pub(super) fn named_oils() -> String {
    json!(NAMED_OILS).to_string()
}

/// Properties of the oil of a lubricant at its temperature, each number with its source: given, named oil, base, default, a
/// standard or a publication.
#[pyfunction]
pub(super) fn oil(py: Python<'_>, lubricant: &str) -> PyResult<String> {
    let lubricant = Lubricant::from_json(lubricant).or_raise(py)?;
    let sheet = lubricant.sheet().or_raise(py)?;
    let oil = Oil::new(&lubricant).or_raise(py)?;
    let of = |value: f64, source: &str| json!({"value": value, "source": source});
    let resolved = json!({
        "temperature": lubricant.temperature,
        "base": sheet.base,
        "viscosity_40": sheet.viscosity_40,
        "viscosity_100": sheet.viscosity_100,
        "density_15": sheet.density_15,
        "kinematic_viscosity": of(oil.kinematic_viscosity, "ASTM D341"),
        "density": of(oil.density, "density_15 less 6.5e-4 of it a kelvin"),
        "viscosity": of(oil.viscosity, "density times kinematic_viscosity"),
        "temperature_viscosity": of(oil.temperature_viscosity, "ASTM D341"),
        "pressure_viscosity": {
            "value": oil.pressure_viscosity,
            "source": sheet.pressure_viscosity_source(),
        },
        "limiting_stress": sheet.limiting_stress,
    });
    Ok(resolved.to_string())
}
