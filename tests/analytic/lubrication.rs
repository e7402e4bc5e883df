//! What is read of the oil: probe, energies, equilibrium, explanation, doubts and features.

use crate::common;
use std::f64::consts::PI;

use ballrace::dynamics::contributions;
use ballrace::scene::{
    Drive, Lubricant, Probe, Profile, RaceProfile, RingName, Scene, TimeFunction, presets,
};
use ballrace::{
    Error, FeatureOptions, Model, Run, Signals, Start, compile, equilibrium, explain, features,
    inspect, start,
};
use common::{Noise, run};

const SPEED_RPM: f64 = 1797.0;

/// A 6205 under 500 N in VG 68 at a temperature \[°C\], with a probe `oil` of its oil.
fn oiled(celsius: f64) -> Scene {
    let mut scene = presets::deep_groove_6205(500.0, 0.0, SPEED_RPM);
    scene.lubricant = Some(Lubricant::named("vg68", celsius + 273.15));
    scene.probes = [("oil".to_owned(), Probe::lubrication(0))].into();
    scene
}

/// A state near the equilibrium's in which everything slips.
fn disturbed(model: &Model) -> Vec<f64> {
    let mut noise = Noise(7);
    let mut y = start(model, &Start::Equilibrium).unwrap();
    let half = y.len() / 2;
    for (i, state) in y.iter_mut().enumerate() {
        *state += noise.next() * if i < half { 1e-6 } else { 0.1 };
    }
    y
}

fn mean(x: &[f64]) -> f64 {
    x.iter().sum::<f64>() / x.len() as f64
}

/// Some turns of the cage; the settling before takes what is left of the start.
fn steady(scene: &Scene) -> Signals {
    let record = Run {
        duration: 0.05,
        threads: 1,
        ..Run::default()
    };
    run(scene, &record)
}

/// Analytic: forces by origin take out the powers that are reported, each its own; rolling resistance counts as friction.
#[test]
fn powers_are_those_of_the_forces() {
    let model = compile(&oiled(55.0)).unwrap();
    let y = disturbed(&model);
    let half = y.len() / 2;
    let energy = inspect::energy(&model, &y).unwrap();
    let row = inspect::lubrication(&model, &y, 0).unwrap();
    let lost = [
        ("damping", energy.damping_power),
        ("friction", energy.friction_power + energy.rolling_power),
    ];
    assert!(energy.rolling_power > 0.1 && energy.friction_power > 0.1);
    let parts = contributions(&model, 0.0, &y);
    for (origin, power) in lost {
        let (_, forces) = parts.iter().find(|(name, _)| *name == origin).unwrap();
        let taken = -forces
            .iter()
            .zip(&y[half..])
            .map(|(f, v)| f * v)
            .sum::<f64>();
        assert!(
            (power / taken - 1.0).abs() < 1e-11,
            "{origin}: {power} of {taken}"
        );
    }
    // One row: the bearing's.
    let of_row = [row.slip_power, row.rolling_power, row.damping_power];
    let of_all = [
        energy.friction_power,
        energy.rolling_power,
        energy.damping_power,
    ];
    for (row, all) in of_row.into_iter().zip(of_all) {
        assert!((row / all - 1.0).abs() < 1e-12, "{row} of {all}");
    }
}

/// Analytic: the moment that all but the drive put on the inner ring, whose centre no load misses.
#[test]
fn friction_torque_is_the_balls_moment_and_resists_either_way() {
    for speed in [188.0, -188.0] {
        let mut scene = oiled(55.0);
        scene.drive = Drive::Speed(speed.into());
        let model = compile(&scene).unwrap();
        let y = start(&model, &Start::Equilibrium).unwrap();
        let moment: f64 = contributions(&model, 0.0, &y)
            .iter()
            .filter(|(name, _)| ["contact", "damping", "friction"].contains(name))
            .map(|(_, forces)| forces[4 + 3])
            .sum();
        let torque = inspect::lubrication(&model, &y, 0).unwrap().friction_torque;
        assert!(
            (torque + moment * speed.signum()).abs() < 1e-12 * torque,
            "{torque}, {moment}"
        );
        assert!(torque > 2e-3, "{torque}");
    }
}

