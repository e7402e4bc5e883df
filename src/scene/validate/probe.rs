//! Probes.

use super::check::numbers;
use crate::base::error::{Error, Result};
use crate::scene::numbers::BoundedNumber;
use crate::scene::{Component, Probe, Scene, SlicesProbe};

impl SlicesProbe {
    /// Numbers of the probe whose range depends on no other.
    pub(in crate::scene) fn numbers(&self) -> Vec<BoundedNumber> {
        BoundedNumber::each("times", &self.times, 0.0..=1e9, "s")
    }
}

fn known_body(scene: &Scene, path: &str, body: &str) -> Result<()> {
    let known = "\"outer\", \"inner\" or a ball of a row such as \"row0.ball3\"";
    let unknown = || Error::scene(format!("{path}.body"), body, known);
    scene.body_index(body).map(|_| ()).ok_or_else(unknown)
}

pub(super) fn probe(scene: &Scene, path: &str, probe: &Probe) -> Result<()> {
    match probe {
        Probe::Motion(of) => {
            let path = format!("{path}.motion");
            known_body(scene, &path, &of.body)?;
            let components = of.components.as_deref().unwrap_or_default();
            of_body(scene, &path, &of.body, components)
        }
        Probe::Forces { body } => known_body(scene, &format!("{path}.forces"), body),
        Probe::Cage { row } => scene.row_index(&format!("{path}.cage"), *row).map(|_| ()),
        Probe::Lubrication { row } => lubricated(scene, &format!("{path}.lubrication"), *row),
        Probe::Energy {} | Probe::Torque {} | Probe::Moments {} => Ok(()),
        Probe::Structure { sensors } => {
            of_structure(scene, &format!("{path}.structure"), sensors.as_deref())
        }
        Probe::Seat {} => of_structure(scene, &format!("{path}.seat"), None),
        Probe::Contacts(of) => {
            let path = format!("{path}.contacts");
            chosen(scene, &path, of.row, of.balls.as_deref())
        }
        Probe::Slices(of) => {
            let path = format!("{path}.slices");
            numbers(&path, of.numbers())?;
            chosen(scene, &path, of.row, of.balls.as_deref())
        }
    }
}

/// Balls have no tilt, and only balls that spin freely turn about x and y.
fn of_body(scene: &Scene, path: &str, body: &str, components: &[Component]) -> Result<()> {
    let is_ring = ["outer", "inner"].contains(&body);
    for component in components {
        let allowed = if Component::OF_TILTS.contains(component) && !is_ring {
            format!("a component of {body}, which has no tilt")
        } else if Component::OF_TURNS.contains(component) && is_ring {
            format!("a component of {body}; turns about x and y are recorded of balls only")
        } else if Component::OF_TURNS.contains(component) && !scene.balls_turn() {
            format!(r#"a component of {body}; turns about x and y need spin = "free""#)
        } else {
            continue;
        };
        let path = format!("{path}.components");
        return Err(Error::scene(path, component.label().0, allowed));
    }
    Ok(())
}

/// There is a structure, with the sensors that are asked for.
fn of_structure(scene: &Scene, path: &str, sensors: Option<&[String]>) -> Result<()> {
    let Some(structure) = &scene.structure else {
        let allowed = "a probe of a scene with a structure: give the scene a `structure`";
        return Err(Error::scene(path, "no structure", allowed));
    };
    let known = structure.sensors();
    let mut asked = sensors.unwrap_or_default().iter();
    match asked.find(|name| !known.contains(name.as_str())) {
        None => Ok(()),
        Some(name) => {
            let known: Vec<_> = known.into_iter().collect();
            let allowed = format!("sensors of the structure: {}", known.join(", "));
            Err(Error::scene(format!("{path}.sensors"), name, allowed))
        }
    }
}

fn lubricated(scene: &Scene, path: &str, row: usize) -> Result<()> {
    let of = scene.row_index(path, row)?;
    if scene.lubricant_of(of).is_some() {
        return Ok(());
    }
    let allowed =
        format!("a row with a lubricant: give the scene a `lubricant`, or rows[{row}] one");
    Err(Error::scene(format!("{path}.row"), row, allowed))
}

fn chosen(scene: &Scene, path: &str, row: usize, balls: Option<&[usize]>) -> Result<()> {
    let count = scene.row_index(path, row)?.ball_count;
    match balls
        .unwrap_or_default()
        .iter()
        .find(|&&ball| ball >= count)
    {
        Some(ball) => Err(Error::scene(
            format!("{path}.balls"),
            ball,
            format!("balls from 0 to {}", count - 1),
        )),
        None => Ok(()),
    }
}
