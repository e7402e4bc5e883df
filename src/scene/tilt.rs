//! Rings that tilt: which may, and their components of motion.

use super::ring::{Mount, Ring, Support};
use super::{Component, Scene};

impl Support {
    /// The mounts of both tilts, which are fixed where they are absent.
    pub fn tilt_mounts(&self) -> [Mount; 2] {
        [&self.tilt_x, &self.tilt_y].map(|mount| mount.clone().unwrap_or(Mount::Fixed))
    }

    /// Whether the support says anything of tilts or couples directions.
    pub(super) fn is_spatial(&self) -> bool {
        self.tilt_x.is_some() || self.tilt_y.is_some() || self.coupled.is_some()
    }
}

impl Ring {
    /// Whether the ring has tilts: one from the start, a free or sprung one, or one that its support couples with other directions.
    pub(crate) fn tilts(&self) -> bool {
        let support = &self.support;
        self.tilt.is_some_and(|tilt| tilt != [0.0; 2])
            || support.tilt_mounts() != [const { Mount::Fixed }; 2]
            || support.coupled.is_some()
    }
}

impl Scene {
    /// The components that a probe of a body records by default: of a ring that may tilt also those of its tilts, of a ball that
    /// spins freely also those about x and y.
    pub(crate) fn components_of(&self, body: &str) -> Vec<Component> {
        let beside: &[Component] = match body {
            "outer" if self.outer_ring.tilts() => &Component::OF_TILTS,
            "inner" if self.inner_ring.tilts() => &Component::OF_TILTS,
            "outer" | "inner" => &[],
            _ if self.balls_turn() => &Component::OF_TURNS,
            _ => &[],
        };
        [&Component::ALL, beside].concat()
    }

    /// Whether a ring may tilt. Where none does, rings have four directions and tilts do not occur.
    pub(crate) fn tilts(&self) -> bool {
        self.outer_ring.tilts() || self.inner_ring.tilts()
    }
}
