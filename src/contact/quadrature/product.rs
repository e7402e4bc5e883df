//! Product integration: what the nodes of a rule weigh for friction.

// Into loops that are compiled for the instructions at hand.
#![allow(clippy::inline_always)]

use super::Rule;
use crate::contact::slip::Slip;
use crate::simd::Number;

/// Places of the finer rule at a time: what their K take stays near.
const PART: usize = 32;

/// Weights of a rule's nodes for integrals over f K, where f is as smooth as the force and K is known but peaks between the
/// nodes: K is replaced by its projection onto the polynomials that the nodes can tell apart,
///
/// ```text
/// ∫ ω f K dx ≈ Σ λ_i f(x_i) K̂(x_i),   K̂(x_i) = ∫ ω K ℓ_i dx / λ_i ≈ Σ_j (Λ_j ℓ_i(t_j)/λ_i) K(t_j)
/// ```
///
/// | symbol | meaning |
/// |---|---|
/// | ω | weight function of the rule |
/// | x_i, λ_i | its Gaussian nodes and weights |
/// | ℓ_i | Lagrange's polynomials of these nodes |
/// | t_j, Λ_j | nodes and weights of a finer rule for the same ω |
///
/// The error is ∫ ω (f − f̂)(K − K̂) dx: what is left of both after the polynomials of the nodes' degree. Friction
/// μ F u/√(u² + w²) takes for K the rest of it that a run of a contact knows in advance ([`Slip`]): along the zone F u is
/// nearly a polynomial, K is not. Six nodes then miss friction by 1e-5 of μ ∫F where they missed it by 5e-3, and where u
/// vanishes twice or curves they need no other formula. Places of nodes and the normal force are what they were.
///
/// Source: I. H. Sloan, W. E. Smith, Product-integration with the Clenshaw–Curtis and related points, Numer. Math. 30 (1978)
/// 415.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::contact) struct Product {
    /// x_i.
    pub(super) nodes: Vec<f64>,
    /// t_j.
    pub(super) fine: Vec<f64>,
    /// Λ_j ℓ_i(t_j)/λ_i, of two nodes i and i + 1 for all j, then of the next two; 0 for a last one that is not there.
    shares: Vec<[f64; 2]>,
}

impl Product {
    /// From a rule and a finer one for the same weight function ω, which both are divided by.
    pub(super) fn new(rule: &Rule, finer: &Rule, weight: impl Fn(f64) -> f64) -> Self {
        let lagrange = |i: usize, t: f64| -> f64 {
            let others = rule.iter().enumerate().filter(|(k, _)| *k != i);
            others
                .map(|(_, (x, _))| (t - x) / (rule[i].0 - x))
                .product()
        };
        let share = |i: usize, (t, w): (f64, f64)| {
            let of = |(x, v): &(f64, f64)| w * weight(t) * lagrange(i, t) / (v * weight(*x));
            rule.get(i).map_or(0.0, of)
        };
        let pairs = (0..rule.len()).step_by(2);
        let shares = pairs.flat_map(|i| {
            finer
                .iter()
                .map(move |fine| [i, i + 1].map(|i| share(i, *fine)))
        });
        Self {
            nodes: rule.iter().map(|(x, _)| *x).collect(),
            fine: finer.iter().map(|(t, _)| *t).collect(),
            shares: shares.collect(),
        }
    }

    /// Λ_j ℓ_i(t_j)/λ_i.
    pub(super) fn share(&self, i: usize, j: usize) -> f64 {
        self.shares[i / 2 * self.fine.len() + j][i % 2]
    }

    /// Adds up K̂/K at the nodes of a piece that reaches `half` to both sides of its centre, along which a contact slips: what
    /// friction weighs there over the normal force. `add` takes parts of it by the nodes' numbers.
    ///
    /// Where K peaks like a needle beside a node, a node may weigh less than nothing, as in any rule for such a K; the sum over
    /// a contact is what is meant, and that takes power out.
    #[inline(always)]
    pub fn weights<T: Number, const FMA: bool>(
        &self,
        slip: &Slip<T>,
        (centre, half): (T, T),
        mut add: impl FnMut(usize, T),
    ) {
        for (part, fine) in self.fine.chunks(PART).enumerate() {
            let mut peaks = [half; PART];
            for (k, t) in peaks.iter_mut().zip(fine) {
                let u = half.mul_add::<FMA>(half.same(*t), centre);
                *k = inverse_root::<T, FMA>(slip.square::<FMA>(u));
            }
            let shares = self.shares.chunks_exact(self.fine.len());
            for (pair, (nodes, shares)) in self.nodes.chunks(2).zip(shares).enumerate() {
                let shares = &shares[part * PART..][..fine.len()];
                let sums = shares_of::<T, FMA>(&peaks, shares);
                for ((i, x), sum) in nodes.iter().enumerate().zip(sums) {
                    let u = half.mul_add::<FMA>(half.same(*x), centre);
                    let square = slip.square::<FMA>(u);
                    add(2 * pair + i, sum * square * inverse_root::<T, FMA>(square));
                }
            }
        }
    }
}

/// Shares of two nodes in K at places of the finer rule.
#[inline(always)]
fn shares_of<T: Number, const FMA: bool>(peaks: &[T; PART], shares: &[[f64; 2]]) -> [T; 2] {
    let zero = peaks[0].same(0.0);
    let mut sums = [zero; 2];
    for (k, [first, second]) in peaks.iter().zip(shares) {
        sums[0] = k.mul_add::<FMA>(zero.same(*first), sums[0]);
        sums[1] = k.mul_add::<FMA>(zero.same(*second), sums[1]);
    }
    sums
}

/// Series of (1 − e)^(−1/2) for what the guess at an inverse root leaves, −0.0692 < e < 0.0676: interpolated at Chebyshev's
/// points, to 7.5e-10.
const INVERSE_ROOT: [f64; 6] = [
    1.000_000_000_716_994_2,
    0.499_999_996_354_897_84,
    0.374_997_231_592_550_9,
    0.312_502_354_991_956_44,
    0.275_020_204_463_988_67,
    0.246_507_976_897_711_76,
];

/// 1/√x to 1e-9 for normal x > 0, without the division and the root that take a vector's instructions ten times as long:
/// y (1 − e)^(−1/2) with a guess y and e = 1 − x y².
#[inline(always)]
pub(super) fn inverse_root<T: Number, const FMA: bool>(x: T) -> T {
    let y = x.guess_inverse_root();
    let e = (-(x * y)).mul_add::<FMA>(y, x.same(1.0));
    let [c_0, c_1, c_2, c_3, c_4, c_5] = INVERSE_ROOT;
    let sum = (e * c_5 + c_4).mul_add::<FMA>(e, x.same(c_3));
    let sum = sum
        .mul_add::<FMA>(e, x.same(c_2))
        .mul_add::<FMA>(e, x.same(c_1));
    sum.mul_add::<FMA>(e, x.same(c_0)) * y
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Analytic: x y² is 1, over all squares of speeds that occur and far beyond.
    #[test]
    fn is_the_inverse_root() {
        for k in 0..100_000 {
            let x = 10_f64.powf(f64::from(k) / 100_000.0 * 60.0 - 30.0);
            for y in [inverse_root::<_, true>(x), inverse_root::<_, false>(x)] {
                let error = (y * x.sqrt() - 1.0).abs();
                assert!(error < 1e-9, "{x}: {error}");
            }
        }
        assert!(inverse_root::<_, false>(f64::NAN).is_nan());
    }
}
