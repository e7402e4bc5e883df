//! The questions as others ask them: about a state of theirs, which is checked first.

use super::{ContactSummary, Energy, Lubrication, SliceForce, raw};
use crate::base::error::{Error, Result};
use crate::model::{Model, Race, StructureModel};

/// A contact in a few numbers: ball `j` among all balls on a race.
///
/// # Errors
/// [`Error::Argument`] for a state `y` that is not as long as [`Model::dim`], or a ball that is not there.
pub fn contact(model: &Model, y: &[f64], j: usize, race: Race) -> Result<ContactSummary> {
    check_length(model, y)?;
    check_index("j", j, model.balls.len(), "balls")?;
    Ok(raw::contact(model, y, j, race))
}

/// The forces of the slices of one contact, in order of ζ; on a defect a slice may appear more than once.
///
/// # Errors
/// As [`contact()`].
pub fn slice_forces(model: &Model, y: &[f64], j: usize, race: Race) -> Result<Vec<SliceForce>> {
    check_length(model, y)?;
    check_index("j", j, model.balls.len(), "balls")?;
    Ok(raw::slice_forces(model, y, j, race))
}

/// Energies and dissipated powers of a state.
///
/// # Errors
/// [`Error::Argument`] for a state `y` that is not as long as [`Model::dim`].
pub fn energy(model: &Model, y: &[f64]) -> Result<Energy> {
    check_length(model, y)?;
    Ok(raw::energy(model, y))
}

/// Forces of the cage links of a row, positive in tension, or of the pockets of a ring on its balls, positive on one that leads \[N\]; empty
/// without a cage.
///
/// # Errors
/// [`Error::Argument`] for a state `y` that is not as long as [`Model::dim`], or a row that is not there.
pub fn cage_forces(model: &Model, y: &[f64], row: usize) -> Result<Vec<f64>> {
    check_length(model, y)?;
    check_index("row", row, model.rows.len(), "rows")?;
    Ok(raw::cage_forces(model, y, row))
}

/// Films and losses of a row's oil in a state.
///
/// # Errors
/// As [`cage_forces()`].
pub fn lubrication(model: &Model, y: &[f64], row: usize) -> Result<Lubrication> {
    check_length(model, y)?;
    check_index("row", row, model.rows.len(), "rows")?;
    Ok(raw::lubrication(model, y, row))
}

/// Moments about x and y that balls and loads put on outer and inner ring at a time \[s\], each about its centre of mass and across
/// its axis \[N m\]: of the balls a sum over contacts of −(c_b − c_r) × f, less what turns them. What keeps the ring from tilting
/// carries them.
///
/// # Errors
/// As [`energy()`].
pub fn moments(model: &Model, t: f64, y: &[f64]) -> Result<[[f64; 2]; 2]> {
    check_length(model, y)?;
    Ok(raw::moments(model, t, y))
}

/// Wrench of the balls on a ring in a state of all bodies: force along x, y and z \[N\], moment about the ring's centre of mass \[N m\].
///
/// # Errors
/// As [`energy()`].
pub fn wrench(model: &Model, y: &[f64], race: Race) -> Result<[f64; 6]> {
    check_length(model, y)?;
    Ok(raw::wrench(model, y, race))
}

/// Force of the outer ring on the seat of a structure in a state, along x, y and z \[N\]; 0 without a structure.
///
/// # Errors
/// As [`energy()`].
pub fn seat_force(model: &Model, y: &[f64]) -> Result<[f64; 3]> {
    check_length(model, y)?;
    let force = |structure: &StructureModel| structure.force(structure.stretch(model.layout(), y));
    Ok(model
        .structure
        .as_ref()
        .map_or([0.0; 3], |of| force(of).into()))
}

/// Acceleration of a sensor of the structure along x, y and z \[m/s²\], by the rates of a state; 0 of one that there is not.
///
/// # Errors
/// As [`energy()`], of the `rates`.
pub fn sensor_acceleration(model: &Model, rates: &[f64], sensor: &str) -> Result<[f64; 3]> {
    check_length(model, rates)?;
    let (layout, half) = (model.layout(), rates.len() / 2);
    let found = model.structure.as_ref();
    let found =
        found.map(|of| StructureModel::at_sensor(layout, &of.shapes(sensor), &rates[half..]));
    Ok(found.map_or([0.0; 3], Into::into))
}

fn check_length(model: &Model, y: &[f64]) -> Result<()> {
    if y.len() == model.dim() {
        return Ok(());
    }
    let allowed = format!("{} numbers, named by the model", model.dim());
    Err(Error::argument(
        "y",
        format!("{} numbers", y.len()),
        allowed,
    ))
}

fn check_index(name: &str, value: usize, count: usize, of: &str) -> Result<()> {
    if value < count {
        return Ok(());
    }
    let allowed = format!("below {count}, the number of {of}");
    Err(Error::argument(name, value, allowed))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::presets;
    use crate::statics::compile;
    use crate::statics::start::{Start, start};

    /// A state of another length, which has its speeds elsewhere, and what is not there are refused by every question.
    #[test]
    fn what_does_not_fit_the_model_is_refused() {
        let model = compile(&presets::deep_groove_6205(500.0, 0.0, 1800.0)).unwrap();
        let y = start(&model, &Start::Rolling).unwrap();
        let words = |y: &[f64], j: usize| {
            let race = Race::Outer;
            [
                contact(&model, y, j, race).map(|_| ()),
                slice_forces(&model, y, j, race).map(|_| ()),
                cage_forces(&model, y, j).map(|_| ()),
                lubrication(&model, y, j).map(|_| ()),
                energy(&model, y).map(|_| ()),
                moments(&model, 0.0, y).map(|_| ()),
                wrench(&model, y, race).map(|_| ()),
                seat_force(&model, y).map(|_| ()),
                sensor_acceleration(&model, y, "top").map(|_| ()),
            ]
            .map(|answer| answer.map_err(|error| error.to_string()).err())
        };
        assert_eq!(words(&y, 0), [const { None }; 9]);
        for count in [0, 10, y.len() - 8, y.len() + 8] {
            let other = vec![0.0; count];
            let refused = format!(
                "y = {count} numbers: {} numbers, named by the model",
                y.len()
            );
            assert!(
                words(&other, 0)
                    .iter()
                    .all(|text| text.as_ref() == Some(&refused))
            );
        }
        let missing = words(&y, 9).map(Option::unwrap_or_default);
        assert!(
            missing[..2]
                .iter()
                .all(|text| text == "j = 9: below 9, the number of balls")
        );
        assert!(
            missing[2..4]
                .iter()
                .all(|text| text == "row = 9: below 1, the number of rows")
        );
    }
}
