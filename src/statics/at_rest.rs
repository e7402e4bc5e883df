//! Answers to what compiling a scene asks of the bearing at rest.

use super::positions;
use crate::base::error::{Error, Result};
use crate::inspect;
use crate::model::{AtRest, BodyId, Dof, HeaviestContact, Model, Race, RaceLoads, compile_placed};
use crate::scene::{Defect, Scene, Surface, TimeFunction};

/// Share of the contacts' scale from which a load counts: what lies below is left over from the solution.
const LOADED: f64 = 1e-9;

/// Answers by the static equilibrium.
pub(super) struct Equilibria;

impl AtRest for Equilibria {
    fn loads(&self, model: &Model) -> Result<RaceLoads> {
        positions(model).map(|y| loads_of(model, &y))
    }

    fn heaviest(&self, scene: &Scene, defect: &Defect) -> Result<Option<HeaviestContact>> {
        let meeting = DefectPasses::of(scene, defect)?;
        Ok(meeting.and_then(|meeting| meeting.heaviest(defect)))
    }
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
    /// The bearing under the largest value of every load, with a ball at the angle of a defect on the outer race; none without
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

    /// The most loaded of these contacts; none without load.
    pub fn heaviest(self, defect: &Defect) -> Option<HeaviestContact> {
        let load = |&(j, race): &(usize, Race)| {
            (
                inspect::raw::contact(&self.model, &self.y, j, race).load,
                race,
            )
        };
        let loads = self.contacts.iter().map(load);
        let heaviest = loads.max_by(|a, b| a.0.total_cmp(&b.0));
        let (load, race) = heaviest.filter(|(load, _)| *load > LOADED * self.model.scales.load)?;
        Some(HeaviestContact {
            place: self.place(defect)?,
            model: self.model,
            load,
            race,
        })
    }

    /// Place at which the most loaded of these contacts runs, from the row's plane or the ball's centre \[m\]; none without load.
    fn place(&self, defect: &Defect) -> Option<f64> {
        let places = self.contacts.iter().map(|&(j, race)| {
            let contact = inspect::raw::contact(&self.model, &self.y, j, race);
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

/// ΣQ²/ΣQ over the contacts of every row and race (12.7). Those that differ by no more than what an equilibrium leaves count as one:
/// rows that are images of each other then have one film.
fn loads_of(model: &Model, y: &[f64]) -> RaceLoads {
    /// Share of a load; films go like its fifteenth root.
    const LEFT: f64 = 1e-6;
    let of_row = |row: usize| Race::BOTH.map(|race| weighted_load(model, y, row, race));
    let mut loads: RaceLoads = (0..model.rows.len()).map(of_row).collect();
    for row in 1..loads.len() {
        for race in Race::BOTH {
            let load = loads[row][race];
            let same = |of: &f64| (of - load).abs() <= LEFT * load;
            let known = loads[..row].iter().map(|of| of[race]).find(same);
            loads[row][race] = known.unwrap_or(load);
        }
    }
    loads
}

/// ΣQ²/ΣQ over a row's contacts with a race (12.7) \[N\].
fn weighted_load(model: &Model, y: &[f64], row: usize, race: Race) -> f64 {
    let (mut sum, mut squares) = (0.0, 0.0);
    for ball in model.rows[row].balls() {
        let load = inspect::raw::contact(model, y, ball, race).load;
        sum += load;
        squares += load * load;
    }
    if sum > 0.0 { squares / sum } else { 0.0 }
}

/// F. P. Wardle's rules for balls, which no scene has one by one.
#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Waves;
    use crate::model::{BodyId, Dof, compile_placed};
    use crate::scene::{Mount, Waviness, presets};

    /// Place of the inner ring of a 6205 at 10 degrees under thrust with a wave on ball 0, which lies on the x axis.
    fn stands(order: u32, amplitude: f64, phase: f64) -> [f64; 2] {
        let mut scene = presets::deep_groove_6205(0.0, 400.0, 0.0);
        (scene.gravity, scene.cage) = ([0.0; 3], None);
        let row = &mut scene.rows[0];
        (row.contact_angle, row.clearance, row.start_angle) = (10_f64.to_radians(), 0.0, 0.0);
        (row.outer_conformity, row.inner_conformity) = (0.525, 0.515);
        let held = &mut scene.outer_ring.support;
        (held.x, held.y, held.z) = (Some(Mount::Fixed), Some(Mount::Fixed), Some(Mount::Fixed));
        let mut model = compile_placed(&scene).unwrap();
        model.balls[0].side.waves = Waves::of(vec![Waviness::new(order, amplitude, phase)]);
        let y = positions(&model).unwrap();
        [Dof::X, Dof::Z].map(|dof| y[model.layout().at(BodyId::INNER, dof)])
    }

    #[test]
    fn even_waves_of_a_ball_move_the_rings() {
        let (alpha, epsilon) = (15.4157_f64.to_radians(), 0.014_070_6);
        let (sin, cos) = alpha.sin_cos();
        let (cot, tan) = (cos / sin, sin / cos);
        let axial = 2e-9 / (9.0 * sin) / (1.0 + epsilon * cot * cot);
        // Two lines of this size, while it leads the ring to and fro along its own direction.
        let radial = 2e-9 / (9.0 * cos) / (1.0 + epsilon * tan * tan);
        for order in [2, 8, 40] {
            let turned = |phase: f64| stands(order, 1e-9, phase);
            let (one, other) = (turned(0.0), turned(std::f64::consts::PI));
            let [x, z] = [0, 1].map(|i| 0.5 * (one[i] - other[i]).abs());
            assert!(
                (x / (2.0 * radial) - 1.0).abs() < 0.01,
                "{order}: {x:e} {radial:e}"
            );
            assert!((z / axial - 1.0).abs() < 0.01, "{order}: {z:e} {axial:e}");
        }
    }

    #[test]
    fn odd_waves_of_a_ball_move_nothing_to_first_order() {
        let moved = |amplitude: f64| {
            let (a, b) = (stands(5, amplitude, 0.3), stands(5, amplitude, 1.7));
            (a[0] - b[0]).hypot(a[1] - b[1])
        };
        let (much, little) = (moved(100e-9), moved(10e-9));
        assert!(little < 0.012 * much + 2e-15, "{much:e} {little:e}");
    }
}
