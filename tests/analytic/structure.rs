//! Analytic: a structure with modes under the outer ring. Without contacts it is a set of coupled oscillators, at rest springs in series;
//! with contacts it keeps energy, and what it does depends neither on the scale of its shapes nor on modes that nothing moves.

use std::f64::consts::TAU;

use crate::common::{apart, rms, run, short};
use ballrace::dynamics::rhs;
use ballrace::scene::{
    Compliance, Drive, Friction, Load, Method, Mode, Mount, Probe, RingName, Scene, Structure,
    Support, presets,
};
use ballrace::{Run, Signals, Start, compile, equilibrium, start, stiffness};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

const STIFFNESS: f64 = 1e8;
const DAMPING: f64 = 300.0;

fn mode(frequency: f64, damping: f64, mass: f64, seat: [f64; 3]) -> Mode {
    Mode::new(frequency, damping, mass, seat).sensor("top", [0.5, 1.0, -0.3])
}

/// Ten modes that couple all directions, or those of the plane alone.
fn ten(z: f64) -> Vec<Mode> {
    let shape = |i: f64| [(1.7 * i).sin(), (2.3 * i).cos(), z * (3.1 * i).sin()];
    (0..10_u8)
        .map(f64::from)
        .map(|i| mode(700.0 * 1.35_f64.powf(i), 0.03, 2.5 / (1.0 + i), shape(i)))
        .collect()
}

fn on(mut scene: Scene, modes: Vec<Mode>) -> Scene {
    scene.structure = Some(Structure::new(modes));
    scene
}

/// An outer ring on its springs with balls that do not touch it, under a force that begins at t = 0.
fn lone(modes: Vec<Mode>, force: [f64; 3]) -> Scene {
    let mut scene = on(presets::deep_groove_6205(0.0, 0.0, 0.0), modes);
    let fixed = || Some(Mount::Fixed);
    let spring = |stiffness| {
        Some(Mount::Spring {
            stiffness,
            damping: DAMPING,
        })
    };
    let held = || Support::new([fixed(), fixed(), fixed(), fixed()]);
    scene.rows[0].clearance = 1e-3;
    scene.rows[0].ball_support = held();
    scene.inner_ring.support = Support::new([fixed(), fixed(), fixed(), None]);
    scene.drive = Drive::Speed(0.0.into());
    scene.outer_ring.mass = Some(0.1);
    scene.outer_ring.support = Support::new([
        spring(STIFFNESS),
        spring(0.8 * STIFFNESS),
        spring(0.6 * STIFFNESS),
        fixed(),
    ]);
    (scene.friction, scene.cage) = (Friction::None, None);
    scene.gravity = [0.0; 3];
    scene.loads.clear();
    let size = Vector3::from(force).norm();
    let direction = force.map(|part| part / size);
    let load = Load::new(RingName::Outer, direction, size);
    scene.loads.insert("push".to_owned(), load);
    scene.probes.clear();
    (scene.solver.method, scene.solver.max_step) = (Method::Verner, Some(1e-6));
    scene
}

fn from_rest(scene: &Scene, duration: f64) -> Signals {
    let exact = Run {
        rtol: Some(1e-12),
        // All at their nominal places.
        start: Start::Rolling,
        ..short(duration)
    };
    run(scene, &exact)
}

