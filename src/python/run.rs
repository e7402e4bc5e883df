//! Models and runs.

// Arguments from Python come by value.
#![allow(clippy::needless_pass_by_value)]

use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde::Deserialize;
use serde::de::IntoDeserializer;
use serde::de::value::Error as ValueError;

use super::answer::{Progress, answering};
use super::errors::{OrRaise, to_json};
use crate::dynamics;
use crate::equilibrium::compile;
use crate::model::DOFS;
use crate::scene::{Method, RingName};
use crate::{Bandwidth, Error, Run, Scene, Signals, SliceRow, Start};

/// A compiled scene.
#[pyclass(frozen, module = "ballrace._core")]
pub(super) struct Model(Arc<crate::Model>);

#[pymethods]
impl Model {
    #[new]
    fn new(py: Python<'_>, scene: &str) -> PyResult<Self> {
        let scene = Scene::from_json(scene).or_raise(py)?;
        let model = answering(py, None, move |_| compile(&scene))?;
        Ok(Self(Arc::new(model)))
    }

    /// Names of the states.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.0.names()
    }

    /// Names of the bodies.
    #[getter]
    fn bodies(&self) -> Vec<String> {
        self.0.bodies()
    }

    /// Number of states.
    #[getter]
    fn dim(&self) -> usize {
        self.0.dim()
    }

    /// State at which a run starts.
    fn start<'py>(&self, py: Python<'py>, kind: &str) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let start = start(kind, None).or_raise(py)?;
        let model = Arc::clone(&self.0);
        Ok(answering(py, None, move |_| crate::start(&model, &start))?.into_pyarray(py))
    }

    /// Time derivative of a state.
    fn rhs<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        y: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let y = self.state(py, &y)?;
        let rates = py.detach(|| {
            let mut rates = vec![0.0; y.len()];
            dynamics::rhs(&self.0, t, &y, &mut rates);
            rates
        });
        Ok(rates.into_pyarray(py))
    }

    /// Generalised forces by origin, each as (bodies, 4).
    fn forces<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        y: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let y = self.state(py, &y)?;
        let forces = PyDict::new(py);
        for (origin, values) in py.detach(|| dynamics::contributions(&self.0, t, &y)) {
            let rows = values.len() / DOFS;
            forces.set_item(origin, values.into_pyarray(py).reshape([rows, DOFS])?)?;
        }
        Ok(forces)
    }
}

impl Model {
    /// A copy of a state of the right length: other threads may write to the array once the GIL is released.
    fn state(&self, py: Python<'_>, y: &PyReadonlyArray1<'_, f64>) -> PyResult<Vec<f64>> {
        let y: Vec<f64> = y.as_array().iter().copied().collect();
        if y.len() == self.0.dim() {
            Ok(y)
        } else {
            let wanted = format!(
                "an array of shape ({},), one number per state",
                self.0.dim()
            );
            Err(Error::scene(
                "y",
                format!("an array of shape ({},)", y.len()),
                wanted,
            ))
            .or_raise(py)
        }
    }
}

/// Run a scene; returns a dict of `fs`, `t`, `columns`, `slices`, `stats`, `provenance` and `scene`.
#[pyfunction]
#[pyo3(signature = (
    scene, duration, fs, kind, state, rtol, accuracy, method, threads, progress, bandwidth, settle,
    time_limit = None, max_steps = None
))]
#[allow(clippy::too_many_arguments)]
pub(super) fn simulate<'py>(
    py: Python<'py>,
    scene: &str,
    duration: f64,
    fs: f64,
    kind: &str,
    state: Option<PyReadonlyArray1<'py, f64>>,
    rtol: Option<f64>,
    accuracy: Option<f64>,
    method: Option<&str>,
    threads: usize,
    progress: Option<Py<PyAny>>,
    bandwidth: Option<&str>,
    settle: Option<f64>,
    time_limit: Option<f64>,
    max_steps: Option<usize>,
) -> PyResult<Bound<'py, PyDict>> {
    let scene = Scene::from_json(scene).or_raise(py)?;
    let state = state.map(|y| y.as_array().iter().copied().collect());
    let run = Run {
        duration,
        fs,
        start: start(kind, state).or_raise(py)?,
        rtol,
        accuracy,
        method: method.map(self::method).transpose().or_raise(py)?,
        threads,
        bandwidth: self::bandwidth(bandwidth).or_raise(py)?,
        settle,
        time_limit,
        max_steps,
    };
    let work = move |told: Progress<'_>| crate::simulate(&scene, &run, told);
    let signals = answering(py, progress.as_ref(), work)?;
    if let Some(callback) = progress {
        callback.call1(py, (1.0,))?;
    }
    hand_over(py, signals)
}

