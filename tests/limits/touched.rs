//! Defects lie where contacts run, and every run records which of them balls met.
//!
//! Truth: the static equilibrium for the places, counting of passes by the kinematics of pure rolling for the rest, and
//! the signals themselves: what is not touched sounds healthy.

use crate::common;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use ballrace::compile;
use ballrace::scene::{
    AxialOffset, Cap, Defect, Drive, Friction, Patch, Profile, RingName, Scene, Surface,
    TimeFunction, Width, WidthProfile, presets,
};
use ballrace::{
    BallEquilibrium, Error, Placed, Run, Signals, Start, Touched, Warning, equilibrium, explain,
    load_distribution, simulate_with_progress,
};
use common::{patch, rms, run, short};

const SPALL: &str = "spall";

/// An angular-contact bearing 7208 (40°) under thrust.
fn angular_7208() -> Scene {
    let mut scene = presets::deep_groove_6205(500.0, 3000.0, 3000.0);
    "angular contact 7208".clone_into(&mut scene.name);
    let row = &mut scene.rows[0];
    (row.ball_count, row.ball_diameter, row.pitch_diameter) = (15, 11.112e-3, 60e-3);
    (row.contact_angle, row.clearance) = (PI * 40.0 / 180.0, 0.0);
    (row.outer_conformity, row.inner_conformity) = (0.52, 0.52);
    for (ring, diameter) in [
        (&mut scene.outer_ring, 80e-3),
        (&mut scene.inner_ring, 40e-3),
    ] {
        (ring.diameter, ring.width) = (Some(diameter), Some(18e-3));
    }
    scene
}

fn spall(on: Surface) -> Defect {
    let mut defect = Defect::of(
        Patch::of_width(1e-3).length(2e-3).edge_radius(0.3e-3),
        on,
        -FRAC_PI_2 - 0.2,
    );
    defect.ball = (on == Surface::Ball).then_some(0);
    defect
}

fn with(mut scene: Scene, defect: Defect) -> Scene {
    scene.defects = [(SPALL.to_owned(), defect)].into();
    scene
}

fn at(offset: f64, defect: Defect) -> Defect {
    defect.at_offset(offset)
}

fn spall_of(out: &Signals) -> &Touched {
    out.provenance
        .defects
        .iter()
        .find(|of| of.name == SPALL)
        .unwrap()
}

fn number(scene: &Scene) -> f64 {
    scene.defects[SPALL].axial_offset.number().unwrap()
}

fn loudness(out: &Signals) -> f64 {
    rms(out.get("outer.ay").unwrap())
}

/// The ball that is most loaded on a race.
fn most(balls: &[BallEquilibrium], load: impl Fn(&BallEquilibrium) -> f64) -> &BallEquilibrium {
    balls
        .iter()
        .max_by(|a, b| load(a).total_cmp(&load(b)))
        .unwrap()
}

/// The issue's: felt where the contact runs, silent and warned of in the middle of the row.
#[test]
fn a_spall_of_a_7208_is_felt_by_default() {
    let healthy = loudness(&run(&angular_7208(), &short(5e-3)));
    let placed = run(
        &with(angular_7208(), spall(Surface::InnerRace)),
        &short(5e-3),
    );
    let missed = run(
        &with(angular_7208(), at(0.0, spall(Surface::InnerRace))),
        &short(5e-3),
    );
    println!(
        "rms healthy {healthy:.3}, placed {:.3}, at 0 {:.3} m/s²; {:?}",
        loudness(&placed),
        loudness(&missed),
        spall_of(&placed)
    );
    let of = spall_of(&placed);
    assert_eq!((of.placed, of.share()), (Placed::Contact, Some(1.0)));
    assert!(of.passes >= 1 && of.largest_load > 50.0);
    assert!(loudness(&placed) > 10.0 * healthy);
    assert!(placed.warnings().is_empty(), "{:?}", placed.warnings());

    let of = spall_of(&missed);
    assert_eq!((of.placed, of.share()), (Placed::Given, Some(0.0)));
    assert_eq!(of.passes, spall_of(&placed).passes);
    assert!((of.contact_offset.unwrap() - number(&placed.scene)).abs() < 0.1e-3);
    assert!((loudness(&missed) / healthy - 1.0).abs() < 0.05);
    let warnings = missed.warnings();
    assert!(
        matches!(&warnings[..], [Warning::Untouched { .. }]),
        "{warnings:?}"
    );
    assert_eq!(warnings[0].category(), "scene");
    println!("{}", warnings[0]);
}

