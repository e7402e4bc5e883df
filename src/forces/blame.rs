//! Blame: the last force by a program's own code that was not finite, or panicked, on this thread.
//!
//! Neither the right-hand side nor a residual of the static solve returns a [`Result`]: a force that is no number ends them where its
//! sums are judged. There the error asks here for the force's name.

use std::any::Any;
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use crate::base::error::{Error, Result};

thread_local! {
    static FAULT: RefCell<Option<Error>> = const { RefCell::new(None) };
}

/// Calls a force by its path in the scene at a time \[s\], and keeps its name where it panics; the panic goes on.
pub(super) fn called<T>(path: &str, t: f64, call: impl FnOnce() -> T) -> T {
    catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|panic| {
        keep(path, t, format!("it panicked: {}", message(&*panic)));
        resume_unwind(panic)
    })
}

/// Keeps the name of a force whose wrench at a time \[s\] is not finite.
pub(super) fn judge(path: &str, t: f64, wrench: &[f64; 6]) {
    if !wrench.iter().all(|part| part.is_finite()) {
        let reason = format!("its wrench is {wrench:?}, where six finite numbers are needed");
        keep(path, t, reason);
    }
}

fn keep(path: &str, time: f64, reason: String) {
    let path = path.to_owned();
    FAULT.set(Some(Error::Force { path, time, reason }));
}

/// Forgets what a force did in evaluations that have passed.
pub(crate) fn forget() {
    FAULT.take();
}

/// The error of the force at fault since the last [`forget`], else the error that was found.
pub(crate) fn blamed(found: Error) -> Error {
    FAULT.take().unwrap_or(found)
}

/// Works, and blames a force for its failure if one was at fault during it.
pub(crate) fn scope<T>(work: impl FnOnce() -> Result<T>) -> Result<T> {
    forget();
    work().map_err(|error| match error {
        Error::Interrupted { .. } => error,
        _ => blamed(error),
    })
}

/// Message of a panic.
pub(crate) fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().cloned();
    text.or_else(|| panic.downcast_ref::<&str>().map(ToString::to_string))
        .unwrap_or_else(|| "without a message".to_owned())
}