/// Truth: the exponential of the linear system's matrix, for one mode and for ten that couple all directions.
#[test]
fn a_ring_on_modes_is_a_set_of_coupled_oscillators() {
    for modes in [vec![mode(1200.0, 0.05, 2.0, [0.0, 1.0, 0.0])], ten(0.7)] {
        let force = Vector3::new(20.0, 100.0, -50.0);
        let scene = lone(modes.clone(), force.into());
        let out = from_rest(&scene, 2e-3);
        let count = modes.len();
        let springs = Vector3::new(1.0, 0.8, 0.6) * STIFFNESS;
        // Pulls of ring and modes on the springs between ring and seat.
        let pulls = DMatrix::from_fn(3, 3 + count, |axis, i| match i.checked_sub(3) {
            None => f64::from(u8::from(axis == i)),
            Some(k) => -modes[k].seat[axis],
        });
        let between = |along: Vector3<f64>| {
            pulls.transpose()
                * DMatrix::from_diagonal(&DVector::from_column_slice(along.as_slice()))
                * &pulls
        };
        let (mut k, mut c) = (between(springs), between(Vector3::repeat(DAMPING)));
        let mut masses = vec![0.1; 3];
        for (i, mode) in modes.iter().enumerate() {
            let omega = TAU * mode.frequency;
            masses.push(mode.mass);
            k[(3 + i, 3 + i)] += mode.mass * omega * omega;
            c[(3 + i, 3 + i)] += 2.0 * mode.damping * omega * mode.mass;
        }
        let n = 3 + count;
        let mut system = DMatrix::zeros(2 * n, 2 * n);
        for i in 0..n {
            system[(i, n + i)] = 1.0;
            for j in 0..n {
                system[(n + i, j)] = -k[(i, j)] / masses[i];
                system[(n + i, n + j)] = -c[(i, j)] / masses[i];
            }
        }
        let mut pushed = DVector::zeros(n);
        pushed.rows_mut(0, 3).copy_from(&force);
        let rest = k.clone().lu().solve(&pushed).unwrap();
        let mut largest = [0.0_f64; 4];
        let mut worst = [0.0_f64; 4];
        for (at, t) in out.t.iter().enumerate().step_by(20) {
            let mut from = DVector::zeros(2 * n);
            from.rows_mut(0, n).copy_from(&-&rest);
            let now = (&system * *t).exp() * from;
            let rates = &system * &now;
            let ring = |i: usize| now[i] + rest[i];
            let stretch = &pulls * (now.rows(0, n) + &rest);
            let seat = springs[1] * stretch[1] + DAMPING * (&pulls * now.rows(n, n))[1];
            let top = (0..count).map(|i| modes[i].sensors["top"][1] * rates[n + 3 + i]);
            let found = ["outer.y", "outer.ay", "seat.fy", "housing.top.ay"]
                .map(|name| out.get(name).unwrap()[at]);
            let exact = [ring(1), rates[n + 1], seat, top.sum::<f64>()];
            for i in 0..4 {
                largest[i] = largest[i].max(exact[i].abs());
                worst[i] = worst[i].max((found[i] - exact[i]).abs());
            }
        }
        for i in 0..4 {
            let share = worst[i] / largest[i];
            println!("{count} modes, column {i}: {share:.1e}");
            assert!(share < 1e-8, "{count} modes, column {i}: {share:e}");
        }
    }
}

/// Truth: a mode that nothing moves is none, to the bit; one too stiff to move is the ground.
#[test]
fn what_does_not_move_is_the_ground() {
    let ground = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let still = on(ground.clone(), vec![mode(1200.0, 0.05, 2.0, [0.0; 3])]);
    let options = short(4e-3);
    let (out, seated) = (run(&ground, &options), run(&still, &options));
    assert_eq!(out.stats.nfev, seated.stats.nfev);
    for column in &out.columns {
        let found = seated.get(&column.name).unwrap();
        assert!(column.values == found, "{}", column.name);
    }
    let force = [20.0, 100.0, -50.0];
    let stiff = vec![mode(1e5, 0.1, 1e9, [0.3, 1.0, 0.2])];
    let none = vec![mode(1200.0, 0.05, 2.0, [0.0; 3])];
    let [stiff, none] = [stiff, none].map(|modes| from_rest(&lone(modes, force), 2e-3));
    for name in [
        "outer.x", "outer.y", "outer.z", "outer.vx", "outer.vy", "outer.vz",
    ] {
        let found = apart(stiff.get(name).unwrap(), none.get(name).unwrap());
        println!("too stiff to move, {name}: {found:.1e}");
        assert!(found < 1e-9, "{name}: {found:e}");
    }
}

/// Truth: compliances in series add up, those of left-out modes too.
#[test]
fn at_rest_compliances_add_up() {
    let residual = [[4e-9, 1e-9, 0.0], [1e-9, 3e-9, 0.5e-9], [0.0, 0.5e-9, 2e-9]];
    for (given, residual) in [
        (None, [[0.0; 3]; 3]),
        (Some(Compliance::Full(residual)), residual),
    ] {
        let force = Vector3::new(120.0, -500.0, 60.0);
        let mut scene = lone(ten(0.7), force.into());
        scene.structure.as_mut().unwrap().static_compliance = given;
        let mut compliance = Matrix3::from_fn(|i, j| residual[i][j]);
        for (i, share) in [1.0, 0.8, 0.6].into_iter().enumerate() {
            compliance[(i, i)] += 1.0 / (share * STIFFNESS);
        }
        for mode in ten(0.7) {
            let seat = Vector3::from(mode.seat);
            compliance += seat * seat.transpose() / (mode.mass * (TAU * mode.frequency).powi(2));
        }
        let found = Vector3::from(equilibrium(&scene).unwrap().outer);
        let moved = compliance * force;
        let off = (found - moved).norm() / moved.norm();
        println!("shift of the ring: {off:.1e}");
        assert!(off < 1e-12, "{off:e}");
        // All bodies rest there.
        let model = compile(&scene).unwrap();
        let y = start(&model, &Start::Equilibrium).unwrap();
        let mut rates = vec![0.0; y.len()];
        rhs(&model, 0.0, &y, &mut rates);
        let fastest = rates.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        let free = force.norm() / 0.1;
        assert!(fastest < 1e-10 * free, "{fastest:e} m/s²");
    }
}

