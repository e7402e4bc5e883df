//! Forces of eight contacts at once with a race through points that is concave everywhere.
//!
//! What [`Contour`] does one by one, in [`Lanes`]: the foot, the ends of the zone, the elements between them. Contacts
//! that run over an end of race or ball, or whose Newton steps do not converge, are reported and left to it.

use super::tilted::SpatialSums;
use super::{Across, BatchForces, EightContacts, FrictionWeights, Moves, Place, Sums};
use crate::contact::kernel::{Element, Receiver, Whole};
use crate::contact::laws::elastic::{ElasticLaw, ForLaw};
use crate::contact::profile::{
    Contour, FLAT, Inclination, REACH, SHALLOW, SNUG, Section, SurfacePoint, Zone,
};
use crate::contact::{Cut, FilmEffect, Motion, Pair, ZoneSlices};
use crate::simd::{InstructionSet, Lanes, Mask};

/// Newton steps before a contact is left out.
const STEPS: usize = 6;
/// Newton's last step over the ball's radius: what it leaves is of its square.
const SETTLED: f64 = 1e-7;

/// Eight contacts with a curve.
struct OnCurve<'a> {
    contour: &'a Contour,
    /// Distance of the balls from the ring's axis less the waves, their axial places in the ring's frame, and their radii \[m\].
    d: Lanes,
    z: Lanes,
    radius: Lanes,
}

/// Places where the balls touch a curve.
struct Meetings {
    section: Section<Lanes>,
    /// Ends of the zones on the chord, and along the balls.
    ends: (Lanes, Lanes),
    along: [Lanes; 2],
    /// Contacts that touch, and those of them that are evaluated.
    touching: Mask,
    regular: Mask,
}

impl Pair {
    /// Forces as by [`Pair::forces`], of eight contacts with this race, which is a hollow curve.
    #[inline(always)]
    pub(crate) fn forces_on_curve<const FMA: bool>(
        &self,
        eight: &EightContacts,
        ring: &Motion,
        contour: &Contour,
        instructions: InstructionSet,
        friction_weight: &mut FrictionWeights,
    ) -> BatchForces {
        let (curve, found, whole, moves, place) = self.place_on_curve::<FMA>(eight, ring, contour);
        let middle = (found.ends.0 + found.ends.1) * 0.5;
        let sigma = Lanes::all(self.race.sigma);
        let slip = self.slip::<FMA>(sigma, &whole, &moves);
        let slip = slip.map(|slip| slip.from::<FMA>(middle));
        let friction_weight =
            friction_weight.at_nodes(instructions, self, slip.as_ref(), &whole.half);
        let mut sums = Sums::new(self, sigma, &whole, &moves);
        self.elements_on_curve::<FMA>(&curve, &found, &whole, middle, friction_weight, &mut sums);
        sums.on_bodies(&place)
    }

    /// The same in the frame of a ring that may tilt; see [`Pair::forces_tilted`].
    #[inline(always)]
    pub(crate) fn forces_on_curve_tilted<const FMA: bool>(
        &self,
        eight: &EightContacts,
        turning: Across,
        ring: &Motion,
        contour: &Contour,
        instructions: InstructionSet,
        friction_weight: &mut FrictionWeights,
    ) -> (BatchForces, [Across; 2]) {
        let (curve, found, whole, moves, place) = self.place_on_curve::<FMA>(eight, ring, contour);
        let middle = (found.ends.0 + found.ends.1) * 0.5;
        let turning = place.along_contact(turning, self.race.sigma);
        let sigma = Lanes::all(self.race.sigma);
        let slip = self.slip_tilted::<FMA>(sigma, &whole, &moves, turning);
        let slip = slip.map(|slip| slip.from::<FMA>(middle));
        let friction_weight =
            friction_weight.at_nodes(instructions, self, slip.as_ref(), &whole.half);
        let mut sums = SpatialSums {
            sums: Sums::new(self, Lanes::all(self.race.sigma), &whole, &moves),
            turning,
            moments: [Lanes::ZERO; 2],
        };
        self.elements_on_curve::<FMA>(&curve, &found, &whole, middle, friction_weight, &mut sums);
        sums.on_bodies(eight, &place)
    }

