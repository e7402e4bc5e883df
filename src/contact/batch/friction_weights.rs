//! Weights of the nodes of eight contacts for friction.

// Into loops that are compiled for the instructions at hand.
#![allow(clippy::inline_always)]

use super::Across;
use crate::contact::kernel::Whole;
use crate::contact::quadrature::Halves;
use crate::contact::slip::{Moves, Slip};
use crate::contact::{Pair, ZoneSlices};
use crate::simd::{InstructionSet, LANES, Lanes, Simd, Vector, Wide};

/// Memory for it.
#[derive(Debug, Clone, Default)]
pub(crate) struct FrictionWeights(Vec<Lanes>);

impl FrictionWeights {
    /// Weights of friction over the normal force at the nodes of whole zones, which have their middle at u = 0 if not elsewhere \[m\];
    /// none where both weigh the same.
    #[inline(always)]
    pub(in crate::contact) fn at_nodes<const FMA: bool>(
        &mut self,
        instructions: InstructionSet,
        pair: &Pair,
        sigma: Lanes,
        whole: &Whole<Lanes>,
        moves: &Moves<Lanes>,
        middle: Option<Lanes>,
    ) -> Option<&[Lanes]> {
        let turning = [Lanes::ZERO; 2];
        self.at_nodes_turning::<FMA, false>(
            instructions,
            (pair, sigma),
            whole,
            (moves, turning),
            middle,
        )
    }

    /// The same, with angular velocities along n_e and t_e where balls before a ring that may tilt have some \[rad/s\].
    #[inline(always)]
    pub(in crate::contact) fn at_nodes_turning<const FMA: bool, const TILTED: bool>(
        &mut self,
        instructions: InstructionSet,
        (pair, sigma): (&Pair, Lanes),
        whole: &Whole<Lanes>,
        (moves, turning): (&Moves<Lanes>, Across),
        middle: Option<Lanes>,
    ) -> Option<&[Lanes]> {
        let ZoneSlices::Fitted(rules) = &pair.slices else {
            return None;
        };
        let halves = rules.halves()?;
        let mut slip = Slip::along::<FMA>(&pair.law, sigma, &whole.section, moves)?;
        if TILTED {
            slip = slip.turning_across::<FMA>(&pair.law, &whole.section, turning);
        }
        if let Some(middle) = middle {
            slip = slip.from::<FMA>(middle);
        }
        self.0.clear();
        self.0.resize(rules.count(), Lanes::ZERO);
        // A program of its own: taken into those that sum forces it would be compiled for each of them.
        instructions.run_wide(Weigh {
            halves,
            slip: &slip,
            half: &whole.half,
            to: &mut self.0,
        });
        Some(&self.0)
    }
}

struct Weigh<'a> {
    halves: &'a Halves,
    slip: &'a Slip<Lanes>,
    half: &'a Lanes,
    to: &'a mut [Lanes],
}

impl Wide for Weigh<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for at in (0..LANES).step_by(Vector::<S>::LANES) {
            let slip = self.slip.register(simd, at);
            let half = Vector::load(simd, &self.half.numbers()[at..]);
            let to = &mut *self.to;
            self.halves.weights::<_, true>(&slip, half, |k, weight| {
                let to = &mut to[k].numbers_mut()[at..];
                (Vector::load(simd, to) + weight).store(to);
            });
        }
    }
}
