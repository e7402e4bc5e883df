//! The scenes by which a change of the code is judged for speed: a line each with its name, the seconds that a simulated second takes
//! (median of the runs), evaluations of the right-hand side, and a number that changes with any bit of the signals.
//!
//! `cargo run --release -p ballrace-benches --bin scenes -- 9`, and behind it a part of a name for some of them. To compare two builds, run their programs in turn, once a time.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::time::Instant;

use ballrace::scene::presets::Arrangement;
use ballrace::scene::{
    Defect, Friction, Lubricant, Patch, Pit, Scene, Spin, Surface, Texture, catalogue, presets,
};
use ballrace::{Run, simulate};

fn scenes() -> Vec<(&'static str, Scene)> {
    let dry = presets::deep_groove_6205(500.0, 0.0, 1797.0);
    let mut oiled = dry.clone();
    oiled.lubricant = Some(Lubricant::named("vg68", 328.15));
    let mut plane = dry.clone();
    plane.friction = Friction::None;
    let mut textured = dry.clone();
    let mut texture = Texture::of_races(1e-9);
    texture.ball = 3e-11;
    textured.rows[0].texture = Some(texture);
    let pitted = |pit: Defect| {
        let mut scene = dry.clone();
        scene.defects.insert("pit".to_owned(), pit);
        scene
    };
    let pit = |on| Defect::of(Pit::of_width(0.178e-3), on, -std::f64::consts::FRAC_PI_2);
    let pits = [pit(Surface::OuterRace), pit(Surface::Ball).on_ball(0)].map(pitted);
    let [pitted_race, pitted_ball] = pits;
    let mut pair = presets::angular_contact_pair(Arrangement::BackToBack, 1000.0, 500.0, 1797.0);
    become_of(&mut pair, "7208B");
    let mut free = presets::deep_groove_6205(500.0, 800.0, 1797.0);
    become_of(&mut free, "7205B");
    free.spin = Some(Spin::Free);
    let mut larger = dry.clone();
    become_of(&mut larger, "6206");
    let spalled = |mut scene: Scene, width: f64| {
        let patch = Patch::of_width(width).length(3e-3).edge_radius(30e-6);
        let spall = Defect::of(patch, Surface::OuterRace, -std::f64::consts::FRAC_PI_2);
        scene.defects.insert("spall".to_owned(), spall);
        scene
    };
    vec![
        ("wheel bearing", presets::wheel_bearing(3000.0)),
        ("6205", dry.clone()),
        ("6205 spall 0.5 mm", spalled(dry.clone(), 0.5e-3)),
        ("6205 spall 1.5 mm", spalled(dry.clone(), 1.5e-3)),
        ("6206 spall 0.8 mm", spalled(larger, 0.8e-3)),
        ("6205 pitted race", pitted_race),
        ("6205 pitted ball", pitted_ball),
        ("6205 in oil", oiled),
        ("6205 textured", textured),
        ("plane 6205", plane),
        ("7208B pair", pair),
        ("free 7205B", free),
        ("cornering wheel", presets::cornering_wheel(0.3)),
    ]
}

/// Puts the rows and rings of another bearing into a scene.
fn become_of(scene: &mut Scene, designation: &str) {
    let bearing = catalogue::find(designation).expect("it is there");
    for row in &mut scene.rows {
        let of = bearing.row();
        (row.ball_count, row.ball_diameter) = (of.ball_count, of.ball_diameter);
        (row.pitch_diameter, row.contact_angle) = (of.pitch_diameter, of.contact_angle);
        row.outer_conformity = of.outer_conformity;
        row.inner_conformity = of.inner_conformity;
        row.axial_position *= bearing.width / 15e-3;
    }
    let rows = scene.rows.len() as f64;
    for (ring, diameter) in [
        (&mut scene.outer_ring, bearing.outside_diameter),
        (&mut scene.inner_ring, bearing.bore),
    ] {
        (ring.diameter, ring.width) = (Some(diameter), Some(rows * bearing.width));
    }
}

fn main() {
    let runs = std::env::args().nth(1).and_then(|count| count.parse().ok());
    let runs: usize = runs.unwrap_or(1).max(1);
    let run = Run {
        duration: 0.03,
        threads: 1,
        settle: Some(0.0),
        ..Run::default()
    };
    let only = std::env::args().nth(2).unwrap_or_default();
    for (name, scene) in scenes() {
        if !name.contains(&only) {
            continue;
        }
        let mut seconds = Vec::new();
        let mut last = (0, 0);
        for _ in 0..runs {
            let begun = Instant::now();
            let out = simulate(&scene, &run).expect("the scene runs");
            seconds.push(begun.elapsed().as_secs_f64() / run.duration);
            let mut bits = DefaultHasher::new();
            let numbers = out.columns.iter().flat_map(|column| &column.values);
            numbers.for_each(|x| x.to_bits().hash(&mut bits));
            last = (out.stats.nfev, bits.finish());
        }
        seconds.sort_by(f64::total_cmp);
        println!(
            "{name:17} {:8.4} {:8} {:016x}",
            seconds[runs / 2],
            last.0,
            last.1
        );
    }
}
