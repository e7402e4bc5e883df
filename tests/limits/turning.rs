//! An outer ring that turns. Contacts know only how the rings turn against each other: forces of a state seen by one who turns are those
//! of the scene whose other ring turns. Inertia, loads and gravity know the speeds themselves.

use std::f64::consts::{FRAC_PI_2, TAU};

use ballrace::dynamics::Dynamics;
use ballrace::integrate::System;
use ballrace::scene::{
    Component, Defect, Drive, Friction, Load, MotionProbe, Mount, Patch, Probe, Profile, RingName,
    Spin, Support, Surface, Texture, TimeFunction, Unbalance, Waviness, presets,
};
use ballrace::{
    Bandwidth, BodyId, Dof, Model, Run, Scene, Signals, Simulation, Start, compile, start,
};

use crate::common::{Noise, effects, oiled, run};

const RINGS: [BodyId; 2] = [BodyId::OUTER, BodyId::INNER];

/// A 6205 with damage on all surfaces, waves and texture, whose balls are squeezed all around.
fn damaged() -> Scene {
    let mut scene = presets::deep_groove_6205(500.0, 300.0, 1800.0);
    scene.rows[0].clearance = -10e-6;
    scene.rows[0].outer_waviness = vec![Waviness::new(13, 0.6e-6, 0.4)];
    scene.rows[0].inner_waviness = vec![Waviness::new(17, 0.4e-6, 1.1)];
    scene.rows[0].texture = Some(Texture::of_races(1e-9));
    for (name, on, angle) in [
        ("outer", Surface::OuterRace, -1.5),
        ("inner", Surface::InnerRace, 0.3),
        ("ball", Surface::Ball, 0.1),
    ] {
        let defect = Defect::of(
            Patch::of_width(1.5e-3).length(1.5e-3).edge_radius(0.3e-3),
            on,
            angle,
        )
        .at_offset(0.0);
        let defect = if on == Surface::Ball {
            defect.on_ball(0)
        } else {
            defect
        };
        scene.defects.insert(name.to_owned(), defect);
    }
    scene
}

fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// A state of parallel rings in a frame that has turned by an angle and turns at a speed.
fn in_frame(model: &Model, y: &[f64], angle: f64, speed: f64) -> Vec<f64> {
    let (layout, mut seen) = (model.layout(), y.to_vec());
    for body in layout.bodies() {
        let [x, y_] = [Dof::X, Dof::Y].map(|dof| layout.at(body, dof));
        let [vx, vy] = [Dof::X, Dof::Y].map(|dof| layout.speed_at(body, dof));
        let (place, velocity) = ([y[x], y[y_]], [y[vx] - speed * y[y_], y[vy] + speed * y[x]]);
        [seen[x], seen[y_]] = turned(place, angle);
        [seen[vx], seen[vy]] = turned(velocity, angle);
        seen[layout.at(body, Dof::Theta)] += angle;
        seen[layout.speed_at(body, Dof::Theta)] += speed;
        if layout.has(body, Dof::TurnX) {
            let across = [Dof::TurnX, Dof::TurnY].map(|dof| layout.speed_at(body, dof));
            [seen[across[0]], seen[across[1]]] = turned(across.map(|at| y[at]), angle);
        }
    }
    seen
}

/// The same scene seen by one who turns: what speed the inner ring has, the outer has backwards.
fn mirrored(scene: &Scene) -> Scene {
    let mut other = scene.clone();
    other.outer_speed = Some((-scene.drive.initial_speed()).into());
    other.drive = Drive::Speed(0.0.into());
    other
}

/// A state near that of the start, of balls that have turned and slip.
fn shaken(model: &Model, noise: &mut Noise) -> Vec<f64> {
    let layout = model.layout();
    let mut y = start(model, &Start::Rolling).unwrap();
    for (body, dof) in layout.degrees().collect::<Vec<_>>() {
        let is_ring = RINGS.contains(&body);
        let (place, speed) = match dof {
            Dof::X | Dof::Y | Dof::Z => (4e-6, 0.02),
            _ if is_ring => (0.0, 0.0),
            _ => (1.0, 20.0),
        };
        y[layout.at(body, dof)] += place * noise.next();
        y[layout.speed_at(body, dof)] += speed * noise.next();
    }
    y[layout.at(BodyId::INNER, Dof::Theta)] = 3.0 * noise.next();
    y
}

