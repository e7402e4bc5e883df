//! How a ball left its groove, in words.

use crate::contact::{Meridian, Torus};
use crate::dynamics::motion;
use crate::model::Model;
use crate::orbit;
use crate::told::length;

/// Which race a ball has left in a state of all bodies, which way and how far, and what may be to blame; `finer` says how the
/// run is made more accurate.
pub(crate) fn reason(model: &Model, y: &[f64], body: usize, finer: &str) -> String {
    let ball = &model.balls[body - 2];
    let radius = ball.side.radius;
    let at = motion(y, body);
    let races = model.rows[ball.row].pairs.each_ref().map(|pair| pair.race);
    let ways = [0, 1].map(|ring| {
        let ring_at = motion(y, ring);
        let distance = (at.centre - ring_at.centre).norm();
        races[ring].meridian(distance, at.z - ring_at.z, 0.0)
    });
    let beyond = |ring: usize| ways[ring].distance() - races[ring].farthest(radius);
    let ring = usize::from(beyond(1) > beyond(0));
    let how = way(&races[ring], &ways[ring], radius);
    let advice = if orbit::note(model).is_some() && model.scene().cage.is_none() {
        "nothing keeps the balls apart: give the scene a cage".to_owned()
    } else {
        format!("check loads, clearance and shoulders, or {finer}")
    };
    let race = ["outer", "inner"][ring];
    format!("the ball has left its groove: it is {how} the {race} race; {advice}")
}

/// Pressed into a race, beside its groove or off it, whichever it is most.
fn way(race: &Torus, meridian: &Meridian, radius: f64) -> String {
    let (e, c) = (meridian.e, meridian.c.abs());
    if c >= e.abs() {
        format!("{} beside the middle of", length(c))
    } else if e > 0.0 {
        format!("pressed {} into", length(meridian.approach(radius)))
    } else {
        format!("{} off", length(race.r - radius - e))
    }
}
