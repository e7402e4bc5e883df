//! Rotations about x and y, where they do not occur.

use super::course::Course;
use super::{Obstacle, Omission, Prescribed, Reduction, symmetry};
use crate::model::{Dof, Model};

impl Reduction {
    /// The reduction of rings that may tilt and balls that may spin freely, and do not, since the motion is its own mirror image: that is then left
    /// out with all that moves along z, rings are those that stay parallel and balls spin about the axis. Else all states are
    /// integrated, and the obstacles are reported.
    ///
    /// # Errors
    /// What stands against it.
    pub(crate) fn in_space(model: &Model, t: f64, start: &[f64]) -> Result<Self, Vec<Obstacle>> {
        let mut found = Self::leaving_out(model, t, start);
        // Balls of two rows that are images of each other may spin differently.
        let is_flat = found.plane || found.mirrored && !model.balls_turn();
        let against = against(model, start, found.mirrored);
        if !is_flat || !against.is_empty() {
            return Err(against.into_iter().chain(found.obstacles).collect());
        }
        let before = found.prescribed.len();
        for (body, dof) in model.layout().degrees() {
            if !Dof::ALL.contains(&dof) {
                let course = Course::steady(0.0, 0.0, 0.0);
                found.prescribed.push(Prescribed { body, dof, course });
            }
        }
        found.omissions.push(Omission {
            what: "turning about x and y".to_owned(),
            degrees: found.prescribed.len() - before,
            reason: "mirror symmetry".to_owned(),
        });
        Ok(found)
    }
}

/// Obstacles: what may turn about x or y in a motion that is its own mirror image but for that.
fn against(model: &Model, start: &[f64], mirrored: bool) -> Vec<Obstacle> {
    let mut found = Vec::new();
    let mut look = |what: &str, looked: Result<(), String>| {
        let what = what.to_owned();
        found.extend(looked.err().map(|reason| Obstacle { what, reason }));
    };
    if model.tilts() {
        let looked = symmetry::of_tilts(model, start, mirrored);
        look("rings that do not tilt", looked);
    }
    if model.balls_turn() {
        let looked = symmetry::of_turns(model, start);
        look("balls that spin about the axis", looked);
    }
    found
}
