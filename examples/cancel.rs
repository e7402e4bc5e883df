//! A run that its program stops: `cargo run --release --example cancel`.

use std::error::Error;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use ballrace::{Run, scene::presets, simulate_with_progress};

/// Gives a minute of bearing a fifth of a second.
pub fn main() -> Result<(), Box<dyn Error>> {
    let run = Run {
        duration: 60.0,
        fs: 5e3,
        ..Run::default()
    };
    let end = Instant::now() + Duration::from_millis(200);
    let mut watch = |_share: f64| {
        if Instant::now() < end {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    };
    match simulate_with_progress(&presets::wheel_bearing(3000.0), &run, &mut watch) {
        Err(ballrace::Error::Interrupted { time, .. }) => println!("stopped at {time:.4} s"),
        other => return Err(format!("not interrupted: {:?}", other.map(|out| out.stats)).into()),
    }
    Ok(())
}
