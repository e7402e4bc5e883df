//! Where defects are placed that are to lie where contacts run.
//!
//! This stands between a scene and its model: a model knows numbers only, and every model of a user's scene is made
//! here, so that a run, an equilibrium and an explanation place a defect alike.

use std::borrow::Cow;
use std::collections::BTreeMap;

use serde::Serialize;

use super::{loads, positions};
use crate::base::error::{Error, Result};
use crate::base::quantities::number;
use crate::inspect;
use crate::model::{BodyId, Dof, Model, Race, ball_fault, compile_placed, race_fault};
use crate::scene::{AxialOffset, Defect, Row, Scene, Surface, TimeFunction};

/// Where the number of a defect's axial place comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
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
/// Share of the contacts' scale from which a load counts: what lies below is left over from the solution.
const LOADED: f64 = 1e-9;

/// Checks a scene, places the defects that are to lie where contacts run, and compiles it.
///
/// # Errors
/// [`crate::Error::Scene`] names the first field that is not usable, or the environment variable `BALLRACE_SIMD` where it
/// names no level of this processor.
pub fn compile(scene: &Scene) -> Result<Model> {
    let (placed, _) = place(scene)?;
    let model = compile_placed(&placed)?;
    check_pits(&placed)?;
    loads::finished(model)
}

/// Refuses pits that are too large for the heaviest static contact that meets them; where there is none they are taken as they are.
fn check_pits(scene: &Scene) -> Result<()> {
    for (name, defect) in scene.defects.iter().filter(|(_, defect)| defect.is_pit()) {
        let Some(meeting) = DefectPasses::of(scene, defect)? else {
            continue;
        };
        let model = &meeting.model;
        let load = |(j, race): &(usize, Race)| inspect::contact(model, &meeting.y, *j, *race).load;
        let loads = meeting
            .contacts
            .iter()
            .map(|contact| (load(contact), contact.1));
        let heaviest = loads.max_by(|a, b| a.0.total_cmp(&b.0));
        let row = &model.rows[defect.row];
        let geometry = &scene.rows[defect.row];
        let compiled = if defect.on == Surface::Ball {
            ball_fault(defect, geometry.ball_diameter / 2.0, &row.hertz)
        } else {
            let race = heaviest.map_or(Race::Outer, |(_, race)| race);
            race_fault(defect, geometry, (&row.pairs[race], &row.hertz[race]))
        };
        if let Some((load, race)) = heaviest
            && load > LOADED * model.scales.load
            && compiled.outgrows(&row.hertz[race], load)
        {
            return Err(Error::scene(
                format!("defects.{name}.width"),
                defect.width.largest(),
                format!(
                    "smaller than its contact, which bears {} N: what is larger is a spall, with an edge radius",
                    number(load)
                ),
            ));
        }
    }
    Ok(())
}

/// The scene with a number for the axial place of every defect, and where the numbers come from, by the defects' names.
///
/// # Errors
/// [`crate::Error::Scene`] for a scene that is not usable.
pub fn place(scene: &Scene) -> Result<(Cow<'_, Scene>, BTreeMap<String, Placed>)> {
    let is_given = |defect: &Defect| defect.axial_offset != AxialOffset::Contact;
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
        let found = DefectPasses::of(scene, defect)?.and_then(|meeting| meeting.place(defect));
        let (number, placed) = match found {
            Some(number) => (number, Placed::Contact),
            None => (nominal(defect, &scene.rows[defect.row]), Placed::Nominal),
        };
        // The sum makes a negative zero a plain one.
        defect.axial_offset = ((number * FINEST).round() / FINEST + 0.0).into();
        from.insert(name.clone(), placed);
    }
    Ok((Cow::Owned(all), from))
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
        if defect.on == Surface::OuterRace {
            let turn = defect.angle - scene.rows[defect.row].start_angle;
            for row in &mut healthy.rows {
                row.start_angle += turn;
            }
        }
        let model = compile_placed(&healthy)?;
        let row = &model.rows[defect.row];
        let contacts = match defect.on {
            Surface::OuterRace => vec![(row.first, Race::Outer)],
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

    /// Where the most loaded of these contacts runs, from the row's plane or the ball's centre \[m\]; none without load.
    fn place(&self, defect: &Defect) -> Option<f64> {
        let told = self.contacts.iter().map(|&(j, race)| {
            let contact = inspect::contact(&self.model, &self.y, j, race);
            let z = |body: BodyId| self.y[self.model.layout().at(body, Dof::Z)];
            let from = match defect.on {
                Surface::Ball => z(BodyId::ball(j)) - z(race.ring()),
                _ => self.model.scene().rows[defect.row].axial_position,
            };
            (contact.load, contact.zone_centre - from)
        });
        let (mut most, mut place) = (LOADED * self.model.scales.load, None);
        for (load, at) in told {
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
