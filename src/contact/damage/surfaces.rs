//! Surfaces that a slice touches: those of the ring against those of the ball.
//!
//! A slice can meet several surfaces: the race itself, or the fault circles of a ring
//! defect; and seen from each of these the ball is smooth, or a pair of circles of a ball defect. A
//! surface carries `law(s − a) − law(s − b)` of the healthy penetration s, its *drops* a and b:
//!
//! | surface | a | b |
//! |---|---|---|
//! | race, healthy | 0 | ∞ |
//! | edge j of an absent arc | s_race − s_j | (s_race − s₁) + (s_race − s₂) |
//! | race behind the arc | (s_race − s₁) + (s_race − s₂) | ∞ |
//! | recessed circle | s_race − s_circle | ∞ |
//!
//! so that edges carry the law at s_j less the law at s₁₂ = s₁ + s₂ − s_race and the race the law at s₁₂
//! (the narrow rule of [*Defects*](crate::equations#defects)). A ball defect splits each of these terms once more in the same way.
//! What the gradients of these energies have beside forces along normals stands in `gradient`.

use nalgebra::Vector3;

use super::arc::{Arc, Edge, WITH_RING_AXIS, absent, floors};
use super::depth::Depth;
use super::direction::ContactDirection;
use super::facing::{Facing, Node};
use crate::contact::profile::Raise;
use crate::contact::{V2, turned};

/// The ring's side of a surface.
#[derive(Clone, Copy)]
pub(in crate::contact) enum SurfaceKind {
    Race,
    Circle {
        from_ring: V2,
        radius: f64,
        /// Motion of the centre along z, by length.
        slope: V2,
    },
}

/// The tangential force that the slope of the waves adds, over the force along n_e, and its arm from the ball's centre.
#[derive(Clone, Copy, Default)]
pub(in crate::contact) struct WaveSlope {
    pub force: V2,
    pub arm: V2,
}

/// A surface of the ring that a slice can meet.
#[derive(Clone, Copy)]
pub(in crate::contact) struct RingSurface<D> {
    pub shape: SurfaceKind,
    /// Unit vector out of the ball.
    pub n_e: V2,
    /// Penetration of the smooth ball against it, by geometry.
    pub s: D,
    pub drops: (D, D),
    pub arm_ring: V2,
    pub wave_slope: WaveSlope,
    /// How rotations of the ball move it along its slice (see `cap`).
    pub turn_axis: Vector3<f64>,
}

/// A surface of the ring against one of the ball.
#[derive(Clone, Copy)]
pub(in crate::contact) struct SurfacePair<D> {
    pub surface: RingSurface<D>,
    /// Drops of the ball's side.
    pub ball_drops: (D, D),
    pub tan: f64,
}

impl<D: Depth> SurfacePair<D> {
    fn smooth(surface: RingSurface<D>, node: &Node) -> Self {
        Self {
            surface,
            ball_drops: (D::new(0.0, 0.0, 0.0), D::NEVER),
            tan: node.zeta / node.rho,
        }
    }

    /// The four drops of the law's argument and their signs; an infinite one does not count.
    pub fn terms(&self) -> [(f64, D); 4] {
        let ((a, b), (p, q)) = (self.surface.drops, self.ball_drops);
        [(1.0, a + p), (-1.0, a + q), (-1.0, b + p), (1.0, b + q)]
    }
}

/// Penetrations of all elements that a place may meet; their zeros end the elements' zones.
pub(in crate::contact) struct Penetrations {
    pub values: [f64; MOST_KEPT],
    pub count: usize,
}

/// Penetrations that are kept; a bed of floor circles can have more, at some loss of accuracy.
const MOST_KEPT: usize = 24;

