//! Why a run ended before its time, in the words of its error.

use crate::collapse::culprits;
use crate::error::Error;
use crate::integrate::{Failure, FailureKind};
use crate::method;
use crate::model::Model;
use crate::step_limit;

/// The step is too small to wait for.
pub(crate) const CRAWLING: &str = "the step has collapsed to less than 1e-5 of the contacts' period and stays there; \
                        raise slip_speed, lower the damping, or soften the contacts";

/// A ball is where its groove does not hold it.
pub(crate) fn escaped(model: &Model, step: f64) -> String {
    let finer = finer(model, step);
    format!("the ball has left its groove; check loads, clearance and shoulders, or {finer}")
}

/// A body does what no bearing does.
pub(crate) fn ran_away(model: &Model, does: &str, step: f64) -> String {
    let finer = finer(model, step);
    format!("the body {does}, which no bearing does; check loads, drive and supports, or {finer}")
}

/// How a run is made more accurate: the one thing that a method of fixed steps has is its step.
fn finer(model: &Model, step: f64) -> String {
    let method = model.scene.solver.method;
    if !method::is_fixed(method) {
        return "use a smaller rtol".to_owned();
    }
    let limit = step_limit::largest(method, &model.scales);
    let bears = if step > limit {
        format!(", stability asks for at most {limit:.1e} s")
    } else {
        String::new()
    };
    format!("use a smaller max_step (the step was {step:.1e} s{bears})")
}

/// The error of an integration that could not go on from its last state; its clock was 0 at `begins` \[s\].
pub(crate) fn broken(model: &Model, last: &[f64], begins: f64, failure: &Failure) -> Error {
    let reason = match failure.kind {
        FailureKind::NonFinite => {
            let what = "a force is not finite; check masses, stiffnesses and loads";
            if method::is_fixed(model.scene.solver.method) {
                format!("{what}, or {}", finer(model, failure.step))
            } else {
                what.to_owned()
            }
        }
        FailureKind::TooSmall => "the step fell below the resolution of time; soften contacts, raise slip_speed or rtol, \
                                  or try another method"
            .to_owned(),
        FailureKind::Invalid(invalid) => invalid.0.to_owned(),
    };
    let when = (begins + failure.time, failure.step);
    stopped(model, last, when, Some(failure.group), &reason)
}

/// The error with what held up the run in its last state: a body's contacts, or the fastest of all.
pub(crate) fn stopped(
    model: &Model,
    last: &[f64],
    (time, step): (f64, f64),
    body: Option<usize>,
    reason: &str,
) -> Error {
    let found = culprits(model, last, body);
    let listed: Vec<String> = found.iter().map(ToString::to_string).collect();
    let body = body.or(found.first().map(|first| first.body)).unwrap_or(0);
    Error::Integration {
        time,
        step,
        body: model.bodies[body].name.clone(),
        reason: if listed.is_empty() {
            format!("{reason} (no contact touches)")
        } else {
            format!("{reason}. Fastest: {}", listed.join(", "))
        },
        contacts: found.into_iter().map(|culprit| culprit.name).collect(),
    }
}