    /// Places of eight contacts on a curve.
    #[inline(always)]
    fn place_on_curve<'a, const FMA: bool>(
        &self,
        eight: &EightContacts,
        ring: &Motion,
        contour: &'a Contour,
    ) -> (OnCurve<'a>, Meetings, Whole<Lanes>, Moves<Lanes>, Place) {
        let sigma = self.race.sigma;
        let (dx, dy) = (eight.q[0] - ring.centre.x, eight.q[1] - ring.centre.y);
        let d = dx.mul_add::<FMA>(dx, dy * dy).sqrt();
        let over = Lanes::all(1.0) / d;
        let n = (dx * over, dy * over);
        let curve = OnCurve {
            contour,
            d: d - eight.raise.height,
            z: eight.q[2] - ring.z,
            radius: eight.constants.radius,
        };
        let found = curve.meet::<FMA>(&self.law.cut());
        let v = [eight.v[0] - ring.velocity.x, eight.v[1] - ring.velocity.y];
        let across = v[1] * n.0 - v[0] * n.1;
        let whole = found.whole(eight);
        let moves = Moves {
            v_e: (v[0] * n.0 + v[1] * n.1) * sigma,
            v_z: eight.v[2] - ring.vz,
            slide: (across - d * ring.omega) * sigma,
            spin: (eight.v[3] - ring.omega) * sigma,
            rolling: self.rolling(eight, Lanes::all(ring.omega), d, across),
            // Heights of the race are those over the ring's axis.
            arm: eight.raise.height - d,
            oil: FilmEffect::of(eight.film.as_ref(), whole.half),
        };
        let place = Place {
            n,
            d,
            wave_slope: eight.wavy.then(|| eight.raise.slope * over),
            // Textures are of balls in plain grooves.
            turn: None,
            regular: found.regular.or(found.touching.not()),
        };
        (curve, found, whole, moves, place)
    }

    /// The elements of eight contacts.
    #[inline(always)]
    fn elements_on_curve<const FMA: bool>(
        &self,
        curve: &OnCurve<'_>,
        found: &Meetings,
        whole: &Whole<Lanes>,
        middle: Lanes,
        friction_weight: Option<&[Lanes]>,
        to: &mut impl Receiver<Lanes>,
    ) {
        // What is not evaluated here stands clear of the race.
        let clear = Lanes::all(-1e3 * self.race.sigma);
        self.law.elastic.choose(CurveElements::<_, FMA> {
            slices: &self.slices,
            curve,
            whole,
            d: found.regular.choose(curve.d, clear),
            middle,
            friction_weight,
            to,
        });
    }
}

