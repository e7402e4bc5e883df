//! Contacts held where they are: the part of their elements that does not depend on velocities, and how their forces depend on them.
//!
//! With all of a node's force at one point, slip and approach depend only on the relative twist
//! w = (v_b − v_r − θ̇_r ẑ × a, θ̇_b − θ̇_r), where a leads from the ring's centre to the ball's: four numbers a
//! contact, and the ball's turning about x and y behind them where it spins freely. The derivative by w of the wrench on the ball about
//! its centre says all about both bodies.

// Loops over matrices read as their formulae do.
#![allow(clippy::needless_range_loop)]

mod films;
mod packs;
mod slope;

pub(crate) use packs::{SlicePack, SlicePacking};
pub(crate) use slope::{AXIAL, FREE, HeldSlope, PlaneVector, in_contact};

use super::batch::{Across, EightContacts, FrictionWeights, RingLanes};
use super::kernel::{self, Element, ElementForce, ElementState, Receiver, Whole};
use super::laws::traction::Rolling;
use super::profile::Inclination;
use super::slip::Moves;
use super::{FilmEffect, Motion, Pair};
use crate::simd::{InstructionSet, Lanes, Mask};
use slope::{Slope, moment};

/// An element of eight contacts, or eight slices of one: what of its [`ElementState`] does not depend on velocities.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct HeldElement {
    elastic: Lanes,
    /// Relative growth of the elastic force with the penetration \[1/m\].
    hardening: Lanes,
    share: (Lanes, Lanes),
    /// Weight of friction at the velocities at which the element was found.
    friction_weight: Lanes,
    slope: Inclination<Lanes>,
    /// Moments about the ball's centre of unit forces along n_e and t_e.
    levers: PlaneVector,
    /// ζ, from the ball's centre along the axis.
    place: Lanes,
}

/// Rolling of an element, where traction laws read it beside its slip ([`super::Traction::reads_rolling`]).
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct HeldRolling {
    load: Lanes,
    depth: Lanes,
    arm: Lanes,
}

/// A node that moves.
struct MovedElement {
    state: ElementState<Lanes>,
    force: ElementForce<Lanes>,
    /// Slip along t_e and the meridian by turning about n_e and t_e; about n_e also, beside, where a point stands off the line of
    /// centres, as edges of the ball's own do.
    turns: [Lanes; 2],
    beside: Lanes,
}

/// The elements of eight contacts.
#[derive(Debug, Clone, Default)]
pub(crate) struct HeldElements {
    elements: Vec<HeldElement>,
    /// Rolling of as many elements, or none where the law reads slip alone.
    rolling: Vec<HeldRolling>,
    friction_weight: FrictionWeights,
}

impl HeldElements {
    pub fn clear(&mut self) {
        self.elements.clear();
        self.rolling.clear();
    }

    pub fn iter(&self) -> impl Iterator<Item = (&HeldElement, Option<&HeldRolling>)> {
        let numbered = self.elements.iter().enumerate();
        numbered.map(|(k, element)| (element, self.rolling.get(k)))
    }
}

/// Quantities that all elements of a contact share beside their law.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Around {
    rolling: Rolling<Lanes>,
    /// Radii of ball and groove \[m\].
    radii: [Lanes; 2],
    /// Effect of the film.
    pub oil: FilmEffect<Lanes>,
    /// Distance of the centres of ring and ball, and R cos α' \[m\].
    pub distance: Lanes,
    pub lever: Lanes,
}

impl Around {
    /// The quantities of the contact in one lane, in all lanes.
    #[inline(always)]
    pub fn of(&self, lane: usize) -> Self {
        let Self {
            rolling: Rolling { turns, d },
            radii,
            oil,
            distance,
            lever,
        } = self;
        let all = |of: &Lanes| Lanes::all(of[lane]);
        Self {
            rolling: Rolling {
                turns: [Lanes::all(turns[0][lane]), Lanes::all(turns[1][lane])],
                d: Lanes::all(d[lane]),
            },
            radii: [Lanes::all(radii[0][lane]), Lanes::all(radii[1][lane])],
            oil: oil.map(all),
            distance: all(distance),
            lever: all(lever),
        }
    }
}

