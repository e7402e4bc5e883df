//! Many cases on all cores; one that cannot be computed costs the others nothing: `cargo run --release --example campaign`.

use std::error::Error;
use std::ops::ControlFlow;

use ballrace::{Case, FeatureOptions, Run, campaign, scene::presets};

/// Prints a feature of each case, or why there is none.
pub fn main() -> Result<(), Box<dyn Error>> {
    let run = Run {
        duration: 2e-3,
        ..Run::default()
    };
    let axial = [-3000.0, 0.0, f64::NAN, 3000.0];
    let cases = axial.map(|load| Case::new(presets::wheel_bearing(load), run.clone()));
    let options = FeatureOptions::default();
    let outcomes = campaign(cases, 2, &options, &mut |_| ControlFlow::Continue(()))?;
    let mut failed = 0;
    for (load, outcome) in axial.iter().zip(outcomes) {
        match outcome.result {
            Ok(done) => {
                let rms = done.features.iter().find(|f| f.name == "outer.ay.rms");
                println!("{load:6} N: {:.2?} m/s²", rms.and_then(|f| f.value));
            }
            Err(error) => {
                failed += 1;
                println!("{load:6} N: {error}");
            }
        }
    }
    assert_eq!(failed, 1);
    Ok(())
}
