//! Text of the error of a ball that left its groove.

use super::orbit;
use crate::base::quantities::length;
use crate::contact::{Section, Torus};
use crate::model::{Model, Race};

/// How a run is made more accurate.
pub(super) const FINER: &str = "use a smaller rtol";

/// Reason of an escape: the race that a ball has left in a state of all bodies, which way and how far, and the possible cause.
pub(crate) fn reason(model: &Model, y: &[f64], j: usize) -> String {
    let ball = &model.balls[j];
    let radius = ball.side.radius;
    let races = model.rows[ball.row].pairs.each_ref().map(|pair| pair.race);
    let ways = Race::BOTH.map(|race| {
        let [at, ring] = model.facing(y, j, race);
        let seen = at.seen_from(&ring);
        races[race].section(radius, seen.centre.norm(), seen.z, 0.0)
    });
    let beyond = |race: Race| ways[race].l - races[race].farthest(radius);
    let race = if beyond(Race::Inner) > beyond(Race::Outer) {
        Race::Inner
    } else {
        Race::Outer
    };
    let how = way(&races[race], &ways[race]);
    let advice = if orbit::note(model).is_some() && model.scene().cage.is_none() {
        "nothing keeps the balls apart: give the scene a cage".to_owned()
    } else {
        format!("check loads, clearance and shoulders, or {FINER}")
    };
    let race = race.name();
    format!("the ball has left its groove: it is {how} the {race} race; {advice}")
}

/// Pressed into a race, beside its groove or off it, whichever it is most.
fn way(race: &Torus, section: &Section<f64>) -> String {
    let (e, c) = (section.e, section.c.abs());
    if c >= e.abs() {
        format!("{} beside the middle of", length(c))
    } else if e > 0.0 {
        format!("pressed {} into", length(section.approach))
    } else {
        format!("{} off", length(race.r - section.radius - e))
    }
}
