//! The kernel: forces of an element of a contact, and elements of a whole contact. The only implementation of both.
//!
//! Everything that evaluates contacts drives it: `scalar` one contact at a time, with everything that may cut it;
//! `batch` eight whole contacts side by side; `held` holds contacts at one place for any velocities; `stiffness`
//! differentiates them at rest. It is generic over the [`Number`] it computes with.

use super::laws::elastic::{ElasticLaw, ForLaw};
use super::laws::traction::{Rolling, Sliding};
use super::profile::{Inclination, Section, SurfacePoint, Zone};
use super::{Cut, FilmEffect, Law, Rules, ZoneSlices};
use crate::simd::Number;

/// A whole contact: no shoulder, no end of the ball and no defect cuts its zone.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Whole<T> {
    pub section: Section<T>,
    /// Inverse of the ball's radius \[1/m\].
    pub inverse: T,
    /// Half of the zone along the line that it is cut along \[m\].
    pub half: T,
    /// Ends of the zone along ζ \[m\].
    pub ends: (T, T),
    /// [`super::Elastic::strength`].
    pub strength: T,
    /// [`Cut::half_curvature`].
    pub half_curvature: T,
}

/// An element: a slice, or a quadrature node.
#[derive(Debug, Clone, Copy)]
pub(super) struct Element<T> {
    /// ζ/R on the ball.
    pub sin: T,
    /// Inclination of the normal across whose meridian it slides: of the ball's surface; on the common tangent, along whose normal
    /// bodies approach, that of the tangent, or else approaching would rub.
    pub slope: Inclination<T>,
    /// Height of the groove over its centre there \[m\].
    pub groove: T,
    /// Penetration that the law sees, at least 0 \[m\].
    pub depth: T,
    /// Width along ζ, or length along the common tangent \[m\].
    pub length: T,
    /// Elastic force per length \[N/m\].
    pub load: T,
    /// Shares of the normal force in the plane and along the axis, over its magnitude.
    pub share: (T, T),
    /// Weight of friction over the normal force.
    pub friction_weight: T,
}

/// Takes the elements of a whole contact.
pub(super) trait Receiver<T> {
    /// Adds one element, which stands for so many. Wants `#[inline(always)]`.
    fn element<const FMA: bool, const SYMMETRIC: bool>(&mut self, element: &Element<T>, times: u32);
}

/// The zone of a section for a cut.
#[inline(always)]
pub(super) fn zone<T: Number>(cut: &Cut, section: &Section<T>, half_curvature: T) -> Zone<T> {
    match cut {
        Cut::BallSurface => Zone::on_chord(section),
        Cut::CommonTangent { .. } => Zone::on_tangent(section, half_curvature),
    }
}

/// Hands all elements of a whole contact to their receiver. `SYMMETRIC` says that the zone is, so that half of it stands
/// for the whole. `friction_weight` is what friction weighs at fitted nodes, if not the same as the normal force.
#[inline(always)]
pub(super) fn elements<T: Number, const FMA: bool, const SYMMETRIC: bool>(
    law: &Law,
    slices: &ZoneSlices,
    friction_weight: Option<&[T]>,
    contact: &Whole<T>,
    to: &mut impl Receiver<T>,
) {
    law.elastic.choose(Elements::<_, _, FMA, SYMMETRIC> {
        slices,
        friction_weight,
        contact,
        to,
    });
}

/// The elements of a contact, for one elastic law.
struct Elements<'a, T, R, const FMA: bool, const SYMMETRIC: bool> {
    slices: &'a ZoneSlices,
    friction_weight: Option<&'a [T]>,
    contact: &'a Whole<T>,
    to: &'a mut R,
}

