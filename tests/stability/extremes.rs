//! Speeds, loads, numbers and tolerances at and beyond the edge; collapse, and chaos.
//!
//! Each test names what could fail, shows the case, and holds it to a truth. `--nocapture` prints the numbers.

use crate::common;
use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use ballrace::compile;
use ballrace::inspect;
use ballrace::scene::{
    Cage, Drive, Friction, Method, Mount, Profile, Scene, TimeFunction, presets,
};
use ballrace::{Error, Race, Run, Signals, Start, simulate_with_progress, start};
use common::{rms, run, short, soon_over_the_spall};

/// The error of a run that must not come to its end, nor go on for ever.
fn refused(scene: &Scene, run: &Run) -> Error {
    let begun = Instant::now();
    let mut patience = |_: f64| {
        if begun.elapsed() < Duration::from_secs(60) {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    };
    simulate_with_progress(scene, run, &mut patience)
        .map(|out| out.stats)
        .expect_err(&scene.name)
}

fn finite(out: &Signals) {
    for column in &out.columns {
        assert!(
            column.values.iter().all(|x| x.is_finite()),
            "{}",
            column.name
        );
    }
}

/// Failure: at no speed the ring stands still for ever; at 30 000 rpm the balls' centrifugal force exceeds the load.
/// Truth: at rest nothing moves by more than its weight; at speed the outer contact of an unloaded ball carries m ω_c² r.
#[test]
fn from_no_speed_to_30_000_rpm() {
    for rpm in [0.0, 1e-3, 1800.0, 30_000.0, -30_000.0] {
        let scene = presets::deep_groove_6205(500.0, 0.0, rpm);
        let model = compile(&scene).unwrap();
        let y = start(&model, &Start::Equilibrium).unwrap();
        let upper = (0..9)
            .map(|j| inspect::contact(&model, &y, j, Race::Outer).unwrap().load)
            .fold(f64::INFINITY, f64::min);
        let orbit = model.rolling_speeds(0).0;
        let mass = 7850.0 * PI * 7.94e-3_f64.powi(3) / 6.0;
        let centrifugal = mass * orbit * orbit * 39.04e-3 / 2.0;
        let out = run(&scene, &short(1e-3));
        finite(&out);
        println!(
            "{rpm} rpm: upper ball {upper:.3} N on the outer race (m ω² r = {centrifugal:.3} N), rms {:.2e} m/s², {} evaluations",
            rms(out.get("outer.ay").unwrap()),
            out.stats.nfev
        );
        // At 30 000 rpm 293 N are less than ten centrifugal forces, which is told; nothing else is.
        let told: Vec<String> = out.warnings().iter().map(ToString::to_string).collect();
        assert_eq!(told.len(), usize::from(rpm.abs() > 1e4), "{told:?}");
        if rpm.abs() > 1e4 {
            assert!(told[0].contains("load of the most loaded ball"), "{told:?}");
            assert!((upper / centrifugal - 1.0).abs() < 0.05);
        }
        if rpm == 0.0 {
            // Loose balls settle under their weight.
            assert!(rms(out.get("outer.ay").unwrap()) < 9.81);
        }
    }
}

/// Failure: a force that jumps within a step is smeared over it. Truth: Newton, on the sample after the jump: the
/// inner ring starts with ΔF/m, to the step's accuracy. Instead: a step ends on the jump, none sees both sides.
#[test]
fn load_steps_are_met_exactly() {
    let at = 0.501_234e-3;
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    scene.loads.get_mut("radial").unwrap().force = TimeFunction::Profile(Profile::Ramp {
        from: 500.0,
        to: 1500.0,
        start: at,
        end: at,
    });
    let fast = Run {
        fs: 1e9 / 40.0,
        ..short(0.6e-3)
    };
    let out = run(&scene, &fast);
    finite(&out);
    let ay = out.get("inner.ay").unwrap();
    let after = out.t.iter().position(|&t| t >= at).unwrap();
    let jump = ay[after] - ay[after - 1];
    println!("inner ring jumps by {jump:.2} m/s², ΔF/m = 1000 N/1 kg");
    assert!((jump / -1000.0 - 1.0).abs() < 1e-2, "{jump}");
    assert!(out.warnings().is_empty(), "{:?}", out.warnings());
    // Reversed, and a hundred times the load, in one instant.
    for to in [-500.0, 50_000.0] {
        scene.loads.get_mut("radial").unwrap().force = TimeFunction::Profile(Profile::Ramp {
            from: 500.0,
            to,
            start: 0.2e-3,
            end: 0.2e-3,
        });
        let out = run(&scene, &short(1e-3));
        finite(&out);
        println!(
            "to {to} N: {} steps, {} rejected, {} pulls",
            out.stats.accepted, out.stats.rejected, out.stats.clamped_pulls
        );
    }
}

/// Sets a field of a scene to a number.
type Set = fn(&mut Scene, f64);

/// Failure: numbers that are none, or beyond all measure, travel silently. Truth: the field is named and nothing runs.
#[test]
fn nan_infinite_and_absurd_input_is_refused_by_name() {
    let good = presets::wheel_bearing(3000.0);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
        let cases: [(&str, Set); 12] = [
            ("rows[0].ball_diameter", |s, x| s.rows[0].ball_diameter = x),
            ("rows[0].pitch_diameter", |s, x| {
                s.rows[0].pitch_diameter = x;
            }),
            ("rows[0].clearance", |s, x| s.rows[0].clearance = x),
            ("rows[1].contact_angle", |s, x| s.rows[1].contact_angle = x),
            ("rows[0].start_angle", |s, x| s.rows[0].start_angle = x),
            ("contact.damping", |s, x| s.contact.damping = x),
            ("friction.coulomb.slip_speed", |s, x| {
                s.friction = Friction::Coulomb {
                    coefficient: 0.1,
                    slip_speed: x,
                }
            }),
            ("loads.radial.force", |s, x| {
                s.loads.get_mut("radial").unwrap().force = x.into();
            }),
            ("drive.speed", |s, x| s.drive = Drive::Speed(x.into())),
            ("gravity[1]", |s, x| s.gravity[1] = x),
            ("defects.spall.width", |s, x| {
                s.defects.get_mut("spall").unwrap().damage.set_width(x);
            }),
            ("solver.rtol", |s, x| s.solver.rtol = x.into()),
        ];
        for (field, set) in cases {
            let mut scene = good.clone();
            set(&mut scene, bad);
            let Error::Scene { path, .. } = refused(&scene, &short(1e-4)) else {
                panic!("{field} = {bad}");
            };
            assert_eq!(path, field);
        }
        for (name, run) in [
            ("duration", short(bad)),
            (
                "fs",
                Run {
                    fs: bad,
                    ..short(1e-3)
                },
            ),
            (
                "rtol",
                Run {
                    rtol: Some(bad),
                    ..short(1e-3)
                },
            ),
        ] {
            let Error::Argument { path, .. } = refused(&good, &run) else {
                panic!("{name} = {bad}");
            };
            assert_eq!(path, name);
        }
    }
    let mut state = start(&compile(&good).unwrap(), &Start::Equilibrium).unwrap();
    state[17] = f64::NAN;
    let run = Run {
        start: Start::State(state),
        ..short(1e-3)
    };
    assert!(matches!(refused(&good, &run), Error::Argument { path, .. } if path == "start[17]"));
}

