//! How stiff a bearing is where it stands.

use serde::Serialize;

use super::unknowns::{OF_RINGS, at};
use super::{Equilibrium, compile, solve};
use crate::error::Result;
use crate::model::{Dof, Race};
use crate::scene::Scene;

/// Tangent stiffness of a bearing at its static equilibrium, in the frame of the scene (z along the axis).
///
/// Entry (i, j) is the force \[N\] that has to be added along i for a metre along j, in the limit of small moves:
/// positive on the diagonal. The balls follow the rings, each free along its radius and along z at the angle where
/// the cage holds it. Supports and gravity are no part of it; damping and friction neither.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Stiffness {
    /// Inner ring against a held outer ring: forces and moves of the inner ring along x, y, z \[N/m\].
    pub inner: [[f64; 3]; 3],
    /// Both rings: x, y, z of the outer, then of the inner ring \[N/m\].
    pub rings: [[f64; OF_RINGS]; OF_RINGS],
    /// Where the bearing stands.
    pub equilibrium: Equilibrium,
}

/// The tangent stiffness at the static equilibrium.
///
/// Every ball is condensed to what it does to the rings, K_rr − K_rb K_bb⁻¹ K_br, and the sum made symmetric: the
/// elastic forces derive from a potential as far as the nodes of a contact are exact.
///
/// ```
/// use ballrace::scene::presets;
/// let found = ballrace::stiffness(&presets::deep_groove_6205(500.0, 0.0, 1800.0)).unwrap();
/// // Loaded along −y, and stiffest there; much softer along the axis.
/// let [x, y, z] = [0, 1, 2].map(|i| found.inner[i][i]);
/// assert!(y > x && x > z && z > 1e6);
/// ```
///
/// # Errors
/// As [`super::equilibrium()`].
pub fn stiffness(scene: &Scene) -> Result<Stiffness> {
    let model = compile(scene)?;
    let solved = solve(&model)?;
    let bearing = &solved.bearing;
    Ok(Stiffness {
        inner: Dof::TRANSLATIONS.map(|i| {
            let inner = |dof| at(Race::Inner, dof);
            Dof::TRANSLATIONS.map(|j| bearing[(inner(i), inner(j))])
        }),
        rings: std::array::from_fn(|i| std::array::from_fn(|j| bearing[(i, j)])),
        equilibrium: solved.describe(&model),
    })
}
