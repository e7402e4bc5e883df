//! The method that a run asked for.

use std::ops::ControlFlow;

use crate::dynamics::Dynamics;
use crate::integrate::{
    self, Adams, DORMAND_PRINCE, DenseStep, Failure, Observer, Options, Solution, StepStatistics,
    System, Tolerance, VERNER, integrate,
};
use crate::scene::Method;
use crate::velocities::Damped;

/// From where to where, and how well.
#[derive(Clone, Copy)]
pub(crate) struct Integration<'a> {
    pub span: (f64, f64),
    pub y0: &'a [f64],
    pub tolerance: &'a Tolerance,
    pub options: &'a Options,
}

/// Integrates by the scene's method, and says what that is called.
pub(crate) fn run<'m, O: Observer<Dynamics<'m>>>(
    dynamics: &mut Dynamics<'m>,
    task: Integration<'_>,
    observer: &mut O,
) -> Result<(Solution, &'static str), Failure> {
    match dynamics.model().scene().solver.method {
        Method::DormandPrince => by(&DORMAND_PRINCE, dynamics, task, observer),
        Method::Verner => by(&VERNER, dynamics, task, observer),
        Method::Adams => {
            let system = &mut Damped::new(dynamics, task.options.max_step);
            by(&Adams, system, task, &mut Through(observer))
        }
    }
}

/// Integrates by one method.
fn by<S, M, O>(
    method: &M,
    system: &mut S,
    task: Integration<'_>,
    observer: &mut O,
) -> Result<(Solution, &'static str), Failure>
where
    S: System,
    M: integrate::StepMethod<S>,
    O: Observer<S>,
{
    let Integration {
        span,
        y0,
        tolerance,
        options,
    } = task;
    let options = Options {
        controller: method.controller(),
        ..options.clone()
    };
    let solution = integrate(system, method, span, y0, tolerance, &options, observer)?;
    Ok((solution, method.tableau().name))
}

/// Lets an observer of the right-hand side see steps of Adams' method.
struct Through<'o, O>(&'o mut O);

impl<'m, O: Observer<Dynamics<'m>>> Observer<Damped<'_, 'm>> for Through<'_, O> {
    fn accepted(
        &mut self,
        system: &mut Damped<'_, 'm>,
        step: &DenseStep<'_>,
        stats: &StepStatistics,
    ) -> ControlFlow<()> {
        self.0.accepted(system.dynamics, step, stats)
    }
}
