//! A bearing of one's own by its dimensions, at rest and running: `cargo run --release --example own_bearing`.

use std::error::Error;

use ballrace::scene::{Cage, Drive, Friction, Load, Mount, Probe, RingName, Row, Scene};
use ballrace::{Run, equilibrium, simulate};

/// A 6205 with nine balls between elastic housing and shaft, under 500 N.
fn bearing() -> Scene {
    let mut row = Row::new(9, 7.94e-3, 39.04e-3, 0.515, 0.515);
    row.clearance = 5e-6;
    let mut scene = Scene::new(vec![row], Drive::Speed(188.2.into()));
    scene.friction = Friction::Coulomb {
        coefficient: 0.05,
        slip_speed: 0.1,
    };
    scene.cage = Some(Cage::new(1e6, 20.0, 0.1e-3));
    scene.inner_ring.mass = Some(0.2);
    scene.outer_ring.mass = Some(0.1);
    let housing = Some(Mount::Spring {
        stiffness: 1e8,
        damping: 300.0,
    });
    (scene.outer_ring.support.x, scene.outer_ring.support.y) = (housing.clone(), housing);
    let down = Load::new(RingName::Inner, [0.0, -1.0, 0.0], 500.0);
    scene.loads.insert("down".to_owned(), down);
    let motion = Probe::motion("outer");
    scene.probes.insert("outer".to_owned(), motion);
    scene
}

/// Prints what the balls carry and how the housing shakes.
pub fn main() -> Result<(), Box<dyn Error>> {
    let scene = bearing();
    let rest = equilibrium(&scene)?;
    let loads: Vec<f64> = rest.balls.iter().map(|ball| ball.outer.load).collect();
    println!("loads at rest [N]: {loads:.0?}");
    let heaviest = loads.iter().fold(0.0_f64, |most, load| most.max(*load));
    // Stribeck: 4.37 of load over number of balls, 5 with clearance.
    assert!((4.0..5.5).contains(&(heaviest * 9.0 / 500.0)));

    let run = Run {
        duration: 5e-3,
        ..Run::default()
    };
    let out = simulate(&scene, &run)?;
    let ay = out.get("outer.ay").ok_or("no such column")?;
    let mean_square = ay.iter().map(|a| a * a).sum::<f64>() / ay.len() as f64;
    println!("outer.ay: {:.2} m/s² rms", mean_square.sqrt());
    Ok(())
}
