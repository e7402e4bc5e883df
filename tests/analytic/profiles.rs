//! Races of other shapes than one torus: curves through points, gothic arches, rounded shoulders.

use crate::common;
use std::collections::BTreeMap;
use std::f64::consts::PI;

use ballrace::InstructionSet;
use ballrace::dynamics::Dynamics;
use ballrace::scene::{
    Defect, Friction, GothicArch, Load, NormalLaw, Patch, RaceProfile, RingName, Scene, Slices,
    Surface, Waviness, presets,
};
use ballrace::{
    Equilibrium, Error, Model, Race, Start, compile, equilibrium, inspect, load_distribution,
    start, stiffness,
};
use common::{Noise, patch, run, short, tabulated, through_points};

/// Largest difference of the forces on bodies at random states about the equilibrium of one of two scenes, over the sum of
/// the contact loads on the body.
fn difference(scene: &Scene, other: &Scene, instructions: InstructionSet) -> f64 {
    let [model, other] = [scene, other].map(|scene| {
        let model = compile(scene).unwrap();
        model.with_instructions(instructions)
    });
    let calm = start(&model, &Start::Equilibrium).unwrap();
    let [mut one, mut two] = [Dynamics::new(&model), Dynamics::new(&other)];
    let (mut noise, mut worst) = (Noise(3), 0.0_f64);
    for _ in 0..8 {
        let half = calm.len() / 2;
        let mut y = calm.clone();
        for i in 0..half {
            let (place, speed) = if i % 4 < 3 { (6e-6, 0.05) } else { (0.5, 5.0) };
            y[i] += place * noise.next();
            y[half + i] += speed * noise.next();
        }
        let (a, b) = (one.forces(0.0, &y), two.forces(0.0, &y));
        let loads =
            |j: usize| Race::BOTH.map(|race| inspect::contact(&model, &y, j, race).unwrap().load);
        let balls: Vec<[f64; 2]> = (0..model.body_count() - 2).map(loads).collect();
        for (body, (a, b)) in a.iter().zip(&b).enumerate() {
            let size: f64 = if body < 2 {
                balls.iter().map(|load| load[body]).sum()
            } else {
                balls[body - 2].iter().sum()
            };
            for i in 0..4 {
                let lever = if i < 3 { 1.0 } else { 6e-3 };
                worst = worst.max((a[i] - b[i]).abs() / (lever * (size + 10.0)));
            }
        }
    }
    worst
}

fn wheel(law: NormalLaw, slices: Slices) -> Scene {
    let mut scene = presets::wheel_bearing(3000.0);
    (scene.contact.law, scene.contact.slices) = (law, slices);
    scene
}

fn spall(on: Surface) -> Defect {
    let mut defect = Defect::of(
        Patch::of_width(1e-3).length(2e-3).edge_radius(0.3e-3),
        on,
        -1.5,
    )
    .at_offset(0.5e-3);
    defect.ball = (on == Surface::Ball).then_some(1);
    defect
}

/// Analytic: points of a torus are the torus, whatever is asked of it.
#[test]
fn a_tabulated_torus_is_the_torus() {
    let iso = NormalLaw::iso16281;
    let mut cases = vec![
        ("nodes", wheel(iso(), Slices::Fitted(6)), 1e-6),
        ("many nodes", wheel(iso(), Slices::Fitted(16)), 1e-6),
        ("slices", wheel(iso(), Slices::Fixed(200)), 1e-6),
        ("Hertz", wheel(NormalLaw::Hertz, Slices::Fitted(6)), 1e-6),
        (
            "Hertz on slices",
            wheel(NormalLaw::Hertz, Slices::Fixed(100)),
            1e-6,
        ),
        (
            "6205",
            presets::deep_groove_6205(800.0, 200.0, 3000.0),
            1e-6,
        ),
    ];
    for law in [iso(), NormalLaw::Hertz] {
        let mut scene = wheel(law, Slices::Fitted(6));
        for (name, on) in [
            ("outer", Surface::OuterRace),
            ("inner", Surface::InnerRace),
            ("ball", Surface::Ball),
        ] {
            scene.defects.insert(name.to_owned(), spall(on));
        }
        scene.rows[0].outer_waviness = vec![Waviness::new(9, 1e-6, 0.3)];
        cases.push(("defects and waves", scene, 1e-6));
    }
    for (name, scene, bound) in cases {
        let mut shifted = scene.clone();
        for row in &mut shifted.rows {
            (row.clearance, row.axial_preload) = (row.clearance + 4e-6, row.axial_preload + 2e-6);
        }
        for scene in [scene, shifted] {
            // The common normal of two circles that are nearly concentric turns r/l = 25 times as far as the curve's slope
            // errs: Hertz's law, all along that normal, wants three times as many points.
            let is_flat = scene.contact.law == NormalLaw::Hertz;
            let points = through_points(&scene, if is_flat { 1200 } else { 400 });
            let worst = difference(&scene, &points, InstructionSet::available()[0]);
            println!("{name}: {worst:.1e}");
            assert!(worst < bound, "{name}: {worst:.1e}");
        }
    }
}

