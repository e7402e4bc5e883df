//! Options of the integrator.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::numbers::{BoundedNumber, POSITIVE};
use super::word;

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

/// Relative tolerance of the steps: a number, or `"band"`, what the band of the record asks for.
///
/// ```
/// use ballrace::scene::RelativeTolerance;
/// assert_eq!(RelativeTolerance::from(1e-8).or_exact(), 1e-8);
/// assert_eq!(RelativeTolerance::Band.or_exact(), 1e-7);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = r#"a number from 1e-12 to 1e-1, or "band""#)]
#[non_exhaustive]
pub enum RelativeTolerance {
    /// 1e-4 where a record is filtered to 20.5 kHz and less and the scene was measured to bear it, else 1e-7.
    #[default]
    #[serde(with = "word::band")]
    Band,
    /// This one, for any record.
    Of(f64),
}

impl RelativeTolerance {
    /// The tolerance that resolves accelerations at all frequencies.
    pub const EXACT: f64 = 1e-7;

    /// The number, or that for a record of all frequencies.
    pub fn or_exact(self) -> f64 {
        match self {
            Self::Band => Self::EXACT,
            Self::Of(rtol) => rtol,
        }
    }

    /// The tolerance of a document that says nothing of it, as long as there were no others.
    fn unsaid() -> Self {
        Self::Of(Self::EXACT)
    }
}

impl From<f64> for RelativeTolerance {
    fn from(rtol: f64) -> Self {
        Self::Of(rtol)
    }
}

/// How the equations are integrated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct Solver {
    /// The method. Default `adams`.
    pub method: Method,
    /// Relative tolerance, 1e-12 to 1e-1, each kind of state having its scale from the scene; or that which the band of the
    /// record asks for. Default the latter; of a document that does not say it, 1e-7.
    #[serde(default = "RelativeTolerance::unsaid")]
    pub rtol: RelativeTolerance,
    /// First step \[s\]; absent: Hairer's estimate.
    pub first_step: Option<f64>,
    /// Largest step \[s\]; absent: no limit other than `frequency_cap`.
    pub max_step: Option<f64>,
    /// Whether the step is also kept below a share of the period of the highest contact frequency that the method's stability and
    /// accuracy require, smaller where contacts vibrate undamped. Default true: without it, runs with loose tolerances
    /// succeed with accelerations wrong by 30 % and more.
    pub frequency_cap: bool,
    /// Whether a run leaves out what does not change the motion: directions without forces and mirror images.
    /// Default true.
    pub reduce: bool,
}

impl Solver {
    /// The options of a document that says nothing of them.
    pub(super) fn unsaid() -> Self {
        Self {
            rtol: RelativeTolerance::unsaid(),
            ..Self::default()
        }
    }

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
            BoundedNumber::new("rtol", rtol.or_exact(), 1e-12..=1e-1, ""),
            BoundedNumber::new("first_step", first_step, POSITIVE, "s"),
            BoundedNumber::new("max_step", max_step, POSITIVE, "s"),
        ]
    }
}

impl Default for Solver {
    fn default() -> Self {
        Self {
            method: Method::default(),
            rtol: RelativeTolerance::default(),
            first_step: None,
            max_step: None,
            frequency_cap: true,
            reduce: true,
        }
    }
}