/// Forces on all bodies that are there without contacts' parts cancelling: the largest of all bodies \[N\].
fn largest(forces: &[[f64; 4]]) -> f64 {
    let each = forces.iter().flat_map(|of| of[..3].iter());
    each.fold(0.0, |most: f64, of| most.max(of.abs()))
}

/// Limits: with outer ring at −Ω and the frame turned, all forces are those with the inner ring at Ω, to round-off: contacts on damaged,
/// wavy and rough races, damping, friction, films with their traction and rolling resistance, and the cage.
#[test]
fn contacts_feel_only_how_the_rings_turn_against_each_other() {
    let mut oil = oiled(damaged());
    // Oil in the balls' way stands in space.
    oil.lubricant.as_mut().unwrap().fill = 0.0;
    let mut free = damaged();
    free.spin = Some(Spin::Free);
    free.defects.remove("ball");
    let mut sloped = damaged();
    sloped.rows[0].contact_angle = 0.4;
    let mut noise = Noise(7);
    for (name, scene) in [
        ("dry", damaged()),
        ("oil", oil),
        ("free", free),
        ("sloped", sloped),
    ] {
        // Nothing that stands in space: weight, loads, dampers, springs that differ along x and y.
        let mut scene = scene;
        scene.gravity = [0.0; 3];
        scene.loads.clear();
        let spring = Some(Mount::Spring {
            stiffness: 1e8,
            damping: 0.0,
        });
        scene.outer_ring.support = Support::new([spring.clone(), spring.clone(), spring, None]);
        scene.inner_ring.support = Support::default();
        // Nor the loads of the equilibrium, which centrifugal forces change: contacts average waves and have films by them.
        scene.rows[0].texture.as_mut().unwrap().reference_load = Some(50.0);
        if let Some(oil) = &mut scene.lubricant {
            oil.reference_load = Some(50.0);
        }
        let omega = scene.drive.initial_speed();
        let [of, as_seen] = [scene.clone(), mirrored(&scene)].map(|scene| compile(&scene).unwrap());
        let mut worst = 0.0_f64;
        for _ in 0..40 {
            let (y, angle) = (shaken(&of, &mut noise), 3.0 * noise.next());
            let seen = in_frame(&as_seen, &y, angle, -omega);
            let wanted = Dynamics::new(&of).forces(0.0, &y);
            let found = Dynamics::new(&as_seen).forces(0.0, &seen);
            let (scale, lever) = (largest(&wanted), 4e-3);
            assert!(scale > 100.0);
            for (wanted, found) in wanted.iter().zip(&found) {
                let [x, y] = turned([wanted[0], wanted[1]], angle);
                let off = [
                    x - found[0],
                    y - found[1],
                    wanted[2] - found[2],
                    (wanted[3] - found[3]) / lever,
                ];
                worst = off
                    .iter()
                    .fold(worst, |most, of| most.max(of.abs() / scale));
            }
        }
        println!("{name}: {worst:.1e}");
        // Approaches of some µm are differences of radii: 20 mm · 2e-16 over 5 µm.
        assert!(worst < 1e-10, "{name}: {worst:e}");
    }
}

