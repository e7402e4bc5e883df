//! Runs leave out what does not change the motion: the reduced model against the full one.

use crate::common;
use std::f64::consts::{FRAC_PI_2, PI};

use ballrace::compile;
use ballrace::dynamics::Dynamics;
use ballrace::dynamics::contributions;
use ballrace::dynamics::rhs;
use ballrace::inspect;
use ballrace::integrate::System;
use ballrace::scene::{
    Defect, Drive, Friction, Mount, NormalLaw, Patch, Profile, Scene, Slices, Surface,
    TimeFunction, Waviness, Width, WidthProfile, presets,
};
use ballrace::{Bandwidth, Model, Race, Reduction, Run, Start, simulate, start};
use common::{Noise, effects, oiled, patch};

/// A healthy deep-groove bearing under a radial load.
fn plane(law: NormalLaw, friction: bool) -> Scene {
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    scene.contact.law = law;
    if !friction {
        scene.friction = Friction::None;
    }
    scene
}

/// Two rows of an angular bearing back to back, in phase.
fn mirrored() -> Scene {
    let mut scene = presets::wheel_bearing(0.0);
    scene.defects.clear();
    scene.rows[1].start_angle = scene.rows[0].start_angle;
    scene
}

fn spall(on: Surface, axial_offset: f64) -> Defect {
    let mut defect = Defect::of(
        Patch::of_width(0.8e-3).length(1.5e-3).edge_radius(0.3e-3),
        on,
        if on == Surface::Ball { PI } else { -FRAC_PI_2 },
    )
    .at_offset(axial_offset);
    defect.ball = (on == Surface::Ball).then_some(0);
    defect
}

type Change = fn(&mut Scene);

/// The equilibrium, or the nominal places where there is none.
fn begin(model: &Model) -> Vec<f64> {
    start(model, &Start::Equilibrium)
        .or_else(|_| start(model, &Start::Rolling))
        .unwrap()
}

fn reduction(scene: &Scene) -> Reduction {
    let model = compile(scene).unwrap();
    let y0 = begin(&model);
    Reduction::of(&model, &y0).unwrap()
}

/// Largest difference between the accelerations of the reduced and of the full model at random states that have the
/// symmetries of the scene, as force over the load of the contacts and 1 kN.
fn difference(scene: &Scene) -> f64 {
    let model = compile(scene).unwrap();
    let y0 = begin(&model);
    let mut dynamics = Dynamics::reduced(&model, Reduction::of(&model, &y0).unwrap(), &y0);
    let mut own = vec![0.0; dynamics.dim()];
    let (mut full, mut rates, mut wanted) = (y0.clone(), y0.clone(), y0.clone());
    let (mut noise, mut worst) = (Noise(7), 0.0_f64);
    let half = y0.len() / 2;
    for k in 0..30 {
        let t = 1e-4 * f64::from(k);
        // Shaken bodies; what the scene keeps in place or ties together comes back by expanding.
        let mut shaken = y0.clone();
        for i in 0..half {
            let (place, speed) = if i % 4 < 3 { (10e-6, 0.2) } else { (0.5, 5.0) };
            shaken[i] += place * noise.next();
            shaken[half + i] += speed * noise.next();
        }
        let y = dynamics.compress(&shaken);
        dynamics.expand(t, &y, &mut full);
        dynamics.rhs(t, &y, &mut own);
        rates.copy_from_slice(&full);
        dynamics.expand_rates(t, &own, &mut rates);
        rhs(&model, t, &full, &mut wanted);
        let loads: f64 = (0..model.body_count() - 2)
            .flat_map(|j| {
                Race::BOTH.map(|race| inspect::contact(&model, &full, j, race).unwrap().load)
            })
            .sum();
        let forces = contributions(&model, t, &full);
        for i in 0..half {
            assert_eq!(rates[i], wanted[i], "speed {i}");
            let total: f64 = forces.iter().map(|(_, part)| part[i]).sum();
            // The inertia that the scene gave the direction.
            let inertia = if wanted[half + i] == 0.0 {
                1.0
            } else {
                total / wanted[half + i]
            };
            let lever = if i % 4 == 3 { 6e-3 } else { 1.0 };
            let apart = (rates[half + i] - wanted[half + i]).abs() * inertia.abs();
            worst = worst.max(apart / (lever * (loads + 1e3)));
        }
    }
    worst
}

fn whats(reduction: &Reduction) -> Vec<&str> {
    reduction
        .omissions()
        .iter()
        .map(|o| o.what.as_str())
        .collect()
}

