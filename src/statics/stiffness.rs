//! Tangent stiffness of a bearing at its equilibrium.

use std::array::from_fn;

use serde::{Deserialize, Serialize};

use super::problem::Problem;
use super::unknowns::{OF_A_RING, OF_RINGS, RingStiffness, at, degree, first};
use super::{Equilibrium, compile, solve_with};
use crate::base::error::Result;
use crate::model::{Dof, Race};
use crate::scene::Scene;

/// Tangent stiffness of a bearing at its static equilibrium, in the frame of the scene (z along the axis).
///
/// Entry (i, j) is the force \[N\] that has to be added along i for a metre along j, in the limit of small moves:
/// positive on the diagonal. The balls follow the rings, each free along its radius and along z at the angle where
/// the cage holds it. Supports, a structure below them and gravity are no part of it; damping and friction neither.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Stiffness {
    /// Inner ring against a held outer ring: forces and moves of the inner ring along x, y, z \[N/m\].
    pub inner: [[f64; 3]; 3],
    /// Both rings: x, y, z of the outer, then of the inner ring \[N/m\].
    pub rings: [[f64; 6]; 6],
    /// The same with tilts: forces along x, y, z \[N\] and moments about x and y, about the ring's centre of mass \[N m\], by moves
    /// along x, y, z \[m\] and tilts about x and y \[rad\], in this order.
    pub inner_spatial: [[f64; OF_A_RING]; OF_A_RING],
    /// The same for both rings: the five of the outer, then those of the inner ring.
    pub rings_spatial: [[f64; OF_RINGS]; OF_RINGS],
    /// Equilibrium at which the stiffness is.
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
    let solved = solve_with(|| Problem::new(&model).with_tilts())?;
    let bearing = &solved.bearing;
    let lever = model.radius(Race::Inner.ring());
    // Moments and tilts, where forces and lengths stood for them.
    let spatial = RingStiffness::from_fn(|i, j| {
        let scale = |at| {
            if degree(at).1.is_rotation() {
                lever
            } else {
                1.0
            }
        };
        bearing[(i, j)] * scale(i) * scale(j)
    });
    let inner = first(Race::Inner);
    let place = |i: usize| at(Race::BOTH[i / 3], Dof::TRANSLATIONS[i % 3]);
    Ok(Stiffness {
        inner: from_fn(|i| from_fn(|j| bearing[(inner + i, inner + j)])),
        rings: from_fn(|i| from_fn(|j| bearing[(place(i), place(j))])),
        inner_spatial: from_fn(|i| from_fn(|j| spatial[(inner + i, inner + j)])),
        rings_spatial: from_fn(|i| from_fn(|j| spatial[(i, j)])),
        equilibrium: solved.describe(&model),
    })
}
