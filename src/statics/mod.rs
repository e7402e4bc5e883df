//! Static equilibrium in the cage's frame: loads, gravity and the balls' centrifugal force.
//!
//! Two nested Newton solves. Each ball, held at its angle, finds its radius and axial place between the
//! rings; the rings then see every ball as a nonlinear spring, the Schur complement of its stiffness. They start
//! where springs between the groove centres would carry the load; the balls are seeded on the line of these
//! centres, and only a positive definite tangent stiffness is accepted: Newton's method alone also finds balls
//! that balance on a shoulder.
//!
//! The cage pulls at all balls of a row with one tension. It is found between two solves of the rings, with the rings
//! held: loose balls leave the race that no longer presses them, and often hang between the races on the cage.
//!
//! What follows from it: [`stiffness()`], which the rings' Newton solve forms anyway, and [`load_distribution`] over
//! a turn of the cage; [`dynamic_coefficients`] adds what depends on velocities. [`compile()`] and [`place()`]
//! answer what compiling a scene asks of the bearing at rest.

mod arms;
mod at_rest;
mod axis;
mod ball;
mod cage;
mod coefficients;
mod distribution;
mod fallen;
mod guess;
mod gyroscopic;
mod polish;
mod problem;
mod residual;
mod rings;
pub(crate) mod rolling;
mod search;
mod small_motion;
mod springs;
pub(crate) mod start;
pub(crate) mod steady;
mod stiffness;
mod tilted;
mod unknowns;

use std::borrow::Cow;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::base::error::Result;
use crate::base::interrupt;
use crate::forces::blame;
use crate::inspect::{self, MomentOnRing, RaceFilm};
use crate::model::{self, Ball, BodyId, Model, Placed, Race};
use crate::scene::{Doubt, Scene, Spin};
pub(crate) use at_rest::DefectPasses;
use at_rest::Equilibria;
pub use axis::{AxisHeld, axis_held};
pub(crate) use axis::{at_speed, axis_doubt};
pub use coefficients::{DynamicCoefficients, dynamic_coefficients};
pub use distribution::{EquivalentLoads, LoadDistribution, load_distribution};
pub(crate) use fallen::Spacing;
use problem::Problem;
use residual::Residual;
pub use rolling::RaceControl;
pub use stiffness::{Stiffness, stiffness};
use unknowns::{RingStiffness, Rings};

/// Checks a scene, places the defects that are to lie where contacts run, and compiles it.
///
/// # Errors
/// [`crate::Error::Scene`] names the first field that is not usable, or the environment variable `BALLRACE_SIMD` where it
/// names no level of this processor.
pub fn compile(scene: &Scene) -> Result<Model> {
    model::compile(scene, &Equilibria)
}

/// The scene with numbers for the axial place of every defect and for what its walls say, and where the places come from, by the
/// defects' names.
///
/// # Errors
/// [`crate::Error::Scene`] for a scene that is not usable.
pub fn place(scene: &Scene) -> Result<(Cow<'_, Scene>, BTreeMap<String, Placed>)> {
    model::place(scene, &Equilibria)
}

/// Residual over the sum of the acting forces that counts as zero.
const TOLERANCE: f64 = 1e-10;
/// The same, while the cage's pull is not yet known.
const ON_THE_WAY: f64 = 1e-5;
/// Precision of the balls over that of the rings.
const FINE: f64 = 1e-2;
/// Residual that is still accepted where a slice that enters a defect makes the force jump.
const STALLED: f64 = 1e-3;
/// Solves with the cage's pull and the balls' speeds renewed, at most: three or four do. Where balls that hang on the cage by next to no load of
/// their own, or a cage stiffer than the contacts, would take many, Newton's method on all bodies ends it.
const ROUNDS: usize = 30;
/// Change of what carries balls round, likewise, at which it counts as found: it closes in by a half a round.
const CARRIED: f64 = 1e-9;
/// Change of the cage's pull on any ball, over the sum of the acting forces, at which the cage counts as engaged.
const ENGAGED: f64 = 1e-7;

