//! Defaults of a scene written from scratch, and the doubts about numbers that no bearing has.
//!
//! Truth: catalogue-like bearings of all sizes are ordinary, and the same numbers in another unit are not; Hertz's law
//! without saying so; what is held does not move.

use crate::common;
use std::f64::consts::{FRAC_PI_2, PI};

use ballrace::scene::{
    Cage, CageRing, Cap, Component, Contact, ContactQuantity, ContactsProbe, Defect, Doubt, Drive,
    Friction, Material, Moment, MotionProbe, Mount, NormalLaw, Patch, Pit, Probe, Ring, RingName,
    Scene, Spin, Support, Surface, TableForce, Texture, Unbalance, presets,
};
use ballrace::{Equilibrium, Warning, equilibrium, explain, load_distribution};
use common::{Noise, run, short};

/// A 6205 as someone writes it who knows its catalogue page.
const HANDWRITTEN: &str = r#"
name = "my 6205"
[[rows]]
ball_count = 9
ball_diameter = 7.94e-3
pitch_diameter = 39.04e-3
outer_conformity = 0.525
inner_conformity = 0.515
start_angle = -1.5707963267948966
[inner_ring]
mass = 1.0
[drive]
speed = 188.5
[loads.radial]
ring = "inner"
direction = [0.0, -1.0, 0.0]
force = 500.0
"#;

fn handwritten() -> Scene {
    Scene::from_toml(HANDWRITTEN).unwrap()
}

/// Literature: 500 N on a 6205 press its rings together by 8.9 µm by Hertz, the paper's law gives 25.7 µm.
#[test]
fn a_scene_that_names_no_law_has_hertz() {
    let mut scene = handwritten();
    assert_eq!(Contact::default().law, NormalLaw::Hertz);
    assert_eq!(scene.contact.law, NormalLaw::Hertz);
    let approach = |scene: &Scene| -1e6 * equilibrium(scene).unwrap().inner[1];
    let hertz = approach(&scene);
    assert!((hertz - 8.9).abs() < 0.1, "{hertz} µm");
    scene.contact.law = NormalLaw::iso16281();
    let paper = approach(&scene);
    assert!((paper - 25.7).abs() < 0.1, "{paper} µm");
    let preset = presets::wheel_bearing(3000.0);
    assert_eq!(preset.contact.law, NormalLaw::iso16281());
}

/// Analytic: the reported approaches are those of the static solve and of Hertz's F = K δ^{3/2}.
#[test]
fn explain_says_what_a_law_implies() {
    let mut scene = handwritten();
    let explanation = explain(&scene).unwrap();
    let law = explanation.law.as_ref().unwrap();
    assert_eq!(
        (&law.law, law.contact.as_str()),
        (&NormalLaw::Hertz, "row0.ball0.outer")
    );
    assert!(
        (law.approach / law.hertz_approach - 1.0).abs() < 1e-3,
        "{law}"
    );
    assert!(
        explanation
            .to_string()
            .contains("law        Hertz's point contact: under ")
    );

    scene.contact.law = NormalLaw::iso16281();
    let explanation = explain(&scene).unwrap();
    let law = explanation.law.as_ref().unwrap();
    let ball = &equilibrium(&scene).unwrap().balls[0];
    assert_eq!(
        (law.load, law.approach),
        (ball.outer.load, ball.outer.deflection)
    );
    assert_eq!(law.pressure, ball.outer.pressure);
    let ratio = law.approach / law.hertz_approach;
    assert!((2.5..3.2).contains(&ratio), "{law}");
    let sentence = format!("{ratio:.2} × Hertz's");
    assert!(explanation.to_string().contains(&sentence), "{explanation}");
}

/// Names of the columns of a short run.
fn columns(scene: &Scene) -> Vec<String> {
    let out = run(scene, &short(1e-4));
    out.columns.into_iter().map(|c| c.name).collect()
}

