//! Forces of eight contacts at once.
//!
//! The same contacts as [`Pair::evaluate`] takes one by one, wherever ball and race are whole and the zone ends in the
//! groove: then the contacts lie side by side in [`Lanes`]. Other contacts (a shoulder, a ball that is not in
//! front of its groove) are reported, and left to it.

mod friction_weights;
mod gather;
mod points;
mod tilted;

pub(crate) use friction_weights::FrictionWeights;
pub(crate) use gather::{Across, Constants, EightContacts, Places, RingLanes};

use super::kernel::{self, Element, ElementForce, ElementState, Receiver, Whole};
use super::laws::traction::Rolling;
use super::oil::RollingResistance;
use super::profile::{Inclination, SHALLOW, Section, Zone};
use super::slip::Moves;
use super::{FilmEffect, Law, Pair};
use crate::simd::{Counters, InstructionSet, Lanes, Mask};

/// Forces \[N\] and moments about z \[N m\] that eight contacts put on balls and ring.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct BatchForces {
    pub ball: [Lanes; 4],
    pub ring: [Lanes; 4],
    /// Slices whose damping wanted to pull.
    pub pulls: u32,
    /// Contacts left out here.
    pub left_out: Mask,
}

/// Places of eight contacts and the directions in which they point.
pub(super) struct Place {
    /// Unit vector in the plane from the ring's centre to the ball's, and their distance there.
    pub n: (Lanes, Lanes),
    pub d: Lanes,
    /// Slope of the waves along the race, R'(φ)/d, if there are any: the force along t_e over that along n_e (see
    /// `gradient`).
    pub wave_slope: Option<Lanes>,
    /// Moment about the balls that the slope of their texture makes of the elastic force in the plane \[m\], if they have one.
    pub turn: Option<Lanes>,
    /// Contacts whose nodes are these; the others get none that press.
    pub regular: Mask,
}

/// Sums over the elements: forces on the balls along n_e, t_e and z, and the moment of those along t_e about the balls.
struct Sums<'a> {
    law: &'a Law,
    sigma: Lanes,
    moves: &'a Moves<Lanes>,
    radii: [Lanes; 2],
    normal: Lanes,
    tangential: Lanes,
    axial: Lanes,
    moment: Lanes,
    /// The elastic part of that along n_e, of which waves turn some aside. Summed without waves too: that costs less than a
    /// second program for those with.
    elastic: Lanes,
    pulls: Counters,
    /// R cos α' \[m\].
    lever: Lanes,
}

impl Pair {
    /// Forces of eight contacts of this or another row: what their constants do not say (the kind of law, where
    /// the ball is cut, damping, friction) is the same for all rows.
    #[inline(always)]
    pub(crate) fn forces<const FMA: bool, const SYMMETRIC: bool>(
        &self,
        eight: &EightContacts,
        ring: &RingLanes,
        instructions: InstructionSet,
        friction_weight: &mut FrictionWeights,
    ) -> BatchForces {
        let (whole, moves, place) = self.place::<FMA, SYMMETRIC>(eight, ring, Mask::default());
        let mut sums = Sums::new(self, ring.sigma, &whole, &moves);
        let slip = self.slip::<FMA>(ring.sigma, &whole, &moves);
        let friction_weight =
            friction_weight.at_nodes(instructions, self, slip.as_ref(), &whole.half);
        let (law, slices) = (&self.law, &self.slices);
        kernel::elements::<_, FMA, SYMMETRIC>(law, slices, friction_weight, &whole, &mut sums);
        sums.on_bodies(&place)
    }

