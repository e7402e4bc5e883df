//! Simplifications that change the result.

use serde::{Deserialize, Serialize};

use super::{Drive, Mount, Scene};
use crate::base::error::{Error, Result};

/// Simplifications that change the answer, all off by default; [`crate::explain()`] offers those that apply to a scene.
// Each is asked for by itself.
#[allow(clippy::struct_excessive_bools)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct Approximations {
    /// Balls and cage are kinematic: every row orbits at the share of the inner ring's speed at which it rolls at the start, with
    /// the spacing of its balls at the start; balls move only along their radii and z. Friction and cage are left out, also from
    /// [`crate::dynamics::rhs()`], which otherwise includes free balls. Needs a given speed.
    pub rolling: bool,
    /// Rings and balls keep their axial places from the start, all balls of a row the same one: the plane model
    /// of a bearing with a contact angle, for loads along z that do not change.
    pub plane: bool,
    /// Approximation by one row: of two rows, the one that carries less than 2 % of the load at the start is left out, where loads do not change.
    pub one_row: bool,
}

impl Approximations {
    /// No approximation.
    pub const NONE: Self = Self {
        rolling: false,
        plane: false,
        one_row: false,
    };

    /// Whether any is asked for.
    pub fn any(self) -> bool {
        self != Self::NONE
    }

    /// The scene without the forces that `rolling` leaves out.
    pub(crate) fn simplified(scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        if scene.approximations.rolling {
            scene.remove_friction();
            scene.cage = None;
        }
        scene
    }

    /// Refuses approximations that the scene does not allow.
    pub(super) fn validate(self, scene: &Scene) -> Result<()> {
        let refuse = |field: &str, allowed: String| {
            Err(Error::scene(
                format!("approximations.{field}"),
                true,
                allowed,
            ))
        };
        if self.rolling {
            if !matches!(scene.drive, Drive::Speed(_)) {
                return refuse(
                    "rolling",
                    "false with drive.torque, which nothing balances without friction".to_owned(),
                );
            }
            for (i, row) in scene.rows.iter().enumerate() {
                if row.ball_support.mounts(Mount::Free) != [const { Mount::Free }; 4] {
                    return refuse(
                        "rolling",
                        format!("false with rows[{i}].ball_support, which holds balls in place"),
                    );
                }
            }
        }
        if self.one_row && scene.rows.len() != 2 {
            return refuse("one_row", "false unless there are two rows".to_owned());
        }
        let rings = [&scene.outer_ring, &scene.inner_ring];
        let follows = |ring: &&super::Ring| matches!(ring.support.z, Some(Mount::Given(_)));
        let kept = [("plane", self.plane), ("one_row", self.one_row)];
        if let Some((name, _)) = kept.into_iter().find(|(_, asked)| *asked)
            && rings.iter().any(follows)
        {
            let allowed =
                "false where a ring's motion along z is given, since it keeps axial places";
            return refuse(name, allowed.to_owned());
        }
        Ok(())
    }
}
