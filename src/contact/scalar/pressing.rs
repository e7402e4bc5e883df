//! The forces of a slice: of every element of the ring against every element of the ball that it touches.

use super::OneContact;
use crate::contact::damage::{Depth, Node, RingSurface, Sloped, SurfacePair, WaveSlope};
use crate::contact::kernel::{self, ElementState};
use crate::contact::profile::Inclination;
use crate::contact::{ContactForce, PointForce, Sink, V2, cross, turned};

impl OneContact<'_> {
    /// Presses one slice against whatever it meets.
    pub(in crate::contact) fn slice<S: Sink + ?Sized>(&self, node: &Node, sink: &mut S) {
        if node.depth <= 0.0 {
            return;
        }
        if !self.facing.race.reaches(node.z) {
            // Beyond the cusp of a gothic arch is the other flank.
            if !self.pair.is_beyond_cusp(node.z) {
                sink.truncated();
            }
            return;
        }
        // Forces along normals are all there is to the ISO law, and where surfaces are whole.
        if self.facing.common().is_some() && (self.facing.ring_open || self.facing.ball_open) {
            self.facing
                .surface_pairs(node, &mut |met: &SurfacePair<Sloped>| {
                    if self.force(node, met, sink) {
                        self.facing.tilt(node, met, sink);
                    }
                });
        } else {
            self.facing
                .surface_pairs(node, &mut |met: &SurfacePair<f64>| {
                    self.force(node, met, sink);
                });
        }
    }

    /// Elastic force, damping and friction of one surface of the ring against one of the ball; false without any.
    fn force<D: Depth, S: Sink + ?Sized>(
        &self,
        node: &Node,
        met: &SurfacePair<D>,
        sink: &mut S,
    ) -> bool {
        let pair = self.pair;
        let share = self.facing.drop_share();
        let (surface, tan) = (&met.surface, met.tan);
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
        let elastic =
            self.facing.unloading.share * split(&|depth| pair.law.elastic.force(depth, node.width));
        if elastic <= 0.0 {
            return false;
        }
        let depth = node.depth - share * (surface.drops.0.value() + met.ball_drops.0.value());
        let n_e = surface.n_e;
        let mut state = self.state(node, surface, tan, elastic, depth);
        let force = if self.facing.b.across == V2::zeros() {
            kernel::force::<_, false, false, false, false>(&pair.law, &state, 0.0)
        } else {
            let across = self.turning_across(node, surface, &mut state);
            kernel::force::<_, false, false, false, true>(&pair.law, &state, across)
        };
        let [radial, tangential, axial] = force.friction;
        let [v_t, u_m] = force.slip;
        let squared = v_t * v_t + u_m * u_m;
        let force = ContactForce {
            zeta: node.zeta,
            z: node.z,
            width: node.width,
            depth,
            friction_weight: node.friction_weight,
            elastic,
            normal: force.normal,
            energy: if sink.asks_energy() {
                self.facing.unloading.energy
                    * split(&|depth| pair.law.elastic.energy(depth, node.width))
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
            arm_ball: surface.arm_ring - self.facing.apart,
            turn_axis: surface.turn_axis,
            pull: force.damped < 0.0,
        };
        sink.force(&force);
        if !pair.waves.is_round() {
            let WaveSlope { force, arm } = surface.wave_slope;
            sink.point(&PointForce {
                plane: force * (elastic * state.share.0),
                axial: 0.0,
                arm_ball: arm,
                turn_axis: surface.turn_axis,
                across: V2::zeros(),
            });
        }
        if !self.facing.ball_side.waves.is_round() {
            sink.point(&self.facing.texture_force(elastic));
        }
        true
    }

    /// State on which the force of an element depends, from its elastic force and penetration.
    #[inline]
    fn state<D: Depth>(
        &self,
        node: &Node,
        surface: &RingSurface<D>,
        tan: f64,
        elastic: f64,
        depth: f64,
    ) -> ElementState<f64> {
        let (b, r, n_e) = (self.facing.b, self.facing.r, surface.n_e);
        let arm_ball = surface.arm_ring - self.facing.apart;
        let v_p = b.velocity - r.velocity + turned(arm_ball) * b.omega
            - turned(surface.arm_ring) * r.omega;
        let radius = self.facing.radius;
        // Along the common tangent, or α of the slice or of the gap's gradient at a ball's fault circle.
        let common = self.facing.common();
        let slope = common.unwrap_or_else(|| {
            let cos = 1.0 / (1.0 + tan * tan).sqrt();
            let sin = tan * cos;
            Inclination { cos, sin }
        });
        let (load, arm) = if self.pair.reads_rolling() {
            let arm = surface.arm_ring.dot(&self.facing.n) - self.facing.distance;
            (elastic / node.width, arm)
        } else {
            (0.0, 0.0)
        };
        let share = common.map_or((1.0, tan), Inclination::share);
        let velocity = [v_p.dot(&n_e), v_p.dot(&turned(n_e)), b.vz - r.vz];
        ElementState {
            elastic,
            share,
            friction_weight: node.friction_weight,
            slope,
            velocity,
            load,
            depth,
            arm,
            rolling: self.rolling,
            radii: [radius, self.facing.race.r],
            oil: self.oil,
        }
    }
}

impl OneContact<'_> {
    /// Adds what the ball does that turns across the ring's axis to the velocities of an element, but for the slip along the meridian,
    /// which is returned \[m/s\].
    fn turning_across<D: Depth>(
        &self,
        node: &Node,
        surface: &RingSurface<D>,
        state: &mut ElementState<f64>,
    ) -> f64 {
        let (n_e, across) = (surface.n_e, self.facing.b.across);
        let arm = surface.arm_ring - self.facing.apart;
        let w = [across.dot(&n_e), across.dot(&turned(n_e))];
        let h = arm.dot(&n_e);
        let [along, meridional] = kernel::slip_of_turning::<_, false>(w, h, node.zeta, state.slope);
        // An edge of the ball's own comes nearer as it turns, and stands off the line of centres.
        let rate = cross(arm, n_e) * surface.turn_axis.xy().dot(&across);
        let [nearer, _, axial] = approaching(rate, state);
        state.velocity[0] += nearer;
        state.velocity[1] += along;
        state.velocity[2] += axial;
        meridional + w[0] * arm.dot(&turned(n_e)) * state.slope.cos
    }
}

/// The velocity along n_e, t_e and z of an edge that is turned into the race at a rate \[m/s\], without slip.
fn approaching(rate: f64, of: &ElementState<f64>) -> [f64; 3] {
    let ((in_plane, axial), Inclination { cos, sin }) = (of.share, of.slope);
    let size = rate * in_plane / (in_plane * cos + axial * sin);
    [size * cos, 0.0, size * sin]
}