/// Those in oil.
fn scenes_in_oil() -> Vec<(&'static str, Scene, usize)> {
    let hertz = || NormalLaw::Hertz;
    let iso = NormalLaw::iso16281;
    let mut scenes = Vec::new();
    scenes.push(("plane in oil, Hertz", oiled(plane(hertz(), true)), 62));
    scenes.push(("plane in oil, ISO", oiled(plane(iso(), true)), 62));
    let mut scene = oiled(plane(hertz(), false));
    effects(scene.lubricant.as_mut().unwrap(), "film");
    scenes.push(("plane with a film alone", scene.clone(), 44));
    effects(scene.lubricant.as_mut().unwrap(), "rolling");
    scenes.push(("plane, rolling is resisted", scene, 62));
    scenes.push((
        "two rows for one in oil",
        oiled(mirrored()),
        2 * (4 * 13 + 4),
    ));
    let mut scene = oiled(mirrored());
    for (name, row, offset) in [("one", 0, 1e-3), ("two", 1, -1e-3)] {
        let mut defect = spall(Surface::OuterRace, offset);
        defect.row = row;
        scene.defects.insert(name.to_owned(), defect);
    }
    scenes.push((
        "two rows in oil with images of a spall",
        scene,
        2 * (4 * 13 + 4),
    ));
    scenes
}

/// Those whose outer ring turns.
fn hubs() -> Vec<(&'static str, Scene, usize)> {
    let mut damaged = plane(NormalLaw::Hertz, false);
    let defect = spall(Surface::OuterRace, 0.0);
    damaged.defects.insert("spall".to_owned(), defect);
    let scenes = [
        ("a hub with a spall", damaged, 44),
        ("a hub", plane(NormalLaw::Hertz, true), 62),
        ("a hub, two rows for one", mirrored(), 2 * (4 * 13 + 4)),
    ];
    let ramp = Profile::Ramp {
        from: 50.0,
        to: -200.0,
        start: 0.0,
        end: 2e-3,
    };
    let turned = scenes.map(|(name, mut scene, kept)| {
        scene.outer_speed = Some(TimeFunction::Profile(ramp.clone()));
        (name, scene, kept)
    });
    turned.into()
}

/// Scenes by name, with the states that a run keeps of them.
fn scenes() -> Vec<(&'static str, Scene, usize)> {
    let hertz = || NormalLaw::Hertz;
    let iso = NormalLaw::iso16281;
    let mut scenes = Vec::new();
    // 9 balls and two rings in x and y.
    scenes.push(("plane, Hertz", plane(hertz(), false), 44));
    scenes.push(("plane, ISO", plane(iso(), false), 44));
    // Balls turn as well.
    scenes.push(("plane, Hertz, friction", plane(hertz(), true), 62));
    for slices in [
        Slices::Fitted(6),
        Slices::Fitted(5),
        Slices::Fixed(70),
        Slices::Fixed(71),
    ] {
        for law in [iso(), hertz()] {
            let mut scene = plane(law, true);
            scene.contact.slices = slices;
            scenes.push(("plane, friction", scene, 62));
        }
    }
    let mut scene = plane(iso(), false);
    scene.contact.slices = Slices::Fixed(70);
    scenes.push(("plane, slices without friction", scene, 44));
    let mut scene = plane(iso(), false);
    (scene.contact.damping, scene.contact.clamp_pull) = (20.0, true);
    scenes.push(("plane, damping that is clamped", scene, 44));
    let mut scene = plane(hertz(), false);
    (scene.contact.damping, scene.contact.clamp_pull) = (20.0, false);
    scenes.push(("plane, damping that pulls", scene, 44));
    let mut scene = plane(iso(), false);
    scene.rows[0].inner_shoulders = Some([0.15, 0.15]);
    scenes.push(("plane, a zone that meets the shoulders", scene, 44));
    for on in [Surface::OuterRace, Surface::InnerRace, Surface::Ball] {
        let mut scene = plane(hertz(), false);
        let mut defect = spall(on, 0.0);
        *patch(&mut defect).1 = Width::Profile(WidthProfile::new(
            vec![-1e-3, 0.0, 1e-3],
            vec![0.2e-3, 0.9e-3, 0.2e-3],
        ));
        scene.defects.insert("spall".to_owned(), defect);
        // A ball with a defect is turned by its edges.
        let spin = if on == Surface::Ball { 2 } else { 0 };
        scenes.push(("plane, a spall in the middle", scene, 44 + spin));
    }
    let mut scene = plane(hertz(), false);
    scene.rows[0].outer_waviness = vec![Waviness::new(5, 2e-6, 0.1)];
    scene.rows[0].diameter_errors = (0..9).map(|j| 1e-6 * f64::from(j % 3)).collect();
    scenes.push(("plane, waves and unequal balls", scene, 44));
    let mut scene = plane(hertz(), false);
    scene.drive = Drive::Speed(TimeFunction::Profile(Profile::Sine {
        mean: 100.0,
        amplitude: 30.0,
        frequency: 40.0,
        phase: 0.4,
    }));
    scene.unbalances.insert(
        "shaft".to_owned(),
        ballrace::scene::Unbalance::new(ballrace::scene::RingName::Inner, 1e-3, 0.2),
    );
    scenes.push(("plane, a speed that changes", scene, 44));
    let mut thrust = presets::deep_groove_6205(500.0, 300.0, 1800.0);
    thrust.friction = Friction::None;
    scenes.push(("thrust without friction", thrust, 66));
    let mut scene = plane(hertz(), false);
    scene.drive = Drive::Torque {
        value: 1.0.into(),
        initial_speed: 100.0,
    };
    scenes.push(("plane, driven by a torque", scene, 46));
    // 13 balls in four directions, rings in x and y.
    scenes.push(("two rows for one", mirrored(), 2 * (4 * 13 + 4)));
    let mut scene = mirrored();
    for (name, row, offset) in [("one", 0, 1e-3), ("two", 1, -1e-3)] {
        let mut defect = spall(Surface::OuterRace, offset);
        defect.row = row;
        scene.defects.insert(name.to_owned(), defect);
    }
    scenes.push(("two rows with images of a spall", scene, 2 * (4 * 13 + 4)));
    let mut scene = mirrored();
    scene.friction = Friction::None;
    for row in &mut scene.rows {
        row.contact_angle = 0.0;
    }
    scenes.push(("two level rows", scene, 2 * (2 * 13 + 4)));
    scenes.extend(scenes_in_oil());
    scenes.extend(hubs());
    let mut scene = plane(hertz(), false);
    scene.rows[0].ball_support.x = Some(Mount::Fixed);
    scenes.push(("balls held in one direction", scene, 2 * (9 + 4)));
    scenes
}

