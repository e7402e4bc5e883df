//! Notes on rotation about x and y: where a run includes it, and where it leaves it out though it matters in the bearing.

use crate::base::quantities::number;
use crate::inspect;
use crate::model::{Model, Race};

/// Least moment that is reported, over the largest load at half the pitch diameter.
const MOMENT: f64 = 0.01;
/// Contact angle from which pivoting is reported \[rad\]: 3°.
const ANGLE: f64 = 0.05;

/// Notes on a model and its start; `reduced` says whether turning is left out of the run.
pub(super) fn notes(model: &Model, y0: &[f64], reduced: bool) -> Vec<String> {
    let mut found = Vec::new();
    if model.tilts() && !reduced {
        let note = "a ring may tilt: contacts are evaluated in the frames of their rings, and nothing is left out";
        found.push(note.to_owned());
    }
    if model.balls_turn() && !reduced {
        let note = "balls spin about any axis, each with two more states, and nothing is left out";
        found.push(note.to_owned());
    }
    found.extend(held_parallel(model, y0).filter(|_| !model.tilts()));
    found.extend(pivoting(model, y0).filter(|_| !model.balls_turn()));
    found
}

/// Rings that are held parallel against a moment.
fn held_parallel(model: &Model, y0: &[f64]) -> Option<String> {
    let moments = inspect::raw::moments(model, 0.0, y0);
    let largest = moments.iter().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max);
    let arm = model.radius(Race::Inner.ring());
    let load: f64 = model.scales.load;
    (largest > MOMENT * load * arm).then(|| {
        format!(
            "rings are held parallel against moments up to {} N m; a mount in inner_ring.support.tilt_x and tilt_y lets one tilt",
            number(largest)
        )
    })
}

/// Balls that spin about the axis, with contacts at an angle.
fn pivoting(model: &Model, y0: &[f64]) -> Option<String> {
    let balls = 0..model.balls.len();
    let rubs = |j: &usize| model.rows[model.balls[*j].row].has_friction();
    let angles = balls
        .filter(rubs)
        .map(|j| inspect::raw::contact(model, y0, j, Race::Inner).angle.abs());
    // Not a number without load, which max passes over.
    let largest = angles.fold(0.0, f64::max);
    (largest > ANGLE).then(|| {
        format!(
            "balls spin about the axis and pivot in contacts at an angle, here up to {:.0}°: friction torque is several times too \
             high; spin = \"free\" lets them roll",
            largest.to_degrees()
        )
    })
}
