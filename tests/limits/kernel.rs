//! Contacts by eights against contacts one by one: `rhs` uses the former wherever surfaces are whole, `forces` the
//! latter always, and `rhs` at every instruction set that this processor has.

use crate::common;
use std::f64::consts::{FRAC_PI_2, PI};

use ballrace::InstructionSet;
use ballrace::compile;
use ballrace::dynamics::Dynamics;
use ballrace::dynamics::contributions;
use ballrace::dynamics::rhs;
use ballrace::inspect;
use ballrace::scene::{
    Damage, Defect, Friction, GothicArch, Lubricant, Mount, NormalLaw, Patch, Pit, Scene, Slices,
    Surface, Texture, Waviness, presets,
};
use ballrace::{Model, Race, Start, start};
use common::{Noise, effects, oiled, through_points};

/// Largest difference of the two evaluations at random states around an equilibrium, over the sum of the contact
/// loads on a body and 1 kN: the distance of two axes is known to 4e-18 m, which a contact of some 1e8 N/m turns
/// into 4e-10 N whatever its load.
fn difference(scene: &Scene, instructions: InstructionSet) -> f64 {
    let model = compile(scene).unwrap().with_instructions(instructions);
    let calm = start(&model, &Start::Equilibrium).unwrap();
    difference_around(&model, &calm)
}

/// The same with rings that tilt, but for moments on them.
fn difference_tilted(scene: &Scene, instructions: InstructionSet) -> f64 {
    let parallel = compile(scene).unwrap();
    let calm = start(&parallel, &Start::Equilibrium).unwrap();
    let mut scene = scene.clone();
    for ring in [&mut scene.outer_ring, &mut scene.inner_ring] {
        (ring.support.tilt_x, ring.support.tilt_y) = (Some(Mount::Free), Some(Mount::Free));
    }
    // Of rings that nothing keeps from tilting there is no equilibrium to take it from.
    let of_rows = scene.rows.iter_mut().flat_map(|row| &mut row.lubricant);
    for oil in of_rows.chain(&mut scene.lubricant) {
        oil.reference_load = Some(1000.0);
    }
    // What turns round defects of balls across a tilted axis is not among the forces by origin.
    scene
        .defects
        .retain(|_, defect| matches!(defect.damage, Damage::Patch(_)) || defect.ball.is_none());
    let tilted = compile(&scene).unwrap().with_instructions(instructions);
    let (places, speeds) = calm.split_at(calm.len() / 2);
    difference_around(&tilted, &[places, &[0.0; 4], speeds, &[0.0; 4]].concat())
}

fn difference_around(model: &Model, calm: &[f64]) -> f64 {
    let mut dynamics = Dynamics::new(model);
    let (mut noise, mut worst) = (Noise(1), 0.0_f64);
    for _ in 0..20 {
        let (half, bodies) = (calm.len() / 2, 4 * model.body_count());
        let mut y = calm.to_vec();
        for i in 0..half {
            let (place, speed) = match i {
                _ if i >= bodies => (1e-3, 5.0),
                _ if i % 4 < 3 => (10e-6, 0.05),
                _ => (0.5, 5.0),
            };
            y[i] += place * noise.next();
            y[half + i] += speed * noise.next();
        }
        let found = dynamics.forces(0.0, &y);
        let parts = contributions(model, 0.0, &y);
        let loads =
            |j: usize| Race::BOTH.map(|race| inspect::contact(model, &y, j, race).unwrap().load);
        let balls: Vec<[f64; 2]> = (0..model.body_count() - 2).map(loads).collect();
        for (b, force) in found.iter().enumerate() {
            let size: f64 = if b < 2 {
                balls.iter().map(|load| load[b]).sum()
            } else {
                balls[b - 2].iter().sum()
            };
            let tilts = half > bodies;
            for i in 0..if tilts && b < 2 { 3 } else { 4 } {
                let sum: f64 = parts.iter().map(|(_, part)| part[4 * b + i]).sum();
                let lever = if i < 3 { 1.0 } else { 6e-3 };
                worst = worst.max((sum - force[i]).abs() / (lever * (size + 1e3)));
            }
        }
    }
    worst
}

