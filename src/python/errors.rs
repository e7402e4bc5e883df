//! Errors of the crate as exceptions of `ballrace.errors`.

use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;
use serde_json::{Value, json};

use crate::Error;

/// Class in `ballrace.errors` and arguments, as JSON, of the exception that says the same as `error`.
pub(super) fn record(error: &Error) -> Value {
    let message = error.to_string();
    let (class, arguments) = match error {
        Error::Scene {
            path,
            value,
            allowed,
        } => ("SceneError", json!([path, value, allowed])),
        Error::Equilibrium { .. } => ("EquilibriumError", json!([message])),
        Error::Integration {
            time,
            step,
            body,
            contacts,
            ..
        } => (
            "IntegrationError",
            json!([message, time, step, body, contacts]),
        ),
        Error::Budget { time, name, limit } => ("BudgetError", json!([message, time, name, limit])),
        Error::Memory {
            needed, available, ..
        } => ("MemoryLimitError", json!([message, needed, available])),
        Error::Interrupted { .. } | Error::Internal { .. } => ("BallraceError", json!([message])),
    };
    json!({ "class": class, "message": message, "arguments": arguments })
}

/// The exception that says the same as `error`.
pub(super) fn raise(py: Python<'_>, error: Error) -> PyErr {
    let made = match error {
        Error::Scene {
            path,
            value,
            allowed,
        } => make(py, "SceneError", (path, value, allowed)),
        Error::Equilibrium { .. } => make(py, "EquilibriumError", (error.to_string(),)),
        Error::Integration {
            ref time,
            ref step,
            ref body,
            ref contacts,
            ..
        } => make(
            py,
            "IntegrationError",
            (error.to_string(), *time, *step, body, contacts.clone()),
        ),
        Error::Budget { time, name, limit } => {
            make(py, "BudgetError", (error.to_string(), time, name, limit))
        }
        Error::Memory {
            needed, available, ..
        } => make(
            py,
            "MemoryLimitError",
            (error.to_string(), needed, available),
        ),
        Error::Internal { .. } => make(py, "BallraceError", (error.to_string(),)),
        // The observer's own exception takes precedence over this one.
        Error::Interrupted { .. } => return PyKeyboardInterrupt::new_err(error.to_string()),
    };
    made.unwrap_or_else(|failure| failure)
}

fn make<'py, A>(py: Python<'py>, name: &str, arguments: A) -> PyResult<PyErr>
where
    A: pyo3::call::PyCallArgs<'py>,
{
    let class = py.import("ballrace.errors")?.getattr(name)?;
    Ok(PyErr::from_value(class.call1(arguments)?))
}

/// `Result<T>` of the crate as `PyResult<T>`.
pub(super) trait OrRaise<T> {
    /// The value, or the exception.
    fn or_raise(self, py: Python<'_>) -> PyResult<T>;
}

impl<T> OrRaise<T> for crate::Result<T> {
    fn or_raise(self, py: Python<'_>) -> PyResult<T> {
        self.map_err(|error| raise(py, error))
    }
}

/// Writes a record as JSON, which numbers that are not finite enter as `null`.
pub(super) fn to_json(record: &impl serde::Serialize) -> PyResult<String> {
    serde_json::to_string(record).map_err(|e| PyRuntimeError::new_err(e.to_string()))
}
