//! Truths that need no other program: conservation, symmetry, closed forms and limits.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::common::{rms, run};
use ballrace::compile;
use ballrace::dynamics::contributions;
use ballrace::inspect;
use ballrace::scene::{
    Defect, Friction, Load, NormalLaw, Patch, Probe, RingName, Scene, Slices, Support, Surface,
    presets,
};
use ballrace::{Bandwidth, Model, Race, Run, Start, start};

/// The wheel bearing at +3 kN without its defect.
fn healthy() -> Scene {
    let mut scene = presets::wheel_bearing(3000.0);
    scene.defects.clear();
    scene
}

fn spall(on: Surface, width: f64) -> Defect {
    let mut defect = Defect::of(
        Patch::of_width(width).length(3e-3).edge_radius(0.3e-3),
        on,
        -FRAC_PI_2,
    )
    .at_offset(0.5e-3);
    defect.ball = (on == Surface::Ball).then_some(1);
    defect
}

/// Forces that the bodies of a state put on each other, without what acts from outside.
fn internal_sums(model: &Model, y: &[f64]) -> ([f64; 4], f64) {
    let mut sums = [0.0; 4];
    let mut size = 0.0;
    for (name, forces) in contributions(model, 0.0, y) {
        if !["contact", "damping", "friction", "cage"].contains(&name) {
            continue;
        }
        for (b, f) in forces.chunks_exact(4).enumerate() {
            let (x, y) = (y[4 * b], y[4 * b + 1]);
            for (sum, part) in sums
                .iter_mut()
                .zip([f[0], f[1], f[2], f[3] + x * f[1] - y * f[0]])
            {
                *sum += part;
            }
            size += f[0].abs() + f[1].abs() + f[2].abs();
        }
    }
    (sums, size)
}

/// Analytic: action equals reaction, in force and in moment about z, with every feature on.
#[test]
fn force_and_moment_are_conserved() {
    let mut scene = presets::wheel_bearing(3000.0);
    scene.defects.insert(
        "inner".into(),
        spall(Surface::InnerRace, 1e-3).at_angle(FRAC_PI_2),
    );
    scene
        .defects
        .insert("ball".into(), spall(Surface::Ball, 2e-3).at_angle(0.3));
    scene.rows[0].outer_waviness = vec![ballrace::scene::Waviness::new(9, 1e-6, 0.3)];
    let model = compile(&scene).unwrap();
    let mut y = start(&model, &Start::Equilibrium).unwrap();
    for (i, state) in y.iter_mut().enumerate() {
        let noise = ((i * 7919) % 997) as f64 / 997.0 - 0.5;
        *state += noise * if i < model.dim() / 2 { 4e-6 } else { 0.3 };
    }
    let (sums, size) = internal_sums(&model, &y);
    for sum in sums {
        assert!(sum.abs() < 1e-13 * size, "{sums:?} of {size}");
    }
}

/// Analytic: when everything turns as one piece, nothing slips and nothing dissipates.
#[test]
fn rigid_rotation_slips_nowhere() {
    let scene = presets::wheel_bearing(3000.0);
    let model = compile(&scene).unwrap();
    let mut y = start(&model, &Start::Equilibrium).unwrap();
    let half = y.len() / 2;
    for b in 0..model.body_count() {
        let (x, z) = (y[4 * b], y[4 * b + 1]);
        y[half + 4 * b..half + 4 * b + 4].copy_from_slice(&[-100.0 * z, 100.0 * x, 0.0, 100.0]);
    }
    let energy = inspect::energy(&model, &y).unwrap();
    assert!(energy.friction_power < 1e-20, "{energy:?}");
    assert!(energy.damping_power.abs() < 1e-9, "{energy:?}");
    // And not because nothing can: the true motion slips.
    let rolling = inspect::energy(&model, &start(&model, &Start::Equilibrium).unwrap()).unwrap();
    assert!(rolling.friction_power > 1e-3, "{rolling:?}");
}

