//! The variation of slip over a zone: how finely friction must be resolved.

use super::Pair;
use crate::contact::kernel;
use crate::contact::profile::Section;

impl Pair {
    /// Half of the zone's length of a ball pressed by an approach \[m\].
    pub(crate) fn half_zone(&self, radius: f64, approach: f64) -> f64 {
        let (r, cut) = (self.race.r, self.law.cut());
        let section = Section::new::<false, true>(radius, r, r - radius + approach, 0.0);
        kernel::zone(&cut, &section, cut.half_curvature()).half
    }

    /// Greatest difference of slip speeds over half of a zone, over the width of the traction law, of a ball pressed at an angle
    /// \[rad\] by an approach \[m\] that turns against its ring \[rad/s\]; none without friction.
    pub(crate) fn sweep(
        &self,
        radius: f64,
        approach: f64,
        angle: f64,
        turning: f64,
    ) -> Option<f64> {
        let width = self.law.traction?.width();
        let (r, half) = (self.race.r, self.half_zone(radius, approach));
        if half > 0.8 * radius {
            // Nothing that is developed about the middle holds over such a zone.
            return Some(f64::INFINITY);
        }
        Some(turning.abs() * half * (angle.sin() + 0.5 * half / r) / width)
    }
}
