//! The films of a scene's oil, at their reference load and speed.

use serde::{Deserialize, Serialize};

use crate::base::nulls;

use crate::model::{Model, Race};
use crate::scene::{Doubt, FilmJudged, RingName};

/// The film between a row's balls and one race, at its reference load and speed; with a steady drive that of a whole run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct RaceFilm {
    /// Row, from 0.
    pub row: usize,
    /// The race.
    pub race: RingName,
    /// Thickness h in the middle of a contact \[m\].
    pub film: f64,
    /// Least thickness, 0.8 h \[m\].
    pub minimum_film: f64,
    /// λ, h over the roughness of both surfaces.
    #[serde(deserialize_with = "nulls::number")]
    pub lambda_ratio: f64,
    /// Friction coefficient μ at large slip.
    #[serde(deserialize_with = "nulls::number")]
    pub friction: f64,
    /// Slip v at which friction bends from its rise to μ \[m/s\].
    #[serde(deserialize_with = "nulls::number")]
    pub slip_scale: f64,
    /// Load of a contact \[N\].
    pub reference_load: f64,
    /// Speed of the rings against each other \[rad/s\].
    pub reference_speed: f64,
    /// The ellipse's length over its width, a/b.
    #[serde(deserialize_with = "nulls::number")]
    pub ellipticity: f64,
    /// Moes' L.
    #[serde(deserialize_with = "nulls::number")]
    pub moes: f64,
    /// Whether the film damps.
    #[serde(skip)]
    damps: bool,
    /// Largest Hertz pressure under the reference load \[Pa\].
    pub pressure: f64,
}

impl RaceFilm {
    fn doubts(&self, is_crushed: bool) -> Vec<Doubt> {
        let race = Race::from(self.race).name();
        let judged = FilmJudged {
            ellipticity: self.ellipticity,
            moes: self.damps.then_some(self.moes),
            lambda: self.lambda_ratio,
            pressure: (!is_crushed).then_some(self.pressure),
        };
        Doubt::film(&format!("row {}, {race} film", self.row), &judged)
    }
}

/// The films of all rows that have an oil, outer race first.
pub fn films(model: &Model) -> Vec<RaceFilm> {
    let rows = 0..model.rows.len();
    let races = rows.flat_map(|row| Race::BOTH.map(|race| (row, race)));
    races
        .filter_map(|(row, race)| film(model, row, race))
        .collect()
}

fn film(model: &Model, row: usize, race: Race) -> Option<RaceFilm> {
    let film = model.rows[row].pairs[race].law.film?.film;
    let (now, reference, limits) = (film.at(1.0), film.reference(), film.limits());
    Some(RaceFilm {
        row,
        race: race.into(),
        film: now.central(),
        minimum_film: now.minimum(),
        lambda_ratio: now.lambda(),
        friction: now.friction(),
        slip_scale: now.slip_scale(1.0),
        reference_load: reference.load,
        reference_speed: reference.speed,
        ellipticity: limits.ellipticity,
        moes: limits.moes,
        damps: film.effects().damping,
        pressure: limits.pressure,
    })
}

/// Doubts about contacts of a largest Hertz pressure \[Pa\] and about their films. A pressure that no steel bears is not
/// reported once more as one outside the range of the formulas of films.
pub(crate) fn doubts(largest_pressure: f64, films: &[RaceFilm]) -> Vec<Doubt> {
    let mut found: Vec<Doubt> = Doubt::pressure(largest_pressure).into_iter().collect();
    let is_crushed = !found.is_empty();
    found.extend(films.iter().flat_map(|film| film.doubts(is_crushed)));
    found
}
