//! Supports: a spring and a damper for each direction of a body, relaxed at its nominal place.
//!
//! ```text
//! F = −k (q − q₀) − c v        energy k (q − q₀)²/2        power c v²
//! ```

use super::{
    Account, Asymmetry, Damper, Force, ForceSums, Instant, RingWrench, State, Table, Use, tilted,
};
use crate::model::{Body, BodyId, Degree, Dof, Model, Race, Spring};

/// Springs and dampers of all bodies, of tilts too.
#[derive(Debug)]
pub(crate) struct Supports;

impl Force for Supports {
    fn name(&self) -> &'static str {
        "support"
    }

    fn used(&self, model: &Model) -> Use {
        Use::evaluated(!model.springs.is_empty() || tilted::holds(model))
    }

    fn add(&self, model: &Model, at: &Instant<'_>, sums: &mut ForceSums<'_>) {
        add(at.springs, at.state, sums.on);
        let Some(rings) = at.rings else { return };
        for race in Race::BOTH {
            if model.is_parallel_and_held(race) {
                continue;
            }
            // The spin's own mount turns the ring about its axis.
            let on_spin = std::mem::take(sums.on.get_mut(race.ring(), Dof::Theta));
            let supported = tilted::support(model, race, at.state, rings[race], on_spin);
            sums.add(race, &supported);
        }
    }

    fn account(&self, model: &Model, y: &[f64]) -> Account {
        let mut account = account(model, y);
        account += tilted::account(model, y);
        account
    }

    fn dampers(&self, model: &Model) -> Vec<Damper> {
        let of = |body: BodyId| Damper {
            name: format!("{}.support", model.bodies[body].name),
            body,
            rate: rate(model, body),
        };
        model.layout().bodies().map(of).collect()
    }

    fn at_start(&self, _model: &Model, _race: Race) -> RingWrench {
        RingWrench::default()
    }

    fn asymmetry(&self, _model: &Model) -> Asymmetry {
        Asymmetry::default()
    }
}

/// Force of a spring and its damper against their direction \[N\], about z \[N m\].
#[inline(always)]
pub(crate) fn resistance(spring: &Spring, place: f64, speed: f64) -> f64 {
    spring.stiffness * (place - spring.nominal) + spring.damping * speed
}

/// Adds the forces of some springs.
#[inline]
fn add(springs: &[Spring], state: &State, forces: &mut Table) {
    for spring in springs {
        let slot = forces.slot(spring.body, spring.dof);
        *forces.at_mut(slot) -= resistance(spring, state.q.at(slot), state.v.at(slot));
    }
}

/// Force that pulls a body at rest at a place back to its nominal one \[N\].
#[inline]
pub(crate) fn at_rest(body: &Body, dof: Dof, place: f64) -> f64 {
    body.degrees[dof].stiffness() * (body.nominal[dof] - place)
}

/// Account of all supports in a state.
fn account(model: &Model, y: &[f64]) -> Account {
    let (layout, mut account) = (model.layout(), Account::default());
    for spring in &model.springs {
        let position = y[layout.at(spring.body, spring.dof)] - spring.nominal;
        let speed = y[layout.speed_at(spring.body, spring.dof)];
        account.support += 0.5 * spring.stiffness * position * position;
        account.power += spring.damping * speed * speed;
    }
    account
}

/// Rate of the fastest of a body's own dampers \[1/s\].
fn rate(model: &Model, body: BodyId) -> f64 {
    let body = &model.bodies[body];
    let rates = body.degrees.iter().zip(body.mass);
    let rates = rates.map(|(degree, mass)| match degree {
        Degree::Free { damping, .. } => damping / mass,
        _ => 0.0,
    });
    rates.fold(0.0, f64::max)
}
