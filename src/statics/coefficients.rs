//! Stiffness and damping of a bearing as they act on a rotor.

use std::array::from_fn;

use nalgebra::{Matrix2x5, Matrix5};
use serde::{Deserialize, Serialize};

use super::distribution::{healthy_turns, turned};
use super::small_motion::SmallMotion;
use super::unknowns::OF_A_RING;
use super::{Equilibrium, RaceControl, Spacing, compile, equilibrium, in_motion};
use crate::base::error::Result;
use crate::scene::Scene;

/// Turn of the cage over which differences along the orbit are taken \[rad\].
const FURTHER: f64 = 1e-3;

/// Stiffness and damping of a bearing that runs, in the frame of the scene (x right, y up, z along the axis): the inner ring against a
/// held outer ring, in the mean over positions of the cage.
///
/// Entry (i, j) is the force \[N\] or moment about the ring's centre of mass \[N m\] that has to be added along i for small, slow motion along
/// j: x, y, z \[m\] and tilts about x and y \[rad\], or their rates. Slow is below some kHz: the inertia of balls is left out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct DynamicCoefficients {
    /// K \[N/m, N/rad, N m/m, N m/rad\].
    pub stiffness: [[f64; OF_A_RING]; OF_A_RING],
    /// C \[N s/m, N s/rad, N m s/m, N m s/rad\].
    pub damping: [[f64; OF_A_RING]; OF_A_RING],
    /// Equilibrium of the healthy bearing at its start angles.
    pub equilibrium: Equilibrium,
}

/// Stiffness and damping of a bearing for a rotor, by the equations of a run.
///
/// The forces of all contacts, with their damping, films and friction, are linearised about the steady motion in which a run begins. The
/// balls follow: along their radius and the axis as their contacts let them, along the orbit and in their rotation so that friction on
/// them does not change. K differs from [`super::stiffness()`] by what velocities add while the balls go round, and is not quite
/// symmetric: friction follows the loads of the contacts, and dampers turn with the cage, which alone makes K_xy = ω_c C_xx of a bearing
/// under thrust. Supports, a structure below them, the cage's links, drag of oil on balls, squeeze films and defects are no part of it. The mean over positions of the cage
/// stands for what varies as balls pass.
///
/// ```
/// use ballrace::scene::presets;
/// let found = ballrace::dynamic_coefficients(&presets::deep_groove_6205(500.0, 0.0, 1800.0), 4)?;
/// let [x, y] = [0, 1].map(|i| found.stiffness[i][i]);
/// // Loaded along −y, and stiffest there; damped in all directions.
/// assert!(y > x && found.damping[0][0] > 0.0);
/// # Ok::<(), ballrace::Error>(())
/// ```
///
/// # Errors
/// As [`super::equilibrium()`]; [`crate::Error::Scene`] for no positions.
pub fn dynamic_coefficients(scene: &Scene, positions: usize) -> Result<DynamicCoefficients> {
    let (scene, turns) = healthy_turns(scene, positions)?;
    let (mut stiffness, mut damping) = (Matrix5::zeros(), Matrix5::zeros());
    let share = 1.0 / turns.len() as f64;
    for turn in turns {
        let here = balls(&scene, turn)?;
        let further = if here.iter().flatten().any(|ball| ball.orbit != 0.0) {
            balls(&scene, turn + FURTHER)?
        } else {
            Vec::new()
        };
        for (j, ball) in here.iter().enumerate() {
            let Some(ball) = ball else { continue };
            stiffness += ball.stiffness * share;
            damping += ball.damping * share;
            let next = further.get(j).and_then(Option::as_ref);
            let change: Matrix2x5<f64> = next.map_or_else(Matrix2x5::zeros, |next| {
                (next.follow - ball.follow) / FURTHER
            });
            // ȧ = follow ẋ + ω_c ∂follow/∂φ x.
            stiffness += ball.by_following * change * (ball.orbit * share);
        }
    }
    let rows = |of: &Matrix5<f64>| from_fn(|i| from_fn(|j| of[(i, j)]));
    Ok(DynamicCoefficients {
        stiffness: rows(&stiffness),
        damping: rows(&damping),
        equilibrium: equilibrium(&scene)?,
    })
}

/// Small motions of all balls with the cage turned so far \[rad\].
fn balls(scene: &Scene, turn: f64) -> Result<Vec<Option<SmallMotion>>> {
    let model = compile(&turned(scene, turn))?;
    let y = in_motion(&model, RaceControl::Friction, Spacing::Equal)?;
    let of = |j| SmallMotion::of(&model, &y, j);
    Ok((0..model.balls.len()).map(of).collect())
}
