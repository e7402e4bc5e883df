//! Thread pools of our own, one per process and size; never rayon's global one.
//!
//! A forked child inherits the memory of its parent's pool but not its threads, and would wait for them without end;
//! the process id is part of the key, so that it builds its own.

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock, Mutex, PoisonError, mpsc};

use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::base::error::{Error, Result};
use crate::dynamics::Dynamics;

/// Stack of our own threads \[bytes\]: without optimisation a frame of the vector code alone takes more than the 2 MiB that Rust
/// gives a thread.
pub const STACK: usize = if cfg!(debug_assertions) {
    8 << 20
} else {
    2 << 20
};

/// Pools by process and size.
type Pools = HashMap<(u32, usize), Arc<ThreadPool>>;

static POOLS: LazyLock<Mutex<Pools>> = LazyLock::new(Mutex::default);

/// The pool of that many threads.
fn pool(threads: usize) -> Result<Arc<ThreadPool>> {
    let key = (std::process::id(), threads);
    let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(pool) = pools.get(&key) {
        return Ok(Arc::clone(pool));
    }
    let pool = ThreadPoolBuilder::new()
        .num_threads(threads)
        .thread_name(|i| format!("ballrace-{i}"))
        .stack_size(STACK)
        .build()
        .map_err(|e| {
            Error::scene(
                "threads",
                threads,
                format!("a number of threads the system grants ({e})"),
            )
        })?;
    let pool = Arc::new(pool);
    pools.insert(key, Arc::clone(&pool));
    Ok(pool)
}

/// Works on the balls of a model with the given number of threads.
pub(crate) fn on<'m, T: Send>(
    threads: usize,
    dynamics: Dynamics<'m>,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    work: impl FnOnce(Dynamics<'m>, &mut dyn FnMut(f64) -> ControlFlow<()>) -> Result<T> + Send,
) -> Result<T> {
    if threads == 1 {
        return work(dynamics, progress);
    }
    let pool = pool(threads)?;
    let dynamics = dynamics.shared(Arc::clone(&pool));
    inside(&pool, progress, |progress| work(dynamics, progress))
}

/// Works inside a pool: to enter one takes some 10 µs, to hand out work from inside next to nothing. `progress`
/// stays on this thread: it may hold a lock that a thread of the pool must not wait for.
fn inside<T: Send>(
    pool: &ThreadPool,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    work: impl FnOnce(&mut dyn FnMut(f64) -> ControlFlow<()>) -> T + Send,
) -> T {
    let (told, listen) = mpsc::channel();
    let stop = AtomicBool::new(false);
    let mut result = None;
    pool.in_place_scope(|scope| {
        scope.spawn(|_| {
            // Owned here, so that listening ends with the work.
            let told = told;
            result = Some(work(&mut |share| {
                let _ = told.send(share);
                if stop.load(Ordering::Relaxed) {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            }));
        });
        for share in &listen {
            if progress(share).is_break() {
                stop.store(true, Ordering::Relaxed);
            }
        }
    });
    result.expect("the scope waits for the work")
}