    /// Places of eight contacts; those in `skip` are not regular.
    #[inline(always)]
    pub(super) fn place<const FMA: bool, const SYMMETRIC: bool>(
        &self,
        eight: &EightContacts,
        ring: &RingLanes,
        skip: Mask,
    ) -> (Whole<Lanes>, Moves<Lanes>, Place) {
        let of = &eight.constants;
        let sigma = ring.sigma;
        let (zero, one) = (Lanes::ZERO, Lanes::all(1.0));
        let [dx, dy, dz] = eight.q_from(ring);
        let d = dx.mul_add::<FMA>(dx, dy * dy).sqrt();
        let over = one / d;
        let n = (dx * over, dy * over);
        let raised = of.a + eight.raise.height;
        let e = (d - raised) * sigma;
        let c = if SYMMETRIC { zero } else { of.centre - dz };
        let mut section = Section::new::<FMA, SYMMETRIC>(of.radius, of.r, e, c);
        let is_flat = self.law.cut().is_flat();
        if let Some(swell) = &eight.swell {
            section = section.raised::<FMA, SYMMETRIC>(is_flat, swell.height);
        }
        let zone = kernel::zone(&self.law.cut(), &section, of.half_curvature);
        let ends = if SYMMETRIC {
            (-zone.half, zone.half)
        } else {
            zone.ends(section.normal)
        };
        let regular =
            is_regular::<SYMMETRIC>(eight, &section, &zone, ends.0, ends.1).and(skip.not());
        // Contacts that are not evaluated here get a place just clear of the groove.
        let clear = (of.r - of.radius) * 0.5;
        let whole = Whole {
            section: Section {
                e: regular.choose(section.e, clear),
                c: regular.choose(c, zero),
                approach: regular.choose(section.approach, zero),
                normal: Inclination {
                    cos: regular.choose(section.normal.cos, one),
                    sin: regular.choose(section.normal.sin, zero),
                },
                ..section
            },
            inverse: of.inverse,
            half: regular.choose(zone.half, zero),
            ends: (regular.choose(ends.0, zero), regular.choose(ends.1, zero)),
            strength: of.strength,
            half_curvature: of.half_curvature,
        };
        let v = eight.v_from(ring);
        let v_z = if SYMMETRIC { zero } else { v[2] };
        let across = v[1] * n.0 - v[0] * n.1;
        let moves = Moves {
            v_e: (v[0] * n.0 + v[1] * n.1) * sigma,
            v_z,
            slide: (across - d * ring.omega) * sigma,
            spin: (eight.v[3] - ring.omega) * sigma,
            rolling: self.rolling(eight, ring.omega, d, across),
            arm: raised - d,
            oil: FilmEffect::of(eight.film.as_ref(), whole.half),
        };
        let wave_slope = eight.wavy.then(|| eight.raise.slope * over);
        let turn = match &eight.swell {
            Some(swell) if is_flat => Some(swell.slope / whole.section.normal.cos),
            Some(swell) => Some(swell.slope),
            None => None,
        };
        (
            whole,
            moves,
            Place {
                n,
                d,
                wave_slope,
                turn,
                regular,
            },
        )
    }

    /// How the surfaces roll, if friction asks for it.
    #[inline(always)]
    fn rolling(
        &self,
        eight: &EightContacts,
        omega: Lanes,
        d: Lanes,
        across: Lanes,
    ) -> Rolling<Lanes> {
        if self.reads_rolling() {
            Rolling::new(d, across, [eight.v[3], omega])
        } else {
            Rolling::resting(d)
        }
    }
}

impl<'a> Sums<'a> {
    #[inline(always)]
    fn new(pair: &'a Pair, sigma: Lanes, whole: &Whole<Lanes>, moves: &'a Moves<Lanes>) -> Self {
        let zero = Lanes::ZERO;
        Self {
            law: &pair.law,
            sigma,
            moves,
            radii: [whole.section.radius, whole.section.r],
            normal: zero,
            tangential: zero,
            axial: zero,
            moment: zero,
            elastic: zero,
            pulls: Counters::default(),
            lever: whole.section.radius * whole.section.normal.cos,
        }
    }

    /// Forces on balls and ring.
    #[inline(always)]
    fn on_bodies(&self, place: &Place) -> BatchForces {
        let (sigma, n) = (self.sigma, place.n);
        let mut tangential = self.tangential;
        if let Some(wave_slope) = place.wave_slope {
            tangential += self.elastic * wave_slope;
        }
        let (along, mut across) = (self.normal * sigma, tangential * sigma);
        let mut moment = self.moment * sigma;
        if let Some(turn) = place.turn {
            // One force at the ring's centre, and the opposite on the ring (see `gradient`).
            let turning = self.elastic * turn;
            across += -(turning / place.d);
            moment += turning;
        }
        if self.law.film.is_some() {
            let resistance = RollingResistance::new(
                self.moves.oil.rolling,
                self.moves,
                sigma,
                place.d,
                self.lever,
            );
            across += resistance.force;
            moment += resistance.moment;
        }
        let plane = (n.0 * along - n.1 * across, n.1 * along + n.0 * across);
        BatchForces {
            ball: [plane.0, plane.1, self.axial, moment],
            // About the ring's centre the arm is longer by d.
            ring: [-plane.0, -plane.1, -self.axial, -moment - place.d * across],
            pulls: self.pulls.total(),
            left_out: place.regular.not(),
        }
    }
}

