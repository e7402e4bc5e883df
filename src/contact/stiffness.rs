//! Elastic force of a contact at rest and its stiffness: what a static solve needs.
//!
//! Where all surfaces are whole, ball and groove are two circles in the meridional plane, and the force depends on the
//! places e and c of their centres alone: the kernel with derivatives by both says force and stiffness, of the very sum
//! that a run makes, so Newton's method converges on it quadratically. Near a defect, and where the ball's equator
//! cuts the zone, the stiffness is found by differences.

// Everything here must be compiled for the instructions of its caller.
#![allow(clippy::inline_always)]

use nalgebra::{Matrix3, Vector3};

use super::closed_form;
use super::dual::Dual;
use super::kernel::{self, Element, Receiver, Whole};
use super::laws::elastic::{Elastic, ForLaw, Load};
use super::profile::{SHALLOW, Section, Zone};
use super::{Aside, BallSide, Motion, Pair, Rules, Sink, Slices, Touch, V2};
use crate::simd::{LANES, Lanes, Level, Number, Task};

/// Elastic force on the ball along x, y, z \[N\], and the stiffness −∂force/∂place of the ball against the ring
/// \[N/m\]; a stiffness that only differences can tell is left out.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tangent {
    pub force: Vector3<f64>,
    pub stiffness: Option<Matrix3<f64>>,
}

impl Pair {
    /// Force and stiffness at rest of a ball whose centre stands at `place` from the ring's, neither turned.
    pub(crate) fn tangent(&self, level: Level, ball: &BallSide, place: &Vector3<f64>) -> Tangent {
        let distance = place.xy().norm();
        let n = V2::new(place.x, place.y) / distance;
        let angle = if self.waves.is_round() && self.faults.is_empty() && ball.faults.is_empty() {
            0.0
        } else {
            n.y.atan2(n.x)
        };
        let raise = self.waves.raise(angle);
        let section = self.section(ball.radius, distance, place.z, raise.height);
        if section.is_clear() {
            return Tangent {
                force: Vector3::zeros(),
                stiffness: Some(Matrix3::zeros()),
            };
        }
        let sigma = self.race.sigma;
        let whole = !self.faults.iter().any(|fault| fault.in_reach(angle))
            && !ball.faults.iter().any(|fault| {
                let towards = if sigma > 0.0 {
                    angle
                } else {
                    angle + std::f64::consts::PI
                };
                fault.in_reach(towards)
            });
        match self.meridional(level, &section).filter(|_| whole) {
            Some(found) => {
                self.in_space(&found, n, distance, (raise.slope, self.waves.bend(angle)))
            }
            None => Tangent {
                force: self.elastic(ball, place),
                stiffness: None,
            },
        }
    }

    /// The stiffness by central differences.
    pub(crate) fn stiffness_by_differences(
        &self,
        ball: &BallSide,
        place: &Vector3<f64>,
        step: f64,
    ) -> Matrix3<f64> {
        let mut stiffness = Matrix3::zeros();
        for i in 0..3 {
            let aside = Vector3::ith(i, step);
            let fall = self.elastic(ball, &(place - aside)) - self.elastic(ball, &(place + aside));
            stiffness.set_column(i, &(fall / (2.0 * step)));
        }
        stiffness
    }

    /// Elastic force on the ball by the walk along the contact.
    fn elastic(&self, ball: &BallSide, place: &Vector3<f64>) -> Vector3<f64> {
        let at = |centre: V2, z: f64| Motion {
            centre,
            z,
            theta: 0.0,
            velocity: V2::zeros(),
            vz: 0.0,
            omega: 0.0,
        };
        let mut sum = ElasticForce(Vector3::zeros());
        let ring = at(V2::zeros(), 0.0);
        self.evaluate(ball, &at(place.xy(), place.z), &ring, &mut sum);
        sum.0
    }

