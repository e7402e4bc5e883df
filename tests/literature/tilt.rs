//! Equilibria and stiffness of rings that tilt.
//!
//! | what | source |
//! |---|---|
//! | Z 7, D 11.5, d_m 43.5, tilt free | printed results of MASTA in the tests of a public ISO/TS 16281 code; there a tilt is linear |
//! | 6205, 218 | computed outside this crate from the formulas of a tilting ring, and in closed form |
//! | pure moment | slewing-ring catalogues, Q_max = 4.37 M/(Z d_m sin α) |
//! | eccentric thrust | H. Sjövall 1933, J. Rumbarger 1962: load integral J_a at ε = 1 |

use crate::common;
use std::f64::consts::FRAC_PI_2;

use ballrace::scene::presets::Arrangement;
use ballrace::scene::{
    CoupledSupport, Drive, Load, Method, Moment, Mount, RingName, Row, Scene, Support, presets,
};
use ballrace::{Equilibrium, equilibrium, simulate, stiffness};
use common::{meets, short};

/// One row or more between a held outer and an inner ring that is free to tilt: Hertz, at rest, without gravity.
fn tilting(rows: Vec<Row>) -> Scene {
    let mut scene = Scene::new(rows, Drive::Speed(0.0.into()));
    scene.inner_ring.mass = Some(1.0);
    let support = &mut scene.inner_ring.support;
    (support.tilt_x, support.tilt_y) = (Some(Mount::Free), Some(Mount::Free));
    scene.gravity = [0.0; 3];
    scene
}

fn load(scene: &mut Scene, name: &str, direction: [f64; 3], force: f64) {
    let load = Load::new(RingName::Inner, direction, force);
    scene.loads.insert(name.to_owned(), load);
}

/// A 6205 under 500 N along −y and 300 N along z, a ball on the load line.
fn combined() -> Scene {
    let mut row = Row::new(9, 7.94e-3, 39.04e-3, 0.525, 0.515);
    (row.clearance, row.start_angle) = (10e-6, -FRAC_PI_2);
    let mut scene = tilting(vec![row]);
    load(&mut scene, "radial", [0.0, -1.0, 0.0], 500.0);
    load(&mut scene, "axial", [0.0, 0.0, 1.0], 300.0);
    scene
}

fn loads(found: &Equilibrium) -> Vec<f64> {
    found.balls.iter().map(|ball| ball.inner.load).collect()
}

/// Truth: computed, and printed where a tilt is linear.
#[test]
fn masta_combined_with_a_free_tilt() {
    let mut row = Row::new(7, 11.5e-3, 43.5e-3, 0.53, 0.52);
    row.clearance = 10e-6;
    let mut scene = tilting(vec![row]);
    scene.materials.balls.youngs_modulus = 210e9;
    scene.materials.rings.youngs_modulus = 210e9;
    load(&mut scene, "radial", [1.0, 0.0, 0.0], 1000.0);
    load(&mut scene, "axial", [0.0, 0.0, 1.0], 1000.0);
    let found = equilibrium(&scene).unwrap();
    let [x, _, z] = found.inner.map(|place| place * 1e6);
    let [tilt_x, tilt_y] = found.inner_tilt;
    let tilt = 1e3 * tilt_x.hypot(tilt_y);
    meets(
        "MASTA tilting, radial shift, µm (computed)",
        19.898,
        x,
        2e-3,
    );
    meets(
        "MASTA tilting, axial shift, µm (computed)",
        146.418,
        z,
        2e-3,
    );
    meets("MASTA tilting, tilt, mrad (computed)", 2.715, tilt, 2e-3);
    meets("MASTA tilting, radial shift, µm", 19.592, x, 0.02);
    meets("MASTA tilting, axial shift, µm", 146.46, z, 1e-3);
    meets("MASTA tilting, tilt, mrad", 2.687, tilt, 0.02);
    let published = [1026.9, 774.1, 476.8, 448.7, 448.7, 476.8, 774.1];
    for (j, (load, published)) in loads(&found).into_iter().zip(published).enumerate() {
        meets(
            &format!("MASTA tilting, Q {j}, N (computed)"),
            published,
            load,
            2e-3,
        );
    }
}

