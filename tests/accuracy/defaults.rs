//! The defaults are in balance: steps and nodes together stay within a percent.
//!
//! Truth: 64 nodes, Dormand–Prince at rtol 1e-9 with a fifth of its step, from the same state. Compared is the
//! acceleration of the outer ring over 4 ms (relative, L2, at 100 kHz), as far as it can be predicted: up to the last
//! moment at which that solution and a looser one agree to a hundredth of the percent.

use crate::common;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use ballrace::scene::{
    Defect, Drive, Friction, Method, NormalLaw, Patch, Scene, Slices, Surface, presets,
};
use ballrace::{Bandwidth, Run, Start, compile, equilibrium, simulate, start};
use common::{Noise, running_errors, soon_over_the_spall};

/// What is allowed.
const PERCENT: f64 = 1e-2;
/// A scene that cannot be predicted for half a millisecond is left out.
const LEAST_SAMPLES: usize = 50;

/// A bearing of one or two rows of any size, conformity, load, speed, law, damping and friction, with a spall that its most
/// loaded ball is about to meet. Nothing was tuned on these.
fn random(noise: &mut Noise) -> Scene {
    let ball = 1e-3 * 10_f64.powf(noise.between(0.6, 1.3));
    let fill = noise.between(0.55, 0.9);
    let count = noise.between(7.0, 15.9).floor();
    let pitch = count * ball / (PI * fill);
    let two_rows = noise.yes();
    let scale = ball / if two_rows { 11.906e-3 } else { 7.94e-3 };
    let load = 10_f64.powf(noise.between(-1.3, 0.0)) * scale * scale;
    let mut scene = if two_rows {
        let mut scene = presets::wheel_bearing(noise.between(-3000.0, 3000.0) * load);
        scene.loads.get_mut("radial").unwrap().force = (7000.0 * load).into();
        let rpm = noise.between(600.0, 4000.0) * 60e-3 / pitch;
        scene.drive = Drive::Speed((rpm * PI / 30.0).into());
        scene
    } else {
        let (axial, rpm) = (
            noise.between(0.0, 800.0) * load,
            noise.between(600.0, 6000.0),
        );
        presets::deep_groove_6205(3000.0 * load, axial, rpm * 39e-3 / pitch)
    };
    let (angle, outer, inner) = (
        noise.between(0.0, 0.4),
        noise.between(0.51, 0.535),
        noise.between(0.51, 0.535),
    );
    let mass = if two_rows { 0.7 } else { 0.3 } * scale.powi(3);
    for ring in [&mut scene.outer_ring, &mut scene.inner_ring] {
        ring.mass = Some(mass * noise.between(0.7, 2.0));
    }
    let place = -FRAC_PI_2 - 0.03 - TAU / count * noise.between(0.0, 0.15);
    for (i, row) in scene.rows.iter_mut().enumerate() {
        // A float that is a small whole number.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let whole = count as usize;
        (row.ball_count, row.ball_diameter, row.pitch_diameter) = (whole, ball, pitch);
        (row.outer_conformity, row.inner_conformity) = (outer, inner);
        row.contact_angle = if two_rows { angle } else { 0.0 };
        row.axial_position *= scale;
        row.start_angle = place + PI / count * i as f64;
    }
    if noise.yes() {
        scene.contact.law = if two_rows {
            NormalLaw::Hertz
        } else {
            NormalLaw::iso16281()
        };
    }
    scene.contact.damping = noise.between(0.05, 0.5);
    scene.friction = Friction::Coulomb {
        coefficient: noise.between(0.01, 0.1),
        slip_speed: noise.between(0.05, 0.3),
    };
    let on = if noise.yes() {
        Surface::OuterRace
    } else {
        Surface::InnerRace
    };
    let (width, length) = (noise.between(1e-3, 3e-3), noise.between(0.3e-3, 1.5e-3));
    let spall = Defect::of(
        Patch::of_width(length * scale)
            .length(width * scale)
            .edge_radius(0.3e-3 * scale),
        on,
        -FRAC_PI_2,
    )
    .at_offset(noise.between(-0.5e-3, 0.5e-3) * scale);
    scene.defects = [("spall".to_owned(), spall)].into();
    scene.name = format!("{count} balls of {:.1} mm", 1e3 * ball);
    scene
}

