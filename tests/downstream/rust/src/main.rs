//! What a program outside may rely on: scenes by constructors, runs with an observer, campaigns, one's own integrator on the
//! equations, errors that may grow variants.

use std::error::Error;
use std::ops::ControlFlow;

use ballrace::integrate::{DORMAND_PRINCE, Options, System, Tolerance, integrate};
use ballrace::scene::{Drive, Friction, Load, RingName, Row, presets};
use ballrace::{
    Case, FeatureOptions, Model, Run, Scene, Start, campaign, compile, dynamics, equilibrium,
    simulate_with_progress, start,
};

/// The bearing as a stranger's system of equations.
struct Bearing<'a>(&'a Model);

impl System for Bearing<'_> {
    fn dim(&self) -> usize {
        self.0.dim()
    }

    fn rhs(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        dynamics::rhs(self.0, t, y, dy);
    }
}

/// A bearing of one's own, under 500 N.
fn bearing() -> Scene {
    let row = Row::new(9, 7.94e-3, 39.04e-3, 0.515, 0.515);
    let mut scene = Scene::new(vec![row], Drive::Speed(188.2.into()));
    scene.friction = Friction::Coulomb {
        coefficient: 0.05,
        slip_speed: 0.1,
    };
    scene.inner_ring.mass = Some(0.2);
    let down = Load::new(RingName::Inner, [0.0, -1.0, 0.0], 500.0);
    scene.loads.insert("down".to_owned(), down);
    scene
}

/// Reasons of this program; `ballrace::Error` may have more than are named here.
fn told(error: &ballrace::Error) -> String {
    match error {
        ballrace::Error::Scene { path, allowed, .. } => format!("{path} must be {allowed}"),
        ballrace::Error::Integration { time, .. } => format!("stopped at {time} s"),
        other => other.to_string(),
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let rest = equilibrium(&bearing())?;
    println!(
        "{} balls, {:.3e} Pa",
        rest.balls.len(),
        rest.largest_pressure()
    );

    let run = Run {
        duration: 2e-3,
        ..Run::default()
    };
    let mut watch = |share: f64| {
        if share < 2.0 {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    };
    match simulate_with_progress(&presets::wheel_bearing(3000.0), &run, &mut watch) {
        Ok(out) => println!("{} samples", out.get("outer.ay").map_or(0, <[f64]>::len)),
        Err(error) => println!("{}", told(&error)),
    }

    let cases = [-1.0, 1.0].map(|axial| Case {
        scene: presets::wheel_bearing(3000.0 * axial),
        run: run.clone(),
    });
    let options = FeatureOptions::default();
    for outcome in campaign(cases, 2, &options, &mut |_| ControlFlow::Continue(()))? {
        println!("{} features", outcome.result?.features.len());
    }

    let model = compile(&bearing())?;
    let y0 = start(&model, &Start::Equilibrium)?;
    let tolerance = Tolerance::uniform(model.dim(), 1e-6, 1e-9)?;
    let end = integrate(
        &mut Bearing(&model),
        &DORMAND_PRINCE,
        (0.0, 1e-4),
        &y0,
        &tolerance,
        &Options::default(),
        &mut (),
    )?;
    println!("{} states", end.y.len());
    Ok(())
}