/// Truth: computed. Parallel rings hide a moment; free, the heaviest ball carries a third more.
#[test]
fn a_6205_under_combined_load_tilts() {
    let found = equilibrium(&combined()).unwrap();
    let [tilt, aside] = found.inner_tilt;
    meets("6205 free, tilt, mrad (computed)", 2.239, 1e3 * tilt, 3e-3);
    meets(
        "6205 free, y, µm (computed)",
        -14.18,
        1e6 * found.inner[1],
        3e-3,
    );
    meets(
        "6205 free, z, µm (computed)",
        79.66,
        1e6 * found.inner[2],
        3e-3,
    );
    let published = [344.0, 255.6, 123.3, 85.1, 109.3, 109.3, 85.1, 123.3, 255.6];
    for (j, (load, published)) in loads(&found).into_iter().zip(published).enumerate() {
        meets(
            &format!("6205 free, Q {j}, N (computed)"),
            published,
            load,
            3e-3,
        );
    }
    assert!(aside.abs() < 1e-9 * tilt);
    // What is free carries no moment.
    assert!(found.inner_moment.iter().all(|moment| moment.abs() < 1e-6));
    assert!(found.residual_share < 1e-8, "{}", found.residual_share);
}

/// Truth: the held bearing. The moment that it carries, as a load against it, leaves a ring that is free where it was held.
#[test]
fn the_moment_of_a_held_ring_is_the_load_that_frees_it() {
    let mut scene = combined();
    let support = &mut scene.inner_ring.support;
    (support.tilt_x, support.tilt_y) = (None, None);
    let held = equilibrium(&scene).unwrap();
    let [x, y] = held.inner_moment;
    let mut freed = combined();
    let against = Moment::new(RingName::Inner, [-x, -y, 0.0], x.hypot(y));
    freed.moments.insert("hold".to_owned(), against);
    let free = equilibrium(&freed).unwrap();
    assert!(free.inner_tilt.iter().all(|tilt| tilt.abs() < 1e-9));
    for (a, b) in loads(&held).into_iter().zip(loads(&free)) {
        assert!((a - b).abs() < 1e-5 * a, "{a} {b}");
    }
    // The same by a force off the centre.
    let mut off = combined();
    let axial = off.loads.get_mut("axial").unwrap();
    *axial = axial.clone().at([y / 300.0, -x / 300.0, 0.0]);
    let free = equilibrium(&off).unwrap();
    assert!(free.inner_tilt.iter().all(|tilt| tilt.abs() < 1e-9));
}

/// Truth: in closed form for a row under thrust, computed.
#[test]
fn stiffness_of_a_218_with_tilts() {
    let mut row = Row::new(16, 22.23e-3, 125.26e-3, 0.5232, 0.5232);
    row.contact_angle = 40_f64.to_radians();
    let mut scene = tilting(vec![row]);
    load(&mut scene, "axial", [0.0, 0.0, 1.0], 17_800.0);
    let found = stiffness(&scene).unwrap();
    let k = found.inner_spatial;
    meets("218 K_xx, N/m (computed)", 4.850e8, k[0][0], 1e-3);
    meets("218 K_zz, N/m (computed)", 7.651e8, k[2][2], 1e-3);
    meets("218 K_ττ, N m/rad (computed)", 1.5015e6, k[3][3], 1e-3);
    meets("218 K_x,τy, N/rad (computed)", -2.617e7, k[0][4], 1e-3);
    meets("218 K_y,τx, N/rad (computed)", 2.617e7, k[1][3], 1e-3);
    for i in 0..5 {
        for j in 0..5 {
            assert!((k[i][j] - k[j][i]).abs() < 1e-9 * k[i][i].max(k[j][j]));
        }
    }
    // The same of a bearing that does not tilt; and its own in the plane.
    scene.inner_ring.support = Support::default();
    let held = stiffness(&scene).unwrap();
    for i in 0..3 {
        for j in 0..3 {
            assert_eq!(held.inner[i][j], held.inner_spatial[i][j]);
        }
    }
    let apart = (held.inner_spatial[3][3] / k[3][3] - 1.0).abs();
    assert!(apart < 1e-6, "{apart}");
}