/// Analytic: without damping, friction and drive the energy stays, to the slices' accuracy for the ISO law
/// and to the tolerance for the Hertz law on fitted nodes.
#[test]
fn energy_is_kept_without_damping_and_friction() {
    for law in NormalLaw::all() {
        let (slices, bound) = match law {
            NormalLaw::Hertz => (Slices::Fitted(6), 1e-5),
            _ => (Slices::Fixed(400), 1e-3),
        };
        let mut scene = healthy();
        scene.contact.law = law;
        scene.contact.slices = slices;
        scene.contact.damping = 0.0;
        scene.friction = Friction::None;
        scene.cage = None;
        scene.drive = ballrace::scene::Drive::Speed(0.0.into());
        scene.inner_ring.support = Support::default();
        scene.outer_ring.support = Support::default();
        scene.rows.truncate(1);
        scene.probes = [
            ("e".to_owned(), Probe::energy()),
            ("inner".to_owned(), Probe::motion("inner")),
        ]
        .into();
        // From nominal places under load: a violent shake. The loads' work is their force times travel.
        let out = run(
            &scene,
            &Run {
                duration: 2e-3,
                fs: 100e3,
                start: Start::Rolling,
                rtol: Some(1e-9),
                threads: 1,
                bandwidth: Bandwidth::Raw,
                settle: Some(0.0),
                ..Run::default()
            },
        );
        let (e, y, z) = (
            out.get("e.total").unwrap(),
            out.get("inner.y").unwrap(),
            out.get("inner.z").unwrap(),
        );
        let scale = out
            .get("e.kinetic")
            .unwrap()
            .iter()
            .copied()
            .fold(0.0, f64::max);
        for i in 0..e.len() {
            let work = -7000.0 * y[i] + 3000.0 * z[i];
            assert!(
                ((e[i] - e[0] - work) / scale).abs() < bound,
                "{i}: {}",
                (e[i] - e[0] - work) / scale
            );
        }
    }
}

/// Analytic: turned by a pitch the healthy bearing is the same; mirrored in z with the thrust it is the
/// mirror image.
#[test]
fn symmetries() {
    let mut scene = healthy();
    scene.rows.truncate(1);
    let mut turned = scene.clone();
    turned.rows[0].start_angle += TAU / 13.0;
    let mut mirrored = scene
        .with(&[("loads.axial.force", (-3000.0).into())])
        .unwrap();
    mirrored.rows[0].side = -1;
    mirrored.rows[0].axial_position = 11e-3;
    let short = Run {
        duration: 1e-3,
        threads: 1,
        bandwidth: Bandwidth::Raw,
        settle: Some(0.0),
        ..Run::default()
    };
    let (one, two, three) = (
        run(&scene, &short),
        run(&turned, &short),
        run(&mirrored, &short),
    );
    for (name, sign) in [
        ("outer.ay", 1.0),
        ("outer.az", -1.0),
        ("inner.y", 1.0),
        ("inner.z", -1.0),
    ] {
        let a = one.get(name).unwrap();
        let scale = rms(a);
        for (i, value) in a.iter().enumerate() {
            let pitch = two.get(name).unwrap()[i];
            let mirror = sign * three.get(name).unwrap()[i];
            assert!(
                (value - pitch).abs() < 1e-4 * scale,
                "{name} {i}: {value} {pitch}"
            );
            assert!(
                (value - mirror).abs() < 1e-4 * scale,
                "{name} {i}: {value} {mirror}"
            );
        }
    }
}

/// Forces on both rings in the plane as ball 0 of row 0 stands at `angle`, turned by `spin`, all at rest.
fn force_at(model: &Model, y: &[f64], angle: f64, spin: f64) -> ([f64; 4], [f64; 2]) {
    let mut y = y.to_vec();
    let radius = y[8].hypot(y[9]);
    y[8] = radius * angle.cos();
    y[9] = radius * angle.sin();
    y[11] = spin;
    let half = y.len() / 2;
    y[half..].fill(0.0);
    let forces = &contributions(model, 0.0, &y)[0].1;
    let loads = Race::BOTH.map(|race| inspect::contact(model, &y, 0, race).unwrap().load);
    ([forces[0], forces[1], forces[4], forces[5]], loads)
}

