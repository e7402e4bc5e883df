//! Materials, normal law and friction.

use super::check::numbers;
use crate::base::error::{Error, Result};
use crate::scene::contact::extreme_slip;
use crate::scene::{Contact, Friction, Materials, Row};

pub(super) fn materials(materials: &Materials) -> Result<()> {
    numbers("materials.rings", materials.rings.numbers())?;
    numbers("materials.balls", materials.balls.numbers())
}

/// Contact, friction and material that a row has of its own.
pub(super) fn of_row(path: &str, row: &Row) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    if let Some(own) = &row.ball_material {
        numbers(&at("ball_material"), own.numbers())?;
    }
    if let Some(own) = &row.contact {
        contact(&at("contact"), own)?;
    }
    match &row.friction {
        Some(own) => friction(&at("friction"), own),
        None => Ok(()),
    }
}

pub(super) fn contact(path: &str, contact: &Contact) -> Result<()> {
    let (law, of_law) = contact.law.numbers();
    numbers(&format!("{path}.law.{law}"), of_law)?;
    numbers(&format!("{path}.slices"), [contact.slices.numbers()])?;
    if let Some(film) = &contact.squeeze {
        numbers(&format!("{path}.squeeze"), film.numbers())?;
    }
    numbers(path, contact.numbers())
}

pub(super) fn friction(path: &str, friction: &Friction) -> Result<()> {
    let Some((law, of_law)) = friction.numbers() else {
        return Ok(());
    };
    numbers(&format!("{path}.{law}"), of_law)?;
    match *friction {
        Friction::Traction { a, b, c, d, .. } => traction(path, [a, b, c, d]),
        _ => Ok(()),
    }
}

/// Dissipation must not be negative: μ(u) ≥ 0 at its ends and at its only stationary point.
fn traction(path: &str, [a, b, c, d]: [f64; 4]) -> Result<()> {
    for u in [0.0, extreme_slip([a, b, c])] {
        let mu = (a + b * u) * (-c * u).exp() + d;
        if mu < 0.0 {
            return Err(Error::scene(
                format!("{path}.traction"),
                format!("μ({u} m/s) = {mu}"),
                "coefficients with μ ≥ 0 at every slip",
            ));
        }
    }
    if c == 0.0 && b < 0.0 {
        return Err(Error::scene(
            format!("{path}.traction.b"),
            b,
            "at least 0 when c is 0",
        ));
    }
    Ok(())
}
