//! Detects a ball that has left its groove, on every path of an evaluation and at every instruction set.

use std::f64::consts::FRAC_PI_2;

use super::Dynamics;
use crate::integrate::System;
use crate::model::{BodyId, Dof};
use crate::reduction::Reduction;
use crate::scene::{
    Defect, Friction, Method, Patch, Profile, Scene, Slices, Surface, TimeFunction, Waviness,
    presets,
};
use crate::simd::InstructionSet;
use crate::statics::compile;
use crate::{Error, Model, Run, Start, simulate, start};

/// Truth: geometry. Where a ball is, by what it was moved.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Way {
    /// A ball pressed into the outer race by more than half its radius.
    Pressed,
    /// A ball beside the groove, out of it along the axis.
    Beside,
    /// An inner ring lifted off its balls, which are all at the bottom.
    Off,
}

const WAYS: [Way; 3] = [Way::Pressed, Way::Beside, Way::Off];

/// A way to evaluate contacts: a scene that takes it, and in how many ways a ball may be lost there; where axial places
/// are kept by symmetry none gets beside its groove.
struct Path {
    name: &'static str,
    scene: Scene,
    ways: &'static [Way],
}

fn path(name: &'static str, scene: &Scene, change: impl FnOnce(&mut Scene)) -> Path {
    let mut scene = scene.clone();
    change(&mut scene);
    Path {
        name,
        scene,
        ways: &WAYS,
    }
}

/// The same where all stays in a plane.
fn plane(name: &'static str, scene: &Scene, change: impl FnOnce(&mut Scene)) -> Path {
    Path {
        ways: &[Way::Pressed, Way::Off],
        ..path(name, scene, change)
    }
}

fn spall() -> Defect {
    Defect::of(
        Patch::of_width(1e-3).length(4e-3).edge_radius(0.1e-3),
        Surface::OuterRace,
        -FRAC_PI_2,
    )
    .at_offset(0.0)
}

fn two_rows() -> Scene {
    let mut scene = presets::wheel_bearing(0.0);
    (scene.cage, scene.friction) = (None, Friction::None);
    scene.defects.clear();
    let angle = scene.rows[0].start_angle;
    for row in &mut scene.rows {
        (row.contact_angle, row.start_angle) = (0.0, angle);
    }
    scene
}

fn paths() -> Vec<Path> {
    let mut rough = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    rough.cage = None;
    let mut smooth = rough.clone();
    smooth.friction = Friction::None;
    let mut thrust = smooth.clone();
    thrust.loads.get_mut("axial").unwrap().force = 200.0.into();
    let wave = Waviness {
        order: 12,
        amplitude: 1e-6,
        phase: 0.0,
    };
    let sine = Profile::Sine {
        mean: 500.0,
        amplitude: 10.0,
        frequency: 50.0,
        phase: 0.0,
    };
    let whole = |s: &mut Scene| s.solver.reduce = false;
    vec![
        path("all, by eights", &rough, whole),
        path("all, on fixed slices", &rough, |s| {
            s.contact.slices = Slices::Fixed(50);
            whole(s);
        }),
        path("all, one by one", &rough, |s| {
            s.defects.insert("spall".to_owned(), spall());
            whole(s);
        }),
        plane("halves of zones by eights", &rough, |_| {}),
        path("without friction", &thrust, |_| {}),
        plane("without friction in the plane", &smooth, |s| {
            let radial = s.loads.get_mut("radial").unwrap();
            radial.force = TimeFunction::Profile(sine);
        }),
        plane("the same on wavy and spalled races", &smooth, |s| {
            s.rows[0].inner_waviness = vec![wave];
            s.defects.insert("spall".to_owned(), spall());
        }),
        plane("one row for two", &two_rows(), |_| {}),
    ]
}

