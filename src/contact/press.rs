//! Forces of eight contacts at once.
//!
//! The same contacts as `pair` and `walk` evaluate one by one, wherever ball and race are whole and the zone ends
//! in the groove: then a node is the same few lines for all, and the contacts lie side by side in [`Lanes`].
//! In the `PLANE` (every ball level with its groove, nothing moves along z) the zone is symmetric, and half of it stands
//! for the whole.
//! Whatever is not so simple (a shoulder, a ball that is not in front of its groove) is told, and left to
//! [`Pair::evaluate`].

// Everything here must be compiled for the instructions of its caller.
#![allow(clippy::inline_always)]

use super::octet::Octet;
use super::power::ten_ninths;
use super::race::SHALLOW;
use super::{Law, Motion, Pair, Slices};
use crate::simd::{Counters, Lanes, Mask};

/// What eight contacts put on balls and ring: force \[N\] and moment about z \[N m\].
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Press {
    pub ball: [Lanes; 4],
    pub ring: [Lanes; 4],
    /// Slices whose damping wanted to pull.
    pub pulls: u32,
    /// Contacts left out here.
    pub careful: Mask,
}

/// The eight contacts as two circles each in their meridional planes (see `Meridian`), and how they move.
pub(super) struct Circles {
    /// Ball radius, and one over it.
    radius: Lanes,
    inverse: Lanes,
    /// Groove radius squared.
    r_square: Lanes,
    e: Lanes,
    c: Lanes,
    approach: Lanes,
    /// (cos α', sin α') of the common normal.
    normal: (Lanes, Lanes),
    /// Half-length of the zone along the common tangent.
    half: Lanes,
    /// Its ends along ζ.
    low: Lanes,
    high: Lanes,
    strength: Lanes,
    half_curvature: Lanes,
    /// The contact's arm from the ball's centre, R(z) − d, is this and σ √(r² − x²).
    pub arm: Lanes,
    v_e: Lanes,
    v_z: Lanes,
    /// v_t is slide + spin · arm.
    slide: Lanes,
    spin: Lanes,
}

/// Zones: half-length along the common tangent, and ends along ζ.
struct Zone {
    half: Lanes,
    /// Height of the chord over the ball's centre.
    height: Lanes,
    low: Lanes,
    high: Lanes,
    /// Height of the lower end above the ball's equator: not positive where the zone's end is the ball's.
    lowest: Lanes,
}

/// A node of every contact.
pub(super) struct Node {
    /// ζ/R and ρ/R.
    pub sin: Lanes,
    pub cos: Lanes,
    /// √(r² − x²).
    pub groove: Lanes,
    pub elastic: Lanes,
    /// In-plane and axial part of the normal force over its magnitude.
    pub share: (Lanes, Lanes),
}

/// Where eight contacts are and which way they point.
pub(super) struct Place {
    /// Unit vector in the plane from the ring's centre to the ball's, and their distance there.
    pub n: (Lanes, Lanes),
    pub d: Lanes,
    /// Slope of the waves along the race, R'(φ)/d, if there are any: the force along t_e over that along n_e (see
    /// `gradient`).
    pub lean: Option<Lanes>,
    /// Contacts whose nodes are these; the others get none that press.
    pub simple: Mask,
}

/// Takes the nodes of eight contacts.
pub(super) trait Receiver {
    /// One node of each, which stands for so many slices. Wants `#[inline(always)]`.
    fn node<const FMA: bool, const PLANE: bool>(
        &mut self,
        pair: &Pair,
        circles: &Circles,
        node: &Node,
        times: u32,
    );
}

/// Sums over the nodes: forces along n_e, t_e and z, and the moment of those along t_e about the ball.
#[derive(Default)]
struct Sums {
    normal: Lanes,
    tangential: Lanes,
    axial: Lanes,
    moment: Lanes,
    pulls: Counters,
}

/// The same on waves, whose slope takes the elastic part of the force along n_e.
#[derive(Default)]
struct WavySums {
    sums: Sums,
    elastic: Lanes,
}