/// Truth: the equilibrium that `equilibrium` returns, most loaded contact of each kind.
#[test]
fn the_number_is_the_place_of_the_contact_at_equilibrium() {
    for scene in [
        angular_7208(),
        presets::deep_groove_6205(800.0, 300.0, 1800.0),
    ] {
        let inner = with(scene.clone(), spall(Surface::InnerRace));
        let found = equilibrium(&scene).unwrap();
        let ball = most(&found.balls, |ball| ball.inner.load);
        let placed = number(compile(&inner).unwrap().scene());
        assert!((placed - ball.inner.zone_centre.unwrap()).abs() <= 1e-9);

        // A ball stands at the angle of the outer race's.
        let angle = -FRAC_PI_2 + TAU / scene.rows[0].ball_count as f64;
        let outer = with(scene.clone(), spall(Surface::OuterRace).at_angle(angle));
        let ball = found
            .balls
            .iter()
            .min_by(|a, b| (a.angle - angle).abs().total_cmp(&(b.angle - angle).abs()))
            .unwrap();
        let placed = number(compile(&outer).unwrap().scene());
        assert!((placed - ball.outer.zone_centre.unwrap()).abs() <= 2e-9);

        // A ball has two tracks, at ±R sin α; centrifugal force makes the outer race the more loaded one.
        let rolling = with(scene.clone(), spall(Surface::Ball));
        let ball = most(&found.balls, |ball| ball.outer.load);
        let placed = number(compile(&rolling).unwrap().scene());
        let zeta = ball.outer.zone_centre.unwrap() - (ball.z - found.outer[2]);
        let half = scene.rows[0].ball_diameter / 2.0;
        assert!((placed - zeta).abs() <= 1e-9);
        assert!((placed - half * ball.outer.angle.unwrap().sin()).abs() < 0.02e-3);
    }
}

/// The place is the scene's: method, start, node count and all calls of it agree on the number.
#[test]
fn all_that_compile_a_scene_place_alike() {
    let scene = with(angular_7208(), spall(Surface::InnerRace));
    let number_here = number(compile(&scene).unwrap().scene());
    let rolling = Run {
        start: Start::Rolling,
        ..short(1e-4)
    };
    assert_eq!(number(&run(&scene, &rolling).scene), number_here);
    let accurate = Run {
        accuracy: Some(1e-1),
        ..short(1e-4)
    };
    assert_eq!(number(&run(&scene, &accurate).scene), number_here);
    assert_eq!(
        explain(&scene).unwrap().defects[0].axial_offset,
        number_here
    );
    // What was recorded runs again to the bit, as given.
    let first = run(&scene, &short(3e-4));
    let again = run(&first.scene, &short(3e-4));
    assert_eq!(first.columns, again.columns);
    assert_eq!(spall_of(&again).placed, Placed::Given);
    // The cage turns past a defect that stays.
    let placed = with(angular_7208(), at(number_here, spall(Surface::InnerRace)));
    assert_eq!(
        load_distribution(&scene, 3).unwrap().equilibria,
        load_distribution(&placed, 3).unwrap().equilibria
    );
    assert_eq!(equilibrium(&scene).unwrap(), equilibrium(&placed).unwrap());
}

/// Limit: level grooves under a radial load keep what runs leave out, and images stay images.
#[test]
fn symmetric_scenes_stay_symmetric() {
    let radial = with(
        presets::deep_groove_6205(500.0, 0.0, 1800.0),
        spall(Surface::InnerRace),
    );
    let out = run(&radial, &short(1e-4));
    assert_eq!(number(&out.scene).to_bits(), 0.0_f64.to_bits());
    assert!(out.provenance.left_out.iter().any(|of| of.what == "z"));

    let out = run(&both_rows(Surface::OuterRace), &short(1e-4));
    let [first, second] = ["first", "second"].map(|name| {
        let offset = out.scene.defects[name].axial_offset;
        offset.number().unwrap()
    });
    // Each towards the middle between the rows, where the outer contacts of an O arrangement lie.
    assert!(first == -second && first > 0.5e-3, "{first} {second}");
    let copies = |out: &Signals| {
        let mut left_out = out.provenance.left_out.iter();
        left_out.any(|of| of.what == "balls of row 1")
    };
    assert!(copies(&out));
}

