//! Supports of a ring that tilts.
//!
//! ```text
//! Q_x = −k τ_x − c τ̇_x …        coupled: ξ = (c + F p − F₀ p, τ_x − τ_x₀, τ_y − τ_y₀, θ),  Q = −(K ξ + C ξ̇),  energy ½ ξ·K ξ
//! ```
//!
//! p leads from the centre of mass to the point of the axis where a coupled support holds, F₀ is the nominal frame. Off the axis
//! a spring would hold a point that does not spin, and drive the spin.

use nalgebra::Vector6;

use super::{Account, RingWrench, State};
use crate::contact::TiltedRing;
use crate::model::{CoupledModel, Degree, Model, Race, RingModel};
use crate::tilt::Frame;

/// Whether springs or dampers hold any tilt.
pub(crate) fn holds(model: &Model) -> bool {
    let sprung = |degree: &Degree| match degree {
        Degree::Free { stiffness, damping } => *stiffness != 0.0 || *damping != 0.0,
        Degree::Fixed | Degree::Driven => false,
    };
    let mut rings = model.rings.iter();
    rings.any(|ring| ring.coupled.is_some() || ring.degrees.iter().any(sprung))
}

/// Wrench of a ring's support through tilts, and what of the table's number about z is a force of the spin's own mount.
pub(crate) fn support(
    model: &Model,
    race: Race,
    state: &State,
    tilted: &TiltedRing,
    on_spin: f64,
) -> RingWrench {
    let ring = &model.rings[race];
    let [tilt, rates] = state.tilt(race);
    let mut forces = [0.0, 0.0, on_spin];
    for i in 0..2 {
        if let Degree::Free { stiffness, damping } = ring.degrees[i] {
            forces[i] -= stiffness * (tilt[i] - ring.tilt[i]) + damping * rates[i];
        }
    }
    let mut sum = RingWrench::default();
    if let Some(coupled) = &ring.coupled {
        let [places, speeds] = stretched(ring, coupled, race, state, tilted);
        let pull = -(coupled.stiffness * places + coupled.damping * speeds);
        let arm = tilted.rotation.frame.axis() * coupled.place;
        sum.force = pull.fixed_rows::<3>(0).into_owned();
        sum.moment = arm.cross(&sum.force);
        for i in 0..3 {
            forces[i] += pull[3 + i];
        }
    }
    sum.moment += tilted.rotation.moment_of(forces);
    sum
}

/// ξ and its rate.
fn stretched(
    ring: &RingModel,
    coupled: &CoupledModel,
    race: Race,
    state: &State,
    tilted: &TiltedRing,
) -> [Vector6<f64>; 2] {
    let motion = state.motion(race.ring());
    let [tilt, rates] = state.tilt(race);
    let frame = &tilted.rotation.frame;
    let moved = (frame.axis() - Frame::new(ring.tilt).axis()) * coupled.place;
    let moving = tilted
        .rotation
        .angular_velocity()
        .cross(&(frame.axis() * coupled.place));
    let (centre, velocity) = (motion.centre, motion.velocity);
    let places = [
        centre.x + moved.x,
        centre.y + moved.y,
        motion.z + moved.z,
        tilt[0] - ring.tilt[0],
        tilt[1] - ring.tilt[1],
        motion.theta,
    ];
    let speeds = [
        velocity.x + moving.x,
        velocity.y + moving.y,
        motion.vz + moving.z,
        rates[0],
        rates[1],
        motion.omega,
    ];
    [places, speeds].map(Vector6::from)
}

/// Account of the supports of tilts and coupled supports in a state.
pub(crate) fn account(model: &Model, y: &[f64]) -> Account {
    let mut account = Account::default();
    if !model.tilts() {
        return account;
    }
    let mut state = State::new(model);
    state.read(y);
    for race in Race::BOTH {
        let ring = &model.rings[race];
        let [tilt, rates] = state.tilt(race);
        for i in 0..2 {
            if let Degree::Free { stiffness, damping } = ring.degrees[i] {
                account.support += 0.5 * stiffness * (tilt[i] - ring.tilt[i]).powi(2);
                account.power += damping * rates[i] * rates[i];
            }
        }
        if let Some(coupled) = &ring.coupled {
            let tilted = state.tilted(model, race);
            let [places, speeds] = stretched(ring, coupled, race, &state, &tilted);
            account.support += 0.5 * places.dot(&(coupled.stiffness * places));
            account.power += speeds.dot(&(coupled.damping * speeds));
        }
    }
    account
}
