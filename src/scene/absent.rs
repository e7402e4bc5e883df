//! Fields that a document leaves out where they are absent, so that older documents keep their text. [`Scene::with`](super::Scene::with)
//! writes them out to find their places.
//!
//! A field of the scene is left out by `skip_serializing_if = "absent::none"` or `"absent::empty"` and by nothing else.

use std::cell::Cell;
use std::collections::BTreeMap;

thread_local! {
    /// Whether this thread writes out everything.
    static WRITTEN_OUT: Cell<bool> = const { Cell::new(false) };
}

/// Whether an option is left out.
#[allow(clippy::ref_option)] // as serde asks
pub(super) fn none<T>(value: &Option<T>) -> bool {
    value.is_none() && !WRITTEN_OUT.get()
}

/// Whether named parts are left out.
pub(super) fn empty<T>(parts: &BTreeMap<String, T>) -> bool {
    parts.is_empty() && !WRITTEN_OUT.get()
}

/// Acts while nothing is left out, such as to write a document.
pub(super) fn written_out<T>(act: impl FnOnce() -> T) -> T {
    /// Leaves out again at its end, also where the act panics.
    struct LeaveOut;
    impl Drop for LeaveOut {
        fn drop(&mut self) {
            WRITTEN_OUT.set(false);
        }
    }
    let _end = LeaveOut;
    WRITTEN_OUT.set(true);
    act()
}