/// Truth: the state at the same time. Films are the specification's for this bearing: 0.19 to
/// 0.23 µm, the outer race's the thicker.
#[test]
fn the_probe_reads_the_state() {
    let scene = oiled(55.0);
    let model = compile(&scene).unwrap();
    let y = start(&model, &Start::Equilibrium).unwrap();
    let still = Run {
        duration: 1e-4,
        settle: Some(0.0),
        ..Run::default()
    };
    let out = run(&scene, &still);
    let names: Vec<_> = out
        .columns
        .iter()
        .map(|c| (c.name.as_str(), c.unit.as_ref()))
        .collect();
    let labels = inspect::Lubrication::LABELS;
    let expected: Vec<_> = labels
        .map(|(name, unit)| (format!("oil.{name}"), unit))
        .into();
    assert_eq!(
        names,
        expected
            .iter()
            .map(|(n, u)| (n.as_str(), *u))
            .collect::<Vec<_>>()
    );
    let read = inspect::lubrication(&model, &y, 0).unwrap();
    for (column, value) in out.columns.iter().zip(read.values()) {
        assert!(
            (column.values[0] - value).abs() <= 1e-9 * value.abs(),
            "{}",
            column.name
        );
    }
    let [outer, inner] = read.film;
    assert!(
        0.19e-6 < inner && inner < outer && outer < 0.235e-6,
        "{read:?}"
    );
    assert!((read.lambda[0] / (outer / 1e-7) - 1.0).abs() < 1e-12);
}

/// Analytic: films follow the rings' speed against each other, with the exponent 2/3 but for heat.
#[test]
fn films_are_those_of_the_speed() {
    let model = compile(&oiled(70.0)).unwrap();
    let mut y = start(&model, &Start::Equilibrium).unwrap();
    let whole = inspect::lubrication(&model, &y, 0).unwrap().film;
    let at = model
        .layout()
        .speed_at(ballrace::BodyId::INNER, ballrace::Dof::Theta);
    y[at] *= -0.5;
    let half = inspect::lubrication(&model, &y, 0).unwrap().film;
    for (whole, half) in whole.into_iter().zip(half) {
        let exponent = (half / whole).ln() / 0.5_f64.ln();
        assert!((exponent - 0.66).abs() < 0.02, "{exponent}");
    }
}

#[test]
fn a_dry_row_has_no_oil_to_read() {
    let mut scene = oiled(55.0);
    scene.lubricant = None;
    let Err(Error::Scene {
        path,
        value,
        allowed,
        ..
    }) = scene.validate()
    else {
        panic!("no oil was read");
    };
    assert_eq!(
        (path.as_str(), value.as_str()),
        ("probes.oil.lubrication.row", "0")
    );
    assert!(allowed.contains("`lubricant`"), "{allowed}");
    // Oil of the row is enough.
    scene.rows[0].lubricant = Some(Lubricant::named("vg68", 328.15));
    scene.validate().unwrap();
}

/// Literature: SKF's model for the same bearing, 0.6 to 1.3 times, and the values computed there apart from
/// this code, to a tenth.
#[test]
fn torque_of_a_6205_is_near_skf() {
    for (celsius, skf, computed) in [
        (40.0, 16.44e-3, 13.3e-3),
        (55.0, 12.14e-3, 9.5e-3),
        (70.0, 9.69e-3, 7.2e-3),
    ] {
        let out = steady(&oiled(celsius));
        let torque = mean(out.get("oil.friction_torque").unwrap());
        let speed = SPEED_RPM * PI / 30.0;
        let power = |name: &str| mean(out.get(&format!("oil.{name}")).unwrap());
        let parts = ["slip_power", "rolling_power", "damping_power"].map(power);
        println!(
            "{celsius} °C: films {:.4}, {:.4} µm; torque {:.3} N mm, slip {:.3}, rolling {:.3}, damping {:.3}, sum {:.3}",
            1e6 * mean(out.get("oil.outer.film").unwrap()),
            1e6 * mean(out.get("oil.inner.film").unwrap()),
            1e3 * torque,
            1e3 * parts[0] / speed,
            1e3 * parts[1] / speed,
            1e3 * parts[2] / speed,
            1e3 * parts.iter().sum::<f64>() / speed,
        );
        assert!(
            (0.6..1.3).contains(&(torque / skf)),
            "{celsius} °C: {torque}"
        );
        assert!(
            (torque / computed - 1.0).abs() < 0.1,
            "{celsius} °C: {torque}"
        );
    }
}

/// Paths of what is doubted.
fn doubted(scene: &Scene) -> Vec<String> {
    let found = equilibrium(scene).unwrap().doubts;
    found.into_iter().map(|doubt| doubt.path).collect()
}