/// Analytic: one motion, evaluated with and without what does not change it.
#[test]
fn reduced_and_full_accelerations_agree() {
    for (name, scene, kept) in scenes() {
        let found = reduction(&scene);
        let worst = difference(&scene);
        println!(
            "{name}: {} states, {worst:.1e}, without {:?}",
            found.dim(),
            whats(&found)
        );
        assert_eq!(found.dim(), kept, "{name}");
        assert!(worst < 1e-12, "{name}: {worst:.1e}");
    }
}

/// Analytic: random scenes, whatever a reduction finds in them.
#[test]
fn random_scenes_agree() {
    let mut noise = Noise(3);
    let mut reduced = 0;
    for case in 0..40 {
        let mut scene = if noise.yes() {
            mirrored()
        } else {
            plane(NormalLaw::Hertz, true)
        };
        if noise.yes() {
            scene.friction = Friction::None;
        }
        if noise.yes() {
            scene.contact.law = NormalLaw::iso16281();
        }
        if noise.yes() {
            scene.contact.slices = Slices::Fixed(50);
        }
        if noise.yes() {
            scene.cage = None;
        }
        if noise.yes() {
            let on = [Surface::OuterRace, Surface::InnerRace, Surface::Ball][case % 3];
            let offset = if noise.yes() { 0.0 } else { 0.2e-3 };
            scene.defects.insert("spall".to_owned(), spall(on, offset));
        }
        if noise.yes() {
            let axial = scene.loads.get_mut("axial").unwrap();
            axial.force = (100.0 * noise.next()).into();
        }
        if noise.yes() {
            scene.contact.damping = 0.0;
        }
        let worst = difference(&scene);
        let found = reduction(&scene);
        reduced += usize::from(found.omissions().len() > 2);
        println!("{case}: {worst:.1e}, without {:?}", whats(&found));
        assert!(worst < 1e-12, "{case}: {worst:.1e}");
    }
    assert!(reduced > 15, "{reduced}");
}

/// Accelerations of the outer ring over 2 ms.
fn signal(scene: &Scene, reduce: bool, y0: &[f64]) -> [Vec<f64>; 2] {
    let mut scene = scene.clone();
    (scene.solver.reduce, scene.solver.rtol) = (reduce, 1e-9.into());
    let run = Run {
        duration: 2e-3,
        start: Start::State(y0.to_vec()),
        bandwidth: Bandwidth::Raw,
        ..Run::default()
    };
    let out = simulate(&scene, &run).unwrap();
    ["outer.ax", "outer.ay"].map(|name| out.get(name).unwrap().to_vec())
}

/// How far two signals are apart over their first samples, relative, L2.
fn apart(a: &[Vec<f64>; 2], b: &[Vec<f64>; 2], samples: usize) -> f64 {
    let (mut apart, mut size) = (0.0, 0.0);
    for (a, b) in a.iter().zip(b) {
        for (a, b) in a.iter().zip(b).take(samples) {
            apart += (a - b).powi(2);
            size += b.powi(2);
        }
    }
    (apart / size).sqrt()
}

