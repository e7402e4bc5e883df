//! Wall time: that of the system, or of a clock that the program gives.

use std::sync::{LazyLock, OnceLock};
use std::time::Instant;

/// Whether the system has a clock: WebAssembly without a system has none.
const SYSTEM_HAS_ONE: bool = cfg!(not(all(target_family = "wasm", target_os = "unknown")));

static GIVEN: OnceLock<fn() -> f64> = OnceLock::new();
static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);

/// Takes wall time from a function in place of the system's clock: seconds since any moment \[s\]. To be given before anything is run,
/// and once in a process; false where there is one already, which stays.
///
/// A program needs it where the system has no clock, as on `wasm32-unknown-unknown`. Until one is given there, [`Run::time_limit`]
/// is refused, `progress` is not called while a run is under way, and wall times are 0.
///
/// ```standalone_crate
/// use std::sync::atomic::{AtomicU32, Ordering};
/// use ballrace::{Error, Run, scene::presets, set_clock, simulate};
///
/// /// A second passes at every look.
/// fn ticking() -> f64 {
///     static SECONDS: AtomicU32 = AtomicU32::new(0);
///     SECONDS.fetch_add(1, Ordering::Relaxed).into()
/// }
/// assert!(set_clock(ticking));
/// let run = Run { duration: 1e-3, time_limit: Some(5.0), ..Run::default() };
/// let ended = simulate(&presets::wheel_bearing(0.0), &run);
/// assert!(matches!(ended, Err(Error::Budget { name: "time_limit", .. })));
/// ```
///
/// [`Run::time_limit`]: crate::Run::time_limit
pub fn set_clock(now: fn() -> f64) -> bool {
    GIVEN.set(now).is_ok()
}

/// Whether there is a clock.
pub(crate) fn is_there() -> bool {
    SYSTEM_HAS_ONE || GIVEN.get().is_some()
}

/// Seconds since a moment that stays the same \[s\].
pub(crate) fn now() -> f64 {
    match GIVEN.get() {
        Some(given) => given(),
        None if SYSTEM_HAS_ONE => BEGUN.elapsed().as_secs_f64(),
        None => 0.0,
    }
}

/// Seconds since a time \[s\].
pub(crate) fn since(begun: f64) -> f64 {
    now() - begun
}
