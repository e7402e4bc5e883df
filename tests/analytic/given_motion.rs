//! Analytic: rings that follow given motions. In a frame that accelerates a bearing feels as much more gravity (d'Alembert); a ring that is
//! given the motion of a free one feels what that one feels; a ring that is given the place of another's rest carries its load.

use ballrace::scene::{Load, Mount, Probe, Profile, RingName, Spin, TimeFunction, presets};
use ballrace::{Bandwidth, Run, Signals, Simulation, Start, equilibrium, simulate};

const DURATION: f64 = 2e-3;

fn sine(mean: f64, amplitude: f64, frequency: f64) -> TimeFunction {
    TimeFunction::Profile(Profile::Sine {
        mean,
        amplitude,
        frequency,
        phase: 0.3,
    })
}

/// ½ a t² of the run.
fn accelerated(a: f64) -> TimeFunction {
    TimeFunction::Profile(Profile::Spline {
        times: vec![0.0, 2.0 * DURATION],
        values: vec![0.0, 2.0 * a * DURATION * DURATION],
        rates: vec![0.0, 2.0 * a * DURATION],
    })
}

fn motion(body: &str) -> Probe {
    Probe::motion(body)
}

/// From nominal places, so that balls strike; samples of points, since a filter changes a constant by 0.05 %.
fn run() -> Run {
    Run {
        duration: DURATION,
        settle: Some(0.0),
        start: Start::Rolling,
        bandwidth: Bandwidth::Raw,
        ..Run::default()
    }
}

/// Largest difference of two columns over the largest of the second.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let largest = b.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max) / largest
}

/// The inner ring is pressed into the balls, both rings are accelerated: in their frame balls weigh more, whether they roll in a plane
/// or between rings that might tilt.
#[test]
fn a_frame_that_accelerates_is_gravity() {
    const A: [f64; 3] = [30.0, 200.0, -10.0];
    for spatial in [false, true] {
        let mut moved = presets::deep_groove_6205(0.0, 0.0, 1800.0);
        moved.gravity = [0.0, -9.81, 0.0];
        moved.loads.clear();
        moved.probes = [("ball".to_owned(), motion("row0.ball2"))].into();
        moved.rows[0].axial_preload = 2e-5;
        moved.solver.rtol = 1e-9.into();
        if spatial {
            moved.spin = Some(Spin::Free);
        }
        let mut weighed = moved.clone();
        for ring in [&mut weighed.outer_ring, &mut weighed.inner_ring] {
            let support = &mut ring.support;
            (support.x, support.y, support.z) = (
                Some(Mount::given(0.0)),
                Some(Mount::given(0.0)),
                Some(Mount::given(0.0)),
            );
        }
        for ring in [&mut moved.outer_ring, &mut moved.inner_ring] {
            let support = &mut ring.support;
            let [x, y, z] = A.map(accelerated);
            (support.x, support.y, support.z) = (
                Some(Mount::given(x)),
                Some(Mount::given(y)),
                Some(Mount::given(z)),
            );
        }
        for (gravity, a) in weighed.gravity.iter_mut().zip(A) {
            *gravity -= a;
        }
        let [moved, weighed] = [&moved, &weighed].map(|scene| simulate(scene, &run()).unwrap());
        for (dof, a) in ["x", "y", "z"].into_iter().zip(A) {
            let name = format!("ball.a{dof}");
            let [moved, weighed] = [&moved, &weighed].map(|of| of.get(&name).unwrap());
            let shifted: Vec<f64> = moved.iter().map(|x| x - a).collect();
            let error = apart(&shifted, weighed);
            println!("{spatial} a{dof} {error:e}");
            assert!(error < 5e-3, "a{dof}: {error}");
        }
    }
}