    /// From the meridional plane to x, y, z: e = σ (d − a − R̃(φ)), c = z₀ − z, the waves R̃ with their first and second
    /// derivative by the angle.
    fn in_space(
        &self,
        found: &Meridional,
        n: V2,
        distance: f64,
        (wave_slope, wave_bend): (f64, f64),
    ) -> Tangent {
        let sigma = self.race.sigma;
        let [[r_e, r_c], [a_e, a_c]] = found.slope;
        let [radial, axial] = found.force;
        // Along n, t = ẑ × n and z the ball gets −σ F_r, σ F_r R̃'/d and −F_a; n and t turn with its direction, and
        // ∂e = σ ∂n − σ R̃'/d ∂t.
        let (lean, bend) = (wave_slope / distance, wave_bend / distance);
        let across = sigma * radial * lean;
        let [nn, nt, nz] = [r_e, -r_e * lean + across / distance, -sigma * r_c];
        let tt = r_e * lean * lean + sigma * radial * (1.0 - bend) / distance;
        let tz = sigma * r_c * lean;
        let [zn, zt, zz] = [sigma * a_e, -sigma * a_e * lean, -a_c];
        // The same along x, y and z.
        let (x, y) = (n.x, n.y);
        let skew = nn * x * y + nt * (x * x - y * y) - tt * x * y;
        let stiffness = Matrix3::new(
            nn * x * x - 2.0 * nt * x * y + tt * y * y,
            skew,
            nz * x - tz * y,
            skew,
            nn * y * y + 2.0 * nt * x * y + tt * x * x,
            nz * y + tz * x,
            zn * x - zt * y,
            zn * y + zt * x,
            zz,
        );
        let push = -sigma * radial;
        Tangent {
            force: Vector3::new(push * x - across * y, push * y + across * x, -axial),
            stiffness: Some(stiffness),
        }
    }

    /// The section of [`Torus::section`], with derivatives by e and c.
    fn section(&self, radius: f64, d: f64, z: f64, wave: f64) -> Section<Dual<f64, 2>> {
        let (e, c) = self.race.centres(d, z, wave);
        let of = Dual::constant;
        let (e, c) = (Dual::variable(e, 0), Dual::variable(c, 1));
        Section::new::<false, false>(of(radius), of(self.race.r), e, c)
    }

    /// Force of a whole contact; none where something cuts its zone.
    fn meridional(&self, level: Level, section: &Section<Dual<f64, 2>>) -> Option<Meridional> {
        let of = Dual::constant;
        let constants = self.constants(section.radius.value);
        let half_curvature = of(constants.half_curvature);
        let zone = kernel::zone(&self.law.cut(), section, half_curvature);
        let ends = zone.ends(section.normal);
        if !self.is_whole(section, &zone, ends) {
            return None;
        }
        let contact = Whole {
            inverse: of(constants.inverse),
            half: zone.half,
            ends,
            strength: of(constants.strength),
            half_curvature,
            section: *section,
        };
        let force = match (closed_form::hertz_stiffness(self), &self.slices) {
            (Some(stiffness), _) => elastic_force(&kernel::as_one(&contact, stiffness)),
            (None, Slices::Fitted(rules)) => level.run(SideBySide {
                elastic: &self.law.elastic,
                rules,
                contact: &contact,
            }),
            (None, Slices::Fixed(_)) => {
                let mut sums = Sums {
                    pair: self,
                    section: &contact.section,
                    force: [of(0.0); 2],
                };
                kernel::elements::<_, false, false>(&self.law, &self.slices, &contact, &mut sums);
                sums.force
            }
        };
        Some(Meridional {
            force: force.map(|force| force.value),
            slope: force.map(|force| force.slopes),
        })
    }

    /// Whether nothing cuts a zone; fixed slices are there or not, one by one.
    fn is_whole<const N: usize>(
        &self,
        section: &Section<Dual<f64, N>>,
        zone: &Zone<Dual<f64, N>>,
        (low, high): (Dual<f64, N>, Dual<f64, N>),
    ) -> bool {
        let (radius, c) = (section.radius.value, section.c.value);
        let fits = |zeta: f64| zeta.abs() < radius && self.holds(zeta - c);
        let on_top = zone.height.value >= SHALLOW * radius;
        section.e.value > 0.0
            && on_top
            && zone.lowest(section.normal).value > 0.0
            && (matches!(self.slices, Slices::Fixed(_)) || fits(low.value) && fits(high.value))
    }

