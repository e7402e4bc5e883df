//! Compilation of a user's scene to its model, in two passes.
//!
//! 1. The *healthy* bearing at rest under its largest loads says where defects lie that are placed by contacts, what steep walls
//!    unload, and whether pits are smaller than their contacts ([`place()`]).
//! 2. The bearing with its defects at rest, without oil and with round races, says over which widths waves are averaged, and how thick
//!    films are (`reference`).
//!
//! From then on a model does not change. Films that follow the speed of the rings are in a copy that a run has of it (`dynamics::films`).

use super::at_rest::AtRest;
use super::compile::compile_placed;
use super::place::place;
use super::{Model, reference};
use crate::base::error::{Error, Result};
use crate::base::quantities::number;
use crate::scene::Scene;

/// Checks a scene, places the defects that are to lie where contacts run, and compiles it.
///
/// # Errors
/// [`crate::Error::Scene`] names the first field that is not usable, or the environment variable `BALLRACE_SIMD` where it
/// names no level of this processor.
pub(crate) fn compile(scene: &Scene, rest: &dyn AtRest) -> Result<Model> {
    let (placed, _) = place(scene, rest)?;
    let model = compile_placed(&placed)?;
    check_pits(&placed, rest)?;
    reference::finished(model, rest)
}

/// Refuses pits that are too large for the heaviest static contact that meets them; where there is none they are taken as they are.
fn check_pits(scene: &Scene, rest: &dyn AtRest) -> Result<()> {
    for (name, defect) in scene
        .defects
        .iter()
        .filter(|(_, defect)| defect.damage.is_small())
    {
        let Some(contact) = rest.heaviest(scene, defect)? else {
            continue;
        };
        if contact.is_outgrown(defect) {
            return Err(Error::scene(
                format!("defects.{name}.width"),
                defect.damage.width(),
                format!(
                    "smaller than its contact, which bears {} N; a larger one is a spall, with an edge radius",
                    number(contact.load)
                ),
            ));
        }
    }
    Ok(())
}
