//! The same scene at every instruction set that this machine has: whole runs, each set in a process of its
//! own, as users choose it.

use crate::common;
use std::f64::consts::{FRAC_PI_2, PI};
use std::process::Command;

use ballrace::InstructionSet;
use ballrace::scene::{Defect, Friction, Method, NormalLaw, Patch, Scene, Surface, presets};
use ballrace::{Run, Start, Warning};
use common::{apart, run, soon_over_the_spall};

/// A spall of 1.5 mm, as wide as half a millimetre, in the middle of a surface; on the outer race ahead of the ball that
/// stands at −90° by 2°, on the others under it.
fn spall(on: Surface) -> Defect {
    let mut defect = Defect::of(
        Patch::of_width(0.5e-3).length(1.5e-3).edge_radius(0.2e-3),
        on,
        match on {
            Surface::OuterRace => -FRAC_PI_2 + 2_f64.to_radians(),
            Surface::InnerRace => -FRAC_PI_2 - 2_f64.to_radians(),
            _ => PI,
        },
    )
    .at_offset(0.0);
    defect.ball = (on == Surface::Ball).then_some(0);
    defect
}

/// A 6205 without friction: halves of zones, with what must be looked at one by one.
fn plane(law: NormalLaw, on: Option<Surface>) -> Scene {
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    scene.contact.law = law;
    scene.friction = Friction::None;
    scene.defects = on
        .map(|on| ("spall".to_owned(), spall(on)))
        .into_iter()
        .collect();
    scene
}

fn mirrored() -> Scene {
    let mut scene = soon_over_the_spall(0.0);
    let spall = scene.defects["spall"].clone();
    let offset = spall.axial_offset.number().unwrap();
    let image = spall.in_row(1).at_offset(-offset);
    scene.rows[1].start_angle = scene.rows[0].start_angle;
    scene.defects.insert("image".to_owned(), image);
    scene
}

/// The ways in which runs evaluate contacts, each with a defect in reach.
fn scenes() -> Vec<(String, Scene)> {
    let mut scenes = Vec::new();
    for law in [NormalLaw::Hertz, iso()] {
        for on in [Surface::OuterRace, Surface::InnerRace, Surface::Ball] {
            scenes.push((
                format!("plane, {on:?}, {law:?}"),
                plane(law.clone(), Some(on)),
            ));
        }
        scenes.push((format!("plane, smooth, {law:?}"), plane(law, None)));
    }
    let mut friction = plane(NormalLaw::Hertz, Some(Surface::OuterRace));
    friction.friction = presets::deep_groove_6205(500.0, 0.0, 1800.0).friction;
    scenes.push(("plane with friction".to_owned(), friction));
    scenes.push(("wheel bearing".to_owned(), soon_over_the_spall(3000.0)));
    scenes.push(("mirrored rows".to_owned(), mirrored()));
    scenes
}

fn iso() -> NormalLaw {
    NormalLaw::Iso16281 {
        constant: 3.5948e10,
        length_ratio: 0.5,
    }
}

/// Steps of a pair at its cap, which rounding does not change, and those of the default, which follow the error: where
/// stability holds them they differ after a while, and the signal with them by what the tolerance leaves.
/// Method, tolerance, and how far signals may be apart.
const METHODS: [(Method, f64, f64); 2] = [
    (Method::DormandPrince, 1e-6, 1e-5),
    (Method::Adams, 1e-7, 1e-2),
];

/// Vertical acceleration of the outer ring over 1.5 ms, a line a scene, by both methods.
fn signals() -> Vec<Vec<f64>> {
    METHODS
        .iter()
        .flat_map(|(method, rtol, _)| signals_by(*method, *rtol))
        .collect()
}

fn signals_by(method: Method, rtol: f64) -> Vec<Vec<f64>> {
    let of = |(_, scene): &(String, Scene)| {
        let short = Run {
            start: Start::Equilibrium,
            method: Some(method),
            rtol: Some(rtol),
            ..common::short(1.5e-3)
        };
        let out = run(scene, &short);
        let inaccurate = |warning: &Warning| warning.category() == "accuracy";
        assert!(
            !out.warnings().iter().any(inaccurate),
            "{:?}",
            out.warnings()
        );
        out.get("outer.ay").unwrap().to_vec()
    };
    scenes().iter().map(of).collect()
}

/// What another process of this program is asked to print.
const CHILD: &str = "levels::print_signals_of_this_level";

#[test]
#[ignore = "a part of levels_agree_over_whole_runs, which starts it in a process of its own for every instruction set"]
fn print_signals_of_this_level() {
    for signal in signals() {
        let bits: Vec<String> = signal.iter().map(|x| x.to_bits().to_string()).collect();
        println!("signal {}", bits.join(" "));
    }
}

fn signals_at(instructions: &str) -> Vec<Vec<f64>> {
    let child = Command::new(std::env::current_exe().unwrap())
        .args([CHILD, "--exact", "--ignored", "--nocapture"])
        .env("BALLRACE_SIMD", instructions)
        .output()
        .unwrap();
    let text = String::from_utf8(child.stdout).unwrap();
    assert!(child.status.success(), "{instructions}: {text}");
    let number = |bits: &str| f64::from_bits(bits.parse().unwrap());
    // The test program writes the name of the test before the first line.
    let signals = text.lines().filter_map(|line| line.split_once("signal "));
    signals
        .map(|(_, bits)| bits.split(' ').map(number).collect())
        .collect()
}

/// Analytic: levels differ by rounding, which grows by a factor of e a millisecond; contacts that an instruction set loses differ by
/// all.
#[test]
fn levels_agree_over_whole_runs() {
    let names: Vec<String> = scenes().into_iter().map(|(name, _)| name).collect();
    let names =
        METHODS.map(|(method, _, allowed)| names.iter().map(move |name| (name, method, allowed)));
    let names: Vec<_> = names.into_iter().flatten().collect();
    let truth = signals_at("baseline");
    assert_eq!(truth.len(), names.len());
    for instructions in InstructionSet::available() {
        let found = signals_at(instructions.name());
        for (((name, method, allowed), found), truth) in names.iter().zip(&found).zip(&truth) {
            let error = apart(found, truth);
            println!("{name}, {method:?}, {instructions}: {error:.1e}");
            assert!(
                error < *allowed,
                "{name}, {method:?}, {instructions}: {error:.1e}"
            );
        }
    }
}

/// Prints which levels were tested and which this machine lacks; `tests/run` shows it.
#[test]
fn levels_of_this_machine() {
    let here: Vec<&str> = InstructionSet::available()
        .iter()
        .map(InstructionSet::name)
        .collect();
    let known = InstructionSet::known().iter().copied();
    let missing: Vec<&str> = known.filter(|name| !here.contains(name)).collect();
    println!("vector levels tested: {}", here.join(", "));
    println!(
        "vector levels not on this machine, so not tested: {}",
        if missing.is_empty() {
            "none".to_owned()
        } else {
            missing.join(", ")
        }
    );
    assert!(here.contains(&"baseline"));
}
