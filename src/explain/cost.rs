//! Cost of a run, by running a little of it.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use serde::Serialize;

use crate::base::clock;
use crate::base::error::Result;
use crate::base::interrupt;
use crate::dynamics::Dynamics;
use crate::integrate::{DenseStep, StepStatistics, System};
use crate::model::{BodyId, Dof, Model};
use crate::reduction::Reduction;
use crate::run::method::{self, Integration};
use crate::run::{options, tolerance};

/// Places of the cage over a ball's pitch.
const PLACES: usize = 8;
/// Steps that are timed at each.
const STEPS: usize = 240;
/// Number of the first steps, which grow.
const GROWING: usize = 60;
/// Number of repetitions; the fastest counts, the others were disturbed.
const TIMES: usize = 3;
/// Evaluations that are timed at once.
const EVALUATIONS: usize = 60;

/// Cost of a run on one thread of this machine, sampling aside.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Cost {
    /// Evaluations of the right-hand side for a simulated second.
    pub evaluations: f64,
    /// Time for one of them with the integrator's share \[s\].
    pub evaluation: f64,
    /// Time for the right-hand side alone \[s\].
    pub right_hand_side: f64,
    /// Share of an evaluation for the contacts of balls and races \[s\].
    pub contacts: f64,
    /// Share of an evaluation for the cage \[s\].
    pub cage: f64,
    /// Time for a simulated second \[s\].
    pub seconds: f64,
}

impl Cost {
    /// Parts of an evaluation, by name \[s\].
    pub fn parts(&self) -> [(&'static str, f64); 4] {
        let others = self.right_hand_side - self.contacts - self.cage;
        [
            ("contacts", self.contacts),
            ("cage", self.cage),
            (
                "other forces, reading and writing of states",
                others.max(0.0),
            ),
            (
                "steps, samples",
                (self.evaluation - self.right_hand_side).max(0.0),
            ),
        ]
    }
}

/// Times some steps from a state of all bodies, at several places of the cage.
pub(super) fn of(model: &Model, y0: &[f64]) -> Result<Cost> {
    // Only the scene's own start is at rest and takes the steps of a run.
    let (_, evaluations) = steps(model, y0, PLACES * STEPS)?;
    let mut evaluation = 0.0;
    for start in places(model, y0) {
        evaluation += steps(model, &start, STEPS)?.0 / PLACES as f64;
    }
    let whole = right_hand_side(model, y0);
    let contacts = time_at_places(model, y0, |dynamics, _, _| dynamics.evaluate_contacts());
    let cage = time_at_places(model, y0, |dynamics, _, _| dynamics.evaluate_cage());
    // One loop for all is faster than its parts by themselves, whose times then give their shares of it.
    let share = (whole / (contacts + cage)).min(1.0);
    Ok(Cost {
        evaluations,
        evaluation,
        right_hand_side: whole,
        contacts: share * contacts,
        cage: share * cage,
        seconds: evaluations * evaluation,
    })
}

/// Time for an evaluation in some steps, and evaluations for a simulated second.
fn steps(model: &Model, start: &[f64], count: usize) -> Result<(f64, f64)> {
    let options = options(model);
    let reduction = Reduction::of(model, start);
    let mut best = f64::INFINITY;
    let mut reached = [(0.0, 0); 2];
    for _ in 0..TIMES {
        let mut dynamics = Dynamics::begin(model, reduction.as_ref(), start);
        let tolerance = tolerance(&dynamics)?;
        let own = dynamics.compress(start);
        let begun = clock::now();
        let mut stop = |_: &mut Dynamics<'_>, step: &DenseStep<'_>, stats: &StepStatistics| {
            let now = (step.t1(), stats.nfev);
            if stats.accepted <= GROWING {
                reached[0] = now;
            }
            reached[1] = now;
            if stats.accepted >= count || interrupt::check().is_err() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let task = Integration {
            span: (0.0, 1.0),
            y0: &own,
            tolerance: &tolerance,
            options: &options,
        };
        // A run that fails reports it itself; its steps until then still show the cost.
        let _ = method::run(&mut dynamics, task, &mut None, &mut stop);
        interrupt::check()?;
        best = best.min(clock::since(begun));
    }
    let [(from, before), (to, nfev)] = reached;
    let rate = (nfev - before) as f64 / (to - from);
    Ok((
        best / nfev as f64,
        if rate.is_finite() { rate } else { 0.0 },
    ))
}

/// Time of one evaluation near a state of all bodies.
fn right_hand_side(model: &Model, y0: &[f64]) -> f64 {
    time_at_places(model, y0, |dynamics, y, dy| dynamics.rhs(0.0, y, dy))
}

/// Time of a part of an evaluation, given the run's states and a place for their rates, in the mean over places of the
/// cage.
fn time_at_places(
    model: &Model,
    y0: &[f64],
    work: impl Fn(&mut Dynamics<'_>, &[f64], &mut [f64]),
) -> f64 {
    let at = |start: &Vec<f64>| {
        let reduction = Reduction::of(model, start);
        let mut dynamics = Dynamics::begin(model, reduction.as_ref(), start);
        let own = dynamics.compress(start);
        let mut dy = vec![0.0; own.len()];
        dynamics.rhs(0.0, &own, &mut dy);
        let mut time = || {
            let begun = clock::now();
            for _ in 0..EVALUATIONS {
                if interrupt::check().is_err() {
                    break;
                }
                work(&mut dynamics, std::hint::black_box(&own), &mut dy);
            }
            clock::since(begun) / EVALUATIONS as f64
        };
        (0..TIMES).map(|_| time()).fold(f64::INFINITY, f64::min)
    };
    places(model, y0).iter().map(at).sum::<f64>() / PLACES as f64
}

/// A state with the balls turned about the axis by parts of their pitch: a ball in a defect costs more than the others,
/// and it is not always there.
fn places(model: &Model, y0: &[f64]) -> Vec<Vec<f64>> {
    let layout = model.layout();
    let turned = |part: usize| {
        let mut y = y0.to_vec();
        for (j, ball) in model.balls.iter().enumerate() {
            let pitch = TAU / model.rows[ball.row].count as f64;
            let (sin, cos) = (pitch * part as f64 / PLACES as f64).sin_cos();
            for half in y.chunks_mut(layout.half()) {
                let body = layout.of_mut(half, BodyId::ball(j));
                let [along_x, along_y] = Dof::SYMMETRIC.map(|dof| body[dof]);
                body[Dof::X] = cos * along_x - sin * along_y;
                body[Dof::Y] = sin * along_x + cos * along_y;
            }
        }
        y
    };
    (0..PLACES).map(turned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Friction, presets};
    use crate::statics::compile;
    use crate::statics::start::{Start, start};

    /// Analytic: parts are no more than the whole, also where one loop does all.
    #[test]
    fn parts_add_up() {
        let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        scene.friction = Friction::None;
        let model = compile(&scene).unwrap();
        let y0 = start(&model, &Start::Equilibrium).unwrap();
        let cost = of(&model, &y0).unwrap();
        let parts = cost.contacts + cost.cage;
        assert!(parts <= (1.0 + 1e-12) * cost.right_hand_side, "{cost:?}");
    }
}
