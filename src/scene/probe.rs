//! Probes: what a run records. A probe's columns are named after it: probe `outer` of a motion gives `outer.ay`.
//!
//! Motion, cage forces, friction torques, sensors and the seat of a structure are signals, filtered before they are sampled unless a run's bandwidth is
//! [`Raw`](crate::Bandwidth::Raw). Contacts, energies, films, moments, forces by origin and slices are values of a state: always points.

use serde::{Deserialize, Serialize};

use super::contact_quantity::ContactQuantity;
use super::ring::RingName;

/// A named set of signals.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum Probe {
    /// Position, velocity and acceleration of a body; filtered.
    Motion(MotionProbe),
    /// Quantities of the contacts of balls and races, as points: columns `<probe>.ball3.outer.load` and so on.
    Contacts(ContactsProbe),
    /// The cage of a row, filtered: the force of every link, positive in tension, in columns `<probe>.link0`, … \[N\]; of a ring its angle,
    /// which goes on from turn to turn, its speed and its centre, `<probe>.angle`, `.omega`, `.x`, `.y`, and the force of each pocket's wall
    /// on its ball, positive on one that leads, `.pocket0.force`, …
    #[non_exhaustive]
    Cage {
        /// Row, from 0.
        #[serde(default)]
        row: usize,
    },
    /// Energies \[J\] and dissipated powers \[W\], as points.
    #[non_exhaustive]
    Energy {},
    /// Friction torque about z that the balls put on each ring, filtered: `<probe>.outer`, `<probe>.inner` \[N m\].
    /// Costs an evaluation of the model at every point that the filter reads.
    #[non_exhaustive]
    Torque {},
    /// Moments about x and y that the balls put on the rings, each about its own centre, as points: `<probe>.outer.x`,
    /// `<probe>.outer.y`, `<probe>.inner.x`, `<probe>.inner.y` \[N m\]. The support that keeps a ring from tilting carries them.
    #[non_exhaustive]
    Moments {},
    /// The forces on a body by origin, as points: `<probe>.contact.x`, `<probe>.friction.y`, … \[N\], about z \[N m\].
    #[non_exhaustive]
    Forces {
        /// `outer`, `inner` or a ball such as `row0.ball3`.
        body: String,
    },
    /// Films and losses of a row's oil, as points: `<probe>.outer.film`, `.inner.film` \[m\], `.outer.lambda`, `.inner.lambda`,
    /// `.friction_torque` \[N m\], `.slip_power`, `.rolling_power`, `.damping_power`, `.drag_power` \[W\]. The torque is that of the
    /// row's balls on the inner ring, positive against its motion whichever way the shaft turns.
    #[non_exhaustive]
    Lubrication {
        /// Row, from 0; it has a lubricant.
        #[serde(default)]
        row: usize,
    },
    /// Accelerations of the sensors of the structure, filtered: `<probe>.<sensor>.ax`, `.ay`, `.az` \[m/s²\].
    #[non_exhaustive]
    Structure {
        /// Names of the sensors; absent: all.
        #[serde(default)]
        sensors: Option<Vec<String>>,
    },
    /// Force of the outer ring on the seat, by springs and dampers of its support, filtered: `<probe>.fx`, `.fy`, `.fz` \[N\].
    #[non_exhaustive]
    Seat {},
    /// Forces of the single slices of chosen contacts at chosen times; a table in addition to the signals.
    Slices(SlicesProbe),
}

/// Motion of a body to be recorded.
///
/// ```
/// use ballrace::scene::{Component, MotionProbe, presets};
/// let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
/// let probe = MotionProbe::of("inner").components([Component::X, Component::Y]);
/// scene.probes.insert("shaft".to_owned(), probe.into());
/// # assert!(scene.validate().is_ok());
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct MotionProbe {
    /// `outer`, `inner` or a ball such as `row0.ball3`.
    pub body: String,
    /// Components to record; absent: the twelve of every body, for a ring that may tilt also those of its tilts, for a ball
    /// that spins freely also those about x and y.
    #[serde(default)]
    pub components: Option<Vec<Component>>,
}

impl MotionProbe {
    /// All components of a body: `outer`, `inner` or a ball such as `row0.ball3`.
    pub fn of(body: impl Into<String>) -> Self {
        Self {
            body: body.into(),
            components: None,
        }
    }

    /// These components alone.
    #[must_use]
    pub fn components(self, components: impl Into<Vec<Component>>) -> Self {
        Self {
            components: Some(components.into()),
            ..self
        }
    }
}