impl Pair {
    /// Forces of eight contacts of this or another row: what their constants do not say (the kind of law, where
    /// the ball is cut, damping, friction) is the same for all rows. Contacts in `skip` are left out, and told. With a
    /// `stiffness` they follow Hertz's law as a whole.
    #[inline(always)]
    pub(crate) fn press<const FMA: bool, const PLANE: bool>(
        &self,
        octet: &Octet,
        ring: &Motion,
        skip: Mask,
        stiffness: Option<f64>,
    ) -> Press {
        let (circles, place) = self.place::<FMA, PLANE>(octet, ring, skip);
        let mut sums = Sums::default();
        if let Some(lean) = place.lean {
            let mut wavy = WavySums::default();
            self.every::<FMA, PLANE, _>(&circles, stiffness, &mut wavy);
            sums = wavy.sums;
            sums.tangential += wavy.elastic * lean;
        } else {
            self.every::<FMA, PLANE, _>(&circles, stiffness, &mut sums);
        }
        let (sigma, n) = (self.race.sigma, place.n);
        let (along, across) = (sums.normal * sigma, sums.tangential * sigma);
        let plane = (n.0 * along - n.1 * across, n.1 * along + n.0 * across);
        let moment = sums.moment * sigma;
        Press {
            ball: [plane.0, plane.1, sums.axial, moment],
            // About the ring's centre the arm is longer by d.
            ring: [-plane.0, -plane.1, -sums.axial, -moment - place.d * across],
            pulls: sums.pulls.total(),
            careful: place.simple.not(),
        }
    }

    /// Where eight contacts are; those in `skip` are not simple.
    #[inline(always)]
    pub(super) fn place<const FMA: bool, const PLANE: bool>(
        &self,
        octet: &Octet,
        ring: &Motion,
        skip: Mask,
    ) -> (Circles, Place) {
        let of = &octet.constants;
        let sigma = self.race.sigma;
        let (zero, one) = (Lanes::ZERO, Lanes::all(1.0));
        let (dx, dy) = (octet.q[0] - ring.centre.x, octet.q[1] - ring.centre.y);
        let d = dx.mul_add::<FMA>(dx, dy * dy).sqrt();
        let over = one / d;
        let n = (dx * over, dy * over);
        let raised = of.a + octet.raise.height;
        let e = (d - raised) * sigma;
        let (c, l, normal) = if PLANE {
            (zero, e, (one, zero))
        } else {
            let c = of.centre + ring.z - octet.q[2];
            let l = e.mul_add::<FMA>(e, c * c).sqrt();
            let over = one / l;
            (c, l, (e * over, -(c * over)))
        };
        let approach = l + of.radius - of.r;
        let zone = self.zone::<PLANE>(octet, normal, l, approach);
        let simple = is_simple::<PLANE>(octet, e, c, &zone).and(skip.not());
        // Contacts that are not evaluated here get a place just clear of the groove.
        let clear = (of.r - of.radius) * 0.5;
        let v_z = if PLANE { zero } else { octet.v[2] - ring.vz };
        let v = [octet.v[0] - ring.velocity.x, octet.v[1] - ring.velocity.y];
        let circles = Circles {
            radius: of.radius,
            inverse: one / of.radius,
            r_square: of.r * of.r,
            e: simple.choose(e, clear),
            c: simple.choose(c, zero),
            approach: simple.choose(approach, zero),
            normal: (simple.choose(normal.0, one), simple.choose(normal.1, zero)),
            half: simple.choose(zone.half, zero),
            low: simple.choose(zone.low, zero),
            high: simple.choose(zone.high, zero),
            strength: of.strength,
            half_curvature: of.half_curvature,
            arm: raised - d,
            v_e: (v[0] * n.0 + v[1] * n.1) * sigma,
            v_z,
            slide: (v[1] * n.0 - v[0] * n.1 - d * ring.omega) * sigma,
            spin: (octet.v[3] - ring.omega) * sigma,
        };
        let lean = octet.wavy.then(|| octet.raise.slope * over);
        let place = Place { n, d, lean, simple };
        (circles, place)
    }

