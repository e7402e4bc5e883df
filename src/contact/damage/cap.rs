//! Caps of a ball: its surface is absent within the angle β of a unit vector e that is fixed in the ball.
//!
//! A slice at ζ of radius ρ has lost an arc to it (e in the ring's frame, e_∥ the length of its part in the plane and ê that
//! part's direction):
//!
//! ```text
//! middle ψ_e, the angle of ê;  half-width h = arccos C,  C = (R cos β − ζ e_z)/(ρ e_∥);   C ≥ 1: whole,  C ≤ −1: all absent
//! dh/dζ = −C'/√(1 − C²),  C' = −e_z/(ρ e_∥) + C ζ/ρ²
//! ```
//!
//! Fault circles stand at its ends ψ_j = ψ_e ± h as at those of any other arc. What differs is that any rotation of the ball
//! moves them, and not only one about the ring's axis: an angular velocity w turns e, and so ψ_j by w · (e × ∂ψ_j/∂e). That
//! vector is the edge's **turn axis**,
//!
//! ```text
//! e × ∂ψ_e/∂e = ẑ − (e_z/e_∥) ê,     e × ∂h/∂e = −(ζ/ρ − C e_z/e_∥)/√(1 − C²) ẑ × ê
//! ```
//!
//! and ẑ for whatever only turns about the ring's axis. With ∂s/∂ψ_j = arm × n_e, a normal force N n_e at the edge puts the
//! moment −N ∂s/∂ψ_j · (turn axis) on the ball (see [`ContactForce`](crate::contact::ContactForce)).
//!
//! No force jumps at the rim. At C = −1 one would: there a cap holds a pole of the ball, and its rim passes that on the far
//! side, which the width that scenes allow keeps beyond 61 degrees, where no contact runs.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::arc::{Arc, EdgeCourse, Rim, Station};
use super::direction::ContactDirection;
use super::patch::CircleEdges;
use super::{Acts, AnyForm, Bed, CompiledForm, Cuts, MARGIN, SurfaceDefect};
use crate::contact::{V2, turned};

/// A cap, compiled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CompiledCap {
    /// Radius of the ball \[m\].
    radius: f64,
    /// sin β and cos β.
    sin: f64,
    cos: f64,
    edges: CircleEdges,
}

/// Part of a slice that is lost to a cap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Lost {
    Nothing,
    Arc(Rim),
    All,
}

impl CompiledForm for CompiledCap {
    fn reach(&self, angle: f64, bed: &Bed) -> f64 {
        MARGIN * self.widest(&self.direction(angle, bed.middle))
    }

    fn pole(&self, of: &SurfaceDefect) -> Option<Vector3<f64>> {
        Some(self.direction(of.angle, of.middle))
    }

    fn half(&self, of: &SurfaceDefect, e: Option<&Vector3<f64>>) -> f64 {
        e.map_or(of.reach / MARGIN, |e| self.widest(e))
    }

    fn is_near(
        &self,
        of: &SurfaceDefect,
        direction: &ContactDirection,
        e: Option<&Vector3<f64>>,
    ) -> bool {
        match e {
            None => direction.offset(of).abs() <= of.reach,
            Some(e) => self.in_reach(e, direction.n),
        }
    }

    fn widened(&mut self, _half_width: f64) -> Option<f64> {
        None
    }

    fn mirrored(&self) -> AnyForm {
        AnyForm::Cap(*self)
    }

    fn acts(&self) -> Acts<'_> {
        Acts::Cuts(self)
    }
}

impl Cuts for CompiledCap {
    fn arc(
        &self,
        of: &SurfaceDefect,
        at: &Station,
        middle: f64,
        e: Option<&Vector3<f64>>,
    ) -> Option<Arc> {
        let radius = self.edges.radius + of.film_layer;
        match self.lost(e?, at.z, at.radius) {
            Lost::Nothing => None,
            Lost::Arc(rim) => Some(Arc::about(middle, rim.half, radius, EdgeCourse::Rim(rim))),
            Lost::All => Some(Arc::all(middle, radius)),
        }
    }

    /// Length of the cap, none: it has a rim all round.
    fn length(&self) -> Option<f64> {
        None
    }

    fn crossings(&self, e: &Vector3<f64>, n: V2) -> Option<[f64; 2]> {
        // Of the point at a latitude its part along e, cos · n·e + sin · e_z, is cos β.
        let (across, along) = (n.dot(&e.xy()), e.z);
        let half = self.cos / across.hypot(along);
        let middle = along.atan2(across);
        (half < 1.0).then(|| [-1.0, 1.0].map(|s| self.radius * (middle + s * half.acos()).sin()))
    }

    fn floor(&self) -> Option<(f64, usize)> {
        self.edges.floor
    }
}

impl CompiledCap {
    /// A cap so wide along the surface of a ball of a radius \[m\], compiled.
    pub fn new(width: f64, radius: f64, edges: CircleEdges) -> Self {
        let (sin, cos) = (width / (2.0 * radius)).sin_cos();
        Self {
            radius,
            sin,
            cos,
            edges,
        }
    }

    /// e in the ball's frame, at an angle about z and an axial place on the surface \[m\].
    fn direction(&self, angle: f64, place: f64) -> Vector3<f64> {
        let (sin, cos) = angle.sin_cos();
        let along = place / self.radius;
        let across = (1.0 - along * along).max(0.0).sqrt();
        Vector3::new(across * cos, across * sin, along)
    }

    /// The largest half-width of all slices \[rad\].
    fn widest(&self, e: &Vector3<f64>) -> f64 {
        let across = e.xy().norm();
        if across > self.sin {
            (self.sin / across).asin()
        } else {
            PI
        }
    }

    /// Whether any slice has lost its surface in a direction of the plane.
    fn in_reach(&self, e: &Vector3<f64>, n: V2) -> bool {
        let outside = e.xy().norm_squared() - self.sin * self.sin;
        outside <= 0.0 || n.dot(&e.xy()) >= outside.sqrt()
    }

    /// The loss of the slice at ζ of radius ρ.
    fn lost(&self, e: &Vector3<f64>, zeta: f64, rho: f64) -> Lost {
        let across = e.xy().norm();
        let c = (self.radius * self.cos - zeta * e.z) / (rho * across);
        if c >= 1.0 {
            return Lost::Nothing;
        }
        // Nor where e stands on the ring's axis and the slice on the rim.
        if c.partial_cmp(&-1.0) != Some(std::cmp::Ordering::Greater) {
            return Lost::All;
        }
        Lost::Arc(rim(c, e, zeta / rho, rho))
    }
}

/// The rim of a slice, from C, e, ζ/ρ and ρ.
fn rim(c: f64, e: &Vector3<f64>, over: f64, rho: f64) -> Rim {
    let across = e.xy().norm();
    let by_c = -1.0 / (1.0 - c * c).sqrt();
    let (rise, towards) = (e.z / across, e.xy() / across);
    Rim {
        half: c.acos(),
        slope: by_c * (c * over - rise) / rho,
        turn_axis: [
            towards * -rise,
            turned(towards) * (by_c * (over - c * rise)),
        ],
    }
}
