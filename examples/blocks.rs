//! A record that is never in memory as a whole: `cargo run --release --example blocks`.

use std::error::Error;
use std::ops::ControlFlow::Continue;

use ballrace::{Block, Run, scene::presets, simulate_into};

/// Counts samples and finds the peak of an acceleration, block by block.
pub fn main() -> Result<(), Box<dyn Error>> {
    let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let run = Run {
        duration: 5e-3,
        ..Run::default()
    };
    let (mut samples, mut peak) = (0, 0.0_f64);
    let mut sink = |block: Block| {
        samples += block.t.len();
        for column in block.columns.iter().filter(|c| c.name == "outer.ay") {
            peak = column.values.iter().fold(peak, |peak, a| peak.max(a.abs()));
        }
        Continue(())
    };
    let rest = simulate_into(&scene, &run, &mut sink, &mut |_| Continue(()))?;
    println!(
        "{samples} samples, peak {peak:.2} m/s², {} steps",
        rest.stats.accepted
    );
    assert_eq!((samples, rest.t.len()), (250, 0));
    Ok(())
}
