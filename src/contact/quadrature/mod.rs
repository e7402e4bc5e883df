//! Cutting of a ball: fixed slices of equal width, or quadrature nodes fitted to the zone of contact, and their weights for
//! friction.

mod halves;
mod moments;
mod needle;
mod product;

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::{DMatrix, SymmetricEigen};

pub(super) use halves::Halves;
pub(super) use product::Product;

/// Fixed slices or fitted nodes.
#[derive(Debug, Clone, PartialEq)]
pub enum ZoneSlices {
    /// n slices of width D/n over the ball, at fixed places in it.
    Fixed(usize),
    /// Nodes on every smooth piece of the zone.
    Fitted(Rules),
}

impl ZoneSlices {
    /// Slices of a ball, or nodes of a whole zone.
    // At most thousands.
    #[allow(clippy::cast_possible_truncation)]
    pub fn count(&self) -> u32 {
        match self {
            Self::Fixed(count) => *count as u32,
            Self::Fitted(rules) => rules.count() as u32,
        }
    }
}

/// Rules that have been asked for, by nodes, exponent and how much finer friction is resolved: every race of every scene needs the same few, and their
/// eigenvalues would be most of what it costs to compile a scene.
static KNOWN: Mutex<BTreeMap<(usize, u64, usize, bool), Rules>> = Mutex::new(BTreeMap::new());

/// Quadrature rules on −1 … 1 for forces that vanish at some ends like a power of the penetration.
///
/// Nodes and weights (x, w) are such that ∫ f dx ≈ Σ w f(x) where f is smooth times (1 ± x)^β at the ends
/// named; the weight function is divided out, so one sum serves all.
#[derive(Debug, Clone, PartialEq)]
pub struct Rules {
    both: Rule,
    low: Rule,
    high: Rule,
    neither: Rule,
    /// Weights of the nodes for friction, if there are [`LEAST`] to [`MOST`].
    products: Option<Arc<[Product; 4]>>,
    halves: Option<Arc<Halves>>,
}

/// Fewest nodes of a piece that weigh for friction by themselves: a straight line through two says too little of the force.
const LEAST: usize = 3;
/// Largest number of nodes that are weighed for friction: more do without.
pub(super) const MOST: usize = 64;

/// Nodes beyond those of a rule by which friction is resolved, where it is not known how steep it is. 1/√(u² + w²) has poles at
/// ± i η with η about 0.2 of half a zone where a loaded contact spins; 26 nodes meet these to e^(−2 · 26 η).
const FINER: usize = 20;

/// Nodes and weights.
type Rule = Vec<(f64, f64)>;

impl Rules {
    /// m nodes a piece for a law of exponent β, 2 m on one where the force vanishes at neither end.
    ///
    /// ```
    /// use ballrace::contact::Rules;
    /// // ∫ (1 − x²)^{10/9} dx = √π Γ(19/9) / Γ(47/18).
    /// let rules = Rules::new(4, 10.0 / 9.0);
    /// let f = |x: f64| (1.0 - x * x).powf(10.0 / 9.0);
    /// let sum: f64 = rules.on([true, true]).iter().map(|(x, w)| w * f(*x)).sum();
    /// assert!((sum - 1.293_623_271_07).abs() < 1e-11, "{sum}");
    /// ```
    pub fn new(m: usize, exponent: f64) -> Self {
        Self::for_friction(m, exponent, FINER)
    }

    /// The same with weights for friction from rules of so many nodes more, or for none without such weights.
    pub fn for_friction(m: usize, exponent: f64, finer: usize) -> Self {
        Self::known(m, exponent, finer, false)
    }

    /// The same for the friction of films, which peaks where slip vanishes.
    pub(crate) fn for_films(m: usize, exponent: f64) -> Self {
        /// Number of nodes more that do beside needles in closed form: the wheel bearing's signal in oil errs over 6 ms by 0.7 % with 20 and with 8,
        /// by 0.9 % with 4, by 1.9 % with none.
        const BESIDE: usize = 4;
        Self::known(m, exponent, BESIDE, true)
    }

    fn known(m: usize, exponent: f64, finer: usize, films: bool) -> Self {
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        known
            .entry((m, exponent.to_bits(), finer, films))
            .or_insert_with(|| Self::compute(m, exponent, finer, films))
            .clone()
    }

    fn compute(m: usize, exponent: f64, finer: usize, films: bool) -> Self {
        let rules = Self::nodes(m, exponent);
        let products = ((LEAST..=MOST).contains(&m) && finer > 0).then(|| {
            let mut products = products(&rules, finer, exponent);
            if films {
                let low = [exponent, exponent, 0.0, 0.0];
                let high = [exponent, 0.0, exponent, 0.0];
                for (k, product) in products.iter_mut().enumerate() {
                    product.take_films(&rules[k], [low[k], high[k]]);
                }
            }
            Arc::new(products)
        });
        let halves = products
            .as_deref()
            .map(|[both, ..]| Arc::new(Halves::new(both)));
        let [both, low, high, neither] = rules;
        Self {
            both,
            low,
            high,
            neither,
            products,
            halves,
        }
    }

