//! Geometries at the edge of what a bearing can be.
//!
//! Each test names what could fail, shows the case, and holds it to a truth. `--nocapture` prints the numbers.

use crate::common;
use std::f64::consts::PI;

use ballrace::compile;
use ballrace::scene::{
    ContactQuantity, ContactsProbe, Friction, NormalLaw, Probe, RingName, Scene, Slices, presets,
};
use ballrace::{Error, Run, Start, Warning, equilibrium, simulate, start};
use common::{rms, run, short};

/// Loads of all contacts with one race.
fn loads_probe(scene: &mut Scene, race: RingName) {
    scene.probes.insert(
        "loads".to_owned(),
        ContactsProbe::of_row(0)
            .races([race])
            .quantities([ContactQuantity::Load])
            .into(),
    );
}

/// Runs for some milliseconds from equilibrium and holds the sum of the forces of the balls on the inner ring to the
/// load: what is carried at the start is carried on the whole. Returns the effort.
fn carried(scene: &Scene, duration: f64) -> usize {
    let eq = equilibrium(scene).unwrap_or_else(|error| panic!("{}: {error}", scene.name));
    let loaded = eq.balls.iter().filter(|ball| ball.inner.load > 0.0).count();
    let mut scene = scene.clone();
    scene
        .probes
        .insert("inner_forces".to_owned(), Probe::forces("inner"));
    let out = run(&scene, &short(duration));
    let column = |name: &str| out.get(name).unwrap();
    let sum = |direction: &str| -> f64 {
        let carried: f64 = ["contact", "damping", "friction"]
            .iter()
            .map(|part| {
                column(&format!("inner_forces.{part}.{direction}"))
                    .iter()
                    .sum::<f64>()
            })
            .sum();
        carried / out.t.len() as f64
    };
    let (radial, axial) = (
        scene.loads["radial"].force.at(0.0),
        scene.loads["axial"].force.at(0.0),
    );
    let load = radial.hypot(axial);

    println!(
        "{}: {loaded} balls loaded, carries {:.1} N and {:.1} N of {radial} N and {axial} N; {} evaluations, residual {:.1e}",
        scene.name,
        sum("y"),
        sum("z"),
        out.stats.nfev,
        out.stats.acceleration_residual.unwrap_or(0.0),
    );
    // The inner ring's own weight is carried too: 1 kg and less.
    assert!(
        (sum("y") - radial).abs() < 0.02 * load + 15.0,
        "{}",
        sum("y")
    );
    assert!(
        (sum("z") + axial).abs() < 0.02 * load + 15.0,
        "{}",
        sum("z")
    );
    for column in &out.columns {
        assert!(
            column.values.iter().all(|x| x.is_finite()),
            "{}",
            column.name
        );
    }
    // Some of these scenes are meant to be odd; those doubts are the scene's.
    let inaccurate = |warning: &Warning| warning.category() == "accuracy";
    assert!(
        !out.warnings().iter().any(inaccurate),
        "{:?}",
        out.warnings()
    );
    out.stats.nfev
}

fn bearing(name: &str, radial: f64, axial: f64) -> Scene {
    let mut scene = presets::deep_groove_6205(radial, axial, 1800.0);
    name.clone_into(&mut scene.name);
    scene
}

/// Failure: contact laws whose derivative is singular at touch meet balls that just touch. Truth: force balance.
#[test]
fn zero_and_negative_clearance() {
    for clearance in [0.0, 1e-9, -1e-6, -20e-6] {
        for law in NormalLaw::all() {
            let mut scene = bearing(&format!("clearance {clearance:e}"), 500.0, 0.0);
            scene.rows[0].clearance = clearance;
            scene.contact.law = law;
            carried(&scene, 2e-3);
        }
    }
}

/// Truth: symmetry. By interference alone every ball carries the same, and stays so at rest.
#[test]
fn interference_alone_loads_all_balls_alike() {
    let mut scene = presets::deep_groove_6205(0.0, 0.0, 0.0);
    scene.rows[0].clearance = -20e-6;
    scene.gravity = [0.0; 3];
    let eq = equilibrium(&scene).unwrap();
    let loads: Vec<f64> = eq.balls.iter().map(|ball| ball.inner.load).collect();
    println!("{loads:?}");
    assert!(
        loads
            .iter()
            .all(|load| (load / loads[0] - 1.0).abs() < 1e-9 && *load > 100.0)
    );
}

