//! Options of the integrator.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::numbers::{BoundedNumber, POSITIVE};

/// The method of integration.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Method {
    /// Adams' predictor–corrector of order four, linearly implicit in friction: the default. One evaluation a step; see
    /// [`Adams`](crate::integrate::Adams).
    #[default]
    Adams,
    /// Dormand–Prince 5(4), explicit.
    DormandPrince,
    /// Verner 6(5), explicit; a dense output of order three only.
    Verner,
}

/// Name of the method as documents have it.
///
/// ```
/// assert_eq!(ballrace::scene::Method::DormandPrince.to_string(), "dormand-prince");
/// ```
impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// How the equations are integrated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct Solver {
    /// The method. Default `adams`.
    pub method: Method,
    /// Relative tolerance, 1e-12 to 1e-1; each kind of state has its scale from the scene. Default 1e-7.
    pub rtol: f64,
    /// First step \[s\]; absent: Hairer's estimate.
    pub first_step: Option<f64>,
    /// Largest step \[s\]; absent: no limit other than `frequency_cap`.
    pub max_step: Option<f64>,
    /// Whether the step is also kept below a share of the period of the highest contact frequency that the method's stability and
    /// accuracy require, smaller where contacts vibrate undamped. Default true: without it, runs with loose tolerances
    /// succeed with accelerations wrong by 30 % and more.
    pub frequency_cap: bool,
    /// Whether a run leaves out what does not change the motion: directions without forces, mirror images, slices
    /// where a closed form gives the same force. Default true.
    pub reduce: bool,
}

impl Default for Solver {
    fn default() -> Self {
        Self {
            method: Method::default(),
            rtol: 1e-7,
            first_step: None,
            max_step: None,
            frequency_cap: true,
            reduce: true,
        }
    }
}

impl Solver {
    /// Numbers of the solver.
    pub(super) fn numbers(&self) -> [BoundedNumber; 3] {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            method: _,
            rtol,
            first_step,
            max_step,
            frequency_cap: _,
            reduce: _,
        } = *self;
        [
            BoundedNumber::new("rtol", rtol, 1e-12..=1e-1, ""),
            BoundedNumber::new("first_step", first_step, POSITIVE, "s"),
            BoundedNumber::new("max_step", max_step, POSITIVE, "s"),
        ]
    }
}