/// Analytic: statics of points of a torus are those of the torus.
#[test]
fn statics_of_a_tabulated_torus_are_the_toruss() {
    for law in [NormalLaw::iso16281(), NormalLaw::Hertz] {
        let scene = wheel(law, Slices::Fitted(6));
        let points = through_points(&scene, 400);
        let (a, b) = (equilibrium(&scene).unwrap(), equilibrium(&points).unwrap());
        for (a, b) in a.balls.iter().zip(&b.balls) {
            for (a, b) in [(&a.outer, &b.outer), (&a.inner, &b.inner)] {
                assert!(
                    (a.load - b.load).abs() < 1e-5 * (a.load + 100.0),
                    "{a:?} {b:?}"
                );
                assert!((a.deflection - b.deflection).abs() < 1e-10, "{a:?} {b:?}");
                assert!((a.pressure - b.pressure).abs() < 1e-5 * (a.pressure + 1e8));
            }
        }
        let [a, b] = [&scene, &points].map(|scene| stiffness(scene).unwrap());
        let (a, b) = (a.inner[1][1], b.inner[1][1]);
        assert!((a / b - 1.0).abs() < 1e-4, "{a} {b}");
        let [a, b] = [&scene, &points].map(|scene| load_distribution(scene, 2).unwrap());
        let (a, b) = (a.equivalent[0].outer, b.equivalent[0].outer);
        assert!((a / b - 1.0).abs() < 1e-5, "{a} {b}");
    }
}

/// Analytic: so is a run.
#[test]
fn a_run_on_a_tabulated_torus_is_the_toruss() {
    let scene = wheel(NormalLaw::iso16281(), Slices::Fitted(6));
    let [a, b] = [&scene, &through_points(&scene, 400)].map(|scene| run(scene, &short(1e-3)));
    let [a, b] = [&a, &b].map(|out| out.get("outer.ay").unwrap());
    let largest = a.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let apart = a
        .iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    println!("{apart:.1e} of {largest:.1e} m/s²");
    assert!(largest > 0.1 && apart < 1e-3 * largest, "{apart} {largest}");
}

/// A bearing whose rings do not turn, without weight, friction or cage, under a load on the inner ring.
fn at_rest(law: NormalLaw, direction: [f64; 3], force: f64) -> Scene {
    let mut scene = presets::deep_groove_6205(0.0, 0.0, 0.0);
    scene.gravity = [0.0; 3];
    (scene.cage, scene.friction) = (None, Friction::None);
    (scene.contact.law, scene.contact.slices) = (law, Slices::Fitted(16));
    let load = Load::new(RingName::Inner, direction, force);
    scene.loads = BTreeMap::from([("load".to_owned(), load)]);
    scene
}

const SHIM: f64 = 0.55;

/// The same with both races gothic arches.
fn four_points(law: NormalLaw, direction: [f64; 3], force: f64) -> Scene {
    let mut scene = at_rest(law, direction, force);
    let arch = GothicArch::new(SHIM);
    let row = &mut scene.rows[0];
    (row.outer_arch, row.inner_arch) = (Some(arch.clone()), Some(arch));
    scene
}

fn laws() -> [NormalLaw; 2] {
    [NormalLaw::iso16281(), NormalLaw::Hertz]
}

