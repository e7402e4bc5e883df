//! Benchmarks, one a layer: the power, a contact, a right-hand side by nodes, slices, balls, threads,
//! instruction set and rings that tilt, the integrator alone, a run, the static solve. `cargo bench -p ballrace-benches --bench layers`.

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Instant;

use ballrace::InstructionSet;
use ballrace::bindings::Pool;
use ballrace::compile;
use ballrace::dynamics::Dynamics;
use ballrace::inspect;
use ballrace::integrate::{DORMAND_PRINCE, Options, System, Tolerance, integrate};
use ballrace::scene::{
    Defect, Friction, Lubricant, Mount, NormalLaw, Patch, Pit, Scene, Slices, Surface,
    TimeFunction, presets,
};
use ballrace::{Model, Race, Run, Start, equilibrium, load_distribution, simulate, start};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

fn wheel(law: NormalLaw, slices: Slices) -> Scene {
    let mut scene = presets::wheel_bearing(3000.0);
    (scene.contact.law, scene.contact.slices) = (law, slices);
    scene
}

/// Two rows of so many balls of the wheel bearing, on a pitch circle as long and under a load as large as they need.
fn ring_of(balls: usize, slices: Slices) -> Scene {
    let mut scene = wheel(NormalLaw::iso16281(), slices);
    let share = balls as f64 / 13.0;
    for row in &mut scene.rows {
        (row.ball_count, row.pitch_diameter) = (balls, row.pitch_diameter * share);
    }
    for load in scene.loads.values_mut() {
        if let TimeFunction::Constant(force) = &mut load.force {
            *force *= share;
        }
    }
    scene
}

/// Model and state of a bearing in equilibrium.
fn loaded(scene: &Scene) -> (Model, Vec<f64>) {
    let model = compile(scene).unwrap();
    let y = start(&model, &Start::Equilibrium).unwrap();
    (model, y)
}

fn contact(c: &mut Criterion) {
    let mut group = c.benchmark_group("contact with its sums, one by one");
    for slices in [Slices::Fitted(6), Slices::Fixed(50), Slices::Fixed(400)] {
        let (model, y) = loaded(&wheel(NormalLaw::iso16281(), slices));
        // Ball 1 of row 0 carries most.
        group.bench_function(format!("{slices:?}"), |b| {
            b.iter(|| inspect::contact(&model, black_box(&y), 1, Race::Outer).unwrap());
        });
    }
    // Its ball 0 stands over the pit.
    let whole = presets::deep_groove_6205(500.0, 0.0, 1797.0);
    let mut pitted = whole.clone();
    let pit = Defect::of(
        Pit::of_width(0.178e-3),
        Surface::OuterRace,
        whole.rows[0].start_angle,
    );
    pitted.defects.insert("pit".to_owned(), pit);
    for (name, scene) in [("6205", whole), ("6205 at a pit", pitted)] {
        let (model, y) = loaded(&scene);
        group.bench_function(name, |b| {
            b.iter(|| inspect::contact(&model, black_box(&y), 0, Race::Outer).unwrap());
        });
    }
    group.finish();
}

fn right_hand_side(c: &mut Criterion) {
    let iso = NormalLaw::iso16281;
    let mut group = c.benchmark_group("rhs");
    let mut add = |id: BenchmarkId, model: &Model, y: &[f64]| {
        let mut dynamics = Dynamics::new(model);
        let mut dy = vec![0.0; model.dim()];
        group.bench_function(id, |b| b.iter(|| dynamics.rhs(0.0, black_box(y), &mut dy)));
    };
    for instructions in InstructionSet::available() {
        let (model, y) = loaded(&wheel(iso(), Slices::Fitted(6)));
        add(
            BenchmarkId::new("instructions", instructions),
            &model.with_instructions(instructions),
            &y,
        );
    }
    for m in [4, 6, 8, 12, 16, 24] {
        let (model, y) = loaded(&wheel(iso(), Slices::Fitted(m)));
        add(BenchmarkId::new("nodes", m), &model, &y);
    }
    for n in [50, 100, 200, 400] {
        let (model, y) = loaded(&wheel(iso(), Slices::Fixed(n)));
        add(BenchmarkId::new("slices", n), &model, &y);
    }
    for balls in [13, 26, 60, 120] {
        let (model, y) = loaded(&ring_of(balls, Slices::Fitted(6)));
        add(BenchmarkId::new("balls a row", balls), &model, &y);
    }
    let (model, y) = loaded(&wheel(NormalLaw::Hertz, Slices::Fitted(6)));
    add(BenchmarkId::new("law", "hertz"), &model, &y);
    let (model, y) = loaded(&presets::deep_groove_6205(500.0, 0.0, 1800.0));
    add(BenchmarkId::new("bearing", "6205"), &model, &y);
    group.finish();
}

