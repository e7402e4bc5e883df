//! A thousand right-hand sides of the faulted wheel bearing and nothing else, to be counted by a profiler:
//! `BALLRACE_SIMD=x86-64-v3 valgrind --tool=callgrind $(cargo bench -p ballrace-benches --bench profile --no-run 2>&1 | sed 's/.*(\(.*\))/\1/')`.

use std::hint::black_box;

use ballrace::compile;
use ballrace::dynamics::Dynamics;
use ballrace::integrate::System;
use ballrace::scene::presets;
use ballrace::{Start, start};

fn main() {
    let model = compile(&presets::wheel_bearing(3000.0)).unwrap();
    // Nothing but the evaluations should be counted: this start costs little.
    let y = start(&model, &Start::Equilibrium).unwrap();
    let mut dynamics = Dynamics::new(&model);
    let mut dy = vec![0.0; model.dim()];
    for _ in 0..1000 {
        dynamics.rhs(0.0, black_box(&y), &mut dy);
    }
    black_box(&dy);
}