/// The wheel bearing with rows in phase and the same spall in both.
fn both_rows(on: Surface) -> Scene {
    let mut scene = presets::wheel_bearing(0.0);
    scene.rows[1].start_angle = scene.rows[0].start_angle;
    let of = |row: usize| spall(on).in_row(row).at_angle(-FRAC_PI_2 + 0.2);
    scene.defects = [("first".to_owned(), of(0)), ("second".to_owned(), of(1))].into();
    scene
}

/// Truth: the full model. However a run is reduced, it sees the same passes and the same loads.
#[test]
fn reduced_runs_see_what_full_ones_see() {
    let frictionless = |mut scene: Scene| {
        scene.friction = Friction::None;
        scene
    };
    let radial = || presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let outer = || spall(Surface::OuterRace).at_angle(-FRAC_PI_2 + 0.1);
    let scenes = [
        (
            "closed, in the plane",
            frictionless(with(radial(), outer())),
        ),
        ("closed", frictionless(with(angular_7208(), outer()))),
        ("mirrored rows", both_rows(Surface::OuterRace)),
        ("mirrored, inner", both_rows(Surface::InnerRace)),
        (
            "a ball",
            with(radial(), spall(Surface::Ball).at_angle(-FRAC_PI_2 + 0.4)),
        ),
    ];
    for (name, scene) in scenes {
        let mut whole = scene.clone();
        whole.solver.reduce = false;
        let [reduced, whole] = [scene, whole].map(|scene| run(&scene, &short(4e-3)));
        assert_eq!(
            reduced.provenance.defects.len(),
            whole.provenance.defects.len()
        );
        for (a, b) in reduced
            .provenance
            .defects
            .iter()
            .zip(&whole.provenance.defects)
        {
            println!("{name}: {a:?}");
            assert!(a.passes > 0, "{name}");
            assert_eq!((a.passes, a.touched), (b.passes, b.touched), "{name}");
            let apart = (a.largest_load - b.largest_load).abs();
            assert!(apart <= 0.05 * b.largest_load, "{name}: {b:?}");
        }
    }
}

/// Truth: kinematics of pure rolling. Balls pass the inner race's Z(1 + γ)/2 times a turn, the outer race's Z(1 − γ)/2
/// times; a ball shows a spot of itself to both races once a turn of its own, and only one of them meets it.
#[test]
fn passes_are_those_of_the_kinematics() {
    let scene = |on| {
        let mut scene = with(angular_7208(), spall(on));
        scene.solver.rtol = 1e-3.into();
        scene
    };
    let row = &angular_7208().rows[0];
    let gamma = row.ball_diameter * row.contact_angle.cos() / row.pitch_diameter;
    let (speed, balls) = (50.0, 15.0);
    let turn = row.pitch_diameter / (2.0 * row.ball_diameter) * (1.0 - gamma * gamma);
    let duration = 20e-3;
    for (on, rate, share) in [
        (Surface::OuterRace, balls * (1.0 - gamma) / 2.0, 1.0),
        (Surface::InnerRace, balls * (1.0 + gamma) / 2.0, 1.0),
        // Against the cage it turns at BSF/cos α.
        (Surface::Ball, 2.0 * turn / row.contact_angle.cos(), 0.5),
    ] {
        let out = run(
            &scene(on),
            &Run {
                fs: 10e3,
                ..short(duration)
            },
        );
        let of = spall_of(&out);
        let wanted = rate * speed * duration;
        println!("{on:?}: {wanted:.2} passes, {of:?}");
        assert!((of.passes as f64 - wanted).abs() <= 1.0, "{on:?}");
        assert!((of.share().unwrap() - share).abs() <= 0.51 / of.passes as f64);
    }
}

