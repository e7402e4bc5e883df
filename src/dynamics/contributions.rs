//! The forces on all bodies, by origin.

use nalgebra::Vector3;

use super::films::Films;
use super::sums::SumsByOrigin;
use crate::forces::{self, Force, ForceSums, Instant, State, Table};
use crate::model::{BodyId, Dof, Model, Race};

/// Names of the contributions of [`contributions`], in their order: elastic contact forces, damping and friction, then what
/// each other force counts to.
pub fn contribution_names() -> Vec<&'static str> {
    let mut names = SumsByOrigin::NAMES.to_vec();
    for force in forces::ALL {
        if !names.contains(&force.contribution()) {
            names.push(force.contribution());
        }
    }
    names
}

/// The forces on every body by origin (see [`contribution_names`]): x, y, z \[N\] and about z \[N m\] for each body in turn. `y`
/// holds the states of all bodies. Films have the speed of the rings that it holds.
///
/// # Panics
/// If the length of `y` is wrong.
pub fn contributions(model: &Model, t: f64, y: &[f64]) -> Vec<(&'static str, Vec<f64>)> {
    let films = Films::of(model, y);
    contributions_with_films(films.as_ref().map_or(model, Films::model), t, y)
}

/// The same of a model whose films are those of the state.
pub(crate) fn contributions_with_films(
    model: &Model,
    t: f64,
    y: &[f64],
) -> Vec<(&'static str, Vec<f64>)> {
    assert_eq!(y.len(), model.dim(), "length of the state");
    let bodies = model.bodies.len();
    let mut state = State::new(model);
    state.read(y);
    let names = contribution_names();
    let mut parts = vec![Table::zeros(bodies); names.len()];
    let rings = state.rings();
    let tilted = model
        .is_spatial()
        .then(|| Race::BOTH.map(|race| state.tilted(model, race)));
    for (j, ball) in model.balls.iter().enumerate() {
        let body = BodyId::ball(j);
        for race in Race::BOTH {
            let mut named = SumsByOrigin::default();
            let pair = &model.rows[ball.row].pairs[race];
            let [at, ring] = match &tilted {
                Some(tilted) => tilted[race].facing(&state.motion(body)),
                None => [state.motion(body), rings[race]],
            };
            pair.evaluate(&ball.side, &at, &ring, &mut named);
            let (place, tilted) = (at.seen_from(&ring).place(), tilted.as_ref());
            let tilted = tilted.map(|tilted| &tilted[race]);
            for (part, sum) in parts.iter_mut().zip(named.0) {
                let [on_ball, mut on_ring] = sum.on_bodies(&place, tilted);
                if let Some(ring) = tilted {
                    on_ring.force = ring.rotation.frame.to_scene(&on_ring.force);
                }
                part.add(body, &on_ball.about_axis());
                part.add(race.ring(), &on_ring.about_axis());
            }
        }
    }
    let part = |force: &dyn Force| {
        let named = |name: &&str| *name == force.contribution();
        names.iter().position(named).unwrap_or_default()
    };
    let at = Instant {
        t,
        state: &state,
        rows: model.rows.len(),
        times: 1.0,
        springs: &model.springs,
        rings: tilted.as_ref().map(<[_; 2]>::each_ref),
    };
    let into = |table: &mut Table, add: &dyn Fn(&mut ForceSums<'_>)| {
        let mut moments = [Vector3::zeros(); 2];
        let spatial = at.rings.is_some();
        add(&mut ForceSums {
            on: table,
            moments: spatial.then_some(&mut moments),
        });
        for (race, moment) in Race::BOTH.into_iter().zip(moments) {
            let about = moment.dot(&at.frame(race).axis());
            table.add(race.ring(), &[0.0, 0.0, 0.0, about]);
        }
    };
    for force in forces::ALL {
        into(&mut parts[part(force)], &|sums| {
            force.add_constant(model, sums);
            force.add(model, &at, sums);
        });
    }
    for force in forces::ALL {
        for race in Race::BOTH {
            let ring = race.ring();
            let all = Dof::ALL.map(|dof| parts.iter().map(|part| part.get(ring, dof)).sum());
            if let Some(wrench) = force.given_others(model, &at, race, &all) {
                into(&mut parts[part(force)], &|sums| sums.add(race, &wrench));
            }
        }
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