    /// Whether the race is there, at a place from the groove's centre.
    fn holds(&self, x: f64) -> bool {
        x.abs() < self.race.r && x >= self.race.lowest && x <= self.race.highest
    }
}

/// Elastic force of an element along n_e and z.
#[inline(always)]
fn elastic_force<T: Number>(element: &Element<T>) -> [T; 2] {
    let elastic = element.load * element.length;
    [elastic * element.share.0, elastic * element.share.1]
}

/// Adds up the elastic forces of fixed slices, of those that lie on the race.
struct Sums<'a> {
    pair: &'a Pair,
    section: &'a Section<Dual<f64, 2>>,
    force: [Dual<f64, 2>; 2],
}

impl Receiver<Dual<f64, 2>> for Sums<'_> {
    #[inline(always)]
    fn element<const FMA: bool, const PLANE: bool>(
        &mut self,
        element: &Element<Dual<f64, 2>>,
        _times: u32,
    ) {
        let place = element.sin.value * self.section.radius.value - self.section.c.value;
        if self.pair.holds(place) {
            let [radial, axial] = elastic_force(element);
            self.force[0] += radial;
            self.force[1] += axial;
        }
    }
}

/// The force of fitted nodes, eight nodes of one contact side by side: one after the other they take a third longer.
struct SideBySide<'a> {
    elastic: &'a Elastic,
    rules: &'a Rules,
    contact: &'a Whole<Dual<f64, 2>>,
}

impl Task for SideBySide<'_> {
    type Output = [Dual<f64, 2>; 2];

    #[inline(always)]
    fn run<const FMA: bool>(self) -> Self::Output {
        let zero = Dual::constant(Lanes::ZERO);
        let mut force = [zero; 2];
        self.elastic.choose(Nodes::<FMA> {
            rules: self.rules,
            contact: &self.contact.widened(),
            force: &mut force,
        });
        [force[0].total(), force[1].total()]
    }
}

/// The same for one elastic law.
struct Nodes<'a, const FMA: bool> {
    rules: &'a Rules,
    contact: &'a Whole<Dual<Lanes, 2>>,
    force: &'a mut [Dual<Lanes, 2>; 2],
}

impl<const FMA: bool> ForLaw for Nodes<'_, FMA> {
    #[inline(always)]
    fn run<L: Load>(self) {
        let Self {
            rules,
            contact,
            force,
        } = self;
        for nodes in rules.on([true; 2]).chunks(LANES) {
            let (mut x, mut weight) = (Lanes::ZERO, Lanes::ZERO);
            for (lane, node) in nodes.iter().enumerate() {
                (x[lane], weight[lane]) = *node;
            }
            let (u, stretch) = (contact.half.scaled(x), contact.half.scaled(weight));
            let element = if L::FLAT {
                contact.on_tangent::<L, FMA>(u, stretch)
            } else {
                contact.on_chord::<L, FMA, false>(u.scaled(contact.inverse.value), stretch)
            };
            let [radial, axial] = elastic_force(&element);
            force[0] += radial;
            force[1] += axial;
        }
    }
}

impl Whole<Dual<f64, 2>> {
    /// The same contact in all lanes.
    #[inline(always)]
    fn widened(&self) -> Whole<Dual<Lanes, 2>> {
        let Section {
            radius,
            r,
            e,
            c,
            l,
            normal,
            approach,
        } = self.section;
        Whole {
            section: Section {
                radius: radius.widened(),
                r: r.widened(),
                e: e.widened(),
                c: c.widened(),
                l: l.widened(),
                normal: (normal.0.widened(), normal.1.widened()),
                approach: approach.widened(),
            },
            inverse: self.inverse.widened(),
            half: self.half.widened(),
            ends: (self.ends.0.widened(), self.ends.1.widened()),
            strength: self.strength.widened(),
            half_curvature: self.half_curvature.widened(),
        }
    }
}

