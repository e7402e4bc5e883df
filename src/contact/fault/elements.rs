//! What a slice meets: features of the ring against features of the ball.
//!
//! The surfaces that a slice can meet are *features*: the race itself, or the fault circles of a ring
//! defect; and seen from each of these the ball is smooth, or a pair of circles of a ball defect. A
//! feature carries `law(s − a) − law(s − b)` of the healthy penetration s, its *drops* a and b:
//!
//! | feature | a | b |
//! |---|---|---|
//! | race, healthy | 0 | ∞ |
//! | edge j of an absent arc | s_race − s_j | (s_race − s₁) + (s_race − s₂) |
//! | race behind the arc | (s_race − s₁) + (s_race − s₂) | ∞ |
//! | recessed circle | s_race − s_circle | ∞ |
//!
//! so that edges carry the law at s_j less the law at s₁₂ = s₁ + s₂ − s_race and the race the law at s₁₂
//! (the narrow rule of model section 7). A ball defect splits each of these terms once more in the same way.
//! What the gradients of these energies have beside forces along normals stands in `gradient`.

use std::ops::{Add, Sub};

use super::{Arc, Edge, absent, floors};
use crate::contact::kernel::{self, State};
use crate::contact::profile::Raise;
use crate::contact::scalar::{Contact, Node};
use crate::contact::{Aside, Sink, Touch, V2, turned};

/// The ring's side of a feature.
#[derive(Clone, Copy)]
enum Shape {
    Race,
    Circle {
        from_ring: V2,
        radius: f64,
        /// How its centre moves along z, by length.
        slope: V2,
    },
}

/// By how much an element stands behind another \[m\], or a penetration: alone, or with what its gradient needs.
pub(super) trait Depth: Copy + Add<Output = Self> + Sub<Output = Self> {
    /// Whether it has slopes.
    const SLOPES: bool;
    /// Out of reach.
    const NEVER: Self;

    /// From its value and slopes.
    fn new(value: f64, by_z: f64, by_zeta: f64) -> Self;

    fn value(self) -> f64;

    /// The same with another slope along the ball.
    fn along_ball(self, by_zeta: f64) -> Self;
}

impl Depth for f64 {
    const SLOPES: bool = false;
    const NEVER: Self = Self::INFINITY;

    fn new(value: f64, _by_z: f64, _by_zeta: f64) -> Self {
        value
    }

    fn value(self) -> f64 {
        self
    }

    fn along_ball(self, _by_zeta: f64) -> Self {
        self
    }
}

/// With its slopes.
#[derive(Clone, Copy)]
pub(super) struct Sloped {
    pub(super) value: f64,
    /// Its derivative by the place z in the ring's frame, at a fixed slice of the ball.
    pub(super) by_z: f64,
    /// Its derivative by the slice ζ, at a fixed place in the ring's frame.
    pub(super) by_zeta: f64,
}

impl Depth for Sloped {
    const SLOPES: bool = true;
    const NEVER: Self = Self {
        value: f64::INFINITY,
        by_z: 0.0,
        by_zeta: 0.0,
    };

    fn new(value: f64, by_z: f64, by_zeta: f64) -> Self {
        Self {
            value,
            by_z,
            by_zeta,
        }
    }

    fn value(self) -> f64 {
        self.value
    }

    fn along_ball(self, by_zeta: f64) -> Self {
        Self { by_zeta, ..self }
    }
}

impl Add for Sloped {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            by_z: self.by_z + other.by_z,
            by_zeta: self.by_zeta + other.by_zeta,
        }
    }
}

impl Sub for Sloped {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            by_z: self.by_z - other.by_z,
            by_zeta: self.by_zeta - other.by_zeta,
        }
    }
}

/// The tangential force that the slope of the waves adds, over the force along n_e, and its arm from the ball's centre.
#[derive(Clone, Copy, Default)]
struct Lean {
    force: V2,
    arm: V2,
}

/// A surface of the ring that a slice can meet.
#[derive(Clone, Copy)]
struct Feature<D> {
    shape: Shape,
    /// Unit vector out of the ball.
    n_e: V2,
    /// Penetration of the smooth ball against it, by geometry.
    s: D,
    drops: (D, D),
    arm_ring: V2,
    lean: Lean,
}

/// One feature of the ring against one of the ball.
#[derive(Clone, Copy)]
pub(super) struct Meeting<D> {
    feature: Feature<D>,
    /// Drops of the ball's side.
    ball_drops: (D, D),
    tan: f64,
}

