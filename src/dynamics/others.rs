//! Forces that are not contacts: cage, supports, gravity, loads, drive.

use crate::contact::V2;
use crate::model::Model;
use crate::scene::{Cage, Drive, TimeFunction};

/// A cage link between two balls: unit vector from the first to the second, force (positive in tension),
/// stored energy and dissipated power.
pub(super) struct Link {
    pub direction: V2,
    pub force: f64,
    pub energy: f64,
    pub power: f64,
}

/// The link between balls `i` and `j` (indices among all balls), model section 6.
pub(super) fn link(cage: &Cage, nominal: f64, y: &[f64], i: usize, j: usize) -> Link {
    let (first, second) = (super::motion(y, 2 + i), super::motion(y, 2 + j));
    let apart = second.centre - first.centre;
    // One division: this runs for every ball in every evaluation.
    let inverse = 1.0 / apart.norm_squared().sqrt();
    let length = apart.norm_squared() * inverse;
    let direction = apart * inverse;
    let extension = length - nominal;
    let half = cage.play / 2.0;
    if cage.play > 0.0 && extension.abs() <= half {
        return Link {
            direction,
            force: 0.0,
            energy: 0.0,
            power: 0.0,
        };
    }
    let beyond = extension - half.copysign(extension);
    let rate = (second.velocity - first.velocity).dot(&direction);
    Link {
        direction,
        force: cage.stiffness * beyond + cage.damping * rate,
        energy: 0.5 * cage.stiffness * beyond * beyond,
        power: cage.damping * rate * rate,
    }
}

pub(super) fn cage(model: &Model, y: &[f64], forces: &mut [[f64; 4]]) {
    let Some(cage) = &model.scene.cage else {
        return;
    };
    for row in &model.rows {
        for (i, j) in row.links() {
            let link = link(cage, row.cage_distance, y, i, j);
            let force = link.direction * link.force;
            for (ball, sign) in [(i, 1.0), (j, -1.0)] {
                forces[2 + ball][0] += sign * force.x;
                forces[2 + ball][1] += sign * force.y;
            }
        }
    }
}

pub(super) fn supports(model: &Model, y: &[f64], forces: &mut [[f64; 4]]) {
    let (q, v) = y.split_at(y.len() / 2);
    for spring in &model.springs {
        let state = 4 * spring.body + spring.direction;
        forces[spring.body][spring.direction] -=
            spring.stiffness * (q[state] - spring.nominal) + spring.damping * v[state];
    }
}

pub(super) fn gravity(model: &Model, forces: &mut [[f64; 4]]) {
    for (body, force) in model.bodies.iter().zip(forces) {
        for (i, g) in model.scene.gravity.iter().enumerate() {
            force[i] += body.mass[i] * g;
        }
    }
}

pub(super) fn loads(model: &Model, t: f64, y: &[f64], forces: &mut [[f64; 4]]) {
    for load in &model.loads {
        let force = load.force.at(t);
        for (sum, direction) in forces[load.ring].iter_mut().zip(load.direction) {
            *sum += force * direction;
        }
    }
    for unbalance in &model.unbalances {
        let ring = super::motion(y, unbalance.ring);
        let rate = match (&model.scene.drive, unbalance.ring) {
            (Drive::Speed(speed), 1) => speed.rate(t),
            _ => 0.0,
        };
        let (sin, cos) = (ring.theta + unbalance.angle).sin_cos();
        let (radial, tangential) = (ring.omega * ring.omega, -rate);
        forces[unbalance.ring][0] += unbalance.moment * (radial * cos - tangential * sin);
        forces[unbalance.ring][1] += unbalance.moment * (radial * sin + tangential * cos);
    }
}

pub(super) fn drive(model: &Model, t: f64, forces: &mut [[f64; 4]]) {
    if let Drive::Torque { value, .. } = &model.scene.drive {
        forces[1][3] += TimeFunction::at(value, t);
    }
}
