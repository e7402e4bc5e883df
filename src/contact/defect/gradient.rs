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
use super::elements::{ElementPair, WITH_RING_AXIS};
use crate::contact::scalar::{Line, Node, OneContact};
use crate::contact::{Aside, Sink, V2, turned};

/// To which body an axial end of a defect belongs.
#[derive(Clone, Copy, PartialEq)]
pub(in crate::contact) enum Owner {
    Ring,
    Ball,
}

/// How far beside an end its two sides are looked at \[m\]: rounding only.
pub(in crate::contact) const HAIR: f64 = 1e-12;

impl OneContact<'_> {
    /// What the meridional direction and the axial place have to say to an element's energy under the Hertz law.
    pub(super) fn tilt<S: Sink + ?Sized>(
        &self,
        node: &Node,
        met: &ElementPair<Sloped>,
        sink: &mut S,
    ) {
        let Some((cos, sin)) = self.common() else {
            return;
        };
        let lever = self.ball.radius - node.zeta * sin;
        let (mut turning, mut shifting) = (0.0, 0.0);
        for (sign, drop) in met.terms() {
            let Sloped {
                value,
                slopes: [by_z, by_zeta],
            } = drop;
            if value < f64::INFINITY {
                let depth = node.depth - cos * value;
                let force = sign * self.pair.law.elastic.force(depth, node.width);
                turning += force * (sin * value - (by_z + by_zeta) * lever);
                shifting -= force * cos * by_z;
            }
        }
        sink.aside(&self.turning((cos, sin), turning, shifting));
    }

    /// What the slope of the ball's texture makes of an elastic force.
    pub(super) fn texture_force(&self, elastic: f64) -> Aside {
        Aside {
            plane: turned(self.n) * (-elastic * self.swell.slope / self.distance),
            axial: 0.0,
            arm_ball: -self.apart,
            arm_ring: V2::zeros(),
            swing: WITH_RING_AXIS,
        }
    }

    /// What the axial end of a defect at a place ζ adds.
    pub(in crate::contact) fn end<S: Sink + ?Sized>(
        &self,
        line: &Line,
        zeta: f64,
        owner: Owner,
        sink: &mut S,
    ) {
        let Some(jump) = self.jump(line, zeta) else {
            return;
        };
        let aside = match (self.common(), owner) {
            (Some((cos, sin)), _) => {
                let by_angle = (zeta * sin - self.ball.radius) / (cos * cos);
                let by_z = if owner == Owner::Ring {
                    -1.0 / cos
                } else {
                    0.0
                };
                self.turning((cos, sin), jump * by_angle, jump * by_z)
            }
            (None, Owner::Ball) => self.central(0.0, jump),
            (None, Owner::Ring) => return,
        };
        sink.aside(&aside);
    }

    /// Whether ends of defects on the ring matter: not to the ISO law.
    pub(in crate::contact) fn feels_ring_ends(&self) -> bool {
        self.pair.law.cut().is_flat()
    }

    /// Energy per length on the side of lower ζ less that on the other; none where there is no contact or no change.
    fn jump(&self, line: &Line, zeta: f64) -> Option<f64> {
        let node = self.node_of(line, zeta)?;
        let reaches = node.depth > 0.0 && self.race.reaches(node.z);
        let side = |beside: f64| self.energy(&Node { beside, ..node });
        let jump = side(-HAIR) - side(HAIR);
        (reaches && jump != 0.0).then_some(jump)
    }

    /// Elastic energy of a node.
    fn energy(&self, node: &Node) -> f64 {
        let share = self.drop_share();
        let mut sum = 0.0;
        self.element_pairs(node, &mut |met: &ElementPair<f64>| {
            for (sign, drop) in met.terms() {
                if drop < f64::INFINITY {
                    let depth = node.depth - share * drop;
                    sum += sign * self.pair.law.elastic.energy(depth, node.width);
                }
            }
        });
        sum
    }

    /// From derivatives of the energy by α' and, at fixed α', by dz.
    fn turning(&self, (cos, sin): (f64, f64), by_angle: f64, by_z: f64) -> Aside {
        let per_angle = by_angle / self.section.l;
        self.central(-per_angle * sin, per_angle * cos + by_z)
    }

    /// From derivatives of the energy by e and dz.
    fn central(&self, by_e: f64, by_z: f64) -> Aside {
        let sigma = self.race.sigma;
        let across = sigma * by_e * self.raise.slope / self.distance;
        Aside {
            plane: self.n * (-sigma * by_e) + turned(self.n) * across,
            axial: -by_z,
            arm_ball: V2::zeros(),
            arm_ring: self.apart,
            swing: WITH_RING_AXIS,
        }
    }
}

