//! The written slope against the kernel's own.

use super::*;
use crate::contact::dual::Dual;
use crate::contact::iso16281::Iso16281;
use crate::contact::laws::traction::tests::laws;
use crate::contact::{Damping, Elastic, Law, Shape, Torus, Waves, ZoneSlices};

fn state<T: crate::simd::Number>(of: impl Fn(f64) -> T, velocity: [T; 3]) -> ElementState<T> {
    ElementState {
        elastic: of(120.0),
        share: (of(0.8), of(0.6)),
        friction_weight: of(0.9),
        slope: Inclination {
            cos: of(f64::sqrt(1.0 - 0.55 * 0.55)),
            sin: of(0.55),
        },
        velocity,
        load: of(1e5),
        depth: of(1e-5),
        arm: of(6e-3),
        rolling: Rolling::resting(of(0.03)),
        radii: [of(6e-3), of(6.2e-3)],
        oil: FilmEffect {
            friction: of(0.05),
            bend: of(2e-3),
            damping: of(0.1),
            rolling: of(0.0),
        },
    }
}

/// Truth: the kernel, differentiated by itself, against the slope that is written out; pressed and pulling.
#[test]
fn the_slope_is_the_kernels() {
    for traction in laws().into_iter().map(Some).chain([None]) {
        for (clamp_pull, velocity) in [
            (true, [0.2, -0.05, 0.3]),
            (true, [-30.0, 0.4, 0.1]),
            (false, [-30.0, 0.4, 0.1]),
            (false, [0.01, 1e-4, -0.02]),
        ] {
            let law = Law {
                damping: Damping {
                    coefficient: 0.2,
                    clamp_pull,
                },
                traction,
                ..Law::elastic(Elastic::Iso16281(Iso16281::new(7e10, 0.5, 12e-3)))
            };
            let pair = Pair {
                race: Torus {
                    sigma: 1.0,
                    a: 30e-3,
                    centre: 0.0,
                    r: 6.24e-3,
                    lowest: -6e-3,
                    highest: 6e-3,
                },
                shape: Shape::default(),
                waves: Waves::default(),
                law,
                slices: ZoneSlices::Fixed(10),
                defects: Vec::new(),
            };
            let lanes = state(Lanes::all, velocity.map(Lanes::all));
            let force = kernel::force::<_, false, false, true, false>(&law, &lanes, Lanes::ZERO);
            let (hardening, reach) = (1.1 / 1e-5, 1e-6);
            let written = pair
                .slope::<false>(&lanes, &force, Lanes::all(hardening), reach)
                .force;
            let of = Dual::<f64, 3>::constant;
            let variables = [0, 1, 2].map(|i| Dual::variable(velocity[i], i));
            let mut dual = state(of, variables);
            // Places move with velocities.
            let [v_n, _, v_z] = dual.velocity;
            let approach = v_n * dual.share.0 + v_z * dual.share.1;
            dual.elastic.slopes = (approach * (dual.elastic.value * hardening * reach)).slopes;
            let differentiated =
                kernel::force::<_, false, false, false, false>(&law, &dual, dual.elastic * 0.0)
                    .on_ring;
            for i in 0..3 {
                assert!((force.on_ring[i][3] - differentiated[i].value).abs() < 1e-12 * 120.0);
                for j in 0..3 {
                    let (found, truth) = (written[i][j][5], differentiated[i].slopes[j]);
                    let off = (found - truth).abs() / (120.0 * 0.3);
                    assert!(off < 1e-12, "{law:?} {velocity:?} {i} {j}: {found} {truth}");
                }
            }
        }
    }
}
