//! Whether anything drives the balls along their orbit, and what becomes of it where nothing does.
//!
//! Friction does. A cage only keeps the balls apart, and contacts without friction take no part in the orbit but by their
//! damping, which slows a ball a little whenever it enters or leaves the load zone: of a 6205 under 500 N about a hundredth a
//! second.

use crate::model::{BodyId, Model};

/// What is told of a scene whose balls nothing drives; nothing where friction does, or where the orbit is given.
pub(crate) fn note(model: &Model) -> Option<&'static str> {
    let scene = model.scene();
    let is_driven = model.rows[0].pairs[0].friction.is_some();
    let is_given = scene.approximations.rolling;
    if is_driven || is_given {
        return None;
    }
    Some(if scene.cage.is_some() {
        "nothing drives the balls' orbit: without friction it decays by the contacts' damping"
    } else {
        "nothing drives the balls' orbit or keeps the balls apart: without friction and cage it decays by the contacts' \
         damping, and the balls gather until a ring is held on one side only"
    })
}

/// Share of their orbit rate that balls which nothing drives have lost between two states of all bodies, in proportion to
/// the speed of the inner ring; none where something drives them, or where they do not orbit.
pub(crate) fn slowed(model: &Model, from: &[f64], to: &[f64]) -> Option<f64> {
    note(model)?;
    let speed = |y: &[f64]| model.layout().motion(y, BodyId::INNER).omega;
    let reference = if speed(from) == 0.0 {
        model.rolling_share() * speed(to)
    } else {
        rate(model, from) * speed(to) / speed(from)
    };
    (reference != 0.0).then(|| 1.0 - rate(model, to) / reference)
}

/// Mean rate of the balls about the axis \[rad/s\].
fn rate(model: &Model, y: &[f64]) -> f64 {
    let of = |j: usize| {
        let ball = model.layout().motion(y, BodyId::ball(j));
        crate::contact::cross(ball.centre, ball.velocity) / ball.centre.norm_squared()
    };
    let count = model.balls.len();
    (0..count).map(of).sum::<f64>() / count as f64
}
