//! Stopping work from outside: a handle that another thread sets, and a time to be done by.
//!
//! A static solve is many small ones, deeply nested. They check here, at every iteration of a ball, whether to go on: the handle
//! belongs to the working thread, so that no function has to pass it on.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::base::clock;
use crate::base::error::{Error, Result};

/// Stops from another thread what works under it: `equilibrium`, `stiffness`, `load_distribution`, `explain`, `start`,
/// `compile` and the static parts of `simulate`, whose integration asks its `progress`.
///
/// ```
/// use ballrace::{Error, Interrupt, equilibrium, scene::presets};
/// let (stop, scene) = (Interrupt::new(), presets::wheel_bearing(0.0));
/// assert!(stop.scope(|| equilibrium(&scene)).is_ok());
/// stop.set();
/// assert!(matches!(stop.scope(|| equilibrium(&scene)), Err(Error::Interrupted { .. })));
/// ```
#[derive(Debug, Clone, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// An interrupt that lets everything go on.
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks to stop, for good.
    pub fn set(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the work is to stop.
    pub fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Works on this thread until done or asked to stop, which ends it by [`Error::Interrupted`].
    pub fn scope<T>(&self, work: impl FnOnce() -> T) -> T {
        under(Limit::Asked(self.clone()), work)
    }

    /// The former name of [`Self::scope`]; gone in 0.5.
    #[deprecated(since = "0.4.0", note = "is called `scope`")]
    pub fn heed<T>(&self, work: impl FnOnce() -> T) -> T {
        self.scope(work)
    }
}

/// Works on this thread until done or until a time of the clock \[s\].
pub(crate) fn until<T>(deadline: f64, work: impl FnOnce() -> T) -> T {
    under(Limit::Deadline(deadline), work)
}

/// Fails where the work of this thread is to end.
pub(crate) fn check() -> Result<()> {
    let ended = LIMITS.with_borrow(|limits| limits.iter().any(Limit::is_over));
    if ended {
        Err(Error::Interrupted { time: 0.0 })
    } else {
        Ok(())
    }
}

enum Limit {
    Asked(Interrupt),
    Deadline(f64),
}

impl Limit {
    fn is_over(&self) -> bool {
        match self {
            Self::Asked(interrupt) => interrupt.is_set(),
            Self::Deadline(time) => clock::now() >= *time,
        }
    }
}

thread_local! {
    static LIMITS: RefCell<Vec<Limit>> = const { RefCell::new(Vec::new()) };
}

fn under<T>(limit: Limit, work: impl FnOnce() -> T) -> T {
    /// Takes the limit away again, after a panic too.
    struct Scope;
    impl Drop for Scope {
        fn drop(&mut self) {
            LIMITS.with_borrow_mut(Vec::pop);
        }
    }
    LIMITS.with_borrow_mut(|limits| limits.push(limit));
    let _scope = Scope;
    work()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scope_ends_with_the_work() {
        let stop = Interrupt::new();
        stop.set();
        assert_eq!(check(), Ok(()));
        assert!(stop.scope(check).is_err());
        stop.scope(|| until(clock::now(), || ()));
        assert_eq!(check(), Ok(()));
        assert!(until(clock::now(), check).is_err());
        let panicked = std::panic::catch_unwind(|| stop.scope(|| panic!("as meant")));
        assert!(panicked.is_err());
        assert_eq!(check(), Ok(()));
    }
}
