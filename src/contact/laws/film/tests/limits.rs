//! Truths that hold of films by [*Film*](crate::equations#film): limits, smoothness, dimensions.

use std::f64::consts::TAU;

use super::super::{FilmEffect, FilmNumbers, Oiled};
use super::{
    Effects, Film, FilmNow, LubricatedRace, Oil, SPEED, answers, film, film_of, near, race,
    reference, rolling, vg68,
};
use crate::simd::{LANES, Lanes};

/// Limit: as η → 0 over nine decades film, damping and rolling of the film go, and asperities stay.
#[test]
fn thin_oil_leaves_asperities_and_steel() {
    let full = vg68(55.0);
    let at = film().conjunction;
    let creep = at.entrainment * 1.00125 * at.half_width / (2.0 * at.radii[0]);
    let bare = [
        0.0,
        full.boundary_friction,
        full.boundary_friction * creep + full.slip_floor,
        3.0 / 32.0 * full.hysteresis * 250.0 * at.half_width / at.radii[0],
        0.0,
    ];
    let of = |decade: i32| {
        let oil = Oil {
            viscosity: full.viscosity * 10_f64.powi(-decade),
            ..full
        };
        let now = film_of(&oil).at(1.0);
        let [slip, damping, rolling] = answers(&now, 1.0);
        [now.thickness(), now.friction(), slip, rolling, damping]
    };
    let off = |found: [f64; 5]| [0, 1, 2, 3, 4].map(|i| (found[i] - bare[i]).abs());
    let mut last = off(of(0));
    for decade in 1..=9 {
        let now = off(of(decade));
        println!("{decade}: {now:?}");
        for (i, (now, last)) in now.into_iter().zip(last).enumerate() {
            // The slip scale first falls below its limit: steel creeps less under Λ than under μ_b.
            let passes_below = i == 2 && decade == 1;
            assert!(now < last || passes_below, "{i} at {decade}: {now:e}");
        }
        last = now;
    }
    let scale = [1e-7, 0.12, bare[2], bare[3], 0.03];
    assert!(
        last.iter()
            .zip(scale)
            .all(|(off, scale)| *off < 1e-3 * scale),
        "{last:?}"
    );
}

/// Limit: a metre of oil in front of a contact is flooded.
#[test]
fn much_oil_is_flooded() {
    let of = |layer| {
        film_of(&Oil {
            layer,
            ..vg68(55.0)
        })
        .at(0.7)
    };
    let (much, flooded) = (of(Some(1.0)), of(None));
    near(much.thickness(), flooded.thickness(), 1e-12);
    near(rolling(&much, 0.8), rolling(&flooded, 0.8), 1e-5);
}

/// All terms are finite where a contact begins, forces begin with slope zero, and none has a kink.
#[test]
fn contacts_begin_softly() {
    for w in [0.0, 0.3, 1.0] {
        let now = film().at(w);
        let [slip, damping, rolling] = answers(&now, 0.0);
        assert_eq!([slip, rolling], [5e-4, 0.0]);
        assert!(damping.is_finite() && damping > 0.0);
        // Q = Q_ref r³ and δ = δ_ref r²: rolling resistance and damping force over δ vanish with it.
        for r in [1e-3, 1e-5] {
            let [_, damping, rolling] = answers(&now, r);
            assert!(rolling / (r * r) < 1e2 * r && damping * r < 1e6 * r);
        }
        // Slopes from left and right agree wherever r is, to what curvature leaves.
        for r in [1e-6, 0.01, 0.3, 1.0, 3.0] {
            let step = 1e-6 * r;
            let [before, here, after] = [r - step, r, r + step].map(|r| answers(&now, r));
            for i in 0..3 {
                let bend = (after[i] - 2.0 * here[i] + before[i]).abs();
                assert!(bend <= 1e-9 * here[i].abs(), "{i} at {r}: {bend:e}");
            }
        }
    }
}

/// A contact that just begins has a slip scale where no asperity is left, too.
#[test]
fn polished_surfaces_begin_softly_too() {
    let oil = Oil {
        roughness: 1e-20,
        ..vg68(55.0)
    };
    let now = film_of(&oil).at(1.0);
    assert_eq!((now.slip_scale(0.0), now.friction()), (5e-4, 0.047));
    near(now.slip_scale(1.0), 3.48e-3, 0.05);
}

/// Films at w and −w are one, and their slope at w = 0 is zero.
#[test]
fn films_pass_standstill_without_a_kink() {
    let film = film();
    assert_eq!(film.at(0.4), film.at(-0.4));
    let rest = film.at(0.0).thickness();
    assert!((film.at(1e-4).thickness() / rest - 1.0).abs() < 1e-5);
    // Numerical: a resting bearing keeps about 0.14 of it.
    near(rest / film.at(1.0).thickness(), 0.14, 0.01);
}

