//! What a program outside may rely on: scenes by constructors, runs with an observer, campaigns, one's own integrator on the
//! equations, errors that may grow variants. Without optimisation all of it does with half of the stack that threads of tests have, at
//! every instruction set of the processor.

use std::error::Error;
use std::ops::ControlFlow;
use std::process::Command;
use std::{env, thread};

use ballrace::InstructionSet;
use ballrace::integrate::{DORMAND_PRINCE, Options, System, Tolerance, integrate};
use ballrace::scene::presets::{self, Arrangement};
use ballrace::scene::{
    Defect, Drive, Friction, Load, Lubricant, Patch, RingName, Row, Spin, Surface, Texture,
};
use ballrace::{
    Case, FeatureOptions, Model, Run, Scene, Simulation, Start, campaign, compile, dynamics,
    equilibrium, simulate, simulate_with_progress, start, stiffness,
};

/// Half of what Rust gives a thread \[bytes\].
const STACK: usize = 1 << 20;

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
fn reason(error: &ballrace::Error) -> String {
    match error {
        ballrace::Error::Scene { path, allowed, .. } => format!("{path} must be {allowed}"),
        ballrace::Error::Integration { time, .. } => format!("stopped at {time} s"),
        other => other.to_string(),
    }
}

/// Scenes that between them go through all programs of the contacts.
fn scenes() -> Vec<(&'static str, Scene)> {
    let radial = || presets::deep_groove_6205(1000.0, 0.0, 1800.0);
    let both = || presets::deep_groove_6205(1000.0, 300.0, 1800.0);
    let changed = |mut scene: Scene, change: &dyn Fn(&mut Scene)| {
        change(&mut scene);
        scene
    };
    let oiled = |scene: &mut Scene| scene.lubricant = Some(Lubricant::named("vg68", 333.0));
    let rubbing = |scene: &mut Scene| {
        scene.friction = Friction::Coulomb {
            coefficient: 0.05,
            slip_speed: 0.1,
        };
    };
    let tilting = |scene: &mut Scene| {
        scene.inner_ring.transverse_inertia = Some(1e-4);
        scene.inner_ring.support.tilt_x = Some(ballrace::scene::Mount::Spring {
            stiffness: 1e4,
            damping: 1.0,
        });
    };
    let spalled = |scene: &mut Scene| {
        let spall = Defect::of(
            Patch::of_width(2e-3).length(1e-3).edge_radius(1e-4),
            Surface::OuterRace,
            -1.57,
        );
        scene.defects.insert("spall".to_owned(), spall);
    };
    let textured = |scene: &mut Scene| scene.rows[0].texture = Some(Texture::of_races(1e-7));
    let free = |scene: &mut Scene| scene.spin = Some(Spin::Free);
    let pair = || presets::angular_contact_pair(Arrangement::BackToBack, 500.0, 100.0, 1800.0);
    vec![
        ("wheel", presets::wheel_bearing(3000.0)),
        ("cornering", presets::cornering_wheel(0.3)),
        ("pair", pair()),
        ("deep groove", radial()),
        ("own", bearing()),
        ("plain", changed(radial(), &|scene| scene.lubricant = None)),
        ("rubbing", changed(radial(), &rubbing)),
        ("oiled", changed(both(), &oiled)),
        ("spalled", changed(radial(), &spalled)),
        ("spalled, oiled", changed(changed(both(), &oiled), &spalled)),
        ("textured", changed(both(), &textured)),
        ("tilting", changed(both(), &tilting)),
        ("tilting, oiled", changed(changed(both(), &oiled), &tilting)),
        ("free", changed(changed(both(), &free), &rubbing)),
        ("free, oiled", changed(changed(pair(), &free), &oiled)),
    ]
}

/// Runs them, and asks what else can be asked of a scene.
fn ask_all() -> Result<(), Box<dyn Error>> {
    let run = Run {
        duration: 1e-4,
        settle: Some(0.0),
        ..Run::default()
    };
    for (name, scene) in scenes() {
        match simulate(&scene, &run) {
            Ok(out) => println!("{name}: {} on {}", out.stats.nfev, out.provenance.simd),
            Err(error) => return Err(format!("{name}: {}", reason(&error)).into()),
        }
    }
    let scene = presets::deep_groove_6205(1000.0, 300.0, 1800.0);
    stiffness(&scene)?;
    let mut simulation = Simulation::begin(&scene, &run)?;
    simulation.advance(5e-5)?;
    simulation.finish()?;
    Ok(())
}

/// Does work with little stack.
fn within(stack: usize, work: fn() -> Result<(), Box<dyn Error>>) -> Result<(), Box<dyn Error>> {
    let worker = thread::Builder::new().stack_size(stack);
    let worker = worker.spawn(move || work().map_err(|error| error.to_string()))?;
    worker.join().map_err(|_| "a panic")?.map_err(Into::into)
}

fn main() -> Result<(), Box<dyn Error>> {
    if env::var_os("BALLRACE_SIMD").is_some() {
        return within(STACK, ask_all);
    }
    within(STACK, use_all)?;
    for instructions in InstructionSet::available() {
        let mut own = Command::new(env::current_exe()?);
        if !own
            .env("BALLRACE_SIMD", instructions.name())
            .status()?
            .success()
        {
            return Err(format!("on {instructions}").into());
        }
    }
    Ok(())
}

/// The calls of a program.
fn use_all() -> Result<(), Box<dyn Error>> {
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
        Err(error) => println!("{}", reason(&error)),
    }

    let cases =
        [-1.0, 1.0].map(|axial| Case::new(presets::wheel_bearing(3000.0 * axial), run.clone()));
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