fn furthest(of: &Equilibrium, value: impl Fn(&ballrace::BallEquilibrium) -> f64, from: f64) -> f64 {
    of.balls
        .iter()
        .map(|ball| (value(ball) - from).abs())
        .fold(0.0, f64::max)
}

/// Analytic: under thrust either way a four-point bearing is an angular-contact bearing of its shim angle, whose contacts incline
/// at cos α = cos α_s − P_d/(2 A) when they bear little (T. A. Harris, Rolling Bearing Analysis, ch. 2).
#[test]
fn a_four_point_bearing_carries_thrust_both_ways() {
    for law in laws() {
        for towards in [1.0, -1.0] {
            let thrust = [0.0, 0.0, towards];
            let scene = four_points(law.clone(), thrust, 1.0);
            let row = &scene.rows[0];
            let reach = (row.outer_conformity + row.inner_conformity - 1.0) * row.ball_diameter;
            let free = (SHIM.cos() - row.clearance / (2.0 * reach)).acos();
            let found = equilibrium(&scene).unwrap();
            let off = furthest(&found, |ball| towards * ball.outer.angle.unwrap(), free);
            println!("{law:?} {towards}: {free:.5} rad, off by {off:.1e}");
            assert!(off < 2e-3, "{off}");
            assert!(free - SHIM > 0.01);

            let loaded = equilibrium(&four_points(law.clone(), thrust, 800.0)).unwrap();
            let mut angular = at_rest(law.clone(), thrust, 800.0);
            angular.rows[0].contact_angle = SHIM;
            angular.rows[0].side = if towards > 0.0 { 1 } else { -1 };
            let angular = equilibrium(&angular).unwrap();
            for (a, b) in loaded.balls.iter().zip(&angular.balls) {
                assert!(
                    (a.inner.load / b.inner.load - 1.0).abs() < 1e-6,
                    "{a:?} {b:?}"
                );
                let turned = a.inner.angle.unwrap() - towards * b.inner.angle.unwrap();
                assert!(turned.abs() < 1e-7, "{a:?} {b:?}");
                assert!((a.inner.deflection - b.inner.deflection).abs() < 1e-11);
                assert!((a.inner.pressure / b.inner.pressure - 1.0).abs() < 1e-6);
            }
        }
    }
}

/// Analytic: under a radial load the heaviest ball has four contacts, two a race and alike, at the resting angle but for
/// what the approach makes of it.
#[test]
fn a_radial_load_has_four_contacts() {
    for law in laws() {
        let scene = four_points(law.clone(), [0.0, -1.0, 0.0], 500.0);
        let model = compile(&scene).unwrap();
        let y = start(&model, &Start::Equilibrium).unwrap();
        for race in Race::BOTH {
            let mut sides = [(0.0, 0.0); 2];
            for slice in inspect::slice_forces(&model, &y, 0, race).unwrap() {
                let side = &mut sides[usize::from(slice.z > 0.0)];
                *side = (side.0 + slice.force, side.1 + slice.force * slice.zeta);
            }
            let [(low, at_low), (high, at_high)] = sides;
            println!("{law:?} {race:?}: {low:.1} N and {high:.1} N");
            assert!(
                low > 50.0 && (low / high - 1.0).abs() < 1e-4,
                "{low} {high}"
            );
            let (row, ring) = (&scene.rows[0], 4 * usize::from(race == Race::Inner));
            let (radius, sigma) = (row.ball_diameter / 2.0, [1.0, -1.0][ring / 4]);
            let f = [row.outer_conformity, row.inner_conformity][ring / 4];
            let apart = f * row.ball_diameter - radius;
            // Ball 0 is at the bottom; the flanks' centres lie (r − R) sin α_s beside it.
            let distance = y[ring + 1] - y[9];
            let a = row.pitch_diameter / 2.0 - sigma * (apart * SHIM.cos() - row.clearance / 4.0);
            let expected = (apart * SHIM.sin()).atan2(sigma * (distance - a));
            assert!((expected - SHIM).abs() < 0.05, "{expected}");
            for (place, side) in [(at_low / low, -1.0), (at_high / high, 1.0)] {
                let angle = (place / radius).asin();
                assert!((angle - side * expected).abs() < 6e-3, "{angle} {expected}");
            }
        }
    }
}

