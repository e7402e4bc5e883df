//! Forces that are not contacts: cage, supports, gravity, loads, unbalances, drive.

use std::ops::Range;

use super::state::{State, Table};
use crate::contact::{Motion, V2, cross};
use crate::model::{BodyId, DOFS, Dof, Model, Race, RowModel, Spring, UnbalanceModel};
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
        let (from, balls) = (row.first_body().index(), row.count);
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
        let (body, dof) = (spring.body, spring.dof);
        *forces.get_mut(body, dof) -= spring.stiffness * (state.q.get(body, dof) - spring.nominal)
            + spring.damping * state.v.get(body, dof);
    }
}

pub(super) fn gravity(model: &Model, forces: &mut Table) {
    for id in model.layout().bodies() {
        for (dof, g) in Dof::TRANSLATIONS.into_iter().zip(model.scene.gravity) {
            *forces.get_mut(id, dof) += model.bodies[id].mass[dof] * g;
        }
    }
}

/// Loads that stay the same, or those that change.
pub(super) fn loads(model: &Model, constant: bool, t: f64, forces: &mut Table) {
    for load in &model.loads {
        if matches!(load.force, TimeFunction::Constant(_)) == constant {
            let force = load.force.at(t);
            let [x, y, z] = load.direction.map(|direction| force * direction);
            forces.add(load.ring.ring(), &[x, y, z, 0.0]);
        }
    }
}

/// What the unbalances of a ring do, x, y, z and about z, from all other forces on it.
///
/// The ring's mass m and its inertia I about its own centre are those of the whole, its centre of mass stands at
/// u/m = Σ m e r̂ / m from the centre, so with ψ the angle of each r̂ (Lagrange)
///
/// ```text
/// m ẍ = F_x + m e (ω² cos ψ + ω̇ sin ψ)        m ÿ = F_y + m e (ω² sin ψ − ω̇ cos ψ)
/// I ω̇ = T + u × g − u × (ẍ, ÿ)
/// ```
///
/// A driven speed tells ω̇. Else the first two in the third give it, over 1 − (u_x²/m_y + u_y²/m_x)/I, which is above 0
/// where the ring's inertia about its centre of mass is.
pub(super) fn unbalance(
    model: &Model,
    t: f64,
    state: &State,
    ring: Race,
    others: &[f64; DOFS],
) -> [f64; DOFS] {
    let mut sum = [0.0; DOFS];
    let of_ring = model.unbalances.iter().filter(|u| u.ring == ring);
    if of_ring.clone().next().is_none() {
        return sum;
    }
    let motion = state.motion(ring.ring());
    let square = motion.omega * motion.omega;
    let direction = |u: &UnbalanceModel| (motion.theta + u.angle).sin_cos();
    let mut whole = V2::zeros();
    for unbalance in of_ring.clone() {
        let (sin, cos) = direction(unbalance);
        whole += V2::new(cos, sin) * unbalance.moment;
    }
    let [gx, gy, _] = model.scene.gravity;
    let mobility = &model.mobility[ring.ring()];
    let accelerate = |spin: f64| {
        V2::new(
            mobility[0] * (others[0] + square * whole.x + spin * whole.y),
            mobility[1] * (others[1] + square * whole.y - spin * whole.x),
        )
    };
    let weight = cross(whole, V2::new(gx, gy));
    let spin = if let (Drive::Speed(speed), Race::Inner) = (&model.scene.drive, ring) {
        speed.rate(t)
    } else {
        let coupled = mobility[1] * whole.x * whole.x + mobility[0] * whole.y * whole.y;
        let torque = others[3] + weight - cross(whole, accelerate(0.0));
        mobility[3] * torque / (1.0 - mobility[3] * coupled)
    };
    for unbalance in of_ring {
        let (sin, cos) = direction(unbalance);
        sum[0] += unbalance.moment * (square * cos + spin * sin);
        sum[1] += unbalance.moment * (square * sin - spin * cos);
    }
    sum[3] = weight - cross(whole, accelerate(spin));
    sum
}

/// Adds them to the forces on both rings, after all others.
pub(super) fn unbalances(model: &Model, t: f64, state: &State, forces: &mut Table) {
    if !model.unbalances.is_empty() {
        for race in Race::BOTH {
            let others = forces.of(race.ring());
            forces.add(race.ring(), &unbalance(model, t, state, race, &others));
        }
    }
}

pub(super) fn drive(model: &Model, t: f64, forces: &mut Table) {
    if let Drive::Torque { value, .. } = &model.scene.drive {
        *forces.get_mut(BodyId::INNER, Dof::Theta) += TimeFunction::at(value, t);
    }
}
