//! Films of one contact: reference values and what must hold.

mod limits;
mod reference;

use std::f64::consts::TAU;

use super::conjunction::Conjunction;
use super::{Effects, Film, FilmNow, LubricatedRace, Oil, Reference};
use crate::contact::laws::elastic::hertz::Hertz;
use crate::scene::Lubricant;

/// E' of steel \[Pa\].
const MODULUS: f64 = 206e9 / 0.91;
/// 1797 1/min \[rad/s\].
const SPEED: f64 = 1797.0 / 60.0 * TAU;

/// VG 68 at a temperature in °C.
fn vg68(celsius: f64) -> Oil {
    Oil::new(&Lubricant::named("vg68", celsius + 273.15)).unwrap()
}

/// Outer or inner race of the 6205.
fn race(sigma: f64) -> LubricatedRace {
    let conformity = if sigma > 0.0 { 0.525 } else { 0.515 };
    LubricatedRace {
        sigma,
        ball_diameter: 7.94e-3,
        pitch_diameter: 39.04e-3,
        groove_radius: conformity * 7.94e-3,
        contact_angle: 0.0,
        reduced_modulus: MODULUS,
    }
}

fn hertz(race: &LubricatedRace) -> Hertz {
    let at = Conjunction::new(race, 1.0, 1.0);
    let [along, across] = at.radii.map(f64::recip);
    Hertz::of_curvatures(along, across, 0.5 * race.reduced_modulus)
}

/// Reference of Hertz's law at a load \[N\] and a speed \[rad/s\].
fn reference(race: &LubricatedRace, load: f64, speed: f64) -> Reference {
    let hertz = hertz(race);
    Reference {
        load,
        speed,
        half_length: hertz.half_length * load.cbrt(),
        approach: hertz.approach(load),
    }
}

fn film_of(oil: &Oil) -> Film {
    let race = race(1.0);
    Film::new(oil, &race, reference(&race, 250.0, SPEED), Effects::ALL)
}

/// The reference contact: outer race, VG 68, 55 °C, 250 N, 1797 1/min.
fn film() -> Film {
    film_of(&vg68(55.0))
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    let off = (found / expected - 1.0).abs();
    assert!(off <= tolerance, "{found:e}, not {expected:e}: {off:.1e}");
}

/// F_R over the entrainment speed \[N s/m\].
fn rolling(now: &FilmNow, r: f64) -> f64 {
    now.rolling_parts(r).iter().sum()
}

/// v, α_f and F_R at u = ũ.
fn answers(now: &FilmNow, r: f64) -> [f64; 3] {
    [
        now.slip_scale(r),
        now.damping.rate(r) / 1.5,
        rolling(now, r) * now.entrainment(),
    ]
}
