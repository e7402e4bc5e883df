//! Textures that are rougher than finished races and balls.

use super::Doubt;
use crate::base::quantities::number;
use crate::scene::{Scene, Texture};

/// Largest amplitude at order 30 \[m\]: quiet bearings have 0.2 to 5 nm ([*Geometry of a row*](crate::equations#geometry-of-a-row)).
const ROUGH: f64 = 20e-9;
/// Largest root mean square of a profile around the circumference \[m\], as of a race out of round by some micrometres.
const OUT_OF_ROUND: f64 = 1e-6;

pub(super) fn look(scene: &Scene, found: &mut Vec<Doubt>) {
    for (i, row) in scene.rows.iter().enumerate() {
        if let Some(texture) = &row.texture {
            texture_of(&format!("rows[{i}].texture"), texture, found);
        }
    }
}

fn texture_of(path: &str, texture: &Texture, found: &mut Vec<Doubt>) {
    for (field, amplitude) in [
        ("outer", texture.outer),
        ("inner", texture.inner),
        ("ball", texture.ball),
    ] {
        let orders = texture.orders.unwrap_or([2, 1000]);
        let roughness = texture.roughness(amplitude, orders);
        let path = format!("{path}.{field}");
        if amplitude > ROUGH {
            let value = format!("{} nm", number(1e9 * amplitude));
            let usual = "races and balls as finished have 0.2 to 5 nm at order 30; amplitudes are in metres";
            found.push(Doubt::new(path, value, usual));
        } else if roughness > OUT_OF_ROUND {
            let value = format!("{} nm", number(1e9 * amplitude));
            let usual = format!(
                "with slope {} and from order {} on that is {} µm root mean square, and finished races have below 1; \
                 begin with a higher order, or let amplitudes fall less",
                number(texture.slope),
                orders[0],
                number(1e6 * roughness)
            );
            found.push(Doubt::new(path, value, usual));
        }
    }
}
