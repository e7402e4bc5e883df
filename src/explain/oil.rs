//! Oil of a scene, and its films.

use std::f64::consts::TAU;
use std::fmt;

use serde::Serialize;

use crate::base::error::Result;
use crate::base::quantities::number;
use crate::contact::film::Oil;
use crate::inspect::{RaceFilm, films};
use crate::model::{Model, Race};

/// 0 °C \[K\].
const CELSIUS: f64 = 273.15;

/// The oil of a row, and its films.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct OilExplanation {
    /// Row, from 0.
    pub row: usize,
    /// Name of the oil; absent: only a data sheet is given.
    pub oil: Option<String>,
    /// Temperature \[K\].
    pub temperature: f64,
    /// Kinematic viscosity there \[m²/s\].
    pub kinematic_viscosity: f64,
    /// Origin of the films' reference load: `given` or `equilibrium`.
    pub load_from: &'static str,
    /// Origin of the films' reference speed: `given` or `drive`.
    pub speed_from: &'static str,
    /// The films on the outer and on the inner race.
    pub films: Vec<RaceFilm>,
}

/// The explanations of all rows whose oil does something.
pub(super) fn of(model: &Model) -> Result<Vec<OilExplanation>> {
    let (scene, films) = (model.scene(), films(model));
    let mut found = Vec::new();
    for (row, geometry) in scene.rows.iter().enumerate() {
        let of_row: Vec<RaceFilm> = films
            .iter()
            .filter(|film| film.row == row)
            .cloned()
            .collect();
        let Some(lubricant) = scene.lubricant_of(geometry).filter(|_| !of_row.is_empty()) else {
            continue;
        };
        let from =
            |given: Option<f64>, else_from| if given.is_some() { "given" } else { else_from };
        found.push(OilExplanation {
            row,
            oil: lubricant.oil.clone(),
            temperature: lubricant.temperature,
            kinematic_viscosity: Oil::new(lubricant)?.kinematic_viscosity,
            load_from: from(lubricant.reference_load, "equilibrium"),
            speed_from: from(lubricant.reference_speed, "drive"),
            films: of_row,
        });
    }
    Ok(found)
}

impl fmt::Display for OilExplanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "row {}: {} at {} °C, {} mm²/s",
            self.row,
            self.oil.as_deref().unwrap_or("by its data sheet"),
            number(self.temperature - CELSIUS),
            number(1e6 * self.kinematic_viscosity)
        )?;
        for film in &self.films {
            write!(
                f,
                "\n    {} race: film {:.3} µm, at least {:.3}, λ {:.2}; friction {:.3} from slip of {} mm/s; for {:.0} N ({}) at {:.0} 1/min ({})",
                Race::from(film.race).name(),
                1e6 * film.film,
                1e6 * film.minimum_film,
                film.lambda_ratio,
                film.friction,
                number(1e3 * film.slip_scale),
                film.reference_load,
                self.load_from,
                film.reference_speed * 60.0 / TAU,
                self.speed_from
            )?;
        }
        Ok(())
    }
}