/// A parallel bearing's state with one ring free to tilt, which does not yet.
fn upright(y: &[f64]) -> Vec<f64> {
    let (places, speeds) = y.split_at(y.len() / 2);
    [places, &[0.0; 2], speeds, &[0.0; 2]].concat()
}

/// A parallel bearing's state turned as a whole by 1 mrad about x, for rings free to tilt: the same balls touch alike.
fn turned(parallel: &Model, y: &[f64], tilted: &Model) -> Vec<f64> {
    const TILT: f64 = 1e-3;
    let (half, all) = (y.len() / 2, tilted.dim() / 2);
    let cos = (1.0 - TILT * TILT).sqrt();
    let mut found = vec![0.0; 2 * all];
    for (from, to) in [(&y[..half], 0), (&y[half..], all)] {
        found[to..to + half].copy_from_slice(from);
        for body in found[to..to + half].chunks_exact_mut(4) {
            let [y, z] = [body[1], body[2]];
            (body[1], body[2]) = (y * cos - z * TILT, y * TILT + z * cos);
        }
    }
    assert_eq!(tilted.names()[half], "outer.tilt_x");
    assert_eq!((all - half, parallel.dim()), (4, 2 * half));
    (found[half], found[half + 2]) = (TILT, TILT);
    found
}

/// Parallel rings against the same ones free to tilt.
fn tilted_rings(c: &mut Criterion) {
    let mut group = c.benchmark_group("rhs of tilted rings");
    let wheel = || presets::wheel_bearing(3000.0);
    let mut oiled = wheel();
    let mut oil = Lubricant::named("vg68", 328.15);
    // Of rings that nothing keeps from tilting there is no equilibrium to take it from.
    oil.reference_load = Some(1000.0);
    oiled.lubricant = Some(oil);
    let mut smooth = wheel();
    smooth.friction = Friction::None;
    for (name, mut scene) in [
        ("wheel bearing", wheel()),
        ("6205", presets::deep_groove_6205(500.0, 300.0, 1800.0)),
        ("wheel bearing in oil", oiled),
        ("wheel bearing without friction", smooth),
        ("wheel bearing, Hertz", {
            let mut scene = wheel();
            scene.contact.law = NormalLaw::Hertz;
            scene
        }),
    ] {
        let (parallel, y) = loaded(&scene);
        let free = || Some(Mount::Free);
        let inner = &mut scene.inner_ring.support;
        (inner.tilt_x, inner.tilt_y) = (free(), free());
        let one = compile(&scene).unwrap();
        let outer = &mut scene.outer_ring.support;
        (outer.tilt_x, outer.tilt_y) = (free(), free());
        let both = compile(&scene).unwrap();
        let (upright, tilted) = (upright(&y), turned(&parallel, &y, &both));
        for instructions in InstructionSet::available() {
            for (kind, model, y) in [
                ("parallel", &parallel, &y),
                ("inner free to tilt", &one, &upright),
                ("tilted", &both, &tilted),
            ] {
                let model = model.clone().with_instructions(instructions);
                let mut dynamics = Dynamics::new(&model);
                let mut dy = vec![0.0; model.dim()];
                group.bench_function(format!("{name}, {instructions}, {kind}"), |b| {
                    b.iter(|| dynamics.rhs(0.0, black_box(y), &mut dy));
                });
            }
        }
    }
    group.finish();
}

/// Serial against two threads, called from inside the pool as a run does: the break-even.
fn threads(c: &mut Criterion) {
    let pool = Pool::of(2).unwrap().unwrap();
    let mut group = c.benchmark_group("threads");
    for (balls, slices) in [
        (13, Slices::Fitted(6)),
        (13, Slices::Fixed(100)),
        (13, Slices::Fixed(400)),
        (60, Slices::Fitted(6)),
        (60, Slices::Fixed(400)),
    ] {
        let (model, y) = loaded(&ring_of(balls, slices));
        let mut dy = vec![0.0; model.dim()];
        let name = format!("2 x {balls} balls, {slices:?}");
        let mut serial = Dynamics::new(&model);
        group.bench_function(format!("{name}, 1"), |b| {
            b.iter(|| serial.rhs(0.0, black_box(&y), &mut dy));
        });
        let mut shared = Dynamics::new(&model).shared(pool.clone());
        group.bench_function(format!("{name}, 2"), |b| {
            b.iter_custom(|count| {
                pool.inside(&mut |_| ControlFlow::Continue(()), |_| {
                    let begun = Instant::now();
                    for _ in 0..count {
                        shared.rhs(0.0, black_box(&y), &mut dy);
                    }
                    begun.elapsed()
                })
            });
        });
    }
    group.finish();
}

