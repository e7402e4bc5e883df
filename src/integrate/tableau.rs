//! Runge–Kutta methods as data.

use super::combine::MAX_TERMS;
use super::dense::MAX_STAGES;

/// The coefficients of an explicit embedded Runge–Kutta pair.
///
/// A method is nothing but this: adding one is adding a constant. A row of `a`,
/// `b` or `b_err` may hold at most eight nonzero entries (`combine.rs`), and a
/// method may have at most sixteen stages (`dense.rs`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tableau {
    /// The method's name, for messages and reports.
    pub name: &'static str,
    /// Order of the solution that is carried on (`b`).
    pub order: u32,
    /// Order of the embedded solution (`b − b_err`).
    pub error_order: u32,
    /// Number of stages, counting the last one of an FSAL method.
    pub stages: usize,
    /// Stage times as shares of the step; `stages` entries.
    pub c: &'static [f64],
    /// Stage coefficients; row `i` holds `i` entries, `stages` rows.
    pub a: &'static [&'static [f64]],
    /// Solution weights; `stages` entries.
    pub b: &'static [f64],
    /// Weights of the error estimate, `b − b̂`; `stages` entries.
    pub b_err: &'static [f64],
    /// "First same as last": the last stage is the derivative at the new state.
    /// Without it one more evaluation per step supplies that derivative.
    pub fsal: bool,
    /// Dense output, one row a derivative (`stages`, one more without FSAL): `y(t0 + θh) = y0 + h Σ bᵢ(θ) kᵢ` with
    /// `bᵢ(θ) = d₀θ + d₁θ² + d₂θ³ + d₃θ⁴`.
    pub dense: &'static [[f64; 4]],
    /// End of the region of absolute stability on the negative real axis,
    /// as a positive number. A stiffness quotient near it means that stability,
    /// not accuracy, holds the step. The quotient compares the last two states
    /// evaluated and is meaningful where both stand at the end of the step.
    pub stability_limit: f64,
}

impl Tableau {
    /// Whether all coefficients are there, and no sum has more of them than there is room for.
    pub(super) fn is_whole(&self) -> bool {
        let stages = self.stages;
        let derivatives = stages + usize::from(!self.fsal);
        let lengths = [self.c, self.b, self.b_err].map(<[f64]>::len);
        (1..=MAX_STAGES).contains(&derivatives)
            && lengths == [stages; 3]
            && self.a.len() == stages
            && self.dense.len() == derivatives
            && self.a.iter().enumerate().all(|(i, row)| row.len() == i)
            && self
                .a
                .iter()
                .copied()
                .chain([self.b, self.b_err])
                .all(|sum| sum.iter().filter(|weight| **weight != 0.0).count() <= MAX_TERMS)
    }
}

/// Dense output by the cubic through both ends and their slopes, of order three: `N` weights of the
/// solution, `M` derivatives, of which the last is at the new state.
pub(super) const fn hermite<const N: usize, const M: usize>(b: &[f64; N]) -> [[f64; 4]; M] {
    let mut dense = [[0.0; 4]; M];
    let mut i = 0;
    while i < N {
        dense[i] = [0.0, 3.0 * b[i], -2.0 * b[i], 0.0];
        i += 1;
    }
    dense[0] = [1.0, dense[0][1] - 2.0, dense[0][2] + 1.0, 0.0];
    dense[M - 1][1] -= 1.0;
    dense[M - 1][2] += 1.0;
    dense
}

