//! The static solve stands up to ordinary scenes, and says so when a load cannot be carried.

use std::f64::consts::FRAC_PI_2;

use ballrace::scene::{Defect, Surface, presets};
use ballrace::{Error, equilibrium};

/// Analytic: whatever the load and clearance, the balls carry it: forces on the free inner ring sum to the load.
#[test]
fn ordinary_loads_are_carried() {
    for radial in [5.0, 50.0, 200.0, 500.0, 5000.0] {
        for axial in [0.0, 100.0, 1000.0] {
            for clearance in [0.0, 10e-6, 40e-6] {
                let mut scene = presets::deep_groove_6205(radial, axial, 1800.0);
                scene.rows[0].clearance = clearance;
                let found = equilibrium(&scene).unwrap();
                let thrust: f64 = found
                    .balls
                    .iter()
                    .map(|ball| ball.inner.load * ball.inner.angle.unwrap_or(0.0).sin())
                    .sum();
                assert!(
                    (thrust - axial).abs() < 1e-6 * (radial + axial),
                    "{thrust} for {axial}"
                );
            }
        }
    }
}

/// Analytic: a ball that has sunk into a spall leaves its load to the others.
#[test]
fn a_ball_over_a_spall_is_found() {
    for on in [Surface::InnerRace, Surface::OuterRace] {
        let mut loads = Vec::new();
        for width in [1e-6, 0.3e-3, 0.5e-3, 1e-3, 2e-3] {
            let mut scene = presets::deep_groove_6205(500.0, 200.0, 1800.0);
            let defect = Defect {
                on,
                row: 0,
                ball: None,
                angle: -FRAC_PI_2,
                axial_offset: 0.0,
                length: 4e-3,
                width: width.into(),
                edge_radius: 0.1e-3,
                floor: None,
            };
            scene.defects.insert("spall".to_owned(), defect);
            loads.push(equilibrium(&scene).unwrap().balls[0].inner.load);
        }
        assert!(loads.is_sorted_by(|a, b| a >= b), "{on:?}: {loads:?}");
        assert!(
            loads[0] > 200.0 && loads[4] < 0.25 * loads[0],
            "{on:?}: {loads:?}"
        );
    }
}

/// A load beyond all reason is an error that says so.
#[test]
fn what_cannot_be_carried_is_refused() {
    let error = equilibrium(&presets::wheel_bearing(1e9)).unwrap_err();
    assert!(
        matches!(&error, Error::Equilibrium { reason } if reason.contains("cannot be carried")),
        "{error}"
    );
}