/// Analytic: signals agree as far as rounding lets any two runs: the full model from a start 1e-16 m away, a
/// hundredth of what a place of 36 mm is known to, measures how it grows.
#[test]
fn signals_agree() {
    for (name, scene, _) in scenes() {
        let y0 = begin(&compile(&scene).unwrap());
        let mut beside = y0.clone();
        beside[1] += 1e-16;
        let full = signal(&scene, false, &y0);
        let (reduced, rounded) = (signal(&scene, true, &y0), signal(&scene, false, &beside));
        for samples in [10, 100] {
            let (error, grown) = (
                apart(&reduced, &full, samples),
                apart(&rounded, &full, samples),
            );
            println!("{name}: {error:.1e} over {samples} samples, rounding {grown:.1e}");
            assert!(
                error < 1e-8 + 100.0 * grown,
                "{name}: {error:.1e}, {grown:.1e}"
            );
        }
    }
}

/// Analytic: the nearest scenes that have not the symmetry keep their states.
#[test]
fn a_very_small_amount_is_enough() {
    let without = |scene: &Scene, what: &str| whats(&reduction(scene)).contains(&what);
    let level = plane(NormalLaw::Hertz, false);
    assert!(without(&level, "z") && without(&level, "spin of balls"));
    let changes: [(&str, Change); 7] = [
        ("thrust", |s| {
            s.loads.get_mut("axial").unwrap().force = 1e-3.into();
        }),
        ("gravity", |s| s.gravity[2] = 1e-6),
        ("contact angle", |s| s.rows[0].contact_angle = 1e-7),
        ("preload", |s| s.rows[0].axial_preload = 1e-10),
        ("shoulders", |s| {
            s.rows[0].outer_shoulders = Some([0.5, 0.5 + 1e-9]);
        }),
        ("a spall off the middle", |s| {
            s.defects
                .insert("spall".to_owned(), spall(Surface::OuterRace, 1e-9));
        }),
        ("a lopsided spall", |s| {
            let mut defect = spall(Surface::InnerRace, 0.0);
            *patch(&mut defect).1 = Width::Profile(WidthProfile::new(
                vec![-1e-3, 1e-3],
                vec![0.8e-3, 0.8e-3 + 1e-9],
            ));
            s.defects.insert("spall".to_owned(), defect);
        }),
    ];
    for (name, change) in changes {
        let mut scene = level.clone();
        change(&mut scene);
        assert!(!without(&scene, "z"), "{name}");
    }
    let mut scene = level.clone();
    scene.friction = Friction::Coulomb {
        coefficient: 1e-9,
        slip_speed: 0.1,
    };
    assert!(without(&scene, "z") && !without(&scene, "spin of balls"));

    let both = mirrored();
    assert!(without(&both, "balls of row 1"));
    let changes: [(&str, Change); 6] = [
        ("thrust", |s| {
            s.loads.get_mut("axial").unwrap().force = 1e-3.into();
        }),
        ("phase", |s| s.rows[1].start_angle += 1e-9),
        ("clearance", |s| s.rows[1].clearance = 1e-10),
        ("conformity", |s| s.rows[0].inner_conformity += 1e-9),
        ("a spall in one row", |s| {
            s.defects
                .insert("spall".to_owned(), spall(Surface::OuterRace, 0.0));
        }),
        ("a ball", |s| {
            s.rows[0].diameter_errors = (0..13).map(|j| 1e-10 * f64::from(j)).collect();
        }),
    ];
    for (name, change) in changes {
        let mut scene = both.clone();
        change(&mut scene);
        assert!(!without(&scene, "balls of row 1"), "{name}");
    }
}

/// Analytic: a start that lacks the symmetry keeps what the scene alone would let go.
#[test]
fn the_start_must_be_symmetric_too() {
    let model = compile(&plane(NormalLaw::Hertz, false)).unwrap();
    let y0 = start(&model, &Start::Rolling).unwrap();
    let has = |y: &[f64]| whats(&Reduction::of(&model, y).unwrap()).contains(&"z");
    assert!(has(&y0));
    for (state, change) in [(2, 1e-9), (4 * 3 + 2, 1e-9), (y0.len() / 2 + 2, 1e-4)] {
        let mut y = y0.clone();
        y[state] += change;
        assert!(!has(&y), "{state}");
    }
}

/// Analytic: `reduce = false` keeps everything, and provenance says so.
#[test]
fn nothing_is_left_out_on_request() {
    let mut scene = plane(NormalLaw::Hertz, false);
    for (reduce, states) in [(true, 44), (false, 88)] {
        scene.solver.reduce = reduce;
        let run = Run {
            duration: 1e-4,
            settle: Some(0.0),
            ..Run::default()
        };
        let out = simulate(&scene, &run).unwrap();
        assert_eq!(out.provenance.states, states);
        assert_eq!(out.provenance.left_out.is_empty(), !reduce);
    }
}
