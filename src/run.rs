//! What a run is asked for.

use crate::scene::Method;
use crate::signals::Bandwidth;
use crate::start::Start;

/// What to run.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Simulated time \[s\].
    pub duration: f64,
    /// Sampling rate \[Hz\].
    pub fs: f64,
    /// How it begins.
    pub start: Start,
    /// Relative tolerance; absent: the scene's.
    pub rtol: Option<f64>,
    /// Relative error of accelerations to stay below, 1e-4 to 1e-1: chooses nodes, tolerance and step cap in
    /// place of the scene's, by pilot runs of the first 3 ms; absent: the scene's. See [`crate::Accuracy`].
    pub accuracy: Option<f64>,
    /// Method; absent: the scene's.
    pub method: Option<Method>,
    /// Threads that share the balls of one evaluation; 0: as many as pay. The bits are the same for any.
    pub threads: usize,
    /// Whether signals are filtered before they are sampled.
    pub bandwidth: Bandwidth,
    /// Time before t = 0 in which what is left of the start dies down \[s\]; absent: as long as the scene needs from
    /// equilibrium, 0 from any other start. Loads and drive are then as at t = 0, and rings and cage are wound back, so
    /// that at t = 0 they stand where the scene says but for what the balls have slipped. From a given state nothing is
    /// wound back: that state is the one before.
    pub settle: Option<f64>,
    /// Wall time that the run may take \[s\], looked at about every 20 ms; absent: any. What it ends depends on the
    /// machine, what finishes within it does not.
    pub time_limit: Option<f64>,
    /// Steps that the run may take, accepted and rejected ones; absent: any. Settling, and pilot runs for an accuracy, have
    /// as many each.
    pub max_steps: Option<usize>,
}

impl Default for Run {
    /// 0.1 s at 50 kHz from equilibrium.
    fn default() -> Self {
        Self {
            duration: 0.1,
            fs: 50e3,
            start: Start::Equilibrium,
            rtol: None,
            accuracy: None,
            method: None,
            threads: 0,
            bandwidth: Bandwidth::Auto,
            settle: None,
            time_limit: None,
            max_steps: None,
        }
    }
}
