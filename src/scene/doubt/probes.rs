//! Probes of what cannot move, and of a cage that is not there.

use super::Doubt;
use crate::scene::{Component, Probe, Scene};

/// Words for the directions of a body.
const DIRECTIONS: [&str; 8] = [
    "along x",
    "along y",
    "along z",
    "about z",
    "from tilting about x",
    "from tilting about y",
    "from turning about x",
    "from turning about y",
];

pub(super) fn look(scene: &Scene, found: &mut Vec<Doubt>) {
    for (name, probe) in &scene.probes {
        match probe {
            Probe::Motion(of) => {
                found.extend(still(scene, name, &of.body, of.components.as_deref()));
            }
            Probe::Cage { .. } if scene.cage.is_none() => {
                let usual = "the scene has no cage, so this probe records nothing";
                found.push(Doubt::new(format!("probes.{name}"), "cage", usual));
            }
            _ => {}
        }
    }
}

/// Columns of a motion that never change. That the outer ring does not turn is as usual as expected: of all twelve
/// components its rotation is reported only where nothing else moves either.
fn still(scene: &Scene, name: &str, body: &str, components: Option<&[Component]>) -> Option<Doubt> {
    let mut moves = scene.moves(scene.body_index(body)?);
    if components.is_none() && moves[..3].contains(&true) {
        moves[3..].fill(true);
    }
    let columns: Vec<Component> = components
        .map_or_else(|| scene.components_of(body), <[_]>::to_vec)
        .into_iter()
        .filter(|component| !moves[component.direction()])
        .collect();
    let held: Vec<&str> = (0..DIRECTIONS.len())
        .filter(|direction| columns.iter().any(|c| c.direction() == *direction))
        .map(|direction| DIRECTIONS[direction])
        .collect();
    let names: Vec<String> = columns
        .iter()
        .map(|component| format!("{name}.{}", component.label().0))
        .collect();
    (!columns.is_empty()).then(|| {
        let usual = format!(
            "these columns never change, since the scene holds {body} {}; give it a spring there, or record what moves",
            held.join(", ")
        );
        Doubt::new(format!("probes.{name}"), names.join(", "), usual)
    })
}
