//! The forces on all bodies apart by origin.

use super::sums::Named;
use crate::forces::{self, Force, State, Table, unbalance};
use crate::model::{BodyId, Dof, Model, Race};

/// Names of the contributions of [`contributions`], in their order: elastic contact forces, damping and friction, then what
/// each other force counts to.
pub fn contribution_names() -> Vec<&'static str> {
    let mut names = Named::NAMES.to_vec();
    for force in &forces::ALL {
        if !names.contains(&force.contribution) {
            names.push(force.contribution);
        }
    }
    names
}

/// The forces on every body by origin (see [`contribution_names`]): x, y, z \[N\] and about z \[N m\] for each body in turn. `y`
/// holds the states of all bodies.
///
/// # Panics
/// If the length of `y` is wrong.
pub fn contributions(model: &Model, t: f64, y: &[f64]) -> Vec<(&'static str, Vec<f64>)> {
    assert_eq!(y.len(), model.dim(), "length of the state");
    let bodies = model.bodies.len();
    let mut state = State::new(bodies);
    state.read(y);
    let names = contribution_names();
    let mut parts = vec![Table::zeros(bodies); names.len()];
    let rings = state.rings();
    for (j, ball) in model.balls.iter().enumerate() {
        let body = BodyId::ball(j);
        for race in Race::BOTH {
            let mut named = Named::default();
            let pair = &model.rows[ball.row].pairs[race];
            pair.evaluate(&ball.side, &state.motion(body), &rings[race], &mut named);
            for (part, (on_ball, on_ring)) in parts.iter_mut().zip(named.wrenches()) {
                part.add(body, &on_ball);
                part.add(race.ring(), &on_ring);
            }
        }
    }
    let part = |force: &Force| {
        let named = |name: &&str| *name == force.contribution;
        names.iter().position(named).unwrap_or_default()
    };
    let depends = |force: &&Force| force.name == unbalance::FORCE.name;
    for force in forces::ALL.iter().filter(|force| !depends(force)) {
        (force.add)(model, t, &state, &mut parts[part(force)]);
    }
    for race in Race::BOTH {
        let ring = race.ring();
        let all = Dof::ALL.map(|dof| parts.iter().map(|part| part.get(ring, dof)).sum());
        let unbalance = unbalance::on(model, t, &state, race, &all);
        parts[part(&unbalance::FORCE)].add(ring, &unbalance);
    }
    let bodies = model.layout().bodies();
    let listed = |part: Table| bodies.clone().flat_map(|body| part.of(body)).collect();
    let parts: Vec<Vec<f64>> = parts.into_iter().map(listed).collect();
    names.into_iter().zip(parts).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Golden: they are names of columns, which users know.
    #[test]
    fn contributions_keep_their_names_and_order() {
        let names = [
            "contact", "damping", "friction", "cage", "support", "gravity", "load", "drive",
        ];
        assert_eq!(contribution_names(), names);
    }
}
