//! Weights of the nodes of a rule for the needles of friction, from integrals in closed form.

use std::f64::consts::PI;

use nalgebra::DMatrix;

use super::Rule;
use super::needle::Needles;
use crate::simd::Number;

/// Powers of x whose integrals are kept, at most.
const POWERS: usize = 28;

/// Shares of a rule's nodes in needles: their projection onto polynomials, ∫ ω K Σ p_j(x_i) p_j dx, by the integrals of K times
/// powers of x; p_j are orthonormal under ω. For few nodes these are all polynomials that the nodes can distinguish, as of a
/// [`Product`](super::Product); of many the force has nothing left beyond.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Moments {
    /// Coefficients of ω Σ p_j(x_i) p_j, those of one node after the other.
    coefficients: Vec<f64>,
    /// Number of coefficients of each node.
    count: usize,
}

/// Integrals of needles times powers of x.
pub(super) type Powers<T> = [T; POWERS];

impl Moments {
    /// Degree of the p_j at most: of higher ones sums of powers have no digits left.
    const DEGREE: usize = 15;

    /// The moments of a rule whose ω is (1 + x)^low (1 − x)^high.
    pub fn new(rule: &Rule, [low, high]: [f64; 2]) -> Self {
        let weight = weight([low, high]);
        let at = |x: f64| (1.0 + x).powf(low) * (1.0 - x).powf(high);
        let masses: Vec<(f64, f64)> = rule.iter().map(|(x, v)| (*x, v * at(*x))).collect();
        let polynomials = orthonormal(&masses, Self::DEGREE.min(rule.len() - 1));
        let of = |(x, _): &(f64, f64)| {
            let mut sum = vec![0.0; polynomials.len()];
            for polynomial in &polynomials {
                let there = value(polynomial, *x);
                for (to, c) in sum.iter_mut().zip(polynomial) {
                    *to += there * c;
                }
            }
            times(&weight, &sum)
        };
        let count = weight.len() + polynomials.len() - 1;
        let coefficients = rule.iter().flat_map(of).collect();
        Self {
            coefficients,
            count,
        }
    }

    /// The integrals that it asks for.
    #[inline(always)]
    pub fn of<T: Number, const FMA: bool>(&self, needles: &Needles<T>, like: T) -> Powers<T> {
        let mut powers = [like.same(0.0); POWERS];
        needles.moments::<FMA>(&mut powers[..self.count]);
        powers
    }

    /// The share of a node.
    #[inline(always)]
    pub fn at<T: Number, const FMA: bool>(&self, node: usize, powers: &Powers<T>) -> T {
        let (even, odd) = self.halves::<T, FMA>(node, powers);
        even + odd
    }

    /// Parts of the share by even and by odd powers.
    #[inline(always)]
    pub fn halves<T: Number, const FMA: bool>(&self, node: usize, powers: &Powers<T>) -> (T, T) {
        let mut parts = [powers[0].same(0.0); 2];
        let of = &self.coefficients[node * self.count..][..self.count];
        for (k, (c, power)) in of.iter().zip(powers).enumerate() {
            parts[k % 2] = power.mul_add::<FMA>(power.same(*c), parts[k % 2]);
        }
        (parts[0], parts[1])
    }
}

/// Polynomials up to a degree that are orthonormal under masses at places, by Stieltjes' recurrence.
fn orthonormal(masses: &[(f64, f64)], degree: usize) -> Vec<Vec<f64>> {
    let sum = |f: &dyn Fn(f64) -> f64| masses.iter().map(|(x, m)| m * f(*x)).sum::<f64>();
    let mut found: Vec<Vec<f64>> = vec![vec![1.0 / sum(&|_| 1.0).sqrt()]];
    let mut before = 0.0;
    for j in 0..degree {
        let last = &found[j];
        let middle = sum(&|x| x * value(last, x).powi(2));
        let mut next = times(last, &[-middle, 1.0]);
        if let Some(older) = j.checked_sub(1).map(|k| &found[k]) {
            for (to, c) in next.iter_mut().zip(older) {
                *to -= before * c;
            }
        }
        let size = sum(&|x| value(&next, x).powi(2)).sqrt();
        for c in &mut next {
            *c /= size;
        }
        before = size;
        found.push(next);
    }
    found
}

/// A polynomial at x.
fn value(powers: &[f64], x: f64) -> f64 {
    powers.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Product of two polynomials.
fn times(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; a.len() + b.len() - 1];
    for (i, a) in a.iter().enumerate() {
        for (j, b) in b.iter().enumerate() {
            product[i + j] += a * b;
        }
    }
    product
}