/// Static state of a bearing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Equilibrium {
    /// Displacement of the outer ring x, y, z \[m\].
    pub outer: [f64; 3],
    /// Displacement of the inner ring x, y, z \[m\].
    pub inner: [f64; 3],
    /// Tilt of the outer ring about x and y \[rad\].
    pub outer_tilt: [f64; 2],
    /// Tilt of the inner ring about x and y \[rad\].
    pub inner_tilt: [f64; 2],
    /// Moments about x and y that the balls put on the outer ring, about its centre \[N m\]: what keeps it from tilting carries
    /// them.
    pub outer_moment: [f64; 2],
    /// The same on the inner ring \[N m\].
    pub inner_moment: [f64; 2],
    /// The balls, row by row.
    pub balls: Vec<BallEquilibrium>,
    /// Newton iterations of the rings.
    pub iterations: usize,
    /// Force left unbalanced on the body that is worst off: on a ring along its free directions, on a ball along its radius
    /// and z \[N\].
    pub residual: f64,
    /// The same over the largest load, of a contact or on a ring: at most 1e-4.
    pub residual_share: f64,
    /// The films of rows with an oil, for the loads of the equilibrium without films and the drive's speed, unless the
    /// lubricant gives others.
    pub films: Vec<RaceFilm>,
    /// Doubts about the scene, about the pressure in its contacts and about its films.
    pub doubts: Vec<Doubt>,
}

impl Equilibrium {
    /// Largest Hertz pressure of any contact \[Pa\].
    pub fn largest_pressure(&self) -> f64 {
        let contacts = self.balls.iter().flat_map(|b| [&b.outer, &b.inner]);
        contacts.map(|c| c.pressure).fold(0.0, f64::max)
    }
}

/// Static state of a ball.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct BallEquilibrium {
    /// Row, from 0.
    pub row: usize,
    /// Ball of the row, from 0.
    pub ball: usize,
    /// Angular place \[rad\].
    pub angle: f64,
    /// Distance from the inertial axis \[m\].
    pub radius: f64,
    /// Axial place \[m\].
    pub z: f64,
    /// Contact with the outer race.
    pub outer: ContactEquilibrium,
    /// Contact with the inner race.
    pub inner: ContactEquilibrium,
}

/// Static state of a contact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct ContactEquilibrium {
    /// Normal force \[N\].
    pub load: f64,
    /// Operating contact angle \[rad\]; null without load.
    pub angle: Option<f64>,
    /// Normal approach \[m\], negative for a gap.
    pub deflection: f64,
    /// Axial place of the zone's middle of force, in the ring's frame \[m\]; null without load.
    pub zone_centre: Option<f64>,
    /// Largest pressure, at the zone's centre, by Hertz's theory whatever the law \[Pa\]; 0 without load. Of the smooth
    /// race where the ball lies in a defect.
    pub pressure: f64,
}

/// Solves for the static equilibrium at t = 0.
///
/// ```
/// use ballrace::scene::presets;
/// let loaded = ballrace::equilibrium(&presets::deep_groove_6205(500.0, 0.0, 1800.0)).unwrap();
/// // The ball on the load line carries most; the top ball only its centrifugal force.
/// assert!(loaded.balls[0].inner.load > 200.0 && loaded.balls[4].inner.load == 0.0);
/// ```
///
/// # Errors
/// [`crate::Error::Scene`] for a scene that is not usable, [`crate::Error::Equilibrium`] when the load cannot be carried, or
/// where more than 1e-4 of the largest load is left unbalanced on a body; [`crate::Error::Interrupted`] under a
/// [`crate::Interrupt`].
pub fn equilibrium(scene: &Scene) -> Result<Equilibrium> {
    equilibrium_under(scene, RaceControl::Friction)
}

/// The same with a say in how balls spin that spin freely; for others it makes no difference.
///
/// # Errors
/// As [`equilibrium()`].
pub fn equilibrium_under(scene: &Scene, control: RaceControl) -> Result<Equilibrium> {
    let mut found = solved(scene, control)?;
    if scene.spin != Some(Spin::Free) {
        // Beside an equilibrium that is there the other spin may have none, of which a user did not ask.
        let held = axis_held(scene).ok().flatten();
        interrupt::check()?;
        found.doubts.extend(axis_doubt(scene, held));
    }
    Ok(found)
}

/// The equilibrium alone, without what another spin would give.
fn solved(scene: &Scene, control: RaceControl) -> Result<Equilibrium> {
    let model = compile(scene)?;
    Ok(solve(&model, control.on(&model))?.describe(&model))
}

