//! Long calls: they release the GIL and answer Ctrl-C at once.

use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::errors::OrRaise;
use super::forces::Raised;
use ballrace::bindings::STACK;
use ballrace::{Block, Column, Interrupt, Result};

/// Longest time between two looks at signals, and least time between two calls of a callback.
const ATTENTION: Duration = Duration::from_millis(50);

/// Callback to which work reports the share done, and by which it is stopped.
pub(super) type Progress<'a> = &'a mut dyn FnMut(f64) -> ControlFlow<()>;

/// Callback to which work hands blocks of a record.
pub(super) type Sink<'a> = &'a mut (dyn FnMut(Block) -> ControlFlow<()> + Send);

/// Messages to the waiting thread.
enum Message {
    Share(f64),
    Block(Block),
}

/// Python's callables, called on the thread that waits: one takes the share done, the other the columns of a block by
/// their names, the times `t` first.
#[derive(Clone, Copy, Default)]
pub(super) struct Callbacks<'a> {
    pub progress: Option<&'a Py<PyAny>>,
    pub sink: Option<&'a Py<PyAny>>,
}

/// Works on a thread of its own while this one waits for Ctrl-C and calls `progress` with the share done.
///
/// An exception is raised at once: work that is in the middle of something ends by itself at its next look, and what it
/// still gives goes to nobody.
pub(super) fn answering<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(Progress<'_>) -> Result<T> + Send + 'static,
) -> PyResult<T> {
    let callbacks = Callbacks {
        progress,
        sink: None,
    };
    handing_over(py, callbacks, &Interrupt::new(), |progress, _| {
        work(progress)
    })
}

/// Answer as of [`answering`], for work with forces by code: what one of them raises, this raises.
pub(super) fn forced<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Py<PyAny>>,
    raised: &Raised,
    work: impl FnOnce(Progress<'_>) -> Result<T> + Send + 'static,
) -> PyResult<T> {
    let callbacks = Callbacks {
        progress,
        sink: None,
    };
    let done = handing_over(py, callbacks, &raised.stop(), |on_progress, _| {
        work(on_progress)
    });
    raised.before(py, done)
}

/// Answer as of [`answering`], for work that hands over blocks, too; it waits while one is taken. Whoever holds `stop` ends the work.
pub(super) fn handing_over<T: Send + 'static>(
    py: Python<'_>,
    callbacks: Callbacks<'_>,
    stop: &Interrupt,
    work: impl FnOnce(Progress<'_>, Sink<'_>) -> Result<T> + Send + 'static,
) -> PyResult<T> {
    // A block is given when it is asked for, so that they do not pile up.
    let (sender, receiver) = mpsc::sync_channel(0);
    let interrupt = stop.clone();
    let worker = thread::Builder::new()
        .name("ballrace".to_owned())
        .stack_size(STACK)
        .spawn(move || {
            // Owned here, so that listening ends with the work.
            let sender = sender;
            let mut progress = |share| {
                // What nobody has time for just now is old at the next look.
                let _ = sender.try_send(Message::Share(share));
                if interrupt.is_set() {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            };
            let mut sink = |block| match sender.send(Message::Block(block)) {
                Ok(()) => ControlFlow::Continue(()),
                Err(_) => ControlFlow::Break(()),
            };
            interrupt.scope(|| work(&mut progress, &mut sink))
        })?;
    py.detach(move || wait(&receiver, callbacks))
        .inspect_err(|_| stop.set())?;
    let result = py.detach(|| worker.join());
    result
        .unwrap_or_else(|panic| resume_unwind(panic))
        .or_raise(py)
}

/// Serves the messages until the other end is gone.
fn wait(receiver: &Receiver<Message>, callbacks: Callbacks<'_>) -> PyResult<()> {
    let mut looked = Instant::now();
    loop {
        let share = match receiver.recv_timeout(ATTENTION) {
            Ok(Message::Share(share)) => Some(share),
            Ok(Message::Block(block)) => {
                Python::attach(|py| hand_over(py, callbacks.sink, block))?;
                None
            }
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        };
        if looked.elapsed() >= ATTENTION {
            looked = Instant::now();
            Python::attach(|py| attend(py, callbacks.progress, share))?;
        }
    }
}

/// Checks for Ctrl-C and calls the callback.
fn attend(py: Python<'_>, progress: Option<&Py<PyAny>>, share: Option<f64>) -> PyResult<()> {
    py.check_signals()?;
    match (progress, share) {
        (Some(callback), Some(share)) => callback.call1(py, (share,)).map(drop),
        _ => Ok(()),
    }
}

/// Gives a block as arrays that take over its memory.
fn hand_over(py: Python<'_>, sink: Option<&Py<PyAny>>, block: Block) -> PyResult<()> {
    let Some(sink) = sink else { return Ok(()) };
    let columns = PyDict::new(py);
    columns.set_item("t", block.t.into_pyarray(py))?;
    for Column { name, values, .. } in block.columns {
        columns.set_item(name, values.into_pyarray(py))?;
    }
    sink.call1(py, (columns,)).map(drop)
}
