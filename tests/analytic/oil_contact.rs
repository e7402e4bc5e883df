//! What oil does in contacts, of whole bearings at random states (`docs/model.md`, *Film*).
//!
//! Analytic: a film only lies between two bodies, takes energy and gives none, knows no place and no direction of its own, and
//! has no kink. Both normal laws, defects on each body, contacts at an angle, the flanks of an arch.

use crate::common;
use std::f64::consts::PI;

use ballrace::dynamics::{contributions, rhs};
use ballrace::inspect;
use ballrace::scene::{
    Defect, Friction, GothicArch, Lubricant, NormalLaw, Patch, Scene, Slices, Surface, presets,
};
use ballrace::{Model, Race, Start, compile, start};
use common::{Noise, effects, oiled, one_ball};

/// Forces of contacts on all bodies by origin: elastic, damping, friction with rolling resistance.
fn contacts(model: &Model, y: &[f64]) -> [Vec<f64>; 3] {
    let parts = contributions(model, 0.0, y);
    ["contact", "damping", "friction"].map(|name| {
        let of = parts.iter().find(|(other, _)| *other == name);
        of.unwrap().1.clone()
    })
}

fn sum(parts: &[Vec<f64>; 3]) -> Vec<f64> {
    (0..parts[0].len())
        .map(|i| parts.iter().map(|part| part[i]).sum())
        .collect()
}

/// Power that a part puts into the bodies \[W\].
fn power(part: &[f64], y: &[f64]) -> f64 {
    part.iter()
        .zip(&y[y.len() / 2..])
        .map(|(force, speed)| force * speed)
        .sum()
}

/// Sum of forces \[N\] as scalars: in the plane and along z, of all bodies.
fn size(parts: &[Vec<f64>; 3]) -> f64 {
    let magnitude = |force: &[f64]| force[..3].iter().map(|f| f * f).sum::<f64>().sqrt();
    parts
        .iter()
        .flat_map(|part| part.chunks(4))
        .map(magnitude)
        .sum()
}

/// A bearing at an angle with a defect on each body.
fn wheel(law: &NormalLaw) -> Scene {
    let mut scene = presets::wheel_bearing(3000.0);
    scene.contact.law = law.clone();
    for (name, on, ball) in [
        ("inner", Surface::InnerRace, None),
        ("ball", Surface::Ball, Some(1)),
    ] {
        let angle = if ball.is_some() { PI } else { -PI / 2.0 };
        let mut defect = Defect::of(
            Patch::of_width(1e-3).length(2e-3).edge_radius(0.3e-3),
            on,
            angle,
        )
        .at_offset(0.5e-3);
        defect.ball = ball;
        scene.defects.insert(name.to_owned(), defect);
    }
    scene
}

/// Bearings in oil by name.
fn scenes() -> Vec<(String, Scene)> {
    let mut scenes = Vec::new();
    for law in [NormalLaw::Hertz, NormalLaw::iso16281()] {
        let mut deep = presets::deep_groove_6205(800.0, 200.0, 3000.0);
        deep.contact.law = law.clone();
        let mut arch = deep.clone();
        arch.rows[0].outer_arch = Some(GothicArch::new(0.3));
        let mut fixed = wheel(&law);
        fixed.contact.slices = Slices::Fixed(70);
        let named = [
            ("deep groove", deep),
            ("arch", arch),
            ("wheel", wheel(&law)),
            ("slices", fixed),
        ];
        for (name, scene) in named {
            scenes.push((format!("{name}, {law:?}"), oiled(scene)));
        }
    }
    scenes
}

/// A state around the equilibrium.
fn random(calm: &[f64], noise: &mut Noise) -> Vec<f64> {
    let mut y = calm.to_vec();
    let half = calm.len() / 2;
    for i in 0..half {
        let (place, speed) = if i % 4 < 3 { (10e-6, 0.05) } else { (0.5, 5.0) };
        y[i] += place * noise.next();
        y[half + i] += speed * noise.next();
    }
    y
}