impl Sums<'_> {
    /// State on which the force of an element depends; its elastic force is counted.
    #[inline(always)]
    fn state<const FMA: bool>(&mut self, element: &Element<Lanes>) -> ElementState<Lanes> {
        let moves = self.moves;
        let arm = element.groove.mul_add::<FMA>(self.sigma, moves.arm);
        let elastic = element.load * element.length;
        self.elastic += elastic * element.share.0;
        ElementState {
            elastic,
            share: element.share,
            friction_weight: element.friction_weight,
            slope: element.slope,
            velocity: [
                moves.v_e,
                moves.spin.mul_add::<FMA>(arm, moves.slide),
                moves.v_z,
            ],
            load: element.load,
            depth: element.depth,
            arm,
            rolling: moves.rolling,
            radii: self.radii,
            oil: moves.oil,
        }
    }

    /// Adds the force of so many elements at an arm.
    #[inline(always)]
    fn add<const SYMMETRIC: bool>(&mut self, force: &ElementForce<Lanes>, arm: Lanes, times: u32) {
        self.pulls.add(Lanes::ZERO.above(force.damped), times);
        let [normal, tangential, axial] = force.on_ring;
        self.normal = self.normal - normal;
        if self.law.traction.is_some() {
            self.tangential = self.tangential - tangential;
            self.moment = self.moment - tangential * arm;
        }
        if !SYMMETRIC {
            self.axial = self.axial - axial;
        }
    }
}

impl Receiver<Lanes> for Sums<'_> {
    #[inline(always)]
    fn element<const FMA: bool, const SYMMETRIC: bool>(
        &mut self,
        element: &Element<Lanes>,
        times: u32,
    ) {
        let state = self.state::<FMA>(element);
        let force = kernel::force::<_, FMA, SYMMETRIC, false, false>(self.law, &state, Lanes::ZERO);
        self.add::<SYMMETRIC>(&force, state.arm, times);
    }
}

/// Whether the zone's ends lie on ball and race.
#[inline(always)]
fn is_regular<const SYMMETRIC: bool>(
    eight: &EightContacts,
    section: &Section<Lanes>,
    zone: &Zone<Lanes>,
    low: Lanes,
    high: Lanes,
) -> Mask {
    /// Bound of places as a share of the ball's or the groove's radius: nothing is singular yet.
    const EDGE: f64 = 1.0 - 1e-9;
    let of = &eight.constants;
    let (e, c) = (section.e, section.c);
    // What is not a number is evaluated here, so that it shows.
    let unknown = (e + c).is_nan();
    let (ball, groove) = (of.radius * EDGE, of.r * EDGE);
    let lowest = if SYMMETRIC {
        zone.height
    } else {
        zone.lowest(section.normal)
    };
    let in_front = e.above(Lanes::ZERO).and(lowest.above(Lanes::ZERO));
    let on_top = zone.height.above(of.radius * SHALLOW);
    if SYMMETRIC {
        // The groove is wider than the ball, and its shoulders are alike.
        let on_ball = ball.above(high);
        let on_race = of.highest.above(high);
        return on_ball.and(on_race).and(in_front).and(on_top).or(unknown);
    }
    let (left, right) = (low - c, high - c);
    let on_ball = low.above(-ball).and(ball.above(high));
    let on_groove = left.above(-groove).and(groove.above(right));
    let on_race = left.above(of.lowest).and(of.highest.above(right));
    on_ball
        .and(on_groove)
        .and(on_race)
        .and(in_front)
        .and(on_top)
        .or(unknown)
}
