//! Many cases on all cores: each runs on one thread, so that its bits do not depend on their number,
//! and a failed case is an outcome like any other.
//!
//! ```
//! use std::ops::ControlFlow;
//! use ballrace::{Case, FeatureOptions, Run, campaign, scene::presets};
//!
//! let run = Run { duration: 1e-3, ..Run::default() };
//! let cases = [-3000.0, 0.0, 3000.0].map(|axial| Case::new(presets::wheel_bearing(axial), run.clone()));
//! let mut outcomes = campaign(cases, 2, &FeatureOptions::default(), &mut |_| ControlFlow::Continue(()))?;
//! assert_eq!(outcomes.len(), 3);
//! let signals = outcomes.remove(2).result?.signals; // of +3 kN: outcomes stand in the order of the cases
//! assert_eq!(signals.get("outer.ay").unwrap().len(), 50);
//! # Ok::<(), ballrace::Error>(())
//! ```

mod case;
mod stream;

use std::ops::ControlFlow;

use crate::base::error::Result;
use crate::features::FeatureOptions;

pub use case::{Case, Finished, Outcome};
pub use stream::stream;

/// Runs all cases on `threads` threads (0: all cores) and returns their outcomes in the order of the cases.
///
/// `watch` is called on this thread about every 50 ms with the number of cases done, and may stop everything:
/// cases that have not finished by then are left out. To see many thousands through, use [`stream()`], which
/// keeps none of them.
///
/// # Errors
/// [`crate::Error::Argument`] for a number of threads that is not usable. What goes wrong in a case is in its outcome.
pub fn campaign(
    cases: impl IntoIterator<Item = Case>,
    threads: usize,
    options: &FeatureOptions,
    watch: &mut dyn FnMut(usize) -> ControlFlow<()>,
) -> Result<Vec<Outcome>> {
    let mut outcomes = Vec::new();
    stream(cases.into_iter(), threads, options, &mut |done| {
        outcomes.extend(done);
        watch(outcomes.len())
    })?;
    outcomes.sort_by_key(|outcome: &Outcome| outcome.index);
    Ok(outcomes)
}
