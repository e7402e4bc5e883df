//! The method a run asked for, and the switch between explicit and implicit ones.

use std::fmt;
use std::ops::ControlFlow;

use super::step_limit;
use crate::dynamics::Dynamics;
use crate::implicit::{Damped, ImplicitDynamics};
use crate::integrate::{
    self, Adams, BOGACKI_SHAMPINE, DORMAND_PRINCE, DenseStep, Failure, KENNEDY_CARPENTER, Observer,
    Options, RUNGE_KUTTA_4, Solution, Statistics, System, TSITOURAS, Tolerance, VERNER,
    VelocityVerlet, integrate,
};
use crate::model::Model;
use crate::scene::Method;

/// Stiffness quotients at which `auto` takes to implicit steps and back to explicit ones. At a quotient of 1
/// friction begins to hold explicit steps below the cap, and at loose tolerance they report success with wrong
/// accelerations (by 27 % at 1.4 and rtol 1e-3). Implicit steps cost twice as much there, as much from about 2 on.
const SWITCH: (f64, f64) = (1.0, 0.5);

/// Accepted steps between two looks at the stiffness; one costs about an evaluation.
const LOOK_EVERY: usize = 50;

/// What was done.
#[derive(Debug, Clone, Default)]
pub(crate) struct Choice {
    auto: bool,
    names: Vec<&'static str>,
    /// Accepted steps that were implicit.
    pub implicit: usize,
    /// Largest stiffness quotient seen.
    pub stiffness: Option<f64>,
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let auto = if self.auto { "auto: " } else { "" };
        write!(f, "{auto}{}", self.names.join(", "))
    }
}

/// From where to where, and how well.
#[derive(Clone, Copy)]
pub(crate) struct Task<'a> {
    pub span: (f64, f64),
    pub y0: &'a [f64],
    pub tolerance: &'a Tolerance,
    pub options: &'a Options,
}

/// Integrates by the scene's method.
pub(crate) fn run<'m, O: Observer<Dynamics<'m>>>(
    dynamics: &mut Dynamics<'m>,
    task: Task<'_>,
    observer: &mut O,
) -> Result<(Solution, Choice), Failure> {
    match dynamics.model().scene().solver.method {
        Method::DormandPrince => by(&DORMAND_PRINCE, dynamics, task, observer),
        Method::BogackiShampine => by(&BOGACKI_SHAMPINE, dynamics, task, observer),
        Method::Tsitouras => by(&TSITOURAS, dynamics, task, observer),
        Method::Verner => by(&VERNER, dynamics, task, observer),
        Method::RungeKutta4 => by(&RUNGE_KUTTA_4, dynamics, task, observer),
        Method::Adams => by(
            &Adams,
            &mut Damped::new(dynamics, task.options.max_step),
            task,
            &mut Through(observer),
        ),
        Method::VelocityVerlet => by(&VelocityVerlet, dynamics, task, observer),
        Method::ImplicitFriction => {
            let mut implicit = ImplicitDynamics::new(dynamics);
            let observer = &mut Through(observer);
            let (solution, mut choice) = by(&KENNEDY_CARPENTER, &mut implicit, task, observer)?;
            choice.implicit = solution.stats.accepted;
            Ok((solution, choice))
        }
        Method::Auto => choose(dynamics, task, observer),
    }
}

/// Integrates by one method.
fn by<S, M, O>(
    method: &M,
    system: &mut S,
    task: Task<'_>,
    observer: &mut O,
) -> Result<(Solution, Choice), Failure>
where
    S: System,
    M: integrate::Method<S>,
    O: Observer<S>,
{
    let Task {
        span,
        y0,
        tolerance,
        options,
    } = task;
    let tableau = method.tableau();
    let options = Options {
        controller: method.controller(),
        ..options.clone()
    };
    let choice = Choice {
        names: vec![tableau.name],
        ..Choice::default()
    };
    let solution = integrate(system, method, span, y0, tolerance, &options, observer)?;
    Ok((solution, choice))
}