    /// The rules of m nodes for forces that vanish at both ends, the low one, the high one and none.
    fn nodes(m: usize, exponent: f64) -> [Rule; 4] {
        let one_sided = jacobi(
            m,
            0.0,
            exponent,
            2_f64.powf(exponent + 1.0) / (exponent + 1.0),
        );
        let high = one_sided.iter().rev().map(|(x, w)| (-x, *w)).collect();
        [
            jacobi(m, exponent, exponent, both_sided_mass(exponent)),
            one_sided,
            high,
            // Inside a defect the forces of its elements vanish at ends of their own, with no weight for them.
            gauss(2 * m),
        ]
    }

    /// The rule for a piece whose force vanishes at its low end, its high end, both or neither.
    pub fn on(&self, sealed: [bool; 2]) -> &[(f64, f64)] {
        match sealed {
            [true, true] => &self.both,
            [true, false] => &self.low,
            [false, true] => &self.high,
            [false, false] => &self.neither,
        }
    }

    /// Weights for friction of the nodes of that rule.
    pub(super) fn product(&self, sealed: [bool; 2]) -> Option<&Product> {
        let [both, low, high, neither] = self.products.as_deref()?;
        Some(match sealed {
            [true, true] => both,
            [true, false] => low,
            [false, true] => high,
            [false, false] => neither,
        })
    }

    /// Weights of the nodes of a whole zone.
    pub(super) fn halves(&self) -> Option<&Halves> {
        self.halves.as_deref()
    }

    /// Nodes of a whole zone.
    pub fn count(&self) -> usize {
        self.both.len()
    }
}

/// Weights for friction of the nodes of all rules, by rules of so many nodes more.
fn products(rules: &[Rule; 4], more: usize, exponent: f64) -> [Product; 4] {
    let [both, low, high, neither] = rules;
    let finer = Rules::nodes(both.len() + more, exponent);
    let finer_inside = gauss(neither.len() + more);
    let (rising, falling) = (
        |x: f64| (1.0 + x).powf(exponent),
        |x: f64| (1.0 - x).powf(exponent),
    );
    [
        Product::new(both, &finer[0], |x| rising(x) * falling(x)),
        Product::new(low, &finer[1], rising),
        Product::new(high, &finer[2], falling),
        Product::new(neither, &finer_inside, |_| 1.0),
    ]
}

/// The rule of m nodes for smooth forces.
fn gauss(m: usize) -> Rule {
    jacobi(m, 0.0, 0.0, 2.0)
}

/// ∫ (1 − x²)^β dx = 2 ∫₀¹ … by the one-sided rule, on which (1 + x)^β is smooth.
fn both_sided_mass(exponent: f64) -> f64 {
    let mass = 2_f64.powf(exponent + 1.0) / (exponent + 1.0);
    let half: f64 = jacobi(24, 0.0, exponent, mass)
        .into_iter()
        // y = −1 … 1 lies over x = −1 … 0, x = (y − 1)/2: (1 + x) = (1 + y)/2, (1 − x) = (3 − y)/2.
        .map(|(y, w)| {
            0.5 * w * f64::midpoint(1.0, y).powf(exponent) * ((3.0 - y) / 2.0).powf(exponent)
        })
        .sum();
    2.0 * half
}

/// Gauss–Jacobi nodes for the weight (1 − x)^α (1 + x)^β of the given mass, divided by that weight.
///
/// Golub and Welsch: the eigenvalues of the recurrence's Jacobi matrix (Math. Comp. 23 (1969) 221).
fn jacobi(m: usize, alpha: f64, beta: f64, mass: f64) -> Vec<(f64, f64)> {
    let sum = alpha + beta;
    let matrix = DMatrix::from_fn(m, m, |i, j| {
        let k = i.max(j) as f64;
        let c = 2.0 * k + sum;
        if i == j {
            if alpha == beta {
                0.0
            } else {
                (beta * beta - alpha * alpha) / (c * (c + 2.0))
            }
        } else if i.abs_diff(j) == 1 {
            // At k = 1 the factors k + α + β and c − 1 are the same.
            let shared = if i.max(j) == 1 {
                1.0
            } else {
                (k + sum) / (c - 1.0)
            };
            (4.0 * k * (k + alpha) * (k + beta) * shared / (c * c * (c + 1.0))).sqrt()
        } else {
            0.0
        }
    });
    let eigen = SymmetricEigen::new(matrix);
    let mut nodes: Vec<(f64, f64)> = eigen
        .eigenvalues
        .iter()
        .zip(eigen.eigenvectors.column_iter())
        .map(|(&x, v)| {
            let weight = (1.0 - x).powf(alpha) * (1.0 + x).powf(beta);
            (x, mass * v[0] * v[0] / weight)
        })
        .collect();
    nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
    nodes
}
