//! Stiffness and load distribution over a turn of the cage, against closed forms, textbooks and the static solve itself.
//!
//! | what | source |
//! |---|---|
//! | stiffness under thrust | analytic: the derivative of Harris' relation of thrust and shift |
//! | stiffness of loaded bearings | central differences of the equilibrium |
//! | Q_max = 4.37 F/(Z cos α), J₁ = 0.5625, J₂ = 0.5875 | R. Stribeck; T. A. Harris, *Rolling Bearing Analysis*, load zone ε = 0.5 |

use crate::common;
use std::f64::consts::{FRAC_PI_2, TAU};

use ballrace::contact::hertz::Hertz;
use ballrace::scene::{
    Defect, Load, Material, Mount, NormalLaw, Patch, RingName, Scene, Support, Surface,
    TimeFunction, presets,
};
use ballrace::{Error, Stiffness, equilibrium, load_distribution, stiffness};
use common::meets;
use nalgebra::{SMatrix, SVector};

/// One row at rest between a held outer and a free inner ring: Hertz, no gravity, no cage, no clearance.
fn still(z: usize, degrees: f64, radial: f64, axial: f64) -> Scene {
    let mut scene = presets::deep_groove_6205(radial, axial, 0.0);
    let row = &mut scene.rows[0];
    (row.ball_count, row.ball_diameter, row.pitch_diameter) = (z, 4e-3, 130e-3);
    (row.outer_conformity, row.inner_conformity) = (0.52, 0.53);
    (row.contact_angle, row.clearance) = (degrees.to_radians(), 0.0);
    row.start_angle = -FRAC_PI_2;
    for ring in [&mut scene.outer_ring, &mut scene.inner_ring] {
        (ring.diameter, ring.width, ring.mass) = (None, None, Some(1.0));
        ring.support = Support::default();
    }
    (scene.cage, scene.gravity) = (None, [0.0; 3]);
    scene.contact.law = NormalLaw::Hertz;
    scene
}

/// Truth: analytic. Groove centres at a distance s, A without load, carry Q = K (s − A)^{3/2} along their line; the sum
/// over the balls differentiated by the inner ring's place. Held at its angle, a ball sees the ring's sidewise moves
/// turn the load of its inner contact.
#[test]
fn stiffness_under_thrust_is_the_derivative_of_harris_relation() {
    for (degrees, thrust) in [(15.0, 200.0), (40.0, 5000.0), (25.0, 1.0)] {
        let z = 20;
        let scene = still(z, degrees, 0.0, thrust);
        let found = stiffness(&scene).unwrap();
        let row = &scene.rows[0];
        let steel = Material::default();
        let compliance = |sigma: f64, conformity: f64| {
            let (d, pitch) = (row.ball_diameter, row.pitch_diameter);
            Hertz::new(
                sigma,
                d,
                pitch,
                conformity,
                row.contact_angle,
                &steel,
                &steel,
            )
            .stiffness
            .powf(-2.0 / 3.0)
        };
        let k = (compliance(1.0, row.outer_conformity) + compliance(-1.0, row.inner_conformity))
            .powf(-1.5);
        let apart = (row.outer_conformity + row.inner_conformity - 1.0) * row.ball_diameter;
        let (sin, cos) = row.contact_angle.sin_cos();
        let shift = found.equilibrium.inner[2].abs();
        let s = (apart * cos).hypot(apart * sin + shift);
        let (cos, sin) = (apart * cos / s, (apart * sin + shift) / s);
        let q = k * (s - apart).powf(1.5);
        let count = z as f64;
        meets("thrust carried", thrust, count * q * sin, 1e-8);
        let slope = 1.5 * q / (s - apart);
        let axial = count * (slope * sin * sin + q / s * cos * cos);
        let sideways = q * cos / found.equilibrium.balls[0].radius;
        let radial = count / 2.0 * (slope * cos * cos + q / s * sin * sin - sideways);
        meets("axial stiffness", axial, found.inner[2][2], 1e-8);
        meets("radial stiffness", radial, found.inner[0][0], 1e-6);
        meets("the other way", radial, found.inner[1][1], 1e-6);
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            assert!(found.inner[i][j].abs() < 1e-9 * radial);
        }
    }
}

/// Adds a small load on the inner ring and returns how both rings answer, per newton, by central differences.
fn answer(scene: &Scene, direction: usize, step: f64) -> SVector<f64, 6> {
    let at = |force: f64| {
        let mut scene = scene.clone();
        let mut along = [0.0; 3];
        along[direction] = 1.0;
        let load = Load::new(RingName::Inner, along, TimeFunction::Constant(force));
        scene.loads.insert("probe".to_owned(), load);
        let found = equilibrium(&scene).unwrap();
        SVector::<f64, 6>::from_fn(|i, _| [found.outer, found.inner][i / 3][i % 3])
    };
    (at(step) - at(-step)) / (2.0 * step)
}

fn matrix(found: &Stiffness) -> SMatrix<f64, 6, 6> {
    SMatrix::from_fn(|i, j| found.rings[i][j])
}

