//! Forces that are not contacts: cage, supports, gravity, loads, drive.

use std::ops::Range;

use super::state::{State, Table};
use crate::contact::Motion;
use crate::model::{Model, RowModel, Spring};
use crate::scene::{Cage, Drive, TimeFunction};
use crate::simd::{Simd, Vector, Wide};

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
            model.level.run_wide(Links {
                cage,
                row,
                state,
                forces,
            });
        }
    }
}

/// All links of a row: each from a ball to its neighbour, and the last one back to the first.
struct Links<'a> {
    cage: &'a Cage,
    row: &'a RowModel,
    state: &'a State,
    forces: &'a mut Table,
}

impl Wide for Links<'_> {
    type Output = ();

    // Compiled for the level that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            cage,
            row,
            state,
            forces,
        } = self;
        let all = |x: f64| Vector::all(simd, x);
        let (zero, half) = (all(0.0), all(0.5 * cage.play));
        let (from, links) = (2 + row.first, row.count - 1);
        let count = links.div_ceil(Vector::<S>::LANES);
        let all_of = |of| Vector::<S>::registers(of, count);
        let [x, y, ..] = state.q.directions();
        let [vx, vy, ..] = state.v.directions();
        let balls = [x, y, vx, vy].map(|of| all_of(&of[from..]));
        let next = [x, y, vx, vy].map(|of| all_of(&of[from + 1..]));
        let [fx, fy, ..] = forces.directions_mut().map(|of| &mut of[from..]);
        for i in 0..count {
            let apart = [0, 1, 2, 3]
                .map(|k: usize| Vector::of(simd, next[k][i]) - Vector::of(simd, balls[k][i]));
            let [dx, dy, dvx, dvy] = apart;
            let over = all(1.0) / dx.mul_add(dx, dy * dy).sqrt();
            let n = (dx * over, dy * over);
            let extension = dx.mul_add(n.0, dy * n.1) - all(row.cage_distance);
            let slack = extension.or_more(-half).or_less(half);
            let rate = dvx.mul_add(n.0, dvy * n.1);
            let beyond = extension - slack;
            let force = beyond.mul_add(all(cage.stiffness), rate * all(cage.damping));
            let at = i * Vector::<S>::LANES;
            let there = Vector::count(simd).below(all((links - at) as f64));
            let engaged = if cage.play > 0.0 {
                half.below(extension).or(extension.below(-half)).and(there)
            } else {
                there
            };
            for (along, n) in [(&mut *fx, n.0), (&mut *fy, n.1)] {
                let pull = engaged.choose(force * n, zero);
                let first = &mut along[at..];
                (Vector::load(simd, first) + pull).store(first);
                let next = &mut along[at + 1..];
                (Vector::load(simd, next) - pull).store(next);
            }
        }
        // Two balls have one link, which is done.
        if links > 1 {
            let (last, first) = (from + links, from);
            let [a, b] = [last, first].map(|body| state.motion(body));
            let apart = b.centre - a.centre;
            let pull = apart * (link(cage, row.cage_distance, &a, &b).force / apart.norm());
            forces.add(last, &[pull.x, pull.y, 0.0, 0.0]);
            forces.add(first, &[-pull.x, -pull.y, 0.0, 0.0]);
        }
    }
}

pub(super) fn supports(springs: &[Spring], state: &State, forces: &mut Table) {
    for spring in springs {
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
