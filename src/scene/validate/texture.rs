//! Texture of races and balls.

use super::check::numbers;
use crate::base::error::{Error, Result};
use crate::scene::{Defect, Scene, Surface, Texture};

/// The texture of a row, if it has one.
pub(super) fn texture(scene: &Scene, index: usize) -> Result<()> {
    let row = &scene.rows[index];
    let Some(texture) = &row.texture else {
        return Ok(());
    };
    let path = format!("rows[{index}].texture");
    let at = |field: &str| format!("{path}.{field}");
    numbers(&path, texture.numbers())?;
    if [texture.outer, texture.inner, texture.ball] == [0.0; 3] {
        let allowed = "an amplitude of outer, inner or ball above 0, or no texture";
        return Err(Error::scene(path, "no amplitude above 0", allowed));
    }
    if let Some([first, last]) = texture.orders
        && !(2 <= first && first <= last && last <= Texture::LAST)
    {
        let allowed = format!(
            "two orders from 2 to {}, the lower one first",
            Texture::LAST
        );
        return Err(Error::scene(
            at("orders"),
            format!("[{first}, {last}]"),
            allowed,
        ));
    }
    if !row.has_plain_grooves() {
        let allowed = "absent in rows with race profiles, gothic arches or rounded shoulders";
        return Err(Error::scene(path, "given", allowed));
    }
    let tumbles = |defect: &Defect| defect.row == index && defect.on == Surface::Ball;
    if texture.ball > 0.0 && scene.balls_turn() && scene.defects.values().any(tumbles) {
        let allowed =
            "0 where balls spin freely and one has a defect: their texture is around one axis";
        return Err(Error::scene(at("ball"), texture.ball, allowed));
    }
    Ok(())
}