impl<T: Number, R: Receiver<T>, const FMA: bool, const SYMMETRIC: bool> ForLaw
    for Elements<'_, T, R, FMA, SYMMETRIC>
{
    #[inline(always)]
    fn run<L: ElasticLaw>(self) {
        let Self {
            slices,
            friction_weight,
            contact,
            to,
        } = self;
        let (half, radius) = (contact.half, contact.section.radius);
        match slices {
            ZoneSlices::Fitted(rules) if L::FLAT => {
                for (k, (x, weight, times)) in nodes::<SYMMETRIC>(rules) {
                    let mut element = contact.on_tangent::<L, FMA>(half * x, half * weight);
                    if let Some(friction_weight) = friction_weight {
                        element.friction_weight = friction_weight[k];
                    }
                    to.element::<FMA, SYMMETRIC>(&element, times);
                }
            }
            ZoneSlices::Fitted(rules) => {
                let reach = half * contact.inverse;
                for (k, (x, weight, times)) in nodes::<SYMMETRIC>(rules) {
                    let mut element =
                        contact.on_chord::<L, FMA, SYMMETRIC>(reach * x, half * weight);
                    if let Some(friction_weight) = friction_weight {
                        element.friction_weight = friction_weight[k];
                    }
                    to.element::<FMA, SYMMETRIC>(&element, times);
                }
            }
            ZoneSlices::Fixed(count) if L::FLAT => {
                let Inclination { cos, sin } = contact.section.normal;
                let over = cos.same(1.0) / cos;
                let length = radius * (2.0 / *count as f64) * over;
                for (place, times) in contact.fixed_sines::<SYMMETRIC>(*count) {
                    let u = radius * (-sin + place) * over;
                    let element = contact.on_tangent::<L, FMA>(u, length * f64::from(times));
                    to.element::<FMA, SYMMETRIC>(&element, times);
                }
            }
            ZoneSlices::Fixed(count) => {
                let width = radius * (2.0 / *count as f64);
                for (sin, times) in contact.fixed_sines::<SYMMETRIC>(*count) {
                    let element = contact.fixed_slice::<L, FMA>(sin, width * f64::from(times));
                    to.element::<FMA, SYMMETRIC>(&element, times);
                }
            }
        }
    }
}

impl<T: Number> Whole<T> {
    /// An element at u/R on the common chord that stands for a stretch of u.
    #[inline(always)]
    pub(super) fn on_chord<L: ElasticLaw, const FMA: bool, const SYMMETRIC: bool>(
        &self,
        u: T,
        stretch: T,
    ) -> Element<T> {
        if SYMMETRIC {
            // tan α has no part in what the two halves add up to.
            let cos = (-u).mul_add::<FMA>(u, u.same(1.0)).sqrt();
            return self.on_surface::<L, FMA>(Inclination { cos, sin: u }, u.same(0.0), stretch);
        }
        let SurfacePoint {
            sin,
            cos,
            tan,
            stretch: width,
        } = SurfacePoint::over::<FMA>(self.section.normal, u);
        self.on_surface::<L, FMA>(Inclination { cos, sin }, tan, stretch * width)
    }

    /// A fixed slice in whose middle the ball has sin α.
    #[inline(always)]
    fn fixed_slice<L: ElasticLaw, const FMA: bool>(&self, sin: f64, width: T) -> Element<T> {
        let cos = (1.0 - sin * sin).sqrt();
        let (tan, slope) = (sin / cos, Inclination { cos, sin });
        self.on_surface::<L, FMA>(slope.map(|x| width.same(x)), width.same(tan), width)
    }

    /// A slice of the ball's surface.
    #[inline(always)]
    fn on_surface<L: ElasticLaw, const FMA: bool>(
        &self,
        slope: Inclination<T>,
        tan: T,
        width: T,
    ) -> Element<T> {
        let Inclination { cos, sin } = slope;
        let groove = self.section.groove::<FMA>(sin);
        let depth = self
            .section
            .penetration(cos * self.section.radius, groove)
            .or_zero();
        Element {
            sin,
            slope,
            groove,
            depth,
            length: width,
            load: L::load::<T, FMA>(self.strength, depth),
            share: (sin.same(1.0), tan),
            friction_weight: sin.same(1.0),
        }
    }

