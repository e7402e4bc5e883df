//! Helpers that the tests share.

// Every test program uses a part of it.
#![allow(dead_code)]

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use ballrace::scene::{
    Damage, Defect, Floor, Friction, Lubricant, Mount, Probe, RaceProfile, Row, Scene, Support,
    Width, presets,
};
use ballrace::{Bandwidth, Race, Run, Signals, simulate};

/// Numbers in −1 … 1, the same in every run.
pub struct Noise(pub u64);

impl Noise {
    pub fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        f64::from((self.0 >> 33) as u32) / f64::from(1u32 << 30) - 1.0
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * 0.5 * (1.0 + self.next())
    }

    pub fn yes(&mut self) -> bool {
        self.next() > 0.0
    }
}

/// Shows a number beside the published one and holds it to a relative tolerance. `tests/validation.py` reads
/// the line into the validation page.
pub fn meets(case: &str, published: f64, ours: f64, tolerance: f64) {
    let deviation = ours / published - 1.0;
    println!(
        "| {case} | {published} | {ours:.6} | {:+.3} % | {} % |",
        100.0 * deviation,
        100.0 * tolerance
    );
    assert!(
        deviation.abs() <= tolerance,
        "{case}: published {published}, ours {ours}, more than {tolerance} apart"
    );
}

/// A run that must come to its end.
pub fn run(scene: &Scene, run: &Run) -> Signals {
    simulate(scene, run).unwrap_or_else(|error| panic!("{}: {error}", scene.name))
}

/// A run of some duration from equilibrium, point samples at 200 kHz, on one thread.
pub fn short(duration: f64) -> Run {
    Run {
        duration,
        fs: 200e3,
        threads: 1,
        bandwidth: Bandwidth::Raw,
        settle: Some(0.0),
        ..Run::default()
    }
}

/// Root mean square.
pub fn rms(x: &[f64]) -> f64 {
    (x.iter().map(|v| v * v).sum::<f64>() / x.len() as f64).sqrt()
}

/// Relative difference in the L2 norm.
pub fn apart(x: &[f64], truth: &[f64]) -> f64 {
    let difference: Vec<f64> = x.iter().zip(truth).map(|(a, b)| a - b).collect();
    rms(&difference) / rms(truth)
}