#[test]
fn without_probes_what_can_move_is_recorded() {
    // The outer ring is fixed where the scene does not mention it: the inner one moves.
    let mut scene = handwritten();
    let inner = columns(&scene);
    assert_eq!(inner.len(), 12);
    assert!(
        inner.iter().all(|name| name.starts_with("inner.")),
        "{inner:?}"
    );
    // Sprung along y only: nothing but y is recorded.
    scene.outer_ring = Ring::default();
    let ring = &mut scene.outer_ring;
    ring.mass = Some(0.1);
    ring.support.y = Some(Mount::Spring {
        stiffness: 1e8,
        damping: 300.0,
    });
    assert_eq!(columns(&scene), ["outer.y", "outer.vy", "outer.ay"]);
    // Both rings held: what the balls carry.
    let fixed = Some(Mount::Fixed);
    scene.outer_ring.support = Support::default();
    scene.inner_ring.support = Support::new([fixed.clone(), fixed.clone(), fixed, None]);
    scene.rows[0].clearance = -4e-6;
    let loads = columns(&scene);
    assert_eq!(loads.len(), 18);
    assert_eq!(
        loads[..2],
        ["row0.ball0.outer.load", "row0.ball0.inner.load"]
    );
    let out = run(&scene, &short(1e-4));
    assert!(out.columns.iter().all(|c| c.values[0] > 0.0));
    assert!(out.warnings().is_empty(), "{:?}", out.warnings());
}

fn motion(body: &str, components: Option<&[Component]>) -> Probe {
    let all = MotionProbe::of(body);
    match components {
        Some(components) => all.components(components).into(),
        None => all.into(),
    }
}

#[test]
fn columns_that_cannot_change_are_doubted() {
    let mut scene = handwritten();
    let mut doubts_of = |probe: Probe| {
        scene.probes = [("p".to_owned(), probe)].into();
        let texts: Vec<String> = scene.doubts().iter().map(ToString::to_string).collect();
        texts.join("\n")
    };
    let all = doubts_of(motion("outer", None));
    assert!(
        all.starts_with("probes.p = p.x, p.y, p.z, p.theta, p.vx, "),
        "{all}"
    );
    assert!(
        all.contains("holds outer along x, along y, along z, about z"),
        "{all}"
    );
    let one = doubts_of(motion("outer", Some(&[Component::Ay])));
    assert!(
        one.starts_with("probes.p = p.ay: these columns never change"),
        "{one}"
    );
    assert_eq!(doubts_of(motion("inner", None)), "");
    assert_eq!(doubts_of(motion("row0.ball8", None)), "");
    assert!(doubts_of(Probe::cage(0)).contains("no cage"));

    // Along x and y it moves, along z it is held; a given speed turns the inner ring.
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    scene.outer_ring.support.z = Some(Mount::Fixed);
    let texts: Vec<String> = scene.doubts().iter().map(ToString::to_string).collect();
    assert_eq!(texts.len(), 1);
    assert!(
        texts[0].starts_with("probes.outer = outer.z, outer.vz, outer.az: "),
        "{texts:?}"
    );
    scene.rows[0].ball_support.x = Some(Mount::Fixed);
    scene.probes = [("b".to_owned(), motion("row0.ball2", Some(&[Component::X])))].into();
    assert_eq!(scene.doubts()[0].path, "probes.b");
    // A run says so, too.
    let out = run(&scene, &short(1e-4));
    assert!(matches!(&out.warnings()[..], [Warning::Doubtful(d)] if d.path == "probes.b"));
    assert_eq!(out.warnings()[0].category(), "scene");
}

/// Bore, ball diameter and pitch diameter \[mm\], balls, contact angle \[°\], 1/min, clearance \[µm\].
type Size = (f64, f64, f64, usize, f64, f64, f64);

/// Catalogue-like bearings from 2 mm to 1 m bore, thin, heavy, fast, loose and angular.
const SIZES: [Size; 16] = [
    (2.0, 1.0, 3.5, 7, 0.0, 100e3, 20.0),
    (2.38, 1.0, 4.2, 7, 12.0, 420e3, 0.0),
    (3.0, 2.0, 6.5, 6, 0.0, 50e3, 37.0),
    (8.0, 3.969, 15.0, 7, 0.0, 30e3, 10.0),
    (17.0, 12.7, 39.5, 6, 0.0, 10e3, 20.0),
    (25.0, 7.94, 39.04, 9, 0.0, 18e3, 48.0),
    (40.0, 11.9, 60.0, 14, 40.0, 12e3, 0.0),
    (50.0, 19.05, 80.0, 8, 0.0, 6e3, 30.0),
    (100.0, 7.94, 112.5, 24, 0.0, 6e3, 40.0),
    (100.0, 25.4, 140.0, 10, 0.0, 4e3, 60.0),
    (101.6, 3.175, 104.8, 60, 30.0, 1e3, 30.0),
    (120.0, 20.6, 155.0, 15, 24.0, 18e3, 0.0),
    (260.0, 57.0, 370.0, 11, 0.0, 1e3, 230.0),
    (500.0, 30.0, 560.0, 34, 0.0, 500.0, 350.0),
    (1000.0, 64.0, 1110.0, 32, 0.0, 100.0, 600.0),
    (1000.0, 120.0, 1210.0, 18, 0.0, 100.0, 700.0),
];

