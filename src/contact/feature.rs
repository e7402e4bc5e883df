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

use super::fault::{Arc, Edge, absent, floors};
use super::law::hunt_crossley;
use super::pair::Contact;
use super::walk::Node;
use super::{Sink, Touch, V2, turned};

/// The ring's side of a feature.
#[derive(Clone, Copy)]
enum Shape {
    Race,
    Circle { from_ring: V2, radius: f64 },
}

/// A surface of the ring that a slice can meet.
#[derive(Clone, Copy)]
struct Feature {
    shape: Shape,
    /// Unit vector out of the ball.
    n_e: V2,
    /// Penetration of the smooth ball against it, by geometry.
    s: f64,
    drops: (f64, f64),
    arm_ring: V2,
}

/// One feature of the ring against one of the ball.
#[derive(Clone, Copy)]
struct Meeting {
    feature: Feature,
    /// Drops of the ball's side.
    ball_drops: (f64, f64),
    tan: f64,
}

impl Meeting {
    fn smooth(feature: Feature, node: &Node) -> Self {
        Self {
            feature,
            ball_drops: (0.0, f64::INFINITY),
            tan: node.zeta / node.rho,
        }
    }

    /// The four drops of the law's argument and their signs; an infinite one does not count.
    fn terms(&self) -> [(f64, f64); 4] {
        let ((a, b), (p, q)) = (self.feature.drops, self.ball_drops);
        [(1.0, a + p), (-1.0, a + q), (-1.0, b + p), (1.0, b + q)]
    }
}

/// Penetrations of all elements that a place may meet; their zeros end the elements' zones.
pub(super) struct Levels {
    pub(super) values: [f64; MOST_LEVELS],
    pub(super) count: usize,
}

/// Levels that are kept; a bed of floor circles can have more, at some loss of accuracy.
const MOST_LEVELS: usize = 24;

