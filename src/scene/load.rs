//! Loads on the rings and what drives the inner ring.

use serde::{Deserialize, Serialize};

use super::Scene;
use super::absent;
use super::expected::nearest;
use super::numbers::{ANGLES, BoundedNumber, PLACES};
use super::ring::{Mount, RingName};
use super::time::TimeFunction;
use crate::base::error::{Error, Result};

/// A force on a ring's centre or on another point of it, in a fixed direction of the inertial frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Load {
    /// The loaded ring.
    pub ring: RingName,
    /// Direction; its length does not matter.
    pub direction: [f64; 3],
    /// Force along the direction \[N\].
    pub force: TimeFunction,
    /// Place at which the load acts, in the ring's frame, which tilts but does not turn with the ring \[m\]; absent: the ring's origin.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub at: Option<[f64; 3]>,
}

impl Load {
    /// A force \[N\] on a ring along a direction.
    pub fn new(ring: RingName, direction: [f64; 3], force: impl Into<TimeFunction>) -> Self {
        Self {
            ring,
            direction,
            force: force.into(),
            at: None,
        }
    }

    /// Numbers of the load.
    pub(super) fn numbers(&self) -> Vec<BoundedNumber> {
        BoundedNumber::each("at", self.at.as_slice().as_flattened(), PLACES, "m")
    }

    /// The same at a point of the ring's frame \[m\].
    #[must_use]
    pub fn at(self, point: [f64; 3]) -> Self {
        Self {
            at: Some(point),
            ..self
        }
    }
}

/// A moment on a ring, about a direction that is fixed in the inertial frame. Its part about the ring's axis turns the ring;
/// its part across the axis tilts the ring, or is carried by the support that holds the ring parallel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Moment {
    /// The loaded ring.
    pub ring: RingName,
    /// Axis of the moment; its length does not matter.
    pub direction: [f64; 3],
    /// Moment about the direction \[N m\].
    pub moment: TimeFunction,
}

impl Moment {
    /// A moment \[N m\] on a ring about a direction.
    pub fn new(ring: RingName, direction: [f64; 3], moment: impl Into<TimeFunction>) -> Self {
        Self {
            ring,
            direction,
            moment: moment.into(),
        }
    }
}

/// A mass off the axis of a ring that turns with it: in-plane force m e (ω² r̂ − ω̇ t̂).
///
/// The mass is part of the ring's mass and of its inertia about its own centre, whose displacement x and y are; the centre of mass
/// lies m e / (mass of the ring) away from it. On a ring that turns freely also act the reaction −m e r̂ × (ẍ, ÿ) about z and the
/// moment of the mass's weight.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Unbalance {
    /// The unbalanced ring.
    pub ring: RingName,
    /// Mass times eccentricity \[kg m\].
    pub moment: f64,
    /// Angular place on the ring, counter-clockwise from its own x axis \[rad\].
    #[serde(default)]
    pub angle: f64,
    /// Axial place in the ring's frame \[m\]; two unbalances at different places make a couple. Absent: 0.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub axial_position: Option<f64>,
}

impl Unbalance {
    /// Mass times eccentricity \[kg m\] at an angular place of a ring \[rad\].
    pub fn new(ring: RingName, moment: f64, angle: f64) -> Self {
        Self {
            ring,
            moment,
            angle,
            axial_position: None,
        }
    }

    /// Numbers of the load.
    pub(super) fn numbers(&self) -> [BoundedNumber; 3] {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            ring: _,
            moment,
            angle,
            axial_position,
        } = *self;
        [
            BoundedNumber::new("moment", moment, 0.0..=1e6, "kg m"),
            BoundedNumber::new("angle", angle, ANGLES, "rad"),
            BoundedNumber::new("axial_position", axial_position, PLACES, "m"),
        ]
    }
}

/// Drive of the inner ring.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum Drive {
    /// Given speed Ω(t) \[rad/s\]; must not jump.
    Speed(TimeFunction),
    /// Given torque about z, on a ring that turns freely.
    Torque {
        /// Torque \[N m\].
        value: TimeFunction,
        /// Speed at t = 0 \[rad/s\].
        #[serde(default)]
        initial_speed: f64,
    },
}

impl Drive {
    /// Numbers of the drive.
    pub(super) fn numbers(&self) -> Option<BoundedNumber> {
        let Self::Torque { initial_speed, .. } = *self else {
            return None;
        };
        let (field, range) = ("initial_speed", -1e6..=1e6);
        Some(BoundedNumber::new(field, initial_speed, range, "rad/s"))
    }

    /// Largest magnitude of the inner ring's speed that is known from the drive \[rad/s\].
    pub(crate) fn peak_speed(&self) -> f64 {
        match self {
            Self::Speed(speed) => speed.peak(),
            Self::Torque { initial_speed, .. } => initial_speed.abs(),
        }
    }

    /// Speed of the inner ring at the start \[rad/s\].
    pub fn initial_speed(&self) -> f64 {
        self.speed_from(0.0)
    }