/// Truth: a spring of the same stiffness. What the bearing carries rests as on that, and its own stiffness is the same on either.
#[test]
fn a_loaded_bearing_rests_as_on_the_spring() {
    let seated = on(
        presets::deep_groove_6205(500.0, 100.0, 1800.0),
        vec![
            mode(900.0, 0.05, 3.0, [1.0, 0.0, 0.0]),
            mode(1200.0, 0.05, 2.0, [0.0, 1.0, 0.0]),
            mode(700.0, 0.05, 2.5, [0.0, 0.0, 1.0]),
        ],
    );
    let mut sprung = presets::deep_groove_6205(500.0, 100.0, 1800.0);
    let support = &mut sprung.outer_ring.support;
    for (mount, mode) in [&mut support.x, &mut support.y, &mut support.z]
        .into_iter()
        .zip(&seated.structure.as_ref().unwrap().modes)
    {
        let Some(Mount::Spring { stiffness, .. }) = mount else {
            panic!("no spring")
        };
        let own = mode.mass * (TAU * mode.frequency).powi(2);
        *stiffness = 1.0 / (1.0 / *stiffness + 1.0 / own);
    }
    let (on_modes, on_spring) = (equilibrium(&seated).unwrap(), equilibrium(&sprung).unwrap());
    let off = apart(&on_modes.outer, &on_spring.outer);
    let loads = |of: &ballrace::Equilibrium| -> Vec<f64> {
        of.balls.iter().map(|ball| ball.inner.load).collect()
    };
    let loads = apart(&loads(&on_modes), &loads(&on_spring));
    let own =
        [&seated, &sprung].map(|scene| stiffness(scene).unwrap().inner.as_flattened().to_vec());
    let own = apart(&own[0], &own[1]);
    println!("ring {off:.1e}, loads {loads:.1e}, stiffness {own:.1e}");
    assert!(off < 1e-9 && loads < 1e-8 && own < 1e-6);
}

/// Truth: energy is kept, less the power of all dampers and friction and the work of the loads.
#[test]
fn energy_answers_for_what_is_lost() {
    for modes in [ten(0.0), ten(0.7)] {
        let mut scene = on(presets::deep_groove_6205(400.0, 0.0, 3000.0), modes);
        scene.drive = Drive::Torque {
            value: 0.0.into(),
            initial_speed: scene.drive.initial_speed(),
        };
        scene.probes = [
            ("e".to_owned(), Probe::energy()),
            ("inner".to_owned(), Probe::motion("inner")),
        ]
        .into();
        let exact = Run {
            rtol: Some(1e-11),
            method: Some(Method::Verner),
            start: Start::Rolling,
            fs: 4e6,
            ..short(3e-3)
        };
        let out = run(&scene, &exact);
        let of = |name: &str| out.get(name).unwrap();
        let powers = ["damping_power", "friction_power", "support_power"];
        let powers: Vec<_> = powers.iter().map(|name| of(&format!("e.{name}"))).collect();
        let power: Vec<f64> = (0..out.t.len())
            .map(|i| powers.iter().map(|of| of[i]).sum())
            .collect();
        let last = power.len() - 1;
        let lost: f64 = (0..last)
            .map(|i| {
                let outer = power[i.saturating_sub(1)] + power[(i + 2).min(last)];
                (13.0 * (power[i] + power[i + 1]) - outer) / (24.0 * out.fs)
            })
            .sum();
        let fallen = of("inner.y")[0] - of("inner.y")[last];
        let total = of("e.total");
        let off = total[last] - total[0] + lost - 400.0 * fallen;
        println!("{lost:.3e} J lost, {:.1e} of it unexplained", off / lost);
        assert!(
            lost > 1e-3 && off.abs() < 1e-6 * lost,
            "{off:e} of {lost:e}"
        );
    }
}

