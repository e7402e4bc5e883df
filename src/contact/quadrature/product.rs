//! Product integration: weights of the nodes of a rule for friction.

use super::Rule;
use super::moments::Moments;
use super::needle::Needles;
use crate::contact::slip::Slip;
use crate::simd::Number;

/// Places of the finer rule at a time: what their K take stays near.
const PART: usize = 32;

/// Weights of a rule's nodes for integrals over f K, where f is as smooth as the force and K is known but peaks between the
/// nodes: K is replaced by its projection onto the polynomials that the nodes can distinguish,
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
    /// Shares of the nodes in K's needles, where K is that of films.
    pub(super) moments: Option<Moments>,
}

impl Product {
    /// Makes it one for films: of the rule it was made from, whose weight function is (1 + x)^low (1 − x)^high.
    pub(super) fn take_films(&mut self, rule: &Rule, ends: [f64; 2]) {
        self.moments = Some(Moments::new(rule, ends));
    }

    /// The weights from a rule and a finer one for the same weight function ω, which both are divided by.
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
            moments: None,
        }
    }

    /// Λ_j ℓ_i(t_j)/λ_i.
    pub(super) fn share(&self, i: usize, j: usize) -> f64 {
        self.shares[i / 2 * self.fine.len() + j][i % 2]
    }

    /// Adds K̂/K at the nodes of a piece that reaches `half` to both sides of its centre, along which a contact slips, to the first
    /// of `to`: what friction weighs there over the normal force.
    ///
    /// Where K peaks like a needle beside a node, a node may weigh less than nothing, as in any rule for such a K; the sum over
    /// a contact is what is meant, and that takes power out.
    #[inline(always)]
    pub fn weights<T: Number, const FMA: bool>(
        &self,
        slip: &Slip<T>,
        centre: T,
        half: T,
        to: &mut [T],
    ) {
        if self.moments.is_some() {
            self.weighed::<T, FMA, true>(slip, centre, half, to);
        } else {
            self.weighed::<T, FMA, false>(slip, centre, half, to);
        }
    }

    #[inline(always)]
    fn weighed<T: Number, const FMA: bool, const FILM: bool>(
        &self,
        slip: &Slip<T>,
        centre: T,
        half: T,
        to: &mut [T],
    ) {
        let needles = match &self.moments {
            Some(moments) if FILM => {
                let needles = Needles::of::<FMA>(slip, centre, half);
                let powers = moments.of::<T, FMA>(&needles, half);
                Some((moments, needles, powers))
            }
            _ => None,
        };
        for (part, fine) in self.fine.chunks(PART).enumerate() {
            let mut peaks = [half; PART];
            for (k, t) in peaks.iter_mut().zip(fine) {
                let u = half.mul_add::<FMA>(half.same(*t), centre);
                *k = slip.peak::<FMA, FILM>(slip.square::<FMA>(u), u);
                if let Some((_, needles, _)) = &needles {
                    *k = *k - needles.at::<FMA>(half.same(*t));
                }
            }
            let shares = self.shares.chunks_exact(self.fine.len());
            for (pair, (nodes, shares)) in self.nodes.chunks(2).zip(shares).enumerate() {
                let shares = &shares[part * PART..][..fine.len()];
                let sums = shares_of::<T, FMA>(&peaks, shares);
                for ((i, x), sum) in nodes.iter().enumerate().zip(sums) {
                    let u = half.mul_add::<FMA>(half.same(*x), centre);
                    let of = 2 * pair + i;
                    let sum = match &needles {
                        Some((moments, _, powers)) if part == 0 => {
                            sum + moments.at::<T, FMA>(of, powers)
                        }
                        _ => sum,
                    };
                    to[of] += slip.over_peak::<FMA, FILM>(sum, slip.square::<FMA>(u), u);
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