impl Facing<'_> {
    /// Whether a surface is absent where the slice meets it.
    pub(in crate::contact) fn is_open(&self, node: &Node) -> bool {
        let direction = self.n * self.race.sigma;
        self.ring_arc(node).is_some() || self.ball_arc(node, direction).is_some()
    }

    /// Penetrations of the elements at a place, touching or not.
    pub(in crate::contact) fn penetrations(&self, node: &Node) -> Penetrations {
        let mut found = Penetrations {
            values: [0.0; MOST_KEPT],
            count: 0,
        };
        let share = self.drop_share();
        self.surface_pairs(node, &mut |met: &SurfacePair<f64>| {
            for (_, drop) in met.terms() {
                if drop.value() < f64::INFINITY && found.count < MOST_KEPT {
                    found.values[found.count] = node.depth - share * drop.value();
                    found.count += 1;
                }
            }
        });
        found
    }

    pub(super) fn ring_arc(&self, node: &Node) -> Option<Arc> {
        if self.ring_open {
            let direction = ContactDirection::race(self.on_ring);
            absent(self.race_side.defects, &node.on_ring(), &direction)
        } else {
            None
        }
    }

    pub(super) fn ball_arc(&self, node: &Node, direction: V2) -> Option<Arc> {
        if !self.ball_open {
            return None;
        }
        absent(
            self.ball_side.defects,
            &node.on_ball(),
            &self.out_of_ball(direction),
        )
    }

    /// A direction in which the ball is met.
    fn out_of_ball(&self, direction: V2) -> ContactDirection<'_> {
        ContactDirection::ball(self.b, direction, direction.y.atan2(direction.x))
    }

    /// Places ζ between which caps of the ball have taken away what would meet the race.
    pub(in crate::contact) fn crossings(&self) -> impl Iterator<Item = f64> + Clone {
        let n = self.n * self.race.sigma;
        let defects = self.ball_side.defects.iter().filter(|_| self.ball_open);
        defects
            .filter_map(move |defect| defect.crossings(self.b, n))
            .flatten()
    }

    /// All pairs of surfaces that stand against each other at a slice.
    pub(in crate::contact) fn surface_pairs<D: Depth>(
        &self,
        node: &Node,
        visit: &mut impl FnMut(&SurfacePair<D>),
    ) {
        let race = self.race_element(node);
        let Some(arc) = self.ring_arc(node) else {
            self.surface(node, &race, visit);
            return;
        };
        // One by one: large structs in arrays are copied where the compiler does not take their maps apart.
        let first = self.ring_circle(node, &arc.low, 0.0);
        let second = self.ring_circle(node, &arc.high, 0.0);
        let drops = [race.s - first.s, race.s - second.s];
        let both = drops[0] + drops[1];
        for (edge, drop) in [(&first, drops[0]), (&second, drops[1])] {
            let drops = (drop, both);
            self.surface(node, &RingSurface { drops, ..*edge }, visit);
        }
        let drops = (both, D::NEVER);
        self.surface(node, &RingSurface { drops, ..race }, visit);
        let direction = ContactDirection::race(self.on_ring);
        for (edge, depth) in floors(self.race_side.defects, node.on_ring(), direction, &arc) {
            let circle = self.ring_circle(node, &edge, depth);
            let drops = (race.s - circle.s, D::NEVER);
            self.surface(node, &RingSurface { drops, ..circle }, visit);
        }
    }

    /// The race, whole.
    fn race_element<D: Depth>(&self, node: &Node) -> RingSurface<D> {
        let sigma = self.race.sigma;
        RingSurface {
            shape: SurfaceKind::Race,
            n_e: self.n * sigma,
            s: D::new(
                self.section.penetration(node.rho, node.groove) - self.raised_in_plane(),
                -sigma * self.race_slope(node),
                -node.zeta / node.rho,
            ),
            drops: (D::new(0.0, 0.0, 0.0), D::NEVER),
            arm_ring: self.n * (node.torus_radius + self.raise.height),
            wave_slope: self.wave_slope(self.n, self.distance, self.raise.slope, V2::zeros()),
            turn_axis: WITH_RING_AXIS,
        }
    }

    /// The ball's texture as it adds to penetrations in the plane, where the law counts those: drops are of smooth balls \[m\].
    fn raised_in_plane(&self) -> f64 {
        if self.common().is_some() {
            0.0
        } else {
            self.swell.height
        }
    }

    /// Effect of the waves' slope in a direction and at a distance from the ring's centre.
    pub(super) fn wave_slope(&self, n: V2, distance: f64, slope: f64, arm: V2) -> WaveSlope {
        if self.race_side.waves.is_round() {
            return WaveSlope::default();
        }
        let force = turned(n) * (self.race.sigma * slope / distance);
        WaveSlope { force, arm }
    }

    /// A surface of the ring against the ball, smooth or not.
    fn surface<D: Depth>(
        &self,
        node: &Node,
        surface: &RingSurface<D>,
        visit: &mut impl FnMut(&SurfacePair<D>),
    ) {
        let Some(arc) = self.ball_arc(node, surface.n_e) else {
            visit(&SurfacePair::smooth(*surface, node));
            return;
        };
        if arc.is_all() {
            return;
        }
        let meet = |edge: &Edge, depth: f64| {
            let (met, tan) = self.ball_circle(node, surface, edge, depth);
            (surface.s - met.s, met, tan)
        };
        let (drop_1, first, tan_1) = meet(&arc.low, 0.0);
        let (drop_2, second, tan_2) = meet(&arc.high, 0.0);
        let both = drop_1 + drop_2;
        visit(&SurfacePair {
            surface: first,
            ball_drops: (drop_1, both),
            tan: tan_1,
        });
        visit(&SurfacePair {
            surface: second,
            ball_drops: (drop_2, both),
            tan: tan_2,
        });
        let ball_drops = (both, D::NEVER);
        visit(&SurfacePair {
            ball_drops,
            ..SurfacePair::smooth(*surface, node)
        });
        let direction = self.out_of_ball(surface.n_e);
        for (edge, depth) in floors(self.ball_side.defects, node.on_ball(), direction, &arc) {
            let (drop, circle, tan) = meet(&edge, depth);
            visit(&SurfacePair {
                surface: circle,
                ball_drops: (drop, D::NEVER),
                tan,
            });
        }
    }
}

/// Fault circles of ring and ball against whatever stands opposite ([*Defects*](crate::equations#defects)).
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

    /// Surface of the ring where a fault circle of the ball meets one of the ring.
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