/// The truth is the energy, differentiated numerically.
#[cfg(test)]
pub(super) mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::contact::hertz::Hertz;
    use crate::contact::iso16281::Iso16281;
    use crate::contact::{
        BallSide, Elastic, Fault, Law, Motion, Pair, Rules, Shape, Torus, Touch, Waves, ZoneSlices,
    };
    use crate::scene::{Defect, Floor, Material, Surface, Waviness, Width, WidthProfile};

    pub(in crate::contact::defect) const RADIUS: f64 = 6e-3;

    /// Energy, and what ball and ring get.
    #[derive(Default)]
    struct Found {
        energy: f64,
        ball: [f64; 4],
        ring: [f64; 4],
    }

    impl Found {
        fn add(&mut self, (ball, ring): ([f64; 4], [f64; 4])) {
            for i in 0..4 {
                self.ball[i] += ball[i];
                self.ring[i] += ring[i];
            }
        }
    }

    impl Sink for Found {
        fn asks_energy(&self) -> bool {
            true
        }

        fn touch(&mut self, touch: &Touch) {
            self.energy += touch.energy;
            self.add(touch.wrenches(touch.elastic, 0.0));
        }

        fn aside(&mut self, force: &Aside) {
            self.add(force.wrenches());
        }
    }

    /// A race whose groove is centred at 0.1 mm, without damping and friction, and a defect of it.
    pub(in crate::contact::defect) fn pair(
        sigma: f64,
        is_hertz: bool,
        defect: Option<&Defect>,
        waves: u32,
    ) -> Pair {
        let steel = Material::default();
        let elastic = if is_hertz {
            let law = Hertz::new(sigma, 2.0 * RADIUS, 60e-3, 0.52, 0.3, &steel, &steel);
            Elastic::Hertz(law)
        } else {
            Elastic::Iso16281(Iso16281::new(7e10, 0.5, 2.0 * RADIUS))
        };
        let race = Torus {
            sigma,
            a: 30e-3,
            centre: 0.1e-3,
            r: 6.24e-3,
            lowest: -6.24e-3,
            highest: 6.24e-3,
        };
        let wave = Waviness {
            order: waves,
            amplitude: 1e-6,
            phase: 0.4,
        };
        let fault =
            |d: &Defect| Fault::new(d, d.axial_offset.number().unwrap(), 30e-3 + sigma * race.r);
        Pair {
            race,
            shape: Shape::default(),
            waves: Waves::of(if waves > 0 { vec![wave] } else { Vec::new() }),
            law: Law::elastic(elastic),
            // Inside a defect forces like s^{10/9} end within pieces, without a weight for them.
            slices: ZoneSlices::Fitted(Rules::new(24, elastic.exponent())),
            faults: defect.map(fault).into_iter().collect(),
        }
    }

    /// A ball at x, y, z, turned, on a ring that is turned.
    fn at(pair: &Pair, ball: &BallSide, [x, y, z, theta, ring]: [f64; 5]) -> Found {
        let motion = |x, y, z, theta| Motion::new(&[x, y, z, theta], &[0.0; 4]);
        let mut found = Found::default();
        let (b, r) = (motion(x, y, z, theta), motion(0.0, 0.0, 0.0, ring));
        pair.evaluate(ball, &b, &r, &mut found);
        found
    }

    fn off(pair: &Pair, ball: &BallSide, place: [f64; 5]) -> f64 {
        let found = at(pair, ball, place);
        let [x, y, z, turn] = found.ball;
        let size = (x * x + y * y + z * z).sqrt();
        assert!(size > 10.0, "nothing presses: {size}");
        // Equal and opposite, at one point.
        let moment = found.ring[3] + turn + place[0] * y - place[1] * x;
        let sums = [x + found.ring[0], y + found.ring[1], z + found.ring[2]];
        assert!(sums.iter().all(|sum| sum.abs() < 1e-12 * size));
        assert!(moment.abs() < 1e-12 * size);
        let forces = [x, y, z, turn, found.ring[3]];
        let mut worst: f64 = 0.0;
        for (i, force) in forces.into_iter().enumerate() {
            let lever = if i < 3 { 1.0 } else { RADIUS };
            let step = 1e-8 / lever;
            let energy = |share: f64| {
                let mut aside = place;
                aside[i] += share * step;
                at(pair, ball, aside).energy
            };
            let slope =
                (8.0 * (energy(1.0) - energy(-1.0)) - energy(2.0) + energy(-2.0)) / (12.0 * step);
            worst = worst.max((force + slope).abs() / (lever * size));
        }
        worst
    }

    /// Of so many waves, of a tenth of a micrometre.
    fn wave_of_ball(order: u32) -> Waves {
        let wave = Waviness {
            order,
            amplitude: 1e-7,
            phase: -0.2,
        };
        Waves::of(if order > 0 { vec![wave] } else { Vec::new() })
    }

    fn defects() -> Vec<(&'static str, Defect)> {
        let plain = Defect::new(Surface::OuterRace, 0.0, 20e-3, 0.7e-3, 0.3e-3).at_offset(0.0);
        let varying = WidthProfile {
            positions: vec![-6e-3, 6e-3],
            widths: vec![0.5e-3, 0.9e-3],
        };
        let floor = Floor {
            depth: 3e-6,
            elements: 3,
        };
        let of = |change: &dyn Fn(&mut Defect)| {
            let mut defect = plain.clone();
            change(&mut defect);
            defect
        };
        vec![
            ("edges", of(&|d| d.length = 4.9e-3)),
            (
                "narrow",
                of(&|d| (d.length, d.width) = (4.9e-3, 0.1e-3.into())),
            ),
            ("ends", of(&|d| d.length = 0.5e-3)),
            (
                "varying",
                of(&|d| (d.length, d.width) = (4.9e-3, Width::Profile(varying.clone()))),
            ),
            (
                "floor",
                of(&|d| (d.length, d.floor) = (0.5e-3, Some(floor.clone()))),
            ),
        ]
    }

    /// Places of a ball pressed by some 15 µm at different angles, near the middle of a defect of the race at 0.4.
    fn places(sigma: f64, on_ball: bool) -> Vec<[f64; 5]> {
        let mut places = Vec::new();
        for (tilt, share) in [(0.03, 0.2), (0.25, -0.5), (-0.4, 0.7), (0.11, -0.83)] {
            let l: f64 = 6.24e-3 - RADIUS + 15e-6 + 4e-6 * share;
            let d = 30e-3 + sigma * l * f64::cos(tilt);
            let half = 0.05e-3
                / if on_ball {
                    RADIUS
                } else {
                    30e-3 + sigma * RADIUS
                };
            let direction: f64 = 0.4 + share;
            let facing = if sigma > 0.0 {
                direction
            } else {
                direction + PI
            };
            places.push([
                d * direction.cos(),
                d * direction.sin(),
                0.1e-3 + l * f64::sin(tilt),
                facing - half * share,
                direction + half * share,
            ]);
        }
        places
    }

    /// A defect's middle where the contact is.
    fn moved(defect: &Defect, place: &[f64; 5], on_ball: bool) -> Defect {
        let l = 6.24e-3 - RADIUS + 15e-6;
        let zeta = RADIUS * (place[2] - 0.1e-3) / l + 0.1e-3;
        Defect {
            axial_offset: (zeta + if on_ball { 0.0 } else { place[2] }).into(),
            ..defect.clone()
        }
    }

    #[test]
    fn forces_are_the_gradient_of_the_energy() {
        let mut failed = Vec::new();
        for is_hertz in [true, false] {
            for sigma in [1.0, -1.0] {
                for (name, defect) in defects() {
                    for on_ball in [false, true] {
                        for waves in [0, 30] {
                            let mut worst: f64 = 0.0;
                            for place in places(sigma, on_ball) {
                                let defect = moved(&defect, &place, on_ball);
                                let fault = Fault::new(
                                    &defect,
                                    defect.axial_offset.number().unwrap(),
                                    5e-3,
                                );
                                let ball = BallSide {
                                    faults: on_ball.then_some(fault).into_iter().collect(),
                                    // Both bodies are wavy, or none.
                                    waves: wave_of_ball(waves / 6),
                                    ..BallSide::whole(RADIUS)
                                };
                                let on_race = Some(&defect).filter(|_| !on_ball);
                                let pair = pair(sigma, is_hertz, on_race, waves);
                                worst = worst.max(off(&pair, &ball, place));
                            }
                            let body = if on_ball { "ball" } else { "race" };
                            let law = if is_hertz { "Hertz" } else { "ISO" };
                            let case = format!("{law} {sigma} {name} {body} {waves}: {worst:.1e}");
                            println!("{case}");
                            if worst > 1e-7 {
                                failed.push(case);
                            }
                        }
                    }
                }
            }
        }
        assert!(failed.is_empty(), "{failed:#?}");
    }
}
