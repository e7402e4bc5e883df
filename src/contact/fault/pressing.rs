//! The forces of a slice: of every element of the ring against every one of the ball that it meets.

use super::depth::{Depth, Sloped};
use super::elements::{ElementPair, Lean, RingElement};
use crate::contact::kernel::{self, State};
use crate::contact::scalar::{Contact, Node};
use crate::contact::{Aside, Sink, Touch, V2, cross, turned};

impl Contact<'_> {
    /// One slice against whatever it meets.
    pub(in crate::contact) fn slice<S: Sink + ?Sized>(&self, node: &Node, sink: &mut S) {
        if node.depth <= 0.0 {
            return;
        }
        if !self.race.reaches(node.z) {
            // Beyond the cusp of a gothic arch is the other flank.
            if !self.pair.is_beyond_cusp(node.z) {
                sink.truncated();
            }
            return;
        }
        // Forces along normals are all there is to the ISO law, and where surfaces are whole.
        if self.common().is_some() && (self.ring_open || self.ball_open) {
            self.element_pairs(node, &mut |met: &ElementPair<Sloped>| {
                if self.force(node, met, sink) {
                    self.tilt(node, met, sink);
                }
            });
        } else {
            self.element_pairs(node, &mut |met: &ElementPair<f64>| {
                self.force(node, met, sink);
            });
        }
    }

    /// Elastic force, damping and friction of one feature of the ring against one of the ball; false without any.
    fn force<D: Depth, S: Sink + ?Sized>(
        &self,
        node: &Node,
        met: &ElementPair<D>,
        sink: &mut S,
    ) -> bool {
        let pair = self.pair;
        let share = self.drop_share();
        let (feature, tan) = (&met.feature, met.tan);
        let split = |law: &dyn Fn(f64) -> f64| {
            let at = |(sign, drop): (f64, D)| {
                if drop.value() < f64::INFINITY {
                    sign * law(node.depth - share * drop.value())
                } else {
                    0.0
                }
            };
            met.terms().into_iter().map(at).sum::<f64>()
        };
        let elastic = split(&|depth| pair.law.elastic.force(depth, node.width));
        if elastic <= 0.0 {
            return false;
        }
        let depth = node.depth - share * (feature.drops.0.value() + met.ball_drops.0.value());
        let n_e = feature.n_e;
        let state = self.state(node, feature, tan, (elastic, depth));
        let force = kernel::force::<f64, false, false, false>(&pair.law, &state);
        let [radial, tangential, axial] = force.friction;
        let [v_t, u_m] = force.slip;
        let squared = v_t * v_t + u_m * u_m;
        let touch = Touch {
            zeta: node.zeta,
            z: node.z,
            width: node.width,
            depth,
            rubbing: node.rubbing,
            elastic,
            normal: force.normal,
            energy: if sink.asks_energy() {
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
            friction_power: force.factor * force.damped.max(0.0) * squared,
            arm_ball: feature.arm_ring - self.apart,
            arm_ring: feature.arm_ring,
            swing: feature.swing,
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
                swing: feature.swing,
            });
        }
        true
    }

    /// What the force of an element depends on, from its elastic force and penetration.
    #[inline]
    fn state<D: Depth>(
        &self,
        node: &Node,
        feature: &RingElement<D>,
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
        let (load, arm) = if self.pair.reads_rolling() {
            let arm = feature.arm_ring.dot(&self.n) - self.distance;
            (elastic / node.width, arm)
        } else {
            (0.0, 0.0)
        };
        let share = self.common().unwrap_or((1.0, tan));
        let mut velocity = [v_p.dot(&n_e), v_p.dot(&turned(n_e)), b.vz - r.vz];
        let turning = (b.across != V2::zeros()).then(|| {
            let w = [b.across.dot(&n_e), b.across.dot(&turned(n_e))];
            let place = (arm_ball.dot(&n_e), node.zeta);
            let [tangential, meridional] = kernel::slip_of_turning::<f64, false>(w, place, slope);
            velocity[1] += tangential;
            // The edge of a ball's defect stands off the line of centres, too.
            let meridional = meridional + w[0] * arm_ball.dot(&turned(n_e)) * slope.1;
            let rate = cross(arm_ball, n_e) * feature.swing.xy().dot(&b.across);
            let [nearer, _, along] = approaching(rate, share, slope);
            velocity[0] += nearer;
            velocity[2] += along;
            meridional
        });
        State {
            elastic,
            share,
            rubbing: node.rubbing,
            slope,
            velocity,
            turning,
            load,
            depth,
            arm,
            rolling: self.rolling,
            radii: [radius, self.race.r],
            oil: self.oil,
        }
    }
}

/// The velocity along n_e, t_e and z of an edge that is turned into the race at a rate \[m/s\], without slip.
fn approaching(rate: f64, (in_plane, axial): (f64, f64), (sin, cos): (f64, f64)) -> [f64; 3] {
    let size = rate * in_plane / (in_plane * cos + axial * sin);
    [size * cos, 0.0, size * sin]
}