fn scenes() -> Vec<(String, Scene)> {
    let mut scenes = Vec::new();
    for law in NormalLaw::all() {
        for slices in [Slices::Fitted(5), Slices::Fitted(6), Slices::Fixed(70)] {
            let mut scene = presets::wheel_bearing(3000.0);
            scene.contact.law = law.clone();
            scene.contact.slices = slices;
            scenes.push((format!("{law:?} {slices:?}"), scene));
        }
    }
    let wheel = || presets::wheel_bearing(3000.0);
    for slices in [Slices::Fitted(6), Slices::Fixed(70)] {
        for law in NormalLaw::all() {
            let mut scene = through_points(&wheel(), 200);
            (scene.contact.law, scene.contact.slices) = (law, slices);
            scenes.push((format!("points, {slices:?}"), scene));
        }
    }
    let mut add = |name: &str, scene: Scene| scenes.push((name.to_owned(), scene));
    add("few balls", presets::deep_groove_6205(800.0, 200.0, 3000.0));
    let mut scene = wheel();
    scene.friction = Friction::None;
    add("no friction", scene);
    let mut scene = wheel();
    scene.friction = Friction::Stribeck {
        static_coefficient: 0.12,
        kinetic_coefficient: 0.05,
        stribeck_speed: 0.1,
        slip_speed: 0.05,
    };
    add("Stribeck friction", scene);
    let mut scene = wheel();
    (scene.contact.damping, scene.contact.clamp_pull) = (20.0, false);
    add("damping that pulls", scene);
    let mut scene = wheel();
    scene.rows[1].inner_waviness = vec![Waviness::new(7, 2e-6, 0.3)];
    scene.rows[0].diameter_errors = (0..13).map(|j| 1e-6 * f64::from(j % 4)).collect();
    add("waves and unequal balls", scene);
    let mut scene = wheel();
    scene.rows[0].outer_shoulders = Some([15_f64.to_radians(), 60_f64.to_radians()]);
    add("a shoulder in the zone", scene);
    let mut scene = wheel();
    for (name, on, ball) in [
        ("inner", Surface::InnerRace, None),
        ("ball", Surface::Ball, Some(1)),
    ] {
        let angle = if ball.is_some() { PI } else { -FRAC_PI_2 };
        let mut defect = Defect::of(
            Patch::of_width(1e-3).length(2e-3).edge_radius(0.3e-3),
            on,
            angle,
        )
        .at_offset(0.5e-3);
        defect.ball = ball;
        scene.defects.insert(name.to_owned(), defect);
    }
    let mut hertz = scene.clone();
    let mut rough = scene.clone();
    add("defects everywhere", scene);
    for row in &mut rough.rows {
        row.texture = Some(textured());
    }
    add("defects everywhere on texture", rough.clone());
    rough.contact.law = NormalLaw::Hertz;
    let mut smooth = rough.clone();
    (smooth.friction, smooth.cage) = (Friction::None, None);
    add("texture without friction, Hertz", smooth);
    let mut pitted = wheel();
    for (name, on, ball) in [
        ("outer", Surface::OuterRace, None),
        ("inner", Surface::InnerRace, None),
        ("ball", Surface::Ball, Some(1)),
    ] {
        let mut pit = Defect::of(Pit::of_width(0.3e-3), on, -FRAC_PI_2).at_offset(2e-3);
        pit.ball = ball;
        pitted.defects.insert(name.to_owned(), pit);
    }
    pitted
        .defects
        .retain(|_, defect| !matches!(defect.damage, Damage::Patch(_)));
    add("pits everywhere", pitted.clone());
    pitted.contact.law = NormalLaw::Hertz;
    add("pits everywhere, Hertz", pitted);
    add("defects everywhere on texture, Hertz", rough);
    hertz.contact.law = NormalLaw::Hertz;
    for row in &mut hertz.rows {
        row.outer_waviness = vec![Waviness::new(11, 2e-6, -0.3)];
    }
    add("defects everywhere on waves, Hertz", hertz.clone());
    add("waves on points, Hertz", {
        let mut points = through_points(&hertz, 200);
        points.defects.clear();
        points
    });
    (hertz.friction, hertz.cage) = (Friction::None, None);
    hertz.defects.clear();
    add("waves without friction, Hertz", hertz);
    scenes.extend(in_oil());
    scenes
}

