//! Product integration over whole zones, whose halves are mirror images.

use super::moments::Moments;
use super::needle::Needles;
use super::product::Product;
use crate::contact::slip::Slip;
use crate::simd::Number;

/// Places of one half of the finer rule at a time: what their K take stays near.
const PART: usize = 16;

/// A [`Product`] of two rules that are symmetric about the middle: what is asked at t and −t has its even and odd parts in common,
/// and so has what it adds to the nodes at x and −x. A third of the operations are saved.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::contact) struct Halves {
    /// Nodes of the whole rule.
    count: usize,
    /// x_i ≥ 0, from the outermost on.
    nodes: Vec<f64>,
    /// t_j ≥ 0.
    fine: Vec<f64>,
    /// Shares of x_i in K(t_j) + K(−t_j), and in K(t_j) − K(−t_j), for all j, then those of the next node.
    shares: Vec<[f64; 2]>,
    moments: Option<Moments>,
}

impl Halves {
    pub(super) fn new(product: &Product) -> Self {
        let (count, finest) = (product.nodes.len(), product.fine.len());
        let (half, fine_half) = (count.div_ceil(2), finest.div_ceil(2));
        let share = |i: usize, j: usize| {
            let (one, other) = (product.share(i, finest - 1 - j), product.share(i, j));
            // The middle stands for both of its halves.
            let sides = if 2 * j + 1 == finest { 4.0 } else { 2.0 };
            [(one + other) / sides, (one - other) / sides]
        };
        // Nodes ascend: the outermost on the positive side is the last.
        let nodes = (0..half).map(|i| count - 1 - i);
        Self {
            count,
            nodes: nodes.clone().map(|i| product.nodes[i]).collect(),
            fine: (0..fine_half)
                .map(|j| product.fine[finest - 1 - j])
                .collect(),
            shares: nodes
                .flat_map(|i| (0..fine_half).map(move |j| share(i, j)))
                .collect(),
            moments: product.moments.clone(),
        }
    }

    /// Weights as of [`Product::weights`], of a zone about u = 0.
    #[inline(always)]
    pub fn weights<T: Number, const FMA: bool>(
        &self,
        slip: &Slip<T>,
        half: T,
        add: impl FnMut(usize, T),
    ) {
        if self.moments.is_some() {
            half.outlined(
                #[inline(always)]
                || self.weighed::<T, FMA, true>(slip, half, add),
            );
        } else {
            half.outlined(
                #[inline(always)]
                || self.weighed::<T, FMA, false>(slip, half, add),
            );
        }
    }

    #[inline(always)]
    fn weighed<T: Number, const FMA: bool, const FILM: bool>(
        &self,
        slip: &Slip<T>,
        half: T,
        mut add: impl FnMut(usize, T),
    ) {
        let needles = match &self.moments {
            Some(moments) if FILM => {
                let needles = half.outlined(
                    #[inline(always)]
                    || Needles::of::<FMA>(slip, half.same(0.0), half),
                );
                let powers = moments.of::<T, FMA>(&needles, half);
                Some((moments, needles, powers))
            }
            _ => None,
        };
        // Filled in place: as a result of the function apart they would be copied.
        let mut peaks = [[half; 2]; PART];
        for (part, fine) in self.fine.chunks(PART).enumerate() {
            let smooth = needles.as_ref().map(|(_, needles, _)| needles);
            half.outlined(
                #[inline(always)]
                || fill_peaks::<T, FMA, FILM>(slip, smooth, half, fine, &mut peaks),
            );
            let shares = self.shares.chunks_exact(self.fine.len());
            for (i, (x, shares)) in self.nodes.iter().zip(shares).enumerate() {
                let shares = &shares[part * PART..][..fine.len()];
                let (mut even, mut odd) = sums::<T, FMA>(&peaks, shares);
                let u = half * *x;
                let (plus, minus) = slip.squares::<FMA>(u);
                let of = self.count - 1 - i;
                if let Some((moments, _, powers)) = &needles
                    && part == 0
                {
                    let (more_even, more_odd) = moments.halves::<T, FMA>(of, powers);
                    even += more_even;
                    odd += more_odd;
                }
                add(of, slip.over_peak::<FMA, FILM>(even + odd, plus, u));
                if i != of {
                    add(i, slip.over_peak::<FMA, FILM>(even - odd, minus, u));
                }
            }
        }
    }
}

/// Even and odd parts at places of the finer rule, less the needles.
#[inline(always)]
fn fill_peaks<T: Number, const FMA: bool, const FILM: bool>(
    slip: &Slip<T>,
    needles: Option<&Needles<T>>,
    half: T,
    fine: &[f64],
    peaks: &mut [[T; 2]; PART],
) {
    for (peak, t) in peaks.iter_mut().zip(fine) {
        let u = half * *t;
        let (plus, minus) = slip.squares::<FMA>(u);
        let mut sides = [plus, minus];
        for (side, t) in sides.iter_mut().zip([*t, -*t]) {
            *side = slip.peak::<FMA, FILM>(*side, u);
            if let Some(needles) = needles {
                *side = *side - needles.at::<FMA>(half.same(t));
            }
        }
        let [plus, minus] = sides;
        *peak = [plus + minus, plus - minus];
    }
}

/// Even and odd part at a node.
#[inline(always)]
fn sums<T: Number, const FMA: bool>(peaks: &[[T; 2]; PART], shares: &[[f64; 2]]) -> (T, T) {
    let zero = peaks[0][0].same(0.0);
    let (mut even, mut odd) = (zero, zero);
    for ([of_even, of_odd], [in_even, in_odd]) in peaks.iter().zip(shares) {
        even = of_even.mul_add::<FMA>(zero.same(*in_even), even);
        odd = of_odd.mul_add::<FMA>(zero.same(*in_odd), odd);
    }
    (even, odd)
}

#[cfg(test)]
mod tests {
    use super::super::Rules;
    use super::*;

    /// Limits: nodes too few, or too many, weigh the same for friction as for the normal force.
    #[test]
    fn is_for_some_numbers_of_nodes() {
        for (m, weighed) in [(2, false), (3, true), (64, true), (65, false)] {
            let rules = Rules::for_friction(m, 1.5, 8);
            assert_eq!(rules.halves().is_some(), weighed, "{m}");
            assert_eq!(rules.product([true, false]).is_some(), weighed, "{m}");
        }
        assert!(Rules::for_friction(6, 1.5, 0).halves().is_none());
    }

    /// Analytic: the weights are those of the whole rules, for even and odd numbers of nodes and of finer ones.
    #[test]
    fn is_the_whole() {
        let slip = Slip::made([0.03, 40.0, -900.0, 2e4, -5e5], [0.02, -3.0, 60.0]);
        for (m, finer) in [(6, 12), (5, 12), (6, 13), (7, 40)] {
            let rules = Rules::for_friction(m, 10.0 / 9.0, finer);
            let (halves, whole) = (rules.halves().unwrap(), rules.product([true; 2]).unwrap());
            let mut found = vec![[0.0; 2]; m];
            halves.weights::<f64, false>(&slip, 2e-3, |k, weight| found[k][0] += weight);
            let mut weights = vec![0.0; m];
            whole.weights::<f64, false>(&slip, 0.0, 2e-3, &mut weights);
            for (to, weight) in found.iter_mut().zip(weights) {
                to[1] = weight;
            }
            for [a, b] in &found {
                assert!((a - b).abs() < 1e-12, "{m} {finer}: {found:?}");
            }
            assert!(
                found.iter().any(|[a, _]| (a - 1.0).abs() > 1e-3),
                "{found:?}"
            );
        }
    }
}
