//! The loads that films are computed for: those of the equilibrium without films.

use super::positions;
use crate::base::error::{Error, Result};
use crate::inspect;
use crate::model::{Model, Race};
use crate::scene::Lubricant;

/// Gives a model whose scene has a lubricant its films.
///
/// # Errors
/// [`Error::Scene`] where there is no equilibrium and the lubricant gives no reference load.
pub(super) fn lubricated(mut model: Model) -> Result<Model> {
    if !model.is_lubricated() {
        return Ok(model);
    }
    let rows = &model.scene.rows;
    let given = |row: &_| {
        model
            .scene
            .lubricant_of(row)
            .and_then(|of: &Lubricant| of.reference_load)
    };
    let given: Vec<Option<f64>> = rows.iter().map(given).collect();
    let absent = given.iter().position(Option::is_none);
    let solved = match absent {
        None => None,
        Some(row) => {
            let path = model.scene.lubricant_path(row);
            Some(positions(&model).map_err(|error| needs_load(&path, error))?)
        }
    };
    let loads: Vec<[f64; 2]> = given
        .iter()
        .enumerate()
        .map(|(row, given)| match (given, &solved) {
            (Some(load), _) => [*load; 2],
            (None, Some(y)) => Race::BOTH.map(|race| weighted_load(&model, y, row, race)),
            (None, None) => [0.0; 2],
        })
        .collect();
    model.lubricate(&alike(loads))?;
    Ok(model)
}

/// The loads, those that differ by no more than what an equilibrium leaves as one: rows that are images of each other then have one film.
fn alike(mut loads: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    /// Share of a load; films go like its fifteenth root.
    const LEFT: f64 = 1e-6;
    for row in 1..loads.len() {
        for race in Race::BOTH {
            let load = loads[row][race];
            let same = |of: &f64| (of - load).abs() <= LEFT * load;
            let known = loads[..row].iter().map(|of| of[race]).find(same);
            loads[row][race] = known.unwrap_or(load);
        }
    }
    loads
}

/// ΣQ²/ΣQ over a row's contacts with a race (12.7) \[N\].
fn weighted_load(model: &Model, y: &[f64], row: usize, race: Race) -> f64 {
    let (mut sum, mut squares) = (0.0, 0.0);
    for ball in model.rows[row].balls() {
        let load = inspect::contact(model, y, ball, race).load;
        sum += load;
        squares += load * load;
    }
    if sum > 0.0 { squares / sum } else { 0.0 }
}

/// Where there is no equilibrium, and the lubricant of a path needs one.
fn needs_load(path: &str, error: Error) -> Error {
    match error {
        Error::Interrupted { .. } => error,
        other => Error::scene(
            format!("{path}.reference_load"),
            "absent",
            format!(
                "given [N], since the film cannot be computed for the loads of the equilibrium: {other}"
            ),
        ),
    }
}