/// Contacts of balls and races whose quantities are to be recorded.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct ContactsProbe {
    /// Row, from 0.
    #[serde(default)]
    pub row: usize,
    /// Balls of the row; absent: all.
    #[serde(default)]
    pub balls: Option<Vec<usize>>,
    /// Races; absent: both.
    #[serde(default)]
    pub races: Option<Vec<RingName>>,
    /// Quantities to record; absent: all.
    #[serde(default)]
    pub quantities: Option<Vec<ContactQuantity>>,
}

impl ContactsProbe {
    /// All quantities of all contacts of a row, from 0.
    pub fn of_row(row: usize) -> Self {
        Self {
            row,
            ..Self::default()
        }
    }

    /// These balls of the row alone.
    #[must_use]
    pub fn balls(self, balls: impl Into<Vec<usize>>) -> Self {
        Self {
            balls: Some(balls.into()),
            ..self
        }
    }

    /// These races alone.
    #[must_use]
    pub fn races(self, races: impl Into<Vec<RingName>>) -> Self {
        Self {
            races: Some(races.into()),
            ..self
        }
    }

    /// These quantities alone.
    #[must_use]
    pub fn quantities(self, quantities: impl Into<Vec<ContactQuantity>>) -> Self {
        Self {
            quantities: Some(quantities.into()),
            ..self
        }
    }
}

/// Contacts whose slices are to be recorded, and when.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct SlicesProbe {
    /// Row, from 0.
    #[serde(default)]
    pub row: usize,
    /// Balls of the row; absent: all.
    #[serde(default)]
    pub balls: Option<Vec<usize>>,
    /// Races; absent: both.
    #[serde(default)]
    pub races: Option<Vec<RingName>>,
    /// Times within the run \[s\].
    pub times: Vec<f64>,
}

impl SlicesProbe {
    /// All contacts of row 0 at times within the run \[s\].
    pub fn at(times: impl Into<Vec<f64>>) -> Self {
        Self {
            row: 0,
            balls: None,
            races: None,
            times: times.into(),
        }
    }

    /// The same of another row, from 0.
    #[must_use]
    pub fn in_row(self, row: usize) -> Self {
        Self { row, ..self }
    }

    /// These balls of the row alone.
    #[must_use]
    pub fn balls(self, balls: impl Into<Vec<usize>>) -> Self {
        Self {
            balls: Some(balls.into()),
            ..self
        }
    }

    /// These races alone.
    #[must_use]
    pub fn races(self, races: impl Into<Vec<RingName>>) -> Self {
        Self {
            races: Some(races.into()),
            ..self
        }
    }
}

impl Probe {
    /// All components of the motion of a body.
    pub fn motion(body: impl Into<String>) -> Self {
        MotionProbe::of(body).into()
    }

    /// The cage of a row, from 0.
    pub fn cage(row: usize) -> Self {
        Self::Cage { row }
    }

    /// Energies and dissipated powers.
    pub fn energy() -> Self {
        Self::Energy {}
    }

    /// Friction torques of the balls on the rings.
    pub fn torque() -> Self {
        Self::Torque {}
    }

    /// Moments of the balls on the rings.
    pub fn moments() -> Self {
        Self::Moments {}
    }

    /// Forces on a body by origin.
    pub fn forces(body: impl Into<String>) -> Self {
        Self::Forces { body: body.into() }
    }

    /// Accelerations of all sensors of the structure.
    pub fn structure() -> Self {
        Self::Structure { sensors: None }
    }

    /// Force of the outer ring on the seat of the structure.
    pub fn seat() -> Self {
        Self::Seat {}
    }

    /// Films and losses of the oil of a row, from 0.
    pub fn lubrication(row: usize) -> Self {
        Self::Lubrication { row }
    }
}

impl From<MotionProbe> for Probe {
    fn from(of: MotionProbe) -> Self {
        Self::Motion(of)
    }
}

impl From<ContactsProbe> for Probe {
    fn from(of: ContactsProbe) -> Self {
        Self::Contacts(of)
    }
}

impl From<SlicesProbe> for Probe {
    fn from(of: SlicesProbe) -> Self {
        Self::Slices(of)
    }
}

