//! Reference values of [*Film*](crate::equations#film). Tolerances are those that stand there, or half the last printed digit.

use std::f64::consts::{PI, TAU};

use super::super::rolling::FilmRolling;
use super::super::speed::SpeedPowers;
use super::super::thickness::Thickness;
use super::{
    Conjunction, Effects, Film, Lubricant, LubricatedRace, MODULUS, Oil, SPEED, answers, film,
    hertz, near, race, reference, vg68,
};

/// Literature: the formulas of the oil as printed.
#[test]
fn oil_has_the_reference_numbers() {
    let oil = vg68(55.0);
    near(oil.kinematic_viscosity, 34.8162e-6, 1e-4);
    near(oil.density, 857.12, 1e-4);
    near(oil.viscosity, 0.029_842, 1e-4);
    near(oil.temperature_viscosity, 0.040_22, 1e-4);
    near(oil.pressure_viscosity, 1.6223e-8, 1e-4);
}

/// Measured: Vogel's fit of FVA 3 by J. Wingertszahn et al., Lubricants 11 (2023) 369.
#[test]
fn viscosity_of_fva3_is_as_measured() {
    let at = |celsius: f64| {
        let oil = Lubricant::new(96.82e-6, 11.759e-6, celsius + 273.15);
        Oil::new(&oil).unwrap().kinematic_viscosity
    };
    near(at(60.0), 40.15e-6, 5e-3);
    near(at(80.0), 20.27e-6, 5e-3);
    near(at(20.0), 308e-6, 2e-2);
}

/// Literature: Hertz's theory, and the formulas of sections 12.2, 12.3 and 12.6.
#[test]
fn conjunction_has_the_reference_numbers() {
    let (race, film) = (race(1.0), film());
    let at = film.conjunction;
    near(at.radii[0], 4.77742e-3, 1e-5);
    near(at.radii[1], 8.33700e-2, 1e-5);
    near(at.axis_ratio, 0.15699, 3e-5);
    near(hertz(&race).stiffness, 2.48922e10, 1e-5);
    near(at.half_length, 7.36715e-4, 1e-5);
    near(at.half_width, 1.15654e-4, 1e-5);
    near(film.reference().approach, 4.65498e-6, 1e-5);
    near(at.pressure, 1.40094e9, 1e-5);
    near(at.entrainment, 1.76068, 1e-5);
    near(film.groups.heat, 0.02777, 2e-4);
    near(film.damping.coefficient, 11.772, 1e-4);
    let flooded = Thickness::new(&at, &film.groups, None);
    near(flooded.isothermal, 2.37079e-7, 1e-4);
    // Against the factor of SKF's model, which is 0.972.
    let skf = 1.0 / (1.0 + 1.84e-9 * (1797.0 * 39.04_f64).powf(1.28) * 34.8162_f64.powf(0.64));
    near(skf, 0.972, 1e-3);
    near(flooded.flooded(1.0) / flooded.isothermal, 0.973, 1e-3);
    near(flooded.flooded(1.0) / flooded.isothermal, skf, 2e-2);
}

/// Literature: the formulas of sections 12.3 and 12.6 to 12.8, at and away from the reference.
#[test]
fn film_has_the_reference_numbers() {
    let film = film();
    // w, r; h, φ_a, μ; v, α_f, F_R.
    let rows = [
        (
            1.0,
            1.0,
            [2.3085e-7, 0.01731, 0.048_264],
            [3.5352e-3, 0.028_484, 0.069_165],
        ),
        (
            1.0,
            0.5,
            [2.3085e-7, 0.01731, 0.048_264],
            [0.135_51, 0.349_61, 0.033_980],
        ),
        (
            0.2,
            1.2,
            [8.2456e-8, 0.208_14, 0.062_194],
            [9.2183e-4, 0.025_008, 0.035_532],
        ),
        (
            0.0,
            1.0,
            [3.2160e-8, 0.532_27, 0.085_855],
            [6.9349e-4, 0.084_046, 0.012_332],
        ),
    ];
    for (w, r, [thickness, asperities, friction], of_contact) in rows {
        let now = film.at(w);
        near(now.thickness(), thickness, 1e-4);
        near(now.friction(), friction, 1e-4);
        near((now.friction() - 0.047) / (0.12 - 0.047), asperities, 3e-4);
        for (found, expected) in answers(&now, r).into_iter().zip(of_contact) {
            near(found, expected, 1e-4);
        }
    }
}

/// Literature: film damping in N s/m, over loads and over the frequencies of (12.17).
#[test]
fn damping_is_that_of_section_12_6() {
    let film = film();
    let now = film.at(1.0);
    let loads = [5.0, 20.0, 100.0, 250.0, 1000.0];
    for (load, expected) in loads.into_iter().zip([15.5, 17.0, 13.4, 10.7, 7.1]) {
        let r = (load / 250.0_f64).cbrt();
        near(now.damping.rate(r) * load, expected, 5e-3);
    }
}

/// F_hd \[N\] of a conjunction at its own load and speed, without starvation, heat and separation.
fn bare_rolling(at: &Conjunction, oil: &Oil) -> f64 {
    let oil = Oil {
        temperature_viscosity: 0.0,
        ..*oil
    };
    let rolling = FilmRolling::new(at, &at.groups(&oil), 0.0);
    // w̃ = 1.
    let powers = SpeedPowers::new((1.0_f64 - 1.0 / 400.0).sqrt());
    let [film, _] = rolling.at(&powers, 1.0, 0.0, None).parts(1.0);
    film
}