    /// The zones in closed form, as in `Meridian::zone` and `Line::along_tangent`.
    #[inline(always)]
    fn zone<const PLANE: bool>(
        &self,
        octet: &Octet,
        normal: (Lanes, Lanes),
        l: Lanes,
        approach: Lanes,
    ) -> Zone {
        let (radius, r) = (octet.constants.radius, octet.constants.r);
        let (half, height) = match &self.law {
            Law::Iso16281(_) => {
                let sum = approach * (l + radius + r) * 0.5 / l;
                let half = (sum * (radius + radius - sum)).or_zero().sqrt();
                (half, radius - sum)
            }
            Law::Hertz(_) => {
                let square = approach / octet.constants.half_curvature;
                (square.or_zero().sqrt(), radius)
            }
        };
        if PLANE {
            return Zone {
                half,
                height,
                low: -half,
                high: half,
                lowest: height,
            };
        }
        let (middle, reach) = (height * normal.1, half * normal.0);
        Zone {
            half,
            height,
            low: middle - reach,
            high: middle + reach,
            lowest: height * normal.0 - (half * normal.1).abs(),
        }
    }

    /// Hands all nodes to their receiver: the law, cut as the scene says.
    #[inline(always)]
    pub(super) fn each<const FMA: bool, const PLANE: bool, R: Receiver>(
        &self,
        circles: &Circles,
        to: &mut R,
    ) {
        let half = circles.half;
        match (&self.slices, &self.law) {
            (Slices::Fitted(rules), Law::Iso16281(_)) => {
                let reach = half * circles.inverse;
                for (x, weight, times) in nodes::<PLANE>(rules.on([true; 2])) {
                    let node = circles.iso_node::<FMA, PLANE>(reach * x, half * weight);
                    to.node::<FMA, PLANE>(self, circles, &node, times);
                }
            }
            (Slices::Fitted(rules), Law::Hertz(_)) => {
                for (x, weight, times) in nodes::<PLANE>(rules.on([true; 2])) {
                    let node = circles.hertz::<FMA>(half * x, half * weight);
                    to.node::<FMA, PLANE>(self, circles, &node, times);
                }
            }
            (Slices::Fixed(count), Law::Iso16281(_)) => {
                let width = circles.radius * (2.0 / *count as f64);
                for (sin, times) in circles.fixed_sines::<PLANE>(*count) {
                    let node = circles.iso_slice::<FMA>(sin, width * f64::from(times));
                    to.node::<FMA, PLANE>(self, circles, &node, times);
                }
            }
            (Slices::Fixed(count), Law::Hertz(_)) => {
                let over = Lanes::all(1.0) / circles.normal.0;
                let length = circles.radius * (2.0 / *count as f64) * over;
                let middle = circles.radius * circles.normal.1;
                for (sin, times) in circles.fixed_sines::<PLANE>(*count) {
                    let u = (circles.radius * sin - middle) * over;
                    let node = circles.hertz::<FMA>(u, length * f64::from(times));
                    to.node::<FMA, PLANE>(self, circles, &node, times);
                }
            }
        }
    }

    /// All nodes, or with a stiffness one for all.
    #[inline(always)]
    fn every<const FMA: bool, const PLANE: bool, R: Receiver>(
        &self,
        circles: &Circles,
        stiffness: Option<f64>,
        to: &mut R,
    ) {
        match stiffness {
            Some(stiffness) => self.whole::<FMA, R>(circles, stiffness, to),
            None => self.each::<FMA, PLANE, R>(circles, to),
        }
    }

    /// Hertz's contacts without friction as a whole, K δ^{3/2}: every slice approaches alike.
    #[inline(always)]
    fn whole<const FMA: bool, R: Receiver>(&self, circles: &Circles, stiffness: f64, to: &mut R) {
        let pressed = circles.approach.or_zero();
        let node = Node {
            sin: Lanes::ZERO,
            cos: Lanes::ZERO,
            groove: Lanes::ZERO,
            elastic: pressed * pressed.sqrt() * stiffness,
            share: circles.normal,
        };
        to.node::<FMA, false>(self, circles, &node, self.slices.count());
    }
}

