//! Rings that tilt: which may, and what is asked of scenes that have one.

use super::bearing::{Mount, Ring, Support};
use super::{Approximations, Component, Scene};
use crate::error::{Error, Result};

impl Support {
    /// The mounts of both tilts, which are fixed where they are absent.
    pub fn tilt_mounts(&self) -> [Mount; 2] {
        [self.tilt_x, self.tilt_y].map(|mount| mount.unwrap_or(Mount::Fixed))
    }

    /// Whether it says anything of tilts or couples directions.
    pub(super) fn is_spatial(&self) -> bool {
        self.tilt_x.is_some() || self.tilt_y.is_some() || self.coupled.is_some()
    }
}

impl Ring {
    /// Whether it may lean: it does from the start, may tilt, or its support couples tilts with other directions.
    pub(crate) fn leans(&self) -> bool {
        let support = &self.support;
        self.tilt.is_some_and(|tilt| tilt != [0.0; 2])
            || support.tilt_mounts() != [Mount::Fixed; 2]
            || support.coupled.is_some()
    }
}

impl Scene {
    /// The components of a body's motion, where nobody says which: of a ring that may lean also those of its tilts.
    pub(crate) fn components_of(&self, body: &str) -> &'static [Component] {
        let leans = match body {
            "outer" => self.outer_ring.leans(),
            "inner" => self.inner_ring.leans(),
            _ => false,
        };
        if leans {
            &Component::OF_LEANING
        } else {
            &Component::ALL
        }
    }

    /// Whether a ring may lean. Where none does, rings have four directions and nobody hears of tilts.
    pub(crate) fn leans(&self) -> bool {
        self.outer_ring.leans() || self.inner_ring.leans()
    }

    /// What reductions by request do not know yet is refused.
    pub(super) fn check_leaning(&self) -> Result<()> {
        if self.leans() && self.approximations != Approximations::NONE {
            return Err(Error::scene(
                "approximations",
                "asked for",
                "none where a ring may tilt: they are of rings that stay parallel",
            ));
        }
        Ok(())
    }
}
