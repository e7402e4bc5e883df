//! A run in pieces is the run in one piece, bit by bit, whatever the pieces, through snapshots, and where nothing changes.

use ballrace::scene::{
    Drive, Load, Lubricant, Method, Mode, Moment, Mount, Probe, Profile, RingName, Spin, Structure,
    TimeFunction, presets,
};
use ballrace::{
    Bandwidth, Column, Error, Run, Scene, Signals, Simulation, Snapshot, Start, simulate,
};

const DURATION: f64 = 4e-3;

fn run() -> Run {
    Run {
        duration: DURATION,
        ..Run::default()
    }
}

/// Scenes whose runs remember different things: matrices of both kinds, films that follow the speed, none at all; reduced and whole.
fn scenes() -> Vec<(&'static str, Scene)> {
    let deep = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let mut wheel = presets::wheel_bearing(3000.0);
    for (name, probe) in [
        ("cage", Probe::cage(0)),
        ("energy", Probe::energy()),
        ("torque", Probe::torque()),
    ] {
        wheel.probes.insert(name.to_owned(), probe);
    }
    let mut frictionless = deep.clone();
    (frictionless.friction, frictionless.contact.damping) = (ballrace::scene::Friction::None, 0.0);
    let mut ramp = presets::deep_groove_6205(500.0, 300.0, 1800.0);
    ramp.lubricant = Some(Lubricant::named("vg68", 328.15));
    ramp.drive = Drive::Speed(TimeFunction::Profile(Profile::Ramp {
        from: 150.0,
        to: 220.0,
        start: 1e-3,
        end: 3e-3,
    }));
    let mut tilting = presets::wheel_bearing(2000.0);
    let support = &mut tilting.inner_ring.support;
    (support.tilt_x, support.tilt_y) = (Some(Mount::Free), Some(Mount::Free));
    tilting.spin = Some(Spin::Free);
    let mut seated = deep.clone();
    let foot = Mode::new(1200.0, 0.05, 2.0, [0.1, 1.0, 0.0]).sensor("top", [0.0, 1.0, 0.0]);
    seated.structure = Some(Structure::new(vec![foot]));
    for (name, probe) in [("housing", Probe::structure()), ("seat", Probe::seat())] {
        seated.probes.insert(name.to_owned(), probe);
    }
    let with = |method| {
        let mut scene = deep.clone();
        scene.solver.method = method;
        scene
    };
    vec![
        ("deep groove", deep.clone()),
        ("Dormand-Prince", with(Method::DormandPrince)),
        ("Verner", with(Method::Verner)),
        ("wheel", wheel),
        ("without friction", frictionless),
        ("oil, speed rising", ramp),
        ("tilting, spinning", tilting),
        ("on a structure", seated),
    ]
}

fn bits(columns: &[Column]) -> Vec<(String, Vec<u64>)> {
    let of = |column: &Column| {
        let bits = column.values.iter().map(|x| x.to_bits()).collect();
        (column.name.clone(), bits)
    };
    columns.iter().map(of).collect()
}

fn append(all: &mut Vec<Column>, next: Vec<Column>) {
    if all.is_empty() {
        *all = next;
        return;
    }
    for (all, next) in all.iter_mut().zip(next) {
        assert_eq!(all.name, next.name);
        all.values.extend(next.values);
    }
}

/// Ends of pieces: equal ones, shorter than a step, and of all lengths.
fn pieces(kind: usize) -> Vec<f64> {
    let even = |count: usize| {
        (1..=count)
            .map(|i| DURATION * i as f64 / count as f64)
            .collect()
    };
    match kind {
        0 => even(1),
        1 => even(7),
        2 => (1..400)
            .map(|i| 1e-7 * f64::from(i))
            .chain([2e-3, DURATION])
            .collect(),
        _ => (1..=12)
            .map(|i| DURATION * (f64::from(i) / 12.0).powi(3))
            .collect(),
    }
}

