//! Whether anything drives the balls along their orbit, and what happens to the orbit where nothing does.
//!
//! Friction drives them. A cage only keeps the balls apart, and contacts without friction affect the orbit only by their
//! damping, which slows a ball a little whenever it enters or leaves the load zone: in a 6205 under 500 N by about a hundredth a
//! second.

use crate::model::{BodyId, Model, RowModel};

/// The report on a scene whose balls nothing drives; nothing where friction does.
pub(crate) fn note(model: &Model) -> Option<&'static str> {
    let scene = model.scene();
    loose_balls(model).next()?;
    Some(if scene.cage.is_some() {
        "nothing drives the balls' orbit: without friction it decays by the contacts' damping"
    } else {
        "nothing drives the balls' orbit or keeps the balls apart: without friction and cage it decays by the contacts' \
         damping, and the balls gather until a ring is held on one side only"
    })
}

/// Share of their orbit rate that balls which nothing drives have lost between two states of all bodies, against the outer ring and in
/// proportion to the speed of the inner against it; none where something drives them, or where they do not orbit.
pub(crate) fn slowed(model: &Model, from: &[f64], to: &[f64]) -> Option<f64> {
    note(model)?;
    let of = |y: &[f64], ring| model.layout().motion(y, ring).omega;
    let speed = |y: &[f64]| of(y, BodyId::INNER) - of(y, BodyId::OUTER);
    let rate = |y: &[f64]| rate(model, y) - of(y, BodyId::OUTER);
    let reference = if speed(from) == 0.0 {
        model.rolling_share() * speed(to)
    } else {
        rate(from) * speed(to) / speed(from)
    };
    (reference != 0.0).then(|| 1.0 - rate(to) / reference)
}

/// The balls that no friction drives, among those of all rows.
fn loose_balls(model: &Model) -> impl Iterator<Item = usize> + Clone {
    let rows = model.rows.iter().filter(|row| !row.has_friction());
    rows.flat_map(RowModel::balls)
}

/// Mean rate about the axis of the balls that no friction drives \[rad/s\].
fn rate(model: &Model, y: &[f64]) -> f64 {
    let of = |j: usize| model.layout().motion(y, BodyId::ball(j)).orbit_speed();
    let balls = loose_balls(model);
    balls.clone().map(of).sum::<f64>() / balls.count() as f64
}
