//! Fault circles of ring and ball against whatever stands opposite ([*Defects*](crate::equations#defects)).

use super::arc::{Edge, WITH_RING_AXIS};
use super::depth::Depth;
use super::facing::{Facing, Node};
use super::surfaces::{RingSurface, SurfaceKind, WaveSlope};
use crate::contact::profile::Raise;
use crate::contact::{V2, turned};

impl Facing<'_> {
    /// A fault circle of the ring against the smooth slice.
    pub(super) fn ring_circle<D: Depth>(
        &self,
        node: &Node,
        edge: &Edge,
        depth: f64,
    ) -> RingSurface<D> {
        let raise = self.race_side.waves.raise(self.on_ring + edge.angle);
        let sigma = self.race.sigma;
        let reach = node.torus_radius + raise.height + sigma * (edge.radius + depth);
        let u = rotated(self.n, edge.angle);
        let from_ring = u * reach;
        let away = from_ring - self.apart;
        let distance = away.norm();
        let n_e = away / distance;
        // How the centre moves along z.
        let slope = if D::SLOPES {
            let race_slope = self.race_slope(node);
            let turn = edge.turn(node.torus_radius, race_slope);
            u * (race_slope + raise.slope * turn) + turned(u) * (reach * turn)
        } else {
            V2::zeros()
        };
        RingSurface {
            shape: SurfaceKind::Circle {
                from_ring,
                radius: edge.radius,
                slope,
            },
            n_e,
            s: D::new(
                node.rho + edge.radius - distance,
                -n_e.dot(&slope),
                -node.zeta / node.rho,
            ),
            drops: (D::new(0.0, 0.0, 0.0), D::NEVER),
            arm_ring: from_ring - n_e * edge.radius,
            wave_slope: WaveSlope::default(),
            turn_axis: WITH_RING_AXIS,
        }
    }

    /// A fault circle of the ball against a surface of the ring, and tan α from the gradient of its gap.
    pub(super) fn ball_circle<D: Depth>(
        &self,
        node: &Node,
        surface: &RingSurface<D>,
        edge: &Edge,
        depth: f64,
    ) -> (RingSurface<D>, f64) {
        let u = rotated(surface.n_e, edge.angle);
        let lever = node.rho - edge.radius - depth;
        let arm = u * lever;
        // ∂c/∂ζ of c = (ρ − R_f − depth) u(ψ), ψ = φ ± w/(2ρ) or ψ_e ± h, ρ' = −ζ/ρ.
        let rho_slope = -node.zeta / node.rho;
        let turn = edge.turn(node.rho, rho_slope);
        let slope = u * rho_slope + turned(u) * (lever * turn);
        let mut met = match surface.shape {
            SurfaceKind::Race => self.circle_on_race(node, surface, edge, arm),
            SurfaceKind::Circle { .. } => self.circle_on_circle(surface, edge, arm),
        };
        let tan = met.wave_slope.force.dot(&slope) - met.n_e.dot(&slope);
        met.s = met.s.along_ball(-tan);
        met.turn_axis = edge.turn_axis();
        (met, tan)
    }

    /// A fault circle of the ball, its centre at some arm, against the race.
    fn circle_on_race<D: Depth>(
        &self,
        node: &Node,
        surface: &RingSurface<D>,
        edge: &Edge,
        arm: V2,
    ) -> RingSurface<D> {
        let from_ring = self.apart + arm;
        let distance = from_ring.norm();
        let m = from_ring / distance;
        let waves = self.race_side.waves;
        let raise = if waves.is_round() {
            Raise::default()
        } else {
            waves.raise(self.r.angle_of(m.y.atan2(m.x)))
        };
        let radius = node.torus_radius + raise.height;
        let sigma = self.race.sigma;
        RingSurface {
            n_e: m * sigma,
            s: D::new(
                sigma * (distance - radius) + edge.radius,
                -sigma * self.race_slope(node),
                0.0,
            ),
            arm_ring: m * radius,
            wave_slope: self.wave_slope(m, distance, raise.slope, arm),
            ..*surface
        }
    }

    /// The same against a fault circle of the ring.
    fn circle_on_circle<D: Depth>(
        &self,
        surface: &RingSurface<D>,
        edge: &Edge,
        arm: V2,
    ) -> RingSurface<D> {
        let SurfaceKind::Circle {
            from_ring: other,
            radius,
            slope,
        } = surface.shape
        else {
            return *surface;
        };
        let away = other - self.apart - arm;
        let distance = away.norm();
        let n_e = away / distance;
        RingSurface {
            n_e,
            s: D::new(radius + edge.radius - distance, -n_e.dot(&slope), 0.0),
            arm_ring: other - n_e * radius,
            ..*surface
        }
    }
}

/// A unit vector turned by an angle.
fn rotated(v: V2, angle: f64) -> V2 {
    let (sin, cos) = angle.sin_cos();
    v * cos + turned(v) * sin
}