/// A run in pieces, taken up by `between` after each of them.
fn in_pieces(
    name: &str,
    scene: &Scene,
    run: &Run,
    kind: usize,
    between: impl Fn(Simulation) -> Simulation,
) -> (Vec<Column>, Signals) {
    let mut simulation = Simulation::begin(scene, run).unwrap();
    let mut record = Vec::new();
    for end in pieces(kind) {
        simulation
            .advance_to(end)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(simulation.time(), end, "{name}");
        append(&mut record, simulation.take_block().columns);
        simulation = between(simulation);
    }
    let mut signals = simulation.finish().unwrap();
    append(&mut record, std::mem::take(&mut signals.columns));
    (record, signals)
}

fn is_the_same(name: &str, whole: &Signals, (record, pieces): &(Vec<Column>, Signals)) {
    for ((name_of, whole), (_, pieces)) in bits(&whole.columns).iter().zip(&bits(record)) {
        let first = whole.iter().zip(pieces).position(|(a, b)| a != b);
        assert_eq!(whole.len(), pieces.len(), "{name}, {name_of}");
        assert_eq!(first, None, "{name}, {name_of}: sample");
    }
    let counts = |signals: &Signals| {
        let stats = signals.stats;
        (
            stats.accepted,
            stats.rejected,
            stats.nfev,
            stats.nfev_past_end,
            stats.acceleration_residual,
        )
    };
    assert_eq!(counts(whole), counts(pieces), "{name}");
    assert_eq!(
        whole.provenance.defects, pieces.provenance.defects,
        "{name}"
    );
}

#[test]
fn pieces_of_all_lengths_give_the_same_bits() {
    for (name, scene) in scenes() {
        let whole = simulate(&scene, &run()).unwrap();
        for kind in 0..4 {
            let pieces = in_pieces(name, &scene, &run(), kind, |simulation| simulation);
            is_the_same(&format!("{name}, pieces {kind}"), &whole, &pieces);
        }
    }
}

/// A run without an end of its own is the run that ends there, but for what its last step gives: it is not shortened to the end, and
/// filtered samples reach back to it. They differ by what the tolerance of steps allows.
#[test]
fn an_open_run_is_the_whole_run_until_its_last_step() {
    const REACH: usize = 14;
    for (name, scene) in scenes() {
        let run = Run {
            rtol: Some(1e-7),
            ..run()
        };
        let whole = simulate(&scene, &run).unwrap();
        let open = Run {
            duration: Run::OPEN,
            ..run
        };
        let mut simulation = Simulation::begin(&scene, &open).unwrap();
        simulation.advance_to(DURATION / 3.0).unwrap();
        simulation.advance_to(DURATION).unwrap();
        let open = simulation.finish().unwrap();
        let last = whole.t.len() - REACH;
        for (whole, open) in whole.columns.iter().zip(&open.columns) {
            let is_off = |(a, b): (&f64, &f64)| a.to_bits() != b.to_bits();
            let first = whole.values.iter().zip(&open.values).position(is_off);
            assert_eq!(whole.values.len(), open.values.len());
            assert!(
                first.is_none_or(|first| first >= last),
                "{name}, {}: {first:?}",
                whole.name
            );
            let scale = whole
                .values
                .iter()
                .fold(0.0, |most: f64, x| most.max(x.abs()));
            for (a, b) in whole.values.iter().zip(&open.values) {
                assert!(
                    (a - b).abs() <= 1e-3 * scale,
                    "{name}, {}: {a} {b}",
                    whole.name
                );
            }
        }
    }
}

#[test]
fn point_samples_are_the_same_bits_too() {
    let run = Run {
        bandwidth: Bandwidth::Raw,
        ..run()
    };
    let scene = presets::wheel_bearing(3000.0);
    let whole = simulate(&scene, &run).unwrap();
    let pieces = in_pieces("points", &scene, &run, 3, |simulation| simulation);
    is_the_same("points", &whole, &pieces);
}

