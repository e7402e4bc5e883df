//! Approximations by request: what scene and start must fulfil.

use super::AxialPlaces;
use crate::inspect;
use crate::model::{BodyId, Dof, Model, Race};
use crate::scene::TimeFunction;

/// Share of the load up to which a row counts as unloaded.
const IDLE: f64 = 0.02;

/// Axial places that rings and rows keep: those of the start, a row's balls in the mean of what they carry.
pub(super) fn axial_places(model: &Model, start: &[f64]) -> Result<AxialPlaces, String> {
    steady(model, |direction| direction[2] != 0.0)?;
    let z = |body: BodyId| start[model.layout().at(body, Dof::Z)];
    let rows = model.rows.iter().map(|row| {
        let (mut sum, mut all, mut mean) = (0.0, 0.0, 0.0);
        for j in row.balls() {
            let [outer, inner] =
                Race::BOTH.map(|race| inspect::raw::contact(model, start, j, race).load);
            let load = outer.min(inner);
            let z = z(BodyId::ball(j));
            sum += load * z;
            all += load;
            mean += z / row.count as f64;
        }
        if all > 0.0 { sum / all } else { mean }
    });
    Ok(AxialPlaces {
        rows: rows.collect(),
        rings: Race::BOTH.map(|race| z(race.ring())),
    })
}

/// The unloaded one of two rows.
pub(super) fn idle_row(model: &Model, start: &[f64]) -> Result<usize, String> {
    steady(model, |_| true)?;
    let loads: Vec<f64> = model
        .rows
        .iter()
        .map(|row| {
            let load = |j| inspect::raw::contact(model, start, j, Race::Inner).load;
            row.balls().map(load).sum()
        })
        .collect();
    let row = usize::from(loads[1] < loads[0]);
    let share = loads[row] / (loads[0] + loads[1]).max(f64::MIN_POSITIVE);
    if share <= IDLE {
        Ok(row)
    } else {
        Err(format!(
            "row {row} carries {:.0} % of the load, more than {:.0} %",
            100.0 * share,
            100.0 * IDLE
        ))
    }
}

/// Loads of some directions must not change.
fn steady(model: &Model, matters: impl Fn(&[f64; 3]) -> bool) -> Result<(), String> {
    for ((name, _), load) in model.scene.loads.iter().zip(&model.loads) {
        if matters(&load.direction) && !matches!(load.force, TimeFunction::Constant(_)) {
            return Err(format!("load {name:?} changes in time"));
        }
    }
    Ok(())
}