/// Eight held contacts with their places.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct HeldContacts {
    /// Unit vector out of the ball at the contact.
    pub n_e: PlaneVector,
    /// Vector from the ring's centre to the ball's.
    pub apart: PlaneVector,
    /// Contacts whose nodes are there; the others get none that press.
    pub regular: Mask,
    pub around: Around,
    /// Zones of the contacts, along which what friction weighs under films is found for any velocities.
    whole: Whole<Lanes>,
    /// `arm` of how they move.
    arm: Lanes,
}

impl Pair {
    /// Holds eight contacts, those of `whole` with their elements; with angular velocities about x and y where balls spin
    /// freely \[rad/s\].
    #[inline(always)]
    pub(crate) fn held_elements<const FMA: bool>(
        &self,
        eight: &EightContacts,
        turning: Option<Across>,
        ring: &Motion,
        whole: Mask,
        instructions: InstructionSet,
        nodes: &mut HeldElements,
    ) -> HeldContacts {
        let ring = &RingLanes::of(ring, self.race.sigma);
        let (contact, moves, place) = self.place::<FMA, false>(eight, ring, whole.not());
        let (regular, sigma) = (place.regular.and(whole), self.race.sigma);
        let HeldElements {
            elements,
            rolling,
            friction_weight,
        } = nodes;
        let slip = match turning {
            None => self.slip::<FMA>(ring.sigma, &contact, &moves),
            Some(turning) => {
                let turning = place.along_contact(turning, sigma);
                self.slip_tilted::<FMA>(ring.sigma, &contact, &moves, turning)
            }
        };
        let friction_weight =
            friction_weight.at_nodes(instructions, self, slip.as_ref(), &contact.half);
        let mut holding = Holding {
            elements,
            rolling,
            reads_rolling: self.reads_rolling(),
            exponent: self.law.elastic.exponent(),
            moves: &moves,
            sigma,
            radius: contact.section.radius,
            regular,
        };
        let slices = &self.slices;
        kernel::elements::<_, FMA, false>(
            &self.law,
            slices,
            friction_weight,
            &contact,
            &mut holding,
        );
        HeldContacts {
            whole: contact,
            arm: moves.arm,
            n_e: [place.n.0 * sigma, place.n.1 * sigma],
            apart: [place.n.0 * place.d, place.n.1 * place.d],
            regular,
            around: Around {
                rolling: moves.rolling,
                radii: [contact.section.radius, contact.section.r],
                oil: moves.oil,
                distance: place.d,
                lever: contact.section.radius * contact.section.normal.cos,
            },
        }
    }

    /// Adds how a node answers to a relative twist in the frame (n_e, t_e, z, about z), of whose places it moves by so much \[s\].
    #[inline(always)]
    pub(crate) fn add_slope<const FMA: bool, const N: usize>(
        &self,
        element: &HeldElement,
        rolling: Option<&HeldRolling>,
        around: &Around,
        twist: &[Lanes; N],
        reach: f64,
        to: &mut HeldSlope<N>,
    ) {
        let moved = self.moved::<FMA, true, N>(element, rolling, around, twist);
        let slope = self.slope::<FMA>(&moved.state, &moved.force, element.hardening, reach);
        to.subtract::<FMA>(&slope.force, element.levers);
        if N > AXIAL {
            to.subtract_turning::<FMA>(&slope, element.levers, moved.turns, element.slope);
        }
    }

