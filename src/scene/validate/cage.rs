//! The cage.

use super::check::numbers;
use crate::base::error::{Error, Result};
use crate::base::quantities::{length, number};
use crate::scene::{Cage, CageGuidance, CageRing, Scene};

pub(super) fn cage(scene: &Scene, cage: &Cage) -> Result<()> {
    match cage {
        Cage::Links(links) => numbers("cage", links.numbers()),
        Cage::Ring { ring: of } => ring(scene, of),
    }
}

fn ring(scene: &Scene, ring: &CageRing) -> Result<()> {
    numbers("cage.ring", ring.numbers())?;
    let at = |field: &str| format!("cage.ring.{field}");
    for (i, row) in scene.rows.iter().enumerate() {
        let (d, count) = (row.ball_diameter, row.ball_count);
        let clearance = ring.pocket_clearance(d);
        if clearance >= d / 2.0 {
            let allowed = format!("below half the ball diameter, {}", length(d / 2.0));
            return Err(Error::scene(at("pocket_clearance"), clearance, allowed));
        }
        if ring.guided == CageGuidance::Balls && clearance == 0.0 {
            let allowed = "above 0 m where the balls guide the cage, in round pockets";
            return Err(Error::scene(at("pocket_clearance"), clearance, allowed));
        }
        let given = ring.pocket_errors.len();
        if given != 0 && given != count {
            let allowed = format!("none, or one for each of the {count} balls of row {i}");
            return Err(Error::scene(
                at("pocket_errors"),
                format!("{given} values"),
                allowed,
            ));
        }
        let most = 0.1 * std::f64::consts::TAU / count as f64;
        for (k, error) in ring.pocket_errors.iter().enumerate() {
            if error.abs() <= most {
                continue;
            }
            let allowed = format!(
                "within ±{} rad, a tenth of the pockets' pitch",
                number(most)
            );
            return Err(Error::scene(
                at(&format!("pocket_errors[{k}]")),
                error,
                allowed,
            ));
        }
    }
    if ring.guided == CageGuidance::Held && ring.eccentricity != 0.0 {
        let allowed = "0 m where the cage's centre is held: guided = \"outer\", \"inner\" or \"balls\" lets it move";
        return Err(Error::scene(at("eccentricity"), ring.eccentricity, allowed));
    }
    Ok(())
}