/// Positions of the equilibrium in a state vector with zero velocities.
pub(crate) fn positions(model: &Model) -> Result<Vec<f64>> {
    solve(model, RaceControl::Friction).map(|solved| solved.y)
}

/// The same with the speeds of all bodies: of balls that run fast those at which they go on as they stand there, of others those at which
/// they roll at their contact angles, which are next to them.
pub(crate) fn in_motion(model: &Model, control: RaceControl, spacing: Spacing) -> Result<Vec<f64>> {
    let Solved { mut y, speeds, .. } =
        solve_with(|| Problem::new(model).controlled(control).spaced(spacing))?;
    if speeds.is_empty() {
        rolling::at_contacts(model, control, &mut y);
    } else {
        let half = y.len() / 2;
        y[half..].copy_from_slice(&speeds);
        if control == RaceControl::Friction {
            steady::keep(model, &mut y);
        }
    }
    if spacing == Spacing::Fallen {
        fallen::advance(model, &mut y);
    }
    Ok(y)
}

/// Solution of the solver.
struct Solved {
    /// State vector with zero velocities.
    y: Vec<f64>,
    /// Speeds of all bodies, where centrifugal forces were worth finding them.
    speeds: Vec<f64>,
    iterations: usize,
    /// Stiffness of the bearing between its rings: x, y, z and, where it was asked for, tilts of outer and inner ring, as lengths.
    bearing: RingStiffness,
    residual: Residual,
}

impl Solved {
    fn describe(&self, model: &Model) -> Equilibrium {
        Equilibrium {
            residual: self.residual.force,
            residual_share: self.residual.share(),
            ..describe(model, &self.y, self.iterations)
        }
    }
}

/// Places and contacts of a state, and what is doubtful there; what is unbalanced is not looked at.
pub(crate) fn describe(model: &Model, y: &[f64], iterations: usize) -> Equilibrium {
    let layout = model.layout();
    let place = |body: BodyId| layout.centre(y, body);
    let mut on_rings = Race::BOTH.map(|race| MomentOnRing::new(model, y, race));
    let mut contact = |j: usize, race: Race| {
        let summary = on_rings[race].add_and_summarise(y, j);
        let loaded = summary.load > 0.0;
        ContactEquilibrium {
            load: summary.load,
            angle: loaded.then_some(summary.angle),
            deflection: deflection(model, y, j, race),
            zone_centre: loaded.then_some(summary.zone_centre),
            pressure: inspect::pressure(model, y, j, race, summary.load),
        }
    };
    let ball = |(j, ball): (usize, &Ball)| {
        let [x, y, z] = place(BodyId::ball(j));
        BallEquilibrium {
            row: ball.row,
            ball: ball.index,
            angle: y.atan2(x),
            radius: x.hypot(y),
            z,
            outer: contact(j, Race::Outer),
            inner: contact(j, Race::Inner),
        }
    };
    let balls = model.balls.iter().enumerate().map(ball).collect();
    let [outer_moment, inner_moment] = on_rings.map(|sum| sum.with_loads(0.0));
    let mut found = Equilibrium {
        outer_tilt: model.tilt(y, Race::Outer)[0],
        inner_tilt: model.tilt(y, Race::Inner)[0],
        outer_moment,
        inner_moment,
        outer: place(BodyId::OUTER),
        inner: place(BodyId::INNER),
        balls,
        iterations,
        residual: 0.0,
        residual_share: 0.0,
        films: inspect::films(model),
        doubts: Vec::new(),
    };
    found.doubts = doubts(&model.scene, &found);
    found.doubts.extend(axis::doubts(model, &found));
    found
}

/// Normal approach of a ball and a race \[m\], negative for a gap.
fn deflection(model: &Model, y: &[f64], j: usize, race: Race) -> f64 {
    let ball = &model.balls[j];
    let pair = &model.rows[ball.row].pairs[race];
    let [b, r] = model.facing(y, j, race);
    let seen = b.seen_from(&r);
    let (dx, dy) = (seen.centre.x, seen.centre.y);
    let wave = pair.waves.at(r.angle_of(dy.atan2(dx)));
    let (approach, _) = pair.foot(ball.side.radius, dx.hypot(dy), seen.z, wave);
    let outwards = pair.outwards(dy.atan2(dx));
    approach + ball.side.waves.at(b.angle_of(outwards))
}

