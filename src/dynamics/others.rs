//! Forces that are not contacts: cage, supports, gravity, loads, drive.

use std::ops::Range;

use super::state::{State, Table};
use crate::contact::Motion;
use crate::model::{Model, RowModel};
use crate::scene::{Cage, Drive, TimeFunction};
use crate::simd::{LANES, Lanes, Task};

/// A cage link between two balls: force on the first (positive in tension), stored energy and dissipated power.
pub(super) struct Link {
    pub force: f64,
    pub energy: f64,
    pub power: f64,
}

/// The link between two balls, model section 6.
pub(super) fn link(cage: &Cage, nominal: f64, first: &Motion, second: &Motion) -> Link {
    let apart = second.centre - first.centre;
    let extension = apart.norm() - nominal;
    let half = cage.play / 2.0;
    if cage.play > 0.0 && extension.abs() <= half {
        return Link {
            force: 0.0,
            energy: 0.0,
            power: 0.0,
        };
    }
    let beyond = extension - half.copysign(extension);
    let rate = (second.velocity - first.velocity).dot(&(apart / apart.norm()));
    Link {
        force: cage.stiffness * beyond + cage.damping * rate,
        energy: 0.5 * cage.stiffness * beyond * beyond,
        power: cage.damping * rate * rate,
    }
}

/// The links of some rows.
pub(super) fn cage(model: &Model, rows: Range<usize>, state: &State, forces: &mut Table) {
    if let Some(cage) = &model.scene.cage {
        for row in &model.rows[rows] {
            model.level.run(Links {
                cage,
                row,
                state,
                forces,
            });
        }
    }
}

/// All links of a row, eight at once: each from a ball to its neighbour, the last one back to the first.
struct Links<'a> {
    cage: &'a Cage,
    row: &'a RowModel,
    state: &'a State,
    forces: &'a mut Table,
}

impl Task for Links<'_> {
    type Output = ();

    // Compiled for the level that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Self {
            cage,
            row,
            state: State { q, v },
            forces,
        } = self;
        let (first, count) = (2 + row.first, row.links().count());
        for start in (0..count).step_by(LANES) {
            let from = first + start;
            // Where the circle closes.
            let last = (row.count - 1).wrapping_sub(start);
            let x = apart(q, 0, from, first, last);
            let y = apart(q, 1, from, first, last);
            let inverse = Lanes::all(1.0) / x.mul_add::<FMA>(x, y * y).sqrt();
            let (n_x, n_y) = (x * inverse, y * inverse);
            let extension = x.mul_add::<FMA>(n_x, y * n_y) - row.cage_distance;
            let half = 0.5 * cage.play;
            let beyond = extension - extension.map(|e| within(e, half));
            let rate = apart(v, 0, from, first, last) * n_x + apart(v, 1, from, first, last) * n_y;
            let there = Lanes::from_fn(|lane| lane as f64);
            let there = Lanes::all((count - start) as f64).above(there);
            let engaged = if cage.play > 0.0 {
                there.and(extension.abs().above(Lanes::all(half)))
            } else {
                there
            };
            let force = beyond * cage.stiffness + rate * cage.damping;
            for (direction, n) in [(0, n_x), (1, n_y)] {
                let mut pull = engaged.choose(force * n, Lanes::ZERO);
                forces.add_eight(from, direction, pull);
                if last < LANES {
                    *forces.get_mut(first, direction) -= pull[last];
                    pull[last] = 0.0;
                }
                forces.add_eight(from + 1, direction, -pull);
            }
        }
    }
}

/// The nearest number between −half and half; `f64::clamp` is not vectorised.
#[allow(clippy::inline_always)]
#[inline(always)]
fn within(x: f64, half: f64) -> f64 {
    let x = if x < half { x } else { half };
    if x > -half { x } else { -half }
}

/// Eight balls' next neighbours less they themselves; the one at `last`, if any, has the `first` ball next.
// Into what is compiled for the level that runs it.
#[allow(clippy::inline_always)]
#[inline(always)]
fn apart(of: &Table, direction: usize, from: usize, first: usize, last: usize) -> Lanes {
    let mut next = of.eight(from + 1, direction);
    if last < LANES {
        next[last] = of.get(first, direction);
    }
    next - of.eight(from, direction)
}

pub(super) fn supports(model: &Model, state: &State, forces: &mut Table) {
    for spring in &model.springs {
        let (direction, body) = (spring.direction, spring.body);
        *forces.get_mut(body, direction) -= spring.stiffness
            * (state.q.get(body, direction) - spring.nominal)
            + spring.damping * state.v.get(body, direction);
    }
}

pub(super) fn gravity(model: &Model, forces: &mut Table) {
    for (b, body) in model.bodies.iter().enumerate() {
        for (i, g) in model.scene.gravity.iter().enumerate() {
            *forces.get_mut(b, i) += body.mass[i] * g;
        }
    }
}

/// Loads that stay the same, or those that change.
pub(super) fn loads(model: &Model, constant: bool, t: f64, forces: &mut Table) {
    for load in &model.loads {
        if matches!(load.force, TimeFunction::Constant(_)) == constant {
            let force = load.force.at(t);
            let [x, y, z] = load.direction.map(|direction| force * direction);
            forces.add(load.ring, &[x, y, z, 0.0]);
        }
    }
}

pub(super) fn unbalances(model: &Model, t: f64, state: &State, forces: &mut Table) {
    for unbalance in &model.unbalances {
        let ring = state.motion(unbalance.ring);
        let rate = match (&model.scene.drive, unbalance.ring) {
            (Drive::Speed(speed), 1) => speed.rate(t),
            _ => 0.0,
        };
        let (sin, cos) = (ring.theta + unbalance.angle).sin_cos();
        let (radial, tangential) = (ring.omega * ring.omega, -rate);
        let x = unbalance.moment * (radial * cos - tangential * sin);
        let y = unbalance.moment * (radial * sin + tangential * cos);
        forces.add(unbalance.ring, &[x, y, 0.0, 0.0]);
    }
}

pub(super) fn drive(model: &Model, t: f64, forces: &mut Table) {
    if let Drive::Torque { value, .. } = &model.scene.drive {
        *forces.get_mut(1, 3) += TimeFunction::at(value, t);
    }
}
