//! Analytic: what is read of records, and the rates at which lines stand there: fault frequencies under load, as balls roll and as a run
//! measured them; records with a sample that is no number are refused.

use std::f64::consts::TAU;

use ballrace::scene::{Drive, Friction, Row, RowGeometry, Scene, Spin, presets};
use ballrace::{
    Error, FaultFrequencies, FeatureOptions, Run, fault_frequencies, run_fault_frequencies,
    signal_features, simulate, squared_envelope, squared_envelope_spectrum,
};

const SHAFT: f64 = 30.0;

/// A row that no scene could run: without masses, loads and mounts.
fn known() -> Scene {
    let row = Row::new(9, 7.94e-3, 39.04e-3, 0.53, 0.52);
    Scene::new(vec![row], Drive::Speed((TAU * SHAFT).into()))
}

/// Bursts of a resonance at 3 kHz at a rate \[Hz\], over a second.
fn bursts(rate: f64) -> Vec<f64> {
    let burst = |t: f64| {
        let since = t % (1.0 / rate);
        (-800.0 * since).exp() * (TAU * 3000.0 * since).sin()
    };
    (0..20_000).map(|i| burst(f64::from(i) / 20e3)).collect()
}

#[test]
fn bursts_have_lines_at_their_rate_without_a_scene_that_could_run() {
    let outer = known().rows[0].geometry().orders().at(SHAFT).bpfo;
    let x = bursts(outer);
    let (f, value) = squared_envelope_spectrum(&x, 20e3, Some([2e3, 4e3])).unwrap();
    let from = f.iter().position(|f| *f > 20.0).unwrap();
    let highest = (from..f.len()).max_by(|&i, &j| value[i].total_cmp(&value[j]));
    assert!((f[highest.unwrap()] - outer).abs() < 1.0);
    let options = FeatureOptions::default();
    let found = signal_features(&x, 20e3, "", Some(&known()), &options).unwrap();
    let line = |name: &str| {
        found
            .iter()
            .find(|of| of.name == name)
            .unwrap()
            .value
            .unwrap()
    };
    assert!(line("row0.bpfo_envelope") > 20.0 * line("row0.bpfi_envelope"));
}

#[test]
fn a_sample_that_is_no_number_is_refused_by_its_place() {
    for (wrong, said) in [(f64::NAN, "nan"), (f64::NEG_INFINITY, "-inf")] {
        let mut x = bursts(100.0);
        (x[17], x[400]) = (wrong, wrong);
        let options = FeatureOptions::default();
        let refused = [
            signal_features(&x, 20e3, "", None, &options).unwrap_err(),
            squared_envelope(&x, 20e3, None).unwrap_err(),
        ];
        for error in refused {
            let text = error.to_string();
            assert_eq!(
                text,
                format!("x = {said} in sample 17, and 1 more like it: finite everywhere")
            );
        }
    }
    let refused = squared_envelope(&[1e61; 8], 20e3, None).unwrap_err();
    assert_eq!(refused.to_string(), "x = up to 1e61: magnitudes up to 1e60");
    let beyond = squared_envelope(&bursts(100.0), 20e3, Some([1e3, 2e4]));
    assert!(matches!(beyond, Err(Error::Argument { path, .. }) if path == "band"));
}

/// f_BPFO + f_BPFI = Z f_shaft, f_BPFO = Z (f_c − f_o), at the angle that the load gives.
#[test]
fn rates_under_load_are_those_of_rolling_at_the_loaded_angle() {
    let mut scene = presets::deep_groove_6205(500.0, 500.0, 1800.0);
    scene.friction = Friction::None;
    let found = fault_frequencies(&scene, 0).unwrap();
    let row = scene.rows[0].geometry();
    let angle = found.contact_angle;
    assert!(angle > 0.1 && found.slip.is_none());
    let rolling = FaultFrequencies::rolling(
        &RowGeometry {
            contact_angle: angle,
            ..row
        },
        [0.0, SHAFT],
    );
    for (found, rolling) in [
        (found.ftf, rolling.ftf),
        (found.bpfo, rolling.bpfo),
        (found.bpfi, rolling.bpfi),
        (found.shaft, 30.0),
    ] {
        assert!((found / rolling - 1.0).abs() < 2e-3, "{found} {rolling}");
    }
    assert!((found.bpfo + found.bpfi - 9.0 * SHAFT).abs() < 1e-9);
    // A hub: the balls pass as often, the cage goes with the other ring.
    let hub = FaultFrequencies::rolling(&row, [SHAFT, 0.0]);
    let shaft = FaultFrequencies::rolling(&row, [0.0, SHAFT]);
    assert!((hub.bpfo - shaft.bpfo).abs() < 1e-9 && (hub.ftf + shaft.ftf - SHAFT).abs() < 1e-9);
}

#[test]
fn a_run_measures_its_rates() {
    let scene = presets::deep_groove_6205(500.0, 100.0, 12_000.0);
    let run = Run {
        duration: 8e-3,
        ..Run::default()
    };
    let out = simulate(&scene, &run).unwrap();
    let did = out.provenance.kinematics[0];
    let [found, rest] =
        [run_fault_frequencies(&out, 0), fault_frequencies(&scene, 0)].map(Result::unwrap);
    assert!((found.bpfo - 9.0 * did.cage).abs() < 1e-9 && found.slip.unwrap().abs() < 0.02);
    assert!((found.bpfo / rest.bpfo - 1.0 + found.slip.unwrap()).abs() < 1e-4);
    let short = simulate(
        &scene,
        &Run {
            duration: 1e-3,
            ..run
        },
    )
    .unwrap();
    assert_eq!(run_fault_frequencies(&short, 0).unwrap(), rest);
}

#[test]
fn rates_that_are_not_there_are_refused_by_name() {
    let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let mut torque = scene.clone();
    torque.drive = Drive::Torque {
        value: 0.1.into(),
        initial_speed: 100.0,
    };
    let still = scene.with(&[("drive.speed", 0.0.into())]).unwrap();
    let mut heavy = presets::wheel_bearing(1e9);
    heavy.spin = Some(Spin::Free);
    let absent = fault_frequencies(&scene, 1);
    assert!(matches!(absent, Err(Error::Argument { path, .. }) if path == "row"));
    for (found, path) in [
        (fault_frequencies(&torque, 0), "drive"),
        (fault_frequencies(&still, 0), "drive"),
    ] {
        assert!(matches!(found, Err(Error::Scene { path: of, .. }) if of == path));
    }
    assert!(matches!(
        fault_frequencies(&heavy, 0),
        Err(Error::Equilibrium { .. })
    ));
}