/// Limits: a ring that nothing turns keeps its speed, so one that is free and one whose speed is given tilt alike, gyroscopic moments and
/// all. Without friction; parallel rings that are about to tilt, since another axis would change the angle about z.
#[test]
fn a_given_speed_is_that_of_a_free_ring_that_nothing_turns() {
    let speed = 250.0;
    let mut free = presets::deep_groove_6205(500.0, 300.0, 1800.0);
    (free.friction, free.cage) = (Friction::None, None);
    let mount = Some(Mount::Spring {
        stiffness: 1e4,
        damping: 0.1,
    });
    let support = &mut free.outer_ring.support;
    (support.tilt_x, support.tilt_y) = (mount.clone(), mount);
    let mut given = free.clone();
    given.outer_speed = Some(speed.into());
    free.outer_ring.support.theta = Some(Mount::Free);
    let accelerations = |scene: &Scene, rates: [f64; 2]| {
        let model = compile(scene).unwrap();
        let layout = model.layout();
        let mut y = start(&model, &Start::Rolling).unwrap();
        y[layout.speed_at(BodyId::OUTER, Dof::Theta)] = speed;
        for (dof, rate) in Dof::TILTS.into_iter().zip(rates) {
            y[layout.speed_at(BodyId::OUTER, dof)] = rate;
        }
        let mut dy = vec![0.0; y.len()];
        Dynamics::new(&model).rhs(0.0, &y, &mut dy);
        [Dof::TiltX, Dof::TiltY, Dof::Theta].map(|dof| dy[layout.speed_at(BodyId::OUTER, dof)])
    };
    let [still, tilting] = [[0.0; 2], [0.3, -0.2]].map(|rates| accelerations(&given, rates));
    assert!(still != tilting);
    for rates in [[0.0; 2], [0.3, -0.2]] {
        let [of_given, of_free] = [&given, &free].map(|scene| accelerations(scene, rates));
        for (a, b) in of_given.iter().zip(of_free).take(2) {
            assert!((a - b).abs() <= 1e-9 * b.abs(), "{of_given:?} {of_free:?}");
        }
    }
}

/// Columns of a run as bits.
fn bits(out: &Signals) -> Vec<Vec<u64>> {
    let of = |column: &ballrace::Column| column.values.iter().map(|x| x.to_bits()).collect();
    out.columns.iter().map(of).collect()
}

fn brief(duration: f64) -> Run {
    Run {
        duration,
        threads: 1,
        ..Run::default()
    }
}

/// Limits: a given speed of 0 is a ring that stands, bit by bit, settled or not; and one in the plane that nobody feels too.
#[test]
fn a_speed_of_zero_is_a_ring_that_stands() {
    let mut round = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    (round.friction, round.contact.damping) = (Friction::None, 0.0);
    for scene in [damaged(), round] {
        let mut given = scene.clone();
        given.outer_speed = Some(0.0.into());
        let mut all = [scene, given].map(|scene| bits(&run(&scene, &brief(2e-3))));
        assert!(!all[0].is_empty() && all[0][0].len() > 50);
        assert!(all[0] == all[1]);
        all[0][0][0] ^= 1;
        assert!(all[0] != all[1]);
    }
}

/// A 6205 whose outer ring turns.
fn hub(outer: f64, inner: f64) -> Scene {
    let mut scene = presets::deep_groove_6205(800.0, 0.0, 0.0);
    scene.outer_speed = Some(outer.into());
    scene.drive = Drive::Speed(inner.into());
    scene
}

/// Analytic: cage and balls of a run are those of rolling between two rings that turn (Harris & Kotzalas),
/// f_c = ½ [f_i (1 − γ) + f_o (1 + γ)], f_b = (d_m/2D) (1 − γ²) |f_i − f_o|; the fault lines follow.
#[test]
fn balls_roll_between_two_rings_that_turn() {
    for [outer, inner] in [[60.0, 0.0], [-40.0, 30.0], [90.0, 30.0]] {
        let scene = hub(TAU * outer, TAU * inner);
        let out = run(&scene, &brief(1.2 / f64::abs(inner - outer)));
        let [found] = out.provenance.kinematics[..] else {
            panic!("one row")
        };
        let row = &scene.rows[0];
        let gamma = row.ball_diameter / row.pitch_diameter;
        let cage = 0.5 * (inner * (1.0 - gamma) + outer * (1.0 + gamma));
        let spin = (1.0 - gamma * gamma) / (2.0 * gamma) * (inner - outer).abs();
        println!("{found:?}, {cage} {spin}");
        assert!((found.outer - outer).abs() < 1e-9 * outer.abs());
        assert!((found.inner - inner).abs() < 1e-9 * outer.abs());
        assert!((found.cage - cage).abs() < 5e-3 * (inner - outer).abs());
        assert!((found.spin.unwrap() / spin - 1.0).abs() < 1e-2);
        assert!(found.ahead().unwrap().abs() < 5e-3);
    }
}