/// Analytic: under another metre, kilogram and second all follow their dimensions.
#[test]
fn units_scale_exactly() {
    // New units a metre, a kilogram, a second: powers of two, so that products are exact.
    for [metre, kilogram, second] in [
        [4.0, 1.0, 1.0],
        [1.0, 8.0, 1.0],
        [1.0, 1.0, 0.5],
        [2.0, 0.25, 16.0],
    ] {
        let (m, kg, s): (f64, f64, f64) = (metre, kilogram, second);
        let (newton, pascal, speed) = (kg * m / s.powi(2), kg / (m * s.powi(2)), m / s);
        let oil = Oil {
            damping_frequency: Some(1e3),
            ..vg68(55.0)
        };
        let scaled = Oil {
            kinematic_viscosity: oil.kinematic_viscosity * m * m / s,
            density: oil.density * kg / m.powi(3),
            viscosity: oil.viscosity * pascal * s,
            pressure_viscosity: oil.pressure_viscosity / pascal,
            conductivity: oil.conductivity * newton / s,
            roughness: oil.roughness * m,
            layer: oil.layer.map(|layer| layer * m),
            slip_floor: oil.slip_floor * speed,
            damping_frequency: oil.damping_frequency.map(|f| f / s),
            ..oil
        };
        let race = race(1.0);
        let large = LubricatedRace {
            ball_diameter: race.ball_diameter * m,
            pitch_diameter: race.pitch_diameter * m,
            groove_radius: race.groove_radius * m,
            reduced_modulus: race.reduced_modulus * pascal,
            ..race
        };
        let one = Film::new(&oil, &race, reference(&race, 250.0, SPEED), Effects::ALL).at(0.6);
        let at = reference(&large, 250.0 * newton, SPEED / s);
        let other = Film::new(&scaled, &large, at, Effects::ALL).at(0.6);
        near(other.thickness(), one.thickness() * m, 1e-13);
        near(other.friction(), one.friction(), 1e-13);
        let units = [speed, 1.0 / speed, newton];
        for ((found, unscaled), unit) in answers(&other, 0.9)
            .into_iter()
            .zip(answers(&one, 0.9))
            .zip(units)
        {
            near(found, unscaled * unit, 1e-13);
        }
    }
}

/// Each effect may be left out by itself; what is left out does nothing and changes none of the others.
#[test]
fn effects_are_left_out_one_by_one() {
    let race = race(1.0);
    let of =
        |effects| Film::new(&vg68(55.0), &race, reference(&race, 250.0, SPEED), effects).at(1.0);
    let whole = of(Effects::ALL);
    let numbers = |now: &FilmNow| {
        let [slip, damping, rolling] = answers(now, 0.9);
        [now.thickness(), slip, damping, rolling]
    };
    let all = numbers(&whole);
    let left_out = [
        (
            0,
            Effects {
                film: false,
                ..Effects::ALL
            },
        ),
        (
            2,
            Effects {
                damping: false,
                ..Effects::ALL
            },
        ),
        (
            3,
            Effects {
                rolling: false,
                ..Effects::ALL
            },
        ),
    ];
    for (which, effects) in left_out {
        let mut expected = all;
        expected[which] = 0.0;
        assert_eq!(numbers(&of(effects)), expected);
    }
    assert_eq!(
        of(Effects {
            film: false,
            ..Effects::ALL
        })
        .lambda(),
        whole.lambda()
    );
}

/// Damping by (12.17) at a frequency: in N s/m per contact, less the faster, and much less than without.
#[test]
fn slow_damping_falls_with_frequency() {
    let at = |damping_frequency| {
        film_of(&Oil {
            damping_frequency,
            ..vg68(55.0)
        })
        .damping
        .coefficient
    };
    let slow = [100.0, 1e3, 3e3].map(|f| at(Some(f)));
    let fast = at(None);
    println!("{slow:?} {fast}");
    assert!(slow[0] > slow[1] && slow[1] > slow[2] && slow[2] > fast);
    // 0.46 h₁ b (1.5 Q/δ)²/(Q u) by its reference values.
    let slowest = 0.46 * 2.3085e-7 * 1.15654e-4 * (375.0_f64 / 4.65498e-6).powi(2) / 440.17;
    near(at(Some(1e-3)) - fast, slowest, 1e-4);
    // 2π f b/u of 3 kHz is 1.24, of which 1.4 squares leave 0.32.
    let left = |f: f64| 1.0 / (1.0 + 1.4 * (TAU * f * 1.15654e-4 / 1.76068).powi(2));
    near(
        (slow[2] - fast) / (slow[0] - fast),
        left(3e3) / left(100.0),
        1e-4,
    );
}

/// Eight contacts side by side are eight contacts, bit for bit.
#[test]
fn lanes_are_single_contacts() {
    let films = [0.8, 0.3].map(|w| FilmNumbers::new(&Oiled::new(film(), 4e-3, w * SPEED)));
    let lanes = Lanes::from_fn(|i| 0.2 * i as f64);
    let mut numbers = FilmNumbers::default();
    (0..LANES).for_each(|i| numbers.set(i, &films[i % 2]));
    let together = FilmEffect::at(&numbers, lanes);
    for (i, &r) in lanes.numbers().iter().enumerate() {
        let alone = FilmEffect::at(&films[i % 2], r);
        assert_eq!(together.map(|all| all[i]), alone);
    }
}