/// A cap of a ball is reported as any defect, by runs and explanations. One that turns beside both contacts is passed, not touched, and
/// changes no acceleration.
#[test]
fn a_cap_is_reported_as_any_defect() {
    let pit = Defect::of(
        Cap::of_width(1e-3).edge_radius(0.3e-3),
        Surface::Ball,
        -FRAC_PI_2 - 0.2,
    );
    let met = with(angular_7208(), pit.clone());
    let explanation = explain(&met).unwrap();
    assert_eq!(
        (
            explanation.defects[0].passes,
            explanation.defects[0].touched
        ),
        (30, 15)
    );
    let healthy = with(
        angular_7208(),
        at(
            0.0,
            Defect::of(Cap::of_width(0.0).edge_radius(0.3e-3), Surface::Ball, 0.0),
        ),
    );
    let missed = with(angular_7208(), at(0.0, pit));
    let signals = [&met, &healthy, &missed].map(|scene| {
        run(
            scene,
            &Run {
                rtol: Some(1e-8),
                ..short(12e-3)
            },
        )
    });
    let of = spall_of(&signals[0]);
    println!("{of:?}");
    assert!(of.passes >= 2 && of.largest_load > 50.0);
    assert!((of.share().unwrap() - 0.5).abs() <= 0.51 / of.passes as f64);
    // On either race, at opposite places.
    let place = of.contact_offset.unwrap().abs();
    assert!((place - number(&signals[0].scene).abs()).abs() < 0.2e-3);
    let beside = spall_of(&signals[2]);
    assert!(beside.passes >= 2 && beside.touched == 0, "{beside:?}");
    let loud = signals.each_ref().map(loudness);
    println!("{loud:?}");
    assert!((loud[2] / loud[1] - 1.0).abs() < 1e-2, "{loud:?}");
    assert!(loud[0] > 2.0 * loud[1], "{loud:?}");
}

/// A run too short for a pass is distinguished from one whose balls miss.
#[test]
fn what_no_ball_passed_is_no_miss() {
    let out = run(
        &with(angular_7208(), spall(Surface::InnerRace)),
        &short(1e-4),
    );
    assert_eq!((spall_of(&out).passes, spall_of(&out).share()), (0, None));
    let warnings = out.warnings();
    assert!(
        matches!(&warnings[..], [Warning::Unpassed { .. }]),
        "{warnings:?}"
    );
    assert_eq!(warnings[0].category(), "scene");

    // At the top of a radially loaded bearing balls pass the inner race without load.
    let mut scene = with(
        presets::deep_groove_6205(500.0, 0.0, 1800.0),
        spall(Surface::InnerRace).at_angle(FRAC_PI_2),
    );
    scene.rows[0].start_angle = FRAC_PI_2;
    // While a ball is still over it, the pass is not over: it may yet touch.
    let out = run(&scene, &short(1e-4));
    assert_eq!((spall_of(&out).passes, spall_of(&out).share()), (0, None));
    let warnings = out.warnings();
    assert!(
        matches!(&warnings[..], [Warning::Unpassed { .. }]),
        "{warnings:?}"
    );
    let out = run(&scene, &short(2e-3));
    assert_eq!((spall_of(&out).passes, spall_of(&out).touched), (1, 0));
    assert_eq!(spall_of(&out).contact_offset, None);
    println!("{}", out.warnings()[0]);
}

