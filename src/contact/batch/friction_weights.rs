//! Weights of the nodes of eight contacts for friction.

use super::Across;
use crate::contact::kernel::Whole;
use crate::contact::quadrature::Halves;
use crate::contact::slip::{Moves, Slip};
use crate::contact::{Pair, ZoneSlices};
use crate::simd::{InstructionSet, LANES, Lanes, Simd, Vector, Wide};

/// Memory for it.
#[derive(Debug, Clone, Default)]
pub(crate) struct FrictionWeights(Vec<Lanes>);

impl Pair {
    /// Slip along the zones of eight contacts, of which nodes' weights are made; none where friction weighs as the normal force does.
    #[inline(always)]
    pub(in crate::contact) fn slip<const FMA: bool>(
        &self,
        sigma: Lanes,
        whole: &Whole<Lanes>,
        moves: &Moves<Lanes>,
    ) -> Option<Slip<Lanes>> {
        self.halves()?;
        Slip::along::<FMA>(&self.law, sigma, &whole.section, moves)
    }

    /// Slip of balls before a ring that may tilt, with angular velocities along n_e and t_e \[rad/s\].
    #[inline(always)]
    pub(in crate::contact) fn slip_tilted<const FMA: bool>(
        &self,
        sigma: Lanes,
        whole: &Whole<Lanes>,
        moves: &Moves<Lanes>,
        turning: Across,
    ) -> Option<Slip<Lanes>> {
        let slip = self.slip::<FMA>(sigma, whole, moves)?;
        Some(slip.turning_across::<FMA>(&self.law, &whole.section, turning))
    }

    fn halves(&self) -> Option<&Halves> {
        match &self.slices {
            ZoneSlices::Fitted(rules) => rules.halves(),
            ZoneSlices::Fixed(_) => None,
        }
    }
}

impl FrictionWeights {
    /// Weights of friction over the normal force at the nodes of whole zones, which reach `half` to both sides of u = 0 \[m\]; none
    /// without a slip.
    #[inline(always)]
    pub(in crate::contact) fn at_nodes(
        &mut self,
        instructions: InstructionSet,
        pair: &Pair,
        slip: Option<&Slip<Lanes>>,
        half: &Lanes,
    ) -> Option<&[Lanes]> {
        let (slip, halves) = (slip?, pair.halves()?);
        self.0.clear();
        self.0.resize(pair.slices.count() as usize, Lanes::ZERO);
        // A program of its own: taken into those that sum forces it would be compiled for each of them.
        instructions.run_wide(Weigh {
            halves,
            slip,
            half,
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