    /// An element at u on the common tangent.
    #[inline(always)]
    pub(super) fn on_tangent<L: ElasticLaw, const FMA: bool>(&self, u: T, length: T) -> Element<T> {
        let normal = self.section.normal;
        let sin = (u * self.inverse).mul_add::<FMA>(normal.cos, normal.sin);
        let depth = (self.section.approach - u * u * self.half_curvature).or_zero();
        Element {
            sin,
            slope: normal,
            groove: self.section.groove::<FMA>(sin),
            depth,
            length,
            load: L::load::<T, FMA>(self.strength, depth),
            share: normal.share(),
            friction_weight: u.same(1.0),
        }
    }

    /// ζ/R in the middle of all fixed slices that may lie in any of the zones, and how many each stands for.
    #[inline(always)]
    pub(super) fn fixed_sines<const SYMMETRIC: bool>(
        &self,
        count: usize,
    ) -> impl Iterator<Item = (f64, u32)> + use<T, SYMMETRIC> {
        let (low, high) = (self.ends.0 * self.inverse, self.ends.1 * self.inverse);
        let slices = count as f64;
        // A float becomes the nearest index that exists; one slice more on either side decides for itself.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let index = |sin: f64| (0.5 * (sin + 1.0) * slices) as usize;
        let (first, last) = (index(low.range().0), index(high.range().1));
        let first = if SYMMETRIC {
            count / 2
        } else {
            first.saturating_sub(1)
        };
        (first..(last + 2).min(count)).map(move |k| {
            let times = if SYMMETRIC && 2 * k + 1 != count {
                2
            } else {
                1
            };
            ((2 * k + 1) as f64 / slices - 1.0, times)
        })
    }
}

/// The nodes of a whole zone by number, with what they weigh and how many they stand for: in the plane those of one half, twice.
#[inline(always)]
fn nodes<const SYMMETRIC: bool>(
    rules: &Rules,
) -> impl Iterator<Item = (usize, (f64, f64, u32))> + '_ {
    let rule = rules.on([true; 2]);
    let first = if SYMMETRIC { rule.len() / 2 } else { 0 };
    let alone = if SYMMETRIC {
        rule.len() % 2
    } else {
        rule.len()
    };
    rule[first..].iter().enumerate().map(move |(k, (x, w))| {
        let times = if k < alone { 1 } else { 2 };
        (first + k, (*x, w * f64::from(times), times))
    })
}

/// State on which the force of an element depends.
#[derive(Debug, Clone, Copy)]
pub(super) struct ElementState<T> {
    /// Elastic force \[N\].
    pub elastic: T,
    /// Shares of the normal force in the plane and along the axis, over its magnitude.
    pub share: (T, T),
    /// Weight of friction over the normal force.
    pub friction_weight: T,
    /// The meridional direction of slip is −sin α n_e + cos α ẑ.
    pub slope: Inclination<T>,
    /// Velocity of the ball's surface against the ring's along n_e, t_e and z \[m/s\].
    pub velocity: [T; 3],
    /// Elastic force per length \[N/m\] and penetration \[m\].
    pub load: T,
    pub depth: T,
    /// Contact point from the ball's centre along the ring's radius \[m\].
    pub arm: T,
    pub rolling: Rolling<T>,
    /// Radii of ball and groove \[m\].
    pub radii: [T; 2],
    /// Effect of the contact's film.
    pub oil: FilmEffect<T>,
}

/// The force of an element ([*Normal force*](crate::equations#normal-force) and [*Friction*](crate::equations#friction)).
#[derive(Debug, Clone, Copy)]
pub(super) struct ElementForce<T> {
    /// Force on the ring along n_e, t_e and z \[N\]; the ball gets the opposite.
    pub on_ring: [T; 3],
    /// The part of friction in it, as it acts on the ball.
    pub friction: [T; 3],
    /// Normal force before any clamp: negative where damping pulls \[N\].
    pub damped: T,
    /// Normal force \[N\].
    pub normal: T,
    /// Approach speed v_n \[m/s\].
    pub approach: T,
    /// Slip velocity along t_e and the meridional direction \[m/s\].
    pub slip: [T; 2],
    /// Friction over normal force and slip velocity, φ(u), and φ'(u)/u if asked for; 0 without friction.
    pub factor: T,
    pub bend: T,
}

