//! Thread pools of this crate, one per process and size; never rayon's global one. Without the feature `parallel` there are none, and
//! all work is done on the calling thread, with the same bits.
//!
//! A forked child inherits the memory of its parent's pool but not its threads, and would wait for them without end;
//! the process id is part of the key, so that it builds its own.

#[cfg(feature = "parallel")]
use std::collections::HashMap;
#[cfg(not(feature = "parallel"))]
use std::convert::Infallible;
use std::ops::ControlFlow;
#[cfg(feature = "parallel")]
use std::sync::atomic::{AtomicBool, Ordering};
#[cfg(feature = "parallel")]
use std::sync::{Arc, LazyLock, Mutex, PoisonError, mpsc};

#[cfg(feature = "parallel")]
use rayon::prelude::*;
#[cfg(feature = "parallel")]
use rayon::{ThreadPool, ThreadPoolBuilder};

#[cfg(feature = "parallel")]
use crate::base::error::Error;
use crate::base::error::Result;

/// Stack of our own threads \[bytes\]. Without optimisation a run takes 0.8 MiB, a tenth of it with.
pub const STACK: usize = 2 << 20;

/// Threads that share the work of an evaluation.
#[derive(Debug, Clone)]
pub struct Pool {
    #[cfg(feature = "parallel")]
    threads: Arc<ThreadPool>,
    #[cfg(not(feature = "parallel"))]
    none: Infallible,
}

/// Pools by process and size.
#[cfg(feature = "parallel")]
type Pools = HashMap<(u32, usize), Pool>;

#[cfg(feature = "parallel")]
static POOLS: LazyLock<Mutex<Pools>> = LazyLock::new(Mutex::default);

#[cfg(feature = "parallel")]
impl Pool {
    /// The pool of so many threads; none for one.
    ///
    /// # Errors
    /// [`Error::Argument`] for more threads than the system grants.
    pub fn of(threads: usize) -> Result<Option<Self>> {
        if threads == 1 {
            return Ok(None);
        }
        let key = (std::process::id(), threads);
        let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(pool) = pools.get(&key) {
            return Ok(Some(pool.clone()));
        }
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|i| format!("ballrace-{i}"))
            .stack_size(STACK)
            .build()
            .map_err(|e| {
                Error::argument(
                    "threads",
                    threads,
                    format!("a number of threads the system grants ({e})"),
                )
            })?;
        let pool = Self {
            threads: Arc::new(pool),
        };
        pools.insert(key, pool.clone());
        Ok(Some(pool))
    }

    /// Works inside the pool: to enter one takes some 10 µs, to hand out work from inside next to nothing. `progress`
    /// stays on this thread: it may hold a lock that a thread of the pool must not wait for.
    ///
    /// # Panics
    /// Where the work does.
    pub fn inside<T: Send>(
        &self,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
        work: impl FnOnce(&mut dyn FnMut(f64) -> ControlFlow<()>) -> T + Send,
    ) -> T {
        let (sender, receiver) = mpsc::channel();
        let stop = AtomicBool::new(false);
        let mut result = None;
        self.threads.in_place_scope(|scope| {
            scope.spawn(|_| {
                // Owned here, so that listening ends with the work.
                let sender = sender;
                result = Some(work(&mut |share| {
                    let _ = sender.send(share);
                    if stop.load(Ordering::Relaxed) {
                        ControlFlow::Break(())
                    } else {
                        ControlFlow::Continue(())
                    }
                }));
            });
            for share in &receiver {
                if progress(share).is_break() {
                    stop.store(true, Ordering::Relaxed);
                }
            }
        });
        result.expect("the scope waits for the work")
    }
}

#[cfg(not(feature = "parallel"))]
impl Pool {
    /// No pool, as the feature `parallel` is off.
    ///
    /// # Errors
    /// Never.
    #[allow(clippy::unnecessary_wraps)]
    pub fn of(_threads: usize) -> Result<Option<Self>> {
        Ok(None)
    }

    /// No pool to work in: the feature `parallel` is off.
    pub fn inside<T>(
        &self,
        _progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
        _work: impl FnOnce(&mut dyn FnMut(f64) -> ControlFlow<()>) -> T,
    ) -> T {
        match self.none {}
    }
}

/// Works on each of several, by the threads of a pool if there is one.
pub(crate) fn each<T: Send>(
    pool: Option<&Pool>,
    of: &mut [T],
    work: impl Fn(&mut T) + Send + Sync,
) {
    match pool {
        // A run already lives inside the pool, where this costs no more than a call.
        #[cfg(feature = "parallel")]
        Some(Pool { threads }) => threads.install(|| of.par_iter_mut().for_each(work)),
        _ => of.iter_mut().for_each(work),
    }
}
