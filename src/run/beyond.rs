//! Follows a motion beyond the end of a run, for what filtered samples take from there.

use std::ops::ControlFlow;

use super::method::{self, Integration};
use super::step_collapse::StepCollapse;
use super::watch::{Progress, REPORT_EVERY, StepWatch};
use crate::base::clock;
use crate::base::error::{Error, Result};
use crate::dynamics::Dynamics;
use crate::integrate::{self, DenseStep, Options, Tolerance};

/// Follows the motion beyond the end of the run for what the last samples take from there; returns the evaluations.
/// Where it cannot go on, the samples make do with what there is.
pub(super) fn go_on(
    dynamics: &mut Dynamics<'_>,
    watch: &mut dyn StepWatch,
    end: f64,
    y: &[f64],
    tolerance: &Tolerance,
    options: &Options,
    progress: Progress<'_>,
) -> Result<usize> {
    let until = watch.until(end);
    if until <= end {
        return Ok(0);
    }
    let mut collapse = StepCollapse::new(dynamics.model(), options.max_step);
    let (mut reported, mut stopped) = (clock::now(), false);
    let mut observe =
        |dynamics: &mut Dynamics<'_>, step: &DenseStep<'_>, _: &integrate::StepStatistics| {
            if dynamics.lost().is_some() || collapse.after(step.h()) {
                return ControlFlow::Break(());
            }
            stopped = watch.step(dynamics, step, step.t1()).is_break();
            if clock::since(reported) >= REPORT_EVERY {
                reported = clock::now();
                stopped |= progress(1.0).is_break();
            }
            if stopped {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
    let task = Integration {
        span: (end, until),
        y0: y,
        tolerance,
        options,
    };
    let beyond = method::run(dynamics, task, &mut None, &mut observe);
    if stopped {
        return Err(Error::Interrupted { time: end });
    }
    Ok(beyond.map_or(0, |solution| solution.stats.nfev))
}