/// Failure: a tolerance below rounding stalls, one above the motion lies. Truth: the permitted ends, 1e-12 and 1e-1, run
/// and agree within 1 % thanks to the step cap; beyond them the field is named.
#[test]
fn absurd_tolerances() {
    let scene = soon_over_the_spall(3000.0);
    let at = |rtol: f64| Run {
        rtol: Some(rtol),
        ..short(2e-3)
    };
    let truth = run(&scene, &at(1e-9));
    for rtol in [1e-12, 1e-1] {
        let out = run(&scene, &at(rtol));
        let error = common::apart(out.get("outer.ay").unwrap(), truth.get("outer.ay").unwrap());
        println!(
            "rtol {rtol:e}: {} evaluations, {error:.1e} from rtol 1e-9",
            out.stats.nfev
        );
        assert!(error < 0.01);
        assert!(out.warnings().is_empty());
    }
    for rtol in [0.0, -1e-6, 1e-13, 0.2, 1.0] {
        assert!(
            matches!(refused(&scene, &at(rtol)), Error::Argument { path, .. } if path == "rtol")
        );
    }
}

/// Failure: the step of an explicit pair collapses and the run goes on for ever. Truth: the one element that is absurdly
/// fast. Instead: an error within a thousand such steps, with the time, the step, the body and the contacts, cage or support
/// that caused it, the fastest first.
#[test]
fn a_collapsed_step_names_what_caused_it() {
    let mut base = presets::wheel_bearing(3000.0);
    base.solver.method = Method::DormandPrince;
    let mut friction = base.clone();
    friction.friction = Friction::Coulomb {
        coefficient: 1e6,
        slip_speed: 1e-8,
    };
    let mut damping = base.clone();
    damping.contact.damping = 1e3;
    damping.materials.balls.density = 1.0;
    damping.solver.rtol = 1e-12.into();
    let mut one = damping.clone();
    // One ball is pressed hardest, though another is nearer to the load line.
    one.rows[0].diameter_errors = vec![0.0; 13];
    one.rows[0].diameter_errors[0] = 30e-6;
    let mut cage = base.clone();
    let links = base.cage.as_ref().and_then(Cage::links).unwrap();
    cage.cage = Some(Cage::new(links.stiffness, 1e9, links.play));
    let mut support = base.clone();
    support.outer_ring.support.x = Some(Mount::Spring {
        stiffness: 1e9,
        damping: 1e12,
    });
    for (name, scene, expected) in [
        ("friction", friction, ".outer"),
        ("damping", damping, "row0.ball"),
        ("one large ball", one, "row0.ball0."),
        ("cage", cage, "row0.cage"),
        ("support", support, "outer.support"),
    ] {
        let error = refused(&scene, &short(1e-3));
        let Error::Integration {
            time,
            step,
            body,
            contacts,
            reason,
            ..
        } = error
        else {
            panic!("{name}: {error}");
        };
        println!("{name}: t = {time:.2e} s, step {step:.1e} s, {body}: {contacts:?}");
        assert!(contacts[0].contains(expected), "{contacts:?}");
        assert!(
            reason.contains(&contacts[0]) && reason.contains("rate"),
            "{reason}"
        );
        assert!(compile(&scene).unwrap().bodies().contains(&body));
        assert!(time >= 0.0 && step > 0.0 && time + step < 1e-3);
    }
}

