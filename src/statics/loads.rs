//! What follows from the contact loads at the equilibrium of round races without oil: how contacts average waves, and films.

use super::positions;
use crate::base::error::{Error, Result};
use crate::inspect;
use crate::model::{Model, Race};
use crate::scene::Row;

/// Loads of contacts by row and race \[N\].
type RaceLoads = Vec<[f64; 2]>;

/// Whether a row needs a load.
#[derive(Clone, Copy, PartialEq)]
enum Need {
    Nothing,
    /// It gives one \[N\].
    Given(f64),
    /// That of its equilibrium.
    Equilibrium,
}

impl Need {
    /// Of a row that may give a load.
    fn unless(given: Option<f64>) -> Self {
        given.map_or(Self::Equilibrium, Self::Given)
    }
}

/// What rows need a load for, and which of them do.
struct Needs<'a> {
    what: &'a str,
    rows: Vec<Need>,
    path: &'a dyn Fn(usize) -> String,
}

/// Gives a model the waves and the films of its scene.
///
/// # Errors
/// [`Error::Scene`] where there is no equilibrium and a lubricant or a texture gives no reference load.
pub(super) fn finished(mut model: Model) -> Result<Model> {
    let scene = model.scene.clone();
    let rows = |of: &dyn Fn(&Row) -> Need| scene.rows.iter().map(of).collect();
    let texture = |row: &Row| row.texture.as_ref().and_then(|of| of.reference_load);
    let waves = Needs {
        what: "the width of contacts",
        rows: rows(&|row| {
            if row.is_wavy() {
                Need::unless(texture(row))
            } else {
                Need::Nothing
            }
        }),
        path: &|row| format!("rows[{row}].texture"),
    };
    let film = |row: &Row| {
        let lubricant = scene.lubricant_of(row).filter(|of| of.acts());
        lubricant.map_or(Need::Nothing, |of| Need::unless(of.reference_load))
    };
    let films = Needs {
        what: "the film",
        rows: rows(&film),
        path: &|row| scene.lubricant_path(row),
    };
    let solved = if waves.asks() || films.asks() {
        positions(&model).map(|y| loads_of(&model, &y))
    } else {
        Ok(Vec::new())
    };
    if waves.are_any() {
        let loads = match &solved {
            // Listed waves take the typical load.
            Err(Error::Equilibrium { .. })
                if scene.rows.iter().all(|row| row.texture.is_none()) =>
            {
                vec![[model.scales.load; 2]; scene.rows.len()]
            }
            _ => waves.loads(&solved)?,
        };
        model.give_waves(&loads)?;
    }
    if films.are_any() {
        model.lubricate(&films.loads(&solved)?)?;
    }
    Ok(model)
}

impl Needs<'_> {
    /// Whether any row needs a load.
    fn are_any(&self) -> bool {
        self.rows.iter().any(|need| *need != Need::Nothing)
    }

    /// Whether any row needs one that it does not give.
    fn asks(&self) -> bool {
        self.rows.contains(&Need::Equilibrium)
    }

    /// The loads that are given, and else those of the equilibrium.
    fn loads(&self, solved: &Result<RaceLoads>) -> Result<RaceLoads> {
        let of_row = |(row, need): (usize, &Need)| match (need, solved) {
            (Need::Nothing, _) => Ok([0.0; 2]),
            (Need::Given(load), _) => Ok([*load; 2]),
            (Need::Equilibrium, Ok(loads)) => Ok(loads[row]),
            (Need::Equilibrium, Err(interrupted @ Error::Interrupted { .. })) => {
                Err(interrupted.clone())
            }
            (Need::Equilibrium, Err(error)) => Err(Error::scene(
                format!("{}.reference_load", (self.path)(row)),
                "absent",
                format!(
                    "a load [N], since {} cannot be computed for the loads of the equilibrium: {error}",
                    self.what
                ),
            )),
        };
        self.rows.iter().enumerate().map(of_row).collect()
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
        let load = inspect::contact(model, y, ball, race).load;
        sum += load;
        squares += load * load;
    }
    if sum > 0.0 { squares / sum } else { 0.0 }
}

/// F. P. Wardle's rules for balls (model section 14.6), which no scene has one by one.
#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Waves;
    use crate::model::{BodyId, Dof, compile_placed};
    use crate::scene::{Mount, Waviness, presets};

    /// Where the inner ring of a 6205 at 10 degrees under thrust stands with a wave on ball 0, which lies on the x axis.
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