/// A free inner ring's motion, given to the same ring by its places and speeds, makes the same signals on the sprung outer ring.
#[test]
fn the_motion_of_a_free_ring_given_back_makes_its_signals() {
    let mut free = presets::deep_groove_6205(500.0, 300.0, 1800.0);
    free.probes = [
        ("outer".to_owned(), motion("outer")),
        ("inner".to_owned(), motion("inner")),
    ]
    .into();
    let run = Run {
        fs: 400_000.0,
        ..run()
    };
    free.solver.rtol = 1e-9.into();
    let truth = simulate(&free, &run).unwrap();
    let column = |of: &Signals, name: &str| of.get(name).unwrap().to_vec();
    let mut led = free.clone();
    for (dof, mount) in ["x", "y", "z"].into_iter().zip({
        let support = &mut led.inner_ring.support;
        [&mut support.x, &mut support.y, &mut support.z]
    }) {
        *mount = Some(Mount::given(TimeFunction::Profile(Profile::Spline {
            times: truth.t.clone(),
            values: column(&truth, &format!("inner.{dof}")),
            rates: column(&truth, &format!("inner.v{dof}")),
        })));
    }
    led.inner_ring.mass = None;
    led.loads.retain(|_, load| load.ring == RingName::Outer);
    let found = simulate(&led, &run).unwrap();
    for name in ["outer.ax", "outer.ay", "outer.az"] {
        let error = apart(&column(&found, name), &column(&truth, name));
        println!("{name} {error:e}");
        assert!(error < 1e-3, "{name}: {error}");
    }
}

/// What carries a load carries it where it is given to be, tilted or not.
#[test]
fn a_ring_given_anothers_rest_carries_its_load() {
    for tilts in [false, true] {
        let mut free = presets::deep_groove_6205(800.0, 300.0, 1800.0);
        if tilts {
            let support = &mut free.inner_ring.support;
            (support.tilt_x, support.tilt_y) = (Some(Mount::Free), Some(Mount::Free));
            let mut off = Load::new(RingName::Inner, [0.0, -1.0, 0.0], 100.0);
            off.at = Some([0.0, 0.0, 0.02]);
            free.loads.insert("off".to_owned(), off);
        }
        let rest = equilibrium(&free).unwrap();
        let mut held = free.clone();
        let support = &mut held.inner_ring.support;
        let [x, y, z] = rest.inner;
        (support.x, support.y, support.z) = (
            Some(Mount::given(x)),
            Some(Mount::given(y)),
            Some(Mount::given(z)),
        );
        if tilts {
            let [x, y] = rest.inner_tilt;
            (support.tilt_x, support.tilt_y) = (Some(Mount::given(x)), Some(Mount::given(y)));
        }
        held.loads.retain(|_, load| load.ring == RingName::Outer);
        let again = equilibrium(&held).unwrap();
        for (one, other) in rest.balls.iter().zip(&again.balls) {
            let [one, other] = [one, other].map(|ball| ball.inner.load);
            assert!((one - other).abs() < 1e-4 * 800.0, "{one} {other}");
        }
    }
}

/// What errors of steps add up to is led back: after 2000 periods of a contact a ring is where it was to be, and as fast.
#[test]
fn a_ring_stays_on_its_course() {
    for tilts in [false, true] {
        let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        scene.probes = [("inner".to_owned(), motion("inner"))].into();
        let course = sine(-2.5e-5, 3e-6, 300.0);
        scene.inner_ring.support.x = Some(Mount::given(0.0));
        scene.inner_ring.support.y = Some(Mount::given(course.clone()));
        let tilt = sine(1e-4, 2e-4, 170.0);
        if tilts {
            scene.inner_ring.support.tilt_x = Some(Mount::given(tilt.clone()));
        }
        let run = Run {
            duration: Run::OPEN,
            settle: Some(5e-3),
            ..Run::default()
        };
        let mut simulation = Simulation::begin(&scene, &run).unwrap();
        simulation.advance(0.02).unwrap();
        let names = simulation.model().names();
        let at = |name: &str| simulation.state()[names.iter().position(|n| n == name).unwrap()];
        let t = simulation.time();
        let mut checks = vec![
            ("inner.y", course.at(t), 1e-13),
            ("inner.vy", course.rate(t), 1e-8),
        ];
        if tilts {
            checks.push(("inner.tilt_x", tilt.at(t), 1e-12));
            checks.push(("inner.tilt_vx", tilt.rate(t), 1e-7));
        }
        for (name, truth, limit) in checks {
            let error = (at(name) - truth).abs();
            println!("{name} {error:e}");
            assert!(error < limit, "{name}: {error:e}");
        }
    }
}