/// What is advised is not what was done: of a place that was given "contact", of one that a contact had at equilibrium its
/// number in the run. Limit: a defect at that number is touched.
#[test]
fn what_is_advised_was_not_done_before() {
    let missed = run(
        &with(angular_7208(), at(0.0, spall(Surface::InnerRace))),
        &short(5e-3),
    );
    let advice = missed.warnings()[0].to_string();
    assert!(advice.contains("give \"contact\" to place it"), "{advice}");
    // Placed for the whole thrust, of which the run sees the beginning.
    let mut growing = with(angular_7208(), spall(Surface::InnerRace));
    *patch(growing.defects.get_mut(SPALL).unwrap()).0 = 0.5e-3;
    growing.loads.get_mut("axial").unwrap().force = TimeFunction::Profile(Profile::Ramp {
        from: 100.0,
        to: 30e3,
        start: 0.1,
        end: 0.2,
    });
    let out = run(&growing, &short(5e-3));
    let of = spall_of(&out);
    assert_eq!((of.placed, of.share()), (Placed::Contact, Some(0.0)));
    let advice = out.warnings()[0].to_string();
    println!("{advice}");
    assert!(!advice.contains("give \"contact\""), "{advice}");
    let place = format!(
        "give axial_offset in metres, {:.2e}",
        of.contact_offset.unwrap()
    );
    assert!(advice.contains(&place), "{advice}");
    let place = of.contact_offset.unwrap();
    growing.defects.get_mut(SPALL).unwrap().axial_offset = AxialOffset::At(place);
    assert!(spall_of(&run(&growing, &short(5e-3))).touched > 0);
}

/// Limit: one without width is healthy, and one narrower than a step is not overlooked.
#[test]
fn width_counts_from_zero() {
    let of = |width: Width| {
        let mut defect = spall(Surface::InnerRace);
        *patch(&mut defect).1 = width;
        run(&with(angular_7208(), defect), &short(4e-3))
    };
    let none = of(0.0.into());
    assert!(none.provenance.defects.is_empty() && none.warnings().is_empty());
    let narrow = of(1e-7.into());
    assert_eq!(spall_of(&narrow).share(), Some(1.0));
    assert!(spall_of(&narrow).passes >= 1);
    // Of a wedge only the part that is wide is there: its thin end reaches under the contact and is none.
    let wedge = of(Width::Profile(WidthProfile::new(
        vec![-1e-3, 0.9e-3, 1e-3],
        vec![0.0, 0.0, 1e-3],
    )));
    assert!(spall_of(&wedge).largest_load < spall_of(&narrow).largest_load);
}

/// Without an equilibrium or a load the nominal contact angle says where, and so does the provenance.
#[test]
fn without_load_the_nominal_angle_places() {
    let mut scene = with(angular_7208(), spall(Surface::InnerRace));
    scene.loads.clear();
    (scene.gravity, scene.drive) = ([0.0; 3], Drive::Speed(0.0.into()));
    let still = Run {
        start: Start::Rolling,
        ..short(1e-5)
    };
    let out = run(&scene, &still);
    assert_eq!(spall_of(&out).placed, Placed::Nominal);
    let row = &scene.rows[0];
    let wanted = -row.ball_diameter / 2.0 * row.contact_angle.sin();
    assert!((number(&out.scene) - wanted).abs() <= 1e-9);
}

/// Loads that change count with their largest value: a thrust that grows from nothing places as in the end.
#[test]
fn loads_in_time_place_by_their_largest_value() {
    let steady = with(angular_7208(), spall(Surface::OuterRace));
    let mut growing = steady.clone();
    growing.loads.get_mut("axial").unwrap().force = TimeFunction::Profile(Profile::Ramp {
        from: 0.0,
        to: 3000.0,
        start: 0.0,
        end: 0.1,
    });
    let [steady, growing] = [steady, growing].map(|scene| number(compile(&scene).unwrap().scene()));
    assert_eq!(steady, growing);
}

/// A drive by torque turns the inner race past the balls; the defect is met all the same.
#[test]
fn a_torque_drive_is_followed() {
    let mut scene = with(angular_7208(), spall(Surface::InnerRace));
    scene.drive = Drive::Torque {
        value: 0.5.into(),
        initial_speed: 100.0 * PI,
    };
    let out = run(&scene, &short(4e-3));
    assert!(spall_of(&out).passes >= 1);
    assert_eq!(spall_of(&out).share(), Some(1.0));
}

