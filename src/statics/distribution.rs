//! Loads over a turn of the cage, and the equivalent loads that a race's life is computed from.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::{BallEquilibrium, Equilibrium, RaceControl, doubts, place, solved};
use crate::base::error::{Error, Result};
use crate::base::memory;
use crate::scene::Scene;

/// Exponents of the mean for a ring that turns and for one that stands under the load (ball bearings).
const TURNING: f64 = 3.0;
const STANDING: f64 = 10.0 / 3.0;

/// Static loads while the cage turns past rings that stand.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct LoadDistribution {
    /// How far the cage has turned from the scene's start angles at each position \[rad\].
    pub turn: Vec<f64>,
    /// The bearing at each position.
    pub equilibria: Vec<Equilibrium>,
    /// Equivalent loads, one entry per row.
    pub equivalent: Vec<EquivalentLoads>,
}

/// Loads \[N\] that tire the races of a row as much, acting on every ball all the time.
///
/// The inner ring turns under the load and every place of it meets every load, (mean of Q³)^{1/3}; the outer ring
/// stands, and its most loaded places decide, (mean of Q^{10/3})^{3/10}. Where [`Scene::outer_speed`] turns the outer ring, the
/// first is its mean too, and the second that of an inner ring that stands. ISO/TS 16281, section on ball bearings, and
/// T. A. Harris, *Rolling Bearing Analysis*, ch. 18, after G. Lundberg, A. Palmgren 1947.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct EquivalentLoads {
    /// Number of the outer race.
    pub outer: f64,
    /// Number of the inner race.
    pub inner: f64,
}

/// The static loads of a scene without its defects at so many positions of the cage per ball pitch.
///
/// Where all balls are alike, one pitch shows all there is: ball j at a turn of φ is where ball j + 1 will be a pitch
/// later. Where they differ (diameters, rows of different numbers of balls) the cage makes a whole turn. Rings
/// stand at angle 0 throughout, with their waviness. Lives are of the healthy bearing: a ball in a spall at one of a few
/// positions would count as if it were there all the time; [`super::equilibrium()`] knows defects.
///
/// ```
/// use ballrace::scene::presets;
/// let found = ballrace::load_distribution(&presets::deep_groove_6205(500.0, 0.0, 1800.0), 8).unwrap();
/// assert_eq!((found.turn.len(), found.equilibria[0].balls.len()), (8, 9));
/// assert!(found.equivalent[0].outer > found.equivalent[0].inner);
/// ```
///
/// # Errors
/// As [`super::equilibrium()`]; [`Error::Argument`] for no positions, [`Error::Memory`] for more than fit.
pub fn load_distribution(scene: &Scene, positions: usize) -> Result<LoadDistribution> {
    let (scene, turn) = healthy_turns(scene, positions)?;
    let equilibria = turn
        .iter()
        .map(|turn| {
            let mut found = solved(&turned(&scene, *turn), RaceControl::Friction)?;
            // Those of the scene that was given: the angle of a turned one says nothing.
            found.doubts = doubts(&scene, &found);
            Ok(found)
        })
        .collect::<Result<Vec<_>>>()?;
    let [outer, inner] = exponents(&scene);
    let equivalent = (0..scene.rows.len())
        .map(|row| EquivalentLoads {
            outer: mean(&equilibria, row, outer, |ball| ball.outer.load),
            inner: mean(&equilibria, row, inner, |ball| ball.inner.load),
        })
        .collect();
    Ok(LoadDistribution {
        turn,
        equilibria,
        equivalent,
    })
}

/// Exponents of the outer and the inner race. Where no speed of the outer ring says otherwise, the inner ring turns under the load.
fn exponents(scene: &Scene) -> [f64; 2] {
    let [outer, inner] = scene.ring_speeds(0.0);
    if outer == 0.0 {
        [STANDING, TURNING]
    } else if inner == 0.0 {
        [TURNING, STANDING]
    } else {
        [TURNING; 2]
    }
}

/// The healthy bearing, and how far its cage turns for so many positions per ball pitch \[rad\]: over a pitch where all balls are alike,
/// else over a turn.
pub(super) fn healthy_turns(scene: &Scene, positions: usize) -> Result<(Scene, Vec<f64>)> {
    if positions == 0 {
        return Err(Error::argument(
            "positions",
            "0",
            "at least 1 per ball pitch",
        ));
    }
    scene.validate()?;
    let mut scene = scene.clone();
    scene.defects.clear();
    // Once for all positions: tilts that are held by request stay as the cage turns.
    let scene = place(&scene)?.0.into_owned();
    let most = scene.rows.iter().map(|row| row.ball_count).max();
    let pitches = if repeats(&scene) {
        1
    } else {
        most.unwrap_or(1)
    };
    let range = if pitches == 1 {
        TAU / most.unwrap_or(1) as f64
    } else {
        TAU
    };
    let count = pitches.saturating_mul(positions);
    check_memory(&scene, count)?;
    let turn = (0..count)
        .map(|k| range * k as f64 / count as f64)
        .collect();
    Ok((scene, turn))
}

/// A scene with its cage turned by an angle \[rad\].
pub(super) fn turned(scene: &Scene, turn: f64) -> Scene {
    let mut turned = scene.clone();
    for row in &mut turned.rows {
        row.start_angle += turn;
    }
    turned
}

/// Refuses more positions than fit into memory: they are here, and in the arrays of their columns.
fn check_memory(scene: &Scene, count: usize) -> Result<()> {
    let balls: usize = scene.rows.iter().map(|row| row.ball_count).sum();
    let position = 2 * (size_of::<Equilibrium>() + balls * size_of::<BallEquilibrium>());
    memory::check(count as f64 * position as f64, || {
        format!("the loads of {balls} balls at {count} positions; lower positions")
    })
}

/// Whether a turn by one pitch leaves everything as it was.
fn repeats(scene: &Scene) -> bool {
    scene.rows.iter().all(|row| {
        row.ball_count == scene.rows[0].ball_count && row.diameter_errors.iter().all(|e| *e == 0.0)
    })
}

/// Mean of order p over all balls of a row at all positions.
fn mean(
    equilibria: &[Equilibrium],
    row: usize,
    p: f64,
    load: impl Fn(&BallEquilibrium) -> f64,
) -> f64 {
    let balls = || equilibria.iter().flat_map(|found| &found.balls);
    let loads = || balls().filter(|ball| ball.row == row).map(&load);
    let count = loads().count() as f64;
    (loads().map(|q| q.powf(p)).sum::<f64>() / count).powf(1.0 / p)
}
