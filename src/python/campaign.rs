//! Campaigns: cases are pulled from a Python iterator and outcomes handed to a Python callable, both on the
//! calling thread; everything between runs without the GIL.

use std::ops::ControlFlow;

use pyo3::prelude::*;
use pyo3::types::PyList;
use serde_json::json;

use super::errors::{OrRaise, record};
use super::features::options_from;
use super::run::hand_over;
use ballrace::bindings::{available, check_features, within};
use ballrace::{Case, Finished, InstructionSet, Outcome, Run, Scene};

/// Share of the memory for cases whose signals are kept: the rest is for those that wait to be written, and for the
/// table they are written from.
const KEEPING: f64 = 0.4;

/// Run cases on threads of their own, each a pair of scene and run as JSON.
///
/// `done` is given a list of (index, record as JSON, signals or None), in any order and possibly empty, at
/// least about every 50 ms. What `cases` or `done` raise, or Ctrl-C, stops everything. `sharing` calls at once, of
/// which this is one, have the memory of the machine between them.
#[pyfunction]
pub(super) fn campaign(
    py: Python<'_>,
    cases: &Bound<'_, PyAny>,
    threads: usize,
    sharing: u32,
    options: &str,
    keep_signals: bool,
    done: &Bound<'_, PyAny>,
) -> PyResult<()> {
    let options = options_from(options).or_raise(py)?;
    let cases = cases.try_iter()?.unbind();
    let done = done.clone().unbind();
    let mut failed_pull = None;
    let mut raised = None;
    let result = py.detach(|| {
        let pull = std::iter::from_fn(|| {
            Python::attach(|py| match pull(py, &cases) {
                Ok(case) => case,
                Err(exception) => {
                    failed_pull = Some(exception);
                    None
                }
            })
        });
        let mut watch = |outcomes: Vec<Outcome>| {
            match Python::attach(|py| deliver(py, &done, outcomes, keep_signals)) {
                Ok(()) => ControlFlow::Continue(()),
                // A second exception, of the last call, says nothing new.
                Err(exception) => {
                    raised.get_or_insert(exception);
                    ControlFlow::Break(())
                }
            }
        };
        let stream = || ballrace::stream(pull, threads, &options, &mut watch);
        let part = if keep_signals { KEEPING } else { 1.0 } / f64::from(sharing.max(1));
        within(part * available(), stream)
    });
    if let Some(exception) = raised.or(failed_pull) {
        return Err(exception);
    }
    result.or_raise(py)
}

/// Refuse a run, as JSON, that no scene can be run by, or that does not give the features.
#[pyfunction]
pub(super) fn check_run(py: Python<'_>, run: &str, options: &str) -> PyResult<()> {
    let checked = Run::from_json(run).and_then(|run| {
        run.validate()
            .and_then(|()| check_features(&options_from(options)?, &run))
    });
    checked.or_raise(py)
}

/// Number of threads that the process may use at once.
#[pyfunction]
pub(super) fn available_threads() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}

/// Names of the instruction sets that the processor has, widest first.
#[pyfunction]
pub(super) fn instruction_sets() -> Vec<&'static str> {
    let all = InstructionSet::available();
    all.iter().map(InstructionSet::name).collect()
}

/// The next case, if there is one.
fn pull(py: Python<'_>, cases: &Py<pyo3::types::PyIterator>) -> PyResult<Option<Case>> {
    let Some(next) = cases.bind(py).clone().next() else {
        return Ok(None);
    };
    let (scene, run): (String, String) = next?.extract()?;
    let scene = Scene::from_json(&scene).or_raise(py)?;
    let run = Run::from_json(&run).or_raise(py)?;
    Ok(Some(Case::new(scene, run)))
}

/// Checks for Ctrl-C, and passes the outcomes on.
fn deliver(
    py: Python<'_>,
    done: &Py<PyAny>,
    outcomes: Vec<Outcome>,
    keep_signals: bool,
) -> PyResult<()> {
    let list = PyList::empty(py);
    for outcome in outcomes {
        let text = describe(&outcome).to_string();
        let signals = match outcome.result {
            Ok(finished) if keep_signals => Some(hand_over(py, finished.signals)?),
            _ => None,
        };
        list.append((outcome.index, text, signals))?;
    }
    // Outcomes first: what has finished is not lost to Ctrl-C.
    done.call1(py, (list,))?;
    py.check_signals()
}

/// An outcome without its signals.
fn describe(outcome: &Outcome) -> serde_json::Value {
    let wall_time = outcome.wall_time;
    match &outcome.result {
        Ok(Finished {
            features, signals, ..
        }) => {
            let features: Vec<_> = features.iter().map(|f| (&f.name, f.value)).collect();
            json!({
                "wall_time": wall_time,
                "accepted": signals.stats.accepted,
                "rejected": signals.stats.rejected,
                "nfev": signals.stats.nfev,
                "warnings": signals.warnings().iter().map(ToString::to_string).collect::<Vec<_>>(),
                "acceleration_residual": signals.stats.acceleration_residual,
                "truncated_contacts": signals.stats.truncated_contacts,
                "simd": signals.provenance.simd,
                "features": features,
                "defects": signals.provenance.defects,
            })
        }
        Err(error) => json!({ "wall_time": wall_time, "error": record(error) }),
    }
}