/// Failure: contacts open and close as balls leave and enter the load zone, each time at order two and a half.
/// Truth: the load zone itself (some balls always loaded, some never all), no pulls, and the residual.
#[test]
fn balls_leave_and_enter_the_load_zone() {
    let mut scene = bearing("load zone", 500.0, 0.0);
    scene.rows[0].clearance = 30e-6;
    loads_probe(&mut scene, RingName::Inner);
    let out = run(
        &scene,
        &Run {
            duration: 30e-3,
            settle: Some(0.0),
            ..Run::default()
        },
    );
    let balls: Vec<&[f64]> = (0..9)
        .map(|j| out.get(&format!("loads.ball{j}.inner.load")).unwrap())
        .collect();
    let crossings: usize = balls
        .iter()
        .map(|load| {
            load.windows(2)
                .filter(|pair| (pair[0] > 0.0) != (pair[1] > 0.0))
                .count()
        })
        .sum();
    let loaded = |k: usize| balls.iter().filter(|load| load[k] > 0.0).count();
    println!(
        "{crossings} contacts made or broken, {} rejected of {} steps",
        out.stats.rejected, out.stats.accepted
    );
    // Nine balls enter and leave once a turn of the cage, 0.3983 of the shaft's.
    let expected = 2.0 * 9.0 * 0.3983 * 30.0 * 30e-3;
    assert!((crossings as f64 - expected).abs() < 2.0, "{expected}");
    assert!((0..out.t.len()).all(|k| (1..9).contains(&loaded(k))));
    assert_eq!(out.stats.clamped_pulls, 0);
    assert!(out.warnings().is_empty(), "{:?}", out.warnings());
}

/// Failure: thrust lifts the zone over the shoulder, where there is no race left. Truth: the same bearing with high
/// shoulders, which carries at a smaller angle. Instead: truncated, counted at every step and warned of.
#[test]
fn a_contact_over_the_shoulder_is_cut_counted_and_warned_of() {
    let high = bearing("high shoulders", 0.0, 4000.0);
    let angle = equilibrium(&high).unwrap().balls[0].outer.angle.unwrap();
    for (share, over) in [(2.5, false), (1.1, true)] {
        let mut scene = high.clone();
        let edge = angle * share;
        scene.rows[0].outer_shoulders = Some([edge; 2]);
        let out = run(&scene, &short(0.5e-3));
        println!(
            "contact at {:.1}°, shoulder at {:.1}°: {} cut in {} steps, {:?}",
            angle.to_degrees(),
            edge.to_degrees(),
            out.stats.truncated_contacts,
            out.stats.accepted,
            out.warnings()
        );
        assert_eq!(out.stats.truncated_contacts > out.stats.accepted, over);
        let warned = out
            .warnings()
            .iter()
            .any(|w| matches!(w, Warning::Shoulders { .. }));
        assert_eq!(warned, over);
    }
}

/// Failure: as a groove closes around the ball the contact grows to the ball's own size and K of Hertz to infinity.
/// Truth: force balance; 0.5 itself is refused.
#[test]
fn conformity_close_to_one_half() {
    for law in NormalLaw::all() {
        for conformity in [0.51, 0.501, 0.5001] {
            let mut scene = bearing(&format!("conformity {conformity}"), 500.0, 0.0);
            scene.contact.law = law.clone();
            (
                scene.rows[0].outer_conformity,
                scene.rows[0].inner_conformity,
            ) = (conformity, conformity);
            carried(&scene, 1e-3);
        }
    }
    let mut scene = bearing("conformity", 500.0, 0.0);
    scene.rows[0].outer_conformity = 0.5;
    assert!(
        matches!(compile(&scene), Err(Error::Scene { path, .. }) if path == "rows[0].outer_conformity")
    );
}

/// Failure: at a vanishing angle thrust divides by sin α. Truth: Z Q sin α = F of pure thrust at the found angle.
#[test]
fn contact_angles_near_zero_and_45_degrees() {
    for degrees in [0.0_f64, 1e-6, 0.1, 44.9, 45.0] {
        let mut scene = bearing(&format!("angle {degrees}°"), 0.0, 1000.0);
        scene.rows[0].contact_angle = degrees.to_radians();
        scene.rows[0].clearance = 0.0;
        scene.gravity = [0.0; 3];
        let eq = equilibrium(&scene).unwrap();
        let thrust: f64 = eq
            .balls
            .iter()
            .map(|ball| ball.inner.load * ball.inner.angle.unwrap().sin())
            .sum();
        println!(
            "{degrees}°: operates at {:.2}°",
            eq.balls[0].inner.angle.unwrap().to_degrees()
        );
        assert!((thrust / 1000.0 - 1.0).abs() < 1e-6, "{thrust}");
        carried(&scene, 1e-3);
    }
}