impl<D: Depth> Meeting<D> {
    fn smooth(feature: Feature<D>, node: &Node) -> Self {
        Self {
            feature,
            ball_drops: (D::new(0.0, 0.0, 0.0), D::NEVER),
            tan: node.zeta / node.rho,
        }
    }

    /// The four drops of the law's argument and their signs; an infinite one does not count.
    pub(super) fn terms(&self) -> [(f64, D); 4] {
        let ((a, b), (p, q)) = (self.feature.drops, self.ball_drops);
        [(1.0, a + p), (-1.0, a + q), (-1.0, b + p), (1.0, b + q)]
    }
}

/// Penetrations of all elements that a place may meet; their zeros end the elements' zones.
pub(in crate::contact) struct Levels {
    pub(in crate::contact) values: [f64; MOST_LEVELS],
    pub(in crate::contact) count: usize,
}

/// Levels that are kept; a bed of floor circles can have more, at some loss of accuracy.
const MOST_LEVELS: usize = 24;

impl Contact<'_> {
    /// One slice against whatever it meets.
    pub(in crate::contact) fn slice<S: Sink>(&self, node: &Node, sink: &mut S) {
        if node.depth <= 0.0 {
            return;
        }
        if !self.pair.race.reaches(node.z) {
            sink.truncated();
            return;
        }
        // Forces along normals are all there is to the ISO law, and where surfaces are whole.
        if self.common().is_some() && (self.ring_open || self.ball_open) {
            self.meetings(node, &mut |meeting: &Meeting<Sloped>| {
                if self.press(node, meeting, sink) {
                    self.tilt(node, meeting, sink);
                }
            });
        } else {
            self.meetings(node, &mut |meeting: &Meeting<f64>| {
                self.press(node, meeting, sink);
            });
        }
    }

    /// Whether a surface is absent where the slice meets it.
    pub(in crate::contact) fn is_open(&self, node: &Node) -> bool {
        let direction = self.n * self.pair.race.sigma;
        self.ring_arc(node).is_some() || self.ball_arc(node, direction).is_some()
    }

    /// Penetrations of the elements at a place, touching or not.
    pub(in crate::contact) fn levels(&self, node: &Node) -> Levels {
        let mut levels = Levels {
            values: [0.0; MOST_LEVELS],
            count: 0,
        };
        let share = self.drop_share();
        self.meetings(node, &mut |meeting: &Meeting<f64>| {
            for (_, drop) in meeting.terms() {
                if drop.value() < f64::INFINITY && levels.count < MOST_LEVELS {
                    levels.values[levels.count] = node.depth - share * drop.value();
                    levels.count += 1;
                }
            }
        });
        levels
    }

    /// Fall of the law's penetration over that of the geometry: 1, or cos α' for the Hertz law.
    pub(super) fn drop_share(&self) -> f64 {
        self.common().map_or(1.0, |(cos, _)| cos)
    }

    fn ring_arc(&self, node: &Node) -> Option<Arc> {
        let faults = &self.pair.faults;
        if self.ring_open {
            absent(faults, &node.on_ring(), self.on_ring)
        } else {
            None
        }
    }

    fn ball_arc(&self, node: &Node, direction: V2) -> Option<Arc> {
        if !self.ball_open {
            return None;
        }
        let angle = direction.y.atan2(direction.x) - self.b.theta;
        absent(&self.ball.faults, &node.on_ball(), angle)
    }

    /// All pairs of features that stand against each other at a slice.
    pub(super) fn meetings<D: Depth>(&self, node: &Node, visit: &mut impl FnMut(&Meeting<D>)) {
        let race = self.race_feature(node);
        let Some(arc) = self.ring_arc(node) else {
            self.feature(node, &race, visit);
            return;
        };
        let [first, second] = [arc.low, arc.high].map(|edge| self.ring_circle(node, &edge, 0.0));
        let drops = [race.s - first.s, race.s - second.s];
        let both = drops[0] + drops[1];
        for (edge, drop) in [first, second].into_iter().zip(drops) {
            let drops = (drop, both);
            self.feature(node, &Feature { drops, ..edge }, visit);
        }
        let drops = (both, D::NEVER);
        self.feature(node, &Feature { drops, ..race }, visit);
        for (edge, depth) in floors(&self.pair.faults, node.on_ring(), self.on_ring, &arc) {
            let circle = self.ring_circle(node, &edge, depth);
            let drops = (race.s - circle.s, D::NEVER);
            self.feature(node, &Feature { drops, ..circle }, visit);
        }
    }

    /// The race, whole.
    fn race_feature<D: Depth>(&self, node: &Node) -> Feature<D> {
        let sigma = self.pair.race.sigma;
        Feature {
            shape: Shape::Race,
            n_e: self.n * sigma,
            s: D::new(
                self.section.penetration(node.rho, node.groove),
                -sigma * self.race_slope(node),
                -node.zeta / node.rho,
            ),
            drops: (D::new(0.0, 0.0, 0.0), D::NEVER),
            arm_ring: self.n * (node.torus_radius + self.raise.height),
            lean: self.lean(self.n, self.distance, self.raise.slope, V2::zeros()),
        }
    }

    /// What the waves' slope does in a direction and at a distance from the ring's centre.
    fn lean(&self, n: V2, distance: f64, slope: f64, arm: V2) -> Lean {
        if self.pair.waves.is_round() {
            return Lean::default();
        }
        let force = turned(n) * (self.pair.race.sigma * slope / distance);
        Lean { force, arm }
    }

    /// Slope of the race's radius along z.
    fn race_slope(&self, node: &Node) -> f64 {
        self.pair.race.slope(node.z, node.torus_radius)
    }

    /// A fault circle of the ring against the smooth slice.
    fn ring_circle<D: Depth>(&self, node: &Node, edge: &Edge, depth: f64) -> Feature<D> {
        let raise = self.pair.waves.raise(self.on_ring + edge.angle);
        let sigma = self.pair.race.sigma;
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
        Feature {
            shape: Shape::Circle {
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
            lean: Lean::default(),
        }
    }

    /// A feature of the ring against the ball, smooth or not.
    fn feature<D: Depth>(
        &self,
        node: &Node,
        feature: &Feature<D>,
        visit: &mut impl FnMut(&Meeting<D>),
    ) {
        let Some(arc) = self.ball_arc(node, feature.n_e) else {
            visit(&Meeting::smooth(*feature, node));
            return;
        };
        let meet = |edge: &Edge, depth: f64| {
            let (met, tan) = self.ball_circle(node, feature, edge, depth);
            (feature.s - met.s, met, tan)
        };
        let (drop_1, first, tan_1) = meet(&arc.low, 0.0);
        let (drop_2, second, tan_2) = meet(&arc.high, 0.0);
        let both = drop_1 + drop_2;
        visit(&Meeting {
            feature: first,
            ball_drops: (drop_1, both),
            tan: tan_1,
        });
        visit(&Meeting {
            feature: second,
            ball_drops: (drop_2, both),
            tan: tan_2,
        });
        let ball_drops = (both, D::NEVER);
        visit(&Meeting {
            ball_drops,
            ..Meeting::smooth(*feature, node)
        });
        let angle = feature.n_e.y.atan2(feature.n_e.x) - self.b.theta;
        for (edge, depth) in floors(&self.ball.faults, node.on_ball(), angle, &arc) {
            let (drop, circle, tan) = meet(&edge, depth);
            visit(&Meeting {
                feature: circle,
                ball_drops: (drop, D::NEVER),
                tan,
            });
        }
    }

    /// A fault circle of the ball against a feature of the ring, and tan α from the gradient of its gap.
    fn ball_circle<D: Depth>(
        &self,
        node: &Node,
        feature: &Feature<D>,
        edge: &Edge,
        depth: f64,
    ) -> (Feature<D>, f64) {
        let u = rotated(feature.n_e, edge.angle);
        let lever = node.rho - edge.radius - depth;
        let arm = u * lever;
        // ∂c/∂ζ of c = (ρ − R_f − depth) u(ψ), ψ = φ ± w/(2ρ), ρ' = −ζ/ρ.
        let rho_slope = -node.zeta / node.rho;
        let turn = edge.turn(node.rho, rho_slope);
        let slope = u * rho_slope + turned(u) * (lever * turn);
        let mut met = match feature.shape {
            Shape::Race => self.circle_on_race(node, feature, edge, arm),
            Shape::Circle { .. } => self.circle_on_circle(feature, edge, arm),
        };
        let tan = met.lean.force.dot(&slope) - met.n_e.dot(&slope);
        met.s = met.s.along_ball(-tan);
        (met, tan)
    }

    /// A fault circle of the ball, its centre at some arm, against the race.
    fn circle_on_race<D: Depth>(
        &self,
        node: &Node,
        feature: &Feature<D>,
        edge: &Edge,
        arm: V2,
    ) -> Feature<D> {
        let from_ring = self.apart + arm;
        let distance = from_ring.norm();
        let m = from_ring / distance;
        let waves = &self.pair.waves;
        let raise = if waves.is_round() {
            Raise::default()
        } else {
            waves.raise(m.y.atan2(m.x) - self.r.theta)
        };
        let radius = node.torus_radius + raise.height;
        let sigma = self.pair.race.sigma;
        Feature {
            n_e: m * sigma,
            s: D::new(
                sigma * (distance - radius) + edge.radius,
                -sigma * self.race_slope(node),
                0.0,
            ),
            arm_ring: m * radius,
            lean: self.lean(m, distance, raise.slope, arm),
            ..*feature
        }
    }

    /// The same against a fault circle of the ring.
    fn circle_on_circle<D: Depth>(&self, feature: &Feature<D>, edge: &Edge, arm: V2) -> Feature<D> {
        let Shape::Circle {
            from_ring: other,
            radius,
            slope,
        } = feature.shape
        else {
            return *feature;
        };
        let away = other - self.apart - arm;
        let distance = away.norm();
        let n_e = away / distance;
        Feature {
            n_e,
            s: D::new(radius + edge.radius - distance, -n_e.dot(&slope), 0.0),
            arm_ring: other - n_e * radius,
            ..*feature
        }
    }

    /// Elastic force, damping and friction of one feature of the ring against one of the ball; false without any.
    fn press<D: Depth, S: Sink>(&self, node: &Node, meeting: &Meeting<D>, sink: &mut S) -> bool {
        let pair = self.pair;
        let share = self.drop_share();
        let (feature, tan) = (&meeting.feature, meeting.tan);
        let split = |law: &dyn Fn(f64) -> f64| {
            let at = |(sign, drop): (f64, D)| {
                if drop.value() < f64::INFINITY {
                    sign * law(node.depth - share * drop.value())
                } else {
                    0.0
                }
            };
            meeting.terms().into_iter().map(at).sum::<f64>()
        };
        let elastic = split(&|depth| pair.law.elastic.force(depth, node.width));
        if elastic <= 0.0 {
            return false;
        }
        let depth = node.depth - share * (feature.drops.0.value() + meeting.ball_drops.0.value());
        let n_e = feature.n_e;
        let state = self.state(node, feature, tan, (elastic, depth));
        let force = kernel::force::<f64, false, false>(&pair.law, &state);
        let [radial, tangential, axial] = force.friction_on_ball;
        let [v_t, u_m] = force.slip;
        let squared = v_t * v_t + u_m * u_m;
        let touch = Touch {
            zeta: node.zeta,
            z: node.z,
            width: node.width,
            depth,
            elastic,
            normal: force.normal,
            energy: if S::ENERGY {
                split(&|depth| pair.law.elastic.energy(depth, node.width))
            } else {
                0.0
            },
            approach: force.approach,
            n_e,
            share: state.share,
            friction: n_e * radial + turned(n_e) * tangential,
            friction_z: axial,
            slip: squared.sqrt(),
            friction_power: force.drag * squared,
            arm_ball: feature.arm_ring - self.apart,
            arm_ring: feature.arm_ring,
            pull: force.damped < 0.0,
        };
        sink.touch(&touch);
        if !pair.waves.is_round() {
            let Lean { force, arm } = feature.lean;
            sink.aside(&Aside {
                plane: force * (elastic * state.share.0),
                axial: 0.0,
                arm_ball: arm,
                arm_ring: self.apart + arm,
            });
        }
        true
    }
}