    /// Adds the wrench on the ball of a node at a relative twist in that frame.
    #[inline(always)]
    fn add_wrench<const FMA: bool, const N: usize>(
        &self,
        element: &HeldElement,
        rolling: Option<&HeldRolling>,
        around: &Around,
        twist: &[Lanes; N],
        to: &mut [Lanes; N],
    ) {
        let moved = self.moved::<FMA, false, N>(element, rolling, around, twist);
        let (HeldElement { levers, slope, .. }, force) = (element, &moved.force);
        for i in 0..3 {
            to[i] = to[i] - force.on_ring[i];
        }
        let [n, t, _] = force.on_ring;
        to[3] = to[3] - moment::<FMA>(n, t, *levers);
        if N > AXIAL {
            let Inclination { cos, sin } = *slope;
            let rubs = force.friction;
            let along = [rubs[1], rubs[2] * cos - rubs[0] * sin];
            for k in 0..2 {
                to[AXIAL + k] = moved.turns[k].mul_add::<FMA>(along[k], to[AXIAL + k]);
            }
            to[AXIAL] = moved.beside.mul_add::<FMA>(along[1], to[AXIAL]);
        }
    }

    /// A node at a relative twist, with what its slope asks for or without.
    #[inline(always)]
    fn moved<const FMA: bool, const SLOPE: bool, const N: usize>(
        &self,
        element: &HeldElement,
        rolling: Option<&HeldRolling>,
        around: &Around,
        twist: &[Lanes; N],
    ) -> MovedElement {
        let levers = element.levers;
        let HeldRolling { load, depth, arm } = rolling.copied().unwrap_or_default();
        let mut velocity = [
            twist[3].mul_add::<FMA>(levers[0], twist[0]),
            twist[3].mul_add::<FMA>(levers[1], twist[1]),
            twist[2],
        ];
        let (one, none) = (Lanes::all(1.0), Lanes::ZERO);
        let beside = -(levers[0] * element.slope.cos);
        let mut turns = [none; 2];
        let mut across = none;
        if N > AXIAL {
            let (h, zeta) = (levers[1], element.place);
            turns = kernel::slip_of_turning::<_, FMA>([one; 2], h, zeta, element.slope);
            velocity[1] = twist[AXIAL].mul_add::<FMA>(turns[0], velocity[1]);
            across = twist[AXIAL].mul_add::<FMA>(beside, twist[AXIAL + 1] * turns[1]);
        }
        let state = ElementState {
            elastic: element.elastic,
            share: element.share,
            friction_weight: element.friction_weight,
            slope: element.slope,
            velocity,
            load,
            depth,
            arm,
            rolling: around.rolling,
            radii: around.radii,
            oil: around.oil,
        };
        let force = if N > AXIAL {
            kernel::force::<_, FMA, false, SLOPE, true>(&self.law, &state, across)
        } else {
            kernel::force::<_, FMA, false, SLOPE, false>(&self.law, &state, none)
        };
        MovedElement {
            state,
            force,
            turns,
            beside,
        }
    }

