//! Contacts of a stage with films: weights of nodes follow the velocities, and there is rolling resistance.

// Everything here must be compiled for the instructions of its caller.
#![allow(clippy::inline_always)]

use super::{AXIAL, Around, Slopes, StageContacts, StageElements, StageWrench};
use crate::contact::Pair;
use crate::contact::slip::Moves;
use crate::simd::{InstructionSet, Lanes};

/// Of the slip at which a film's traction bends: the step of differences.
const STEP: f64 = 3e-3;

impl Pair {
    /// What eight contacts do at a relative twist in the frame (n_e, t_e, z, about z), with the slope or without; see
    /// [`Self::force`].
    ///
    /// Under films nodes weigh anew for every twist, since friction peaks where slip vanishes, and slopes are differences of that.
    #[inline(always)]
    pub(crate) fn stage_forces<const FMA: bool, const SLOPE: bool, const N: usize>(
        &self,
        (nodes, held): (&mut StageElements, &StageContacts),
        twist: &[Lanes; N],
        slopes: Slopes,
        instructions: InstructionSet,
    ) -> StageWrench<N> {
        let mut sum = StageWrench::default();
        if !self.law.traction.is_some_and(|law| law.is_film()) {
            for node in nodes.iter() {
                self.force::<FMA, SLOPE, N>(node, &held.around, twist, slopes, &mut sum);
            }
            return sum;
        }
        let slow = held.around.oil.bend * STEP;
        let step = |i: usize| {
            if i < 3 {
                slow
            } else {
                slow / held.whole.section.radius
            }
        };
        // The twist itself first, then beside it to both sides.
        for k in 0..if SLOPE { 2 * N + 1 } else { 1 } {
            let (mut beside, side) = (*twist, if k % 2 == 0 { 0.5 } else { -0.5 });
            let j = k.div_ceil(2);
            if k > 0 {
                beside[j - 1] += step(j - 1) * side;
            }
            self.weigh::<FMA, N>(nodes, held, &beside, instructions);
            let mut found = StageWrench::default();
            for node in nodes.iter() {
                self.force::<FMA, false, N>(
                    node,
                    &held.around,
                    &beside,
                    Slopes::default(),
                    &mut found,
                );
            }
            if k == 0 {
                sum.wrench = found.wrench;
                if SLOPE && slopes.reach != 0.0 {
                    for (element, _) in nodes.iter() {
                        element.stiffen::<FMA, N>(slopes.reach, &mut sum);
                    }
                }
                continue;
            }
            for i in 0..N {
                sum.slope[i][j - 1] += found.wrench[i] * (2.0 * side) / step(j - 1);
            }
        }
        sum
    }

    /// Gives nodes the weights that a twist asks for.
    #[inline(always)]
    fn weigh<const FMA: bool, const N: usize>(
        &self,
        nodes: &mut StageElements,
        held: &StageContacts,
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
        let StageElements {
            elements, rubbing, ..
        } = nodes;
        let whole = &held.whole;
        let weights = if N > AXIAL {
            let turns = (&moves, [twist[AXIAL], twist[AXIAL + 1]]);
            rubbing.at_nodes_turning::<FMA, true>(instructions, self, whole, turns, None)
        } else {
            rubbing.at_nodes::<FMA>(instructions, self, whole, &moves, None)
        };
        for (element, weight) in elements.iter_mut().zip(weights.into_iter().flatten()) {
            element.rubbing = *weight;
        }
    }

    /// Adds the rolling resistance of eight contacts at a relative twist in that frame, with its slope or without: −2 k u ∂u/∂w of
    /// the entrainment speed u, which is linear in the twist.
    #[inline(always)]
    pub(crate) fn rolling_resistance<const SLOPE: bool, const N: usize>(
        &self,
        around: &Around,
        twist: &[Lanes; N],
        to: &mut StageWrench<N>,
    ) {
        if self.law.film.is_none() {
            return;
        }
        let (sigma, d) = (self.race.sigma, around.distance);
        let across = (around.lever * (2.0 * sigma) + d) / d * (-0.5 * sigma);
        let by = [(1, across), (3, around.lever * (0.5 * sigma))];
        let entrainment = twist[1] * by[0].1 + twist[3] * by[1].1;
        let twice = around.oil.rolling * -2.0;
        for (i, slope) in by {
            to.wrench[i] += twice * entrainment * slope;
            if SLOPE {
                for (j, other) in by {
                    to.slope[i][j] += twice * slope * other;
                }
            }
        }
    }
}