/// A state of all bodies with balls lost one way, and the first of them.
fn lose(model: &Model, way: Way) -> Vec<f64> {
    let mut y = start(model, &Start::Equilibrium).unwrap();
    for (j, ball) in model.balls.iter().enumerate() {
        let radius = ball.side.radius;
        let at = |dof: Dof| model.layout().at(BodyId::ball(j), dof);
        let [x, y_, z] = Dof::TRANSLATIONS.map(at);
        let distance = y[x].hypot(y[y_]);
        match way {
            // One of each row, so that rows stay images.
            Way::Pressed if ball.index == 0 => {
                let further = 1.0 + 0.6 * radius / distance;
                (y[x], y[y_]) = (further * y[x], further * y[y_]);
            }
            // All of them, so that all keep the same place.
            Way::Beside => y[z] += 2.2 * radius,
            Way::Off => {
                let angle = -FRAC_PI_2 + 5e-3 * ball.index as f64;
                (y[x], y[y_]) = (distance * angle.cos(), distance * angle.sin());
            }
            Way::Pressed => {}
        }
    }
    if way == Way::Off {
        y[model.layout().at(BodyId::INNER, Dof::Y)] += 0.8 * model.balls[0].side.radius;
    }
    y
}

/// Lost balls are noticed by an evaluation, at every instruction set that there is.
#[test]
fn an_evaluation_notices_lost_balls_on_every_path() {
    for path in paths() {
        for instructions in InstructionSet::available() {
            let model = compile(&path.scene)
                .unwrap()
                .with_instructions(instructions);
            let fine = start(&model, &Start::Equilibrium).unwrap();
            assert_eq!(
                first_lost(&model, &fine),
                None,
                "{}, {instructions}",
                path.name
            );
            for way in path.ways {
                let lost = first_lost(&model, &lose(&model, *way));
                assert_eq!(
                    lost,
                    Some(BodyId::ball(0)),
                    "{}, {instructions}, {way:?}",
                    path.name
                );
            }
        }
    }
}

fn first_lost(model: &Model, y: &[f64]) -> Option<BodyId> {
    let mut dynamics = Dynamics::begin(model, Reduction::of(model, y).as_ref(), y);
    let own = dynamics.compress(y);
    dynamics.rhs(0.0, &own, &mut vec![0.0; own.len()]);
    dynamics.lost()
}

fn ends(name: &str, scene: &Scene, begin: Start, duration: f64) -> (String, String, f64) {
    let run = Run {
        duration,
        fs: 10e3,
        start: begin,
        ..Run::default()
    };
    match simulate(scene, &run) {
        Err(Error::Integration {
            body, reason, time, ..
        }) => (body, reason, time),
        Err(other) => panic!("{name}: {other}"),
        Ok(_) => panic!("{name}: came to its end"),
    }
}

/// A run ends by name, by whatever method, and says how the ball left.
#[test]
fn a_run_ends_when_a_ball_is_lost() {
    let mut all = paths();
    let mut other = paths().swap_remove(0);
    other.scene.solver.method = Method::Verner;
    all.push(other);
    for path in all {
        let model = compile(&path.scene).unwrap();
        for way in path.ways {
            let expected = match way {
                Way::Pressed => "m into the outer race",
                Way::Beside => "m beside the middle of the",
                Way::Off => "m off the inner race",
            };
            let name = format!("{}, {:?}, {way:?}", path.name, path.scene.solver.method);
            let begin = Start::State(lose(&model, *way));
            let (body, reason, time) = ends(&name, &path.scene, begin, 1e-3);
            assert_eq!(body, "row0.ball0", "{name}: {reason}");
            assert!(reason.contains(expected), "{name}: {reason}");
            assert!(time < 1e-4, "{name}: {time}");
        }
    }
}

/// Nothing keeps frictionless balls without a cage apart. They gather in the load zone, the ring that they hold on one side
/// only falls off at the other, and the run ends there on every path, by whatever instructions.
#[test]
fn a_ring_that_falls_off_its_balls_ends_the_run() {
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    (scene.friction, scene.cage) = (Friction::None, None);
    for reduce in [true, false] {
        scene.solver.reduce = reduce;
        let (body, reason, time) = ends("6205", &scene, Start::Equilibrium, 0.3);
        println!("{reduce}: {time} s, {body}: {reason}");
        assert!(body.starts_with("row0.ball"), "{body}");
        assert!(reason.contains("give the scene a cage"), "{reason}");
    }
}