/// Analytic: entering a defect of any width makes no jump, on any body, and as its width goes to zero the
/// healthy force comes back.
#[test]
fn edges_do_not_jump_and_narrow_defects_vanish() {
    for law in NormalLaw::all() {
        for on in [Surface::OuterRace, Surface::InnerRace, Surface::Ball] {
            for width in [1e-7, 1e-5, 0.3e-3, 1.5e-3] {
                let mut scene = healthy();
                scene.contact.law = law.clone();
                scene.rows[0].start_angle = -FRAC_PI_2;
                // A plane contact: every slice then meets the edge at the same angle.
                scene.rows[0].contact_angle = 0.0;
                scene.rows[1].contact_angle = 0.0;
                scene.loads.get_mut("axial").unwrap().force = 0.0.into();
                let whole = compile(&scene).unwrap();
                let y = start(&whole, &Start::Equilibrium).unwrap();
                let mut defect = spall(on, width).at_offset(0.0);
                defect.ball = defect.ball.map(|_| 0);
                scene.defects.insert("d".into(), defect);
                let defective = compile(&scene).unwrap();
                let pitch = 30e-3;
                // Ball defect: the ball turns at rest; ring defect: the ball travels.
                let at = |model: &Model, arc: f64| match on {
                    Surface::Ball => force_at(model, &y, -FRAC_PI_2, arc / 5.953e-3),
                    _ => force_at(model, &y, -FRAC_PI_2 + arc / pitch, 0.0),
                };
                let race = usize::from(on == Surface::InnerRace);
                let size = at(&whole, 0.0).1[race];
                assert!(size > 500.0);
                let steps = 1000;
                let mut before = at(&defective, -1.2e-3);
                let mut deepest = 1.0_f64;
                for k in 1..=steps {
                    let arc = -1.2e-3 + 2.4e-3 * f64::from(k) / f64::from(steps);
                    let now = at(&defective, arc);
                    // A continuous force: 2.4 µm of travel cannot change it by more than this.
                    let jump = now
                        .0
                        .iter()
                        .zip(before.0)
                        .map(|(a, b)| (a - b).abs())
                        .fold(0.0, f64::max);
                    assert!(
                        jump < 0.05 * size,
                        "{on:?} {width} {k}: jump {jump} of {size}"
                    );
                    // Against the whole race, since the rings are not concentric.
                    let healthy = at(&whole, arc).1[race];
                    deepest = deepest.min(now.1[race] / healthy);
                    before = now;
                }
                if width <= 1e-7 {
                    assert!(deepest > 0.9999, "{on:?}: {deepest} of the healthy load");
                } else if width >= 1.5e-3 {
                    // And the defect does something: the ball unloads.
                    assert!(deepest < 0.5, "{on:?}: {deepest} of the healthy load");
                }
            }
        }
    }
}

/// Analytic: from equilibrium the healthy bearing starts calmly. Its first ball pass has under 1 % of the rolling start's
/// rms acceleration and under 10 % of the defective signal's, without thrust and at +3 kN.
#[test]
fn equilibrium_start_is_calm() {
    // 6.3 ms: one ball pass at 30 Hz.
    let pass = |scene: &Scene, start: Start, duration: f64| {
        let out = run(
            scene,
            &Run {
                duration,
                start,
                threads: 1,
                bandwidth: Bandwidth::Raw,
                settle: Some(0.0),
                ..Run::default()
            },
        );
        let ay = out.get("outer.ay").unwrap();
        rms(&ay[ay.len() - 315..])
    };
    for axial_load in [0.0, 3000.0] {
        let loaded = presets::wheel_bearing(axial_load);
        let mut healthy = loaded.clone();
        healthy.defects.clear();
        let calm = pass(&healthy, Start::Equilibrium, 6.3e-3);
        let rolling = pass(&healthy, Start::Rolling, 6.3e-3);
        let defective = pass(&loaded, Start::Equilibrium, 26.3e-3);
        println!(
            "first pass at {axial_load} N: {calm:.3} equilibrium, {rolling:.1} rolling, {defective:.1} defective (m/s² rms)"
        );
        assert!(calm < 0.01 * rolling, "{calm} {rolling}");
        assert!(calm < 0.1 * defective, "{calm} {defective}");
    }
}

/// Analytic: a torque-driven ring with Coulomb drag spins up at torque over inertia while its balls are loose.
#[test]
fn torque_turns_the_ring() {
    let mut scene = healthy();
    scene.drive = ballrace::scene::Drive::Torque {
        value: 0.5.into(),
        initial_speed: 0.0,
    };
    scene.friction = Friction::None;
    let out = run(
        &scene,
        &Run {
            duration: 5e-3,
            threads: 1,
            bandwidth: Bandwidth::Raw,
            settle: Some(0.0),
            ..Run::default()
        },
    );
    let inertia = 0.6 * 0.03 * 0.03;
    let last = out.get("inner.omega").unwrap().last().copied().unwrap();
    let t = out.t.last().unwrap();
    assert!((last - 0.5 / inertia * t).abs() < 1e-6 * last, "{last}");
}

/// Analytic: an unbalance turns with the ring, m e ω² in size.
#[test]
fn unbalance_turns_with_the_ring() {
    let mut scene = healthy();
    scene.unbalances.insert(
        "wheel".into(),
        ballrace::scene::Unbalance::new(RingName::Inner, 1e-3, 0.5),
    );
    scene.loads = [(
        "none".to_owned(),
        Load::new(RingName::Inner, [1.0, 0.0, 0.0], 0.0),
    )]
    .into();
    let model = compile(&scene).unwrap();
    let mut y = start(&model, &Start::Rolling).unwrap();
    y[7] = 0.25;
    let forces = contributions(&model, 0.0, &y);
    let load = &forces.iter().find(|(name, _)| *name == "load").unwrap().1[4..8];
    let force = 1e-3 * (TAU * 30.0_f64).powi(2);
    assert!((load[0] - force * 0.75_f64.cos()).abs() < 1e-9 * force);
    assert!((load[1] - force * 0.75_f64.sin()).abs() < 1e-9 * force);
}