/// A bearing of a size under a load over ISO 76's C₀ ≈ 14 N/mm² Z D² cos α.
fn of_size(size: Size, share: f64) -> Scene {
    let (bore, ball, pitch, count, degrees, turns, clearance) = size;
    let angle = degrees.to_radians();
    let rating = 14.0 * count as f64 * ball * ball * angle.cos();
    let mut scene = presets::deep_groove_6205(share * rating, 0.1 * share * rating, turns);
    let row = &mut scene.rows[0];
    (row.ball_count, row.contact_angle) = (count, angle);
    (row.ball_diameter, row.pitch_diameter) = (1e-3 * ball, 1e-3 * pitch);
    (row.outer_conformity, row.inner_conformity) = (0.53, 0.52);
    row.clearance = 1e-6 * clearance;
    // The standards' boundary; as wide as a ball and a third.
    let (outer, width) = (2.0 * pitch - bore, 1.3e-3 * ball);
    scene.outer_ring.diameter = Some(1e-3 * outer);
    (scene.inner_ring.diameter, scene.inner_ring.mass) = (Some(1e-3 * bore), None);
    (scene.outer_ring.width, scene.inner_ring.width) = (Some(width), Some(width));
    scene
}

/// Doubts but for those about balls at their speed, at which some of these sizes slide: the fastest of their kinds under
/// light loads (`tests/python/test_axis.py` has ordinary speeds).
fn of_numbers(found: &Equilibrium) -> Vec<&Doubt> {
    let of_speed = |path: &str| path == "spin" || path.starts_with("row 0, ");
    let doubts = found.doubts.iter();
    doubts.filter(|doubt| !of_speed(&doubt.path)).collect()
}

#[test]
fn ordinary_bearings_raise_no_doubt() {
    for scene in [
        presets::wheel_bearing(0.0),
        presets::wheel_bearing(3000.0),
        presets::wheel_bearing(-3000.0),
        presets::deep_groove_6205(500.0, 0.0, 1800.0),
    ] {
        assert_eq!(equilibrium(&scene).unwrap().doubts, []);
        let warnings = run(&scene, &short(2e-4)).warnings();
        let doubtful = |warning: &&Warning| matches!(warning, Warning::Doubtful(_));
        assert_eq!(warnings.iter().find(doubtful), None);
    }
    for size in SIZES {
        let scene = of_size(size, 0.2);
        assert_eq!(scene.doubts(), [], "{size:?}");
        let found = equilibrium(&scene).unwrap();
        assert!(
            of_numbers(&found).is_empty(),
            "{size:?}: {:?}",
            found.doubts
        );
        assert!(found.largest_pressure() > 1e9, "{size:?}");
    }
}

#[test]
fn a_load_beyond_the_static_rating_is_doubted() {
    for size in SIZES {
        let found = equilibrium(&of_size(size, 2.0)).unwrap();
        let paths: Vec<_> = of_numbers(&found).iter().map(|d| &d.path).collect();
        assert_eq!(paths, ["contact pressure"], "{size:?}");
    }
    let out = run(&of_size(SIZES[5], 2.0), &short(2e-4));
    let pressure = out.stats.largest_pressure;
    assert!(pressure > 4.2e9);
    assert!(matches!(&out.warnings()[..], [Warning::Doubtful(d)]
        if d.to_string().starts_with(&format!("contact pressure = {:.2} GPa", 1e-9 * pressure))));
}

