//! Materials, normal law and friction.

use super::check::{numbers, positive, within};
use crate::base::error::{Error, Result};
use crate::scene::contact::extreme_slip;
use crate::scene::{Contact, Friction, Material, Materials, Row, Slices};

pub(super) fn materials(materials: &Materials) -> Result<()> {
    material("materials.rings", &materials.rings)?;
    material("materials.balls", &materials.balls)
}

/// Contact, friction and material that a row has of its own.
pub(super) fn of_row(path: &str, row: &Row) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    if let Some(own) = &row.ball_material {
        material(&at("ball_material"), own)?;
    }
    if let Some(own) = &row.contact {
        contact(&at("contact"), own)?;
    }
    match &row.friction {
        Some(own) => friction(&at("friction"), own),
        None => Ok(()),
    }
}

fn material(path: &str, material: &Material) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    within(&at("density"), material.density, 1.0..=1e6, "kg/m³")?;
    within(
        &at("youngs_modulus"),
        material.youngs_modulus,
        1e3..=1e15,
        "Pa",
    )?;
    within(
        &at("poisson_ratio"),
        material.poisson_ratio,
        0.0..=0.499,
        "",
    )
}

pub(super) fn contact(path: &str, contact: &Contact) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    numbers(&at("law"), contact.law.numbers())?;
    match contact.slices {
        Slices::Fixed(n) if !(10..=100_000).contains(&n) => {
            Err(Error::scene(at("slices.fixed"), n, "10 to 100000"))
        }
        Slices::Fitted(n) if !(2..=64).contains(&n) => {
            Err(Error::scene(at("slices.fitted"), n, "2 to 64"))
        }
        Slices::Accuracy(a) if !(1e-9..=1e-1).contains(&a) => {
            Err(Error::scene(at("slices.accuracy"), a, "from 1e-9 to 0.1"))
        }
        _ => within(&at("damping"), contact.damping, 0.0..=1e3, "s/m"),
    }
}

pub(super) fn friction(path: &str, friction: &Friction) -> Result<()> {
    let Some(numbers) = friction.numbers() else {
        return Ok(());
    };
    let at = |field: &str| format!("{path}.{}.{field}", numbers.law);
    for (field, value) in &numbers.fields {
        match *field {
            "stribeck_speed" => positive(&at(field), *value, "m/s")?,
            // A traction curve may begin at or fall to less than nothing, if another part makes up for it.
            "a" | "b" => within(&at(field), *value, -1e6..=1e6, "")?,
            _ => within(&at(field), *value, 0.0..=1e6, "")?,
        }
    }
    within(&at("slip_speed"), numbers.slip_speed, 1e-9..=1e3, "m/s")?;
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
