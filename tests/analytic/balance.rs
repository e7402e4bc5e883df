//! What the static solve leaves unbalanced: next to nothing, over scenes drawn at random.

use crate::common;
use std::f64::consts::PI;

use ballrace::compile;
use ballrace::dynamics::contributions;
use ballrace::scene::{Cage, Material, Mount, NormalLaw, Scene, presets};
use ballrace::{Equilibrium, Start, equilibrium, start};
use common::Noise;

const HARD: [u64; 14] = [
    74, 159, 193, 311, 364, 453, 479, 639, 776, 1293, 1724, 2283, 2306, 2343,
];

/// A scene that somebody could ask for: one of the presets with other loads, speed, geometry, cage and supports.
fn ordinary(seed: u64) -> Scene {
    let mut noise = Noise(seed);
    (0..20).for_each(|_| {
        noise.next();
    });
    let radial = 10_f64.powf(noise.between(0.5, 4.0));
    let axial = if noise.yes() {
        10_f64.powf(noise.between(0.0, 3.5))
    } else {
        0.0
    };
    let mut scene = if noise.yes() {
        presets::deep_groove_6205(radial, axial, noise.between(0.0, 12_000.0))
    } else {
        let mut wheel = presets::wheel_bearing(axial * noise.next().signum());
        wheel.loads.get_mut("radial").unwrap().force = radial.into();
        wheel
    };
    if noise.yes() {
        scene.defects.clear();
    }
    if noise.yes() {
        scene.contact.law =
            [NormalLaw::Hertz, NormalLaw::iso16281()][usize::from(noise.yes())].clone();
    }
    let single = scene.rows.len() == 1;
    let (angle, clearance) = (noise.between(0.0, 0.5), noise.between(-5e-6, 40e-6));
    let (outer, inner) = (noise.between(0.51, 0.54), noise.between(0.505, 0.54));
    let (turn, count) = (noise.between(-3.0, 3.0), noise.between(5.0, 16.0));
    let (change_angle, change_count) = (noise.yes(), noise.yes());
    for row in &mut scene.rows {
        row.clearance = clearance;
        (row.outer_conformity, row.inner_conformity) = (outer, inner);
        row.start_angle += turn;
        if change_angle && (!single || axial > 0.0) {
            row.contact_angle = angle;
        }
        if change_count && single {
            let most = (0.95 * PI * row.pitch_diameter / row.ball_diameter).floor();
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let count = count.min(most) as usize;
            row.ball_count = count;
        }
    }
    scene.cage = noise.yes().then(|| {
        Cage::new(
            10_f64.powf(noise.between(4.0, 8.7)),
            20.0,
            if noise.yes() {
                noise.between(0.0, 2e-4)
            } else {
                0.0
            },
        )
    });
    let support = Mount::Spring {
        stiffness: 10_f64.powf(noise.between(7.0, 9.5)),
        damping: 300.0,
    };
    let outer = &mut scene.outer_ring.support;
    (outer.x, outer.y, outer.z) = (Some(support.clone()), Some(support.clone()), Some(support));
    if noise.yes() {
        scene.gravity = [0.0; 3];
    }
    scene
}

/// The largest force left on a body \[N\], by the model's own forces, and the largest load.
fn left(scene: &Scene, found: &Equilibrium) -> (f64, f64) {
    let model = compile(scene).unwrap();
    let mut y = start(&model, &Start::Equilibrium).unwrap();
    let half = y.len() / 2;
    let orbits: Vec<f64> = (0..found.balls.len())
        .map(|j| common::orbit(&y, 2 + j))
        .collect();
    y[half..].fill(0.0);
    let mut sum = vec![0.0; half];
    for (name, part) in contributions(&model, 0.0, &y) {
        if !["damping", "friction", "drive"].contains(&name) {
            sum.iter_mut()
                .zip(part)
                .for_each(|(sum, part)| *sum += part);
        }
    }
    let loads = scene.loads.values().map(|load| load.force.at(0.0).abs());
    let mut largest = loads.fold(0.0, f64::max);
    // The presets' rings are free along x, y and z.
    let ring = |i: usize| sum[i].hypot(sum[i + 1]).hypot(sum[i + 2]);
    for ball in &found.balls {
        largest = largest.max(ball.outer.load).max(ball.inner.load);
    }
    let worst = |orbits: &[f64]| {
        let mut worst = ring(0).max(ring(4));
        for ((j, ball), orbit) in found.balls.iter().enumerate().zip(orbits) {
            let q = 4 * (2 + j);
            let mass =
                Material::default().density * PI / 6.0 * scene.rows[ball.row].ball_diameter.powi(3);
            let radius = y[q].hypot(y[q + 1]);
            let outwards = (sum[q] * y[q] + sum[q + 1] * y[q + 1]) / radius;
            let radial = outwards + mass * orbit * orbit * radius;
            worst = worst.max(radial.hypot(sum[q + 2]));
        }
        worst
    };
    // Where centrifugal forces are small beside the loads, balls roll as at the nominal contact angle; else as a run begins.
    let rolling = found
        .balls
        .iter()
        .map(|ball| model.rolling_speeds(ball.row).0);
    let worst = worst(&orbits).min(worst(&rolling.collect::<Vec<f64>>()));
    (worst, largest)
}

/// Truth: Newton's law, by the forces of the dynamics; what the solve says it leaves is what it leaves. None where the
/// scene is refused.
fn share(seed: u64) -> Option<f64> {
    let scene = ordinary(seed);
    let found = match equilibrium(&scene) {
        Ok(found) => found,
        Err(error) => {
            println!("{seed}: {error}");
            return None;
        }
    };
    let (worst, largest) = left(&scene, &found);
    let share = worst / largest;
    assert!(share <= 2e-4, "{seed}: {worst:.2e} N of {largest:.2e} N");
    // The largest load of the reported share counts the rings' weight, too.
    let reported = found.residual_share;
    assert!(
        share < 2e-5 || (0.5..2.0).contains(&(reported / share)),
        "{seed}: {share:e}, reported {reported:e}"
    );
    Some(share)
}

/// Scenes that once were accepted with up to four times the load unbalanced: cages stiffer than contacts, loose balls that
/// hang on them, rings that only the cage holds.
#[test]
fn hard_scenes_are_balanced() {
    let shares: Vec<_> = HARD.into_iter().map(share).collect();
    println!("{shares:?}");
    let refused = shares.iter().filter(|share| share.is_none()).count();
    assert_eq!(refused, 0);
}

#[test]
#[ignore = "long: 2344 scenes"]
fn ordinary_scenes_are_balanced() {
    let mut shares: Vec<f64> = (0..2344).filter_map(share).collect();
    shares.sort_by(f64::total_cmp);
    println!("{} refused; worst {:?}", 2344 - shares.len(), shares.last());
    assert_eq!(shares.len(), 2344);
}
