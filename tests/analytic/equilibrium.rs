//! The static solve stands up to ordinary scenes, and says so when a load cannot be carried.

use std::f64::consts::{FRAC_PI_2, PI};

use ballrace::compile;
use ballrace::dynamics::contributions;
use ballrace::scene::{Defect, Material, Patch, Surface, presets};
use ballrace::{Error, Start, equilibrium, start};

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

/// Analytic: on the lowest ball alone a ring would topple; it tilts on the next one, and both carry its weight.
#[test]
fn an_unloaded_ring_tilts_on_two_balls() {
    let scene = presets::deep_groove_6205(0.0, 0.0, 1800.0);
    let found = equilibrium(&scene).unwrap();
    let [mut aside, mut up] = [0.0, 0.0];
    for ball in &found.balls {
        // From the ring's centre: a micrometre aside matters for what tilts.
        let (sin, cos) = ball.angle.sin_cos();
        let x = ball.radius * cos - found.inner[0];
        let y = ball.radius * sin - found.inner[1];
        aside -= ball.inner.load * x / x.hypot(y);
        up -= ball.inner.load * y / x.hypot(y);
    }
    let weight = scene.inner_ring.mass.unwrap() * 9.81;
    assert!((up / weight - 1.0).abs() < 1e-9, "{up} of {weight}");
    assert!((aside / weight).abs() < 1e-9, "{aside}");
    let carry: Vec<_> = found
        .balls
        .iter()
        .filter(|ball| ball.inner.load > 0.0)
        .collect();
    assert_eq!(carry.len(), 2);
    assert!(carry.iter().any(|ball| ball.ball == 0));
}

/// Analytic: a ball that has sunk into a spall leaves its load to the others.
#[test]
fn a_ball_over_a_spall_is_found() {
    for on in [Surface::InnerRace, Surface::OuterRace] {
        let mut loads = Vec::new();
        for width in [1e-6, 0.3e-3, 0.5e-3, 1e-3, 2e-3] {
            let mut scene = presets::deep_groove_6205(500.0, 200.0, 1800.0);
            let defect = Defect::of(
                Patch::of_width(width).length(4e-3).edge_radius(0.1e-3),
                on,
                -FRAC_PI_2,
            )
            .at_offset(0.0);
            scene.defects.insert("spall".to_owned(), defect);
            loads.push(equilibrium(&scene).unwrap().balls[0].inner.load);
        }
        // Sunk, a ball no longer sees the width: places near 0.02 m on contacts of 10⁸ N/m round to 4e-10 N.
        assert!(
            loads.is_sorted_by(|a, b| *a >= *b - 1e-9),
            "{on:?}: {loads:?}"
        );
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
        matches!(&error, Error::Equilibrium { reason, ..} if reason.contains("cannot be carried")),
        "{error}"
    );
}

/// Limits: a ring of 330 t, whose weight pushes it past the other's middle, is refused by a ball and with numbers.
#[test]
fn rings_that_lie_beyond_each_other_are_refused_with_numbers() {
    let mut scene = presets::deep_groove_6205(500.0, 100.0, 1800.0);
    scene.outer_ring.diameter = Some(60.048_663);
    let Err(Error::Equilibrium { reason, .. }) = equilibrium(&scene) else {
        panic!("it is carried");
    };
    assert!(reason.starts_with("row0.ball"), "{reason}");
    assert!(!reason.contains("NaN"), "{reason}");
}

/// Truth: Newton's law. In the cage's frame nothing is left on any ball of a bearing whose loose balls hang on their
/// cage between the races; and it takes few iterations (22 where tension and balls take turns).
#[test]
fn balls_that_hang_on_the_cage_are_balanced_soon() {
    for axial in [0.0, 3000.0, -3000.0] {
        let scene = presets::wheel_bearing(axial);
        let iterations = equilibrium(&scene).unwrap().iterations;
        assert!(iterations <= 12, "{axial}: {iterations}");
        let model = compile(&scene).unwrap();
        let mut y = start(&model, &Start::Equilibrium).unwrap();
        let half = y.len() / 2;
        y[half..].fill(0.0);
        let forces = contributions(&model, 0.0, &y);
        let at_rest = forces
            .iter()
            .filter(|(name, _)| !["damping", "friction"].contains(name));
        let mut sum = vec![0.0; half];
        for (_, part) in at_rest {
            for (sum, part) in sum.iter_mut().zip(part) {
                *sum += part;
            }
        }
        let row = &scene.rows[0];
        let mass = Material::default().density * PI / 6.0 * row.ball_diameter.powi(3);
        let orbit = model.rolling_speeds(0).0;
        for ball in (2..model.body_count()).map(|body| 4 * body) {
            let radius = y[ball].hypot(y[ball + 1]);
            let outwards = (sum[ball] * y[ball] + sum[ball + 1] * y[ball + 1]) / radius;
            let centrifugal = mass * orbit * orbit * radius;
            let left = (outwards + centrifugal).hypot(sum[ball + 2]);
            // A ball weighs 0.07 N.
            assert!(left < 1e-2, "{axial}, {ball}: {left}");
        }
    }
}
