//! Rings that tilt.

use super::Doubt;
use crate::base::quantities::number;
use crate::scene::Scene;

/// Rings tilt by less in use \[rad\]: self-aligning ball bearings by 2.5 to 3°.
const TILT: f64 = 0.05;

/// Why that is doubted.
const USUAL: &str = "rings of bearings tilt by less than 3° in use";

impl Doubt {
    /// Doubt about how far rings tilt in a run or at equilibrium \[rad\], if that is too far.
    pub(crate) fn tilt(size: f64) -> Option<Self> {
        (size > TILT).then(|| {
            let value = format!("{}°", number(size.to_degrees()));
            Self::new(
                "tilt of a ring",
                value,
                format!("{USUAL}; look at its support and loads"),
            )
        })
    }
}

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
            found.push(Doubt::new(
                path,
                value,
                format!("{USUAL}; tilts are in radians"),
            ));
        }
    }
}
