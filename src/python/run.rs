//! Models and runs.

// Arguments from Python come by value.
#![allow(clippy::needless_pass_by_value)]

use std::sync::Arc;

use numpy::{IntoPyArray, PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use super::answer::{Callbacks, answering, handing_over};
use super::errors::{OrRaise, to_json};
use super::forces::{Passed, Raised};
use ballrace::DOFS;
use ballrace::bindings::{check_length, layout_of};
use ballrace::compile;
use ballrace::dynamics;
use ballrace::scene::RingForces;
use ballrace::{Error, Run, Scene, Signals, SliceRow, Start};

/// A compiled scene.
#[pyclass(frozen, module = "ballrace._core", name = "Model")]
pub(super) struct CompiledScene(Arc<ballrace::Model>);

#[pymethods]
impl CompiledScene {
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

    /// State at which a run starts.
    fn start<'py>(&self, py: Python<'py>, kind: &str) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let start = match kind {
            "equilibrium" => Start::Equilibrium,
            "rolling" => Start::Rolling,
            _ => {
                let allowed = "\"equilibrium\" or \"rolling\"";
                return Err(Error::argument("start", format!("{kind:?}"), allowed)).or_raise(py);
            }
        };
        let model = Arc::clone(&self.0);
        Ok(answering(py, None, move |_| ballrace::start(&model, &start))?.into_pyarray(py))
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

impl CompiledScene {
    /// A copy of a state of the right length: other threads may write to the array once the GIL is released.
    fn state(&self, py: Python<'_>, y: &PyReadonlyArray1<'_, f64>) -> PyResult<Vec<f64>> {
        if y.as_array().len() == self.0.dim() {
            Ok(y.as_array().iter().copied().collect())
        } else {
            let wanted = format!(
                "an array of shape ({},), one number per state",
                self.0.dim()
            );
            Err(Error::argument(
                "y",
                format!("an array of shape ({},)", y.as_array().len()),
                wanted,
            ))
            .or_raise(py)
        }
    }
}

/// Run a scene; returns a dict of `fs`, `t`, `columns`, `slices`, `stats`, `provenance` and `scene`.
///
/// With a `sink` times and columns come back empty: it was given them, block by block, as dicts of arrays.
///
/// The run is a JSON document; a `state` goes before its start. What `forces` raise, the run does.
#[pyfunction]
#[pyo3(signature = (scene, run, state = None, progress = None, sink = None, forces = Vec::new()))]
pub(super) fn simulate<'py>(
    py: Python<'py>,
    scene: &str,
    run: &str,
    state: Option<PyReadonlyArray1<'py, f64>>,
    progress: Option<Py<PyAny>>,
    sink: Option<Py<PyAny>>,
    forces: Vec<Passed>,
) -> PyResult<Bound<'py, PyDict>> {
    let mut scene = Scene::from_json(scene).or_raise(py)?;
    let mut run = Run::from_json(run).or_raise(py)?;
    if let Some(y) = state {
        run.start = Start::State(state_of(&scene, &y).or_raise(py)?);
    }
    let raised = Raised::of_forces(&mut scene, forces);
    let callbacks = Callbacks {
        progress: progress.as_ref(),
        sink: sink.as_ref(),
    };
    let in_blocks = sink.is_some();
    let done = handing_over(py, callbacks, &raised.stop(), move |on_progress, sink| {
        if in_blocks {
            ballrace::simulate_into(&scene, &run, sink, on_progress)
        } else {
            ballrace::simulate_with_progress(&scene, &run, on_progress)
        }
    });
    let signals = raised.before(py, done)?;
    if let Some(callback) = progress {
        callback.call1(py, (1.0,))?;
    }
    hand_over(py, signals)
}

/// Read a checked run from JSON and return it as JSON with every field written out.
#[pyfunction]
pub(super) fn run_from_json(py: Python<'_>, text: &str) -> PyResult<String> {
    Ok(Run::from_json(text).or_raise(py)?.to_json())
}

/// A copy of a state to begin from, if it has the length for it.
pub(super) fn state_of(scene: &Scene, y: &PyReadonlyArray1<'_, f64>) -> ballrace::Result<Vec<f64>> {
    check_length(y.as_array().len(), layout_of(scene).dim())?;
    Ok(y.as_array().iter().copied().collect())
}

/// Explanation of what a scene is compiled to and costs, as JSON and as text.
#[pyfunction]
pub(super) fn explain(py: Python<'_>, scene: &str) -> PyResult<(String, String)> {
    let scene = Scene::from_json(scene).or_raise(py)?;
    let explanation = answering(py, None, move |_| ballrace::explain(&scene))?;
    Ok((to_json(&explanation)?, explanation.to_string()))
}

pub(super) fn hand_over(py: Python<'_>, mut signals: Signals) -> PyResult<Bound<'_, PyDict>> {
    // No document has forces by code.
    signals.scene.ring_forces = RingForces::default();
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
    out.set_item("end_state", signals.end_state.into_pyarray(py))?;
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
    let race = |r: &SliceRow| r.race.name();
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
