//! Forces of eight contacts at once with a ring that may tilt, in whose frame balls turn across its axis.
//!
//! To the sums of contacts of parallel rings ([`Sums`]) this adds the slip of that rotation, and the moments of friction across the axis
//! ([*Rings that tilt*](crate::equations#rings-that-tilt-balls-that-spin-freely)).
//! It is separate code, since in that of parallel rings the compiler would no longer fill whole registers.

use super::{Across, BatchForces, EightContacts, FrictionWeights, Place, RingLanes, Sums};
use crate::contact::kernel::{self, Element, Receiver};
use crate::contact::{Motion, Pair};
use crate::simd::{InstructionSet, Lanes, Mask};

/// Sums over the elements of contacts whose balls turn across the ring's axis.
pub(super) struct SpatialSums<'a> {
    pub sums: Sums<'a>,
    /// Angular velocities along n_e and t_e \[rad/s\].
    pub turning: Across,
    /// Moments of friction about the balls along n_e and t_e \[N m\].
    pub moments: Across,
}

impl Pair {
    /// Forces as by [`Pair::forces`], of eight contacts in the frame of a ring that may tilt, where it stands still and balls turn across its axis
    /// so fast \[rad/s\]. Moments across the axis are returned as well, on balls and on the ring about the origin \[N m\].
    #[inline(always)]
    pub(crate) fn forces_tilted<const FMA: bool>(
        &self,
        eight: &EightContacts,
        turning: Across,
        ring: &Motion,
        instructions: InstructionSet,
        friction_weight: &mut FrictionWeights,
    ) -> (BatchForces, [Across; 2]) {
        let ring = &RingLanes::of(ring, self.race.sigma);
        let (whole, moves, place) = self.place::<FMA, false>(eight, ring, Mask::default());
        let turning = place.along_contact(turning, self.race.sigma);
        let mut sums = SpatialSums {
            sums: Sums::new(self, ring.sigma, &whole, &moves),
            turning,
            moments: [Lanes::ZERO; 2],
        };
        let slip = self.slip_tilted::<FMA>(ring.sigma, &whole, &moves, turning);
        let friction_weight =
            friction_weight.at_nodes(instructions, self, slip.as_ref(), &whole.half);
        let slices = &self.slices;
        kernel::elements::<_, FMA, false>(&self.law, slices, friction_weight, &whole, &mut sums);
        sums.on_bodies(eight, &place)
    }
}

impl Place {
    /// Components along n_e and t_e of vectors across the axis, given along x and y.
    #[inline(always)]
    pub fn along_contact(&self, [x, y]: Across, sigma: f64) -> Across {
        let n = self.n;
        [(x * n.0 + y * n.1) * sigma, (y * n.0 - x * n.1) * sigma]
    }
}

impl SpatialSums<'_> {
    /// Forces on balls and ring, with the moments about x and y.
    #[inline(always)]
    pub fn on_bodies(&self, eight: &EightContacts, place: &Place) -> (BatchForces, [Across; 2]) {
        let forces = self.sums.on_bodies(place);
        let (n, [about_n, about_t], sigma) = (place.n, self.moments, self.sums.sigma);
        let ball = [
            (n.0 * about_n - n.1 * about_t) * sigma,
            (n.1 * about_n + n.0 * about_t) * sigma,
        ];
        let ([x, y, z], [force_x, force_y, force_z, _]) = (eight.q, forces.ball);
        let ring = [
            z * force_y - y * force_z - ball[0],
            x * force_z - z * force_x - ball[1],
        ];
        (forces, [ball, ring])
    }
}

impl Receiver<Lanes> for SpatialSums<'_> {
    #[inline(always)]
    fn element<const FMA: bool, const SYMMETRIC: bool>(
        &mut self,
        element: &Element<Lanes>,
        times: u32,
    ) {
        let mut state = self.sums.state::<FMA>(element);
        let (h, zeta) = (
            state.arm * self.sums.sigma,
            element.sin * self.sums.radii[0],
        );
        let [along, across] = kernel::slip_of_turning::<_, FMA>(self.turning, h, zeta, state.slope);
        state.velocity[1] += along;
        let law = self.sums.law;
        let force = kernel::force::<_, FMA, SYMMETRIC, false, true>(law, &state, across);
        self.sums.add::<SYMMETRIC>(&force, state.arm, times);
        if law.traction.is_some() {
            let ([about_n, about_t], friction) = (self.moments, force.friction);
            self.moments = [
                about_n - zeta * friction[1],
                about_t + (zeta * friction[0] - h * friction[2]),
            ];
        }
    }
}