/// Force of a whole contact in its meridional plane.
struct Meridional {
    /// F_r along n_e and F_a along z \[N\].
    force: [f64; 2],
    /// Derivatives of each by e and c \[N/m\].
    slope: [[f64; 2]; 2],
}

/// Adds up the elastic forces on the ball.
struct ElasticForce(Vector3<f64>);

impl Sink for ElasticForce {
    fn touch(&mut self, touch: &Touch) {
        let plane = touch.n_e * (touch.elastic * touch.share.0);
        self.0 -= Vector3::new(plane.x, plane.y, touch.elastic * touch.share.1);
    }

    fn aside(&mut self, force: &Aside) {
        self.0 += Vector3::new(force.plane.x, force.plane.y, force.axial);
    }
}

#[cfg(test)]
mod tests {
    use super::super::hertz::Hertz;
    use super::super::iso16281::Iso16281;
    use super::super::{Law, Torus, Waves};
    use super::*;
    use crate::scene::{Material, Waviness};

    fn pair(sigma: f64, hertz: bool, slices: Slices, waves: Waves) -> Pair {
        let steel = Material::default();
        let elastic = if hertz {
            Elastic::Hertz(Hertz::new(sigma, 12e-3, 60e-3, 0.52, 0.3, &steel, &steel))
        } else {
            Elastic::Iso16281(Iso16281::new(3.5948e10, 0.5, 12e-3))
        };
        Pair {
            race: Torus {
                sigma,
                a: 30e-3,
                centre: 0.1e-3,
                r: 6.24e-3,
                lowest: -6.24e-3,
                highest: 6.24e-3,
            },
            waves,
            law: Law::elastic(elastic),
            slices,
            faults: Vec::new(),
        }
    }

    /// Truth: the walk along the contact. The same force, and the stiffness as its central differences.
    #[test]
    fn agrees_with_the_walk() {
        let ball = BallSide {
            radius: 6e-3,
            faults: Vec::new(),
        };
        let wavy = || {
            Waves(vec![Waviness {
                order: 9,
                amplitude: 1e-6,
                phase: 0.4,
            }])
        };
        // Of the force, of the stiffness on nodes, and of that on slices: one that enters within a difference
        // bends its own force like s^{1/9}.
        let mut worst = [0.0_f64; 3];
        for sigma in [1.0, -1.0] {
            for (hertz, slices) in [
                (false, Slices::Fitted(Rules::new(6, 10.0 / 9.0))),
                (false, Slices::Fixed(200)),
                (true, Slices::Fitted(Rules::new(6, 1.0))),
            ] {
                for waves in [Waves::default(), wavy()] {
                    let pair = pair(sigma, hertz, slices.clone(), waves);
                    for (tilt, direction) in [(0.0, 0.3), (0.4, -2.0), (-0.7, 1.1)] {
                        let l = 6.24e-3 - ball.radius + 15e-6;
                        let d = pair.race.a + sigma * l * f64::cos(tilt);
                        let (sin, cos) = f64::sin_cos(direction);
                        let place =
                            Vector3::new(d * cos, d * sin, pair.race.centre + l * tilt.sin());
                        let found = pair.tangent(Level::current(), &ball, &place);
                        let force = pair.elastic(&ball, &place);
                        let stiffness = pair.stiffness_by_differences(&ball, &place, 1e-8);
                        let analytic = found.stiffness.unwrap();
                        worst[0] = worst[0].max((found.force - force).norm() / force.norm());
                        let kind = if matches!(slices, Slices::Fitted(_)) {
                            1
                        } else {
                            2
                        };
                        let error = (analytic - stiffness).norm() / stiffness.norm();
                        worst[kind] = worst[kind].max(error);
                    }
                }
            }
        }
        println!("force, stiffness on nodes and on slices: {worst:?}");
        assert!(
            worst[0] < 1e-11 && worst[1] < 1e-6 && worst[2] < 5e-3,
            "{worst:?}"
        );
    }
}
