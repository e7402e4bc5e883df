//! Caps of balls in a whole bearing: what a run may leave out beside them, and what rings feel that may tilt.

use ballrace::dynamics::rhs;
use ballrace::inspect;
use ballrace::scene::{
    Cap, Defect, Drive, Friction, Mount, NormalLaw, Pit, Row, Scene, Slices, Support, Surface,
};
use ballrace::{Model, Race, Start, compile, explain, start};

/// Two rows of five balls back to back, pressed apart between rings that are free in all directions.
fn free_rings(law: &NormalLaw) -> Scene {
    let row = |side: i8| {
        let mut row = Row::new(5, 9e-3, 40e-3, 0.53, 0.52);
        (row.contact_angle, row.side) = (20_f64.to_radians(), side);
        row.axial_position = -f64::from(side) * 8e-3;
        row.axial_preload = 20e-6;
        // Both contacts of every ball are pressed.
        row.clearance = -60e-6;
        row
    };
    let drive = Drive::Torque {
        value: 0.0.into(),
        initial_speed: 150.0,
    };
    let mut scene = Scene::new(vec![row(1), row(-1)], drive);
    scene.rows[1].start_angle = 0.4;
    (scene.contact.law, scene.contact.damping) = (law.clone(), 0.0);
    scene.contact.slices = Slices::Fitted(24);
    scene.gravity = [0.0; 3];
    let free = || Some(Mount::Free);
    for ring in [&mut scene.outer_ring, &mut scene.inner_ring] {
        ring.support = Support::new([free(), free(), free(), free()]);
        (ring.support.tilt_x, ring.support.tilt_y) = (free(), free());
        (ring.mass, ring.inertia, ring.transverse_inertia) = (Some(0.2), Some(1e-4), Some(7e-5));
    }
    scene
}

/// Ball 0 of row 0 at its start, with a cap beside its contact with the outer or the inner race.
fn with_cap(scene: Scene, race: Race) -> Scene {
    let cap = Defect::of(
        Cap::of_width(1.2e-3).edge_radius(0.2e-3),
        Surface::Ball,
        0.06,
    )
    .at_offset(0.15e-3);
    with_round(scene, race, cap)
}

/// The same with a pit in its contact.
fn with_pit(scene: Scene, race: Race) -> Scene {
    let pit = Defect::of(Pit::of_width(0.3e-3).length(0.5e-3), Surface::Ball, 0.01);
    with_round(scene, race, pit.at_offset(0.1e-3))
}

/// With a round defect of ball 0 whose place is given from where it meets a race.
fn with_round(mut scene: Scene, race: Race, mut defect: Defect) -> Scene {
    let row = &scene.rows[0];
    let outwards = if race == Race::Outer {
        0.0
    } else {
        std::f64::consts::PI
    };
    let sign = if race == Race::Outer { 1.0 } else { -1.0 };
    let contact = sign * f64::from(row.side) * row.ball_diameter / 2.0 * row.contact_angle.sin();
    defect.angle += row.start_angle + outwards;
    let beside = defect.axial_offset.number().unwrap();
    let defect = defect.at_offset(contact + beside);
    scene.defects.insert("round".to_owned(), defect);
    scene
}

/// A state in which everything moves and the rings tilt by 0.3 mrad.
fn stirred(model: &Model) -> Vec<f64> {
    let mut y = start(model, &Start::Rolling).unwrap();
    let names = model.names();
    let at = |name: &str| names.iter().position(|n| n == name).unwrap();
    for (k, ring) in ["outer", "inner"].into_iter().enumerate() {
        let sign = 1.0 - 1.7 * k as f64;
        for (place, size, speed) in [
            ("x", 1e-6, 0.02),
            ("y", -1e-6, -0.03),
            ("z", 0.5e-6, 0.04),
            ("tilt_x", 3e-4, 3.0),
            ("tilt_y", -2e-4, -2.0),
        ] {
            let i = at(&format!("{ring}.{place}"));
            y[i] = size;
            y[i + names.len() / 2] = speed * sign;
        }
    }
    y
}

/// Truth: the energy, differentiated along the motion. Without friction and damping nothing is lost, whether a cap is met outside or
/// inside, by rings that tilt.
#[test]
fn a_cap_between_tilted_rings_keeps_energy() {
    for law in [NormalLaw::Hertz, NormalLaw::iso16281()] {
        for race in Race::BOTH {
            for (scene, least) in [
                (with_cap(free_rings(&law), race), 1e3),
                (with_pit(free_rings(&law), race), 10.0),
            ] {
                let model = compile(&scene).unwrap();
                let y = stirred(&model);
                let mut dy = vec![0.0; y.len()];
                rhs(&model, 0.0, &y, &mut dy);
                let energy = |h: f64| {
                    let moved: Vec<f64> = y.iter().zip(&dy).map(|(y, d)| y + h * d).collect();
                    inspect::energy(&model, &moved).unwrap().total()
                };
                let h = 2e-9;
                let rate = (8.0 * (energy(h) - energy(-h)) - energy(2.0 * h) + energy(-2.0 * h))
                    / (12.0 * h);
                let mut healthy = scene.clone();
                healthy.defects.clear();
                let mut other = vec![0.0; y.len()];
                rhs(&compile(&healthy).unwrap(), 0.0, &y, &mut other);
                let half = y.len() / 2;
                let moved = |i: usize| (dy[half + i] - other[half + i]).abs();
                let met = (0..half).map(moved).fold(0.0, f64::max);
                println!("{law:?} {race:?}: {rate:e} W, {met} m/s²");
                assert!(met > least, "{law:?} {race:?}: {met}");
                assert!(rate.abs() < 1e-4, "{law:?} {race:?}: {rate} W");
            }
        }
    }
}

/// A level bearing stays in its plane beside a cap in the middle of a ball, and leaves it beside one off the middle.
#[test]
fn a_cap_in_the_middle_keeps_the_plane() {
    let mut scene = ballrace::scene::presets::deep_groove_6205(500.0, 0.0, 1800.0);
    scene.friction = Friction::None;
    let with = |offset: f64| {
        let mut scene = scene.clone();
        let cap = Defect::of(Cap::of_width(1e-3).edge_radius(0.3e-3), Surface::Ball, 0.0)
            .at_offset(offset);
        scene.defects.insert("pit".to_owned(), cap);
        let text = explain(&scene).unwrap().to_string();
        println!("{text}");
        text
    };
    let off = "a ball's defect is off the middle";
    assert!(!with(0.0).contains(off) && with(0.2e-3).contains(off));
}