/// Literature: F_hd of Biboulet and Houpert without starvation, heat and separation; by O. Bălan's simplified form 0.03941,
/// 0.05637, 0.10765 N.
#[test]
fn rolling_resistance_is_that_of_biboulet_and_houpert() {
    let oil = Oil {
        viscosity: 0.03,
        ..vg68(55.0)
    };
    let rows = [
        (5.0, 0.03955, 0.03941),
        (50.0, 0.05658, 0.05637),
        (500.0, 0.10803, 0.10765),
    ];
    for (load, expected, simplified) in rows {
        let found = bare_rolling(&Conjunction::new(&race(1.0), load, SPEED), &oil);
        near(found, expected, 1e-3);
        near(found, simplified, 5e-3);
    }
}

/// Measured: friction torque of a thrust bearing 51205 with three balls of 0.125 N each, M. R. D. Bălan et al., Lubricants
/// 3 (2015) 222; by the formula of Biboulet and Houpert. Where so little load presses, the factor by which resistance ends
/// smoothly leaves 0.4 of it.
#[test]
fn thrust_bearing_turns_as_hard_as_measured() {
    let radius = 18e-3;
    let race = LubricatedRace {
        sigma: 1.0,
        ball_diameter: 6.35e-3,
        pitch_diameter: 2.0 * radius,
        groove_radius: 4.16e-3,
        contact_angle: PI / 2.0,
        reduced_modulus: MODULUS,
    };
    let oil = Oil {
        viscosity: 0.05,
        ..vg68(55.0)
    };
    for (turns, measured) in [(120.0, 1.89e-4), (210.0, 2.49e-4)] {
        let at = Conjunction::new(&race, 0.125, turns / 60.0 * TAU);
        let torque = 6.0 * radius * bare_rolling(&at, &oil);
        println!("{turns} 1/min: {torque:e} N m");
        assert!((0.7..1.1).contains(&(torque / measured)), "{torque:e}");
    }
}

/// Literature: where ISO 281 has κ = 1, ν̂ = 4500/√(n d_m'), the inner film of a 6205 is as thick as surfaces are rough.
#[test]
fn film_is_as_thick_as_surfaces_are_rough_at_kappa_one() {
    let needed = 4500.0 / (1797.0 * 38.5_f64).sqrt();
    let oil = vg68(55.0);
    let oil = Oil {
        viscosity: oil.density * needed * 1e-6,
        pressure_viscosity: 9.904e-9 * needed.powf(0.139),
        ..oil
    };
    let race = race(-1.0);
    let at = reference(&race, 800.0, SPEED);
    near(
        Film::new(&oil, &race, at, Effects::ALL).at(1.0).thickness(),
        0.106e-6,
        5e-3,
    );
}

/// Literature: films of both races of a 6205 at 250 N a ball by temperature.
#[test]
fn films_thin_as_oil_warms() {
    for (celsius, inner, outer) in [(40.0, 0.31, 0.38), (55.0, 0.19, 0.23), (70.0, 0.13, 0.15)] {
        for (sigma, expected) in [(-1.0, inner), (1.0, outer)] {
            let race = race(sigma);
            let at = reference(&race, 250.0, SPEED);
            let film = Film::new(&vg68(celsius), &race, at, Effects::ALL).at(1.0);
            assert!((film.thickness() * 1e6 - expected).abs() < 6e-3, "{film:?}");
        }
    }
}

/// Restitution of a ball that falls on the reference contact at a speed \[m/s\], by m δ̈ = −K δ^{3/2} (1 + 3/2 α δ̇).
fn restitution(speed: f64, rate: impl Fn(f64) -> f64) -> f64 {
    let mass = 7850.0 * PI / 6.0 * 7.94e-3_f64.powi(3);
    let stiffness = hertz(&race(1.0)).stiffness;
    let unit = (250.0 / stiffness).powf(2.0 / 3.0);
    let acceleration = |x: f64, v: f64| {
        let x = x.max(0.0);
        let factor = 1.0 + rate((x / unit).sqrt()) * v;
        -stiffness * x * x.sqrt() * factor.max(0.0) / mass
    };
    // A ten-thousandth of about half a period of the impact.
    let step = 3e-4 * (mass / stiffness).powf(0.4) * speed.powf(-0.2);
    let (mut x, mut v) = (0.0, speed);
    while x >= 0.0 {
        let (a1, v1) = (acceleration(x, v), v);
        let v2 = v + 0.5 * step * a1;
        let a2 = acceleration(x + 0.5 * step * v1, v2);
        let v3 = v + 0.5 * step * a2;
        let a3 = acceleration(x + 0.5 * step * v2, v3);
        let v4 = v + step * a3;
        let a4 = acceleration(x + step * v3, v4);
        x += step / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
        v += step / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
    -v / speed
}

/// Reference: a free impact on dry steel, on film, and on both.
#[test]
fn free_impacts_lose_what_they_should() {
    let now = film().at(1.0);
    let dry = 1.5 * 0.2;
    let rows = [
        (0.01, [0.998, 0.940, 0.938]),
        (0.1, [0.980, 0.894, 0.877]),
        (0.5, [0.909, 0.921, 0.839]),
    ];
    for (speed, expected) in rows {
        let found = [
            restitution(speed, |_| dry),
            restitution(speed, |r| now.damping.rate(r)),
            restitution(speed, |r| now.damping.rate(r) + dry),
        ];
        println!("{speed} m/s: {found:.4?}");
        for (found, expected) in found.into_iter().zip(expected) {
            assert!(
                (found - expected).abs() <= 1e-3,
                "{speed}: {found} not {expected}"
            );
        }
    }
}
