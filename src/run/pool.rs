//! Runs whose evaluations threads share.

use std::ops::ControlFlow;

use crate::base::error::Result;
use crate::base::pool::Pool;
use crate::dynamics::Dynamics;

/// Works on the balls of a model with the given number of threads.
pub(crate) fn on<'m, T: Send>(
    threads: usize,
    dynamics: Dynamics<'m>,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    work: impl FnOnce(Dynamics<'m>, &mut dyn FnMut(f64) -> ControlFlow<()>) -> Result<T> + Send,
) -> Result<T> {
    let Some(pool) = Pool::of(threads)? else {
        return work(dynamics, progress);
    };
    let dynamics = dynamics.shared(pool.clone());
    pool.inside(progress, |progress| work(dynamics, progress))
}