/// Truth: shapes along the line between x and y know no difference between them.
#[test]
fn shapes_between_x_and_y_are_symmetric() {
    let half = 0.5_f64.sqrt();
    let pushed = |force| {
        let mut scene = lone(vec![Mode::new(1200.0, 0.05, 2.0, [half, half, 0.0])], force);
        let Some(Mount::Spring { stiffness, .. }) = &mut scene.outer_ring.support.y else {
            panic!("no spring")
        };
        *stiffness = STIFFNESS;
        from_rest(&scene, 2e-3)
    };
    let (along_x, along_y) = (pushed([50.0, 0.0, 0.0]), pushed([0.0, 50.0, 0.0]));
    for (x, y) in [
        ("outer.x", "outer.y"),
        ("outer.y", "outer.x"),
        ("seat.fx", "seat.fy"),
    ] {
        let off = apart(along_x.get(x).unwrap(), along_y.get(y).unwrap());
        println!("{x}: {off:.1e}");
        assert!(off < 1e-12, "{x}: {off:e}");
    }
    assert!(rms(along_x.get("outer.y").unwrap()) > 0.01 * rms(along_x.get("outer.x").unwrap()));
}

/// Truth: shapes times c and masses times c² are the same modes: to rounding, and to the bit for a power of two.
#[test]
fn the_scale_of_shapes_is_free() {
    let scaled = |c: f64| {
        let mut modes = ten(0.0);
        for mode in &mut modes {
            mode.mass *= c * c;
            mode.seat = mode.seat.map(|part| c * part);
            for shape in mode.sensors.values_mut() {
                *shape = shape.map(|part| c * part);
            }
        }
        modes
    };
    let names = ["outer.ay", "seat.fy", "housing.top.ay"];
    let push = |c| from_rest(&lone(scaled(c), [20.0, 100.0, 0.0]), 2e-3);
    let one = push(1.0);
    for c in [1e-3, 3.0, 250.0] {
        let other = push(c);
        for name in names {
            let off = apart(other.get(name).unwrap(), one.get(name).unwrap());
            println!("{c}, {name}: {off:.1e}");
            assert!(off < 1e-11, "{c}, {name}: {off:e}");
        }
    }
    let bearing = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let [one, other] = [1.0, 1024.0].map(|c| run(&on(bearing.clone(), scaled(c)), &short(3e-3)));
    for name in names {
        assert!(one.get(name) == other.get(name), "{name}");
    }
}

/// Truth: the force on a seat that does not move drives the modes as it does on one that moves a little: the difference is of the
/// first order in what they move it by.
#[test]
fn heavy_modes_may_be_driven_one_way() {
    let (frequency, damping) = (3000.0, 0.04);
    let force = [0.0, 80.0, 0.0];
    let still = from_rest(
        &lone(vec![mode(frequency, damping, 1.0, [0.0; 3])], force),
        2e-3,
    );
    let forces = still.get("seat.fy").unwrap();
    let [small, smaller] = [200.0, 400.0].map(|mass| {
        let seated = lone(vec![mode(frequency, damping, mass, [0.0, 1.0, 0.0])], force);
        let out = from_rest(&seated, 2e-3);
        let found = out.get("housing.top.ay").unwrap();
        // Runge and Kutta's method over two samples a step.
        let (omega, h) = (TAU * frequency, 2.0 / out.fs);
        let rate = |[q, v]: [f64; 2], force: f64| {
            [
                v,
                force / mass - 2.0 * damping * omega * v - omega * omega * q,
            ]
        };
        let mut state = [0.0; 2];
        let mut one_way = vec![rate(state, forces[0])[1]];
        for at in (0..forces.len() - 2).step_by(2) {
            let go = |by: f64, k: [f64; 2]| [state[0] + by * k[0], state[1] + by * k[1]];
            let a = rate(state, forces[at]);
            let b = rate(go(0.5 * h, a), forces[at + 1]);
            let c = rate(go(0.5 * h, b), forces[at + 1]);
            let d = rate(go(h, c), forces[at + 2]);
            for i in 0..2 {
                state[i] += h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]);
            }
            one_way.push(rate(state, forces[at + 2])[1]);
        }
        let coupled: Vec<f64> = found.iter().copied().step_by(2).collect();
        apart(&one_way, &coupled[..one_way.len()])
    });
    println!("one way is off by {small:.4} and {smaller:.4}");
    assert!(small < 0.05 && (small / smaller - 2.0).abs() < 0.1);
}

/// Truth: the same bearing without a structure. Its steps follow contacts, not modes.
#[test]
fn a_structure_takes_no_more_steps() {
    let ground = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let seated = on(ground.clone(), ten(0.0));
    let [without, with] = [&ground, &seated].map(|scene| {
        let out = run(
            scene,
            &Run {
                settle: None,
                ..short(0.05)
            },
        );
        out.stats.nfev as f64
    });
    println!("{without} evaluations, {with} with ten modes");
    assert!((with / without - 1.0).abs() < 0.02);
}