/// Does something with states around the equilibrium of a scene.
fn at_states(scene: &Scene, count: usize, mut look: impl FnMut(&Model, &[f64])) {
    let model = compile(scene).unwrap();
    let calm = start(&model, &Start::Equilibrium).unwrap();
    let mut noise = Noise(5);
    for _ in 0..count {
        look(&model, &random(&calm, &mut noise));
    }
}

#[test]
fn what_a_ball_gets_its_ring_loses() {
    for (name, scene) in scenes() {
        let mut worst = 0.0_f64;
        at_states(&scene, 20, |model, y| {
            let parts = contacts(model, y);
            let (all, size) = (sum(&parts), size(&parts));
            let mut total = [0.0; 4];
            for (place, force) in y.chunks(4).zip(all.chunks(4)) {
                for i in 0..3 {
                    total[i] += force[i];
                }
                total[3] += force[3] + place[0] * force[1] - place[1] * force[0];
            }
            for (total, lever) in total.iter().zip([1.0, 1.0, 1.0, 0.02]) {
                worst = worst.max(total.abs() / (lever * size));
            }
        });
        println!("{name}: {worst:.1e}");
        assert!(worst < 1e-13, "{name}: {worst:.1e}");
    }
}

/// Of one ball, since a sum over many could hide one that gains.
#[test]
fn every_effect_takes_energy() {
    for (name, mut scene) in scenes() {
        for row in &mut scene.rows {
            row.ball_count = 1;
        }
        scene.rows.truncate(1);
        let ball = |defect: &Defect| defect.row == 0 && defect.ball.is_none_or(|ball| ball == 0);
        scene.defects.retain(|_, defect| ball(defect));
        (scene.contact.damping, scene.friction, scene.cage) = (0.0, Friction::None, None);
        // The load is not one ball's to bear.
        let nominal = |model: &Model| start(model, &Start::Rolling).unwrap();
        for (effect, part) in [("damping", 1), ("traction", 2), ("rolling", 2)] {
            let of = scene.lubricant.as_mut().unwrap();
            effects(of, effect);
            of.reference_load = Some(300.0);
            scene.rows[0].clearance = -20e-6;
            let model = compile(&scene).unwrap();
            let (calm, mut noise, mut felt) = (nominal(&model), Noise(9), 0);
            for _ in 0..400 {
                let y = random(&calm, &mut noise);
                let parts = contacts(&model, &y);
                let powers = [0, 1, 2].map(|k| power(&parts[k], &y));
                let scale = 1e-12 * size(&parts) * 1.0;
                assert!(powers[part] <= scale, "{name}, {effect}: {powers:?}");
                let others = powers[1] + powers[2] - powers[part];
                assert!(others == 0.0, "{name}, {effect}: {powers:?}");
                felt += usize::from(powers[part] < 0.0);
            }
            assert!(felt > 100, "{name}, {effect}: {felt}");
        }
    }
}

