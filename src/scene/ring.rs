//! Rings and how they are held.

use serde::{Deserialize, Serialize};

use super::TimeFunction;
use super::absent;
use super::numbers::{BoundedNumber, PLACES, POSITIVE, up_to};

/// A ring: its mass and how it is held.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Ring {
    /// Mass, with what turns or moves with the ring \[kg\]; absent: from `diameter`, `width` and density.
    #[serde(default)]
    pub mass: Option<f64>,
    /// Moment of inertia about z \[kg m²\]; absent: from `diameter`, `width` and density, or of a thin ring of `mass` at the pitch radius.
    #[serde(default)]
    pub inertia: Option<f64>,
    /// Boundary diameter \[m\]: outside diameter of the outer ring, bore of the inner.
    #[serde(default)]
    pub diameter: Option<f64>,
    /// Axial width \[m\].
    #[serde(default)]
    pub width: Option<f64>,
    /// How the ring is supported.
    #[serde(default)]
    pub support: Support,
    /// Nominal tilt (τ_x, τ_y) \[rad\], √(τ_x² + τ_y²) at most 0.5: the right-handed rotation about x and y at which the tilts are held,
    /// or their springs relaxed; absent: 0. It does not apply to a tilt whose motion is given.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub tilt: Option<[f64; 2]>,
    /// Moment of inertia about an axis across z through the centre of mass \[kg m²\]; absent: that of the hollow cylinder or thin ring
    /// that `inertia` is computed from, as long as `width`.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub transverse_inertia: Option<f64>,
    /// Axial place of the centre of mass in the ring's frame \[m\]; x, y and z of the ring are the displacement of this point. Absent: 0.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub centre_of_mass: Option<f64>,
}

impl Ring {
    /// Numbers of the ring that are checked by themselves.
    pub(super) fn numbers(&self) -> [BoundedNumber; 6] {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            mass,
            inertia,
            diameter,
            width,
            support: _,
            tilt: _,
            transverse_inertia,
            centre_of_mass,
        } = self;
        [
            BoundedNumber::new("mass", *mass, up_to(1e9), "kg"),
            BoundedNumber::new("inertia", *inertia, up_to(1e9), "kg m²"),
            BoundedNumber::new("diameter", *diameter, up_to(1e9), "m"),
            BoundedNumber::new("width", *width, up_to(1e9), "m"),
            BoundedNumber::new("transverse_inertia", *transverse_inertia, POSITIVE, "kg m²"),
            BoundedNumber::new("centre_of_mass", *centre_of_mass, PLACES, "m"),
        ]
    }
}

/// How a body is supported on the inertial frame, direction by direction. An absent direction is fixed for the
/// outer ring, free for the inner ring and the balls; an absent tilt is fixed.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Support {
    /// Mount along x.
    #[serde(default)]
    pub x: Option<Mount>,
    /// Mount along y.
    #[serde(default)]
    pub y: Option<Mount>,
    /// Mount along z.
    #[serde(default)]
    pub z: Option<Mount>,
    /// Mount about z; absent for a ring whose speed is given.
    #[serde(default)]
    pub theta: Option<Mount>,
    /// Tilt about x; rings only.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub tilt_x: Option<Mount>,
    /// Tilt about y; rings only.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub tilt_y: Option<Mount>,
    /// Springs and dampers between all directions, in addition to those above; rings only.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub coupled: Option<Box<CoupledSupport>>,
}

/// Mount of a ring in one direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum Mount {
    /// Nothing holds the body.
    Free,
    /// The body does not move.
    Fixed,
    /// A spring and a damper to the inertial frame, relaxed at the body's nominal place.
    Spring {
        /// Stiffness \[N/m\], of rotations \[N m/rad\].
        #[serde(default)]
        stiffness: f64,
        /// Damping \[N s/m\], of rotations \[N m s/rad\].
        #[serde(default)]
        damping: f64,
    },
    /// A ring follows a given motion: its place over time \[m\], of tilts the angle \[rad\]; a number, a sine or a spline. Not about z,
    /// where the drive or [`Scene::outer_speed`](super::Scene::outer_speed) gives a speed.
    Given(Box<TimeFunction>),
}

impl Mount {
    /// A given motion \[m\], \[rad\].
    pub fn given(motion: impl Into<TimeFunction>) -> Self {
        Self::Given(Box::new(motion.into()))
    }