impl Contact<'_> {
    /// One slice against whatever it meets.
    pub(super) fn slice<S: Sink>(&self, node: &Node, sink: &mut S) {
        if node.depth <= 0.0 {
            return;
        }
        if !self.pair.race.reaches(node.z) {
            sink.truncated();
            return;
        }
        self.meetings(node, &mut |meeting| self.press(node, meeting, sink));
    }

    /// Whether a surface is absent where the slice meets it.
    pub(super) fn is_open(&self, node: &Node) -> bool {
        let direction = self.n * self.pair.race.sigma;
        self.ring_arc(node).is_some() || self.ball_arc(node, direction).is_some()
    }

    /// Penetrations of the elements at a place, touching or not.
    pub(super) fn levels(&self, node: &Node) -> Levels {
        let mut levels = Levels {
            values: [0.0; MOST_LEVELS],
            count: 0,
        };
        let share = self.drop_share();
        self.meetings(node, &mut |meeting| {
            for (_, drop) in meeting.terms() {
                if drop < f64::INFINITY && levels.count < MOST_LEVELS {
                    levels.values[levels.count] = node.depth - share * drop;
                    levels.count += 1;
                }
            }
        });
        levels
    }

    /// Fall of the law's penetration over that of the geometry: 1, or cos α' for the Hertz law.
    fn drop_share(&self) -> f64 {
        self.common.map_or(1.0, |(cos, _)| cos)
    }

    fn ring_arc(&self, node: &Node) -> Option<Arc> {
        let faults = &self.pair.faults;
        if self.ring_open {
            absent(faults, node.z, node.torus_radius, self.on_ring)
        } else {
            None
        }
    }

    fn ball_arc(&self, node: &Node, direction: V2) -> Option<Arc> {
        if !self.ball_open {
            return None;
        }
        let angle = direction.y.atan2(direction.x) - self.b.theta;
        absent(&self.ball.faults, node.zeta, node.rho, angle)
    }

    /// All pairs of features that stand against each other at a slice.
    fn meetings(&self, node: &Node, visit: &mut impl FnMut(&Meeting)) {
        let s_race = self.race_penetration(node);
        let race = |drops| Feature {
            shape: Shape::Race,
            n_e: self.n * self.pair.race.sigma,
            s: s_race,
            drops,
            arm_ring: self.n * (node.torus_radius + self.wave),
        };
        let Some(arc) = self.ring_arc(node) else {
            self.feature(node, &race((0.0, f64::INFINITY)), visit);
            return;
        };
        let [first, second] = [arc.low, arc.high].map(|edge| self.ring_circle(node, &edge, 0.0));
        let (drop_1, drop_2) = (s_race - first.s, s_race - second.s);
        let both = drop_1 + drop_2;
        self.feature(
            node,
            &Feature {
                drops: (drop_1, both),
                ..first
            },
            visit,
        );
        self.feature(
            node,
            &Feature {
                drops: (drop_2, both),
                ..second
            },
            visit,
        );
        self.feature(node, &race((both, f64::INFINITY)), visit);
        for (edge, depth) in floors(
            &self.pair.faults,
            node.z,
            node.torus_radius,
            self.on_ring,
            &arc,
        ) {
            let circle = self.ring_circle(node, &edge, depth);
            let drops = (s_race - circle.s, f64::INFINITY);
            self.feature(node, &Feature { drops, ..circle }, visit);
        }
    }

    /// A fault circle of the ring against the smooth slice.
    fn ring_circle(&self, node: &Node, edge: &Edge, depth: f64) -> Feature {
        let wave = self.pair.waves.at(self.on_ring + edge.angle);
        let reach = node.torus_radius + wave + self.pair.race.sigma * (edge.radius + depth);
        let from_ring = rotated(self.n, edge.angle) * reach;
        let away = from_ring - self.apart;
        let distance = away.norm();
        let n_e = away / distance;
        Feature {
            shape: Shape::Circle {
                from_ring,
                radius: edge.radius,
            },
            n_e,
            s: node.rho + edge.radius - distance,
            drops: (0.0, f64::INFINITY),
            arm_ring: from_ring - n_e * edge.radius,
        }
    }

    /// A feature of the ring against the ball, smooth or not.
    fn feature(&self, node: &Node, feature: &Feature, visit: &mut impl FnMut(&Meeting)) {
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
        let ball_drops = (both, f64::INFINITY);
        visit(&Meeting {
            ball_drops,
            ..Meeting::smooth(*feature, node)
        });
        let angle = feature.n_e.y.atan2(feature.n_e.x) - self.b.theta;
        for (edge, depth) in floors(&self.ball.faults, node.zeta, node.rho, angle, &arc) {
            let (drop, circle, tan) = meet(&edge, depth);
            visit(&Meeting {
                feature: circle,
                ball_drops: (drop, f64::INFINITY),
                tan,
            });
        }
    }

    /// A fault circle of the ball against a feature of the ring, and tan α from the gradient of its gap.
    fn ball_circle(
        &self,
        node: &Node,
        feature: &Feature,
        edge: &Edge,
        depth: f64,
    ) -> (Feature, f64) {
        let u = rotated(feature.n_e, edge.angle);
        let lever = node.rho - edge.radius - depth;
        let from_ring = self.apart + u * lever;
        let met = match feature.shape {
            Shape::Race => {
                let distance = from_ring.norm();
                let m = from_ring / distance;
                let waves = &self.pair.waves;
                let wave = if waves.is_round() {
                    0.0
                } else {
                    waves.at(m.y.atan2(m.x) - self.r.theta)
                };
                let radius = node.torus_radius + wave;
                let sigma = self.pair.race.sigma;
                Feature {
                    n_e: m * sigma,
                    s: sigma * (distance - radius) + edge.radius,
                    arm_ring: m * radius,
                    ..*feature
                }
            }
            Shape::Circle {
                from_ring: other,
                radius,
            } => {
                let away = other - from_ring;
                let distance = away.norm();
                let n_e = away / distance;
                Feature {
                    n_e,
                    s: radius + edge.radius - distance,
                    arm_ring: other - n_e * radius,
                    ..*feature
                }
            }
        };
        // ∂c/∂ζ of c = (ρ − R_f − depth) u(ψ), ψ = φ ± w/(2ρ), ρ' = −ζ/ρ.
        let rho_slope = -node.zeta / node.rho;
        let turn = edge.side * (edge.slope - edge.width * rho_slope / node.rho) / (2.0 * node.rho);
        let slope = u * rho_slope + turned(u) * (lever * turn);
        (met, -met.n_e.dot(&slope))
    }

    /// Elastic force, damping and friction of one feature of the ring against one of the ball.
    fn press<S: Sink>(&self, node: &Node, meeting: &Meeting, sink: &mut S) {
        let pair = self.pair;
        let share = self.drop_share();
        let (feature, tan) = (&meeting.feature, meeting.tan);
        let split = |law: &dyn Fn(f64) -> f64| {
            let at = |(sign, drop): (f64, f64)| {
                if drop < f64::INFINITY {
                    sign * law(node.depth - share * drop)
                } else {
                    0.0
                }
            };
            meeting.terms().into_iter().map(at).sum::<f64>()
        };
        let elastic = split(&|depth| pair.law.force(depth, node.width));
        if elastic <= 0.0 {
            return;
        }
        let (b, r, n_e) = (self.b, self.r, feature.n_e);
        let arm_ball = feature.arm_ring - self.apart;
        let v_p = b.velocity - r.velocity + turned(arm_ball) * b.omega
            - turned(feature.arm_ring) * r.omega;
        let v_z = b.vz - r.vz;
        let (v_e, v_t) = (v_p.dot(&n_e), v_p.dot(&turned(n_e)));
        let direction = self.common.unwrap_or((1.0, tan));
        let approach = v_e * direction.0 + v_z * direction.1;
        let damped = elastic * hunt_crossley(pair.damping, approach);
        let pull = damped < 0.0;
        let normal = if pull && pair.clamp_pull { 0.0 } else { damped };
        let mut touch = Touch {
            zeta: node.zeta,
            z: node.z,
            width: node.width,
            depth: node.depth - share * (feature.drops.0 + meeting.ball_drops.0),
            elastic,
            normal,
            energy: if S::ENERGY {
                split(&|depth| pair.law.energy(depth, node.width))
            } else {
                0.0
            },
            approach,
            n_e,
            share: direction,
            friction: V2::zeros(),
            friction_z: 0.0,
            slip: 0.0,
            friction_power: 0.0,
            arm_ball,
            arm_ring: feature.arm_ring,
            pull,
        };
        if let Some(friction) = &pair.friction {
            // α of the slice, or of the gap's gradient at a ball's fault circle.
            let (sin, cos) = if self.common.is_some() {
                (node.zeta / self.ball.radius, node.rho / self.ball.radius)
            } else {
                let cos = 1.0 / (1.0 + tan * tan).sqrt();
                (tan * cos, cos)
            };
            let u_m = v_z * cos - v_e * sin;
            let slip = (v_t * v_t + u_m * u_m).sqrt();
            let factor = friction.factor(slip) * normal.max(0.0);
            touch.friction = turned(n_e) * (-factor * v_t) + n_e * (factor * u_m * sin);
            touch.friction_z = -factor * u_m * cos;
            touch.slip = slip;
            touch.friction_power = factor * slip * slip;
        }
        sink.touch(&touch);
    }
}

/// A unit vector turned by an angle.
fn rotated(v: V2, angle: f64) -> V2 {
    let (sin, cos) = angle.sin_cos();
    v * cos + turned(v) * sin
}
