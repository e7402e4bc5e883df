//! Runs that go on in pieces.

// Arguments from Python come by value.
#![allow(clippy::needless_pass_by_value)]

use std::sync::{Arc, Mutex, PoisonError};

use numpy::{IntoPyArray, PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::answer::{Progress, forced};
use super::errors::OrRaise;
use super::forces::{Passed, Raised};
use super::run::{hand_over, state_of};
use ballrace::inspect::ContactSummary;
use ballrace::scene::{ContactQuantity, RingForces, RingName};
use ballrace::{Error, Result, Run, Scene, Snapshot, Start};

/// A run that goes on, none after its end; and what its forces by code raised.
#[pyclass(frozen, module = "ballrace._core", name = "Simulation")]
pub(super) struct GoingRun(Arc<Mutex<Option<ballrace::Simulation>>>, Raised);

#[pymethods]
impl GoingRun {
    #[new]
    #[pyo3(signature = (scene, run, state = None, progress = None, forces = Vec::new()))]
    fn new(
        py: Python<'_>,
        scene: &str,
        run: &str,
        state: Option<PyReadonlyArray1<'_, f64>>,
        progress: Option<Py<PyAny>>,
        forces: Vec<Passed>,
    ) -> PyResult<Self> {
        let mut scene = Scene::from_json(scene).or_raise(py)?;
        let mut run = Run::from_json(run).or_raise(py)?;
        if let Some(y) = state {
            run.start = Start::State(state_of(&scene, &y).or_raise(py)?);
        }
        let raised = Raised::of_forces(&mut scene, forces);
        let made = forced(py, progress.as_ref(), &raised, move |on_progress| {
            ballrace::Simulation::begin_with_progress(&scene, &run, on_progress)
        })?;
        Ok(Self(Arc::new(Mutex::new(Some(made))), raised))
    }

    /// A simulation that goes on where a snapshot was taken.
    #[staticmethod]
    fn restored(py: Python<'_>, snapshot: &str) -> PyResult<Self> {
        let snapshot = Snapshot::from_json(snapshot).or_raise(py)?;
        let raised = Raised::default();
        let made = forced(py, None, &raised, move |_| {
            ballrace::Simulation::restore(&snapshot)
        })?;
        Ok(Self(Arc::new(Mutex::new(Some(made))), raised))
    }

    /// Snapshot of what the simulation needs to go on, as JSON.
    fn snapshot(&self, py: Python<'_>) -> PyResult<String> {
        self.with(py, |simulation| Ok(simulation.snapshot().to_json()))
    }

    #[getter]
    fn time(&self, py: Python<'_>) -> PyResult<f64> {
        self.with(py, |simulation| Ok(simulation.time()))
    }

    /// The scene as it is now, as JSON.
    #[getter]
    fn scene(&self, py: Python<'_>) -> PyResult<String> {
        self.with(py, |simulation| {
            let mut scene = simulation.scene().clone();
            // No document has forces by code.
            scene.ring_forces = RingForces::default();
            Ok(scene.to_json())
        })
    }

    /// Names of the states.
    #[getter]
    fn names(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.with(py, |simulation| Ok(simulation.model().names()))
    }

    /// The states of all bodies.
    fn state<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let y = self.with(py, |simulation| Ok(simulation.state().to_vec()))?;
        Ok(y.into_pyarray(py))
    }

    /// Quantities of all contacts, each as (balls, 2).
    fn contacts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = self.with(py, |simulation| Ok(simulation.contacts()))?;
        let contacts = PyDict::new(py);
        for quantity in ContactQuantity::ALL {
            let of = |contact: &ContactSummary| contact.get(quantity);
            let values: Vec<f64> = found.iter().flatten().map(of).collect();
            let (name, _) = quantity.label();
            contacts.set_item(name, values.into_pyarray(py).reshape([found.len(), 2])?)?;
        }
        Ok(contacts)
    }

    /// Wrench of the balls on a ring.
    fn wrench<'py>(&self, py: Python<'py>, ring: &str) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let ring = match ring {
            "outer" => RingName::Outer,
            "inner" => RingName::Inner,
            _ => {
                let allowed = "\"outer\" or \"inner\"";
                return Err(Error::argument("ring", format!("{ring:?}"), allowed)).or_raise(py);
            }
        };
        let wrench = self.with(py, |simulation| Ok(simulation.wrench(ring)))?;
        Ok(wrench.to_vec().into_pyarray(py))
    }

    /// Goes on to a time; returns the columns of the samples that are final, the times `t` among them.
    #[pyo3(signature = (t, progress = None))]
    fn advance_to<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let block = self.answering(py, progress.as_ref(), move |simulation, on_progress| {
            simulation.advance_with_progress(t, on_progress)?;
            Ok(simulation.take_block())
        })?;
        let columns = PyDict::new(py);
        columns.set_item("t", block.t.into_pyarray(py))?;
        for column in block.columns {
            columns.set_item(column.name, column.values.into_pyarray(py))?;
        }
        Ok(columns)
    }

    /// Replaces fields by dotted paths; `changes` is a JSON list of pairs of path and value.
    fn change(&self, py: Python<'_>, changes: &str) -> PyResult<()> {
        let changes: Vec<(String, serde_json::Value)> = serde_json::from_str(changes)
            .map_err(|e| Error::argument("changes", changes, e.to_string()))
            .or_raise(py)?;
        self.answering(py, None, move |simulation, _| {
            let each = changes.iter();
            let each: Vec<_> = each
                .map(|(path, value)| (path.as_str(), value.clone()))
                .collect();
            simulation.change(&each)
        })
    }

    /// Sets sizes of constant loads by dotted paths.
    fn set_loads(&self, py: Python<'_>, loads: Vec<(String, f64)>) -> PyResult<()> {
        let loads = loads.iter().map(|(path, size)| (path.as_str(), *size));
        let loads: Vec<_> = loads.collect();
        self.with(py, |simulation| simulation.set_loads(&loads))
    }

    /// Moves rings to places with speeds at a time, by dotted paths.
    fn set_motions(
        &self,
        py: Python<'_>,
        motions: Vec<(String, [f64; 2])>,
        until: f64,
    ) -> PyResult<()> {
        let motions = motions.iter().map(|(path, to)| (path.as_str(), *to));
        let motions: Vec<_> = motions.collect();
        self.with(py, |simulation| simulation.set_motions(&motions, until))
    }

    /// Ends it; returns what `simulate` does, of the samples that were not taken.
    #[pyo3(signature = (progress = None))]
    fn finish<'py>(
        &self,
        py: Python<'py>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let going = Arc::clone(&self.0);
        let signals = forced(py, progress.as_ref(), &self.1, move |on_progress| {
            let mut going = going.lock().unwrap_or_else(PoisonError::into_inner);
            going.as_ref().ok_or_else(over)?.check_end()?;
            going
                .take()
                .ok_or_else(over)?
                .finish_with_progress(on_progress)
        })?;
        hand_over(py, signals)
    }
}

impl GoingRun {
    /// Works with the run on a thread of its own.
    fn answering<T: Send + 'static>(
        &self,
        py: Python<'_>,
        progress: Option<&Py<PyAny>>,
        work: impl FnOnce(&mut ballrace::Simulation, Progress<'_>) -> Result<T> + Send + 'static,
    ) -> PyResult<T> {
        let going = Arc::clone(&self.0);
        forced(py, progress, &self.1, move |on_progress| {
            let mut going = going.lock().unwrap_or_else(PoisonError::into_inner);
            work(going.as_mut().ok_or_else(over)?, on_progress)
        })
    }

    /// Reads the run; waits for a thread that works with it.
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        read: impl FnOnce(&mut ballrace::Simulation) -> Result<T> + Send,
    ) -> PyResult<T> {
        py.detach(|| {
            let mut going = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            read(going.as_mut().ok_or_else(over)?)
        })
        .or_raise(py)
    }
}

/// Nothing goes on after the end.
fn over() -> Error {
    Error::argument(
        "simulation",
        "finished",
        "one that goes on: begin another, or restore a snapshot",
    )
}
