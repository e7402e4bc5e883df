//! Where friction breaks methods: creep instead of sticking, start, stop and reversal, vanishing slip speeds.
//!
//! Each test names the failure, shows it, and shows what happens here instead. `--nocapture` prints the numbers.

use crate::common;
use ballrace::compile;
use ballrace::inspect;
use ballrace::scene::{
    Drive, Friction, Method, NormalLaw, Probe, Profile, Scene, TimeFunction, presets,
};
use ballrace::{Bandwidth, Race, Run, Start, start};
use common::{ball_mass, one_ball, run, short, soon_over_the_spall};

fn with_friction(mut scene: Scene, slip_speed: f64) -> Scene {
    scene.friction = Friction::Coulomb {
        coefficient: 0.05,
        slip_speed,
    };
    scene
}

/// Failure: regularised friction never sticks; a ball that dry friction would hold against its weight creeps.
/// Truth: force balance, v = m g v_s/(μ (N_o + N_i)) for v ≪ v_s. Instead: just that speed, which falls with the slip
/// speed; nothing runs away and nothing is dissipated negatively.
#[test]
fn sticking_is_a_creep_that_falls_with_the_slip_speed() {
    for slip_speed in [0.1, 0.01, 0.001] {
        let mut scene = with_friction(one_ball(10e-6), slip_speed);
        scene.gravity = [0.0, -9.81, 0.0];
        scene.contact.damping = 0.2;
        scene.probes.insert("energy".to_owned(), Probe::energy());
        let model = compile(&scene).unwrap();
        let y0 = start(&model, &Start::Rolling).unwrap();
        let loads: f64 = Race::BOTH
            .into_iter()
            .map(|race| inspect::contact(&model, &y0, 0, race).unwrap().load)
            .sum();
        let expected = ball_mass() * 9.81 * slip_speed / (0.05 * loads);
        let out = run(
            &scene,
            &Run {
                duration: 2e-3,
                start: Start::State(y0),
                bandwidth: Bandwidth::Raw,
                // The slowest creep is 2 µm/s.
                rtol: Some(2e-8),
                ..Run::default()
            },
        );
        let creep = -out.get("ball.vy").unwrap().last().unwrap();
        println!("v_s {slip_speed}: creeps at {creep:.3e} m/s, balance {expected:.3e}");
        assert!((creep / expected - 1.0).abs() < 0.02, "{creep} {expected}");
        let power = out.get("energy.friction_power").unwrap();
        assert!(power.iter().all(|&p| p >= 0.0));
    }
}

/// The 6205 with its energies, driven by a speed in time.
fn driven(speed: TimeFunction, slip_speed: f64) -> Scene {
    let mut scene = with_friction(presets::deep_groove_6205(500.0, 0.0, 0.0), slip_speed);
    scene.drive = Drive::Speed(speed);
    scene.probes = [
        ("energy".to_owned(), Probe::energy()),
        ("ball".to_owned(), Probe::motion("row0.ball0")),
    ]
    .into();
    scene
}

fn ramp(from: f64, to: f64, end: f64) -> TimeFunction {
    TimeFunction::Profile(Profile::Ramp {
        from,
        to,
        start: 0.0,
        end,
    })
}

/// Failure: at zero speed and where it changes sign, the direction of dry friction is not defined.
/// Truth: kinematics: the loaded ball takes up the orbit and the spin of rolling at the new speed.
/// Instead: start from rest, stop and reversal pass with finite forces, and friction never gives energy.
#[test]
fn start_stop_and_reversal_roll_on() {
    let speed = 100.0;
    for (name, from, to) in [
        ("start", 0.0, speed),
        ("stop", speed, 0.0),
        ("reversal", speed, -speed),
        ("rest", 0.0, 0.0),
    ] {
        let out = run(
            &driven(ramp(from, to, 10e-3), 0.01),
            &Run {
                duration: 15e-3,
                bandwidth: Bandwidth::Raw,
                settle: Some(0.0),
                ..Run::default()
            },
        );
        let last = |column: &str| *out.get(column).unwrap().last().unwrap();
        // Pure rolling at no contact angle: spin of the ball over that of the inner ring.
        let gamma = 7.94 / 39.04;
        let spin = -to * (1.0 - gamma) / (2.0 * gamma);
        let measured = last("ball.omega");
        println!(
            "{name}: ball spins at {measured:.2} rad/s, rolling {spin:.2}; {} evaluations",
            out.stats.nfev
        );
        assert!((measured - spin).abs() < 0.02 * speed, "{measured} {spin}");
        for column in &out.columns {
            assert!(
                column.values.iter().all(|x| x.is_finite()),
                "{}",
                column.name
            );
        }
        assert!(
            out.get("energy.friction_power")
                .unwrap()
                .iter()
                .all(|&p| p >= 0.0)
        );
        assert!(out.warnings().is_empty(), "{:?}", out.warnings());
    }
}

/// Failure: friction laws with falling branches could feed energy in. Truth: dissipation F·u ≥ 0 for every law, at
/// random states from rest to gross slip.
#[test]
fn no_friction_law_gives_energy() {
    let laws = [
        Friction::Coulomb {
            coefficient: 0.1,
            slip_speed: 1e-6,
        },
        Friction::Stribeck {
            static_coefficient: 0.3,
            kinetic_coefficient: 0.02,
            stribeck_speed: 1e-3,
            slip_speed: 1e-4,
        },
        Friction::Traction {
            a: -0.05,
            b: 10.0,
            c: 20.0,
            d: 0.05,
            slip_speed: 1e-3,
        },
    ];
    for law in laws {
        for normal in NormalLaw::all() {
            let mut scene = presets::wheel_bearing(3000.0);
            (scene.friction, scene.contact.law) = (law.clone(), normal);
            let model = compile(&scene).unwrap();
            let y0 = start(&model, &Start::Equilibrium).unwrap();
            let half = y0.len() / 2;
            for scale in [0.0, 1e-9, 1e-3, 1.0, 100.0] {
                let mut y = y0.clone();
                for (i, state) in y.iter_mut().enumerate().skip(half) {
                    *state += scale * (((i * 7919) % 997) as f64 / 997.0 - 0.5);
                }
                let power = inspect::energy(&model, &y).unwrap().friction_power;
                assert!(power >= 0.0, "{law:?} {scale}: {power}");
            }
        }
    }
}

/// Failure: as the slip speed goes to zero the explicit step goes with it, and no step resolves the kink.
/// Truth: the warning, or the accuracy. Instead: down to 1e-9 m/s a run ends in bounded effort, because the
/// tolerance limits what the kink can do, and says that its accelerations are not to be believed.
#[test]
fn a_vanishing_slip_speed_is_warned_of() {
    let mut calls = Vec::new();
    for slip_speed in [1e-2, 1e-4, 1e-6, 1e-9] {
        let mut scene = soon_over_the_spall(3000.0);
        scene = with_friction(scene, slip_speed);
        let explicit = Run {
            method: Some(Method::DormandPrince),
            rtol: Some(1e-6),
            ..short(0.1e-3)
        };
        let out = run(&scene, &explicit);
        println!(
            "v_s {slip_speed:e}: {} evaluations, residual {:.1e}",
            out.stats.nfev,
            out.stats.acceleration_residual.unwrap()
        );
        calls.push(out.stats.nfev);
        let doubts = out.warnings().iter().any(|w| w.category() == "accuracy");
        assert_eq!(!doubts, slip_speed > 1e-3);
    }
    assert!(calls[3] < 2 * calls[2]);
}