/// Truth: the solve itself. The stiffness says how a little more load moves and tilts the ring.
#[test]
fn stiffness_is_the_slope_of_the_solution() {
    let scene = combined();
    let k = stiffness(&scene).unwrap().inner_spatial;
    let mut more = scene.clone();
    let moment = Moment::new(RingName::Inner, [1.0, 0.0, 0.0], 1e-3);
    more.moments.insert("more".to_owned(), moment);
    let [from, to] = [&scene, &more].map(|scene| equilibrium(scene).unwrap());
    let moved: Vec<f64> = (0..5)
        .map(|i| match i {
            0..3 => to.inner[i] - from.inner[i],
            _ => to.inner_tilt[i - 3] - from.inner_tilt[i - 3],
        })
        .collect();
    let answer = |i: usize| (0..5).map(|j| k[i][j] * moved[j]).sum::<f64>();
    println!("{:?}", [0, 1, 2, 3, 4].map(answer));
    assert!((answer(3) / 1e-3 - 1.0).abs() < 1e-3, "{}", answer(3));
    assert!(answer(4).abs() < 1e-5 && answer(2).abs() < 1e-2);
}

/// Truth: catalogues of slewing rings, 4.37 M/(Z d_m sin α); and Sjövall's integral under eccentric thrust.
#[test]
fn slewing_rings_carry_moments_as_catalogues_say() {
    let (count, pitch, angle) = (60, 250e-3, 45_f64.to_radians());
    let row = |side: i8| {
        let mut row = Row::new(count, 12e-3, pitch, 0.53, 0.53);
        (row.contact_angle, row.side) = (angle, side);
        row
    };
    let heaviest = |found: &Equilibrium| loads(found).into_iter().fold(0.0, f64::max);
    let mut scene = tilting(vec![row(1), row(-1)]);
    let moment = Moment::new(RingName::Inner, [1.0, 0.0, 0.0], 5.0);
    scene.moments.insert("pure".to_owned(), moment);
    let share = heaviest(&equilibrium(&scene).unwrap()) * f64::from(60) * pitch * angle.sin() / 5.0;
    meets("pure moment, Q_max Z d_m sin α/M", 4.37, share, 2e-3);
    let mut scene = tilting(vec![row(1)]);
    let support = &mut scene.inner_ring.support;
    (support.x, support.y) = (Some(Mount::Fixed), Some(Mount::Fixed));
    let thrust = Load::new(RingName::Inner, [0.0, 0.0, 1.0], 60.0);
    let thrust = thrust.at([0.6 * pitch / 2.0, 0.0, 0.0]);
    scene.loads.insert("thrust".to_owned(), thrust);
    let most = heaviest(&equilibrium(&scene).unwrap());
    let integral = 60.0 / (f64::from(60) * angle.sin() * most);
    meets("eccentric thrust, J_a at ε = 1", 0.4244, integral, 3e-3);
}

/// Truth: the springs. Those of a tilt, single or coupled, carry what balls and loads put on the ring; coupled ones at a place of
/// the axis hold places too.
#[test]
fn springs_of_tilts_carry_moments() {
    let mut scene = combined();
    let spring = Mount::Spring {
        stiffness: 800.0,
        damping: 0.0,
    };
    scene.inner_ring.support.tilt_x = Some(spring);
    let single = equilibrium(&scene).unwrap();
    let carried = 800.0 * single.inner_tilt[0];
    // But for the cosine of the tilt.
    meets(
        "moment on a tilt spring, N m",
        carried,
        single.inner_moment[0],
        1e-5,
    );
    scene.inner_ring.support.tilt_x = Some(Mount::Free);
    let mut stiff = [[0.0; 6]; 6];
    stiff[3][3] = 800.0;
    scene.inner_ring.support.coupled = Some(Box::new(CoupledSupport::new(stiff)));
    let coupled = equilibrium(&scene).unwrap();
    assert!((coupled.inner_tilt[0] / single.inner_tilt[0] - 1.0).abs() < 1e-8);
    // A spring along y at an arm holds the tilt like one of arm² as much, and pulls besides.
    let mut along = CoupledSupport::new([[0.0; 6]; 6]);
    (along.stiffness[1][1], along.axial_position) = (2e6, 0.02);
    scene.inner_ring.support.coupled = Some(Box::new(along));
    let arm = equilibrium(&scene).unwrap();
    let pulled = 2e6 * (arm.inner[1] - 0.02 * arm.inner_tilt[0]);
    let moment = -0.02 * pulled;
    meets(
        "moment on a spring at an arm, N m",
        moment,
        arm.inner_moment[0],
        1e-4,
    );
}

