//! Options of the integrator.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The method of integration; measured against each other in `benches/README.md`.
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
    /// Bogacki–Shampine 3(2), explicit.
    BogackiShampine,
    /// Tsitouras 5(4), explicit.
    Tsitouras,
    /// Verner 6(5), explicit; a dense output of order three only.
    Verner,
    /// The classical Runge–Kutta method with fixed steps, each the largest allowed.
    #[serde(rename = "runge-kutta-4")]
    RungeKutta4,
    /// Velocity Verlet with fixed steps, each the largest allowed.
    VelocityVerlet,
    /// Kennedy–Carpenter 4(3), explicit in positions and implicit in velocities: its steps do not depend on how
    /// stiff friction is. For slip speeds below about 0.01 m/s.
    ImplicitFriction,
    /// Dormand–Prince or the implicit one, whichever the stiffness of friction asks for, at any time of the run.
    Auto,
}

impl Method {
    /// Whether it has no error estimate and so wants a step.
    pub(crate) fn is_fixed(self) -> bool {
        matches!(self, Self::RungeKutta4 | Self::VelocityVerlet)
    }
}

/// As documents name it.
///
/// ```
/// assert_eq!(ballrace::scene::Method::RungeKutta4.to_string(), "runge-kutta-4");
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
    /// Largest step \[s\]; absent: no limit but the one below.
    pub max_step: Option<f64>,
    /// Whether the step is also kept below what the method's stability and accuracy ask for: a share of the period
    /// of the highest contact frequency, less for methods of low order where contacts ring undamped; for fixed steps
    /// also a share of the time in which friction and damping act. On by default: at loose tolerances a run otherwise
    /// reports success with accelerations wrong by 30 % and more.
    pub frequency_cap: bool,
    /// Whether a run leaves out what does not change the motion: directions without forces, mirror images, slices
    /// where a closed form says the same. Default true.
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