/// Through a document and back after every piece, as if each ran in a process of its own.
#[test]
fn snapshots_go_on_with_the_same_bits() {
    let through = |mut simulation: Simulation| {
        let written = simulation.snapshot().to_json();
        let read: Snapshot = Snapshot::from_json(&written).unwrap();
        let restored = Simulation::restore(&read).unwrap();
        assert_eq!(restored.time(), simulation.time());
        assert_eq!(restored.state(), simulation.state());
        restored
    };
    for (name, scene) in scenes() {
        let whole = simulate(&scene, &run()).unwrap();
        let pieces = in_pieces(name, &scene, &run(), 1, through);
        is_the_same(&format!("{name}, restored"), &whole, &pieces);
    }
}

/// A change of what has no effect: the integrator starts anew, and all bodies, also those that a run leaves out, are where they would be.
#[test]
fn a_change_without_effect_leaves_the_motion_as_it_is() {
    for (name, mut scene) in scenes() {
        scene.solver.rtol = 1e-8.into();
        let mut whole = Simulation::begin(&scene, &run()).unwrap();
        let mut changed = Simulation::begin(&scene, &run()).unwrap();
        changed.advance_to(1.7e-3).unwrap();
        changed.change(&[("name", "other".into())]).unwrap();
        for simulation in [&mut whole, &mut changed] {
            simulation.advance_to(0.9 * DURATION).unwrap();
        }
        let half = whole.state().len() / 2;
        let names = whole.model().names();
        for (i, (a, b)) in whole.state().iter().zip(changed.state()).enumerate() {
            // Places to a nanometre, angles to a millionth, speeds to what moves them so within a period of the contacts.
            let tolerance = if i < half { 1e-9 } else { 1e-3 };
            let scale = if names[i].ends_with("theta") || names[i].contains(".e") {
                1e3
            } else {
                1.0
            };
            assert!(
                (a - b).abs() < scale * tolerance + 1e-6 * a.abs(),
                "{name}, {}: {a} {b}",
                names[i]
            );
        }
    }
}

/// A load and a speed that are changed are those of a table with a step there.
#[test]
fn changes_are_steps_of_a_table() {
    let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let step = |from: f64, to: f64| {
        let times = vec![0.0, 1e-3, 1e-3, 1.0];
        let values = vec![from, from, to, to];
        TimeFunction::Profile(Profile::Table { times, values })
    };
    let mut course = scene.clone();
    course.loads.get_mut("radial").unwrap().force = step(500.0, 900.0);
    let run = Run {
        duration: 3e-3,
        rtol: Some(1e-9),
        start: Start::Rolling,
        ..Run::default()
    };
    let truth = simulate(&course, &run).unwrap();
    let truth = truth.get("outer.vy").unwrap();
    let size = truth.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    for is_compiled in [true, false] {
        let mut simulation = Simulation::begin(&scene, &run).unwrap();
        simulation.advance_to(1e-3).unwrap();
        let path = "loads.radial.force";
        if is_compiled {
            simulation.change(&[(path, 900.0.into())]).unwrap();
        } else {
            simulation.set_loads(&[(path, 900.0)]).unwrap();
        }
        assert_eq!(simulation.scene().loads["radial"].force.at(0.0), 900.0);
        simulation.advance_to(3e-3).unwrap();
        let found = simulation.finish().unwrap();
        for (a, b) in truth.iter().zip(found.get("outer.vy").unwrap()) {
            assert!((a - b).abs() < 1e-3 * size, "{a} {b} of {size}");
        }
    }
}

/// A scene with loads of both kinds in and off the plane, none of them at work yet, and a torque for the inner ring.
fn unloaded() -> Scene {
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let thrust = Load::new(RingName::Outer, [0.0, 0.0, 1.0], 0.0);
    scene.loads.insert("thrust".to_owned(), thrust);
    let about_z = Moment::new(RingName::Inner, [0.0, 0.0, 1.0], 0.0);
    scene.moments.insert("brake".to_owned(), about_z);
    scene.drive = Drive::Torque {
        value: 0.5.into(),
        initial_speed: 188.5,
    };
    scene.outer_ring.support.z = Some(Mount::Spring {
        stiffness: 1e7,
        damping: 100.0,
    });
    scene
}

