//! Supports: a spring and a damper for each direction of a body, relaxed at its nominal place.
//!
//! ```text
//! F = −k (q − q₀) − c v        energy k (q − q₀)²/2        power c v²
//! ```

// Everything in the loop must be compiled for the instructions of its caller.
#![allow(clippy::inline_always)]

use super::{Account, Force, State, Table, Use, leaning};
use crate::model::{Body, BodyId, Degree, Dof, Model, Spring};

pub(crate) const FORCE: Force = Force {
    name: "support",
    contribution: "support",
    used: |model| Use::evaluated(!model.springs.is_empty() || leaning::holds(model)),
    add: |model, _, state, forces| add(&model.springs, state, forces),
};

/// Force of a spring and its damper against their direction \[N\], about z \[N m\].
#[inline(always)]
pub(crate) fn resistance(spring: &Spring, place: f64, speed: f64) -> f64 {
    spring.stiffness * (place - spring.nominal) + spring.damping * speed
}

/// Those of some springs.
#[inline]
pub(crate) fn add(springs: &[Spring], state: &State, forces: &mut Table) {
    for spring in springs {
        let (body, dof) = (spring.body, spring.dof);
        let resistance = resistance(spring, state.q.get(body, dof), state.v.get(body, dof));
        *forces.get_mut(body, dof) -= resistance;
    }
}

/// What pulls a body at rest at a place back to its nominal one \[N\].
#[inline]
pub(crate) fn at_rest(body: &Body, dof: Dof, place: f64) -> f64 {
    body.degrees[dof].stiffness() * (body.nominal[dof] - place)
}

/// Of all supports in a state.
pub(crate) fn account(model: &Model, y: &[f64]) -> Account {
    let (layout, mut account) = (model.layout(), Account::default());
    for spring in &model.springs {
        let position = y[layout.at(spring.body, spring.dof)] - spring.nominal;
        let speed = y[layout.speed_at(spring.body, spring.dof)];
        account.energy += 0.5 * spring.stiffness * position * position;
        account.power += spring.damping * speed * speed;
    }
    account
}

/// Rate of the fastest of a body's own dampers \[1/s\].
pub(crate) fn rate(model: &Model, body: BodyId) -> f64 {
    let body = &model.bodies[body];
    let rates = body.degrees.iter().zip(body.mass);
    let rates = rates.map(|(degree, mass)| match degree {
        Degree::Free { damping, .. } => damping / mass,
        _ => 0.0,
    });
    rates.fold(0.0, f64::max)
}