/// A change of the scene, and the path that has to be doubted.
type Slip = (&'static str, fn(&mut Scene));

/// Numbers in the wrong unit, one each, that validation lets pass.
const SLIPS: &[Slip] = &[
    ("rows[0].pitch_diameter", |s| {
        s.rows[0].pitch_diameter *= 1e3;
        s.rows[0].ball_diameter *= 1e3;
    }),
    ("rows[0].ball_diameter", |s| {
        (s.rows[0].ball_diameter, s.rows[0].pitch_diameter) = (0.25, 1.0);
    }),
    ("rows[0].ball_diameter / pitch_diameter", |s| {
        s.rows[0].ball_diameter = 0.3e-3;
        s.defects.clear();
    }),
    ("rows[0].inner_conformity", |s| {
        s.rows[0].inner_conformity = 0.8;
    }),
    ("rows[0].outer_conformity", |s| {
        s.rows[0].outer_conformity = 0.5001;
    }),
    ("rows[0].axial_position", |s| {
        s.rows[0].axial_position = 11.0;
    }),
    ("rows[0].clearance", |s| s.rows[0].clearance = 1e-3),
    ("rows[0].axial_preload", |s| s.rows[0].axial_preload = 1e-3),
    ("rows[0].start_angle", |s| s.rows[0].start_angle = -90.0),
    ("rows[0].diameter_errors", |s| {
        s.rows[0].diameter_errors = vec![1e-4; 9];
    }),
    ("rows[0].ball_mass", |s| s.rows[0].ball_mass = Some(2.06)),
    ("rows[0].ball_inertia", |s| {
        s.rows[0].ball_inertia = Some(1.3e-2);
    }),
    ("outer_ring.width", |s| s.outer_ring.width = Some(15.0)),
    ("outer_ring.diameter", |s| {
        s.outer_ring.diameter = Some(52.0);
    }),
    ("inner_ring.mass", |s| s.inner_ring.mass = Some(1500.0)),
    ("outer_ring.mass", |s| s.outer_ring.mass = Some(60e-6)),
    ("materials.balls.density", |s| {
        s.materials.balls.density = 7.85;
    }),
    ("materials.rings.youngs_modulus", |s| {
        s.materials.rings.youngs_modulus = 206e3;
    }),
    ("defects.a.angle", |s| {
        s.defects.get_mut("a").unwrap().angle = -90.0;
    }),
    ("friction.coulomb.coefficient", |s| {
        s.friction = Friction::Coulomb {
            coefficient: 5.0,
            slip_speed: 0.1,
        };
    }),
    ("friction.coulomb.slip_speed", |s| {
        s.friction = Friction::Coulomb {
            coefficient: 0.05,
            slip_speed: 100.0,
        };
    }),
    ("friction.traction.largest coefficient", |s| {
        s.friction = Friction::Traction {
            a: 0.0,
            b: 10.0,
            c: 1.0,
            d: 0.0,
            slip_speed: 0.1,
        };
    }),
    ("cage.play", |s| {
        s.cage = Some(Cage::new(1e6, 20.0, 0.1));
    }),
    ("cage.ring.stiffness", |s| {
        let mut ring = CageRing::default();
        (ring.stiffness, ring.friction) = (Some(1e8), 0.0);
        s.cage = Some(Cage::ring(ring));
    }),
    ("cage.ring.friction", |s| {
        let mut ring = CageRing::default();
        (ring.stiffness, ring.friction) = (Some(1e6), 0.2);
        s.cage = Some(Cage::ring(ring));
    }),
    ("drive.speed", |s| {
        s.drive = Drive::Speed((180_000.0).into());
    }),
    ("gravity", |s| s.gravity = [0.0, -9810.0, 0.0]),
    ("unbalances.a.moment", |s| {
        s.unbalances.get_mut("a").unwrap().moment = 2.0;
    }),
    ("unbalances.a.angle", |s| {
        s.unbalances.get_mut("a").unwrap().angle = 90.0;
    }),
    ("rows[0].clearance", |s| s.rows[0].clearance = -100e-6),
    ("contact.damping", |s| s.contact.damping = 20.0),
    ("defects.a.width", |s| {
        s.defects.get_mut("a").unwrap().damage.set_width(1e-6);
    }),
    ("drive.speed", |s| {
        s.drive = Drive::Speed((29.95 * PI / 30.0).into());
    }),
    // A 6205 at 3500.5 and a 6310 at 1797 and 1797.5 turns a minute, given as radians a second.
    ("drive.speed", |s| s.drive = Drive::Speed(3500.5.into())),
    ("drive.speed", |s| {
        of_a_6310(s);
        s.drive = Drive::Speed(1797.0.into());
    }),
    ("drive.speed", |s| {
        of_a_6310(s);
        s.drive = Drive::Speed(1797.5.into());
    }),
    ("loads.radial.force", |s| {
        s.unbalances.clear();
        s.loads.get_mut("radial").unwrap().force = 1.5.into();
    }),
    // A 6310 that was given the rings of a bearing of 60 × 130 mm.
    ("rows[0].pitch_diameter", |s| {
        of_a_6310(s);
        (s.inner_ring.diameter, s.outer_ring.diameter) = (Some(60e-3), Some(130e-3));
    }),
];

fn of_a_6310(scene: &mut Scene) {
    let row = &mut scene.rows[0];
    (row.ball_count, row.ball_diameter, row.pitch_diameter) = (8, 19.05e-3, 80e-3);
}

/// Fields that have no effect in their scene, one each.
const LOST: &[Slip] = &[
    ("loads.radial.at", |s| {
        s.loads.get_mut("radial").unwrap().at = Some([0.0, 0.0, -60e-3]);
    }),
    ("moments.a", |s| {
        let moment = Moment::new(RingName::Inner, [1.0, 0.0, 0.0], 5.0);
        s.moments.insert("a".to_owned(), moment);
    }),
    ("moments.a", |s| {
        let moment = Moment::new(RingName::Outer, [0.0, 0.0, 2.0], 5.0);
        s.moments.insert("a".to_owned(), moment);
    }),
    ("rows[0].axial_preload", |s| {
        s.rows[0].axial_preload = 10e-6;
    }),
    ("thrust on the inner ring", |s| {
        s.rows[0].contact_angle = 40_f64.to_radians();
        s.loads.get_mut("axial").unwrap().force = (-800.0).into();
    }),
    ("materials.balls.youngs_modulus", |s| {
        s.contact.law = NormalLaw::iso16281();
        s.materials.balls.youngs_modulus = 310e9;
    }),
    ("rows[0].ball_material.youngs_modulus", |s| {
        s.contact.law = NormalLaw::iso16281();
        s.rows[0].ball_material = Some(Material::new(3200.0, 310e9, 0.26));
    }),
    ("defects.a.on", |s| {
        let defect = s.defects.get_mut("a").unwrap();
        (defect.on, defect.ball) = (Surface::Ball, Some(0));
        s.loads.get_mut("axial").unwrap().force = 800.0.into();
    }),
];

fn with_everything() -> Scene {
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let spall = presets::wheel_bearing(0.0).defects["spall"].clone();
    scene.defects.insert("a".to_owned(), spall);
    scene.defects.get_mut("a").unwrap().axial_offset = 0.0.into();
    let unbalance = Unbalance::new(RingName::Inner, 1e-4, 0.0);
    scene.unbalances.insert("a".to_owned(), unbalance);
    for ring in [&mut scene.outer_ring, &mut scene.inner_ring] {
        (ring.diameter, ring.mass) = (None, Some(0.5));
    }
    scene
}

#[test]
fn numbers_in_another_unit_and_fields_without_effect_are_reported() {
    assert_eq!(with_everything().doubts(), []);
    for (path, slip) in SLIPS.iter().chain(LOST) {
        let mut scene = with_everything();
        slip(&mut scene);
        let doubts = scene.doubts();
        assert!(doubts.iter().any(|d| d.path == *path), "{path}: {doubts:?}");
        scene.validate().unwrap_or_else(|e| panic!("{path}: {e}"));
    }
}

/// No doubt comes from what an engineer may well write: drawn within what the module says is usual.
#[test]
fn scenes_drawn_within_the_usual_raise_no_doubt() {
    let mut noise = Noise(11);
    for _ in 0..300 {
        let mut scene = with_everything();
        let scale = 10_f64.powf(noise.between(-1.0, 1.4));
        let row = &mut scene.rows[0];
        row.ball_diameter *= scale;
        row.pitch_diameter *= scale;
        row.outer_conformity = noise.between(0.506, 0.58);
        row.inner_conformity = noise.between(0.506, 0.58);
        row.clearance = noise.between(-0.01, 0.015) * row.ball_diameter;
        row.start_angle = noise.between(-2.0 * PI, 2.0 * PI);
        scene.outer_ring.mass = Some(noise.between(0.02, 2.0) * scale.powi(3));
        scene.inner_ring.mass = Some(noise.between(0.02, 2.0) * scale.powi(3));
        // Up to 2.8 million mm/min; from where deep groove bearings end on with a contact angle.
        let speed = noise.between(10.0, 7.5e3);
        row.contact_angle = if speed < 3.2e3 { 0.0 } else { 0.3 };
        scene.drive = Drive::Speed((speed / scale).into());
        scene.materials.balls = Material::default();
        let material = &mut scene.materials.balls;
        material.density = noise.between(3200.0, 7850.0);
        material.youngs_modulus = noise.between(200e9, 315e9);
        assert_eq!(scene.doubts(), []);
    }
}

/// Literature: a maker's limiting speed of a 6205 is 18 000 1/min. 1797 rad/s are 17 160, whole number or not, and no doubt
/// follows; the doubt of a faster one says both ways to read its number.
#[test]
fn speeds_that_bearings_run_at_are_not_taken_for_turns_a_minute() {
    let at = |speed: f64| {
        let mut scene = with_everything();
        scene.drive = Drive::Speed(speed.into());
        scene.doubts()
    };
    for speed in [1797.0, 1797.5, 18e3 * PI / 30.0] {
        assert_eq!(at(speed), [], "{speed}");
    }
    let text = at(3500.0)[0].to_string();
    for part in [
        "drive.speed = 3500 rad/s: 33420 1/min",
        "3500 1/min would be 366.5 rad/s",
    ] {
        assert!(text.contains(part), "{text}");
    }
}

/// What engineers simulate: bearings of all sizes under usual loads and speeds, held and preloaded as they are meant to be.
#[test]
fn machines_drawn_at_random_raise_no_doubt() {
    let mut noise = Noise(39);
    for case in 0..500 {
        let size = SIZES[case % SIZES.len()];
        let mut scene = of_size(size, noise.between(0.005, 0.4));
        let (speed, angle) = (scene.drive.initial_speed(), scene.rows[0].contact_angle);
        // From a twentieth of the fastest that is usual.
        scene.drive = Drive::Speed((speed * noise.between(0.05, 1.0)).into());
        let radial = scene.loads["radial"].force.peak();
        let thrust = radial * noise.between(0.0, 0.4) + 1.3 * radial * angle.tan();
        scene.loads.get_mut("axial").unwrap().force = thrust.into();
        scene.contact.damping = noise.between(0.02, 1.0);
        let row = &mut scene.rows[0];
        row.clearance = noise.between(-0.002, 0.01) * row.ball_diameter;
        let width = noise.between(0.05, 0.5) * row.ball_diameter;
        let on = [Surface::OuterRace, Surface::InnerRace, Surface::Ball][case % 3];
        if on == Surface::Ball && angle > 0.0 {
            scene.spin = Some(Spin::Free);
        }
        let mut defect = Defect::of(
            Patch::of_width(width)
                .length(width)
                .edge_radius(0.1 * width),
            on,
            noise.between(-PI, PI),
        );
        defect.ball = (on == Surface::Ball).then_some(0);
        if scene.spin.is_some() {
            defect = Defect::of(
                Cap::of_width(width).edge_radius(0.1 * width),
                Surface::Ball,
                0.0,
            )
            .on_ball(0);
        }
        scene.defects.insert("a".to_owned(), defect.at_offset(0.0));
        if case % 4 == 0 {
            // A shaft that bends may tilt.
            let tilts = Some(Mount::Free);
            let support = &mut scene.inner_ring.support;
            (support.tilt_x, support.tilt_y) = (tilts.clone(), tilts);
            scene.loads.get_mut("radial").unwrap().at = Some([0.0, 0.0, -60e-3]);
        }
        if case % 5 == 0 {
            // Preloaded between rings that are held.
            scene.rows[0].axial_preload = noise.between(1e-6, 20e-6);
            scene.probes.clear();
            for ring in [&mut scene.outer_ring, &mut scene.inner_ring] {
                ring.support.z = Some(Mount::Fixed);
            }
        }
        scene.validate().unwrap();
        assert_eq!(scene.doubts(), [], "case {case}: {size:?}");
    }
}

/// Textures that no finished race has.
#[test]
fn rough_textures_are_doubted() {
    let is_doubted = |outer: f64, slope: f64| {
        let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        let mut texture = Texture::of_races(1e-9);
        (texture.outer, texture.slope) = (outer, slope);
        scene.rows[0].texture = Some(texture);
        let doubts = scene.doubts();
        doubts
            .iter()
            .any(|doubt| doubt.path == "rows[0].texture.outer")
    };
    assert!(
        !is_doubted(5e-9, 2.0)
            && is_doubted(21e-9, 2.0)
            && is_doubted(6e-9, 2.0)
            && is_doubted(1e-9, 3.0)
    );
}

/// A force by a table on a ring that is held along it does nothing.
#[test]
fn a_table_of_forces_on_a_held_ring_is_doubted() {
    let is_doubted = |direction: [f64; 3]| {
        let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        let table = TableForce::new(RingName::Outer, direction, [-1e-5, 1e-5], [10.0, -10.0]);
        scene.outer_ring.support.y = Some(Mount::Free);
        (scene.outer_ring.support.x, scene.outer_ring.support.z) = (None, None);
        scene.table_forces.insert("seal".to_owned(), table);
        let path = "table_forces.seal.direction";
        scene.doubts().iter().any(|doubt| doubt.path == path)
    };
    assert!(is_doubted([1.0, 0.0, 0.0]) && is_doubted([1.0, 0.0, 1.0]));
    assert!(!is_doubted([0.0, 1.0, 0.0]) && !is_doubted([1.0, 0.1, 0.0]));
}

/// Slots narrower than 1.3 contacts, which fault circles take for less than they are; pits are not doubted.
#[test]
fn defects_narrower_than_their_contact_are_doubted() {
    let is_doubted = |defect: Defect| {
        let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        scene.rows[0].start_angle = -FRAC_PI_2;
        scene.defects.insert("slot".to_owned(), defect);
        let found = explain(&scene).unwrap();
        let width = found.defects[0].contact_width.unwrap();
        // 2b of Hertz's ellipse, 0.24 mm under 250 N.
        assert!((0.2e-3..0.3e-3).contains(&width), "{width:e}");
        let is_of_width = |doubt: &ballrace::scene::Doubt| doubt.path == "defects.slot.width";
        let in_a_run = run(&scene, &short(2e-3)).warnings();
        let of_run = in_a_run
            .iter()
            .any(|of| matches!(of, Warning::Doubtful(doubt) if is_of_width(doubt)));
        assert_eq!(found.doubts.iter().any(is_of_width), of_run);
        of_run
    };
    let slot = |width: f64| {
        Defect::of(
            Patch::of_width(width).length(2e-3).edge_radius(0.3e-3),
            Surface::OuterRace,
            -FRAC_PI_2,
        )
    };
    assert!(is_doubted(slot(0.178e-3)) && !is_doubted(slot(0.5e-3)));
    assert!(!is_doubted(Defect::of(
        Pit::of_width(0.178e-3),
        Surface::OuterRace,
        -FRAC_PI_2
    )));
}

/// Truth: the doubts of statics over a turn of the cage are the scene's own, wherever the turn starts.
#[test]
fn a_turn_of_the_cage_raises_no_doubt() {
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    scene.rows[0].start_angle = 1.9 * PI;
    scene.rows[0].diameter_errors = vec![1e-7, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let found = load_distribution(&scene, 1).unwrap();
    assert!(*found.turn.last().unwrap() > PI);
    assert!(found.equilibria.iter().all(|at| at.doubts.is_empty()));
}

/// Analytic: pressures of the statics are Hertz's of their own loads, under either law.
#[test]
fn pressures_belong_to_the_loads() {
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    for law in [NormalLaw::iso16281(), NormalLaw::Hertz] {
        scene.contact.law = law;
        scene.rows[0].start_angle = -FRAC_PI_2;
        let found = equilibrium(&scene).unwrap();
        let loaded = &found.balls[0];
        // The inner groove curves against the ball: the smaller contact, the higher pressure.
        assert!(loaded.inner.pressure > loaded.outer.pressure);
        assert_eq!(found.largest_pressure(), loaded.inner.pressure);
        // p₀ ∝ F^{1/3}.
        let other = &found.balls[1];
        let expected = (other.inner.load / loaded.inner.load).cbrt();
        assert!((other.inner.pressure / loaded.inner.pressure / expected - 1.0).abs() < 1e-12);
        // The top ball touches the outer race only.
        assert_eq!(found.balls[4].inner.pressure, 0.0);
        // A run begins there; a contact probe reads the same load.
        scene.probes = [(
            "c".to_owned(),
            ContactsProbe::of_row(0)
                .balls([0])
                .quantities([ContactQuantity::Load])
                .into(),
        )]
        .into();
        let out = run(&scene, &short(1e-4));
        assert!((out.stats.largest_pressure / loaded.inner.pressure - 1.0).abs() < 1e-2);
    }
}