/// Integrates explicitly or implicitly, as the stiffness quotient asks.
fn choose<'m, O: Observer<Dynamics<'m>>>(
    dynamics: &mut Dynamics<'m>,
    task: Task<'_>,
    observer: &mut O,
) -> Result<(Solution, Choice), Failure> {
    let model = dynamics.model();
    let step = task.options.max_step.min(1.0 / model.scales().frequency);
    let mut system = ImplicitDynamics::new(dynamics);
    let first = quotient(&mut system, task.span.0, task.y0, step);
    let mut watch = Watch {
        observer,
        step,
        implicit: first > SWITCH.0,
        switch: false,
        quotient: first,
        last: 0.0,
    };
    let mut choice = Choice {
        auto: true,
        ..Choice::default()
    };
    let mut options = task.options.clone();
    let mut whole: Option<Solution> = None;
    loop {
        let (t, y) = whole
            .as_ref()
            .map_or((task.span.0, task.y0), |s| (s.t, &s.y));
        let part = Task {
            span: (t, task.span.1),
            y0: y,
            options: &options,
            ..task
        };
        let (mut solution, done) = if watch.implicit {
            let part = Task {
                options: &implicit_options(&options, model),
                ..part
            };
            by(&KENNEDY_CARPENTER, &mut system, part, &mut watch)?
        } else {
            by(&DORMAND_PRINCE, &mut system, part, &mut watch)?
        };
        choice.names.extend(done.names);
        if watch.implicit {
            choice.implicit += solution.stats.accepted;
        }
        if let Some(before) = whole {
            let mut stats = before.stats;
            stats.merge(&solution.stats);
            solution.stats = stats;
        }
        if !watch.switch {
            choice.stiffness = Some(watch.quotient);
            return Ok((solution, choice));
        }
        watch.switch = false;
        watch.implicit = !watch.implicit;
        options.first_step = Some(watch.last);
        whole = Some(solution);
    }
}

/// The options for implicit steps, which have a cap of their own.
fn implicit_options(options: &Options, model: &Model) -> Options {
    let mut options = options.clone();
    if model.scene().solver.frequency_cap {
        let most = step_limit::largest(Method::ImplicitFriction, model);
        options.max_step = options.max_step.min(most);
    }
    options
}

/// Lets an observer of the right-hand side see implicit steps.
struct Through<'o, O>(&'o mut O);

impl<'m, O: Observer<Dynamics<'m>>> Observer<ImplicitDynamics<'_, 'm>> for Through<'_, O> {
    fn accepted(
        &mut self,
        system: &mut ImplicitDynamics<'_, 'm>,
        step: &DenseStep<'_>,
        stats: &Statistics,
    ) -> ControlFlow<()> {
        self.0.accepted(system.dynamics, step, stats)
    }
}

impl<'m, O: Observer<Dynamics<'m>>> Observer<Damped<'_, 'm>> for Through<'_, O> {
    fn accepted(
        &mut self,
        system: &mut Damped<'_, 'm>,
        step: &DenseStep<'_>,
        stats: &Statistics,
    ) -> ControlFlow<()> {
        self.0.accepted(system.dynamics, step, stats)
    }
}

/// Looks at the stiffness now and then, and ends the integration where the other method should go on.
struct Watch<'o, O> {
    observer: &'o mut O,
    step: f64,
    implicit: bool,
    switch: bool,
    /// Largest quotient so far.
    quotient: f64,
    /// Last step size.
    last: f64,
}

impl<'m, O: Observer<Dynamics<'m>>> Observer<ImplicitDynamics<'_, 'm>> for Watch<'_, O> {
    fn accepted(
        &mut self,
        system: &mut ImplicitDynamics<'_, 'm>,
        step: &DenseStep<'_>,
        stats: &Statistics,
    ) -> ControlFlow<()> {
        self.observer.accepted(system.dynamics, step, stats)?;
        if stats.accepted.is_multiple_of(LOOK_EVERY) {
            let quotient = quotient(system, step.t1(), step.y1(), self.step);
            self.quotient = self.quotient.max(quotient);
            self.last = step.h();
            self.switch = if self.implicit {
                quotient < SWITCH.1
            } else {
                quotient > SWITCH.0
            };
            if self.switch {
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }
}

/// Rate of friction times a step, over what Dormand–Prince bears.
fn quotient(system: &mut ImplicitDynamics<'_, '_>, t: f64, y: &[f64], step: f64) -> f64 {
    system.fastest_rate(t, y) * step / DORMAND_PRINCE.stability_limit
}