impl Receiver for Sums {
    /// Damping and friction of a node (model section 5), and its part in the sums; it stands for so many slices.
    #[inline(always)]
    fn node<const FMA: bool, const PLANE: bool>(
        &mut self,
        pair: &Pair,
        circles: &Circles,
        node: &Node,
        times: u32,
    ) {
        let (in_plane, axial) = node.share;
        let (v_e, v_z) = (circles.v_e, circles.v_z);
        let approach = if PLANE {
            v_e
        } else {
            v_e.mul_add::<FMA>(in_plane, v_z * axial)
        };
        let damped = node.elastic * (approach * (1.5 * pair.damping) + 1.0);
        self.pulls.add(Lanes::ZERO.above(damped), times);
        let pressed = damped.or_zero();
        let normal = if pair.clamp_pull { pressed } else { damped };
        let (mut along, mut out) = if PLANE {
            (normal, Lanes::ZERO)
        } else {
            (normal * in_plane, normal * axial)
        };
        if let Some(friction) = &pair.friction {
            let arm = node
                .groove
                .mul_add::<FMA>(Lanes::all(pair.race.sigma), circles.arm);
            let v_t = circles.spin.mul_add::<FMA>(arm, circles.slide);
            let u_m = if PLANE {
                -(v_e * node.sin)
            } else {
                v_z * node.cos - v_e * node.sin
            };
            let factor = friction.factors(v_t.mul_add::<FMA>(v_t, u_m * u_m)) * pressed;
            let (tangential, meridional) = (factor * v_t, factor * u_m);
            along = along - meridional * node.sin;
            if !PLANE {
                out = meridional.mul_add::<FMA>(node.cos, out);
            }
            self.tangential = self.tangential - tangential;
            self.moment = self.moment - tangential * arm;
        }
        self.normal = self.normal - along;
        if !PLANE {
            self.axial = self.axial - out;
        }
    }
}

impl Receiver for WavySums {
    #[inline(always)]
    fn node<const FMA: bool, const PLANE: bool>(
        &mut self,
        pair: &Pair,
        circles: &Circles,
        node: &Node,
        times: u32,
    ) {
        self.elastic += node.elastic * node.share.0;
        self.sums.node::<FMA, PLANE>(pair, circles, node, times);
    }
}

/// The nodes of a rule with what they weigh and how many they stand for: in the plane those of one half, twice.
#[inline(always)]
fn nodes<const PLANE: bool>(rule: &[(f64, f64)]) -> impl Iterator<Item = (f64, f64, u32)> + '_ {
    let first = if PLANE { rule.len() / 2 } else { 0 };
    let alone = if PLANE { rule.len() % 2 } else { rule.len() };
    rule[first..].iter().enumerate().map(move |(k, (x, w))| {
        let times = if k < alone { 1 } else { 2 };
        (*x, w * f64::from(times), times)
    })
}

/// Whether the zone's ends lie on ball and race.
#[inline(always)]
fn is_simple<const PLANE: bool>(octet: &Octet, e: Lanes, c: Lanes, zone: &Zone) -> Mask {
    /// Of the ball's or the groove's radius: nothing is singular yet.
    const EDGE: f64 = 1.0 - 1e-9;
    let of = &octet.constants;
    // What is not a number is evaluated here, so that it shows.
    let unknown = (e + c).is_nan();
    let (ball, groove) = (of.radius * EDGE, of.r * EDGE);
    let in_front = e.above(Lanes::ZERO).and(zone.lowest.above(Lanes::ZERO));
    let on_top = zone.height.above(of.radius * SHALLOW);
    if PLANE {
        // The groove is wider than the ball, and its shoulders are alike.
        let on_ball = ball.above(zone.high);
        let on_race = of.highest.above(zone.high);
        return on_ball.and(on_race).and(in_front).and(on_top).or(unknown);
    }
    let (left, right) = (zone.low - c, zone.high - c);
    let on_ball = zone.low.above(-ball).and(ball.above(zone.high));
    let on_groove = left.above(-groove).and(groove.above(right));
    let on_race = left.above(of.lowest).and(of.highest.above(right));
    on_ball
        .and(on_groove)
        .and(on_race)
        .and(in_front)
        .and(on_top)
        .or(unknown)
}