/// Errors name the tilt that nothing holds: about the line through two balls.
#[test]
fn a_tilt_that_nothing_holds_is_named() {
    let mut scene = combined();
    scene.loads.remove("radial");
    scene.rows[0].ball_count = 2;
    scene.inner_ring.support.x = Some(Mount::Fixed);
    let message = equilibrium(&scene).unwrap_err().to_string();
    println!("{message}");
    assert!(message.contains("nothing holds inner.tilt_y"), "{message}");
}

/// Truth: the balance of moments. The side force of a cornering wheel acts at its tyre, and the wheel's ring tilts by it; at the
/// bearing's centre the same forces hardly tilt it.
#[test]
fn a_cornering_wheel_tilts() {
    for (lateral, least) in [(0.3, 2e-3), (0.6, 4e-3)] {
        let at_tyre = presets::cornering_wheel(lateral);
        let mut centred = at_tyre.clone();
        for load in centred.loads.values_mut() {
            load.at = None;
        }
        let [tyre, centre] = [&at_tyre, &centred].map(|scene| equilibrium(scene).unwrap());
        let heaviest = |found: &Equilibrium| loads(found).into_iter().fold(0.0, f64::max);
        println!(
            "{lateral} g: {:?} mrad, {} N; centred {:?} mrad, {} N",
            tyre.inner_tilt.map(|tilt| 1e3 * tilt),
            heaviest(&tyre),
            centre.inner_tilt.map(|tilt| 1e3 * tilt),
            heaviest(&centre)
        );
        assert!(tyre.inner_tilt[0].abs() > least && tyre.inner_tilt[0].abs() < 0.05);
        assert!(centre.inner_tilt[0].abs() < 0.5 * tyre.inner_tilt[0].abs());
        assert!(heaviest(&tyre) > heaviest(&centre));
        assert!(tyre.inner_moment[0].abs() < 1e-3);
    }
}

/// Truth: the equilibrium. A run begins there, tilted, and stays.
/// Analytic: the moment of the overhung load is what the pair carries, and lines of contact that part bear it on the longer lever.
#[test]
fn a_pair_back_to_back_is_stiffer_than_face_to_face() {
    let found = [Arrangement::BackToBack, Arrangement::FaceToFace].map(|arrangement| {
        let mut scene = presets::angular_contact_pair(arrangement, 500.0, 300.0, 2900.0);
        scene.gravity = [0.0; 3];
        let found = equilibrium(&scene).unwrap();
        let moment = found.outer_moment[0].abs();
        assert!((moment - 30.0).abs() < 0.1, "{arrangement:?}: {moment} N m");
        let heaviest = found
            .balls
            .iter()
            .map(|ball| ball.outer.load)
            .fold(0.0, f64::max);
        (found.inner_tilt[0].abs(), heaviest)
    });
    println!("{found:?}");
    let [(back, least), (face, most)] = found;
    // Levers to the pressure centres, about d_m/2 tan 40° + 7.5 mm and less 7.5 mm: their squares are as 6.4 to 1 at rest.
    assert!((3.5..6.4).contains(&(face / back)), "{}", face / back);
    assert!((1.6..2.2).contains(&(most / least)), "{}", most / least);
}

#[test]
fn a_run_begins_tilted() {
    let mut scene = combined();
    let damped = |damping| {
        Some(Mount::Spring {
            stiffness: 0.0,
            damping,
        })
    };
    let support = &mut scene.inner_ring.support;
    (support.x, support.y, support.z) = (damped(1e3), damped(1e3), damped(1e3));
    (support.tilt_x, support.tilt_y) = (damped(0.1), damped(0.1));
    scene.solver.method = Method::DormandPrince;
    let solved = equilibrium(&scene).unwrap().inner_tilt[0];
    let out = simulate(&scene, &short(3e-4)).unwrap();
    for tilt in out.get("inner.tilt_x").unwrap() {
        assert!((tilt / solved - 1.0).abs() < 1e-5, "{tilt} {solved}");
    }
}
