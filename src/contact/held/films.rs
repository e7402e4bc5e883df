//! Held contacts with films: weights of nodes follow the velocities, and there is rolling resistance.

use super::{AXIAL, Around, HeldContacts, HeldElements, HeldSlope};
use crate::contact::Pair;
use crate::contact::slip::Moves;
use crate::simd::{InstructionSet, Lanes};

/// Step of differences, as a share of the slip at which a film's traction bends.
const STEP: f64 = 3e-3;

impl Pair {
    /// How eight contacts answer to a relative twist in the frame (n_e, t_e, z, about z); see [`Self::add_slope`].
    ///
    /// Under films nodes weigh anew for every twist, since friction peaks where slip vanishes, and slopes are differences of that.
    #[inline(always)]
    pub(crate) fn slopes<const FMA: bool, const N: usize>(
        &self,
        nodes: &mut HeldElements,
        held: &HeldContacts,
        twist: &[Lanes; N],
        reach: f64,
        instructions: InstructionSet,
    ) -> HeldSlope<N> {
        let mut slope = HeldSlope::default();
        if !self.law.traction.is_some_and(|law| law.is_film()) {
            for (element, rolling) in nodes.iter() {
                self.add_slope::<FMA, N>(element, rolling, &held.around, twist, reach, &mut slope);
            }
            return slope;
        }
        if reach != 0.0 {
            for (element, _) in nodes.iter() {
                element.stiffen::<FMA, N>(reach, &mut slope);
            }
        }
        let slow = held.around.oil.bend * STEP;
        for j in 0..N {
            let step = if j < 3 {
                slow
            } else {
                slow / held.whole.section.radius
            };
            for side in [-0.5, 0.5] {
                let mut beside = *twist;
                beside[j] += step * side;
                self.weigh::<FMA, N>(nodes, held, &beside, instructions);
                let mut wrench = [Lanes::ZERO; N];
                for (element, rolling) in nodes.iter() {
                    self.add_wrench::<FMA, N>(element, rolling, &held.around, &beside, &mut wrench);
                }
                for i in 0..N {
                    slope.by[i][j] += wrench[i] * (2.0 * side) / step;
                }
            }
        }
        slope
    }

    /// Gives nodes the weights that a twist asks for.
    #[inline(always)]
    fn weigh<const FMA: bool, const N: usize>(
        &self,
        nodes: &mut HeldElements,
        held: &HeldContacts,
        twist: &[Lanes; N],
        instructions: InstructionSet,
    ) {
        let moves = Moves {
            v_e: twist[0],
            v_z: twist[2],
            slide: twist[1],
            spin: twist[3] * self.race.sigma,
            rolling: held.around.rolling,
            arm: held.arm,
            oil: held.around.oil,
        };
        let HeldElements {
            elements,
            friction_weight,
            ..
        } = nodes;
        let (whole, sigma) = (&held.whole, Lanes::all(self.race.sigma));
        let slip = if N > AXIAL {
            let turning = [twist[AXIAL], twist[AXIAL + 1]];
            self.slip_tilted::<FMA>(sigma, whole, &moves, turning)
        } else {
            self.slip::<FMA>(sigma, whole, &moves)
        };
        let weights = friction_weight.at_nodes(instructions, self, slip.as_ref(), &whole.half);
        for (element, weight) in elements.iter_mut().zip(weights.into_iter().flatten()) {
            element.friction_weight = *weight;
        }
    }

    /// Adds how the rolling resistance of eight contacts answers to a relative twist in that frame: −2 k ∂u/∂w ∂u/∂w of the entrainment
    /// speed u, which is linear in the twist.
    #[inline(always)]
    pub(crate) fn add_rolling_resistance<const N: usize>(
        &self,
        around: &Around,
        to: &mut HeldSlope<N>,
    ) {
        if self.law.film.is_none() {
            return;
        }
        let (sigma, d) = (self.race.sigma, around.distance);
        let across = (around.lever * (2.0 * sigma) + d) / d * (-0.5 * sigma);
        let by = [(1, across), (3, around.lever * (0.5 * sigma))];
        let twice = around.oil.rolling * -2.0;
        for (i, slope) in by {
            for (j, other) in by {
                to.by[i][j] += twice * slope * other;
            }
        }
    }
}