/// Springs with as many states as the wheel bearing has, and next to nothing to evaluate.
struct Springs;

impl System for Springs {
    fn dim(&self) -> usize {
        224
    }

    fn rhs(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        let (q, v) = y.split_at(112);
        dy[..112].copy_from_slice(v);
        for (acceleration, q) in dy[112..].iter_mut().zip(q) {
            *acceleration = -1e9 * q;
        }
    }
}

fn integrator(c: &mut Criterion) {
    let group: Vec<usize> = (0..224).map(|i| i % 112 / 4).collect();
    let tolerance = Tolerance::new(0.0, vec![1e-3; 224], &[false; 224], group).unwrap();
    let options = Options {
        max_step: 6.8e-6,
        ..Options::default()
    };
    c.bench_function("integrator alone, 1000 steps", |b| {
        b.iter(|| {
            let span = (0.0, 6.8e-3);
            integrate(
                &mut Springs,
                &DORMAND_PRINCE,
                span,
                &[1e-6; 224],
                &tolerance,
                &options,
                &mut (),
            )
        });
    });
}

fn run(c: &mut Criterion) {
    let mut group = c.benchmark_group("run");
    group.sample_size(10);
    let scene = presets::wheel_bearing(3000.0);
    for (name, rtol, accuracy) in [("default", None, None), ("accuracy 1 %", None, Some(1e-2))] {
        let run = Run {
            duration: 10e-3,
            threads: 1,
            rtol,
            accuracy,
            settle: Some(0.0),
            ..Run::default()
        };
        group.bench_function(format!("10 ms of the wheel bearing, {name}"), |b| {
            b.iter(|| simulate(&scene, &run).unwrap());
        });
    }
    group.finish();
}

/// Scene compiled and solved at rest.
/// A millisecond of a spalled 6205, and what a step of two of its balls by themselves would take of it: the contacts of a
/// bearing of three, by eights and with one over the spall. A matrix of their own would come on top.
fn sub_steps(c: &mut Criterion) {
    let mut group = c.benchmark_group("sub-steps");
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1797.0);
    let settings = Run {
        duration: 1e-3,
        settle: Some(0.0),
        threads: 1,
        ..Run::default()
    };
    let spall = Patch::of_width(0.5e-3).length(3e-3).edge_radius(30e-6);
    let spall = Defect::of(spall, Surface::OuterRace, scene.rows[0].start_angle);
    scene.defects.insert("spall".to_owned(), spall);
    let steps = simulate(&scene, &settings).unwrap().stats.nfev;
    group.bench_function(format!("a run of {steps} evaluations"), |b| {
        b.iter(|| simulate(black_box(&scene), &settings).unwrap());
    });
    scene.rows[0].ball_count = 3;
    let mut whole = scene.clone();
    whole.defects.clear();
    for (name, scene) in [("three balls", whole), ("one over the spall", scene)] {
        let model = compile(&scene).unwrap();
        let y = start(&model, &Start::Rolling).unwrap();
        let mut dynamics = Dynamics::new(&model);
        let mut dy = vec![0.0; model.dim()];
        group.bench_function(name, |b| {
            b.iter(|| dynamics.rhs(0.0, black_box(&y), &mut dy));
        });
    }
    group.finish();
}

fn statics(c: &mut Criterion) {
    let mut group = c.benchmark_group("statics");
    for (name, scene) in [
        ("6205", presets::deep_groove_6205(500.0, 0.0, 1800.0)),
        ("wheel bearing", presets::wheel_bearing(3000.0)),
    ] {
        group.bench_function(format!("model, {name}"), |b| {
            b.iter(|| compile(black_box(&scene)).unwrap());
        });
        group.bench_function(format!("equilibrium, {name}"), |b| {
            b.iter(|| equilibrium(black_box(&scene)).unwrap());
        });
        group.bench_function(format!("load distribution of 16 positions, {name}"), |b| {
            b.iter(|| load_distribution(black_box(&scene), 16).unwrap());
        });
    }
    group.finish();
}

criterion_group!(
    layers,
    contact,
    right_hand_side,
    tilted_rings,
    threads,
    integrator,
    run,
    sub_steps,
    statics
);
criterion_main!(layers);