/// Elastic forces are the slope of the potential, differentiated along the motion, and what the summary of energies calls
/// losses is what the forces take.
#[test]
fn power_is_accounted_for() {
    for (name, mut scene) in scenes() {
        scene.lubricant.as_mut().unwrap().rolling = false;
        let (mut worst, mut slope) = (0.0_f64, 0.0_f64);
        at_states(&scene, 8, |model, y| {
            let [elastic, damping, friction] = contacts(model, y);
            let energy = inspect::energy(model, y).unwrap();
            let taken = power(&damping, y) + energy.damping_power;
            let rubbed = power(&friction, y) + energy.friction_power;
            let speeds = &y[y.len() / 2..];
            let scale: f64 = elastic.iter().zip(speeds).map(|(f, v)| (f * v).abs()).sum();
            worst = worst.max(taken.abs().max(rubbed.abs()) / scale);
            if scene.contact.slices == Slices::Fixed(70) {
                // Whose forces are no slope: slices enter and leave.
                return;
            }
            let stored = |step: f64| {
                let mut y = y.to_vec();
                let half = y.len() / 2;
                for i in 0..half {
                    y[i] += step * y[half + i];
                }
                inspect::energy(model, &y).unwrap().contact
            };
            let step = 1e-8;
            let rate = (8.0 * (stored(step) - stored(-step))
                - (stored(2.0 * step) - stored(-2.0 * step)))
                / (12.0 * step);
            slope = slope.max((power(&elastic, y) + rate).abs() / scale);
        });
        println!("{name}: {worst:.1e}, {slope:.1e}");
        assert!(worst < 1e-12, "{name}: {worst:.1e}");
        assert!(slope < 1e-4, "{name}: {slope:.1e}");
    }
}

/// All bodies turned together, in place and in speed.
#[test]
fn a_rigid_rotation_is_not_felt() {
    for (name, mut scene) in scenes() {
        scene.defects.clear();
        let model = compile(&scene).unwrap();
        let mut y = random(&start(&model, &Start::Equilibrium).unwrap(), &mut Noise(3));
        let half = y.len() / 2;
        for (place, speed) in (0..half).step_by(4).map(|i| (i, half + i)) {
            let (px, py) = (y[place], y[place + 1]);
            y[speed..speed + 4].copy_from_slice(&[-150.0 * py, 150.0 * px, 0.0, 150.0]);
        }
        let [elastic, damping, friction] = contacts(&model, &y);
        let most = elastic.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
        for force in damping.iter().chain(&friction) {
            assert!(
                force.abs() < 1e-9 * most,
                "{name}: {force:e} beside {most:e}"
            );
        }
    }
}

/// The forces of the state that is turned about the axis are the forces turned; those of its image in a plane through the axis,
/// where all turn the other way round, are the image of the forces.
#[test]
fn no_direction_is_special() {
    for (name, mut scene) in scenes() {
        scene.defects.clear();
        for (what, turned, flip) in [("turned", 0.7_f64, 1.0), ("image", 0.0, -1.0)] {
            let mut worst = 0.0_f64;
            at_states(&scene, 5, |model, y| {
                let (sin, cos) = turned.sin_cos();
                let image = |v: &[f64]| {
                    [
                        cos * v[0] - flip * sin * v[1],
                        sin * v[0] + flip * cos * v[1],
                        v[2],
                        flip * v[3],
                    ]
                };
                let other: Vec<f64> = y.chunks(4).flat_map(image).collect();
                let parts = contacts(model, y);
                let found = sum(&contacts(model, &other));
                let expected: Vec<f64> = sum(&parts).chunks(4).flat_map(image).collect();
                for (i, (a, b)) in found.iter().zip(&expected).enumerate() {
                    let lever = if i % 4 == 3 { 6e-3 } else { 1.0 };
                    worst = worst.max((a - b).abs() / (lever * size(&parts)));
                }
            });
            println!("{name}, {what}: {worst:.1e}");
            assert!(worst < 1e-10, "{name}, {what}: {worst:.1e}");
        }
    }
}

/// A ball between held rings, squeezed, under oil.
fn squeezed(law: &NormalLaw) -> Scene {
    let mut scene = one_ball(5e-6);
    scene.contact.law = law.clone();
    let mut oil = Lubricant::named("vg68", 328.15);
    (oil.reference_load, oil.reference_speed) = (Some(250.0), Some(188.18));
    scene.lubricant = Some(oil);
    scene
}

