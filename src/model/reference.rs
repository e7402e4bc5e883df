//! Waves and films follow contact loads: those that a scene gives, else those at the equilibrium of round races without oil.

use super::Model;
use super::at_rest::{AtRest, RaceLoads};
use crate::base::error::{Error, Result};
use crate::scene::Row;

/// Whether a row needs a load.
#[derive(Clone, Copy, PartialEq)]
enum Need {
    Nothing,
    /// A load that the film gives \[N\].
    Given(f64),
    /// The load of the row's equilibrium.
    Equilibrium,
}

impl Need {
    /// The reference of a row that may give a load.
    fn unless(given: Option<f64>) -> Self {
        given.map_or(Self::Equilibrium, Self::Given)
    }
}

/// Loads that rows need, and which of them do.
struct Needs<'a> {
    what: &'a str,
    rows: Vec<Need>,
    path: &'a dyn Fn(usize) -> String,
}

/// Gives a model the waves and the films of its scene.
///
/// # Errors
/// [`Error::Scene`] where there is no equilibrium and a lubricant or a texture gives no reference load.
pub(super) fn finished(mut model: Model, rest: &dyn AtRest) -> Result<Model> {
    let scene = model.scene.clone();
    let rows = |of: &dyn Fn(&Row) -> Need| scene.rows.iter().map(of).collect();
    let texture = |row: &Row| row.texture.as_ref().and_then(|of| of.reference_load);
    let waves = Needs {
        what: "the width of contacts",
        rows: rows(&|row| {
            if row.is_wavy() {
                Need::unless(texture(row))
            } else {
                Need::Nothing
            }
        }),
        path: &|row| format!("rows[{row}].texture"),
    };
    let film = |row: &Row| {
        let lubricant = scene.lubricant_of(row).filter(|of| of.acts());
        lubricant.map_or(Need::Nothing, |of| Need::unless(of.reference_load))
    };
    let films = Needs {
        what: "the film",
        rows: rows(&film),
        path: &|row| scene.lubricant_path(row),
    };
    let solved = if waves.asks() || films.asks() {
        rest.loads(&model)
    } else {
        Ok(Vec::new())
    };
    if waves.are_any() {
        let loads = match &solved {
            // Listed waves take the typical load.
            Err(Error::Equilibrium { .. })
                if scene.rows.iter().all(|row| row.texture.is_none()) =>
            {
                vec![[model.scales.load; 2]; scene.rows.len()]
            }
            _ => waves.loads(&solved)?,
        };
        model.give_waves(&loads)?;
    }
    if films.are_any() {
        model.lubricate(&films.loads(&solved)?)?;
    }
    Ok(model)
}

impl Needs<'_> {
    /// Whether any row needs a load.
    fn are_any(&self) -> bool {
        self.rows.iter().any(|need| *need != Need::Nothing)
    }

    /// Whether any row needs one that it does not give.
    fn asks(&self) -> bool {
        self.rows.contains(&Need::Equilibrium)
    }

    /// The loads that are given, and else those of the equilibrium.
    fn loads(&self, solved: &Result<RaceLoads>) -> Result<RaceLoads> {
        let of_row = |(row, need): (usize, &Need)| match (need, solved) {
            (Need::Nothing, _) => Ok([0.0; 2]),
            (Need::Given(load), _) => Ok([*load; 2]),
            (Need::Equilibrium, Ok(loads)) => Ok(loads[row]),
            (Need::Equilibrium, Err(interrupted @ Error::Interrupted { .. })) => {
                Err(interrupted.clone())
            }
            (Need::Equilibrium, Err(error)) => Err(Error::scene(
                format!("{}.reference_load", (self.path)(row)),
                "absent",
                format!(
                    "a load [N], since {} cannot be computed for the loads of the equilibrium: {error}",
                    self.what
                ),
            )),
        };
        self.rows.iter().enumerate().map(of_row).collect()
    }
}