/// Elastic force, damping and friction of an element, and how friction bends if asked. Where it is `SYMMETRIC` nothing moves along
/// z and all presses in the plane. Where it is `TURNING` the ball turns across its ring's axis, which adds so much to slip along
/// the meridian \[m/s\].
#[inline(always)]
pub(super) fn force<
    T: Number,
    const FMA: bool,
    const SYMMETRIC: bool,
    const BEND: bool,
    const TURNING: bool,
>(
    law: &Law,
    of: &ElementState<T>,
    turning: T,
) -> ElementForce<T> {
    let (in_plane, axial) = of.share;
    let [v_n, v_t, v_z] = of.velocity;
    let approach = if SYMMETRIC {
        v_n
    } else {
        v_n.mul_add::<FMA>(in_plane, v_z * axial)
    };
    let factor = match law.film {
        None => law.damping.factor(approach),
        Some(_) => law.damping.factor_with(approach, of.oil.damping),
    };
    let damped = of.elastic * factor;
    let pressed = damped.or_zero();
    let normal = if law.damping.clamp_pull {
        pressed
    } else {
        damped
    };
    let zero = approach.same(0.0);
    let (mut factor, mut bend, mut slip, mut friction) = (zero, zero, [zero; 2], [zero; 3]);
    if let Some(traction) = &law.traction {
        let Inclination { cos, sin } = of.slope;
        let u_m = if SYMMETRIC {
            -(v_n * sin)
        } else {
            v_z * cos - v_n * sin
        };
        let u_m = if TURNING { u_m + turning } else { u_m };
        slip = [v_t, u_m];
        let sliding = of.sliding(approach, v_t.mul_add::<FMA>(v_t, u_m * u_m));
        if BEND {
            (factor, bend) = traction.factor_and_bend(&sliding);
            bend = bend * of.friction_weight;
        } else {
            factor = traction.factor(&sliding);
        }
        factor = factor * of.friction_weight;
        let drag = factor * pressed;
        let meridional = drag * u_m;
        friction = [meridional * sin, -(drag * v_t), -(meridional * cos)];
    }
    let pressing = if SYMMETRIC {
        [normal, zero, zero]
    } else {
        [normal * in_plane, zero, normal * axial]
    };
    // Differences, not fused products: with those the compiler no longer fills whole registers, and a right-hand
    // side of the wheel bearing takes half as long again.
    let on_ring = [
        pressing[0] - friction[0],
        pressing[1] - friction[1],
        pressing[2] - friction[2],
    ];
    ElementForce {
        on_ring,
        friction,
        damped,
        normal,
        approach,
        slip,
        factor,
        bend,
    }
}

/// Slip that a ball which turns across its ring's axis, with w_n and w_t along n_e and t_e \[rad/s\], adds along t_e and along the
/// meridian (−sin α, cos α) at h n_e + ζ ẑ from its centre: −w_n ζ and −w_t (ζ sin α + h cos α). None of it is an approach: normal
/// forces act through the ball's centre, about which it turns.
#[inline(always)]
pub(super) fn slip_of_turning<T: Number, const FMA: bool>(
    [w_n, w_t]: [T; 2],
    h: T,
    zeta: T,
    slope: Inclination<T>,
) -> [T; 2] {
    let lever = zeta.mul_add::<FMA>(slope.sin, h * slope.cos);
    [-(w_n * zeta), -(w_t * lever)]
}

impl<T: Number> ElementState<T> {
    /// Quantities that a traction law reads, at an approach speed and the square of a slip speed.
    #[inline(always)]
    pub fn sliding(&self, approach: T, squared: T) -> Sliding<T> {
        Sliding {
            squared,
            arm: self.arm,
            rolling: self.rolling,
            load: self.load,
            depth: self.depth,
            approach,
            radii: self.radii,
            friction: self.oil.friction,
            bend: self.oil.bend,
        }
    }
}
