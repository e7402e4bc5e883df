//! Forces that are not contacts: cage, supports, gravity, loads, drive.

use std::ops::Range;

use super::state::{State, Table};
use crate::contact::Motion;
use crate::model::{Model, RowModel, Spring};
use crate::scene::{Cage, Drive, TimeFunction};
use crate::simd::{Simd, Vector, Wide};

/// A cage link between two balls: force on the first (positive in tension), stored energy and dissipated power.
pub(crate) struct Link {
    pub force: f64,
    pub energy: f64,
    pub power: f64,
}

/// The link between two balls, model section 6.
pub(crate) fn link(cage: &Cage, nominal: f64, first: &Motion, second: &Motion) -> Link {
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
        let (from, balls) = (2 + row.first, row.count);
        let [x, y, ..] = state.q.directions();
        let [vx, vy, ..] = state.v.directions();
        let of = [x, y, vx, vy];
        let zero = all(0.0);
        // Two balls have one link.
        let mut closing = [zero; 2];
        if balls > 2 {
            let mut apart = [zero; 4];
            for (apart, of) in apart.iter_mut().zip(of) {
                *apart = all(of[from] - of[from + balls - 1]);
            }
            closing = pull((cage, row.cage_distance), apart);
        }
        let mut before = closing;
        let [fx, fy, ..] = forces.directions_mut();
        for at in (0..balls).step_by(Vector::<S>::LANES) {
            let body = from + at;
            let mut apart = [zero; 4];
            for (apart, of) in apart.iter_mut().zip(of) {
                *apart = Vector::load(simd, &of[body + 1..]) - Vector::load(simd, &of[body..]);
            }
            let linked = pull((cage, row.cage_distance), apart);
            let lane = Vector::count(simd);
            let left = (balls - at) as f64;
            let (open, there) = (lane.below(all(left - 1.5)), lane.below(all(left - 0.5)));
            for (i, along) in [&mut *fx, &mut *fy].into_iter().enumerate() {
                let next = there.choose(open.choose(linked[i], closing[i]), zero);
                let force = next - there.choose(next.after(before[i]), zero);
                before[i] = next;
                let to = &mut along[body..];
                (Vector::load(simd, to) + force).store(to);
            }
        }
    }
}

/// What [`link`] puts on the first of two balls along x and y, from how far the second is apart and how fast it departs.
#[allow(clippy::inline_always)]
#[inline(always)]
pub(super) fn pull<S: Simd>(
    (cage, nominal): (&Cage, f64),
    [dx, dy, dvx, dvy]: [Vector<S>; 4],
) -> [Vector<S>; 2] {
    let all = |x: f64| dx.same(x);
    let half = all(0.5 * cage.play);
    let over = all(1.0) / dx.mul_add(dx, dy * dy).sqrt();
    let (nx, ny) = (dx * over, dy * over);
    let extension = dx.mul_add(nx, dy * ny) - all(nominal);
    let rate = dvx.mul_add(nx, dvy * ny);
    let mut beyond = extension;
    if cage.play > 0.0 {
        beyond = extension - extension.or_more(-half).or_less(half);
    }
    let mut tension = beyond.mul_add(all(cage.stiffness), rate * all(cage.damping));
    if cage.play > 0.0 {
        let engaged = half.below(extension).or(extension.below(-half));
        tension = engaged.choose(tension, all(0.0));
    }
    [tension * nx, tension * ny]
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
