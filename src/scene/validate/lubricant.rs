//! Oil between balls and races.

use super::check::numbers;
use crate::base::error::{Error, Result};
use crate::base::quantities::number;
use crate::scene::{Lubricant, Scene};

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
    numbers(path, lubricant.numbers())
}

/// Check of the oil, by name or as given.
fn oil(path: &str, lubricant: &Lubricant) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    let temperature = lubricant.temperature;
    numbers(path, lubricant.numbers_of_oil())?;
    let sheet = lubricant.sheet_at(path)?;
    let [warm, hot] = [sheet.viscosity_40.value, sheet.viscosity_100.value];
    if warm <= hot {
        let allowed = format!("below viscosity_40, {} m²/s", number(warm));
        return Err(Error::scene(at("viscosity_100"), hot, allowed));
    }
    let [thick, _] = sheet.kinematic_viscosity(temperature);
    if thick > *Lubricant::VISCOSITIES.end() {
        let allowed = format!(
            "warm enough for the oil to flow: it would have {} m²/s",
            number(thick)
        );
        return Err(Error::scene(at("temperature"), temperature, allowed));
    }
    Ok(())
}