/// Loads that are set push where loads of a compiled scene do: also along z, where the run had left that out, and about it.
#[test]
fn loads_that_are_set_are_loads_of_the_scene() {
    let sizes = [
        ("loads.radial.force", 550.0),
        ("loads.thrust.force", 20.0),
        ("moments.brake.moment", -1.5),
        ("drive.torque.value", 2.0),
    ];
    let run = Run {
        rtol: Some(1e-9),
        ..run()
    };
    let mut simulations = [0, 1].map(|_| Simulation::begin(&unloaded(), &run).unwrap());
    let [set, compiled] = &mut simulations;
    set.advance_to(1e-3).unwrap();
    compiled.advance_to(1e-3).unwrap();
    let rest = set.state().to_vec();
    set.set_loads(&sizes).unwrap();
    let changes = sizes.map(|(path, size)| (path, size.into()));
    compiled.change(&changes).unwrap();
    assert_eq!(set.scene(), compiled.scene());
    for simulation in [&mut *set, &mut *compiled] {
        simulation.advance_to(3e-3).unwrap();
    }
    let names = set.model().names();
    for name in ["outer.y", "outer.z", "inner.omega"] {
        let at = names.iter().position(|of| of == name).unwrap();
        let [moved, truth] = [&*set, &*compiled].map(|of| of.state()[at] - rest[at]);
        assert!(
            truth != 0.0 && (moved - truth).abs() < 1e-3 * truth.abs(),
            "{name}: {moved} {truth}"
        );
    }
}

/// Runs a scene in 20 pieces, without and with a snapshot after each, compiled anew after the tenth; `set` is called before each with its
/// end. Bits are to be the same.
fn goes_on_bit_by_bit(scene: &Scene, piece: f64, set: impl Fn(&mut Simulation, f64)) {
    let go = |takes_up: bool| {
        let mut simulation = Simulation::begin(scene, &run()).unwrap();
        for k in 1..=20 {
            let t = piece * f64::from(k);
            set(&mut simulation, t);
            simulation.advance_to(t).unwrap();
            if k == 10 {
                simulation.change(&[("friction", "none".into())]).unwrap();
            }
            if takes_up {
                let words = simulation.snapshot().to_json();
                simulation = Simulation::restore(&Snapshot::from_json(&words).unwrap()).unwrap();
            }
        }
        simulation.finish().unwrap()
    };
    let (whole, taken_up) = (go(false), go(true));
    assert_eq!(bits(&whole.columns), bits(&taken_up.columns));
    assert_eq!(whole.end_state, taken_up.end_state);
}

/// A snapshot has the loads that were set, and the tolerances of those that were compiled, also of a scene compiled anew with them.
#[test]
fn loads_that_are_set_go_on_bit_by_bit() {
    goes_on_bit_by_bit(&unloaded(), 2e-5, |simulation, t| {
        let phase = 0.3 * t / 2e-5;
        let sizes = [
            ("loads.radial.force", 500.0 + 200.0 * phase.sin()),
            ("loads.thrust.force", 50.0 * phase.cos()),
        ];
        simulation.set_loads(&sizes).unwrap();
    });
}

/// Sizes that are those before leave the motion of a run in one piece, bit by bit.
#[test]
fn the_same_loads_again_leave_the_bits() {
    let scene = presets::deep_groove_6205(500.0, 300.0, 1800.0);
    let whole = simulate(&scene, &run()).unwrap();
    let (_, pieces) = in_pieces("set again", &scene, &run(), 1, |mut simulation| {
        let same = simulation.scene().loads["radial"].force.at(0.0);
        simulation
            .set_loads(&[("loads.radial.force", same)])
            .unwrap();
        simulation
    });
    assert_eq!(whole.end_state, pieces.end_state);
}

const PUSHED: &str = "inner_ring.support.y.given";
const TILTED: &str = "inner_ring.support.tilt_x.given";

/// A bearing whose inner ring another program carries.
fn carried() -> Scene {
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let given = |place: f64| Some(Mount::given(place));
    let support = &mut scene.inner_ring.support;
    (support.x, support.y) = (given(0.0), given(-2e-5));
    support.tilt_x = given(1e-4);
    scene
}