/// Restitution v_o/v_i under Hunt–Crossley's force by α_d v_i: b v_i − ln(1 + b v_i) = −b v_o − ln(1 − b v_o), b = 3/2 α_d.
pub fn restitution_of(damped: f64) -> f64 {
    let b = 1.5 * damped;
    let lost = b - b.ln_1p();
    let (mut low, mut high) = (0.0, f64::min(1.0, 1.0 / b));
    for _ in 0..100 {
        let middle = f64::midpoint(low, high);
        if -b * middle - (-b * middle).ln_1p() < lost {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Relative errors of accelerations over the first samples, for each number of them.
pub fn running_errors(found: &[[f64; 3]], truth: &[[f64; 3]]) -> Vec<f64> {
    let (mut off, mut size) = (0.0, 0.0);
    let pairs = found.iter().flatten().zip(truth.iter().flatten());
    let running = pairs.map(|(x, y)| {
        off += (x - y) * (x - y);
        size += y * y;
        (off / size).sqrt()
    });
    running.skip(2).step_by(3).collect()
}

/// Slope of the least-squares line through `(ln h, ln error)`.
pub fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs = points.iter().map(|(h, e)| (h.ln(), e.ln()));
    let (mx, my) = logs
        .clone()
        .fold((0.0, 0.0), |(a, b), (x, y)| (a + x / n, b + y / n));
    let (xy, xx) = logs.fold((0.0, 0.0), |(xy, xx), (x, y)| {
        (xy + (x - mx) * (y - my), xx + (x - mx) * (x - mx))
    });
    xy / xx
}

/// The faulted wheel bearing, turned so that a ball crosses the spall about 1.2 ms after the start.
pub fn soon_over_the_spall(axial_load: f64) -> Scene {
    let mut scene = presets::wheel_bearing(axial_load);
    let (orbit, pitch) = (76.0, TAU / 13.0);
    scene.rows[0].start_angle = -FRAC_PI_2 - orbit * 1.2e-3;
    scene.rows[1].start_angle = scene.rows[0].start_angle + pitch / 2.0;
    scene
}

/// A ball of 7.94 mm at angle 0 between held rings that stand still, squeezed by an interference \[m\]; without
/// gravity, friction, damping and cage. The load rests on a held ring: it only gives the size of a contact.
pub fn one_ball(squeeze: f64) -> Scene {
    let mut scene = presets::deep_groove_6205(1000.0, 0.0, 0.0);
    let fixed = Some(Mount::Fixed);
    let held = Support::new([fixed.clone(), fixed.clone(), fixed, None]);
    scene.rows[0].ball_count = 1;
    scene.rows[0].start_angle = 0.0;
    scene.rows[0].clearance = -squeeze;
    (scene.outer_ring.support, scene.inner_ring.support) = (held.clone(), held);
    (scene.cage, scene.friction, scene.gravity) = (None, Friction::None, [0.0; 3]);
    scene.contact.damping = 0.0;
    scene.probes = [("ball".to_owned(), Probe::motion("row0.ball0"))].into();
    scene
}

/// Mass of the ball of [`one_ball`] \[kg\].
pub fn ball_mass() -> f64 {
    7850.0 * PI * 7.94e-3_f64.powi(3) / 6.0
}

/// Points of the groove that a row's conformity says, so many of them to 75° on both sides.
pub fn tabulated(row: &Row, race: Race, count: usize) -> RaceProfile {
    let (conformity, sigma) = match race {
        Race::Outer => (row.outer_conformity, 1.0),
        Race::Inner => (row.inner_conformity, -1.0),
    };
    let (r, ball) = (conformity * row.ball_diameter, row.ball_diameter / 2.0);
    let (sin, cos) = row.contact_angle.sin_cos();
    let a = row.pitch_diameter / 2.0 - sigma * (r - ball) * cos;
    let centre = -sigma * f64::from(row.side) * (r - ball) * sin;
    let angle = |k: usize| 75_f64.to_radians() * (2.0 * k as f64 / count as f64 - 1.0);
    let (z, r) = (0..=count)
        .map(|k| (centre + r * angle(k).sin(), a + sigma * r * angle(k).cos()))
        .unzip();
    RaceProfile::new(z, r)
}

/// Scene with all races through points of their tori.
pub fn through_points(scene: &Scene, count: usize) -> Scene {
    let mut scene = scene.clone();
    for row in &mut scene.rows {
        row.outer_profile = Some(tabulated(row, Race::Outer, count));
        row.inner_profile = Some(tabulated(row, Race::Inner, count));
    }
    scene
}

/// A scene in VG 68 at 55 °C.
pub fn oiled(mut scene: Scene) -> Scene {
    scene.lubricant = Some(Lubricant::named("vg68", 328.15));
    scene
}

/// Leaves one effect of a lubricant by its name, or none.
pub fn effects(of: &mut Lubricant, effect: &str) {
    let is = |name: &str| effect == name;
    (of.film, of.damping, of.traction, of.rolling) =
        (is("film"), is("damping"), is("traction"), is("rolling"));
}

/// How fast a body of a state goes round the axis \[rad/s\].
pub fn orbit(y: &[f64], body: usize) -> f64 {
    let (q, v) = (4 * body, y.len() / 2 + 4 * body);
    (y[q] * y[v + 1] - y[q + 1] * y[v]) / y[q].hypot(y[q + 1]).powi(2)
}

/// Length, width and floor of a defect that is a patch.
pub fn patch(defect: &mut Defect) -> (&mut f64, &mut Width, &mut Option<Floor>) {
    match &mut defect.damage {
        Damage::Patch(of) => (&mut of.length, &mut of.width, &mut of.floor),
        other => panic!("{other:?}"),
    }
}