/// The same for rings in and out of equilibrium.
fn textured() -> Texture {
    let mut texture = Texture::of_races(5e-9);
    texture.ball = 2e-9;
    texture.reference_load = Some(1000.0);
    texture
}

/// Contacts in oil: tori under both laws, on nodes and slices, defects, arches, and rows in oils of their own.
fn in_oil() -> Vec<(String, Scene)> {
    let mut scenes = Vec::new();
    for law in NormalLaw::all() {
        for slices in [Slices::Fitted(6), Slices::Fixed(70)] {
            let mut scene = oiled(presets::wheel_bearing(3000.0));
            (scene.contact.law, scene.contact.slices) = (law.clone(), slices);
            scenes.push((format!("oil, {law:?} {slices:?}"), scene));
        }
    }
    let mut add = |name: &str, scene: Scene| scenes.push((name.to_owned(), oiled(scene)));
    let mut scene = presets::wheel_bearing(3000.0);
    scene.rows[1].inner_waviness = vec![Waviness::new(7, 2e-6, 0.3)];
    scene.rows[1].lubricant = Some(Lubricant::named("vg32", 300.0));
    add("oils of two rows, waves", scene);
    let mut scene = presets::deep_groove_6205(800.0, 200.0, 3000.0);
    scene.rows[0].outer_arch = Some(GothicArch::new(0.3));
    add("oil on an arch", scene);
    let mut scene = presets::deep_groove_6205(800.0, 0.0, 3000.0);
    scene.friction = Friction::None;
    let mut rolling = oiled(scene.clone());
    effects(rolling.lubricant.as_mut().unwrap(), "rolling");
    let mut damping = rolling.clone();
    effects(damping.lubricant.as_mut().unwrap(), "damping");
    scenes.push(("oil that only resists rolling".to_owned(), rolling));
    scenes.push(("oil that only damps".to_owned(), damping));
    scenes
}

/// Analytic: one law, evaluated in two ways.
#[test]
fn eights_and_ones_agree_at_every_level() {
    for (name, scene) in scenes() {
        for instructions in InstructionSet::available() {
            let worst = difference(&scene, instructions);
            println!("{name}, {instructions}: {worst:.1e}");
            assert!(worst < 1e-12, "{name}, {instructions}: {worst:.1e}");
        }
    }
}

/// Analytic: the same in the frames of rings that tilt.
#[test]
fn eights_and_ones_agree_where_rings_tilt() {
    for (name, scene) in scenes() {
        for instructions in InstructionSet::available() {
            let worst = difference_tilted(&scene, instructions);
            println!("{name}, {instructions}: {worst:.1e}");
            assert!(worst < 1e-12, "{name}, {instructions}: {worst:.1e}");
        }
    }
}

/// Analytic: a state that is not a number shows in the derivative, whoever evaluates it.
#[test]
fn what_is_no_number_does_not_hide() {
    let model = compile(&presets::wheel_bearing(0.0)).unwrap();
    let calm = start(&model, &Start::Equilibrium).unwrap();
    let mut dy = vec![0.0; model.dim()];
    for state in [0, 1, 8, 9, 10, 8 * 4 + 2] {
        let mut y = calm.clone();
        y[state] = f64::NAN;
        rhs(&model, 0.0, &y, &mut dy);
        assert!(dy.iter().any(|x| x.is_nan()), "{}", model.names()[state]);
    }
}
