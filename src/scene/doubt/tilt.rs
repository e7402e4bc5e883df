//! Rings that lean.

use super::Doubt;
use crate::scene::Scene;
use crate::told::number;

/// Rings lean by less in use \[rad\]: self-aligning ball bearings by 2.5 to 3°.
const TILT: f64 = 0.05;

pub(super) fn look(scene: &Scene, found: &mut Vec<Doubt>) {
    let rings = [
        ("outer_ring.tilt", scene.outer_ring.tilt),
        ("inner_ring.tilt", scene.inner_ring.tilt),
    ];
    for (path, tilt) in rings {
        let [x, y] = tilt.unwrap_or_default();
        let size = x.hypot(y);
        if size > TILT {
            let value = format!("{}°", number(size.to_degrees()));
            let usual = "no bearing's rings lean by 3° in use; tilts are in radians";
            found.push(Doubt::new(path, value, usual));
        }
    }
}