    /// Numbers of a spring along an axis, or about one.
    pub(super) fn numbers(&self, turns: bool) -> Vec<BoundedNumber> {
        let Self::Spring { stiffness, damping } = *self else {
            return Vec::new();
        };
        let units = if turns {
            ["N m/rad", "N m s/rad"]
        } else {
            ["N/m", "N s/m"]
        };
        vec![
            BoundedNumber::new("stiffness", stiffness, 0.0..=1e15, units[0]),
            BoundedNumber::new("damping", damping, 0.0..=1e12, units[1]),
        ]
    }

    /// Whether forces move a body in this direction.
    pub(crate) fn gives(&self) -> bool {
        matches!(self, Self::Free | Self::Spring { .. })
    }
}

impl Support {
    /// The mount of a direction, by the field's name.
    pub(super) fn along(&mut self, direction: &str) -> Option<&mut Option<Mount>> {
        match direction {
            "x" => Some(&mut self.x),
            "y" => Some(&mut self.y),
            "z" => Some(&mut self.z),
            "theta" => Some(&mut self.theta),
            "tilt_x" => Some(&mut self.tilt_x),
            "tilt_y" => Some(&mut self.tilt_y),
            _ => None,
        }
    }

    /// Given motions along and about axes.
    pub(super) fn given(&self) -> impl Iterator<Item = &TimeFunction> {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            x,
            y,
            z,
            theta,
            tilt_x,
            tilt_y,
            coupled: _,
        } = self;
        let mounts = [x, y, z, theta, tilt_x, tilt_y].into_iter().flatten();
        mounts.filter_map(|mount| match mount {
            Mount::Given(motion) => Some(&**motion),
            _ => None,
        })
    }

    /// Holds a ring of given motions where they begin.
    pub(crate) fn hold_given(&mut self) {
        for direction in ["x", "y", "z", "tilt_x", "tilt_y"] {
            if let Some(Some(Mount::Given(motion))) = self.along(direction) {
                **motion = motion.at(0.0).into();
            }
        }
    }

    /// The support of the mounts along x, y and z and about z.
    pub fn new([x, y, z, theta]: [Option<Mount>; 4]) -> Self {
        Self {
            x,
            y,
            z,
            theta,
            ..Self::default()
        }
    }

    /// The four mounts (x, y, z, θ) with absent ones filled in.
    #[allow(clippy::needless_pass_by_value)] // a word in every call
    pub fn mounts(&self, absent: Mount) -> [Mount; 4] {
        let mounts = [&self.x, &self.y, &self.z, &self.theta];
        mounts.map(|mount| mount.as_ref().unwrap_or(&absent).clone())
    }
}

/// Springs and dampers between all directions of a ring, in addition to those of single directions: generalised forces −(K ξ + C ξ̇)
/// on x, y, z of a point of its axis, on its tilts and on its rotation. K and C are symmetric and positive semidefinite.
///
/// The order is x, y, z, `tilt_x`, `tilt_y`, θ; entries of K are \[N/m\], \[N/rad\] or \[N m/m\], and \[N m/rad\], those of C the same
/// times seconds. Fixed directions stay fixed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct CoupledSupport {
    /// K; row and column of θ are 0 where the ring's speed is given.
    pub stiffness: [[f64; 6]; 6],
    /// C; likewise.
    #[serde(default)]
    pub damping: [[f64; 6]; 6],
    /// Axial place of the point in the ring's frame \[m\].
    #[serde(default)]
    pub axial_position: f64,
}

impl CoupledSupport {
    /// Numbers of the support whose range depends on no other.
    pub(super) fn numbers(&self) -> [BoundedNumber; 1] {
        let place = self.axial_position;
        [BoundedNumber::new("axial_position", place, PLACES, "m")]
    }

    /// Springs without dampers, at the ring's origin.
    pub fn new(stiffness: [[f64; 6]; 6]) -> Self {
        Self {
            stiffness,
            damping: [[0.0; 6]; 6],
            axial_position: 0.0,
        }
    }
}

/// Name of a ring.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum RingName {
    /// The outer ring, body 0.
    Outer,
    /// The inner ring, body 1.
    Inner,
}

impl RingName {
    /// `outer` or `inner`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Outer => "outer",
            Self::Inner => "inner",
        }
    }
}