impl OnCurve<'_> {
    /// Places where the balls touch, and the ends between which they do.
    #[inline(always)]
    fn meet<const FMA: bool>(&self, cut: &Cut) -> Meetings {
        let (section, settled) = self.foot::<FMA>();
        let (zero, radius) = (Lanes::ZERO, self.radius);
        // What is not a number touches and is evaluated, so that it shows.
        let unknown = section.approach.is_nan();
        let touching = section.approach.above(zero).or(unknown);
        let on_top = (radius * (1.0 - SHALLOW)).above(section.approach);
        let (ends, sealed) = match cut {
            Cut::BallSurface => self.ends::<FMA>(&section, touching),
            Cut::CommonTangent { curvature } => {
                let half = Zone::on_tangent(&section, Lanes::all(0.5 * curvature)).half;
                ((-half, half), Mask::default().not())
            }
        };
        let Inclination { cos, sin } = section.normal;
        let [first, last] = self.contour.ends();
        let mut regular = settled.and(sealed).and(on_top);
        let mut along = [zero; 2];
        for (u, along) in [ends.0, ends.1].into_iter().zip(&mut along) {
            let reach = u.abs();
            regular = regular.and((radius * REACH).above(reach));
            let (zeta, rho) = match cut {
                Cut::BallSurface => {
                    let height = (radius * radius - u * u).or_zero().sqrt();
                    (height * sin + u * cos, height * cos - u * sin)
                }
                Cut::CommonTangent { .. } => {
                    let zeta = radius * sin + u * cos;
                    (zeta, radius - zeta.abs())
                }
            };
            *along = zeta;
            let z = self.z + zeta;
            let on_race = z.above(Lanes::all(first)).and(Lanes::all(last).above(z));
            regular = regular.and(rho.above(zero)).and(on_race);
        }
        let regular = regular.and(touching).or(unknown);
        let keep = |x: Lanes| regular.choose(x, zero);
        Meetings {
            section: Section {
                approach: keep(section.approach),
                ..section
            },
            ends: (keep(ends.0), keep(ends.1)),
            along: [keep(along[0]), keep(along[1])],
            touching,
            regular,
        }
    }

    /// The circles of curvature at the feet, from the nominal torus on, and where Newton's steps have settled.
    #[inline(always)]
    fn foot<const FMA: bool>(&self) -> (Section<Lanes>, Mask) {
        let (sigma, (d, z)) = (self.contour.sigma(), (self.d, self.z));
        let mut foot = match self.contour.nominal() {
            Some(torus) => {
                let (e, x) = (d - torus.a, z - torus.centre);
                x * torus.r / e.mul_add::<FMA>(e, x * x).sqrt() + torus.centre
            }
            None => z,
        };
        let last = self.radius * SETTLED;
        let mut at = [Lanes::ZERO; 3];
        let mut step = Lanes::ZERO;
        for _ in 0..STEPS {
            at = self.contour.curve().at_eight::<FMA>(foot);
            let [r, slope, bend] = at;
            let short = d - r;
            let falls = (foot - z) - short * slope;
            step = falls / (slope * slope + 1.0 - short * bend);
            foot = foot - step;
            if !step.abs().above(last).any() {
                break;
            }
        }
        let settled = step.abs().above(last).not();
        // To where the last step led.
        let [r, slope, bend] = at;
        let r = r - step * (slope - step * bend * 0.5);
        let slope = slope - step * bend;
        let cos = Lanes::all(1.0) / (slope * slope + 1.0).sqrt();
        let normal = Inclination {
            cos,
            sin: -(slope * cos) * sigma,
        };
        let height = (r - d) * sigma * normal.cos + (foot - z) * normal.sin;
        let approach = self.radius - height;
        let hollow = -(bend * (cos * cos * cos)) * sigma;
        let least = self.radius * SNUG;
        let flattest = Lanes::all(1.0 / FLAT) / self.radius;
        let bent = hollow.above(flattest).choose(hollow, flattest);
        let circle = Lanes::all(1.0) / bent;
        let circle = circle.above(least).choose(circle, least);
        let l = approach + circle - self.radius;
        let section = Section {
            radius: self.radius,
            r: circle,
            e: l * normal.cos,
            c: -(l * normal.sin),
            l,
            normal,
            approach,
        };
        (section, settled)
    }

    /// Ends of the zones on the chords by Newton's method from those of the circles, and where its steps have settled.
    #[inline(always)]
    fn ends<const FMA: bool>(
        &self,
        section: &Section<Lanes>,
        touching: Mask,
    ) -> ((Lanes, Lanes), Mask) {
        let half = Zone::on_chord(section).half;
        let (low, settled_low) = self.end::<FMA>(section, touching, -half);
        let (high, settled_high) = self.end::<FMA>(section, touching, half);
        ((low, high), settled_low.and(settled_high))
    }

    #[inline(always)]
    fn end<const FMA: bool>(
        &self,
        section: &Section<Lanes>,
        touching: Mask,
        mut u: Lanes,
    ) -> (Lanes, Mask) {
        let (sigma, radius) = (self.contour.sigma(), self.radius);
        let Inclination { cos, sin } = section.normal;
        let last = u.abs() * SETTLED;
        let mut moving = Mask::default();
        for _ in 0..STEPS {
            let height = (radius * radius - u * u).sqrt();
            let falls = u / height;
            let (zeta, rho) = (height * sin + u * cos, height * cos - u * sin);
            let [r, slope, _] = self.contour.curve().at_eight::<FMA>(self.z + zeta);
            let depth = (self.d - r) * sigma + rho;
            let rate = -(slope * sigma * (cos - falls * sin)) - falls * cos - sin;
            let step = touching.choose(depth / rate, Lanes::ZERO);
            u = u - step;
            moving = step.abs().above(last);
            if !moving.any() {
                break;
            }
        }
        (u, moving.not())
    }
}

impl Meetings {
    /// The contacts as the kernel has them, for what their elements share.
    #[inline(always)]
    fn whole(&self, eight: &EightContacts) -> Whole<Lanes> {
        Whole {
            section: self.section,
            inverse: eight.constants.inverse,
            half: (self.ends.1 - self.ends.0) * 0.5,
            ends: (self.along[0], self.along[1]),
            strength: eight.constants.strength,
            half_curvature: eight.constants.half_curvature,
        }
    }
}

