//! The machine around the outer ring, as a structure with modes.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use super::absent;
use super::numbers::{BoundedNumber, up_to};

/// Components of shapes.
pub(super) const SHAPES: RangeInclusive<f64> = -1e6..=1e6;

/// Structure on which the outer ring stands: modes of what is around the bearing, as finite elements or a modal test give them.
///
/// The springs and dampers of [`outer_ring.support`](super::Ring::support) along x, y and z then end at the seat, a point of the structure
/// that its modes move, instead of on the ground ([*A structure with modes*](crate::equations#a-structure-with-modes)).
///
/// ```
/// use ballrace::scene::{Mode, Structure, presets};
/// let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
/// scene.probes.clear();
/// let foot = Mode::new(1200.0, 0.05, 2.0, [0.0, 1.0, 0.0]).sensor("top", [0.0, 1.0, 0.0]);
/// scene.structure = Some(Structure::new(vec![foot]));
/// assert!(scene.recorded().contains_key("housing") && scene.recorded().contains_key("seat"));
/// assert!(scene.validate().is_ok());
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Structure {
    /// Modes, at least one.
    pub modes: Vec<Mode>,
    /// Residual compliance at the seat \[m/N\]: the static compliance that modes beyond those listed leave to it, in series with the
    /// springs of the ring's support. Absent: none.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub static_compliance: Option<Compliance>,
}

/// Mode of a structure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Mode {
    /// Natural frequency f \[Hz\].
    pub frequency: f64,
    /// Damping ratio ζ, below 1.
    pub damping: f64,
    /// Modal mass m \[kg\], for the scale of the shapes.
    pub mass: f64,
    /// Shape at the seat Φ along x, y, z: its displacement where the mode's coordinate is 1.
    pub seat: [f64; 3],
    /// Shapes Ψ at sensors by their names, likewise; a sensor that a mode does not list is not moved by it.
    #[serde(default)]
    pub sensors: BTreeMap<String, [f64; 3]>,
}

/// Compliance of a point against forces on it \[m/N\].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(
    untagged,
    expecting = "a number, three numbers, or three rows of three"
)]
#[non_exhaustive]
pub enum Compliance {
    /// The same along x, y and z.
    Same(f64),
    /// Along x, y and z.
    Along([f64; 3]),
    /// Displacements, by rows, by forces along x, y and z; symmetric and positive semidefinite.
    Full([[f64; 3]; 3]),
}

impl Structure {
    /// A structure of modes.
    pub fn new(modes: Vec<Mode>) -> Self {
        Self {
            modes,
            static_compliance: None,
        }
    }

    /// Names of the sensors of all modes, in alphabetical order.
    pub fn sensors(&self) -> BTreeSet<&str> {
        let modes = self.modes.iter();
        modes
            .flat_map(|mode| mode.sensors.keys().map(String::as_str))
            .collect()
    }
}

impl Mode {
    /// A mode of a natural frequency \[Hz\], a damping ratio, a modal mass \[kg\] and a shape at the seat, without sensors.
    pub fn new(frequency: f64, damping: f64, mass: f64, seat: [f64; 3]) -> Self {
        Self {
            frequency,
            damping,
            mass,
            seat,
            sensors: BTreeMap::new(),
        }
    }

    /// The same with a sensor.
    #[must_use]
    pub fn sensor(mut self, name: impl Into<String>, shape: [f64; 3]) -> Self {
        self.sensors.insert(name.into(), shape);
        self
    }
}

impl Mode {
    /// Numbers of a mode.
    pub(super) fn numbers(&self) -> Vec<BoundedNumber> {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            frequency,
            damping,
            mass,
            seat,
            sensors: _,
        } = self;
        let mut found = vec![
            BoundedNumber::new("frequency", *frequency, up_to(1e6), "Hz"),
            BoundedNumber::new("damping", *damping, 0.0..1.0, ""),
            BoundedNumber::new("mass", *mass, up_to(1e9), "kg"),
        ];
        found.extend(BoundedNumber::each("seat", seat, SHAPES, ""));
        found
    }
}

impl Compliance {
    /// The compliance as a matrix \[m/N\].
    pub fn matrix(&self) -> [[f64; 3]; 3] {
        let diagonal = |c: [f64; 3]| [[c[0], 0.0, 0.0], [0.0, c[1], 0.0], [0.0, 0.0, c[2]]];
        match self {
            Self::Same(c) => diagonal([*c; 3]),
            Self::Along(c) => diagonal(*c),
            Self::Full(matrix) => *matrix,
        }
    }
}
