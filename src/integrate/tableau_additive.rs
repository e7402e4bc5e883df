//! Additive Runge–Kutta methods as data.

use super::additive::Additive;
use super::tableau::{Tableau, hermite};

const WEIGHTS: [f64; 6] = [
    82889.0 / 524_892.0,
    0.0,
    15625.0 / 83664.0,
    69875.0 / 102_672.0,
    -2260.0 / 8211.0,
    1.0 / 4.0,
];

/// Kennedy–Carpenter ARK4(3)6L\[2\]SA: order four in both parts, six stages, the implicit part L-stable
/// and stiffly accurate. Dense output is cubic Hermite, of order three.
///
/// With positions explicit and velocities implicit an oscillator of 5 % damping is stable up to ωh = 2.0, one of
/// 0.1 % to 0.82; an undamped one grows by 0.27 % a step at ωh = 1.
///
/// Source: C. A. Kennedy, M. H. Carpenter, Appl. Numer. Math. 44 (2003) 139–181, appendix C.
pub const KENNEDY_CARPENTER: Additive = Additive {
    explicit: Tableau {
        name: "Kennedy-Carpenter ARK4(3)6L[2]SA",
        order: 4,
        error_order: 3,
        stages: 6,
        c: &[0.0, 1.0 / 2.0, 83.0 / 250.0, 31.0 / 50.0, 17.0 / 20.0, 1.0],
        a: &[
            &[],
            &[1.0 / 2.0],
            &[13861.0 / 62500.0, 6889.0 / 62500.0],
            &[
                -116_923_316_275.0 / 2_393_684_061_468.0,
                -2_731_218_467_317.0 / 15_368_042_101_831.0,
                9_408_046_702_089.0 / 11_113_171_139_209.0,
            ],
            &[
                -451_086_348_788.0 / 2_902_428_689_909.0,
                -2_682_348_792_572.0 / 7_519_795_681_897.0,
                12_662_868_775_082.0 / 11_960_479_115_383.0,
                3_355_817_975_965.0 / 11_060_851_509_271.0,
            ],
            &[
                647_845_179_188.0 / 3_216_320_057_751.0,
                73_281_519_250.0 / 8_382_639_484_533.0,
                552_539_513_391.0 / 3_454_668_386_233.0,
                3_354_512_671_639.0 / 8_306_763_924_573.0,
                4040.0 / 17871.0,
            ],
        ],
        b: &WEIGHTS,
        b_err: &[
            WEIGHTS[0] - 4_586_570_599.0 / 29_645_900_160.0,
            0.0,
            WEIGHTS[2] - 178_811_875.0 / 945_068_544.0,
            WEIGHTS[3] - 814_220_225.0 / 1_159_782_912.0,
            WEIGHTS[4] + 3_700_637.0 / 11_593_932.0,
            WEIGHTS[5] - 61727.0 / 225_920.0,
        ],
        fsal: false,
        dense: &hermite::<6, 7>(&WEIGHTS),
        stability_limit: f64::INFINITY,
    },
    implicit: &[
        &[],
        &[1.0 / 4.0],
        &[8611.0 / 62500.0, -1743.0 / 31250.0],
        &[
            5_012_029.0 / 34_652_500.0,
            -654_441.0 / 2_922_500.0,
            174_375.0 / 388_108.0,
        ],
        &[
            15_267_082_809.0 / 155_376_265_600.0,
            -71_443_401.0 / 120_774_400.0,
            730_878_875.0 / 902_184_768.0,
            2_285_395.0 / 8_070_912.0,
        ],
        &[WEIGHTS[0], WEIGHTS[1], WEIGHTS[2], WEIGHTS[3], WEIGHTS[4]],
    ],
    gamma: 1.0 / 4.0,
};

/// The implicit part checks itself as `tableau.rs` checks the explicit one.
#[cfg(test)]
mod tests {
    use super::*;

    type Matrix = Vec<Vec<f64>>;

    fn parts(t: &Additive) -> [Matrix; 2] {
        let n = t.explicit.stages;
        let full = |row: &[f64], diagonal: f64| {
            let mut full = vec![0.0; n];
            full[..row.len()].copy_from_slice(row);
            if diagonal != 0.0 {
                full[row.len()] = diagonal;
            }
            full
        };
        let explicit = t.explicit.a.iter().map(|row| full(row, 0.0)).collect();
        let diagonal = |i: usize| if i == 0 { 0.0 } else { t.gamma };
        let implicit = t.implicit.iter().enumerate();
        [
            explicit,
            implicit.map(|(i, row)| full(row, diagonal(i))).collect(),
        ]
    }

    fn apply(a: &Matrix, v: &[f64]) -> Vec<f64> {
        a.iter().map(|row| dot(row, v)).collect()
    }

    fn dot(u: &[f64], v: &[f64]) -> f64 {
        u.iter().zip(v).map(|(x, y)| x * y).sum()
    }

    #[test]
    fn row_sums_and_stiff_accuracy() {
        let t = KENNEDY_CARPENTER;
        let [_, implicit] = parts(&t);
        for (row, c) in implicit.iter().zip(t.explicit.c) {
            assert!((row.iter().sum::<f64>() - c).abs() < 1e-14);
        }
        assert_eq!(implicit[5], t.explicit.b);
    }

    /// Order four of both parts together: every tree of the explicit conditions, with each of its inner
    /// matrices explicit or implicit (Kennedy & Carpenter 2003, section 2).
    #[test]
    fn coupling_conditions_to_order_four() {
        let t = KENNEDY_CARPENTER;
        let (b, c) = (t.explicit.b, t.explicit.c);
        let embedded: Vec<f64> = b.iter().zip(t.explicit.b_err).map(|(b, e)| b - e).collect();
        let squares: Vec<f64> = c.iter().map(|c| c * c).collect();
        let meets = |weights: &[f64], phi: &[f64], density: f64| {
            let off = dot(weights, phi) - 1.0 / density;
            assert!(off.abs() < 1e-13, "γ = {density}: {off:e}");
        };
        for outer in &parts(&t) {
            let ac = apply(outer, c);
            meets(b, &ac, 6.0);
            meets(&embedded, &ac, 6.0);
            let cac: Vec<f64> = ac.iter().zip(c).map(|(x, c)| x * c).collect();
            meets(b, &cac, 8.0);
            meets(b, &apply(outer, &squares), 12.0);
            for inner in &parts(&t) {
                meets(b, &apply(outer, &apply(inner, c)), 24.0);
            }
        }
    }
}
