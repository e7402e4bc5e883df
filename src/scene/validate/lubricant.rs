//! Oil between balls and races.

use std::ops::RangeInclusive;

use super::check::{positive, up_to, within};
use crate::base::error::{Error, Result};
use crate::base::quantities::number;
use crate::scene::{Lubricant, OilLayer, Scene, Sourced};

/// Temperatures at which the formulas of oils hold \[K\].
const TEMPERATURES: RangeInclusive<f64> = 233.0..=473.0;
/// Viscosities \[m²/s\] from the lower limit of ASTM D341 to that above which no oil flows into a contact.
const VISCOSITIES: RangeInclusive<f64> = 0.3e-6..=0.1;

impl Lubricant {
    /// Reads a lubricant from JSON and checks it.
    ///
    /// # Errors
    /// [`Error::Scene`] names the first field, as of a scene's `lubricant`, that is unknown, missing or not usable.
    pub fn from_json(text: &str) -> Result<Self> {
        let path = "lubricant";
        let document = serde_json::from_str(text)
            .map_err(|e| Error::scene(path, "not JSON", e.to_string()))?;
        let lubricant = crate::scene::interpret(&document, path)?;
        alone(path, &lubricant)?;
        Ok(lubricant)
    }
}

/// The lubricants of a scene and of its rows.
pub(super) fn lubricants(scene: &Scene) -> Result<()> {
    let of_rows = scene.rows.iter().enumerate().filter_map(|(i, row)| {
        let own = row.lubricant.as_ref()?;
        Some((format!("rows[{i}].lubricant"), own))
    });
    let of_scene = scene.lubricant.iter().map(|own| ("lubricant".into(), own));
    for (path, lubricant) in of_scene.chain(of_rows) {
        alone(&path, lubricant)?;
        // A speed of denormal numbers is none, either.
        if !scene.reference_speed_of(lubricant).is_normal() {
            return Err(Error::scene(
                format!("{path}.reference_speed"),
                "absent",
                "a relative speed of the rings above 0 [rad/s], since the scene gives them none",
            ));
        }
    }
    Ok(())
}

/// A lubricant, whatever turns the bearing.
fn alone(path: &str, lubricant: &Lubricant) -> Result<()> {
    oil(path, lubricant)?;
    let at = |field: &str| format!("{path}.{field}");
    fraction(&at("boundary_friction"), lubricant.boundary_friction)?;
    within(
        &at("conductivity"),
        lubricant.conductivity,
        1e-3..=1e3,
        "W/(m K)",
    )?;
    up_to(&at("roughness"), lubricant.roughness, 1.0, "m")?;
    if let OilLayer::Thickness(layer) = lubricant.oil_layer {
        up_to(&at("oil_layer"), layer, 1.0, "m")?;
    }
    within(&at("hysteresis"), lubricant.hysteresis, 0.0..=1.0, "")?;
    within(&at("slip_floor"), lubricant.slip_floor, 1e-9..=1e3, "m/s")?;
    within(&at("fill"), lubricant.fill, 0.0..=1.0, "")?;
    for (field, value, unit) in [
        ("damping_frequency", lubricant.damping_frequency, "Hz"),
        ("reference_speed", lubricant.reference_speed, "rad/s"),
        ("reference_load", lubricant.reference_load, "N"),
    ] {
        if let Some(value) = value {
            positive(&at(field), value, unit)?;
        }
    }
    Ok(())
}

/// Check of the oil, by name or as given.
fn oil(path: &str, lubricant: &Lubricant) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    let temperature = lubricant.temperature;
    if !TEMPERATURES.contains(&temperature) {
        let allowed = "from 233 to 473 K, which is -40 to 200 °C";
        return Err(Error::scene(at("temperature"), temperature, allowed));
    }
    let sheet = lubricant.sheet_at(path)?;
    viscosity(&at("viscosity_40"), sheet.viscosity_40)?;
    viscosity(&at("viscosity_100"), sheet.viscosity_100)?;
    let [warm, hot] = [sheet.viscosity_40.value, sheet.viscosity_100.value];
    if warm <= hot {
        let allowed = format!("below viscosity_40, {} m²/s", number(warm));
        return Err(Error::scene(at("viscosity_100"), hot, allowed));
    }
    let [thick, _] = sheet.kinematic_viscosity(temperature);
    if thick > *VISCOSITIES.end() {
        let allowed = format!(
            "warm enough for the oil to flow: it would have {} m²/s",
            number(thick)
        );
        return Err(Error::scene(at("temperature"), temperature, allowed));
    }
    within(
        &at("density_15"),
        sheet.density_15.value,
        100.0..=1e4,
        "kg/m³",
    )?;
    if let Some(coefficient) = sheet.pressure_viscosity {
        within(&at("pressure_viscosity"), coefficient, 1e-10..=1e-6, "1/Pa")?;
    }
    fraction(&at("limiting_stress"), sheet.limiting_stress.value)
}

fn viscosity(path: &str, viscosity: Sourced) -> Result<()> {
    if VISCOSITIES.contains(&viscosity.value) {
        return Ok(());
    }
    let allowed = "from 3e-7 to 0.1 m²/s; a viscosity of 68 mm²/s is 68e-6";
    Err(Error::scene(path, viscosity.value, allowed))
}

/// A coefficient of friction.
fn fraction(path: &str, value: f64) -> Result<()> {
    if value > 0.0 && value < 0.5 {
        return Ok(());
    }
    Err(Error::scene(path, value, "above 0 and below 0.5"))
}