/// Points of a gothic arch, so many a flank: the flank of either side is struck from the other.
fn tabulated_arch(scene: &Scene, race: Race, count: usize) -> RaceProfile {
    let mut row = scene.rows[0].clone();
    row.contact_angle = SHIM;
    let mut flank = |side: i8| {
        row.side = side;
        let RaceProfile { z, r, .. } = tabulated(&row, race, count);
        z.into_iter().zip(r)
    };
    let low: Vec<_> = flank(if race == Race::Outer { -1 } else { 1 }).collect();
    // One is the other in a mirror.
    let before = low.iter().copied().take_while(|(z, _)| *z < -1e-9);
    let mut points: Vec<(f64, f64)> = before.collect();
    let mirrored: Vec<(f64, f64)> = points.iter().rev().map(|(z, r)| (-z, *r)).collect();
    points.extend(mirrored);
    let (z, r) = points.into_iter().unzip();
    RaceProfile::new(z, r)
}

/// Analytic: points of a gothic arch have its two contacts, by nodes and by slices, with a defect across the cusp.
#[test]
fn a_tabulated_arch_has_both_contacts() {
    for slices in [Slices::Fitted(12), Slices::Fixed(300)] {
        let mut scene = four_points(NormalLaw::iso16281(), [0.0, -1.0, 0.05], 500.0);
        scene.contact.slices = slices;
        scene.rows[0].contact_angle = SHIM;
        let mut spall = spall(Surface::OuterRace);
        (spall.angle, spall.axial_offset) = (-PI / 2.0, 0.0.into());
        *patch(&mut spall).0 = 6e-3;
        for defects in [BTreeMap::new(), BTreeMap::from([("s".to_owned(), spall)])] {
            scene.defects = defects;
            let mut points = scene.clone();
            let row = &mut points.rows[0];
            (row.outer_arch, row.inner_arch) = (None, None);
            row.outer_profile = Some(tabulated_arch(&scene, Race::Outer, 800));
            row.inner_profile = Some(tabulated_arch(&scene, Race::Inner, 800));
            let worst = difference(&scene, &points, InstructionSet::available()[0]);
            println!("{slices:?}, {} defects: {worst:.1e}", scene.defects.len());
            assert!(worst < 1e-5, "{worst:.1e}");
        }
    }
}

/// Force on ball 0 along x and z \[N\], held at a place before the outer ring alone.
fn on_ball(scene: &Scene, model: &Model, depth: f64, angle: f64) -> [f64; 2] {
    let mut y = vec![0.0; model.dim()];
    let row = &scene.rows[0];
    let r = row.outer_conformity * row.ball_diameter;
    let radius = row.ball_diameter / 2.0;
    let a = row.pitch_diameter / 2.0 - (r - radius) + row.clearance / 4.0;
    let l = r - radius + depth;
    y[4 * 2] = a + l * angle.cos();
    y[4 * 2 + 2] = l * angle.sin();
    // The other balls are far from both races.
    for ball in 1..row.ball_count {
        y[4 * (2 + ball)] = row.pitch_diameter / 2.0;
    }
    let forces = Dynamics::new(model).forces(0.0, &y);
    [forces[2][0], forces[2][2]]
}