/// Accelerations of the outer ring along x, y and z, and evaluations.
fn accelerations(scene: &Scene, y0: &[f64]) -> Option<(Vec<[f64; 3]>, usize)> {
    let run = Run {
        duration: 4e-3,
        fs: 100e3,
        threads: 1,
        bandwidth: Bandwidth::Raw,
        settle: Some(0.0),
        start: Start::State(y0.to_vec()),
        ..Run::default()
    };
    let out = simulate(scene, &run).ok()?;
    let [x, y, z] = ["outer.ax", "outer.ay", "outer.az"].map(|name| out.get(name).unwrap());
    let samples = (0..x.len()).map(|k| [x[k], y[k], z[k]]).collect();
    Some((samples, out.stats.nfev))
}

/// The whole error of the defaults, for how long, and the evaluations that they and Dormand–Prince took; none where nothing can
/// be predicted.
fn judged(scene: &Scene) -> Option<(f64, f64, [usize; 2])> {
    let model = compile(scene).ok()?;
    let y0 = start(&model, &Start::Equilibrium).ok()?;
    let fine = |rtol: f64, share: f64| {
        let mut fine = scene.clone();
        fine.contact.slices = Slices::Fitted(64);
        fine.solver.method = Method::DormandPrince;
        fine.solver.rtol = rtol.into();
        fine.solver.max_step = Some(share / model.scales().frequency);
        accelerations(&fine, &y0)
    };
    let (truth, _) = fine(1e-9, 0.2)?;
    let (near, _) = fine(1e-8, 0.3)?;
    let last = running_errors(&near, &truth)
        .iter()
        .rposition(|error| *error < PERCENT / 100.0)?;
    if last < LEAST_SAMPLES {
        return None;
    }
    let (found, nfev) = accelerations(scene, &y0)?;
    let mut pair = scene.clone();
    (pair.solver.method, pair.solver.rtol) = (Method::DormandPrince, 1e-6.into());
    let (_, of_pair) = accelerations(&pair, &y0)?;
    Some((
        running_errors(&found, &truth)[last],
        last as f64 / 1e5,
        [nfev, of_pair],
    ))
}

fn within_a_percent(count: usize) {
    let mut noise = Noise(2031);
    let mut small = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    small.rows[0].start_angle = -FRAC_PI_2 - 0.13;
    let spall = Defect::of(
        Patch::of_width(1e-3).length(2e-3).edge_radius(0.3e-3),
        Surface::OuterRace,
        -FRAC_PI_2,
    )
    .at_offset(0.0);
    small.defects.insert("spall".to_owned(), spall);
    let mut scenes = vec![soon_over_the_spall(3000.0), small];
    while scenes.len() < count + 2 {
        let scene = random(&mut noise);
        // A random bearing may not carry its random load.
        if equilibrium(&scene).is_ok() {
            scenes.push(scene);
        }
    }
    let (mut found, mut efforts) = (vec![], vec![]);
    for scene in &scenes {
        let Some((error, horizon, [nfev, of_pair])) = judged(scene) else {
            println!("{}: not judged", scene.name);
            continue;
        };
        let (percent, milliseconds) = (100.0 * error, 1e3 * horizon);
        println!(
            "{}: {percent:.3} % over {milliseconds:.1} ms, {nfev} evaluations, {of_pair} by the pair",
            scene.name
        );
        found.push(error);
        efforts.push(of_pair as f64 / nfev as f64);
    }
    found.sort_by(f64::total_cmp);
    let median = f64::midpoint(found[(found.len() - 1) / 2], found[found.len() / 2]);
    efforts.sort_by(f64::total_cmp);
    let (n, worst) = (found.len(), found[found.len() - 1]);
    println!(
        "{n} scenes: median {:.3} %, nine in ten {:.3} %, worst {:.3} %; the pair takes {:.1} times the evaluations",
        100.0 * median,
        100.0 * found[9 * n / 10],
        100.0 * worst,
        efforts[n / 2],
    );
    assert!(3 * n > 2 * scenes.len());
    // Where a spall's edge runs through a zone six nodes can be too few: of the forty, in one bearing (9 %; 24 nodes leave
    // 0.2 %), while its steps are right to 0.1 %.
    let over = found.iter().filter(|error| **error > PERCENT).count();
    assert!(20 * over <= n, "{found:?}");
    assert!(median < PERCENT / 5.0, "{found:?}");
    assert!(efforts[n / 2] > 2.0, "{efforts:?}");
}

#[test]
fn the_defaults_are_within_a_percent() {
    within_a_percent(6);
}

#[test]
#[ignore = "takes minutes"]
fn the_defaults_are_within_a_percent_on_forty_bearings() {
    within_a_percent(40);
}
