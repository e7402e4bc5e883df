//! Errors of runs that ended early.

use super::escape::{self, FINER};
use crate::base::error::Error;
use crate::inspect::{StiffElement, stiffest};
use crate::integrate::{Failure, FailureKind};
use crate::model::{BodyId, Model};

const CRAWLING: &str = "the step has collapsed to less than 1e-5 of the contacts' period and stays there; \
                        raise slip_speed, lower the damping, or soften the contacts";

/// Why a run ends though the integrator could go on.
pub(crate) enum Halt {
    /// A ball, by its number among all balls, is where its groove does not hold it.
    Escaped(usize),
    /// A ball, likewise, that is no longer in its pocket.
    OutOfPocket(usize),
    /// A body does what no bearing does.
    RanAway(BodyId, String),
    /// The step is too small to wait for.
    Crawls,
}

impl Halt {
    /// The error in the last state of all bodies, at a time and after a step \[s\].
    pub fn error(&self, model: &Model, last: &[f64], time: f64, step: f64) -> Error {
        let (body, reason) = match self {
            Self::Escaped(ball) => (
                Some(BodyId::ball(*ball)),
                escape::reason(model, last, *ball),
            ),
            Self::OutOfPocket(ball) => (
                Some(BodyId::ball(*ball)),
                format!(
                    "the ball has left its pocket in the cage; check cage.ring.pocket_clearance and cage.ring.stiffness, or {FINER}"
                ),
            ),
            Self::RanAway(body, does) => {
                let advice = format!("check loads, drive and supports, or {FINER}");
                (
                    Some(*body),
                    format!("the body {does}, which no bearing does; {advice}"),
                )
            }
            Self::Crawls => (None, CRAWLING.to_owned()),
        };
        stopped(model, last, time, step, body, &reason)
    }
}

/// The error of an integration that could not go on from its last state; its clock was 0 at `begins` \[s\].
pub(crate) fn broken(model: &Model, last: &[f64], begins: f64, failure: &Failure) -> Error {
    let reason = match failure.kind {
        FailureKind::NonFinite => {
            "a force is not finite; check masses, stiffnesses and loads".to_owned()
        }
        FailureKind::TooSmall => "the step fell below the resolution of time; soften contacts, raise slip_speed or rtol, \
                                  or try another method"
            .to_owned(),
        FailureKind::Invalid(invalid) => invalid.0.to_owned(),
    };
    let time = begins + failure.time;
    let body = Some(BodyId::new(failure.group));
    stopped(model, last, time, failure.step, body, &reason)
}

/// The error with what held up the run in its last state: a body's contacts, or the fastest of all.
fn stopped(
    model: &Model,
    last: &[f64],
    time: f64,
    step: f64,
    body: Option<BodyId>,
    reason: &str,
) -> Error {
    let found = stiffest(model, last, body);
    let listed: Vec<String> = found.iter().map(ToString::to_string).collect();
    let body = body.or(found.first().map(|first| first.body));
    Error::Integration {
        time,
        step,
        body: model.bodies[body.unwrap_or_default()].name.clone(),
        reason: if listed.is_empty() {
            format!("{reason} (no contact touches)")
        } else {
            format!("{reason}. Fastest: {}", listed.join(", "))
        },
        contacts: found
            .into_iter()
            .map(|element: StiffElement| element.name)
            .collect(),
    }
}