impl Circles {
    /// A node of the ISO law at u/R along the common chord, as in `Chord::zeta`.
    #[inline(always)]
    fn iso_node<const FMA: bool, const PLANE: bool>(&self, u: Lanes, stretch: Lanes) -> Node {
        let (normal_cos, normal_sin) = self.normal;
        let height = (-u).mul_add::<FMA>(u, Lanes::all(1.0)).sqrt();
        if PLANE {
            // tan α has no part in what the two halves add up to.
            return self.iso::<FMA>(u, height, Lanes::ZERO, stretch);
        }
        let sin = u.mul_add::<FMA>(normal_cos, height * normal_sin);
        let cos = height * normal_cos - u * normal_sin;
        // One division for 1/height and 1/cos.
        let over = Lanes::all(1.0) / (height * cos);
        let tan = sin * (height * over);
        self.iso::<FMA>(sin, cos, tan, stretch * cos * (cos * over))
    }

    /// A slice of the ISO law at sin α = ζ/R of the ball.
    #[inline(always)]
    fn iso_slice<const FMA: bool>(&self, sin: f64, width: Lanes) -> Node {
        let cos = (1.0 - sin * sin).sqrt();
        let [sin, cos, tan] = [sin, cos, sin / cos].map(Lanes::all);
        self.iso::<FMA>(sin, cos, tan, width)
    }

    #[inline(always)]
    fn iso<const FMA: bool>(&self, sin: Lanes, cos: Lanes, tan: Lanes, width: Lanes) -> Node {
        let groove = self.groove::<FMA>(sin);
        // s = σ(d − R(z)) + ρ.
        let depth = (self.e + (cos * self.radius - groove)).or_zero();
        Node {
            sin,
            cos,
            groove,
            elastic: width * self.strength * depth.map(ten_ninths::<FMA>),
            share: (Lanes::all(1.0), tan),
        }
    }

    /// A slice or node of the Hertz law at u along the common tangent.
    #[inline(always)]
    fn hertz<const FMA: bool>(&self, u: Lanes, length: Lanes) -> Node {
        let sin = (u * self.inverse).mul_add::<FMA>(self.normal.0, self.normal.1);
        let cos = (-sin).mul_add::<FMA>(sin, Lanes::all(1.0)).sqrt();
        let groove = self.groove::<FMA>(sin);
        let depth = (self.approach - u * u * self.half_curvature).or_zero();
        Node {
            sin,
            cos,
            groove,
            elastic: depth * length * self.strength,
            share: self.normal,
        }
    }

    /// √(r² − x²) at sin α = ζ/R of the ball.
    #[inline(always)]
    fn groove<const FMA: bool>(&self, sin: Lanes) -> Lanes {
        let x = sin.mul_add::<FMA>(self.radius, -self.c);
        (-x).mul_add::<FMA>(x, self.r_square).sqrt()
    }

    /// ζ/R in the middle of all fixed slices that may lie in any of the zones, and how many each stands for.
    #[inline(always)]
    fn fixed_sines<const PLANE: bool>(
        &self,
        count: usize,
    ) -> impl Iterator<Item = (f64, u32)> + use<PLANE> {
        let (low, high) = (self.low * self.inverse, self.high * self.inverse);
        let slices = count as f64;
        // A float becomes the nearest index that exists; one slice more on either side decides for itself.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let index = |sin: f64| (0.5 * (sin + 1.0) * slices) as usize;
        let (first, last) = (index(low.least()), index(high.greatest()));
        let first = if PLANE {
            count / 2
        } else {
            first.saturating_sub(1)
        };
        (first..(last + 2).min(count)).map(move |k| {
            let times = if PLANE && 2 * k + 1 != count { 2 } else { 1 };
            ((2 * k + 1) as f64 / slices - 1.0, times)
        })
    }
}
