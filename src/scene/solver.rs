//! Options of the integrator.

use serde::{Deserialize, Serialize};

/// How the equations are integrated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Solver {
    /// Relative tolerance, 1e-12 to 1e-1; each kind of state has its scale from the scene. Default 1e-6.
    pub rtol: f64,
    /// First step \[s\]; absent: Hairer's estimate.
    pub first_step: Option<f64>,
    /// Largest step \[s\]; absent: no limit but the one below.
    pub max_step: Option<f64>,
    /// Whether the step is also kept below a share of the period of the highest contact frequency. On by
    /// default: at loose tolerances a run otherwise reports success with accelerations wrong by 30 % and more.
    pub frequency_cap: bool,
}

impl Default for Solver {
    fn default() -> Self {
        Self {
            rtol: 1e-6,
            first_step: None,
            max_step: None,
            frequency_cap: true,
        }
    }
}
