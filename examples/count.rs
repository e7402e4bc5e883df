use ballrace::dynamics::Dynamics;
use ballrace::integrate::System;
use ballrace::scene::{Friction, Method, NormalLaw, Slices, presets};
use ballrace::{Model, Run, Start, equilibrium, simulate, start};
use std::hint::black_box;

fn rhs(scene: &ballrace::Scene, n: usize) {
    let model = Model::new(scene).unwrap();
    let y = start(&model, &Start::Equilibrium).unwrap();
    let mut dynamics = Dynamics::new(&model);
    let mut dy = vec![0.0; model.dim()];
    for _ in 0..n {
        dynamics.rhs(0.0, black_box(&y), &mut dy);
    }
    black_box(&dy);
}
fn main() {
    let mode = std::env::args().nth(1).unwrap();
    let n: usize = std::env::args().nth(2).unwrap().parse().unwrap();
    let mut wheel = presets::wheel_bearing(3000.0);
    match mode.as_str() {
        "rhs" => rhs(&wheel, n),
        "hertz" => {
            wheel.contact.law = NormalLaw::Hertz;
            wheel.friction = Friction::Coulomb {
                coefficient: 0.1,
                slip_speed: 0.1,
            };
            rhs(&wheel, n)
        }
        "iso" => {
            wheel.contact.law = NormalLaw::iso16281();
            wheel.friction = Friction::Coulomb {
                coefficient: 0.1,
                slip_speed: 0.1,
            };
            rhs(&wheel, n)
        }
        "stribeck" => {
            wheel.friction = Friction::Stribeck {
                static_coefficient: 0.1,
                kinetic_coefficient: 0.05,
                stribeck_speed: 0.3,
                slip_speed: 0.1,
            };
            rhs(&wheel, n)
        }
        "fixed" => {
            wheel.contact.slices = Slices::Fixed(100);
            wheel.contact.law = NormalLaw::iso16281();
            rhs(&wheel, n)
        }
        "deep" => rhs(&presets::deep_groove_6205(500.0, 0.0, 1797.0), n),
        "eq" => {
            for _ in 0..n {
                black_box(equilibrium(black_box(&wheel)).unwrap());
            }
        }
        "eqiso" => {
            wheel.contact.law = NormalLaw::iso16281();
            for _ in 0..n {
                black_box(equilibrium(black_box(&wheel)).unwrap());
            }
        }
        "implicit" => {
            wheel.solver.method = Method::ImplicitFriction;
            let run = Run {
                duration: n as f64 * 1e-4,
                settle: Some(0.0),
                ..Run::default()
            };
            black_box(
                simulate(&wheel, &run, &mut |_| std::ops::ControlFlow::Continue(())).unwrap(),
            );
        }
        "run" => {
            let run = Run {
                duration: n as f64 * 1e-4,
                settle: Some(0.0),
                ..Run::default()
            };
            black_box(
                simulate(&wheel, &run, &mut |_| std::ops::ControlFlow::Continue(())).unwrap(),
            );
        }
        "spall" => {
            let model = Model::new(&wheel).unwrap();
            let y = start(&model, &Start::Equilibrium).unwrap();
            for _ in 0..n {
                for j in 0..model.body_count() - 2 {
                    for r in 0..2 {
                        black_box(model.contact(black_box(&y), j, r));
                    }
                }
            }
        }
        _ => panic!(),
    }
}