/// Dormand–Prince 5(4), seven stages, FSAL, quartic dense output.
///
/// Source: Dormand & Prince (1980), J. Comp. Appl. Math. 6, 19–26. The dense
/// output is Shampine's (1986), Math. Comp. 46, 135–150: it is of order four
/// and continuously differentiable from step to step.
pub const DORMAND_PRINCE: Tableau = Tableau {
    name: "Dormand-Prince 5(4)",
    order: 5,
    error_order: 4,
    stages: 7,
    c: &[0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0],
    a: &[
        &[],
        &[1.0 / 5.0],
        &[3.0 / 40.0, 9.0 / 40.0],
        &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
        &[
            19372.0 / 6561.0,
            -25360.0 / 2187.0,
            64448.0 / 6561.0,
            -212.0 / 729.0,
        ],
        &[
            9017.0 / 3168.0,
            -355.0 / 33.0,
            46732.0 / 5247.0,
            49.0 / 176.0,
            -5103.0 / 18656.0,
        ],
        &[
            35.0 / 384.0,
            0.0,
            500.0 / 1113.0,
            125.0 / 192.0,
            -2187.0 / 6784.0,
            11.0 / 84.0,
        ],
    ],
    b: &[
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
        0.0,
    ],
    b_err: &[
        71.0 / 57600.0,
        0.0,
        -71.0 / 16695.0,
        71.0 / 1920.0,
        -17253.0 / 339_200.0,
        22.0 / 525.0,
        -1.0 / 40.0,
    ],
    fsal: true,
    dense: &[
        [
            1.0,
            -8_048_581_381.0 / 2_820_520_608.0,
            8_663_915_743.0 / 2_820_520_608.0,
            -12_715_105_075.0 / 11_282_082_432.0,
        ],
        [0.0; 4],
        [
            0.0,
            131_558_114_200.0 / 32_700_410_799.0,
            -68_118_460_800.0 / 10_900_136_933.0,
            87_487_479_700.0 / 32_700_410_799.0,
        ],
        [
            0.0,
            -1_754_552_775.0 / 470_086_768.0,
            14_199_869_525.0 / 1_410_260_304.0,
            -10_690_763_975.0 / 1_880_347_072.0,
        ],
        [
            0.0,
            127_303_824_393.0 / 49_829_197_408.0,
            -318_862_633_887.0 / 49_829_197_408.0,
            701_980_252_875.0 / 199_316_789_632.0,
        ],
        [
            0.0,
            -282_668_133.0 / 205_662_961.0,
            2_019_193_451.0 / 616_988_883.0,
            -1_453_857_185.0 / 822_651_844.0,
        ],
        [
            0.0,
            40_617_522.0 / 29_380_423.0,
            -110_615_467.0 / 29_380_423.0,
            69_997_945.0 / 29_380_423.0,
        ],
    ],
    stability_limit: 3.3066,
};

