//! The integrator on equations of one's own: `cargo run --release --example own_ode`.

use std::error::Error;
use std::ops::ControlFlow;

use ballrace::integrate::{
    DORMAND_PRINCE, DenseStep, Options, StepStatistics, System, Tolerance, integrate,
};

/// A mass on a spring, x″ = −ω² x.
struct Oscillator {
    omega: f64, // rad/s
}

impl System for Oscillator {
    fn dim(&self) -> usize {
        2
    }

    fn rhs(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = y[1];
        dy[1] = -self.omega * self.omega * y[0];
    }
}

/// Samples the place every tenth of a second from the dense output, and compares it with cos ωt.
pub fn main() -> Result<(), Box<dyn Error>> {
    let omega = 3.0;
    let tolerance = Tolerance::uniform(2, 1e-8, 1e-10)?;
    let (mut next, mut worst) = (0.0, 0.0_f64);
    let mut y = [0.0; 2];
    let mut sample = |_: &mut Oscillator, step: &DenseStep<'_>, _: &StepStatistics| {
        while next <= step.t1() {
            step.interpolate(next, &mut y);
            worst = worst.max((y[0] - (omega * next).cos()).abs());
            next += 0.1;
        }
        ControlFlow::Continue(())
    };
    let end = integrate(
        &mut Oscillator { omega },
        &DORMAND_PRINCE,
        (0.0, 10.0),
        &[1.0, 0.0],
        &tolerance,
        &Options::default(),
        &mut sample,
    )?;
    println!("{} steps, largest error {worst:.1e}", end.stats.accepted);
    assert!(worst < 1e-5);
    Ok(())
}