/// Analytic: a rounded shoulder is none for a contact that does not reach it; over it the force fades without a kink, where
/// that on a sharp one bends abruptly, and the zone is not cut.
#[test]
fn a_rounded_shoulder_lets_the_force_fade() {
    let mut sharp = at_rest(NormalLaw::iso16281(), [1.0, 0.0, 0.0], 0.0);
    sharp.rows[0].start_angle = 0.0;
    // No inner race in the way.
    (sharp.rows[0].clearance, sharp.rows[0].inner_conformity) = (0.4e-3, 0.6);
    sharp.rows[0].outer_shoulders = Some([0.7; 2]);
    let mut round = sharp.clone();
    round.rows[0].outer_shoulder_radius = Some(0.2e-3);
    let depth = 10e-6;
    let both = [&sharp, &round].map(|scene| compile(scene).unwrap());
    for angle in [0.0, 0.3, -0.3] {
        let [a, b] = both
            .each_ref()
            .map(|model| on_ball(&sharp, model, depth, angle));
        let size = a[0].hypot(a[1]);
        let off = (a[0] - b[0]).hypot(a[1] - b[1]) / size;
        println!("{angle}: {size:.1} N, off by {off:.1e}");
        assert!(size > 10.0 && off < 1e-6, "{angle}: {off:e}");
    }
    // Slices that break off one after the other: largest bend of the force over the angle, per force.
    let bend = |scene: &mut Scene| {
        scene.contact.slices = Slices::Fixed(200);
        let model = compile(scene).unwrap();
        let force = |k: usize| {
            let [x, z] = on_ball(scene, &model, depth, 0.35 + 2e-3 * k as f64);
            x.hypot(z)
        };
        let forces: Vec<f64> = (0..350).map(force).collect();
        assert!(forces[349] < 0.2 * forces[0], "{} N", forces[349]);
        let bends = forces.windows(3).map(|f| (f[0] - 2.0 * f[1] + f[2]).abs());
        bends.fold(0.0, f64::max) / forces[0]
    };
    let (sharp, round) = (bend(&mut sharp), bend(&mut round));
    println!("bends: sharp {sharp:.1e}, round {round:.1e}");
    assert!(round < 0.3 * sharp, "{sharp:e} {round:e}");
}

/// What is refused, by the field.
#[test]
fn bad_races_are_named() {
    let good = through_points(&wheel(NormalLaw::Hertz, Slices::Fitted(6)), 60);
    compile(&good).unwrap();
    let refused = |path: &str, change: &dyn Fn(&mut Scene)| {
        let mut scene = good.clone();
        change(&mut scene);
        match compile(&scene) {
            Err(Error::Scene { path: found, .. }) => assert_eq!(found, path),
            other => panic!("{path}: {:?}", other.map(|_| ())),
        }
    };
    let outer = |change: fn(&mut RaceProfile)| {
        move |scene: &mut Scene| change(scene.rows[0].outer_profile.as_mut().unwrap())
    };
    let field = "rows[0].outer_profile";
    refused(&format!("{field}.z[3]"), &outer(|p| p.z[3] = p.z[2]));
    refused(&format!("{field}.z[2]"), &outer(|p| p.z[2] = f64::NAN));
    refused(&format!("{field}.r[7]"), &outer(|p| p.r[7] = -1e-3));
    refused(field, &outer(|p| p.r.truncate(5)));
    refused(
        field,
        &outer(|p| {
            p.z.truncate(3);
            p.r.truncate(3);
        }),
    );
    // Convex, and far from the balls.
    refused(
        &format!("{field}.r"),
        &outer(|p| {
            let bottom = p.r[30];
            p.r.iter_mut().for_each(|r| *r = 2.0 * bottom - *r);
        }),
    );
    refused(
        &format!("{field}.r"),
        &outer(|p| p.r.iter_mut().for_each(|r| *r += 20e-3)),
    );
    // A ridge that Hertz's law cannot know of.
    refused(&format!("{field}.r"), &outer(|p| p.r[50] -= 50e-6));
    refused("rows[1].inner_shoulders", &|s| {
        s.rows[1].inner_shoulders = Some([0.7; 2]);
    });
    let arch = |angle: f64| Some(GothicArch::new(angle));
    refused("rows[0].outer_arch", &|s| s.rows[0].outer_arch = arch(0.3));
    refused("rows[0].inner_arch.shim_angle", &|s| {
        s.rows[0].inner_profile = None;
        s.rows[0].inner_arch = arch(0.0);
    });
    refused("rows[0].inner_arch.conformities[1]", &|s| {
        s.rows[0].inner_profile = None;
        s.rows[0].inner_arch = arch(0.3);
        s.rows[0].inner_arch.as_mut().unwrap().conformities = Some([0.52, 0.4]);
    });
    refused("rows[0].inner_shoulder_radius", &|s| {
        s.rows[0].inner_profile = None;
        s.rows[0].inner_shoulder_radius = Some(1e-4);
    });
    refused("defects.d.axial_offset", &|s| {
        let far = spall(Surface::OuterRace).at_offset(12e-3);
        s.defects.insert("d".to_owned(), far);
    });
}