/// Every table checks itself against the order conditions, which are exact.
#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrate::VERNER;

    const ALL: [Tableau; 2] = [DORMAND_PRINCE, VERNER];

    fn dot(u: &[f64], v: &[f64]) -> f64 {
        u.iter().zip(v).map(|(x, y)| x * y).sum()
    }

    fn close(x: f64, y: f64, what: &str) {
        assert!((x - y).abs() < 1e-13, "{what}: {x} is not {y}");
    }

    /// Error of an order condition by rounding of the coefficients: those of Verner's pair reach 200.
    fn rounding(t: &Tableau) -> f64 {
        let largest = |row: &[f64]| row.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
        let coefficients = t.a.iter().map(|row| largest(row)).fold(1.0, f64::max);
        3e-15 * coefficients * largest(t.b) + 5e-15
    }

    /// Stage times and coefficients, with the derivative at the new state that a method without FSAL adds.
    fn stages(t: &Tableau) -> (Vec<f64>, Vec<&[f64]>) {
        let (mut c, mut a) = (t.c.to_vec(), t.a.to_vec());
        if !t.fsal {
            c.push(1.0);
            a.push(t.b);
        }
        (c, a)
    }

    /// Elementary weights of the 17 rooted trees to order five and of one of order six, with their order and
    /// density: `Σ bᵢ Φᵢ = 1/γ` (Hairer I, theorem II.2.13).
    fn trees(t: &Tableau) -> Vec<(u32, f64, Vec<f64>)> {
        let (c, a) = stages(t);
        let apply = |v: &[f64]| -> Vec<f64> { a.iter().map(|row| dot(row, v)).collect::<Vec<_>>() };
        let times = |u: &[f64], v: &[f64]| -> Vec<f64> {
            u.iter().zip(v).map(|(x, y)| x * y).collect::<Vec<_>>()
        };
        let one = vec![1.0; c.len()];
        let (c2, ac) = (times(&c, &c), apply(&c));
        let (c3, cac, ac2, aac) = (times(&c2, &c), times(&c, &ac), apply(&c2), apply(&ac));
        vec![
            (1, 1.0, one),
            (2, 2.0, c.clone()),
            (3, 3.0, c2.clone()),
            (3, 6.0, ac.clone()),
            (4, 4.0, c3.clone()),
            (4, 8.0, cac.clone()),
            (4, 12.0, ac2.clone()),
            (4, 24.0, aac.clone()),
            (5, 5.0, times(&c3, &c)),
            (5, 10.0, times(&c2, &ac)),
            (5, 20.0, times(&ac, &ac)),
            (5, 15.0, times(&c, &ac2)),
            (5, 30.0, times(&c, &aac)),
            (5, 20.0, apply(&c3)),
            (5, 40.0, apply(&cac)),
            (5, 60.0, apply(&ac2)),
            (5, 120.0, apply(&aac)),
            (6, 6.0, times(&c3, &c2)),
        ]
    }

    #[test]
    fn shapes_and_row_sums() {
        for t in ALL {
            let lengths = [t.c.len(), t.a.len(), t.b.len(), t.b_err.len()];
            assert_eq!(lengths, [t.stages; 4], "{}", t.name);
            assert_eq!(t.dense.len(), t.stages + usize::from(!t.fsal), "{}", t.name);
            for (i, row) in t.a.iter().enumerate() {
                assert_eq!(row.len(), i);
                let sum: f64 = row.iter().sum();
                assert!((sum - t.c[i]).abs() < rounding(&t), "{}: row {i}", t.name);
            }
        }
    }

    #[test]
    fn solution_and_embedded_weights_meet_their_order_conditions() {
        for t in ALL {
            let embedded: Vec<f64> = t.b.iter().zip(t.b_err).map(|(b, e)| b - e).collect();
            let meets = |weights: &[f64], phi: &[f64], density: f64| {
                let off = dot(weights, phi) - 1.0 / density;
                assert!(
                    off.abs() < rounding(&t),
                    "{}, γ = {density}: {off:e}",
                    t.name
                );
            };
            close(t.b_err.iter().sum(), 0.0, "sum of b_err");
            for (order, density, phi) in trees(&t) {
                if order <= t.order {
                    meets(t.b, &phi, density);
                }
                if order <= t.error_order {
                    meets(&embedded, &phi, density);
                }
            }
        }
    }

    /// An embedded solution of the solution's own order would measure nothing.
    #[test]
    fn the_error_estimate_sees_the_leading_error() {
        for t in ALL.iter().filter(|t| t.error_order > 0) {
            let seen = trees(t).into_iter().any(|(order, _, phi)| {
                order == t.error_order + 1 && dot(t.b_err, &phi).abs() > 1e-6
            });
            assert!(seen, "{}", t.name);
        }
    }

    #[test]
    fn fsal_row_is_the_solution() {
        for t in ALL.iter().filter(|t| t.fsal) {
            let last = t.a[t.stages - 1];
            assert_eq!(last, &t.b[..t.stages - 1]);
            assert_eq!(t.b[t.stages - 1], 0.0);
            assert_eq!(t.c[t.stages - 1], 1.0);
        }
    }

    /// `Σ bᵢ(θ) Φᵢ = θ^order / γ` holds power by power up to the order of the dense output: four for the two
    /// pairs of order five, three for a cubic. The polynomial ends on `b`, its slope on the last derivative.
    #[test]
    fn dense_output_is_of_its_order_and_smooth() {
        for t in ALL {
            let known = if t.dense.iter().any(|d| d[3] != 0.0) {
                4
            } else {
                3
            };
            assert_eq!(known, if t.order == 5 { 4 } else { 3 }, "{}", t.name);
            for (order, density, phi) in trees(&t).into_iter().filter(|tree| tree.0 <= known) {
                for power in 1..=known {
                    let column: Vec<f64> = t.dense.iter().map(|d| d[power as usize - 1]).collect();
                    let expected = if power == order { 1.0 / density } else { 0.0 };
                    let got = dot(&column, &phi);
                    let off = (got - expected).abs();
                    assert!(
                        off < 10.0 * rounding(&t) + 1e-12,
                        "{} θ^{power}: {got}",
                        t.name
                    );
                }
            }
            let last = t.dense.len() - 1;
            for (i, d) in t.dense.iter().enumerate() {
                let weight = t.b.get(i).copied().unwrap_or(0.0);
                close(d.iter().sum(), weight, "dense output at the end");
                let slope = d[0] + 2.0 * d[1] + 3.0 * d[2] + 4.0 * d[3];
                let expected = if i == last { 1.0 } else { 0.0 };
                assert!(
                    (slope - expected).abs() < 1e-12,
                    "slope of stage {i}: {slope}"
                );
            }
        }
    }

    /// The stability function, run on `y' = −limit·y`, has modulus one there.
    #[test]
    fn stability_limit_is_where_the_amplification_is_one() {
        for t in ALL.iter().filter(|t| t.stability_limit.is_finite()) {
            let amplification = |z: f64| {
                let mut k: Vec<f64> = Vec::new();
                for row in t.a {
                    k.push(z * (1.0 + dot(row, &k)));
                }
                (1.0 + dot(t.b, &k)).abs()
            };
            assert!(amplification(-t.stability_limit + 1e-3) < 1.0);
            assert!(amplification(-t.stability_limit - 1e-3) > 1.0);
        }
    }
}
