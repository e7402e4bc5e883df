//! How fast the rows of a run orbited and their balls turned, compared with rolling at the contact angles at rest.
//!
//! Lines of faults lie at the passing frequencies of the balls. At high speed the contact angles of both races differ, balls slip, and
//! without race control they spin about an axis of their own: the error of rolling at one mean angle, as in tables of frequencies, is
//! then several percent. A run measures it.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::base::error::Result;
use crate::base::words::remembers;
use crate::contact::{Motion, wrapped};
use crate::dynamics::Dynamics;
use crate::inspect;
use crate::integrate::DenseStep;
use crate::model::{BodyId, Model, Race, RowModel};
use crate::statics::{RaceControl, Spacing, compile, in_motion, steady::keep, steady::orbit};

/// Mean speeds of a row over a run \[Hz\], all in the positive sense about z.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct RowKinematics {
    /// Row, from 0.
    pub row: usize,
    /// Rate of the inner ring.
    pub inner: f64,
    /// Rate of the outer ring.
    pub outer: f64,
    /// Rate of the balls around the axis: FTF, that of the cage. Of a cage that is a ring its own turns, from one on; else the mean over all
    /// balls of the row: as many of them pass an unloaded place of a race as a loaded one.
    pub cage: f64,
    /// Rate of a ball about its own axis against the cage: BSF, or BSF/cos α of balls that spin about the bearing's axis only. Absent
    /// where all balls of the row have a defect that tumbles.
    pub spin: Option<f64>,
    /// Value of [`Self::cage`] for balls that roll at the contact angles of the static equilibrium; absent where there is
    /// none, where nothing loads the row at rest, or where the speed of a ring changes.
    pub rolling: Option<f64>,
}

impl RowKinematics {
    /// FTF, BPFO, BPFI and BSF of so many balls, in turns of the inner ring against the outer; BSF absent with [`Self::spin`].
    pub(crate) fn orders(&self, balls: usize) -> ([f64; 3], Option<f64>) {
        let balls = balls as f64;
        let orders = [
            self.cage - self.outer,
            balls * (self.cage - self.outer),
            balls * (self.inner - self.cage),
        ];
        let shaft = (self.inner - self.outer).abs();
        (
            orders.map(|f| f.abs() / shaft),
            self.spin.map(|f| f / shaft),
        )
    }

    /// How much faster the balls went round than by rolling, seen from the outer ring, as a share of that.
    pub fn ahead(&self) -> Option<f64> {
        let seen = |cage: f64| cage - self.outer;
        self.rolling
            .map(|rolling| seen(self.cage) / seen(rolling) - 1.0)
    }
}

/// How far balls may go between two looks \[rad\], and the longest time between them, since speeds change \[s\].
const APART: f64 = 0.3;
const LONGEST: f64 = 1e-3;
/// Turns of the inner ring against the outer from which a run has means.
const TURNS: f64 = 1.0;

/// Follows the balls of a run.
#[derive(Default)]
pub(crate) struct Orbits {
    /// States of all bodies.
    y: Vec<f64>,
    /// Time of the next look \[s\].
    next: f64,
    /// Times of the first and the last look \[s\].
    times: Option<[f64; 2]>,
    /// Angles of the rings at the first and at the last look \[rad\].
    rings: [[f64; 2]; 2],
    balls: Vec<BallCourse>,
    /// Angles of the cages that are rings at the first and at the last look \[rad\].
    cages: Vec<[f64; 2]>,
}

#[derive(Clone, Copy, Default)]
struct BallCourse {
    /// Direction in which it was seen last, and how far it has come since the first look \[rad\].
    direction: f64,
    advance: f64,
    /// Rate at which the ball turned against the cage, and how far it has \[rad/s, rad\]; absent of one that tumbles.
    spin: Option<f64>,
    turned: f64,
}

impl Orbits {
    /// Prepares for a run from a state of all bodies.
    pub fn prepare(&mut self, start: &[f64]) {
        self.y = start.to_vec();
    }

    /// An accepted step.
    pub fn step(&mut self, dynamics: &Dynamics<'_>, step: &DenseStep<'_>) {
        let t = step.t1();
        if t < self.next {
            return;
        }
        dynamics.expand(t, step.y1(), &mut self.y);
        self.look(dynamics.model(), t);
    }

    fn look(&mut self, model: &Model, t: f64) {
        let layout = model.layout();
        let mut fastest = 0.0_f64;
        let now = Race::BOTH.map(|race| layout.motion(&self.y, race.ring()).theta);
        let [first, last] = self.times.unwrap_or([t, t]);
        for j in 0..model.balls.len() {
            let motion = layout.motion(&self.y, BodyId::ball(j));
            let orbit = motion.orbit_speed();
            fastest = fastest.max(orbit.abs());
            let spin = motion.attitude.is_none().then(|| against(&motion, orbit));
            let direction = motion.direction();
            let Some(ball) = self.balls.get_mut(j) else {
                self.balls.push(BallCourse {
                    direction,
                    advance: 0.0,
                    spin,
                    turned: 0.0,
                });
                continue;
            };
            ball.advance += wrapped(direction - ball.direction);
            ball.turned += 0.5 * (t - last) * (spin.unwrap_or(0.0) + ball.spin.unwrap_or(0.0));
            (ball.direction, ball.spin) = (direction, spin);
        }
        self.rings[1] = now;
        let cages = (0..model.rows.len()).filter(|row| model.rows[*row].cage.is_some());
        let cages = cages.map(|row| layout.motion(&self.y, layout.cage(row)).theta);
        if self.times.is_none() {
            self.rings[0] = now;
            self.cages = cages.map(|angle| [angle; 2]).collect();
        } else {
            for (cage, now) in self.cages.iter_mut().zip(cages) {
                cage[1] = now;
            }
        }
        self.times = Some([first, t]);
        self.next = t + (APART / fastest).min(LONGEST);
    }