/// The elements of eight contacts with a curve, for one elastic law.
struct CurveElements<'a, R, const FMA: bool> {
    slices: &'a ZoneSlices,
    curve: &'a OnCurve<'a>,
    whole: &'a Whole<Lanes>,
    /// Distances from the ring's axis less the waves \[m\].
    d: Lanes,
    /// u of the zones' middles \[m\].
    middle: Lanes,
    /// Weights of friction at nodes over the normal force, if not the same.
    friction_weight: Option<&'a [Lanes]>,
    to: &'a mut R,
}

impl<R: Receiver<Lanes>, const FMA: bool> ForLaw for CurveElements<'_, R, FMA> {
    #[inline(always)]
    fn run<L: ElasticLaw>(self) {
        let whole = self.whole;
        let (half, radius) = (whole.half, whole.section.radius);
        match self.slices {
            ZoneSlices::Fitted(rules) => {
                for (k, &(x, weight)) in rules.on([true; 2]).iter().enumerate() {
                    let (u, length) = (half * x + self.middle, half * weight);
                    let mut element = if L::FLAT {
                        self.on_tangent::<L>(u, length)
                    } else {
                        let point =
                            SurfacePoint::over::<FMA>(whole.section.normal, u * whole.inverse);
                        let SurfacePoint { cos, sin, tan, .. } = point;
                        let slope = Inclination { cos, sin };
                        self.on_surface::<L>(slope, tan, length * point.stretch)
                    };
                    if let Some(friction_weight) = self.friction_weight {
                        element.friction_weight = friction_weight[k];
                    }
                    self.to.element::<FMA, false>(&element, 1);
                }
            }
            ZoneSlices::Fixed(count) => {
                let width = radius * (2.0 / *count as f64);
                let Inclination { cos, sin } = whole.section.normal;
                for (place, _) in whole.fixed_sines::<false>(*count) {
                    let element = if L::FLAT {
                        let over = Lanes::all(1.0) / cos;
                        self.on_tangent::<L>(radius * (-sin + place) * over, width * over)
                    } else {
                        let cos = (1.0 - place * place).sqrt();
                        let slope = Inclination { cos, sin: place };
                        let tan = Lanes::all(place / cos);
                        self.on_surface::<L>(slope.map(Lanes::all), tan, width)
                    };
                    self.to.element::<FMA, false>(&element, 1);
                }
            }
        }
    }
}

impl<R, const FMA: bool> CurveElements<'_, R, FMA> {
    /// σ R under the points of the balls at sin α \[m\].
    #[inline(always)]
    fn height(&self, sin: Lanes) -> Lanes {
        let OnCurve {
            contour, z, radius, ..
        } = self.curve;
        let [r, ..] = contour
            .curve()
            .at_eight::<FMA>(sin.mul_add::<FMA>(*radius, *z));
        r * contour.sigma()
    }

    /// A slice of the ball's surface.
    #[inline(always)]
    fn on_surface<L: ElasticLaw>(
        &self,
        slope: Inclination<Lanes>,
        tan: Lanes,
        width: Lanes,
    ) -> Element<Lanes> {
        let Inclination { cos, sin } = slope;
        let height = self.height(sin);
        let before = self.d * self.curve.contour.sigma() - height;
        let depth = cos.mul_add::<FMA>(self.curve.radius, before).or_zero();
        Element {
            sin,
            slope,
            groove: height,
            depth,
            length: width,
            load: L::load::<Lanes, FMA>(self.whole.strength, depth),
            share: (Lanes::all(1.0), tan),
            friction_weight: Lanes::all(1.0),
        }
    }

    /// An element of the common tangent.
    #[inline(always)]
    fn on_tangent<L: ElasticLaw>(&self, u: Lanes, length: Lanes) -> Element<Lanes> {
        let whole = self.whole;
        let normal = whole.section.normal;
        let sin = (u * whole.inverse).mul_add::<FMA>(normal.cos, normal.sin);
        let depth = (whole.section.approach - u * u * whole.half_curvature).or_zero();
        Element {
            sin,
            slope: normal,
            groove: self.height(sin),
            depth,
            length,
            load: L::load::<Lanes, FMA>(whole.strength, depth),
            share: normal.share(),
            friction_weight: Lanes::all(1.0),
        }
    }
}
