//! Limits of a run's cost: wall time, and steps.

use std::ops::ControlFlow;

use crate::base::clock;
use crate::base::error::{Error, Result};
use crate::base::interrupt;
use crate::base::words::remembers;
use crate::integrate::StepStatistics;

/// Works under a limit of wall time \[s\], checked as often as `progress` is called, so about every 20 ms, and by static
/// solves at every iteration.
///
/// # Errors
/// Those of the work, with [`Error::Budget`] in place of the interruption that a spent limit causes.
pub(crate) fn within<T>(
    limit: Option<f64>,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    work: impl FnOnce(&mut dyn FnMut(f64) -> ControlFlow<()>) -> Result<T>,
) -> Result<T> {
    let Some(seconds) = limit else {
        return work(progress);
    };
    if !clock::is_there() {
        let allowed = "None where the system has no clock, or one given by set_clock";
        return Err(Error::argument("time_limit", seconds, allowed));
    }
    let deadline = clock::now() + seconds;
    let is_over = || clock::now() >= deadline;
    let mut asked = false;
    let mut watched = |share| {
        asked = progress(share).is_break();
        if asked || is_over() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let result = interrupt::until(deadline, || work(&mut watched));
    match result {
        Err(Error::Interrupted { time }) if !asked && is_over() => Err(Error::Budget {
            time,
            name: "time_limit",
            limit: seconds,
        }),
        other => other,
    }
}

/// Counts steps, accepted and rejected ones, over the parts that `auto` integrates a run in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepBudget {
    limit: Option<usize>,
    /// Steps of the parts before this one, and of this one.
    before: usize,
    now: usize,
}

impl StepBudget {
    pub fn new(limit: Option<usize>) -> Self {
        Self {
            limit,
            before: 0,
            now: 0,
        }
    }

    /// Whether no step is left after an accepted one.
    pub fn spent(&mut self, stats: &StepStatistics) -> bool {
        if stats.accepted == 1 {
            self.before += self.now;
        }
        self.now = stats.accepted + stats.rejected;
        self.limit
            .is_some_and(|limit| self.before + self.now >= limit)
    }

    /// The error of a run that has spent them at a time \[s\].
    pub fn error(&self, time: f64) -> Error {
        Error::Budget {
            time,
            name: "max_steps",
            limit: self.limit.unwrap_or_default() as f64,
        }
    }
}

remembers!(StepBudget: before, now; but limit);

#[cfg(test)]
mod tests {
    use super::*;

    fn counted(accepted: usize, rejected: usize) -> StepStatistics {
        StepStatistics {
            accepted,
            rejected,
            ..StepStatistics::default()
        }
    }

    #[test]
    fn steps_of_all_parts_count() {
        let mut budget = StepBudget::new(Some(10));
        assert!(!budget.spent(&counted(1, 0)));
        assert!(!budget.spent(&counted(2, 4)));
        // Another part begins, as it does where `auto` changes the method.
        assert!(!budget.spent(&counted(1, 2)));
        assert!(budget.spent(&counted(2, 2)));
        assert!(!StepBudget::new(None).spent(&counted(1 << 40, 0)));
    }

    #[test]
    fn an_interruption_of_another_kind_stays_one() {
        let stopped = within::<()>(Some(1e3), &mut |_| ControlFlow::Break(()), |progress| {
            assert!(progress(0.5).is_break());
            Err(Error::Interrupted { time: 1.0 })
        });
        assert_eq!(stopped, Err(Error::Interrupted { time: 1.0 }));
    }
}