/// (1 + x)^low (1 − x)^high as a polynomial: exact for whole exponents, else fitted.
fn weight(ends: [f64; 2]) -> Vec<f64> {
    /// Powers that stand for what is left of an exponent beside its whole part: to 2e-3 of the weight's largest value.
    const FITTED: usize = 7;
    const PLACES: usize = 400;
    let mut whole = vec![1.0];
    for (exponent, slope) in ends.into_iter().zip([1.0, -1.0]) {
        if exponent >= 1.0 {
            whole = times(&whole, &[1.0, slope]);
        }
    }
    let rest = ends.map(|exponent| exponent - exponent.min(1.0));
    if rest == [0.0; 2] {
        return whole;
    }
    let place = |k: usize| -(PI * (k as f64 + 0.5) / PLACES as f64).cos();
    let size = |x: f64| value(&whole, x);
    let matrix = DMatrix::from_fn(PLACES, FITTED, |i, k| {
        // A whole number below eleven.
        #[allow(clippy::cast_possible_truncation, clippy::cast_possible_wrap)]
        let power = k as i32;
        size(place(i)) * place(i).powi(power)
    });
    let wanted = DMatrix::from_fn(PLACES, 1, |i, _| {
        let x = place(i);
        size(x) * (1.0 + x).powf(rest[0]) * (1.0 - x).powf(rest[1])
    });
    let fitted = matrix.svd(true, true).solve(&wanted, 1e-12);
    let fitted = fitted.expect("singular vectors are there");
    times(&whole, fitted.as_slice())
}

#[cfg(test)]
mod tests {
    use super::super::needle::polynomial;
    use super::super::{Rules, jacobi};
    use crate::contact::slip::Slip;

    /// K of a slip at x.
    fn film(along: &[f64; 5], across: &[f64; 3], bend: f64, x: f64) -> f64 {
        let (u, _) = polynomial::<f64, false>(along, x);
        let [m_0, m_1, m_2] = across;
        let m = m_0 + x * (m_1 + x * m_2);
        1.0 / (bend + (u * u + m * m + bend * bend).sqrt())
    }

    /// ∫ over −1 … 1, finer and finer towards places.
    fn integral(places: &[f64], f: impl Fn(f64) -> f64) -> f64 {
        let rule = jacobi(40, 0.0, 0.0, 2.0);
        let mut ends: Vec<f64> = places.iter().copied().filter(|x| x.abs() < 1.0).collect();
        ends.extend([-1.0, 1.0]);
        ends.sort_by(f64::total_cmp);
        let middles: Vec<f64> = ends.windows(2).map(|w| f64::midpoint(w[0], w[1])).collect();
        let mut sum = 0.0;
        for (pair, middle) in ends.windows(2).zip(middles) {
            for (from, to) in [(pair[0], middle), (pair[1], middle)] {
                for k in 0..30 {
                    let [a, b] = [k, k + 1].map(|k| if k == 30 { 0.0 } else { 0.5_f64.powi(k) });
                    let [a, b] = [a, b].map(|s| from + (to - from) * s);
                    let (mid, half) = (f64::midpoint(a, b), (a - b).abs() / 2.0);
                    sum += rule
                        .iter()
                        .map(|(x, w)| half * w * f(mid + half * x))
                        .sum::<f64>();
                }
            }
        }
        sum
    }

    /// Analytic: friction of films a thousandth to a third of what slip sweeps over a zone, along and across the race, against a rule
    /// refined where slip vanishes. Six nodes without needles miss it by 3 %.
    #[test]
    fn six_nodes_resolve_films() {
        let slips = [
            [0.05, 0.7, 0.05, 0.01, -0.01],
            [-0.3, -0.4, 0.1, 0.0, 0.005],
            [-0.06, 0.02, 0.12, 0.001, 0.002],
            [0.01, 0.0, 0.12, 0.0, 0.0],
            [0.4, 0.01, -0.02, 0.0, 0.0],
            [-0.002, 0.0, 0.15, 0.0, 0.0],
        ];
        let across = [0.002, -0.003, 0.001];
        for exponent in [1.0, 10.0 / 9.0] {
            let rules = Rules::for_films(6, exponent);
            let rule = rules.on([true; 2]);
            for along in slips {
                for bend in [0.001, 0.004, 0.03, 0.3] {
                    let half = 1e-3;
                    let scaled = |k: usize| along[k] / half_power(half, k);
                    let slip = Slip::of_film(
                        std::array::from_fn(scaled),
                        std::array::from_fn(|k| across[k] / half_power(half, k)),
                        bend,
                    );
                    let mut weights = [0.0; 6];
                    let halves = rules.halves().unwrap();
                    halves.weights::<f64, false>(&slip, half, |k, weight| weights[k] += weight);
                    let ut = |x: f64| polynomial::<f64, false>(&along, x).0;
                    let um = |x: f64| across[0] + x * (across[1] + x * across[2]);
                    let k = |x: f64| film(&along, &across, bend, x);
                    let force = |x: f64| (1.0 - x * x).powf(exponent) * (1.0 + 0.2 * x);
                    let zeros: Vec<f64> = (-2000..2000)
                        .map(|i| f64::from(i) / 2000.0)
                        .filter(|x| ut(*x) * ut(x + 5e-4) <= 0.0)
                        .collect();
                    let all = integral(&[], force);
                    for slip in [&ut as &dyn Fn(f64) -> f64, &um] {
                        let found: f64 = rule
                            .iter()
                            .zip(weights)
                            .map(|((x, w), r)| w * force(*x) * r * k(*x) * slip(*x))
                            .sum();
                        let truth = integral(&zeros, |x| force(x) * k(x) * slip(x));
                        let error = (found - truth).abs() / all;
                        assert!(error < 5e-3, "{exponent} {along:?} {bend}: {error:e}");
                    }
                }
            }
        }
    }

    fn half_power(half: f64, k: usize) -> f64 {
        half.powi(i32::try_from(k).unwrap())
    }
}
