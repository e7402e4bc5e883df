//! Rings that tilt, as users meet them: what a scene says, what a run records of it, and what is refused.

use crate::common;
use ballrace::dynamics::Dynamics;
use ballrace::integrate::System;
use ballrace::scene::{
    Component, CoupledSupport, Friction, Load, Lubricant, Method, Moment, MotionProbe, Mount,
    Probe, RingName, Scene, Spin, Unbalance, presets,
};
use ballrace::{Explanation, Reduction, Run, Start, Warning, compile, explain, simulate, start};
use common::{apart, oiled, run, short};

/// A 6205 under 500 N and 300 N whose inner ring tilts, damped.
fn tilted() -> Scene {
    let mut scene = presets::deep_groove_6205(500.0, 300.0, 1800.0);
    let tilts = Some(Mount::Spring {
        stiffness: 0.0,
        damping: 0.05,
    });
    let support = &mut scene.inner_ring.support;
    (support.tilt_x, support.tilt_y) = (tilts.clone(), tilts);
    scene
}

fn rolling(duration: f64) -> Run {
    Run {
        start: Start::Rolling,
        ..short(duration)
    }
}

/// Documents of scenes without tilts are what they were.
#[test]
fn other_documents_say_nothing_of_tilts() {
    for scene in [
        presets::deep_groove_6205(500.0, 0.0, 1800.0),
        presets::wheel_bearing(3000.0),
    ] {
        for text in [scene.to_toml(), scene.to_json()] {
            for word in [
                "tilt",
                "moments",
                "coupled",
                "transverse",
                "centre_of_mass",
                "\"at\"",
            ] {
                assert!(!text.contains(word), "{word} in {text}");
            }
        }
        let model = compile(&scene).unwrap();
        assert!(model.names().iter().all(|name| !name.contains("tilt")));
    }
}

/// Fields come back as they were written, and can be changed by their paths.
#[test]
fn fields_of_tilts_come_back() {
    let mut scene = tilted();
    let load = Load::new(RingName::Inner, [0.0, 1.0, 0.0], 100.0).at([0.0, -0.3, 0.02]);
    scene.loads.insert("wheel".to_owned(), load);
    let moment = Moment::new(RingName::Outer, [1.0, 0.0, 0.0], 2.0);
    scene.moments.insert("bend".to_owned(), moment.clone());
    scene.inner_ring.tilt = Some([1e-3, -2e-3]);
    scene.outer_ring.support.coupled = Some(Box::new(CoupledSupport::new([[0.0; 6]; 6])));
    assert_eq!(Scene::from_toml(&scene.to_toml()).unwrap(), scene);
    assert_eq!(Scene::from_json(&scene.to_json()).unwrap(), scene);
    let plain = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let changed = plain
        .with(&[
            ("outer_ring.tilt", serde_json::json!([1e-3, 0.0])),
            ("inner_ring.support.tilt_y", "free".into()),
            ("loads.radial.at", serde_json::json!([0.0, 0.0, 0.01])),
            ("moments.bend", serde_json::to_value(&moment).unwrap()),
        ])
        .unwrap();
    assert_eq!(changed.outer_ring.tilt, Some([1e-3, 0.0]));
    assert_eq!(changed.inner_ring.support.tilt_y, Some(Mount::Free));
    assert_eq!(changed.loads["radial"].at, Some([0.0, 0.0, 0.01]));
    assert_eq!(changed.moments["bend"], moment);
}

/// Tilts stand behind all bodies in each half of a state.
#[test]
fn tilts_have_states_where_they_move() {
    let mut scene = tilted();
    scene.inner_ring.support.tilt_y = None;
    let model = compile(&scene).unwrap();
    let names = model.names();
    let half = names.len() / 2;
    assert_eq!(half, 4 * 11 + 1);
    assert_eq!(names[half - 1], "inner.tilt_x");
    assert_eq!(names[2 * half - 1], "inner.tilt_vx");
    assert_eq!(names[4 + 1], "inner.y");
}

fn refused(scene: &Scene, field: &str) {
    let message = match simulate(scene, &rolling(1e-4)) {
        Ok(_) => panic!("{field} is taken"),
        Err(error) => error.to_string(),
    };
    assert!(message.contains(field), "{field}: {message}");
}

