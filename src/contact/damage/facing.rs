//! A ball before a race, and a slice of it: what the surfaces that they meet are computed from.

use super::SurfaceDefect;
use super::arc::Station;
use super::hole::Unloading;
use crate::contact::laws::Law;
use crate::contact::profile::{Inclination, RaceSurface, Raise, Section};
use crate::contact::{Motion, Torus, V2, Waves};

/// A contact as its geometry, and what its surfaces are made of.
#[derive(Clone, Copy)]
pub(in crate::contact) struct Facing<'a> {
    /// The torus, or that of the circle of curvature of another shape where it is met.
    pub race: Torus,
    /// The race where it is a curve through points.
    pub surface: Option<RaceSurface<'a>>,
    pub race_side: SurfaceSide<'a>,
    pub ball_side: SurfaceSide<'a>,
    pub law: &'a Law,
    /// Radius of the ball \[m\].
    pub radius: f64,
    pub b: &'a Motion,
    pub r: &'a Motion,
    /// Vector from the ring's centre to the ball's.
    pub apart: V2,
    pub distance: f64,
    /// Axial place of the ball in the ring's frame.
    pub z: f64,
    /// Unit vector of `apart`.
    pub n: V2,
    /// Direction of the ball in the ring's frame.
    pub on_ring: f64,
    /// Raise of the race by its waves.
    pub raise: Raise<f64>,
    /// Raise of the ball by its texture.
    pub swell: Raise<f64>,
    /// Whether arcs where the race or the ball is absent may be met.
    pub ring_open: bool,
    pub ball_open: bool,
    /// Scale of the contact's elastic forces by damages smaller than it.
    pub unloading: Unloading,
    pub section: Section<f64>,
}

/// Waves and defects of a surface.
#[derive(Clone, Copy)]
pub(in crate::contact) struct SurfaceSide<'a> {
    pub waves: &'a Waves,
    pub defects: &'a [SurfaceDefect],
}

/// A slice or node, before it is known what it meets.
#[derive(Clone, Copy)]
pub(in crate::contact) struct Node {
    pub zeta: f64,
    pub rho: f64,
    /// Place in the ring's frame.
    pub z: f64,
    pub width: f64,
    /// Healthy penetration that the law sees.
    pub depth: f64,
    /// Height of the groove over its centre at z.
    pub groove: f64,
    /// Radius of the round race at z.
    pub torus_radius: f64,
    /// Distance beside it within which defects are looked for (see [`Station`]).
    pub beside: f64,
    /// Weight of friction here over the normal force.
    pub friction_weight: f64,
}

impl Node {
    /// The node's station on the race.
    pub(super) fn on_ring(&self) -> Station {
        Station {
            z: self.z,
            beside: self.beside,
            radius: self.torus_radius,
        }
    }

    /// The node's station on the ball.
    pub(super) fn on_ball(&self) -> Station {
        Station {
            z: self.zeta,
            beside: self.beside,
            radius: self.rho,
        }
    }
}

impl Facing<'_> {
    /// The common normal, where all elements press along it.
    pub fn common(&self) -> Option<Inclination<f64>> {
        let is_flat = self.law.cut().is_flat();
        is_flat.then_some(self.section.normal)
    }

    /// Fall of the law's penetration over that of the geometry: 1, or cos α' for the Hertz law.
    pub fn drop_share(&self) -> f64 {
        self.common().map_or(1.0, |normal| normal.cos)
    }

    /// Height of the race over the groove's centre at an axial place of the ring's frame; none where there is none.
    pub fn groove(&self, z: f64) -> Option<f64> {
        match &self.surface {
            None => self.race.groove(z),
            Some(surface) => Some(self.race.sigma * (surface.at(z)?.radius - self.race.a)),
        }
    }

    /// Slope of the race's radius along z.
    pub(super) fn race_slope(&self, node: &Node) -> f64 {
        match &self.surface {
            None => self.race.slope(node.z, node.torus_radius),
            Some(surface) => surface.curve.at(node.z).slope,
        }
    }
}