/// Contacts begin at the gap h, softer than in proportion to the approach, damped, rubbing and resisted alike. On the
/// outer race h is that of the reference contact.
#[test]
fn contacts_begin_softly() {
    for law in [NormalLaw::Hertz, NormalLaw::iso16281()] {
        let mut scene = squeezed(&law);
        scene.rows[0].clearance = 100e-6;
        if let ballrace::scene::Drive::Speed(speed) = &mut scene.drive {
            *speed = 188.18.into();
        }
        let model = compile(&scene).unwrap();
        let calm = start(&model, &Start::Rolling).unwrap();
        let half = calm.len() / 2;
        // The ball is the third body, at angle 0; the groove's bottom is 50 µm away but for the film.
        let forces = |x: f64| {
            let mut y = calm.clone();
            y[8] += x;
            (y[half + 8], y[half + 11]) = (0.01, y[half + 11] + 3.0);
            let parts = contacts(&model, &y);
            [0, 1, 2].map(|k| parts[k][8].hypot(parts[k][9]).hypot(parts[k][11] / 4e-3))
        };
        let (mut clear, mut touching) = (0.0, 60e-6);
        while touching - clear > 1e-16 {
            let middle = f64::midpoint(clear, touching);
            if middle == clear || middle == touching {
                break;
            }
            if forces(middle) == [0.0; 3] {
                clear = middle;
            } else {
                touching = middle;
            }
        }
        let film = 25e-6 - touching;
        println!("{law:?}: film {film:e}");
        assert!((film / 2.3085e-7 - 1.0).abs() < 1e-4, "{law:?}: {film:e}");
        for part in 0..3 {
            let steep = |delta: f64| forces(touching + delta)[part] / delta;
            // Slope zero: over 1000 it falls by 1000^{1/2} at least.
            let (near, far) = (steep(1e-11), steep(1e-8));
            println!("{law:?}, {part}: {near:e} {far:e}");
            assert!(
                far > 0.0 && near < far / 20.0,
                "{law:?}, {part}: {near:e} {far:e}"
            );
        }
    }
}

/// Slopes to both sides agree ever better: where nothing slips, nothing rolls, nothing approaches, and where all do.
#[test]
fn no_speed_has_a_kink() {
    for (name, mut scene) in scenes() {
        scene.defects.clear();
        let model = compile(&scene).unwrap();
        let rolling = start(&model, &Start::Equilibrium).unwrap();
        let half = rolling.len() / 2;
        let mut still = rolling.clone();
        still[half..].fill(0.0);
        for (base, what) in [(&rolling, "rolling"), (&still, "still")] {
            let mut noise = Noise(11);
            let along: Vec<f64> = (0..half)
                .map(|i| noise.next() * if i % 4 < 3 { 1.0 } else { 200.0 })
                .collect();
            let at = |step: f64| {
                let mut y = base.clone();
                for (speed, along) in y[half..].iter_mut().zip(&along) {
                    *speed += step * along;
                }
                sum(&contacts(&model, &y))
            };
            let bend = |step: f64| {
                let (before, here, after) = (at(-step), at(0.0), at(step));
                let most = |of: &dyn Fn(usize) -> f64| {
                    (0..half).fold(0.0_f64, |most, i| most.max(of(i).abs()))
                };
                most(&|i| before[i] + after[i] - 2.0 * here[i]) / most(&|i| after[i] - before[i])
            };
            // A kink would keep its share.
            let found = [1e-4, 1e-5, 1e-6].map(bend);
            println!("{name}, {what}: {found:?}");
            assert!(
                found[2] < 0.02 && found[2] < 0.3 * found[0].max(1e-3),
                "{name}, {what}: {found:?}"
            );
        }
    }
}