/// Doubts about a scene, about the pressures and films in its contacts, and about rings that have tilted from where they nominally are.
fn doubts(scene: &Scene, found: &Equilibrium) -> Vec<Doubt> {
    let of_contacts = inspect::doubts(found.largest_pressure(), &found.films);
    let rings = [
        (&scene.outer_ring, found.outer_tilt),
        (&scene.inner_ring, found.inner_tilt),
    ];
    let tilted = rings
        .into_iter()
        .filter(|(ring, tilt)| *tilt != ring.tilt.unwrap_or_default());
    let tilt = tilted.map(|(_, [x, y])| x.hypot(y)).fold(0.0, f64::max);
    let of_scene = scene.doubts().into_iter();
    of_scene
        .chain(of_contacts)
        .chain(Doubt::tilt(tilt))
        .collect()
}

/// Solves from the first guess; from the nominal places where there is none, or where it leads to no stable place, such
/// as one on top of a single ball.
fn solve(model: &Model, control: RaceControl) -> Result<Solved> {
    solve_with(|| Problem::new(model).controlled(control))
}

fn solve_with<'m>(problem: impl Fn() -> Problem<'m>) -> Result<Solved> {
    let first = problem();
    interrupt::check()?;
    if let Some(rings) = first.guess()
        && let Ok(solved) = solve_from(first, rings)
    {
        return Ok(solved);
    }
    interrupt::check()?;
    let again = problem();
    let relaxed = again.relaxed();
    solve_from(again, relaxed)
}

/// Solves with the balls at their nominal angles and nominal speeds; then with those at which they roll where they stand, lets the
/// cage shift them and pull, and solves again.
fn solve_from(problem: Problem, rings: Rings) -> Result<Solved> {
    blame::scope(|| solved_from(problem, rings))
}

fn solved_from(mut problem: Problem, mut rings: Rings) -> Result<Solved> {
    let model = problem.model;
    let seeds: Vec<_> = (0..model.balls.len())
        .map(|j| problem.seed(j, &rings))
        .collect();
    let (mut state, mut iterations) = problem.balance(&mut rings, &seeds, 1.0, ON_THE_WAY)?;
    if let Some(step) = problem.off_saddle(&state) {
        rings += step;
        let (found, more) = problem.balance(&mut rings, &state.balls, 1.0, ON_THE_WAY)?;
        state = found;
        iterations += more;
    }
    let mut unbalanced = ON_THE_WAY;
    let mut last = f64::INFINITY;
    for _ in 0..ROUNDS {
        interrupt::check()?;
        let turned = problem.carry_round(&rings, &state.balls);
        let left = match model.scene.cage_links() {
            Some(cage) => problem.engage(cage, &rings, &mut state.balls, &state.holds),
            None => 0.0,
        };
        unbalanced = left.max(turned) / problem.magnitude;
        if left <= ENGAGED * problem.magnitude && turned <= CARRIED * problem.magnitude {
            break;
        }
        // Where a stiff cage makes it worse, with a firmer hold.
        if left > last {
            problem.cage_share = (4.0 * problem.cage_share).clamp(0.25, 1.0);
        }
        last = left;
        // Rough places would look like speeds that have been found.
        let tolerance = if turned > 0.0 { TOLERANCE } else { ON_THE_WAY };
        let (found, more) = problem.balance(&mut rings, &state.balls, unbalanced, tolerance)?;
        state = found;
        iterations += more;
    }
    let (mut state, more) = problem.balance(&mut rings, &state.balls, unbalanced, TOLERANCE)?;
    iterations += more;
    let mut residual = problem.residual(&rings, &state.balls)?;
    if model.scene.cage_links().is_some() && residual.is_off() {
        let mut places = state.balls.clone();
        for _ in 0..ROUNDS {
            problem.polish(&mut rings, &mut places)?;
            if problem.carry_round(&rings, &places) <= CARRIED * problem.magnitude {
                break;
            }
        }
        state = problem.rings(&rings, &places, 0.0, FINE * TOLERANCE)?;
        residual = problem.residual(&rings, &state.balls)?;
    }
    problem.check(&state, &rings)?;
    problem.accept(&residual)?;
    Ok(Solved {
        residual,
        y: problem.state(&rings, &state.balls),
        iterations,
        bearing: state.bearing,
        speeds: problem.speeds,
    })
}
