//! Places of defects that are to lie where contacts run.
//!
//! Runs, equilibria and explanations all place defects by this module.

use std::borrow::Cow;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::at_rest::{AtRest, HeaviestContact};
use crate::base::error::{Error, Result};
use crate::base::quantities;
use crate::scene::{AxialOffset, Damage, Defect, Patch, Row, Scene, SteepPatch, Surface};

/// Origin of the number of a defect's axial place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Placed {
    /// The scene gave it.
    Given,
    /// A contact runs there at equilibrium.
    Contact,
    /// The nominal contact angle: there is no equilibrium, or no load on the contacts that meet the defect.
    Nominal,
}

/// Places are rounded to a nanometre: a level groove gives 0, and rows that are images keep being so \[1/m\].
const FINEST: f64 = 1e9;
/// Half-widths of its contact from which a slot between steep walls unloads it as a solver by boundary elements does: 164 N of 250 N by 2.5 of
/// them (here 169), 65 N by 1.5 (here 28).
const NARROWEST: f64 = 2.5;

/// The scene with numbers for the axial place of every defect and for what its walls say, and where the places come from, by the
/// defects' names.
///
/// # Errors
/// [`crate::Error::Scene`] for a scene that is not usable.
pub(crate) fn place<'s>(
    scene: &'s Scene,
    rest: &dyn AtRest,
) -> Result<(Cow<'s, Scene>, BTreeMap<String, Placed>)> {
    let is_given = |defect: &Defect| {
        let waits = matches!(defect.damage, Damage::SteepPatch(_));
        defect.axial_offset.number().is_some() && !waits
    };
    let mut from: BTreeMap<String, Placed> = scene
        .defects
        .keys()
        .map(|name| (name.clone(), Placed::Given))
        .collect();
    if scene.defects.values().all(is_given) {
        return Ok((Cow::Borrowed(scene), from));
    }
    scene.validate()?;
    let mut all = scene.clone();
    for (name, defect) in &mut all.defects {
        if is_given(defect) {
            continue;
        }
        let heaviest = rest.heaviest(scene, defect)?;
        let row = &scene.rows[defect.row];
        let half_width = |of: &HeaviestContact| of.half_width(defect.row);
        let half_width = heaviest.as_ref().map(half_width);
        if let Some(patch) = between_walls(name, &defect.damage, row, half_width)? {
            defect.damage = patch;
        }
        if defect.axial_offset == AxialOffset::Contact {
            let (number, placed) = match heaviest {
                Some(contact) => (contact.place, Placed::Contact),
                None => (nominal(defect, row), Placed::Nominal),
            };
            defect.axial_offset = in_nanometres(number).into();
            from.insert(name.clone(), placed);
        }
    }
    Ok((Cow::Owned(all), from))
}

fn in_nanometres(number: f64) -> f64 {
    // The sum makes a negative zero a plain one.
    (number * FINEST).round() / FINEST + 0.0
}

/// The patch whose fault circles unload a contact of a half-width \[m\] as solids between steep walls do
/// ([*Defects*](crate::equations#defects)); none for a damage without such walls.
fn between_walls(
    name: &str,
    damage: &Damage,
    row: &Row,
    half_width: Option<f64>,
) -> Result<Option<Damage>> {
    let Damage::SteepPatch(SteepPatch {
        length,
        width,
        floor,
    }) = damage
    else {
        return Ok(None);
    };
    let half = half_width.ok_or_else(|| {
        let allowed = "absent, since no loaded contact meets the defect at equilibrium: give width and edge_radius of its defect \
                       circles";
        Error::scene(format!("defects.{name}.walls"), "steep", allowed)
    })?;
    if *width < NARROWEST * half {
        let allowed = format!(
            "at least {} between steep walls, 1.25 times the width of its contact; a narrower one is a pit",
            quantities::length(NARROWEST * half)
        );
        return Err(Error::scene(
            format!("defects.{name}.width"),
            quantities::length(*width),
            allowed,
        ));
    }
    let patch = Patch {
        length: *length,
        width: in_nanometres(width + half).into(),
        edge_radius: row.ball_diameter / 4.0,
        floor: floor.clone(),
    };
    Ok(Some(patch.into()))
}

/// Place where a contact would run at the nominal contact angle \[m\]: at ±R sin α₀, on the inner race with its preload.
fn nominal(defect: &Defect, row: &Row) -> f64 {
    let side = f64::from(row.side);
    let place = side * row.ball_diameter / 2.0 * row.contact_angle.sin();
    match defect.on {
        Surface::OuterRace | Surface::Ball => place,
        Surface::InnerRace => side * row.axial_preload - place,
    }
}