/// Analytic: at t = 0 a run is where its scene says, whatever settled before: the outer ring unturned, balls at their places but for slip.
/// Damage of the outer race has then come a turn closer to them than the cage went.
#[test]
fn a_run_begins_where_its_scene_says() {
    let mut scene = hub(300.0, 0.0);
    let angle = scene.rows[0].start_angle + 0.1;
    let spall = Defect::of(
        Patch::of_width(2e-3).length(1e-3).edge_radius(0.3e-3),
        Surface::OuterRace,
        angle,
    );
    scene.defects.insert("spall".into(), spall.at_offset(0.0));
    scene.probes = [("outer", "outer"), ("ball", "row0.ball0")]
        .map(|(name, body)| {
            let probe =
                MotionProbe::of(body).components([Component::X, Component::Y, Component::Theta]);
            (name.to_owned(), probe.into())
        })
        .into();
    let out = run(
        &scene,
        &Run {
            bandwidth: Bandwidth::Raw,
            ..brief(6e-3)
        },
    );
    let at = |name: &str| out.get(name).unwrap();
    let turned = at("outer.theta");
    assert!(turned[0].abs() < 1e-12);
    for (t, angle) in out.t.iter().zip(turned) {
        assert!((angle - 300.0 * t).abs() < 1e-12);
    }
    let place = at("ball.y")[0].atan2(at("ball.x")[0]);
    let off = (place - scene.rows[0].start_angle).sin().abs();
    assert!(off < 0.02, "{off}");
    // The race comes up behind the ball with 300 rad/s, which goes 0.6 times as fast.
    let orbit = compile(&scene).unwrap().rolling_speeds(0).0;
    let after = (TAU / 9.0 - 0.1) / (300.0 - orbit);
    println!("{orbit} rad/s, next ball after {after} s");
    assert!((170.0..190.0).contains(&orbit));
    let [met] = &out.provenance.defects[..] else {
        panic!("one defect")
    };
    assert!(after < 5.5e-3);
    assert_eq!(met.passes, 1);
}

fn ramp(from: f64, to: f64) -> TimeFunction {
    TimeFunction::Profile(Profile::Ramp {
        from,
        to,
        start: 0.5e-3,
        end: 2.5e-3,
    })
}

/// Analytic: the angle of an outer ring whose speed changes is the antiderivative of it, where it is left out of the run.
#[test]
fn courses_follow_the_outer_ring() {
    let mut scene = presets::wheel_bearing(3000.0);
    scene.outer_speed = Some(ramp(50.0, -100.0));
    scene.drive = Drive::Speed(ramp(0.0, 200.0));
    let ring = [Component::Theta, Component::Omega, Component::Alpha];
    let ring = MotionProbe::of("outer").components(ring);
    scene.probes.insert("ring".into(), ring.into());
    let out = run(
        &scene,
        &Run {
            bandwidth: Bandwidth::Raw,
            settle: Some(0.0),
            ..brief(3e-3)
        },
    );
    let at = |name: &str| *out.get(name).unwrap().last().unwrap();
    // Of a ramp: before it, half of both while it lasts, after it.
    let outer = 50.0 * 0.5e-3 - 0.5 * 50.0 * 2e-3 - 100.0 * (out.t.last().unwrap() - 2.5e-3);
    assert!((at("ring.theta") - outer).abs() < 1e-12);
    assert_eq!(at("ring.omega"), -100.0);
    let alphas = out.get("ring.alpha").unwrap();
    let middle = alphas[alphas.len() / 2];
    assert!((middle + 150.0 / 2e-3).abs() < 1e-6 * 75e3, "{middle}");
}