/// Failure: a state that throws forces beyond the numbers. Instead: the error names the body and its contacts.
#[test]
fn forces_beyond_numbers_name_the_ball() {
    let scene = presets::wheel_bearing(3000.0);
    let model = compile(&scene).unwrap();
    let mut y = start(&model, &Start::Equilibrium).unwrap();
    let spin = model
        .names()
        .iter()
        .position(|name| name == "row0.ball3.vx")
        .unwrap();
    y[spin] = 1e160;
    let run = Run {
        start: Start::State(y),
        ..short(1e-3)
    };
    let error = refused(&scene, &run);
    println!("{error}");
    assert!(
        matches!(error, Error::Integration { body, .. } if body == "row0.ball3" || body == "outer" || body == "inner")
    );
}

/// Two runs whose starts differ by 1e-12 m in one ball, and their relative difference of acceleration in time.
fn growth(scene: &Scene, begin: &Start, duration: f64) -> Vec<(f64, f64)> {
    let model = compile(scene).unwrap();
    let y0 = start(&model, begin).unwrap();
    let mut y1 = y0.clone();
    y1[4 * 3] += 1e-12;
    let names = ["outer.x", "outer.y", "inner.x", "inner.y"];
    let [a, b] = [y0, y1].map(|y| {
        run(
            scene,
            &Run {
                start: Start::State(y),
                rtol: Some(1e-10),
                ..short(duration)
            },
        )
    });
    let windows = 20;
    let length = a.t.len() / windows;
    (0..windows)
        .map(|w| {
            let part = w * length..(w + 1) * length;
            let gap = names.iter().flat_map(|name| {
                let (a, b) = (
                    &a.get(name).unwrap()[part.clone()],
                    &b.get(name).unwrap()[part.clone()],
                );
                a.iter()
                    .zip(b)
                    .map(|(a, b)| (a - b).abs())
                    .collect::<Vec<_>>()
            });
            (a.t[part.start], gap.fold(0.0, f64::max))
        })
        .collect()
}

/// Failure: a cold start is chaotic: no method's trajectory can be compared with another's for long.
/// Truth: the same run gives the same bits; two starts 1e-12 m apart part exponentially from the rolling start, and
/// slower, from a thousandth of the gap, from equilibrium.
/// Instead: repeatable to the bit, and features, not trajectories, are compared beyond the horizon.
#[test]
fn a_cold_start_is_chaotic_but_repeatable() {
    let mut scene = presets::wheel_bearing(3000.0);
    scene.solver.method = Method::DormandPrince;
    let cold = Run {
        start: Start::Rolling,
        ..short(2e-3)
    };
    let bits = |out: &Signals| -> Vec<u64> {
        out.columns
            .iter()
            .flat_map(|column| column.values.iter().map(|x| x.to_bits()))
            .collect()
    };
    assert_eq!(bits(&run(&scene, &cold)), bits(&run(&scene, &cold)));
    let parted = [Start::Rolling, Start::Equilibrium].map(|begin| {
        let growth = growth(&scene, &begin, 6e-3);
        let (first, last) = (growth[0].1, growth[19].1);
        for (t, gap) in &growth {
            println!("{begin:?}, {:.1} ms: {gap:.1e} m apart", 1e3 * t);
        }
        println!(
            "grows {:.1e} times in 6 ms: e-folding {:.2} ms",
            last / first,
            5.7 / (last / first).ln()
        );
        (last / first, last)
    });
    assert!(
        parted[0].0 > 1e3 && parted[0].0 > 10.0 * parted[1].0,
        "{parted:?}"
    );
    assert!(parted[0].1 > 1e3 * parted[1].1, "{parted:?}");
}
