//! The method that a run asked for.

use std::ops::ControlFlow;

use crate::base::words::{Words, remembers};
use crate::dynamics::Dynamics;
use crate::integrate::{
    self, Adams, DORMAND_PRINCE, DenseStep, Failure, Integrator, Observer, Options, Solution,
    StepStatistics, System, Tolerance, VERNER,
};
use crate::scene::Method;
use crate::velocities::Damped;

/// Task of an integration: from where to where, and how well.
#[derive(Clone, Copy)]
pub(crate) struct Integration<'a> {
    pub span: (f64, f64),
    /// State at which it begins if nothing is remembered.
    pub y0: &'a [f64],
    pub tolerance: &'a Tolerance,
    pub options: &'a Options,
}

/// Memory of an integration that stands.
#[derive(Debug, Clone, Default)]
pub(crate) struct Memory {
    integrator: Vec<u64>,
    /// Words of the contacts' matrix.
    matrix: Vec<u64>,
    /// Speed of films that follow that of the rings, as of the last evaluation \[rad/s\].
    film_speed: Option<f64>,
}

remembers!(Memory: integrator, matrix, film_speed);

/// Name of the scene's method.
pub(crate) fn name(method: Method) -> &'static str {
    match method {
        Method::DormandPrince => DORMAND_PRINCE.name,
        Method::Verner => VERNER.name,
        Method::Adams => Adams::NAME,
    }
}

/// Integrates by the scene's method until the end, or until the observer breaks off: what is remembered then goes on from there.
pub(crate) fn run<'m, O: Observer<Dynamics<'m>>>(
    dynamics: &mut Dynamics<'m>,
    task: Integration<'_>,
    memory: &mut Option<Memory>,
    observer: &mut O,
) -> Result<Solution, Failure> {
    let from = memory.take().unwrap_or_default();
    let integrator = &from.integrator;
    let mut after = Memory::default();
    let solution = match dynamics.model().scene().solver.method {
        Method::DormandPrince => {
            dynamics.set_film_speed(from.film_speed);
            by(
                &DORMAND_PRINCE,
                dynamics,
                task,
                integrator,
                &mut after,
                observer,
            )
        }
        Method::Verner => {
            dynamics.set_film_speed(from.film_speed);
            by(&VERNER, dynamics, task, integrator, &mut after, observer)
        }
        Method::Adams => {
            let mut system = Damped::new(dynamics, task.options.max_step);
            if !integrator.is_empty() {
                system
                    .remember(&from.matrix)
                    .map_err(|_| integrate::other_task(task.span.0))?;
                system.dynamics.set_film_speed(from.film_speed);
            }
            let observer = &mut Through(observer);
            let solution = by(&Adams, &mut system, task, integrator, &mut after, observer)?;
            after.matrix = system.remembered();
            Ok(solution)
        }
    }?;
    after.film_speed = dynamics.film_speed();
    *memory = solution.interrupted.then_some(after);
    Ok(solution)
}

/// Integrates by one method.
fn by<S, M, O>(
    method: &M,
    system: &mut S,
    task: Integration<'_>,
    from: &[u64],
    after: &mut Memory,
    observer: &mut O,
) -> Result<Solution, Failure>
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
    let mut integrator = if from.is_empty() {
        Integrator::begin(system, method, span, y0, tolerance, &options)?
    } else {
        Integrator::resumed(system, method, span, from, tolerance, &options)?
    };
    let interrupted = integrator.run(system, method, observer)?;
    if interrupted {
        after.integrator = Words::saved(&mut integrator);
    }
    Ok(integrator.solution(interrupted))
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
