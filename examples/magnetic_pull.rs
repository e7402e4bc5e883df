//! Unbalanced magnetic pull of a motor as a force of one's own on the outer ring, in a housing of 30 N/µm.
//!
//! The pull grows with the displacement, by 10 N/µm here, and so softens the mount: at rest the ring sinks by F/(k − k_m), and it
//! vibrates as on a spring of that stiffness. `cargo run --release --example magnetic_pull`

use std::f64::consts::TAU;
use std::sync::Arc;

use ballrace::scene::{Friction, Mount, RingForce, RingMotion, RingName, Scene, presets};
use ballrace::{Run, equilibrium, simulate};

const HOUSING: f64 = 3e7; // N/m
const PULL: f64 = 1e7; // N/m
const LOAD: f64 = 800.0; // N

#[derive(Debug)]
struct MagneticPull {
    /// Force over displacement, alike in all directions \[N/m\].
    slope: f64,
}

impl RingForce for MagneticPull {
    fn ring(&self) -> RingName {
        RingName::Outer
    }

    fn wrench(&self, _t: f64, ring: &RingMotion) -> [f64; 6] {
        let [x, y, _] = ring.place;
        [self.slope * x, self.slope * y, 0.0, 0.0, 0.0, 0.0]
    }

    fn stiffness(&self) -> f64 {
        self.slope
    }

    fn energy(&self, ring: &RingMotion) -> f64 {
        let [x, y, _] = ring.place;
        -0.5 * self.slope * (x * x + y * y)
    }

    fn keeps_plane(&self) -> bool {
        true
    }
}

/// A 6205 whose outer ring is sprung in its housing, with the rotor's load on it.
fn motor() -> Scene {
    let mut scene = presets::deep_groove_6205(LOAD, 0.0, 1800.0);
    scene.gravity = [0.0; 3];
    let mount = Mount::Spring {
        stiffness: HOUSING,
        damping: 300.0,
    };
    let support = &mut scene.outer_ring.support;
    (support.x, support.y) = (Some(mount.clone()), Some(mount));
    scene
}

fn pulled(mut scene: Scene) -> Scene {
    let pull = MagneticPull { slope: PULL };
    scene.ring_forces.insert("pull", Arc::new(pull));
    scene
}

/// How far the ring sinks \[m\].
fn sunk(scene: &Scene) -> ballrace::Result<f64> {
    Ok(-equilibrium(scene)?.outer[1])
}

/// A heavy ring on its own, without balls that touch: the frequency of its vibration \[Hz\], by its first zero crossings.
fn frequency(mut scene: Scene) -> ballrace::Result<f64> {
    scene.loads.clear();
    (scene.friction, scene.cage) = (Friction::None, None);
    scene.rows[0].clearance = 2e-3;
    scene.outer_ring.mass = Some(2.0);
    let model = ballrace::compile(&scene)?;
    let mut state = ballrace::start(&model, &ballrace::Start::Rolling)?;
    state[model
        .names()
        .iter()
        .position(|name| name == "outer.vy")
        .unwrap_or(0)] = 0.01;
    let run = Run {
        duration: 6e-3,
        fs: 200e3,
        start: ballrace::Start::State(state),
        ..Run::default()
    };
    let signals = simulate(&scene, &run)?;
    let vy = signals.get("outer.vy").unwrap_or_default();
    let crossings: Vec<f64> = vy
        .windows(2)
        .enumerate()
        .filter(|(_, v)| (v[0] < 0.0) != (v[1] < 0.0))
        .map(|(i, v)| (i as f64 + v[0] / (v[0] - v[1])) / run.fs)
        .collect();
    let halves = crossings.len() - 1;
    Ok(0.5 * halves as f64 / (crossings[halves] - crossings[0]))
}

fn main() -> ballrace::Result<()> {
    let (free, soft) = (sunk(&motor())?, sunk(&pulled(motor()))?);
    println!(
        "sinks by {:.2} µm without, {:.2} µm with the pull",
        1e6 * free,
        1e6 * soft
    );
    println!("F/(k - k_m) = {:.2} µm", 1e6 * LOAD / (HOUSING - PULL));
    let natural = |stiffness: f64| (stiffness / 2.0).sqrt() / TAU;
    println!(
        "vibrates at {:.1} Hz without, {:.1} Hz with it",
        frequency(motor())?,
        frequency(pulled(motor()))?
    );
    println!(
        "closed form: {:.1} and {:.1} Hz",
        natural(HOUSING),
        natural(HOUSING - PULL)
    );
    Ok(())
}

/// Truth: a mass on a spring of k − k_m.
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pull_softens_the_mount() {
        let soft = sunk(&pulled(motor())).unwrap();
        assert!(
            (soft * (HOUSING - PULL) / LOAD - 1.0).abs() < 2e-3,
            "{soft}"
        );
        let natural = ((HOUSING - PULL) / 2.0).sqrt() / TAU;
        let found = frequency(pulled(motor())).unwrap();
        assert!((found / natural - 1.0).abs() < 2e-3, "{found} {natural}");
    }
}
