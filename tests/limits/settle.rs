//! Free physics: a run shows the bearing's own motion from t = 0 on. What its start leaves has died down before, and
//! nothing else has changed on the way.

use crate::common;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use ballrace::compile;
use ballrace::scene::{
    Component, Defect, Drive, Friction, MotionProbe, Mount, Pit, Probe, Profile, Scene, Surface,
    TimeFunction, presets,
};
use ballrace::{Bandwidth, Run, Signals, Start, start};
use common::{rms, run};

/// The time in which a ball of row 0 takes the place of the next one \[s\].
fn ball_pass(scene: &Scene) -> f64 {
    let model = compile(scene).unwrap();
    let (orbit, _) = model.rolling_speeds(0);
    TAU / (scene.rows[0].ball_count as f64 * orbit)
}

fn settled(passes: usize, scene: &Scene) -> Signals {
    let duration = passes as f64 * ball_pass(scene);
    let asked = Run {
        duration,
        fs: 200e3,
        threads: 1,
        ..Run::default()
    };
    run(scene, &asked)
}

/// Root mean square, peak and kurtosis of the outer ring's vertical acceleration over each ball pass, about its mean.
fn measures(out: &Signals, passes: usize) -> Vec<[f64; 3]> {
    let ay = out.get("outer.ay").unwrap();
    let size = ay.len() / passes;
    let of = |pass: &[f64]| {
        let mean = pass.iter().sum::<f64>() / size as f64;
        let about: Vec<f64> = pass.iter().map(|v| v - mean).collect();
        let rms = rms(&about);
        let fourth = about.iter().map(|v| v.powi(4)).sum::<f64>() / size as f64;
        let peak = about.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        [rms, peak, fourth / rms.powi(4)]
    };
    ay.chunks_exact(size).take(passes).map(of).collect()
}

/// That the first pass lies within the scatter of the later ones, widened by a factor.
#[track_caller]
fn begins_as_it_goes_on(scene: &Scene, passes: usize, factor: f64) {
    let all = measures(&settled(passes, scene), passes);
    println!("{}: {all:.5?}", scene.name);
    // Less than a ten-thousandth of gravity is nothing.
    if all.iter().all(|pass| pass[1] < 1e-3) {
        return;
    }
    for (i, name) in ["rms", "peak", "kurtosis"].into_iter().enumerate() {
        let later = all[1..].iter().map(|pass| pass[i]);
        let (low, high) = (
            later.clone().fold(f64::INFINITY, f64::min),
            later.fold(0.0, f64::max),
        );
        let first = all[0][i];
        // A ring's own vibration comes and goes; a pass with few strikes in it is no remnant of the start.
        let calm = name != "rms" || first >= low / factor;
        assert!(
            calm && first <= high * factor,
            "{}: {name} of the first pass {first:.3}, later {low:.3} to {high:.3}",
            scene.name
        );
    }
}

/// Unsettled, the first three passes have ten times the later rms: 12.6, 10.2, 11.5, then 0.6 to 1.4 m/s².
#[test]
fn a_healthy_6205_begins_as_it_goes_on() {
    begins_as_it_goes_on(&presets::deep_groove_6205(500.0, 0.0, 1800.0), 10, 1.3);
}

/// Under thrust all balls are loaded and roll without a sound; unsettled, the first pass has 200 times the later rms.
#[test]
fn nothing_is_left_under_thrust() {
    let mut scene = presets::deep_groove_6205(500.0, 500.0, 1800.0);
    begins_as_it_goes_on(&scene, 4, 1.5);
    scene = presets::deep_groove_6205(0.0, 300.0, 1800.0);
    let all = measures(&settled(4, &scene), 4);
    // Of 0.037 m/s² without settling.
    assert!(all[0][0] < 1e-4, "{all:?}");
}

#[test]
fn wheel_bearings_begin_as_they_go_on() {
    for axial in [-3000.0, 0.0, 3000.0] {
        let mut scene = presets::wheel_bearing(axial);
        scene.defects.clear();
        begins_as_it_goes_on(&scene, 8, 1.5);
    }
}

/// Without friction, in the plane, loose balls rattle for ever; a light one at 15 000 rpm is loudest when all of them do.
/// Passes of the first scene scatter from 3 to 15 m/s² as chance has it: it takes two dozen to know by how much.
#[test]
fn bearings_that_rattle_begin_as_they_go_on() {
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    scene.friction = Friction::None;
    begins_as_it_goes_on(&scene, 24, 1.5);
    begins_as_it_goes_on(&presets::deep_groove_6205(100.0, 0.0, 15000.0), 20, 1.3);
}

