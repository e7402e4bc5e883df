//! The oil films of rows that have a lubricant ([*Film*](crate::equations#film)).

use super::compile::classify;
use super::scales::Bottom;
use super::{BodyId, Dof, Model, Race};
use crate::base::error::{Error, Result};
use crate::contact::film::{self, Effects, Film, Oil, Reference};
use crate::contact::{Oiled, Pair};
use crate::scene::{Lubricant, Row};

impl Model {
    /// Whether any row has a lubricant that does something.
    pub(crate) fn is_lubricated(&self) -> bool {
        let rows = &self.scene.rows;
        rows.iter()
            .any(|row| self.scene.lubricant_of(row).is_some_and(Lubricant::acts))
    }

    /// Gives races their films, computed for loads of a contact by row and race \[N\].
    ///
    /// # Errors
    /// [`Error::Scene`] for a lubricant that is not usable.
    pub(crate) fn lubricate(&mut self, loads: &[[f64; 2]]) -> Result<()> {
        for (row, loads) in loads.iter().enumerate() {
            let geometry = self.scene.rows[row].clone();
            let Some(lubricant) = self.scene.lubricant_of(&geometry).filter(|of| of.acts()) else {
                continue;
            };
            let (lubricant, oil) = (lubricant.clone(), Oil::new(lubricant)?);
            self.rows[row].drag = drag(geometry.ball_diameter, oil.density, lubricant.fill);
            for race in Race::BOTH {
                self.check_profile(row, race, &lubricant)?;
                let films = self.films(row, race, &lubricant, &oil, loads[race]);
                let pair = &mut self.rows[row].pairs[race];
                let mut films = films.into_iter();
                pair.change_each(|flank| {
                    if let Some(oiled) = films.next() {
                        flank.lubricate(&oiled, lubricant.traction);
                    }
                });
            }
        }
        classify(&mut self.rows);
        Ok(())
    }

    /// Whether films change in a run: of a bearing whose rings do not keep one speed against each other.
    pub(crate) fn has_films_in_motion(&self) -> bool {
        let is_free = self.bodies[BodyId::OUTER].degrees[Dof::Theta].is_free();
        (is_free || !self.scene.turns_steadily()) && self.has_films()
    }

    /// Whether any contact has a film.
    pub(crate) fn has_films(&self) -> bool {
        let mut pairs = self.rows.iter().flat_map(|row| &row.pairs);
        pairs.any(|pair| pair.law.film.is_some())
    }

    /// Gives all films the state that they have at a speed of the rings against each other \[rad/s\].
    pub(crate) fn set_film_speed(&mut self, speed: f64) {
        for pair in self.rows.iter_mut().flat_map(|row| &mut row.pairs) {
            pair.change_each(|flank| flank.turn_film(speed));
        }
    }

    /// The film on a race through points is not built.
    fn check_profile(&self, row: usize, race: Race, lubricant: &Lubricant) -> Result<()> {
        let pair = &self.rows[row].pairs[race];
        if !lubricant.film || !pair.is_through_points() {
            return Ok(());
        }
        Err(Error::scene(
            format!("{}.film", self.scene.lubricant_path(row)),
            true,
            format!(
                "false, since the {} race of rows[{row}] is a curve through points, on which no film can lie",
                race.name()
            ),
        ))
    }

    /// The film of a race, and of the other flank of a gothic arch.
    fn films(
        &self,
        row: usize,
        race: Race,
        lubricant: &Lubricant,
        oil: &Oil,
        load: f64,
    ) -> Vec<Oiled> {
        let speed = self.scene.reference_speed_of(lubricant);
        let effects = Effects {
            film: lubricant.film,
            damping: lubricant.damping,
            traction: lubricant.traction,
            rolling: lubricant.rolling,
        };
        let of = |pair: &Pair| {
            let geometry = self.film_race(&self.scene.rows[row], race, pair.race.r);
            let load = load.max(geometry.least_load());
            let (approach, half_length) = self.reference_zone(row, pair, load);
            let reference = Reference {
                load,
                speed,
                half_length,
                approach,
            };
            let film = Film::new(oil, &geometry, reference, effects);
            Oiled::new(film, pair.race.r, self.scene.relative_speed(0.0))
        };
        self.rows[row].pairs[race].flanks().map(of).collect()
    }

    /// The geometry of a race's film.
    pub(crate) fn film_race(
        &self,
        row: &Row,
        race: Race,
        groove_radius: f64,
    ) -> film::LubricatedRace {
        let scene = &self.scene;
        let compliance = |material: &crate::scene::Material| {
            (1.0 - material.poisson_ratio.powi(2)) / material.youngs_modulus
        };
        let both = compliance(scene.ball_material_of(row)) + compliance(&scene.materials.rings);
        film::LubricatedRace {
            sigma: race.sigma(),
            ball_diameter: row.ball_diameter,
            pitch_diameter: row.pitch_diameter,
            groove_radius,
            contact_angle: row.contact_angle,
            reduced_modulus: 2.0 / both,
        }
    }

    /// Approach under a load \[N\] by the scene's own law, and half of the zone's length there \[m\].
    fn reference_zone(&self, row: usize, pair: &Pair, load: f64) -> (f64, f64) {
        let ball = &self.balls[self.rows[row].first].side;
        let at_bottom = || Bottom::new(pair, ball).approach(load);
        let approach = pair.law.elastic.approach(load).unwrap_or_else(at_bottom);
        (approach, pair.half_zone(ball.radius, approach))
    }
}

/// Drag of a ball over the square of its speed \[N s²/m²\], of a ball of a diameter \[m\] in so much oil of a density \[kg/m³\].
fn drag(diameter: f64, density: f64, fill: f64) -> f64 {
    /// C_d.
    const SPHERE: f64 = 0.5;
    0.125 * std::f64::consts::PI * density * fill * SPHERE * diameter * diameter
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Literature: full oil of a 6205 at 1797 1/min, whose balls go round at 3.0 m/s half as fast as the
    /// shaft's angle: 0.023 N.
    #[test]
    fn full_oil_holds_a_ball_back() {
        let speed = 0.5 * 188.18 * (1.0 - 7.94 / 39.04) * 39.04e-3 / 2.0;
        let force = drag(7.94e-3, 857.0, 1.0) * speed * speed;
        assert!((force / 0.023 - 1.0).abs() < 0.05, "{force}");
    }
}