/// Literature: the reference contact, whose load and speed are given to the films: 0.2309 µm on the outer
/// race, μ 0.0483, v 3.54 mm/s. Truth: without given ones they are ΣQ²/ΣQ of the dry equilibrium, and the drive's.
#[test]
fn equilibrium_gives_the_films() {
    let mut scene = oiled(55.0);
    let films = equilibrium(&scene).unwrap().films;
    let races: Vec<_> = films.iter().map(|film| (film.row, film.race)).collect();
    assert_eq!(races, [(0, RingName::Outer), (0, RingName::Inner)]);
    let mut dry = scene.clone();
    (dry.lubricant, dry.probes) = (None, [].into());
    let dry = equilibrium(&dry).unwrap();
    assert!(dry.films.is_empty());
    let of_load = |power: i32| -> f64 {
        dry.balls
            .iter()
            .map(|ball| ball.inner.load.powi(power))
            .sum()
    };
    let inner = &films[1];
    assert!(
        (inner.reference_load / (of_load(2) / of_load(1)) - 1.0).abs() < 1e-6,
        "{inner:?}"
    );
    assert!((inner.reference_speed - SPEED_RPM * PI / 30.0).abs() < 1e-9);

    let oil = scene.lubricant.as_mut().unwrap();
    (oil.reference_load, oil.reference_speed) = (Some(250.0), Some(188.18));
    let outer = &equilibrium(&scene).unwrap().films[0];
    let expected = [
        (outer.film, 2.3085e-7),
        (outer.minimum_film, 0.8 * 2.3085e-7),
        (outer.lambda_ratio, 2.3085),
        (outer.friction, 0.048_264),
        (outer.slip_scale, 3.5352e-3),
        (outer.pressure, 1.40094e9),
        (outer.ellipticity, 1.0 / 0.15699),
    ];
    for (found, published) in expected {
        assert!(
            (found / published - 1.0).abs() < 1e-3,
            "{found} of {published}"
        );
    }
}