/// Balls and inner ring stand at t = 0 where the scene says, but for some slip: the cage's play is 0.29 degrees.
#[test]
fn the_phase_is_the_scenes() {
    let mut scene = presets::deep_groove_6205(500.0, 300.0, 1800.0);
    scene.rows[0].start_angle = 0.3;
    let motion = |body: &str| Probe::motion(body);
    scene.probes = [
        ("ball".to_owned(), motion("row0.ball2")),
        ("inner".to_owned(), motion("inner")),
    ]
    .into();
    let out = run(
        &scene,
        &Run {
            duration: 1e-4,
            bandwidth: Bandwidth::Raw,
            ..Run::default()
        },
    );
    let at = |name: &str| out.get(name).unwrap()[0];
    let off = at("ball.y").atan2(at("ball.x")) - (0.3 + 2.0 * TAU / 9.0);
    println!("off by {:.4} degrees", off.to_degrees());
    assert!(off.abs() < 0.25_f64.to_radians(), "{off}");
    assert!(at("inner.theta").abs() < 1e-12, "{}", at("inner.theta"));
    assert!(out.provenance.settled > 0.025, "{}", out.provenance.settled);
}

/// A spall of the inner race meets the same ball at about the time as without settling; the next would come 6 ms later.
#[test]
fn defects_of_the_inner_race_stand_where_the_scene_says() {
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let mut spall = presets::wheel_bearing(0.0).defects.remove("spall").unwrap();
    spall.on = ballrace::scene::Surface::InnerRace;
    spall.axial_offset = 0.0.into();
    // 2 ms later the inner ring has turned it under the lowest ball.
    spall.angle = -FRAC_PI_2 - 60.0 * PI * (1.0 - 0.3983) * 2e-3;
    scene.defects.insert("spall".to_owned(), spall);
    let first = |settle: Option<f64>| {
        let asked = Run {
            duration: 4e-3,
            fs: 200e3,
            settle,
            ..Run::default()
        };
        let out = run(&scene, &asked);
        let ay = out.get("outer.ay").unwrap();
        // The blows of both edges are about as loud: the first one counts.
        let loudest = ay.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
        let first = ay.iter().position(|a| a.abs() > 0.5 * loudest);
        first.map(|at| (out.t[at], ay[at])).unwrap()
    };
    let (unsettled, settled) = (first(Some(0.0)), first(None));
    println!("{unsettled:?} {settled:?}");
    assert!(
        (unsettled.0 - settled.0).abs() < 4e-4,
        "{unsettled:?} {settled:?}"
    );
    assert!((1.5e-3..3e-3).contains(&settled.0), "{settled:?}");
}

/// Switched off, a run begins with the equilibrium and has its bits.
#[test]
fn switched_off_it_changes_nothing() {
    let scene = presets::deep_groove_6205(500.0, 100.0, 1800.0);
    let from = |start: Start, settle: Option<f64>| Run {
        duration: 1e-3,
        start,
        settle,
        ..Run::default()
    };
    let y0 = start(&compile(&scene).unwrap(), &Start::Equilibrium).unwrap();
    let off = run(&scene, &from(Start::Equilibrium, Some(0.0)));
    let given = run(&scene, &from(Start::State(y0), None));
    assert_eq!(off.columns, given.columns);
    for out in [off, given, run(&scene, &from(Start::Rolling, None))] {
        assert_eq!((out.provenance.settled, out.stats.settling_nfev), (0.0, 0));
    }
}

/// What is asked for is done, and counted apart from the run's own effort.
#[test]
fn a_time_may_be_asked_for() {
    let scene = presets::deep_groove_6205(500.0, 100.0, 1800.0);
    let with = |settle: Option<f64>, start: Start| {
        let asked = Run {
            duration: 2e-3,
            settle,
            start,
            ..Run::default()
        };
        run(&scene, &asked)
    };
    for start in [Start::Equilibrium, Start::Rolling] {
        let off = with(Some(0.0), start.clone());
        let on = with(Some(6e-3), start);
        assert_eq!(on.provenance.settled, 6e-3);
        assert_eq!(on.t[0], 0.0);
        // What was left of a rolling start cost steps.
        let share = on.stats.nfev as f64 / off.stats.nfev as f64;
        assert!((0.5..1.4).contains(&share), "{share}");
        let before = on.stats.settling_nfev as f64 / off.stats.nfev as f64;
        // Three times the time, half of it by coarse steps.
        assert!((1.3..4.0).contains(&before), "{before}");
        assert!(on.stats.settling_accepted < on.stats.settling_nfev);
    }
}

/// Effort: before t = 0 steps are as long as a loose tolerance lets them be, until the last 3 ms. The tests above show that nothing of it is
/// left at t = 0.
#[test]
fn settling_takes_half_the_evaluations_of_its_time() {
    let out = settled(4, &presets::deep_groove_6205(500.0, 0.0, 1800.0));
    let stats = &out.stats;
    let before = stats.settling_nfev as f64 / out.provenance.settled;
    let share = before / (stats.nfev as f64 / out.t[out.t.len() - 1]);
    println!("{share:.3}");
    assert!((0.4..0.6).contains(&share), "{share}");
}