    /// Speed of the inner ring for a run that begins at a time \[s\]; of a torque, the initial one \[rad/s\].
    pub(crate) fn speed_from(&self, t: f64) -> f64 {
        match self {
            Self::Speed(speed) => speed.at(t),
            Self::Torque { initial_speed, .. } => *initial_speed,
        }
    }
}

impl Scene {
    /// All values that may change in time: of loads and moments, of the drive and of the outer ring, and given motions of rings.
    pub(crate) fn values_in_time(&self) -> Vec<&TimeFunction> {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            drive,
            outer_speed,
            loads,
            moments,
            outer_ring,
            inner_ring,
            unbalances: _,
            table_forces: _,
            ring_forces: _,
            schema: _,
            name: _,
            rows: _,
            structure: _,
            materials: _,
            contact: _,
            friction: _,
            lubricant: _,
            spin: _,
            cage: _,
            gravity: _,
            defects: _,
            probes: _,
            solver: _,
        } = self;
        let (Drive::Speed(drive) | Drive::Torque { value: drive, .. }) = drive;
        let loads = loads.values().map(|load| &load.force);
        let moments = moments.values().map(|of| &of.moment);
        let rings = [outer_ring, inner_ring].into_iter();
        let given = rings.flat_map(|ring| ring.support.given());
        let speeds = [drive].into_iter().chain(outer_speed);
        speeds.chain(loads).chain(moments).chain(given).collect()
    }

    /// The size of a load, of a moment or of the drive's torque, or the given motion of a ring, by its path.
    pub(crate) fn in_time(&mut self, path: &str) -> Option<&mut TimeFunction> {
        if self.given_motion(path).is_some() {
            self.given_motion(path)
        } else {
            self.size(path)
        }
    }

    /// The given motion of a ring by its path, such as `inner_ring.support.x.given`.
    pub(crate) fn given_motion(&mut self, path: &str) -> Option<&mut TimeFunction> {
        let steps: Vec<&str> = path.split('.').collect();
        let [ring, "support", direction, "given"] = steps[..] else {
            return None;
        };
        let support = match ring {
            "outer_ring" => &mut self.outer_ring.support,
            "inner_ring" => &mut self.inner_ring.support,
            _ => return None,
        };
        match support.along(direction)? {
            Some(Mount::Given(motion)) => Some(motion),
            _ => None,
        }
    }

    /// Paths of the given motions of rings.
    fn given_motions(&mut self) -> Vec<String> {
        let of = |ring| {
            ["x", "y", "z", "tilt_x", "tilt_y"]
                .map(|direction| format!("{ring}.support.{direction}.given"))
        };
        let all = ["outer_ring", "inner_ring"].into_iter().flat_map(of);
        all.filter(|path| self.given_motion(path).is_some())
            .collect()
    }

    /// Paths of the sizes of loads and moments, and of the drive's torque.
    fn sizes(&self) -> Vec<String> {
        let loads = self.loads.keys().map(|name| format!("loads.{name}.force"));
        let moments = self.moments.keys();
        let moments = moments.map(|name| format!("moments.{name}.moment"));
        let torque = matches!(self.drive, Drive::Torque { .. });
        let torque = torque.then(|| "drive.torque.value".to_owned());
        loads.chain(moments).chain(torque).collect()
    }

    /// The size of a load, of a moment or of the drive's torque by its path.
    fn size(&mut self, path: &str) -> Option<&mut TimeFunction> {
        let steps: Vec<&str> = path.split('.').collect();
        match steps[..] {
            ["loads", name, "force"] => self.loads.get_mut(name).map(|load| &mut load.force),
            ["moments", name, "moment"] => self.moments.get_mut(name).map(|of| &mut of.moment),
            ["drive", "torque", "value"] => match &mut self.drive {
                Drive::Torque { value, .. } => Some(value),
                Drive::Speed(_) => None,
            },
            _ => None,
        }
    }

    /// The size of a constant load or moment, or of a constant torque of the drive, by its path.
    pub(crate) fn constant_load(&mut self, path: &str) -> Result<&mut f64> {
        let known = self.sizes();
        match self.size(path) {
            Some(TimeFunction::Constant(size)) => Ok(size),
            Some(TimeFunction::Profile(_)) => {
                let allowed = "a constant size, not a ramp, sine, table or spline";
                Err(Error::scene(path, "changing in time", allowed))
            }
            None => Err(not_there(path, &known, "a load, moment or torque")),
        }
    }

    /// The given motion of a ring, by its path.
    pub(crate) fn motion_to_set(&mut self, path: &str) -> Result<&mut TimeFunction> {
        let known = self.given_motions();
        let motion = self.given_motion(path);
        motion.ok_or_else(|| not_there(path, &known, "a given motion of a ring"))
    }
}

/// The refusal of a path that is none of those that there are.
fn not_there(path: &str, known: &[String], kind: &str) -> Error {
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    let allowed = match (nearest(path, &known), known.is_empty()) {
        (Some(like), _) => format!("perhaps {like}; there are: {}", known.join(", ")),
        (None, false) => format!("one of {}", known.join(", ")),
        (None, true) => format!("{kind} of the scene, which has none"),
    };
    Error::scene(path, "not there", allowed)
}
