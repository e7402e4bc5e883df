//! Quantities of contacts, as probes record them.

use serde::{Deserialize, Serialize};

use crate::base::every::every;

/// Quantity of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum ContactQuantity {
    /// Magnitude of the normal force, elastic and damping \[N\].
    Load,
    /// Operating contact angle: of the normal force against the radial plane \[rad\]; NaN without load.
    Angle,
    /// Axial place of the centre of force of the zone, in the ring's frame \[m\]; NaN without load.
    ZoneCentre,
    /// Axial extent of the slices that touch \[m\].
    ZoneWidth,
    /// Load-weighted slip speed \[m/s\]; NaN without load.
    Slip,
}

impl ContactQuantity {
    /// Quantities of contacts, in their order.
    pub const ALL: [Self; 5] = every!(ContactQuantity: Load, Angle, ZoneCentre, ZoneWidth, Slip);

    /// Name as in columns, and unit.
    pub fn label(self) -> (&'static str, &'static str) {
        match self {
            Self::Load => ("load", "N"),
            Self::Angle => ("angle", "rad"),
            Self::ZoneCentre => ("zone_centre", "m"),
            Self::ZoneWidth => ("zone_width", "m"),
            Self::Slip => ("slip", "m/s"),
        }
    }
}
