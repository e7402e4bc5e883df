//! Where defects are placed that are to lie where contacts run.
//!
//! Runs, equilibria and explanations all place defects by this module.

use std::borrow::Cow;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::positions;
use crate::base::error::{Error, Result};
use crate::base::quantities;
use crate::contact::SurfaceDefect;
use crate::inspect;
use crate::model::{BodyId, Dof, Model, Race, ball_defect, compile_placed, race_defect};
use crate::scene::{AxialOffset, Defect, Row, Scene, Surface, TimeFunction, Width};

/// Where the number of a defect's axial place comes from.
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
/// Share of the contacts' scale from which a load counts: what lies below is left over from the solution.
const LOADED: f64 = 1e-9;

/// The scene with numbers for the axial place of every defect and for what its walls say, and where the places come from, by the
/// defects' names.
///
/// # Errors
/// [`crate::Error::Scene`] for a scene that is not usable.
pub fn place(scene: &Scene) -> Result<(Cow<'_, Scene>, BTreeMap<String, Placed>)> {
    let is_given = |defect: &Defect| defect.axial_offset.number().is_some() && !defect.is_steep();
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
        let meeting = DefectPasses::of(scene, defect)?;
        let row = &scene.rows[defect.row];
        if defect.is_steep() {
            let heaviest = meeting.as_ref().and_then(DefectPasses::half_width);
            wall(name, defect, row, heaviest)?;
        }
        if defect.axial_offset == AxialOffset::Contact {
            let (number, placed) = match meeting.and_then(|meeting| meeting.place(defect)) {
                Some(number) => (number, Placed::Contact),
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

/// Gives a defect between steep walls the fault circles that unload a contact of a half-width \[m\] as solids do (model section 15.5).
fn wall(name: &str, defect: &mut Defect, row: &Row, half_width: Option<f64>) -> Result<()> {
    let half = half_width.ok_or_else(|| {
        let allowed = "absent, since no loaded contact meets the defect at equilibrium: give width and edge_radius of its defect \
                       circles";
        Error::scene(format!("defects.{name}.walls"), "steep", allowed)
    })?;
    let width = defect.width.largest();
    if width < NARROWEST * half {
        let allowed = format!(
            "at least {} between steep walls, 1.25 times the width of its contact; a narrower one is a pit",
            quantities::length(NARROWEST * half)
        );
        return Err(Error::scene(
            format!("defects.{name}.width"),
            quantities::length(width),
            allowed,
        ));
    }
    defect.width = Width::Constant(in_nanometres(width + half));
    (defect.edge_radius, defect.walls) = (row.ball_diameter / 4.0, None);
    Ok(())
}

/// The healthy bearing at equilibrium, and the contacts that meet a defect over a turn of the balls.
pub(crate) struct DefectPasses {
    pub model: Model,
    /// A state vector with zero velocities.
    pub y: Vec<f64>,
    /// Ball among all balls, and race.
    pub contacts: Vec<(usize, Race)>,
}

impl DefectPasses {
    /// Under the largest value of every load, with a ball at the angle of a defect on the outer race; none without
    /// equilibrium.
    ///
    /// # Errors
    /// [`crate::Error::Scene`] for a scene that is not usable.
    pub fn of(scene: &Scene, defect: &Defect) -> Result<Option<Self>> {
        let mut healthy = scene.clone();
        healthy.defects.clear();
        for load in healthy.loads.values_mut() {
            load.force = TimeFunction::Constant(load.force.extreme());
        }
        for moment in healthy.moments.values_mut() {
            moment.moment = TimeFunction::Constant(moment.moment.extreme());
        }
        let stands = defect.on == Surface::OuterRace && scene.outer_speed.is_none();
        if stands {
            let turn = defect.angle - scene.rows[defect.row].start_angle;
            for row in &mut healthy.rows {
                row.start_angle += turn;
            }
        }
        let model = compile_placed(&healthy)?;
        let row = &model.rows[defect.row];
        let contacts = match defect.on {
            Surface::OuterRace if stands => vec![(row.first, Race::Outer)],
            Surface::OuterRace => row.balls().map(|j| (j, Race::Outer)).collect(),
            Surface::InnerRace => row.balls().map(|j| (j, Race::Inner)).collect(),
            Surface::Ball => {
                let both = |j| Race::BOTH.map(|race| (j, race));
                row.balls().flat_map(both).collect()
            }
        };
        match positions(&model) {
            Ok(y) => Ok(Some(Self { model, y, contacts })),
            Err(interrupted @ Error::Interrupted { .. }) => Err(interrupted),
            Err(_) => Ok(None),
        }
    }

    /// Load \[N\] of the most loaded of these contacts, and its race; none without load.
    fn heaviest(&self) -> Option<(f64, Race)> {
        let load = |&(j, race): &(usize, Race)| {
            (inspect::contact(&self.model, &self.y, j, race).load, race)
        };
        let loads = self.contacts.iter().map(load);
        let heaviest = loads.max_by(|a, b| a.0.total_cmp(&b.0));
        heaviest.filter(|(load, _)| *load > LOADED * self.model.scales.load)
    }

    /// A pit, compiled, with the load \[N\] of that contact and its race.
    pub fn pit(&self, defect: &Defect) -> Option<(SurfaceDefect, f64, Race)> {
        let (load, race) = self.heaviest()?;
        let row = &self.model.rows[defect.row];
        let geometry = &self.model.scene().rows[defect.row];
        let defect = if defect.on == Surface::Ball {
            ball_defect(defect, geometry.ball_diameter / 2.0, &row.hertz)
        } else {
            race_defect(defect, geometry, (&row.pairs[race], &row.hertz[race]))
        };
        Some((defect, load, race))
    }

    /// Half-width of that contact along rolling \[m\].
    fn half_width(&self) -> Option<f64> {
        let row = &self.model.rows[self.model.balls[self.contacts[0].0].row];
        let of = |(load, race): (f64, Race)| row.hertz[race].half_width * load.cbrt();
        self.heaviest().map(of)
    }

    /// Where the most loaded of these contacts runs, from the row's plane or the ball's centre \[m\]; none without load.
    fn place(&self, defect: &Defect) -> Option<f64> {
        let places = self.contacts.iter().map(|&(j, race)| {
            let contact = inspect::contact(&self.model, &self.y, j, race);
            let z = |body: BodyId| self.y[self.model.layout().at(body, Dof::Z)];
            let from = match defect.on {
                Surface::Ball => z(BodyId::ball(j)) - z(race.ring()),
                _ => self.model.scene().rows[defect.row].axial_position,
            };
            (contact.load, contact.zone_centre - from)
        });
        let (mut most, mut place) = (LOADED * self.model.scales.load, None);
        for (load, at) in places {
            if load > most {
                (most, place) = (load, Some(at));
            }
        }
        place
    }
}

/// Where a contact would run at the nominal contact angle \[m\]: at ±R sin α₀, on the inner race with its preload.
fn nominal(defect: &Defect, row: &Row) -> f64 {
    let side = f64::from(row.side);
    let place = side * row.ball_diameter / 2.0 * row.contact_angle.sin();
    match defect.on {
        Surface::OuterRace | Surface::Ball => place,
        Surface::InnerRace => side * row.axial_preload - place,
    }
}