#[test]
fn nonsense_is_refused() {
    for settle in [-1.0, f64::NAN, f64::INFINITY] {
        let asked = Run {
            settle: Some(settle),
            ..Run::default()
        };
        let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        let refused = ballrace::simulate(&scene, &asked);
        let message = refused.unwrap_err().to_string();
        assert!(
            message.contains("settle") && message.contains("0 to switch"),
            "{message}"
        );
    }
}

fn ramp(from: f64, to: f64) -> TimeFunction {
    TimeFunction::Profile(Profile::Ramp {
        from,
        to,
        start: 0.0,
        end: 1e-3,
    })
}

/// Loads and speed that change in time wait for t = 0.
#[test]
fn time_begins_at_zero() {
    let steady = presets::deep_groove_6205(500.0, 100.0, 1800.0);
    let mut changing = steady.clone();
    changing.loads.get_mut("radial").unwrap().force = ramp(500.0, 1000.0);
    changing.drive = Drive::Speed(ramp(60.0 * PI, 50.0 * PI));
    let first = |scene: &Scene| {
        let asked = Run {
            duration: 1e-3,
            settle: Some(5e-3),
            ..Run::default()
        };
        let out = run(scene, &asked);
        ["outer.y", "inner.y", "inner.vy", "inner.omega"].map(|name| out.get(name).unwrap()[0])
    };
    let (a, b) = (first(&steady), first(&changing));
    for (a, b) in a.into_iter().zip(b) {
        assert!((a - b).abs() <= 1e-6 * a.abs(), "{a} {b}");
    }
}

/// A driving torque acts from t = 0 on: until then the ring keeps its initial speed.
#[test]
fn a_torque_waits_for_zero() {
    let mut scene = presets::deep_groove_6205(500.0, 100.0, 1800.0);
    scene.drive = Drive::Torque {
        value: 1.0.into(),
        initial_speed: 150.0,
    };
    let asked = Run {
        duration: 1e-3,
        ..Run::default()
    };
    let out = run(&scene, &asked);
    let omega = out.get("inner.omega").unwrap();
    assert!(out.provenance.settled > 0.0);
    assert!((omega[0] - 150.0).abs() < 1e-9, "{}", omega[0]);
    assert!(omega[omega.len() - 1] > 150.0 + 1e-3, "{omega:?}");
}

/// Where nothing takes energy there is nothing to wait for; where little does, the wait is bounded.
#[test]
fn scenes_that_never_settle_are_bounded() {
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    scene.inner_ring.support = ballrace::scene::Support::default();
    scene.outer_ring.support.x = Some(Mount::Fixed);
    scene.outer_ring.support.y = Some(Mount::Fixed);
    scene.outer_ring.support.z = Some(Mount::Fixed);
    let asked = Run {
        duration: 1e-4,
        ..Run::default()
    };
    assert_eq!(run(&scene, &asked).provenance.settled, 0.1);
    scene.contact.damping = 0.0;
    scene.friction = Friction::None;
    assert_eq!(run(&scene, &asked).provenance.settled, 0.0);
}

#[test]
fn threads_do_not_change_the_bits() {
    let mut scene = presets::wheel_bearing(3000.0);
    scene.probes = [(
        "outer".to_owned(),
        MotionProbe::of("outer").components([Component::Ay]).into(),
    )]
    .into();
    let on = |threads: usize| {
        let asked = Run {
            duration: 1e-3,
            settle: Some(1e-3),
            threads,
            ..Run::default()
        };
        run(&scene, &asked).columns
    };
    assert_eq!(on(1), on(3));
}

/// Only a record needs short steps over a pit: before it a fast bearing settles in as many as without one.
#[test]
fn a_pit_does_not_shorten_the_steps_of_settling() {
    let healthy = presets::deep_groove_6205(500.0, 0.0, 15_000.0);
    let mut pitted = healthy.clone();
    let pit = Defect::of(Pit::of_width(0.178e-3), Surface::OuterRace, -FRAC_PI_2);
    pitted.defects.insert("pit".to_owned(), pit);
    let asked = Run {
        duration: 1e-4,
        ..Run::default()
    };
    let [healthy, pitted] = [healthy, pitted].map(|scene| run(&scene, &asked));
    assert!(2.0 * pitted.provenance.step_limit < healthy.provenance.step_limit);
    let [healthy, pitted] = [healthy, pitted].map(|out| out.stats.settling_nfev);
    // The last 3 ms are as fine as the record.
    assert!(2 * pitted < 3 * healthy, "{pitted}, {healthy}");
}
