//! Errors of the crate as exceptions of `ballrace.errors`.

use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;
use serde_json::{Value, json};

use ballrace::Error;

/// Class in `ballrace.errors` and arguments, as JSON, of the exception that says the same as `error`.
pub(super) fn record(error: &Error) -> Value {
    let message = error.to_string();
    let (class, arguments) = match error {
        Error::Scene {
            path,
            value,
            allowed,
            ..
        }
        | Error::Argument {
            path,
            value,
            allowed,
            ..
        }
        | Error::Record {
            path,
            value,
            allowed,
            ..
        }
        | Error::Snapshot {
            path,
            value,
            allowed,
            ..
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
        Error::Budget {
            time, name, limit, ..
        } => ("BudgetError", json!([message, time, name, limit])),
        Error::Memory {
            needed, available, ..
        } => ("MemoryLimitError", json!([message, needed, available])),
        // Interrupted, internal, and what the exceptions have no class of its own for.
        _ => ("BallraceError", json!([message])),
    };
    json!({ "class": class, "message": message, "arguments": arguments })
}

/// The exception that says the same as `error`.
#[allow(clippy::needless_pass_by_value)] // so that it can be handed to `map_err`
pub(super) fn raise(py: Python<'_>, error: Error) -> PyErr {
    match error {
        // The observer's own exception takes precedence over this one.
        Error::Interrupted { .. } => PyKeyboardInterrupt::new_err(error.to_string()),
        _ => made(py, &record(&error)).unwrap_or_else(|failure| failure),
    }
}

/// The exception of a record, made where those of campaigns are.
fn made(py: Python<'_>, record: &Value) -> PyResult<PyErr> {
    let record = py
        .import("json")?
        .call_method1("loads", (record.to_string(),))?;
    let exception = py
        .import("ballrace.errors")?
        .call_method1("from_record", (record,))?;
    Ok(PyErr::from_value(exception))
}

/// `Result<T>` of the crate as `PyResult<T>`.
pub(super) trait OrRaise<T> {
    /// The value, or the exception.
    fn or_raise(self, py: Python<'_>) -> PyResult<T>;
}

impl<T> OrRaise<T> for ballrace::Result<T> {
    fn or_raise(self, py: Python<'_>) -> PyResult<T> {
        self.map_err(|error| raise(py, error))
    }
}

/// Writes a record as JSON, which numbers that are not finite enter as `null`.
pub(super) fn to_json(record: &impl serde::Serialize) -> PyResult<String> {
    serde_json::to_string(record).map_err(|e| PyRuntimeError::new_err(e.to_string()))
}