/// The same numbers, in words, with where they come from, and what the oil costs and changes.
#[test]
fn explain_gives_the_oil() {
    let mut scene = oiled(55.0);
    let explanation = explain(&scene).unwrap();
    let oil = &explanation.oils[0];
    assert_eq!(
        (oil.oil.as_deref(), oil.load_from, oil.speed_from),
        (Some("vg68"), "equilibrium", "drive")
    );
    assert!((oil.kinematic_viscosity / 34.8162e-6 - 1.0).abs() < 1e-4);
    assert_eq!(oil.films, equilibrium(&scene).unwrap().films);
    for change in [
        "without oil",
        "without rolling resistance",
        "without the film's damping",
    ] {
        let offer = explanation
            .variants
            .iter()
            .find(|variant| variant.change == change)
            .unwrap();
        assert!(offer.note.contains("of a 6205 under 500 N"), "{offer:?}");
    }
    let text = explanation.to_string();
    for part in [
        "vg68 at 55 °C, 34.82 mm²/s",
        "outer race: film 0.2",
        "(equilibrium) at 1797 1/min (drive)",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    scene.lubricant.as_mut().unwrap().reference_load = Some(250.0);
    assert!(
        explain(&scene)
            .unwrap()
            .to_string()
            .contains("for 250 N (given)")
    );
    let dry = explain(&presets::deep_groove_6205(500.0, 0.0, SPEED_RPM)).unwrap();
    assert!(
        dry.oils.is_empty() && !dry.to_string().contains("oil"),
        "{dry}"
    );
}

/// An error names the oil that it is of: the scene's or a row's own.
#[test]
fn errors_name_the_oil_that_they_are_of() {
    let refused = |of_row: bool, change: fn(&mut Scene)| {
        let mut scene = oiled(55.0);
        if of_row {
            scene.rows[0].lubricant = scene.lubricant.take();
        }
        change(&mut scene);
        compile(&scene).unwrap_err().to_string()
    };
    let overloaded = |scene: &mut Scene| scene.loads.get_mut("radial").unwrap().force = 1e9.into();
    let curved = |scene: &mut Scene| {
        let z: Vec<f64> = (-20..=20).map(|k| 1e-4 * f64::from(k)).collect();
        let groove = 0.525 * scene.rows[0].ball_diameter;
        let r = z
            .iter()
            .map(|z| 23.49e-3 - groove + (groove * groove - z * z).sqrt());
        scene.rows[0].outer_profile = Some(RaceProfile::new(z.clone(), r.collect()));
    };
    for (of_row, path) in [(false, "lubricant"), (true, "rows[0].lubricant")] {
        let text = refused(of_row, overloaded);
        assert!(text.contains(&format!("{path}.reference_load")), "{text}");
        let text = refused(of_row, curved);
        assert!(text.contains(&format!("{path}.film")), "{text}");
    }
}

/// Ordinary bearings in ordinary oil are not doubted.
#[test]
fn ordinary_films_are_not_doubted() {
    let wheels = [-3000.0, 0.0, 3000.0].map(presets::wheel_bearing);
    let scenes = wheels.into_iter().chain([oiled(0.0)]);
    for mut scene in scenes {
        for celsius in [40.0, 55.0, 70.0] {
            scene.lubricant = Some(Lubricant::named("vg68", celsius + 273.15));
            assert_eq!(doubted(&scene), [""; 0], "{} at {celsius} °C", scene.name);
        }
    }
}

/// Every limit of the formulas of films, in an equilibrium and after a run.
#[test]
fn films_beyond_their_formulas_are_doubted() {
    let changed = |change: fn(&mut Scene)| {
        let mut scene = oiled(55.0);
        change(&mut scene);
        scene
    };
    let close = changed(|scene| scene.rows[0].inner_conformity = 0.508);
    assert_eq!(doubted(&close), ["row 0, inner film, length over width"]);
    let fast = changed(|scene| {
        scene.lubricant = Some(Lubricant::named("vg220", 293.15));
        scene.drive = Drive::Speed(1200.0.into());
    });
    assert_eq!(
        doubted(&fast),
        ["row 0, outer film, Moes' L", "row 0, inner film, Moes' L"]
    );
    let undamped = changed(|scene| {
        let oil = scene.lubricant.insert(Lubricant::named("vg220", 293.15));
        oil.damping = false;
        scene.drive = Drive::Speed(1200.0.into());
    });
    assert_eq!(doubted(&undamped), [""; 0]);
    let rough = changed(|scene| scene.lubricant.as_mut().unwrap().roughness = 1.9e-6);
    assert_eq!(
        doubted(&rough),
        ["row 0, outer film, λ", "row 0, inner film, λ"]
    );
    let heavy = changed(|scene| scene.lubricant.as_mut().unwrap().reference_load = Some(4000.0));
    assert_eq!(
        doubted(&heavy),
        ["row 0, outer film, pressure", "row 0, inner film, pressure"]
    );
    // What no steel bears is doubted once, and not as a film's.
    let crushed = changed(|scene| scene.loads.get_mut("radial").unwrap().force = 50e3.into());
    assert_eq!(doubted(&crushed), ["contact pressure"]);

    let record = Run {
        duration: 1e-4,
        settle: Some(0.0),
        ..Run::default()
    };
    let warned = |scene: &Scene| -> Vec<String> {
        let warnings = run(scene, &record).warnings();
        warnings
            .iter()
            .map(ToString::to_string)
            .filter(|text| text.contains("film"))
            .collect()
    };
    assert!(
        warned(&rough)[0].contains("row 0, outer film, λ = 0.12"),
        "{:?}",
        warned(&rough)
    );
    assert!(warned(&oiled(55.0)).is_empty());
}

/// Truth: the columns, without the beginning that is left out.
#[test]
fn features_of_the_oil_are_least_films_and_means() {
    let mut scene = oiled(55.0);
    // A film that changes: least at the end.
    let slowing = Profile::Ramp {
        from: 188.0,
        to: 150.0,
        start: 0.0,
        end: 2e-3,
    };
    scene.drive = Drive::Speed(TimeFunction::Profile(slowing));
    let out = run(
        &scene,
        &Run {
            duration: 2e-3,
            settle: Some(0.0),
            ..Run::default()
        },
    );
    let options = FeatureOptions {
        skip: 1e-3,
        ..FeatureOptions::default()
    };
    let found = features(&out, &options).unwrap();
    let value = |name: &str| {
        found
            .iter()
            .find(|feature| feature.name == name)
            .unwrap()
            .value
            .unwrap()
    };
    let column = |name: &str| &out.get(name).unwrap()[50..];
    assert_eq!(value("oil.inner.film_min"), column("oil.inner.film")[49]);
    assert_eq!(
        value("oil.outer.lambda_min"),
        column("oil.outer.lambda")[49]
    );
    for name in [
        "friction_torque",
        "slip_power",
        "rolling_power",
        "damping_power",
    ] {
        let name = format!("oil.{name}");
        assert_eq!(
            value(&format!("{name}_mean")),
            mean(column(&name)),
            "{name}"
        );
    }
}