#[test]
fn a_place_is_a_number_or_a_word() {
    let scene = with(angular_7208(), spall(Surface::InnerRace));
    let path = format!("defects.{SPALL}.axial_offset");
    assert!(scene.to_toml().contains("axial_offset = \"contact\""));
    assert_eq!(Scene::from_toml(&scene.to_toml()).unwrap(), scene);
    assert_eq!(Scene::from_json(&scene.to_json()).unwrap(), scene);
    let moved = scene.with(&[(&path, 1e-3.into())]).unwrap();
    assert_eq!(number(&moved), 1e-3);
    assert_eq!(Scene::from_toml(&moved.to_toml()).unwrap(), moved);
    assert_eq!(moved.with(&[(&path, "contact".into())]).unwrap(), scene);
    // Left out, it is the word.
    let text = scene.to_toml().replace("axial_offset = \"contact\"\n", "");
    assert_eq!(Scene::from_toml(&text).unwrap(), scene);
    match scene.with(&[(&path, "middle".into())]) {
        Err(Error::Scene { path: found, .. }) => assert_eq!(found, path),
        other => panic!("{other:?}"),
    }
}

/// A defect that does not fit where the contact runs is refused by name.
#[test]
fn what_does_not_fit_there_is_refused() {
    let mut long = spall(Surface::OuterRace);
    *patch(&mut long).0 = 6e-3;
    let scene = with(angular_7208(), long);
    scene.validate().unwrap();
    let error = compile(&scene).unwrap_err().to_string();
    println!("{error}");
    assert!(error.contains("defects.spall.length"), "{error}");
}

#[test]
fn an_explanation_has_places_and_touches() {
    let explanation = explain(&with(angular_7208(), spall(Surface::InnerRace))).unwrap();
    let of = &explanation.defects[0];
    assert_eq!(
        (of.placed, of.passes, of.touched),
        (Placed::Contact, 15, 15)
    );
    assert!(of.largest_load > 50.0);
    let text = explanation.to_string();
    println!("{text}");
    assert!(text.contains("where contacts run; touched at 15 of 15 places of a turn"));
    let explanation = explain(&with(angular_7208(), at(0.0, spall(Surface::OuterRace)))).unwrap();
    let of = &explanation.defects[0];
    assert_eq!((of.placed, of.passes, of.touched), (Placed::Given, 1, 0));
    assert!(
        explanation
            .to_string()
            .contains("not touched: contacts run at")
    );
    let explanation = explain(&with(angular_7208(), spall(Surface::Ball))).unwrap();
    assert_eq!(
        (
            explanation.defects[0].passes,
            explanation.defects[0].touched
        ),
        (30, 15)
    );
}

/// Both rows of the wheel bearing, and thrust that moves the contact off a given place.
#[test]
fn thrust_decides_whether_a_given_place_is_touched() {
    let passing = |thrust: f64, row: usize, offset: AxialOffset| {
        let mut scene = presets::wheel_bearing(thrust);
        let start = scene.rows[row].start_angle;
        let spall = scene.defects.get_mut(SPALL).unwrap();
        (spall.row, spall.angle, spall.axial_offset) = (row, start + 0.1, offset);
        spall_of(&run(&scene, &short(3e-3))).clone()
    };
    let given = passing(3000.0, 0, AxialOffset::At(2.32e-3));
    assert!(given.passes > 0 && given.touched == given.passes);
    // The zone of the other row lies on the other side.
    let other = passing(3000.0, 1, AxialOffset::At(3.5e-3));
    assert!(other.passes > 0 && other.touched == 0, "{other:?}");
    for row in [0, 1] {
        let placed = passing(3000.0, row, AxialOffset::Contact);
        assert!(placed.touched > 0, "{placed:?}");
        assert_eq!(placed.axial_offset > 0.0, row == 0, "{placed:?}");
    }
}

/// Which ring is loaded does not matter: what counts is the contact.
#[test]
fn loads_on_the_outer_ring_place_as_well() {
    let mut scene = with(angular_7208(), spall(Surface::InnerRace));
    let load = scene.loads.get_mut("axial").unwrap();
    (load.ring, load.direction) = (RingName::Outer, [0.0, 0.0, -1.0]);
    // The inner ring is held, and the outer one pushed onto it.
    std::mem::swap(&mut scene.outer_ring.support, &mut scene.inner_ring.support);
    let stop = |_: f64| std::ops::ControlFlow::Continue(());
    let out = simulate_with_progress(&scene, &short(1e-5), &mut { stop }).unwrap();
    assert_eq!(spall_of(&out).placed, Placed::Contact);
    assert!(number(&out.scene) < -2e-3);
}