/// Where the other program has it.
fn course(t: f64) -> [(&'static str, [f64; 2]); 2] {
    let (sin, cos) = (900.0 * t).sin_cos();
    [
        (PUSHED, [-2e-5 - 1e-5 * sin, -9e-3 * cos]),
        (TILTED, [1e-4 + 1e-4 * sin, 9e-2 * cos]),
    ]
}

/// A ring that is moved piece by piece takes the course of the spline through the same points.
#[test]
fn motions_that_are_set_are_those_of_the_scene() {
    let run = Run {
        duration: DURATION,
        settle: Some(5e-3),
        rtol: Some(1e-9),
        ..Run::default()
    };
    let times: Vec<f64> = (0..=20_u8).map(|i| 1e-4 * f64::from(i)).collect();
    let mut whole = carried();
    // From rest, as a ring does that is not moved yet.
    let rest = [course(0.0)[0].1[0], course(0.0)[1].1[0]];
    let spline = |which: usize| {
        let points = times[1..].iter().map(|t| course(*t)[which].1);
        let all: Vec<[f64; 2]> = std::iter::once([rest[which], 0.0]).chain(points).collect();
        Some(Mount::given(TimeFunction::Profile(Profile::Spline {
            times: times.clone(),
            values: all.iter().map(|point| point[0]).collect(),
            rates: all.iter().map(|point| point[1]).collect(),
        })))
    };
    (whole.inner_ring.support.y, whole.inner_ring.support.tilt_x) = (spline(0), spline(1));
    let mut truth = Simulation::begin(&whole, &run).unwrap();
    let mut moved = Simulation::begin(&carried(), &run).unwrap();
    for t in &times[1..] {
        moved.set_motions(&course(*t), *t).unwrap();
        moved.advance_to(*t).unwrap();
        truth.advance_to(*t).unwrap();
        let at = |name: &str| {
            truth
                .model()
                .names()
                .iter()
                .position(|of| of == name)
                .unwrap()
        };
        for (name, place) in [("inner.y", 0), ("inner.tilt_x", 1)] {
            let error = moved.state()[at(name)] - course(*t)[place].1[0];
            assert!(error.abs() < 1e-14, "{name} {error:e}");
        }
        for ring in [RingName::Outer, RingName::Inner] {
            let [one, other] = [&moved, &truth].map(|of| of.wrench(ring)[1]);
            assert!(
                (one - other).abs() < 1e-5 * other.abs(),
                "{t} {one} {other}"
            );
        }
    }
}

/// Snapshots have the motions that were set, also of a scene that was compiled anew while a ring moved.
#[test]
fn motions_that_are_set_go_on_bit_by_bit() {
    goes_on_bit_by_bit(&carried(), 5e-5, |simulation, t| {
        simulation.set_motions(&course(t), t).unwrap();
    });
}

/// Past the end of its course a ring goes straight on; set anew it goes on from there, and a motion of the scene replaces it.
#[test]
fn a_moved_ring_goes_straight_on() {
    let mut simulation = Simulation::begin(&carried(), &run()).unwrap();
    let at = simulation.model().names();
    let at = at.iter().position(|of| of == "inner.y").unwrap();
    simulation
        .set_motions(&[(PUSHED, [-2.2e-5, -2e-3])], 1e-3)
        .unwrap();
    simulation.advance_to(2e-3).unwrap();
    assert!((simulation.state()[at] - -2.4e-5).abs() < 1e-14);
    simulation.change(&[(PUSHED, (-3e-5).into())]).unwrap();
    assert_eq!(simulation.state()[at], -3e-5);
    simulation.advance_to(2.1e-3).unwrap();
    assert!((simulation.state()[at] - -3e-5).abs() < 1e-14);
}

#[test]
fn motions_that_cannot_be_set_are_refused_by_name() {
    let mut simulation = Simulation::begin(&carried(), &run()).unwrap();
    simulation.advance_to(1e-3).unwrap();
    let before = simulation.scene().clone();
    for (path, [place, speed], until, named) in [
        (
            "inner_ring.support.z.given",
            [0.0, 0.0],
            2e-3,
            "inner_ring.support.z.given",
        ),
        (
            "outer_ring.support.x",
            [0.0, 0.0],
            2e-3,
            "outer_ring.support.x",
        ),
        ("loads.radial.force", [0.0, 0.0], 2e-3, "loads.radial.force"),
        (
            PUSHED,
            [0.2, 0.0],
            2e-3,
            "inner_ring.support.y.given.spline.values[1]",
        ),
        (
            PUSHED,
            [0.0, f64::NAN],
            2e-3,
            "inner_ring.support.y.given.spline.rates[1]",
        ),
        (PUSHED, [0.0, 0.0], 1e-3, "until"),
        (PUSHED, [0.0, 0.0], f64::INFINITY, "until"),
    ] {
        let motions = [(TILTED, [0.0, 0.0]), (path, [place, speed])];
        let refused = simulation.set_motions(&motions, until);
        let Err(Error::Scene { path: found, .. } | Error::Argument { path: found, .. }) = refused
        else {
            panic!("{path}: {refused:?}")
        };
        assert_eq!(found, named);
        assert_eq!(simulation.scene(), &before);
    }
    let refused = simulation.set_loads(&[(PUSHED, 0.0)]);
    assert!(matches!(refused, Err(Error::Scene { path, .. }) if path == PUSHED));
    let refused = simulation.change(&[("inner_ring.support.y", "fixed".into())]);
    assert!(matches!(refused, Err(Error::Argument { path, .. }) if path == "changes"));
}

#[test]
fn loads_that_cannot_be_set_are_refused_by_name() {
    let mut scene = unloaded();
    scene.loads.get_mut("thrust").unwrap().force = TimeFunction::Profile(Profile::Ramp {
        from: 0.0,
        to: 1.0,
        start: 0.0,
        end: 1.0,
    });
    let mut simulation = Simulation::begin(&scene, &run()).unwrap();
    let before = simulation.scene().clone();
    for (path, size) in [
        ("loads.other.force", 1.0),
        ("loads.thrust.force", 1.0),
        ("rows[0].clearance", 1e-6),
        ("drive.speed", 100.0),
        ("loads.radial.force", f64::NAN),
        ("loads.radial.force", 1e13),
    ] {
        let refused = simulation.set_loads(&[("moments.brake.moment", 1.0), (path, size)]);
        let Err(Error::Scene { path: named, .. }) = refused else {
            panic!("{path}: {refused:?}")
        };
        assert_eq!(named, path);
        assert_eq!(simulation.scene(), &before);
    }
}

#[test]
fn what_cannot_be_changed_or_reached_is_refused_by_name() {
    let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let mut simulation = Simulation::begin(&scene, &run()).unwrap();
    simulation.advance_to(1e-3).unwrap();
    let before = simulation.state().to_vec();
    let changes: [(&str, serde_json::Value, &str); 5] = [
        ("rows[0].ball_count", 8.into(), "changes"),
        ("outer_ring.support.y", "fixed".into(), "changes"),
        ("spin", "free".into(), "changes"),
        ("loads.radial.force", "heavy".into(), "loads.radial.force"),
        ("solver.rtol", 1.0.into(), "solver.rtol"),
    ];
    for (path, value, field) in changes {
        let refused = simulation.change(&[(path, value)]);
        let Err(Error::Scene { path: named, .. } | Error::Argument { path: named, .. }) = refused
        else {
            panic!("{path}: {refused:?}")
        };
        assert_eq!(named, field);
    }
    for time in [0.5e-3, 2.0 * DURATION, f64::NAN] {
        let refused = simulation.advance_to(time);
        assert!(
            matches!(&refused, Err(Error::Argument { path, .. }) if path == "t"),
            "{refused:?}"
        );
    }
    assert_eq!(simulation.state(), before);
    let words = simulation.snapshot().to_json();
    let wrong = words.replacen("\"trajectory\":[", "\"trajectory\":[7,", 1);
    let refused = Snapshot::from_json(&wrong).and_then(|of| Simulation::restore(&of));
    assert!(matches!(refused, Err(Error::Snapshot { path, .. }) if path == "snapshot"));
}