/// A defect comes into reach before a zone meets it: nothing may jump there, and a film knows how large a contact is by other
/// sums from there on.
#[test]
fn a_defect_in_reach_is_not_felt() {
    for slices in [Slices::Fitted(6), Slices::Fixed(30), Slices::Fixed(70)] {
        for law in [NormalLaw::Hertz, NormalLaw::iso16281()] {
            let mut scene = oiled(presets::deep_groove_6205(800.0, 200.0, 3000.0));
            (scene.contact.slices, scene.contact.law) = (slices, law.clone());
            let (width, radius) = (1e-3, 19.52e-3 + 3.97e-3);
            let defect = |angle: f64| {
                let mut scene = scene.clone();
                let spall = Defect::of(
                    Patch::of_width(width).length(7e-3).edge_radius(0.3e-3),
                    Surface::OuterRace,
                    angle,
                )
                .at_offset(0.0);
                scene.defects.insert("spall".to_owned(), spall);
                compile(&scene).unwrap()
            };
            let calm = start(&compile(&scene).unwrap(), &Start::Equilibrium).unwrap();
            let mut y = random(&calm, &mut Noise(2));
            y[..4].copy_from_slice(&calm[..4]);
            let ball = y[9].atan2(y[8]);
            // The half-angle is w/2R in the middle of the groove, and 9 % more at the ends of the defect: its reach, with 1 % more.
            let [inside, outside] = [0.54, 0.56].map(|share| {
                let model = defect(ball + share * width / radius);
                let parts = contacts(&model, &y);
                [1, 2].map(|k| parts[k][8..12].to_vec())
            });
            for k in 0..2 {
                for i in 0..4 {
                    let (a, b) = (inside[k][i], outside[k][i]);
                    let most = outside[k].iter().fold(0.0_f64, |most, f| most.max(f.abs()));
                    assert!(
                        (a - b).abs() < 1e-9 * most,
                        "{law:?}, {slices:?}, {k} {i}: {a:e} {b:e}"
                    );
                }
            }
        }
    }
}

/// All effects left out: the documents differ, the motion does not.
#[test]
fn oil_that_does_nothing_is_none() {
    for (name, scene) in scenes() {
        let mut dry = scene.clone();
        dry.lubricant = None;
        let mut idle = scene.clone();
        effects(idle.lubricant.as_mut().unwrap(), "none");
        let rates = |scene: &Scene| {
            let model = compile(scene).unwrap();
            let calm = start(&model, &Start::Equilibrium).unwrap();
            let y = random(&calm, &mut Noise(4));
            let mut dy = vec![0.0; y.len()];
            rhs(&model, 0.0, &y, &mut dy);
            (y, dy)
        };
        assert_eq!(rates(&dry), rates(&idle), "{name}");
    }
}

/// Rows with oils of their own have the forces that each has alone.
#[test]
fn rows_keep_their_oils() {
    let mut both = presets::wheel_bearing(2000.0);
    let oils = [
        Lubricant::named("vg32", 320.0),
        Lubricant::named("vg220", 330.0),
    ];
    for (row, oil) in both.rows.iter_mut().zip(&oils) {
        let mut oil = oil.clone();
        oil.reference_load = Some(800.0);
        row.lubricant = Some(oil);
    }
    let model = compile(&both).unwrap();
    let y = random(&start(&model, &Start::Equilibrium).unwrap(), &mut Noise(6));
    let found = ballrace::dynamics::Dynamics::new(&model).forces(0.0, &y);
    for (row, oil) in oils.iter().enumerate() {
        let mut one = both.clone();
        one.rows.iter_mut().for_each(|row| row.lubricant = None);
        let mut oil = oil.clone();
        oil.reference_load = Some(800.0);
        one.lubricant = Some(oil);
        let model = compile(&one).unwrap();
        let alone = ballrace::dynamics::Dynamics::new(&model).forces(0.0, &y);
        for ball in 2 + 13 * row..2 + 13 * (row + 1) {
            for i in 0..4 {
                let off = (found[ball][i] - alone[ball][i]).abs();
                assert!(off < 1e-9, "row {row}, body {ball}: {off:e}");
            }
        }
    }
    let loads = |j: usize| inspect::contact(&model, &y, j, Race::Outer).unwrap().load;
    assert!((0..26).map(loads).sum::<f64>() > 1e3);
}