/// What a scene is compiled to and costs, as JSON and as text.
#[pyfunction]
pub(super) fn explain(py: Python<'_>, scene: &str) -> PyResult<(String, String)> {
    let scene = Scene::from_json(scene).or_raise(py)?;
    let told = answering(py, None, move |_| crate::explain(&scene))?;
    Ok((to_json(&told)?, told.to_string()))
}

pub(super) fn start(kind: &str, state: Option<Vec<f64>>) -> crate::Result<Start> {
    match (kind, state) {
        (_, Some(state)) => Ok(Start::State(state)),
        ("equilibrium", None) => Ok(Start::Equilibrium),
        ("rolling", None) => Ok(Start::Rolling),
        (other, None) => Err(Error::scene(
            "start",
            format!("{other:?}"),
            "\"equilibrium\", \"rolling\" or an array of states",
        )),
    }
}

pub(super) fn method(name: &str) -> crate::Result<Method> {
    Method::deserialize(name.into_deserializer())
        .map_err(|e: ValueError| Error::scene("method", format!("{name:?}"), e.to_string()))
}

/// None asks for point samples.
pub(super) fn bandwidth(name: Option<&str>) -> crate::Result<Bandwidth> {
    match name {
        Some("auto") => Ok(Bandwidth::Auto),
        None => Ok(Bandwidth::Raw),
        Some(other) => Err(Error::scene(
            "bandwidth",
            format!("{other:?}"),
            "\"auto\" or None",
        )),
    }
}

pub(super) fn hand_over(py: Python<'_>, signals: Signals) -> PyResult<Bound<'_, PyDict>> {
    let warnings: Vec<(&str, String)> = signals
        .warnings()
        .iter()
        .map(|warning| (warning.category(), warning.to_string()))
        .collect();
    let out = PyDict::new(py);
    out.set_item("fs", signals.fs)?;
    out.set_item("t", signals.t.into_pyarray(py))?;
    let columns = PyList::empty(py);
    for column in signals.columns {
        columns.append((column.name, column.unit, column.values.into_pyarray(py)))?;
    }
    out.set_item("columns", columns)?;
    out.set_item("slices", slices(py, &signals.slices)?)?;
    out.set_item("stats", to_json(&signals.stats)?)?;
    out.set_item("warnings", warnings)?;
    out.set_item("provenance", to_json(&signals.provenance)?)?;
    out.set_item("scene", signals.scene.to_json())?;
    Ok(out)
}

/// A numeric column of the table of slices.
type Number = fn(&SliceRow) -> f64;

/// The table of slices, a column at a time; `None` without rows.
fn slices<'py>(py: Python<'py>, rows: &[SliceRow]) -> PyResult<Option<Bound<'py, PyDict>>> {
    if rows.is_empty() {
        return Ok(None);
    }
    let table = PyDict::new(py);
    table.set_item(
        "probe",
        rows.iter().map(|r| r.probe.as_str()).collect::<Vec<_>>(),
    )?;
    table.set_item(
        "row",
        rows.iter()
            .map(|r| r.row as u64)
            .collect::<Vec<_>>()
            .into_pyarray(py),
    )?;
    table.set_item(
        "ball",
        rows.iter()
            .map(|r| r.ball as u64)
            .collect::<Vec<_>>()
            .into_pyarray(py),
    )?;
    let race = |r: &SliceRow| match r.race {
        RingName::Outer => "outer",
        RingName::Inner => "inner",
    };
    table.set_item("race", rows.iter().map(race).collect::<Vec<_>>())?;
    let numbers: [(&str, Number); 6] = [
        ("time", |r| r.time),
        ("zeta", |r| r.zeta),
        ("z", |r| r.z),
        ("width", |r| r.width),
        ("penetration", |r| r.penetration),
        ("force", |r| r.force),
    ];
    for (name, value) in numbers {
        table.set_item(
            name,
            rows.iter().map(value).collect::<Vec<_>>().into_pyarray(py),
        )?;
    }
    Ok(Some(table))
}