/// Truth: the static solve itself. Stiffness and supports times the answer to a load are that load; symmetric, and
/// positive definite with one ring held.
#[test]
fn stiffness_is_the_slope_of_the_equilibrium() {
    let mut wheel = presets::wheel_bearing(3000.0);
    wheel.cage = None;
    let mut spalled = presets::deep_groove_6205(500.0, 200.0, 1800.0);
    spalled.cage = None;
    let spall = Defect::of(
        Patch::of_width(0.3e-3).length(4e-3).edge_radius(0.1e-3),
        Surface::InnerRace,
        -FRAC_PI_2,
    )
    .at_offset(0.0);
    spalled.defects.insert("spall".to_owned(), spall);
    let caged = presets::deep_groove_6205(500.0, 200.0, 1800.0);
    let fast = presets::deep_groove_6205(500.0, 200.0, 12_000.0);
    // The cage's pull changes with the radii of all balls of a row; the stiffness takes each ball's alone.
    for (name, scene, bound) in [
        ("thrust and radial", still(11, 20.0, 300.0, 400.0), 1e-5),
        ("wheel bearing without cage", wheel, 1e-4),
        ("spalled 6205", spalled, 1e-5),
        ("6205", caged, 1e-3),
        ("6205 at speed", fast, 1e-2),
    ] {
        let found = stiffness(&scene).unwrap();
        let mut held = matrix(&found);
        assert_eq!(held, held.transpose());
        assert!(
            held.fixed_view::<3, 3>(3, 3)
                .into_owned()
                .cholesky()
                .is_some()
        );
        for (i, ring) in [&scene.outer_ring, &scene.inner_ring]
            .into_iter()
            .enumerate()
        {
            let mounts = [&ring.support.x, &ring.support.y, &ring.support.z];
            for (j, mount) in mounts.into_iter().enumerate() {
                let absent = if i == 0 { Mount::Fixed } else { Mount::Free };
                held[(3 * i + j, 3 * i + j)] += match mount.as_ref().unwrap_or(&absent) {
                    Mount::Spring { stiffness, .. } => *stiffness,
                    Mount::Fixed => 1e30,
                    _ => 0.0,
                };
            }
        }
        for direction in 0..3 {
            let moved = answer(&scene, direction, 0.3);
            let load = (held * moved).fixed_rows::<3>(3).into_owned();
            let wanted = SVector::<f64, 3>::ith(direction, 1.0);
            let error = (load - wanted).norm();
            println!("{name}, {direction}: {error:.1e}");
            assert!(error < bound, "{name}, {direction}: {load}");
        }
    }
}

/// Truth: symmetry, and Stribeck's and Harris' integrals at half a load zone, which many balls under next to no load reach.
#[test]
fn equivalent_loads_of_thrust_and_of_half_a_load_zone() {
    let thrust = load_distribution(&still(15, 30.0, 0.0, 500.0), 3).unwrap();
    let load = thrust.equilibria[0].balls[0].inner.load;
    let balls = thrust.equilibria.iter().flat_map(|found| &found.balls);
    for q in balls.flat_map(|ball| [ball.outer.load, ball.inner.load]) {
        meets("under thrust all are equal", load, q, 1e-8);
    }
    meets("outer", load, thrust.equivalent[0].outer, 1e-8);
    meets("inner", load, thrust.equivalent[0].inner, 1e-8);

    let (z, radial) = (61, 0.1);
    let found = load_distribution(&still(z, 0.0, radial, 0.0), 2).unwrap();
    let q_max = found.equilibria[0].balls[0].inner.load;
    meets("Stribeck", 4.37, q_max * z as f64 / radial, 1e-3);
    meets("Harris J1", 0.5625, found.equivalent[0].inner / q_max, 2e-3);
    meets("Harris J2", 0.5875, found.equivalent[0].outer / q_max, 2e-3);
}

/// Truth: symmetry. Turned by a pitch, a bearing of equal balls is the same bearing; one odd ball asks for a whole turn.
#[test]
fn a_pitch_shows_all_of_equal_balls() {
    let scene = presets::deep_groove_6205(500.0, 100.0, 1800.0);
    let one = load_distribution(&scene, 4).unwrap();
    assert_eq!(one.turn.len(), 4);
    let mut turned = scene.clone();
    turned.rows[0].start_angle += TAU / 9.0;
    let after = equilibrium(&turned).unwrap();
    for j in 0..9 {
        let (a, b) = (&after.balls[j], &one.equilibria[0].balls[(j + 1) % 9]);
        assert!((a.inner.load - b.inner.load).abs() < 1e-6);
    }
    let mut odd = scene;
    odd.rows[0].diameter_errors = vec![0.0; 9];
    odd.rows[0].diameter_errors[0] = 1e-6;
    let whole = load_distribution(&odd, 4).unwrap();
    assert_eq!(whole.turn.len(), 36);
    assert!(whole.equivalent[0].inner > one.equivalent[0].inner);
    let refused = load_distribution(&odd, 0).unwrap_err();
    assert!(matches!(&refused, Error::Argument { path, .. } if path == "positions"));
}