/// Limits: films are those of the rings' speed against each other, whichever ring turns, and follow it where only the outer changes.
#[test]
fn films_follow_the_relative_speed() {
    let film = |outer: Option<TimeFunction>, inner: f64, alone: bool| {
        let mut scene = oiled(hub(0.0, inner));
        if alone {
            effects(scene.lubricant.as_mut().unwrap(), "film");
        }
        scene.outer_speed = outer;
        scene.lubricant.as_mut().unwrap().reference_speed = Some(150.0);
        scene.lubricant.as_mut().unwrap().reference_load = Some(300.0);
        scene.probes.insert("oil".into(), Probe::lubrication(0));
        let out = run(
            &scene,
            &Run {
                bandwidth: Bandwidth::Raw,
                settle: Some(0.0),
                ..brief(3e-3)
            },
        );
        let films = out.get("oil.outer.film").unwrap();
        assert!(alone || out.get("oil.friction_torque").unwrap()[0] > 0.0);
        [films[0], *films.last().unwrap()]
    };
    // Alone they turn no ball, and nothing but them knows how fast the rings are.
    for alone in [false, true] {
        let still = film(None, 100.0, alone);
        let [slow, fast] = film(Some(ramp(-50.0, -150.0)), 50.0, alone);
        let doubled = film(None, 200.0, alone);
        println!("{still:?} {slow} {fast} {doubled:?}");
        assert!((slow / still[0] - 1.0).abs() < 1e-12);
        assert!((fast / doubled[0] - 1.0).abs() < 1e-12);
        assert!(fast > 1.5 * slow);
    }
}

/// Limits: where films are all that feels how fast the rings turn, runs that leave the rings' rotations out have the same films.
#[test]
fn films_alone_follow_in_reduced_runs() {
    let mut scene = oiled(hub(-50.0, 50.0));
    scene.outer_speed = Some(ramp(-50.0, -150.0));
    effects(scene.lubricant.as_mut().unwrap(), "film");
    (scene.friction, scene.gravity) = (Friction::None, [0.0; 3]);
    let end = |reduce: bool| {
        scene.solver.reduce = reduce;
        let asked = Run {
            settle: Some(0.0),
            ..brief(5e-3)
        };
        let out = run(&scene, &asked);
        *out.get("inner.y").unwrap().last().unwrap()
    };
    let [reduced, whole] = [true, false].map(end);
    println!("{reduced:e} {whole:e}");
    // Films grow by 0.1 µm.
    assert!((reduced - whole).abs() < 2e-9);
}

/// Analytic: an unbalance of a ring at a given speed pulls with m e Ω², where it has turned to; its start is in balance with that.
#[test]
fn an_unbalance_turns_with_the_outer_ring() {
    let (speed, moment) = (400.0, 1e-4);
    let mut scene = hub(speed, 0.0);
    scene
        .unbalances
        .insert("u".into(), Unbalance::new(RingName::Outer, moment, 0.3));
    let model = compile(&scene).unwrap();
    scene.unbalances.clear();
    let without = compile(&scene).unwrap();
    let mut y = start(&model, &Start::Rolling).unwrap();
    y[model.layout().at(BodyId::OUTER, Dof::Theta)] = 0.5;
    let [with, without] = [&model, &without].map(|model| Dynamics::new(model).forces(0.0, &y)[0]);
    for (i, along) in [0.8_f64.cos(), 0.8_f64.sin()].into_iter().enumerate() {
        let wanted = moment * speed * speed * along;
        assert!((with[i] - without[i] - wanted).abs() < 1e-9 * wanted.abs());
    }
}

/// A new speed of the outer ring holds at once, and balls follow.
#[test]
fn a_caller_sets_the_speed_between_the_pieces() {
    let asked = Run {
        bandwidth: Bandwidth::Raw,
        ..brief(2e-3)
    };
    let mut simulation = Simulation::begin(&hub(100.0, 0.0), &asked).unwrap();
    simulation.advance_to(1e-3).unwrap();
    simulation.change(&[("outer_speed", 120.0.into())]).unwrap();
    simulation.advance_to(2e-3).unwrap();
    let end = simulation.finish().unwrap().end_state;
    let model = compile(&hub(100.0, 0.0)).unwrap();
    let layout = model.layout();
    assert_eq!(end[layout.speed_at(BodyId::OUTER, Dof::Theta)], 120.0);
    let turned = end[layout.at(BodyId::OUTER, Dof::Theta)];
    assert!((turned - 0.22).abs() < 1e-9, "{turned}");
}