/// Component of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Component {
    /// Position \[m\].
    X,
    /// Position \[m\].
    Y,
    /// Position \[m\].
    Z,
    /// Angle about z \[rad\].
    Theta,
    /// Velocity \[m/s\].
    Vx,
    /// Velocity \[m/s\].
    Vy,
    /// Velocity \[m/s\].
    Vz,
    /// Angular speed \[rad/s\].
    Omega,
    /// Acceleration \[m/s²\].
    Ax,
    /// Acceleration \[m/s²\].
    Ay,
    /// Acceleration \[m/s²\].
    Az,
    /// Angular acceleration \[rad/s²\].
    Alpha,
    /// Tilt of a ring about x \[rad\].
    TiltX,
    /// Tilt of a ring about y \[rad\].
    TiltY,
    /// Rate of the tilt about x \[rad/s\].
    TiltVx,
    /// Rate of the tilt about y \[rad/s\].
    TiltVy,
    /// Acceleration of the tilt about x \[rad/s²\].
    TiltAx,
    /// Acceleration of the tilt about y \[rad/s²\].
    TiltAy,
    /// Integral of ω_x over time of a ball that spins freely \[rad\].
    TurnX,
    /// Integral of ω_y over time of a ball that spins freely \[rad\].
    TurnY,
    /// Angular velocity about x of a ball that spins freely \[rad/s\].
    OmegaX,
    /// Angular velocity about y of a ball that spins freely \[rad/s\].
    OmegaY,
    /// Angular acceleration about x of a ball that spins freely \[rad/s²\].
    AlphaX,
    /// Angular acceleration about y of a ball that spins freely \[rad/s²\].
    AlphaY,
}

impl Component {
    /// The twelve of every body, positions first.
    pub const ALL: [Self; 12] = [
        Self::X,
        Self::Y,
        Self::Z,
        Self::Theta,
        Self::Vx,
        Self::Vy,
        Self::Vz,
        Self::Omega,
        Self::Ax,
        Self::Ay,
        Self::Az,
        Self::Alpha,
    ];

    /// Components that a ring that may tilt has in addition.
    pub const OF_TILTS: [Self; 6] = [
        Self::TiltX,
        Self::TiltY,
        Self::TiltVx,
        Self::TiltVy,
        Self::TiltAx,
        Self::TiltAy,
    ];

    /// Components that a ball that spins freely has in addition.
    pub const OF_TURNS: [Self; 6] = [
        Self::TurnX,
        Self::TurnY,
        Self::OmegaX,
        Self::OmegaY,
        Self::AlphaX,
        Self::AlphaY,
    ];

    /// The component of a direction and a derivative: 0 for a place, 1 for a speed, 2 for an acceleration.
    pub(crate) fn of(direction: usize, derivative: usize) -> Self {
        match direction {
            0..4 => Self::ALL[4 * derivative + direction],
            4 | 5 => Self::OF_TILTS[2 * derivative + direction - 4],
            _ => Self::OF_TURNS[2 * derivative + direction - 6],
        }
    }

    /// The direction it is of: 0 to 2 along x, y, z, 3 about z, 4 and 5 of the tilts about x and y, 6 and 7 of how a ball turns
    /// about x and y.
    pub fn direction(self) -> usize {
        match self as usize {
            common @ 0..12 => common % 4,
            of_tilts @ 12..18 => 4 + of_tilts % 2,
            of_turns => 6 + of_turns % 2,
        }
    }

    /// 0 for a place, 1 for a speed, 2 for an acceleration.
    pub fn derivative(self) -> usize {
        match self as usize {
            common @ 0..12 => common / 4,
            of_tilts @ 12..18 => (of_tilts - 12) / 2,
            of_turns => (of_turns - 18) / 2,
        }
    }

    /// Name as in columns and states, and unit.
    pub fn label(self) -> (&'static str, &'static str) {
        match self {
            Self::X => ("x", "m"),
            Self::Y => ("y", "m"),
            Self::Z => ("z", "m"),
            Self::Theta => ("theta", "rad"),
            Self::Vx => ("vx", "m/s"),
            Self::Vy => ("vy", "m/s"),
            Self::Vz => ("vz", "m/s"),
            Self::Omega => ("omega", "rad/s"),
            Self::Ax => ("ax", "m/s^2"),
            Self::Ay => ("ay", "m/s^2"),
            Self::Az => ("az", "m/s^2"),
            Self::Alpha => ("alpha", "rad/s^2"),
            Self::TiltX => ("tilt_x", "rad"),
            Self::TiltY => ("tilt_y", "rad"),
            Self::TiltVx => ("tilt_vx", "rad/s"),
            Self::TiltVy => ("tilt_vy", "rad/s"),
            Self::TiltAx => ("tilt_ax", "rad/s^2"),
            Self::TiltAy => ("tilt_ay", "rad/s^2"),
            Self::TurnX => ("turn_x", "rad"),
            Self::TurnY => ("turn_y", "rad"),
            Self::OmegaX => ("omega_x", "rad/s"),
            Self::OmegaY => ("omega_y", "rad/s"),
            Self::AlphaX => ("alpha_x", "rad/s^2"),
            Self::AlphaY => ("alpha_y", "rad/s^2"),
        }
    }
}
