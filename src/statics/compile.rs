//! From a user's scene to its model, in two passes.
//!
//! 1. The *healthy* bearing at rest under its largest loads says where defects lie that are placed by contacts, what steep walls
//!    unload, and whether pits are smaller than their contacts ([`place()`]).
//! 2. The bearing with its defects at rest, without oil and with round races, says over which widths waves are averaged, and how thick
//!    films are (`loads`).
//!
//! From then on a model does not change. Films that follow the speed of the rings are in a copy that a run has of it (`dynamics::films`).

use super::{DefectPasses, loads, place};
use crate::base::error::{Error, Result};
use crate::base::quantities::number;
use crate::model::{Model, compile_placed};
use crate::scene::Scene;

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
        if let Some((pit, load, race)) = meeting.pit(defect)
            && pit.outgrows(&meeting.model.rows[defect.row].hertz[race], load)
        {
            return Err(Error::scene(
                format!("defects.{name}.width"),
                defect.width.largest(),
                format!(
                    "smaller than its contact, which bears {} N; a larger one is a spall, with an edge radius",
                    number(load)
                ),
            ));
        }
    }
    Ok(())
}