    /// Kinematics of the rows whose balls drive at the end of the run; empty of a run of less than a turn.
    pub fn results(&self, model: &Model) -> Vec<RowKinematics> {
        let Some([first, last]) = self.times else {
            return Vec::new();
        };
        let rate = |angle: f64| angle / (TAU * (last - first));
        let [before, after] = self.rings;
        let [outer, inner] = Race::BOTH.map(|race| after[race] - before[race]);
        if (inner - outer).abs() < TURNS * TAU {
            return Vec::new();
        }
        let rolling = if model.scene().turns_steadily() {
            rolling(model, RaceControl::Friction).ok()
        } else {
            None
        };
        let rows = model.rows.iter().enumerate();
        rows.filter(|(_, row)| {
            row.balls()
                .any(|j| inspect::raw::contact(model, &self.y, j, Race::Inner).load > 0.0)
        })
        .map(|(at, row)| {
            let balls = || row.balls().map(|j| &self.balls[j]);
            let mean = |sum: f64, count: usize| rate(sum / count as f64);
            let seen = balls().filter(|ball| ball.spin.is_some());
            let of = &model.scene().rows[at];
            RowKinematics {
                row: at,
                inner: rate(inner),
                outer: rate(outer),
                cage: match self.cages.get(at).map(|[first, last]| last - first) {
                    // Of less than a turn the balls tell more: each is somewhere in its pocket.
                    Some(turned) if turned.abs() >= TAU => rate(turned),
                    _ => mean(balls().map(|ball| ball.advance).sum(), of.ball_count),
                },
                spin: (seen.clone().count() > 0)
                    .then(|| mean(seen.clone().map(|ball| ball.turned).sum(), seen.count())),
                rolling: rolling.as_ref().and_then(|all| Some(all[at]?.cage)),
            }
        })
        .collect()
    }
}

remembers!(Orbits: y, next, times, rings, balls, cages);

remembers!(BallCourse: direction, advance, spin, turned);

/// How a row rolls at the contact angles of the static equilibrium, each race at its own.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RowRolling {
    /// Mean contact angle of both races, weighted with the loads \[rad\].
    pub angle: f64,
    /// Orbit of the balls \[Hz\].
    pub cage: f64,
    /// Mean turns of the loaded balls against it \[Hz\].
    pub spin: f64,
}

/// How each row of the healthy bearing rolls that is loaded: a ball that rests in a defect at one place would count as if all did all
/// the time. As a run starts: where friction, drag and gyroscopic moments balance; or, without friction or under
/// a race's control, by those of [*Rings that tilt*](crate::equations#rings-that-tilt-balls-that-spin-freely). Absent of a row whose inner
/// contacts carry nothing, so that nothing drives it.
///
/// # Errors
/// As [`crate::start()`] from [`crate::Start::Equilibrium`].
pub fn rolling(model: &Model, control: RaceControl) -> Result<Vec<Option<RowRolling>>> {
    if !model.scene().defects.is_empty() {
        let mut healthy = model.scene().clone();
        healthy.defects.clear();
        return rolling(&compile(&healthy)?, control);
    }
    let control = control.on(model);
    let mut y = in_motion(model, control, Spacing::Equal)?;
    if control == RaceControl::Friction {
        keep(model, &mut y);
    }
    Ok(model.rows.iter().map(|row| rolls(model, row, &y)).collect())
}

fn rolls(model: &Model, row: &RowModel, y: &[f64]) -> Option<RowRolling> {
    let (mut angle, mut spin, mut loads, mut both) = (0.0, 0.0, 0.0, 0.0);
    let (mut around, mut drives) = (0.0, false);
    for j in row.balls() {
        let [outer, inner] = Race::BOTH.map(|race| inspect::raw::contact(model, y, j, race));
        for contact in [&outer, &inner].into_iter().filter(|of| of.load > 0.0) {
            angle += contact.load * contact.angle.abs();
            loads += contact.load;
        }
        let motion = model.layout().motion(y, BodyId::ball(j));
        around = orbit(model.layout(), y, BodyId::ball(j));
        let least = outer.load.min(inner.load);
        spin += least * against(&motion, around);
        both += least;
        drives |= inner.load > 0.0;
    }
    (drives && both > 0.0).then(|| RowRolling {
        angle: angle / loads,
        cage: around / TAU,
        spin: spin / (both * TAU),
    })
}

/// How fast a ball turns against its orbit \[rad/s\].
fn against(motion: &Motion, orbit: f64) -> f64 {
    (motion.omega - orbit).hypot(motion.across.norm())
}