/// Failure: a light or small ball has a contact period that steps chosen for steel step over.
/// Truth: the highest frequency goes with 1/√m; the step cap follows it, and the residual stays small.
#[test]
fn light_and_small_balls() {
    let steel = compile(&bearing("steel", 500.0, 0.0))
        .unwrap()
        .scales()
        .frequency;
    let mut calls = Vec::new();
    for density in [7850.0, 3200.0, 100.0] {
        let mut scene = bearing(&format!("density {density}"), 500.0, 0.0);
        scene.materials.balls.density = density;
        let frequency = compile(&scene).unwrap().scales().frequency;
        assert!(
            (frequency / steel - (7850.0_f64 / density).sqrt()).abs() < 0.02 * frequency / steel
        );
        calls.push(carried(&scene, 0.5e-3));
    }
    // The first steps are short, whatever the balls.
    assert!(calls[2] > 6 * calls[0], "{calls:?}");
    for scale in [0.1, 0.01] {
        let mut scene = bearing(&format!("size {scale}"), 500.0 * scale * scale, 0.0);
        let row = &mut scene.rows[0];
        (row.ball_diameter, row.pitch_diameter, row.clearance) = (
            row.ball_diameter * scale,
            row.pitch_diameter * scale,
            row.clearance * scale,
        );
        (scene.outer_ring.mass, scene.outer_ring.inertia) = (Some(0.1 * scale), None);
        (scene.inner_ring.mass, scene.inner_ring.inertia) = (Some(0.1 * scale), None);
        (scene.outer_ring.diameter, scene.inner_ring.diameter) = (None, None);
        scene.cage = None;
        carried(&scene, 0.2e-3);
    }
}

/// Truth: with one ball under the load it carries all of it; with sixty the load is shared as equilibrium says.
#[test]
fn one_ball_and_sixty() {
    let mut scene = bearing("one ball", 500.0, 0.0);
    scene.rows[0].ball_count = 1;
    scene.drive = ballrace::scene::Drive::Speed(0.0.into());
    // A single ball cannot hold the ring sideways.
    let side = ballrace::scene::Mount::Spring {
        stiffness: 1e6,
        damping: 300.0,
    };
    (scene.inner_ring.support.x, scene.inner_ring.support.z) = (Some(side.clone()), Some(side));
    carried(&scene, 1e-3);
    let mut scene = bearing("sixty balls", 5000.0, 0.0);
    let row = &mut scene.rows[0];
    (row.ball_count, row.pitch_diameter) = (60, 200e-3);
    (
        scene.outer_ring.mass,
        scene.outer_ring.diameter,
        scene.outer_ring.width,
    ) = (Some(2.0), None, None);
    (
        scene.inner_ring.mass,
        scene.inner_ring.diameter,
        scene.inner_ring.width,
    ) = (Some(2.0), None, None);
    carried(&scene, 1e-3);
}

/// Failure: a slice that enters the zone is a kink, and few slices are a model error of their own.
/// Truth: fitted nodes on the same scene, whose zone ends where the contact does.
#[test]
fn few_slices_kink_where_fitted_nodes_do_not() {
    let mut scene = common::soon_over_the_spall(3000.0);
    scene.friction = Friction::None;
    let found = [Slices::Fixed(20), Slices::Fixed(200), Slices::Fitted(6)].map(|slices| {
        scene.contact.slices = slices;
        let tight = Run {
            rtol: Some(1e-9),
            ..short(2e-3)
        };
        let out = run(&scene, &tight);
        let size = rms(out.get("outer.ay").unwrap());
        println!(
            "{slices:?}: {} of {} steps rejected, rms {size:.2} m/s²",
            out.stats.rejected, out.stats.accepted
        );
        (out.stats.rejected, size)
    });
    assert!(2 * found[0].0 > 5 * found[2].0);
    let error = |i: usize| (found[i].1 / found[2].1 - 1.0).abs();
    assert!(error(0) > 0.05 && error(1) < 0.01);
}

/// Failure: a ball that is thrown out of its groove over its shoulders meets no race and flies on for ever. Truth: geometry.
/// Instead: an error with the ball, the time and what it touched last.
#[test]
fn a_ball_that_leaves_its_groove_ends_the_run() {
    let mut scene = bearing("escape", 500.0, 0.0);
    scene.rows[0].outer_shoulders = Some([0.5; 2]);
    scene.rows[0].inner_shoulders = Some([0.5; 2]);
    let model = compile(&scene).unwrap();
    let mut y = start(&model, &Start::Equilibrium).unwrap();
    let vz = model
        .names()
        .iter()
        .position(|name| name == "row0.ball0.vz")
        .unwrap();
    y[vz] = 500.0;
    let run = Run {
        start: Start::State(y),
        ..short(2e-3)
    };
    let out = simulate(&scene, &run);
    let error = out.map(|out| out.stats).unwrap_err();
    println!("{error}");
    let Error::Integration {
        body,
        time,
        contacts,
        ..
    } = error
    else {
        panic!("{error}");
    };
    assert_eq!(body, "row0.ball0");
    assert!(
        contacts.iter().all(|contact| contact.starts_with("row0.")),
        "{contacts:?}"
    );
    assert!(time > 0.0 && time < PI * 7.94e-3 / 500.0);
}