/// Amplitude of a sine of a frequency in a signal about its mean, under a Hann window.
fn line(x: &[f64], fs: f64, frequency: f64) -> f64 {
    let n = x.len() as f64;
    let mean = x.iter().sum::<f64>() / n;
    let (mut re, mut im) = (0.0, 0.0);
    for (i, value) in x.iter().enumerate() {
        let share = i as f64 / n;
        let window = 1.0 - (TAU * share).cos();
        let (sin, cos) = (TAU * frequency * i as f64 / fs).sin_cos();
        re += window * (value - mean) * cos;
        im += window * (value - mean) * sin;
    }
    2.0 * re.hypot(im) / n
}

/// Highest line near a frequency: balls slip a little.
fn near(x: &[f64], fs: f64, frequency: f64) -> f64 {
    let around = (-6..=6).map(|k| frequency * (1.0 + 1e-3 * f64::from(k)));
    around.map(|f| line(x, fs, f)).fold(0.0, f64::max)
}

/// Analytic: orders of a planet's bearing. The pin turns with the carrier at f_i, the planet on it at f_o, and the tooth loads with the
/// carrier, or, of an idler, stand, or turn with the ring. A spall of the outer race is met by Z (1 − γ)/2 |f_i − f_o| balls a second, and
/// its strikes swell with the turns of the ring against the load, |f_o − f_l|: where the load turns with the ring they do not.
#[test]
fn a_planet_under_a_load_that_turns() {
    let (outer, inner, fs) = (-150.0, 50.0, 100e3);
    let strikes = |load: f64| {
        let mut scene = hub(TAU * outer, TAU * inner);
        scene.gravity = [0.0; 3];
        let sine = |phase: f64| {
            TimeFunction::Profile(Profile::Sine {
                mean: 0.0,
                amplitude: 1500.0,
                frequency: f64::abs(load),
                phase,
            })
        };
        // cos and sin of an angle that begins at −90°.
        let along = [sine(0.0), sine(-FRAC_PI_2)];
        scene.loads.clear();
        for (i, force) in along.into_iter().enumerate() {
            let mut direction = [0.0; 3];
            direction[i] = if i == 0 { load.signum() } else { 1.0 };
            let name = ["x", "y"][i].to_owned();
            scene
                .loads
                .insert(name, Load::new(RingName::Inner, direction, force));
        }
        let spall = Defect::of(
            Patch::of_width(2e-3).length(1e-3).edge_radius(0.3e-3),
            Surface::OuterRace,
            -FRAC_PI_2,
        );
        scene.defects.insert("spall".into(), spall.at_offset(0.0));
        let probe = MotionProbe::of("outer").components([Component::Ax, Component::Ay]);
        scene.probes = [("outer".to_owned(), probe.into())].into();
        // After 10 ms.
        let from = 1000;
        let out = run(
            &scene,
            &Run {
                fs,
                ..brief(10e-3 + 8.0 / 150.0)
            },
        );
        let [x, y] = ["outer.ax", "outer.ay"].map(|name| &out.get(name).unwrap()[from..]);
        let power: Vec<f64> = x.iter().zip(y).map(|(x, y)| x * x + y * y).collect();
        let [did] = out.provenance.kinematics[..] else {
            panic!("one row")
        };
        let met = 9.0 * (did.cage - did.outer).abs();
        let beside = (outer - load).abs().max(50.0);
        let sides = [met - beside, met + beside].map(|f| near(&power, fs, f));
        let row = &scene.rows[0];
        let gamma = row.ball_diameter / row.pitch_diameter;
        let wanted = 4.5 * (1.0 - gamma) * (inner - outer);
        println!(
            "load at {load} Hz: met {met:.1} Hz, rolling {wanted:.1}; {:.3e}, beside {sides:?}, {:?}",
            near(&power, fs, met),
            out.provenance.defects
        );
        assert!((met / wanted - 1.0).abs() < 0.01);
        sides.map(|side| side / near(&power, fs, met))
    };
    let [with_carrier, with_ring] = [inner, outer].map(strikes);
    assert!(
        with_carrier.iter().all(|side| *side > 0.2),
        "{with_carrier:?}"
    );
    assert!(with_ring.iter().all(|side| *side < 0.1), "{with_ring:?}");
}
