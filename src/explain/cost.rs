//! What a run costs, by running a little of it.

use std::ops::ControlFlow;
use std::time::Instant;

use serde::Serialize;

use crate::dynamics::Dynamics;
use crate::error::Result;
use crate::integrate::{DenseStep, Statistics, System};
use crate::method::{self, Task};
use crate::model::Model;
use crate::simulate::{options, tolerance};

/// Steps that are timed.
const STEPS: usize = 300;
/// How often; the fastest counts, the others were disturbed.
const TIMES: usize = 3;
/// Evaluations that are timed at once.
const EVALUATIONS: usize = 300;

/// What a run costs on one thread of this machine, sampling aside.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Cost {
    /// Evaluations of the right-hand side for a simulated second.
    pub evaluations: f64,
    /// Time for one of them with the integrator's share \[s\].
    pub evaluation: f64,
    /// Time for the right-hand side alone \[s\].
    pub right_hand_side: f64,
    /// Time for a simulated second \[s\].
    pub seconds: f64,
}

/// Times the first steps from a state.
pub(super) fn of(model: &Model, y0: &[f64]) -> Result<Cost> {
    let options = options(model)?;
    let reduction = model.reduction(y0);
    let (mut best, mut evaluations) = (f64::INFINITY, 0.0);
    for _ in 0..TIMES {
        let mut dynamics = Dynamics::begin(model, reduction.as_ref(), y0);
        let tolerance = tolerance(&dynamics)?;
        let own = dynamics.compress(y0);
        let begun = Instant::now();
        let mut reached = (0.0, 0);
        let mut stop = |_: &mut Dynamics<'_>, step: &DenseStep<'_>, stats: &Statistics| {
            reached = (step.t1(), stats.nfev);
            if stats.accepted >= STEPS {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let task = Task {
            span: (0.0, 1.0),
            y0: &own,
            tolerance: &tolerance,
            options: &options,
        };
        // A run that breaks down says so itself; what it did until then still tells the cost.
        let _ = method::run(&mut dynamics, task, &mut stop);
        let (time, nfev) = reached;
        if nfev > 0 {
            best = best.min(begun.elapsed().as_secs_f64() / nfev as f64);
            evaluations = nfev as f64 / time;
        }
    }
    Ok(Cost {
        evaluations,
        evaluation: best,
        right_hand_side: right_hand_side(model, y0),
        seconds: evaluations * best,
    })
}

/// Time of one evaluation at a state.
pub(super) fn right_hand_side(model: &Model, y0: &[f64]) -> f64 {
    let reduction = model.reduction(y0);
    let mut dynamics = Dynamics::begin(model, reduction.as_ref(), y0);
    let own = dynamics.compress(y0);
    let mut dy = vec![0.0; own.len()];
    let mut time = || {
        let begun = Instant::now();
        for _ in 0..EVALUATIONS {
            dynamics.rhs(0.0, std::hint::black_box(&own), &mut dy);
        }
        begun.elapsed().as_secs_f64() / EVALUATIONS as f64
    };
    (0..TIMES).map(|_| time()).fold(f64::INFINITY, f64::min)
}
