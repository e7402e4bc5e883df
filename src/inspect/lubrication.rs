//! Films and losses of a row's oil in a state.

use serde::{Deserialize, Serialize};

use crate::base::nulls;

use super::powers::ContactPowers;
use crate::contact::film::FilmNow;
use crate::contact::{ContactForce, OilForce, PointForce, Sink, WrenchSum};
use crate::forces;
use crate::model::{Dof, Model, Race};

/// Films and losses of a row: `[outer, inner]` race.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Lubrication {
    /// Central films h \[m\]; not a number without an oil that does something.
    #[serde(deserialize_with = "nulls::pair")]
    pub film: [f64; 2],
    /// λ, the films over the roughness; likewise.
    #[serde(deserialize_with = "nulls::pair")]
    pub lambda: [f64; 2],
    /// Moment that resists the inner ring's turning against the outer, positive whichever way it turns \[N m\].
    pub friction_torque: f64,
    /// Power lost to slip \[W\].
    pub slip_power: f64,
    /// Power lost to rolling resistance \[W\].
    pub rolling_power: f64,
    /// Power lost to damping \[W\].
    pub damping_power: f64,
    /// Power that oil in the balls' way takes out of them \[W\].
    pub drag_power: f64,
}

impl Lubrication {
    /// Names and units of the values.
    pub const LABELS: [(&str, &str); 9] = [
        ("outer.film", "m"),
        ("inner.film", "m"),
        ("outer.lambda", "1"),
        ("inner.lambda", "1"),
        ("friction_torque", "N m"),
        ("slip_power", "W"),
        ("rolling_power", "W"),
        ("damping_power", "W"),
        ("drag_power", "W"),
    ];

    /// The values, in the order of [`Self::LABELS`].
    pub fn values(&self) -> [f64; 9] {
        let ([outer, inner], lambda) = (self.film, self.lambda);
        [
            outer,
            inner,
            lambda[0],
            lambda[1],
            self.friction_torque,
            self.slip_power,
            self.rolling_power,
            self.damping_power,
            self.drag_power,
        ]
    }
}

/// Moment of a row's contacts on a ring, and power that they lose.
#[derive(Default)]
struct Resistance {
    on_ball: WrenchSum,
    /// Moment on the ring about its axis, of contacts before this \[N m\].
    moment: f64,
    powers: ContactPowers,
}

impl Sink for Resistance {
    fn force(&mut self, force: &ContactForce) {
        self.on_ball.force(force);
        self.powers.force(force);
    }

    fn point(&mut self, force: &PointForce) {
        self.on_ball.point(force);
    }

    fn oil(&mut self, oil: &OilForce) {
        self.on_ball.oil(oil);
        self.powers.oil(oil);
    }
}

/// Films and losses of a row in a state.
pub(crate) fn lubrication(model: &Model, y: &[f64], row: usize) -> Lubrication {
    let layout = model.layout();
    let speed = |race: Race| y[layout.speed_at(race.ring(), Dof::Theta)];
    let speed = speed(Race::Inner) - speed(Race::Outer);
    let films = Race::BOTH.map(|race| film(model, row, race, speed));
    let [outer, inner] = Race::BOTH.map(|race| resistance(model, y, row, race));
    let lost = |of: fn(&ContactPowers) -> f64| of(&outer.powers) + of(&inner.powers);
    let or_none = |of: fn(&FilmNow) -> f64| films.map(|now| now.as_ref().map_or(f64::NAN, of));
    Lubrication {
        film: or_none(FilmNow::central),
        lambda: or_none(FilmNow::lambda),
        friction_torque: -inner.moment * speed.signum(),
        slip_power: lost(|of| of.slip),
        rolling_power: lost(|of| of.rolling),
        damping_power: lost(|of| of.damping),
        drag_power: forces::drag::power(model, y, row),
    }
}

/// The film of a race while the rings turn at a speed against each other \[rad/s\].
fn film(model: &Model, row: usize, race: Race, speed: f64) -> Option<FilmNow> {
    let film = model.rows[row].pairs[race].law.film?.film;
    Some(film.at(speed / film.reference().speed))
}

/// Resistance of all balls of a row on a ring.
fn resistance(model: &Model, y: &[f64], row: usize, race: Race) -> Resistance {
    let row = &model.rows[row];
    let mut sum = Resistance::default();
    for j in row.balls() {
        let [at, ring] = model.facing(y, j, race);
        sum.on_ball = WrenchSum::default();
        row.pairs[race].evaluate(&model.balls[j].side, &at, &ring, &mut sum);
        let place = at.seen_from(&ring).place();
        sum.moment += sum.on_ball.wrench.on_ring(&place).moment.z;
    }
    sum
}