impl Contact<'_> {
    /// What the force of an element depends on, from its elastic force and penetration.
    fn state<D: Depth>(
        &self,
        node: &Node,
        feature: &Feature<D>,
        tan: f64,
        (elastic, depth): (f64, f64),
    ) -> State<f64> {
        let (b, r, n_e) = (self.b, self.r, feature.n_e);
        let arm_ball = feature.arm_ring - self.apart;
        let v_p = b.velocity - r.velocity + turned(arm_ball) * b.omega
            - turned(feature.arm_ring) * r.omega;
        let radius = self.ball.radius;
        // α of the slice, or of the gap's gradient at a ball's fault circle.
        let slope = if self.common().is_some() {
            (node.zeta / radius, node.rho / radius)
        } else {
            let cos = 1.0 / (1.0 + tan * tan).sqrt();
            (tan * cos, cos)
        };
        State {
            elastic,
            share: self.common().unwrap_or((1.0, tan)),
            slope,
            velocity: [v_p.dot(&n_e), v_p.dot(&turned(n_e)), b.vz - r.vz],
            load: elastic / node.width,
            depth,
            arm: feature.arm_ring.dot(&self.n) - self.distance,
            rolling: self.rolling,
            radii: [radius, self.pair.race.r],
        }
    }
}

/// A unit vector turned by an angle.
fn rotated(v: V2, angle: f64) -> V2 {
    let (sin, cos) = angle.sin_cos();
    v * cos + turned(v) * sin
}
