//! The instant at which forces are evaluated, and the sums that they add to.

use nalgebra::Vector3;

use super::{State, Table};
use crate::contact::TiltedRing;
use crate::model::{Race, Spring};
use crate::tilt::Frame;

/// A time and a state, and the part of the bearing that a run integrates.
pub(crate) struct Instant<'a> {
    /// \[s\]
    pub t: f64,
    pub state: &'a State,
    /// Number of the rows whose balls move, the first ones.
    pub rows: usize,
    /// Supports of directions that move.
    pub springs: &'a [Spring],
    /// How many rows each of them stands for: two, where the second row is an image of the first.
    pub times: f64,
    /// Rings that may tilt; none where they stay parallel.
    pub rings: Option<[&'a TiltedRing; 2]>,
}

impl Instant<'_> {
    /// The frame of a ring.
    pub fn frame(&self, race: Race) -> Frame {
        self.rings
            .map_or_else(|| Frame::new([0.0; 2]), |rings| rings[race].rotation.frame)
    }
}

/// Force on a ring's centre of mass \[N\] and moment about it \[N m\], in the scene's frame.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct RingWrench {
    pub force: Vector3<f64>,
    pub moment: Vector3<f64>,
}

/// Sums of the forces on all bodies.
pub(crate) struct ForceSums<'a> {
    pub on: &'a mut Table,
    /// Moments about the rings' centres of mass, in the scene's frame; none where rings stay parallel and the table has the moment
    /// about z.
    pub moments: Option<&'a mut [Vector3<f64>; 2]>,
}

impl ForceSums<'_> {
    pub fn add(&mut self, race: Race, wrench: &RingWrench) {
        let [x, y, z] = wrench.force.into();
        let about = match &mut self.moments {
            None => wrench.moment.z,
            Some(moments) => {
                moments[race] += wrench.moment;
                0.0
            }
        };
        self.on.add(race.ring(), &[x, y, z, about]);
    }
}
