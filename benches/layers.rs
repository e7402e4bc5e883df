//! One benchmark a layer: a contact, a right-hand side, a run. `cargo bench`.

use std::hint::black_box;
use std::ops::ControlFlow;

use ballrace::dynamics::Dynamics;
use ballrace::integrate::System;
use ballrace::scene::{NormalLaw, Slices, presets};
use ballrace::{Model, Run, Start, simulate, start};
use criterion::{Criterion, criterion_group, criterion_main};

fn layers(c: &mut Criterion) {
    let cases = [
        ("iso 50 slices", NormalLaw::default(), Slices::Fixed(50)),
        ("iso 6 nodes", NormalLaw::default(), Slices::Fitted(6)),
        ("iso 400 slices", NormalLaw::default(), Slices::Fixed(400)),
        ("hertz 6 nodes", NormalLaw::Hertz, Slices::Fitted(6)),
    ];
    for (name, law, slices) in cases {
        let mut scene = presets::wheel_bearing(3000.0);
        scene.contact.law = law;
        scene.contact.slices = slices;
        let model = Model::new(&scene).unwrap();
        let y = start(&model, &Start::Equilibrium).unwrap();
        // Ball 1 of row 0 carries most.
        c.bench_function(&format!("contact, {name}"), |b| {
            b.iter(|| model.contact(black_box(&y), 1, 0));
        });
        let mut dynamics = Dynamics::new(&model);
        let mut dy = vec![0.0; model.dim()];
        c.bench_function(&format!("rhs wheel bearing, {name}"), |b| {
            b.iter(|| dynamics.rhs(0.0, black_box(&y), &mut dy));
        });
    }
    let scene = presets::wheel_bearing(3000.0);
    let run = Run {
        duration: 2e-3,
        threads: 1,
        ..Run::default()
    };
    let mut group = c.benchmark_group("run");
    group.sample_size(10);
    group.bench_function("2 ms of the wheel bearing", |b| {
        b.iter(|| simulate(&scene, &run, &mut |_| ControlFlow::Continue(())).unwrap());
    });
    group.finish();
}

criterion_group!(benches, layers);
criterion_main!(benches);