/// A field that is refused, and what makes it so.
type Case = (&'static str, Box<dyn Fn(&mut Scene)>);

/// What cannot be, or is not known yet, is refused by name.
#[test]
fn what_cannot_tilt_is_refused_by_name() {
    let changed = |change: &dyn Fn(&mut Scene)| {
        let mut scene = tilted();
        change(&mut scene);
        scene
    };
    let cases: Vec<Case> = vec![
        (
            "inner_ring.tilt",
            Box::new(|s| s.inner_ring.tilt = Some([0.4, 0.4])),
        ),
        (
            "rows[0].ball_support",
            Box::new(|s| s.rows[0].ball_support.tilt_x = Some(Mount::Fixed)),
        ),
        (
            "outer_ring.support.coupled.stiffness",
            Box::new(|s| {
                let mut rows = [[0.0; 6]; 6];
                rows[0][1] = 1.0;
                s.outer_ring.support.coupled = Some(Box::new(CoupledSupport::new(rows)));
            }),
        ),
        (
            "outer_ring.support.coupled.stiffness",
            Box::new(|s| {
                let mut rows = [[0.0; 6]; 6];
                rows[3][3] = -1.0;
                s.outer_ring.support.coupled = Some(Box::new(CoupledSupport::new(rows)));
            }),
        ),
        (
            "inner_ring.support.coupled.stiffness",
            Box::new(|s| {
                let mut rows = [[0.0; 6]; 6];
                rows[5][5] = 1.0;
                s.inner_ring.support.coupled = Some(Box::new(CoupledSupport::new(rows)));
            }),
        ),
        (
            "loads.radial.at[1]",
            Box::new(|s| {
                s.loads.get_mut("radial").unwrap().at = Some([0.0, f64::NAN, 0.0]);
            }),
        ),
        (
            "moments.bend.direction",
            Box::new(|s| {
                let none = Moment::new(RingName::Inner, [0.0; 3], 1.0);
                s.moments.insert("bend".to_owned(), none);
            }),
        ),
        (
            "unbalances.rotor.ring",
            Box::new(|s| {
                s.drive = ballrace::scene::Drive::Torque {
                    value: 0.0.into(),
                    initial_speed: 10.0,
                };
                let rotor = Unbalance::new(RingName::Inner, 1e-5, 0.0);
                s.unbalances.insert("rotor".to_owned(), rotor);
            }),
        ),
        (
            "probes.ball.motion.components",
            Box::new(|s| {
                let probe = MotionProbe::of("row0.ball0")
                    .components([Component::TiltX])
                    .into();
                s.probes.insert("ball".to_owned(), probe);
            }),
        ),
    ];
    for (field, change) in cases {
        refused(&changed(&*change), field);
    }
}

/// A run by every method records tilts, moments and an energy that its powers account for.
#[test]
fn a_run_records_tilts() {
    let mut tilts = Vec::new();
    for method in [Method::DormandPrince, Method::Adams, Method::Verner] {
        let mut scene = tilted();
        scene.friction = Friction::None;
        scene.solver.method = method;
        let out = run(&scene, &rolling(4e-4));
        let tilt = out.get("inner.tilt_x").unwrap();
        assert!(out.get("outer.tilt_x").is_none());
        assert!(out.get("inner.tilt_ay").unwrap()[0].is_finite());
        tilts.push(tilt[tilt.len() - 1]);
    }
    println!("{tilts:?}");
    for tilt in &tilts {
        assert!(
            tilt.abs() > 1e-7 && (tilt / tilts[0] - 1.0).abs() < 0.02,
            "{tilts:?}"
        );
    }
}

/// Convergence: the default method follows a wheel that tilts in a curve, dry and in oil, to the truth of a pair at a tight tolerance,
/// with a fifth of the evaluations that the pair takes for its own.
#[test]
fn the_default_method_follows_tilts() {
    let wheel = presets::cornering_wheel(0.3);
    for (name, scene) in [("dry", wheel.clone()), ("oil", oiled(wheel))] {
        let by = |method, rtol| {
            let mut scene = scene.clone();
            scene.solver.method = method;
            let run = Run {
                start: Start::Equilibrium,
                rtol: Some(rtol),
                ..short(2e-3)
            };
            let out = simulate(&scene, &run).unwrap();
            (out.get("outer.ay").unwrap().to_vec(), out.stats.nfev)
        };
        let rtol = scene.solver.rtol.or_exact();
        let (truth, _) = by(Method::DormandPrince, 1e-8);
        let [(pair, most), (found, count)] =
            [(Method::DormandPrince, rtol), (Method::Adams, rtol / 10.0)]
                .map(|(method, rtol)| by(method, rtol));
        let [pair, off] = [pair, found].map(|of| apart(&of, &truth));
        println!("{name}: adams {off:.1e} in {count}, dormand-prince {pair:.1e} in {most}");
        assert!(off < 3e-3, "{name}: {off}");
        assert!(5 * count < most, "{name}: {count} {most}");
    }
}

/// Truth: Dormand–Prince at a tight tolerance, of a wheel that tilts in a curve with balls that spin freely. Steps of the default method
/// do not depend on how stiff friction is.
#[test]
fn stiff_friction_in_space_costs_the_default_method_nothing() {
    let mut scene = presets::cornering_wheel(0.3);
    scene.spin = Some(Spin::Free);
    let by = |method, slip_speed, rtol| {
        let mut scene = scene.clone();
        scene.friction = Friction::Coulomb {
            coefficient: 0.05,
            slip_speed,
        };
        scene.solver.method = method;
        let asked = Run {
            start: Start::Equilibrium,
            rtol: Some(rtol),
            ..short(1e-3)
        };
        run(&scene, &asked)
    };
    let rtol = scene.solver.rtol.or_exact();
    let mut counts = Vec::new();
    for slip_speed in [0.1, 2e-3] {
        let truth = by(Method::DormandPrince, slip_speed, 1e-8);
        let found = by(Method::Adams, slip_speed, rtol / 100.0);
        let off = ["outer.ay", "inner.tilt_ax"].map(|name| {
            let [found, truth] = [&found, &truth].map(|of| of.get(name).unwrap());
            apart(found, truth)
        });
        println!(
            "{slip_speed} m/s: {off:?} in {} of {}",
            found.stats.nfev, truth.stats.nfev
        );
        assert!(off.iter().all(|off| *off < 1e-2), "{off:?}");
        counts.push(found.stats.nfev as f64);
    }
    assert!(counts[1] < 2.0 * counts[0], "{counts:?}");
}

/// A part of the reason why a mirror symmetry is broken, and the change that breaks it.
type Asymmetry = (&'static str, Box<dyn Fn(&mut Scene)>);

/// Limits: rings that may tilt do not where the motion is its own mirror image; then they are rings that stay parallel, bit by bit, and
/// their tilts are left out. What breaks that ever so little is reported.
#[test]
fn tilts_that_never_move_are_left_out() {
    let parallel = |scene: &Scene| {
        let mut scene = scene.clone();
        let support = &mut scene.inner_ring.support;
        (support.tilt_x, support.tilt_y) = (None, None);
        scene
    };
    let rates = |scene: &Scene| {
        let model = compile(scene).unwrap();
        let y = start(&model, &Start::Rolling).unwrap();
        let reduction = Reduction::of(&model, &y).unwrap();
        let mut dynamics = Dynamics::reduced(&model, reduction, &y);
        let kept = dynamics.compress(&y);
        let mut dy = vec![0.0; kept.len()];
        dynamics.rhs(0.0, &kept, &mut dy);
        dy
    };
    let mut images = presets::wheel_bearing(0.0);
    images.defects.clear();
    images.rows[1].start_angle = images.rows[0].start_angle;
    images.inner_ring.support.tilt_y = Some(Mount::Free);
    assert_eq!(rates(&images), rates(&parallel(&images)));
    images.rows[1].start_angle += 1e-3;
    let found = explain(&images).unwrap();
    assert_eq!(found.kept, found.states);
    let mut scene = tilted();
    scene.loads.remove("axial");
    let parallel = parallel(&scene);
    assert_eq!(rates(&scene), rates(&parallel));
    let [tilting, plain] = [&scene, &parallel].map(|scene| explain(scene).unwrap());
    assert_eq!(tilting.kept, plain.kept);
    let tilts = |tilting: &Explanation| {
        let mut omissions = tilting.omissions.iter();
        omissions
            .find(|of| of.what == "turning about x and y")
            .map(|of| of.degrees)
    };
    assert_eq!((tilts(&tilting), tilts(&plain)), (Some(2), None));
    let out = run(&scene, &rolling(2e-4));
    assert!(
        out.get("inner.tilt_x")
            .unwrap()
            .iter()
            .all(|tilt| *tilt == 0.0)
    );
    let asymmetries: Vec<Asymmetry> = vec![
        (
            "off the ring's centre",
            Box::new(|s| {
                s.loads.get_mut("radial").unwrap().at = Some([0.0, 0.0, 1e-6]);
            }),
        ),
        (
            "centre of mass",
            Box::new(|s| s.inner_ring.centre_of_mass = Some(1e-6)),
        ),
        (
            "tilts at the start",
            Box::new(|s| s.inner_ring.tilt = Some([0.0, 1e-6])),
        ),
        (
            "moment \"bend\"",
            Box::new(|s| {
                let bend = Moment::new(RingName::Inner, [1.0, 0.0, 0.0], 1e-3);
                s.moments.insert("bend".to_owned(), bend);
            }),
        ),
        (
            "along z",
            Box::new(|s| {
                let push = Load::new(RingName::Inner, [0.0, 0.0, 1.0], 1e-3);
                s.loads.insert("push".to_owned(), push);
            }),
        ),
    ];
    for (expected, change) in asymmetries {
        let mut scene = scene.clone();
        change(&mut scene);
        let found = explain(&scene).unwrap();
        assert_eq!(found.kept, found.states, "{expected}");
        let reasons: Vec<&String> = found.obstacles.iter().map(|of| &of.reason).collect();
        assert!(
            reasons.iter().any(|of| of.contains(expected)),
            "{expected}: {reasons:?}"
        );
    }
}

/// A ring mounted crooked tilts as long as it is held so; loads along a drive's axis tilt nothing.
#[test]
fn a_crooked_ring_stays_crooked() {
    let mut scene = tilted();
    scene.inner_ring.tilt = Some([1e-3, 0.0]);
    let support = &mut scene.inner_ring.support;
    (support.tilt_x, support.tilt_y) = (None, None);
    scene.probes.insert("moments".to_owned(), Probe::moments());
    let out = run(&scene, &rolling(2e-4));
    assert!(
        out.get("inner.tilt_x")
            .unwrap()
            .iter()
            .all(|tilt| *tilt == 1e-3)
    );
    let moment = out.get("moments.inner.x").unwrap();
    assert!(moment.iter().all(|m| m.is_finite()) && moment.iter().any(|m| m.abs() > 1e-3));
}

/// Oil lies in contacts of rings that tilt: all of its powers are lost.
#[test]
fn oil_lies_in_contacts_of_rings_that_tilt() {
    let mut scene = tilted();
    let mut oil = Lubricant::named("vg68", 328.15);
    oil.reference_load = Some(200.0);
    scene.lubricant = Some(oil);
    scene.probes = [("oil".to_owned(), Probe::lubrication(0))].into();
    let out = run(&scene, &rolling(2e-4));
    for name in ["slip_power", "rolling_power", "damping_power", "outer.film"] {
        let values = out.get(&format!("oil.{name}")).unwrap();
        assert!(values.iter().all(|value| *value >= 0.0), "{name}");
    }
}

/// A ring that tilts by more than 3° is doubted, at equilibrium and by a run; one of any bearing in use is not.
#[test]
fn rings_that_tilt_far_are_doubted() {
    let doubts = |scene: &Scene| {
        let still = ballrace::equilibrium(scene).unwrap().doubts;
        let out = run(scene, &short(1e-5));
        [
            still,
            out.warnings()
                .into_iter()
                .filter_map(|of| match of {
                    Warning::Doubtful(doubt) => Some(doubt),
                    _ => None,
                })
                .collect(),
        ]
        .map(|found: Vec<_>| {
            found
                .iter()
                .filter(|doubt| doubt.path == "tilt of a ring")
                .count()
        })
    };
    let mut scene = tilted();
    scene.friction = Friction::None;
    assert_eq!(doubts(&scene), [0, 0]);
    (scene.rows[0].clearance, scene.rows[0].ball_diameter) = (0.8e-3, 10e-3);
    scene.moments.insert(
        "bend".to_owned(),
        Moment::new(RingName::Inner, [1.0, 0.0, 0.0], 60.0),
    );
    assert_eq!(doubts(&scene), [1, 1]);
}