    /// Derivative of a node's force on the ring by its velocity: what differentiating the kernel says, without the
    /// products that are known to vanish.
    #[inline(always)]
    fn slope<const FMA: bool>(
        &self,
        state: &ElementState<Lanes>,
        force: &ElementForce<Lanes>,
        hardening: Lanes,
        reach: f64,
    ) -> Slope {
        let ((in_plane, axial), Inclination { cos, sin }) = (state.share, state.slope);
        let zero = Lanes::ZERO;
        // How the normal force grows with the velocities; friction only where it presses.
        let rate = self.law.damping.rate();
        let stiff = match self.law.film {
            None => state.elastic * rate,
            Some(_) => state.elastic * (state.oil.damping + rate),
        };
        let stiff = (force.damped * hardening).mul_add::<FMA>(Lanes::all(reach), stiff);
        let rubs = zero.above(force.damped).choose(zero, stiff);
        let stiff = if self.law.damping.clamp_pull {
            rubs
        } else {
            stiff
        };
        let (by_n, by_z) = (stiff * in_plane, stiff * axial);
        let mut slope = [[zero; 3]; 3];
        (slope[0][0], slope[0][2]) = (by_n * in_plane, by_n * axial);
        (slope[2][0], slope[2][2]) = (by_n * axial, by_z * axial);
        if self.law.traction.is_none() {
            return Slope {
                force: slope,
                meridian: [zero; 3],
                slip: [zero; 3],
            };
        }
        let ([v_t, u_m], factor) = (force.slip, force.factor);
        // By slip at constant normal force: N (φ 1 + (φ'/u) u⃗ u⃗ᵀ).
        let pressed = force.damped.or_zero();
        let drag = factor * pressed;
        let bent = force.bend * pressed;
        let tt = (bent * v_t).mul_add::<FMA>(v_t, drag);
        let tm = bent * v_t * u_m;
        let mm = (bent * u_m).mul_add::<FMA>(u_m, drag);
        let (m_n, m_z) = (mm * sin, mm * cos);
        let slip = [
            [m_n * sin, -(tm * sin), -(m_n * cos)],
            [-(tm * sin), tt, tm * cos],
            [-(m_n * cos), tm * cos, m_z * cos],
        ];
        let f_m = factor * u_m;
        let friction = [-(f_m * sin), factor * v_t, f_m * cos];
        let (by_n, by_z) = (rubs * in_plane, rubs * axial);
        for i in 0..3 {
            for j in 0..3 {
                slope[i][j] += slip[i][j];
            }
            slope[i][0] = friction[i].mul_add::<FMA>(by_n, slope[i][0]);
            slope[i][2] = friction[i].mul_add::<FMA>(by_z, slope[i][2]);
        }
        Slope {
            force: slope,
            meridian: [f_m * by_n - m_n, tm, f_m * by_z + m_z],
            slip: [tt, tm, mm],
        }
    }
}

impl HeldElement {
    /// Adds the slope of the elastic force alone, where places move with velocities: −(dN/dδ) n nᵀ times their reach.
    #[inline(always)]
    fn stiffen<const FMA: bool, const N: usize>(&self, reach: f64, to: &mut HeldSlope<N>) {
        let stiff = self.elastic * self.hardening * reach;
        let (in_plane, axial) = self.share;
        let zero = Lanes::ZERO;
        let mixed = stiff * in_plane * axial;
        let slope = [
            [stiff * in_plane * in_plane, zero, mixed],
            [zero; 3],
            [mixed, zero, stiff * axial * axial],
        ];
        to.subtract::<FMA>(&slope, self.levers);
    }
}

/// Collects the elements of eight contacts, of those that are whole.
struct Holding<'a> {
    elements: &'a mut Vec<HeldElement>,
    rolling: &'a mut Vec<HeldRolling>,
    reads_rolling: bool,
    /// Exponent of the elastic law for an element.
    exponent: f64,
    moves: &'a Moves<Lanes>,
    sigma: f64,
    /// Radii of the balls.
    radius: Lanes,
    regular: Mask,
}

impl Receiver<Lanes> for Holding<'_> {
    #[inline(always)]
    fn element<const FMA: bool, const SYMMETRIC: bool>(
        &mut self,
        element: &Element<Lanes>,
        _times: u32,
    ) {
        let sigma = Lanes::all(self.sigma);
        let arm = element.groove.mul_add::<FMA>(sigma, self.moves.arm);
        let elastic = element.load * element.length;
        let elastic = self.regular.choose(elastic, Lanes::ZERO);
        self.elements.push(HeldElement {
            elastic,
            hardening: element
                .depth
                .above(Lanes::ZERO)
                .choose(Lanes::all(self.exponent) / element.depth, Lanes::ZERO),
            share: element.share,
            friction_weight: element.friction_weight,
            slope: element.slope,
            levers: [Lanes::ZERO, arm * sigma],
            place: element.sin * self.radius,
        });
        if self.reads_rolling {
            self.rolling.push(HeldRolling {
                load: element.load,
                depth: element.depth,
                arm,
            });
        }
    }
}

#[cfg(test)]
mod tests;
