//! Terms of the gradient of the elastic energy in addition to forces along normals: forces through the ball's centre.
//!
//! A contact's energy is U = Σ ± ∫ u(p) over its terms (see `elements`), u' the law. Forces are conservative if they are
//! −∂U/∂q. With e and dz the ball's place in the meridional plane ([`Section`](crate::contact::Section): e = σ (d − a − R̃(φ)), R̃ the waves), l and
//! α' its polar coordinates there, C = cos α' and S = sin α':
//!
//! **Waves.** At a fixed place on the race −∂U/∂φ = −∂U/∂e · ∂e/∂φ = σ R̃'(φ) ∂U/∂e: a moment about the ring's centre, which
//! is a tangential force σ R̃' (∂U/∂e)/d through the ball's centre, so that it turns no ball. A fault circle of the ball
//! has its own direction and distance, and takes it through the circle's centre.
//!
//! **Texture of the ball** adds w(ψ) to the approach, or to penetrations in the plane under the ISO law; ψ is the direction of the contact from
//! the ball's mark, so that with F the sum of elastic forces −∂U/∂φ = −F w' and −∂U/∂θ_b = F w': a force −F w'/d across the ball's radius that acts
//! at the ring's centre, on the ring the opposite.
//!
//! **The ISO law** has s and tan α of every slice such that −∂U/∂q is the sum of slice forces as long as slices enter and
//! leave without penetration or stand still in the *ring's* frame (shift the variable to z: the ends of a ring defect
//! stay, and ∂s/∂z_b = tan α). The axial ends of a ball defect move along, ∂z_end/∂z_b = 1, and add u(left) − u(right).
//!
//! **The Hertz law** is p(τ) = δ − κτ²/2 − C Δ at ζ = R S + τ C, z = dz + ζ, with the drop Δ(in-plane place, z, ζ) of the
//! element behind the race (0 for the race). At fixed τ, ∂ζ/∂α' = R C − τ S = (R − ζ S)/C, so that
//!
//! ```text
//! ∂p/∂(in-plane place) = C n_e  of the element: the force along its normal
//! ∂p/∂dz = S − C Δ_z            of which S is the share of the normal force
//! ∂p/∂α' = S Δ − (Δ_z + Δ_ζ)(R − ζ S)
//! ```
//!
//! and an end of a defect at a place z of the ring or ζ of the ball adds [u(left) − u(right)] ∂τ_end with
//!
//! ```text
//! ∂τ_end/∂α' = (ζ S − R)/C²,    ∂τ_end/∂dz = −1/C of the ring's, 0 of the ball's.
//! ```
//!
//! From α' and dz to the ball: ∂α'/∂e = −S/l, ∂α'/∂dz = C/l. All these forces depend on places alone, so they act
//! through the ball's centre, on the ring with the opposite sign at the same point. Slices at fixed places take the same
//! terms, with their error.

use super::depth::Sloped;
use super::facing::{Facing, Node};
use super::surfaces::SurfacePair;
use crate::contact::profile::Inclination;
use crate::contact::{PointForce, Sink, V2, turned};

/// The body to which an axial end of a defect belongs.
#[derive(Clone, Copy, PartialEq)]
pub(in crate::contact) enum Owner {
    Ring,
    Ball,
}

/// How far beside an end its two sides are looked at \[m\]: rounding only.
pub(in crate::contact) const BESIDE: f64 = 1e-12;

impl Facing<'_> {
    /// Share of the meridional direction and the axial place in an element's energy under the Hertz law.
    pub(in crate::contact) fn tilt<S: Sink + ?Sized>(
        &self,
        node: &Node,
        met: &SurfacePair<Sloped>,
        sink: &mut S,
    ) {
        let Some(normal @ Inclination { cos, sin }) = self.common() else {
            return;
        };
        let lever = self.radius - node.zeta * sin;
        let (mut turning, mut shifting) = (0.0, 0.0);
        for (sign, drop) in met.terms() {
            let Sloped {
                value,
                slopes: [by_z, by_zeta],
            } = drop;
            if value < f64::INFINITY {
                let depth = node.depth - cos * value;
                let force = sign * self.law.elastic.force(depth, node.width);
                turning += force * (sin * value - (by_z + by_zeta) * lever);
                shifting -= force * cos * by_z;
            }
        }
        sink.point(&self.turning(normal, turning, shifting));
    }

    /// Force that the slope of the ball's texture makes of an elastic force.
    pub(in crate::contact) fn texture_force(&self, elastic: f64) -> PointForce {
        let plane = turned(self.n) * (-elastic * self.swell.slope / self.distance);
        PointForce::at(-self.apart, plane, 0.0)
    }

    /// Force that the axial end of a defect at a node's place adds.
    pub(in crate::contact) fn end<S: Sink + ?Sized>(
        &self,
        node: &Node,
        owner: Owner,
        sink: &mut S,
    ) {
        let Some(jump) = self.jump(node) else {
            return;
        };
        let zeta = node.zeta;
        let force = match (self.common(), owner) {
            (Some(normal @ Inclination { cos, sin }), _) => {
                let by_angle = (zeta * sin - self.radius) / (cos * cos);
                let by_z = if owner == Owner::Ring {
                    -1.0 / cos
                } else {
                    0.0
                };
                self.turning(normal, jump * by_angle, jump * by_z)
            }
            (None, Owner::Ball) => self.central(0.0, self.unloading.share * jump),
            (None, Owner::Ring) => return,
        };
        sink.point(&force);
    }

    /// Whether ends of defects on the ring matter: not to the ISO law.
    pub(in crate::contact) fn feels_ring_ends(&self) -> bool {
        self.law.cut().is_flat()
    }

    /// Energy per length on the side of lower ζ less that on the other; none where there is no contact or no change.
    fn jump(&self, node: &Node) -> Option<f64> {
        let reaches = node.depth > 0.0 && self.race.reaches(node.z);
        let side = |beside: f64| self.energy(&Node { beside, ..*node });
        let jump = side(-BESIDE) - side(BESIDE);
        (reaches && jump != 0.0).then_some(jump)
    }

    /// Elastic energy of a node.
    fn energy(&self, node: &Node) -> f64 {
        let share = self.drop_share();
        let mut sum = 0.0;
        self.surface_pairs(node, &mut |met: &SurfacePair<f64>| {
            for (sign, drop) in met.terms() {
                if drop < f64::INFINITY {
                    let depth = node.depth - share * drop;
                    sum += sign * self.law.elastic.energy(depth, node.width);
                }
            }
        });
        sum
    }

    /// Force from derivatives of the energy by α' and, at fixed α', by dz.
    fn turning(&self, normal: Inclination<f64>, by_angle: f64, by_z: f64) -> PointForce {
        let Inclination { cos, sin } = normal;
        let (share, per_angle) = (self.unloading.share, by_angle / self.section.l);
        self.central(-share * per_angle * sin, share * (per_angle * cos + by_z))
    }

    /// Force from the derivative by α' of what pits release.
    pub(super) fn turning_by(&self, by_angle: f64) -> PointForce {
        let (Inclination { cos, sin }, per_angle) =
            (self.section.normal, by_angle / self.section.l);
        self.central(-per_angle * sin, per_angle * cos)
    }

    /// Force from derivatives of the energy by e and dz.
    fn central(&self, by_e: f64, by_z: f64) -> PointForce {
        let sigma = self.race.sigma;
        let across = sigma * by_e * self.raise.slope / self.distance;
        let plane = self.n * (-sigma * by_e) + turned(self.n) * across;
        PointForce::at(V2::zeros(), plane, -by_z)
    }
}
