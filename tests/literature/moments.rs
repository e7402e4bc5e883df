//! Moments that rings which are kept from tilting carry: statics against catalogues and trials outside the crate, and the same
//! in a run.

use crate::common;
use std::f64::consts::FRAC_PI_2;

use ballrace::scene::{Drive, Load, Mount, Probe, RingName, Row, Scene, Support};
use ballrace::{equilibrium, simulate};
use common::{meets, short};

/// One row between a held outer and a free inner ring: Hertz, at rest, without gravity. Lengths in mm.
fn at_rest(row: Row, loads: &[([f64; 3], f64)]) -> Scene {
    let mut scene = Scene::new(vec![row], Drive::Speed(0.0.into()));
    scene.inner_ring.mass = Some(1.0);
    scene.gravity = [0.0; 3];
    for (k, (direction, force)) in loads.iter().enumerate() {
        let load = Load::new(RingName::Inner, *direction, *force);
        scene.loads.insert(format!("load{k}"), load);
    }
    scene
}

/// A 6205 under 500 N along −y and 300 N along z, a ball on the load line.
fn combined() -> Scene {
    let mut row = Row::new(9, 7.94e-3, 39.04e-3, 0.525, 0.515);
    (row.clearance, row.start_angle) = (10e-6, -FRAC_PI_2);
    at_rest(row, &[([0.0, -1.0, 0.0], 500.0), ([0.0, 0.0, 1.0], 300.0)])
}

/// Truth: computed outside this crate from the formulas of a tilting ring.
#[test]
fn a_6205_under_combined_load_carries_a_moment() {
    let found = equilibrium(&combined()).unwrap();
    let [about_x, about_y] = found.inner_moment;
    let most = found.balls.iter().map(|ball| ball.inner.load);
    meets("6205 held, M_x, N m (computed)", 2.539, about_x, 0.003);
    let most = most.fold(0.0, f64::max);
    meets("6205 held, Q_max, N (computed)", 255.8, most, 0.003);
    // The outer ring carries the opposite, about its own centre.
    assert!((found.outer_moment[0] + about_x).abs() < 0.02 * about_x);
    assert!(about_y.abs() < 1e-9 * about_x);
}

/// Truth: the pressure centre of catalogues, (d_m/2) tan α from the row's plane: of a 7210 B a − B/2 = 29.4 mm.
#[test]
fn the_pressure_centre_of_a_7210_is_that_of_catalogues() {
    let mut row = Row::new(14, 12.4e-3, 70e-3, 0.525, 0.525);
    row.contact_angle = 40_f64.to_radians();
    let radial = 100.0;
    let scene = at_rest(row, &[([1.0, 0.0, 0.0], radial), ([0.0, 0.0, 1.0], radial)]);
    let [about_x, about_y] = equilibrium(&scene).unwrap().inner_moment;
    let place = about_x.hypot(about_y) / radial;
    meets("7210 B, pressure centre, m", 29.4e-3, place, 0.015);
}

/// Limits: a bearing whose balls press along radii carries no moment.
#[test]
fn a_radial_load_makes_none() {
    let mut scene = combined();
    scene.loads.remove("load1");
    let found = equilibrium(&scene).unwrap();
    for moment in [found.outer_moment, found.inner_moment].as_flattened() {
        assert!(moment.abs() < 1e-12, "{moment}");
    }
}

/// Truth: the equilibrium. A run that begins there and where nothing moves records the same, whatever it leaves out.
#[test]
fn a_run_records_the_moments_of_its_state() {
    let mut scene = combined();
    let damped = Mount::Spring {
        stiffness: 0.0,
        damping: 1e3,
    };
    scene.inner_ring.support = Support::new([
        Some(damped.clone()),
        Some(damped.clone()),
        Some(damped),
        None,
    ]);
    scene.probes = [("m".to_owned(), Probe::moments())].into();
    let found = equilibrium(&scene).unwrap();
    let out = simulate(&scene, &short(1e-4)).unwrap();
    let columns = ["outer.x", "outer.y", "inner.x", "inner.y"];
    let [outer, inner] = [found.outer_moment, found.inner_moment];
    for (name, truth) in columns.iter().zip([outer, inner].as_flattened()) {
        for value in out.get(&format!("m.{name}")).unwrap() {
            assert!((value - truth).abs() < 1e-5, "{name}: {value} {truth}");
        }
    }
}
