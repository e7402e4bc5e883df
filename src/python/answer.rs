//! Long calls: they release the GIL and answer Ctrl-C at once.

use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use pyo3::prelude::*;

use super::errors::OrRaise;
use crate::{Interrupt, Result};

/// Longest time between two looks at signals, and least time between two calls of a callback.
const ATTENTION: Duration = Duration::from_millis(50);

/// What work tells the share done to, and is stopped by.
pub(super) type Progress<'a> = &'a mut dyn FnMut(f64) -> ControlFlow<()>;

/// Works on a thread of its own while this one waits for Ctrl-C and calls `progress` with the share done.
///
/// An exception is raised at once: work that is in the middle of something ends by itself at its next look, and what it
/// still gives goes to nobody.
pub(super) fn answering<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(Progress<'_>) -> Result<T> + Send + 'static,
) -> PyResult<T> {
    let stop = Interrupt::new();
    let (tell, listen) = mpsc::channel();
    let heeded = stop.clone();
    let worker = thread::Builder::new()
        .name("ballrace".to_owned())
        .spawn(move || {
            // Owned here, so that listening ends with the work.
            let tell = tell;
            heeded.heed(|| {
                work(&mut |share| {
                    let _ = tell.send(share);
                    if heeded.is_set() {
                        ControlFlow::Break(())
                    } else {
                        ControlFlow::Continue(())
                    }
                })
            })
        })?;
    py.detach(move || wait(&listen, progress))
        .inspect_err(|_| stop.set())?;
    let result = py.detach(|| worker.join());
    result
        .unwrap_or_else(|panic| resume_unwind(panic))
        .or_raise(py)
}

/// Until the other end is gone.
fn wait(listen: &Receiver<f64>, progress: Option<&Py<PyAny>>) -> PyResult<()> {
    let mut looked = Instant::now();
    loop {
        let told = match listen.recv_timeout(ATTENTION) {
            Ok(share) => Some(share),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        };
        if looked.elapsed() >= ATTENTION {
            looked = Instant::now();
            Python::attach(|py| attend(py, progress, told))?;
        }
    }
}

/// Lets Ctrl-C and the callback speak.
fn attend(py: Python<'_>, progress: Option<&Py<PyAny>>, told: Option<f64>) -> PyResult<()> {
    py.check_signals()?;
    match (progress, told) {
        (Some(callback), Some(share)) => callback.call1(py, (share,)).map(drop),
        _ => Ok(()),
    }
}
