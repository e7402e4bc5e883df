use super::super::hertz::Hertz;
use super::super::iso16281::Iso16281;
use super::super::{Elastic, Law, Shape, Torus, Waves};
use super::*;
use crate::scene::{Material, Waviness};

fn pair(sigma: f64, hertz: bool, slices: ZoneSlices, waves: Waves) -> Pair {
    let steel = Material::default();
    let elastic = if hertz {
        Elastic::Hertz(Hertz::new(sigma, 12e-3, 60e-3, 0.52, 0.3, &steel, &steel))
    } else {
        Elastic::Iso16281(Iso16281::new(3.5948e10, 0.5, 12e-3))
    };
    Pair {
        race: Torus {
            sigma,
            a: 30e-3,
            centre: 0.1e-3,
            r: 6.24e-3,
            lowest: -6.24e-3,
            highest: 6.24e-3,
        },
        shape: Shape::default(),
        waves,
        law: Law::elastic(elastic),
        slices,
        defects: Vec::new(),
    }
}

/// Truth: the contact slice by slice. The same force, and the stiffness as its central differences.
#[test]
fn agrees_with_the_slices() {
    let ball = BallSide::whole(6e-3);
    let wavy = || {
        Waves::of(vec![Waviness {
            order: 9,
            amplitude: 1e-6,
            phase: 0.4,
        }])
    };
    // Of the force, of the stiffness on nodes, and of that on slices: one that enters within a difference
    // bends its own force like s^{1/9}.
    let mut worst = [0.0_f64; 3];
    for sigma in [1.0, -1.0] {
        for (hertz, slices) in [
            (false, ZoneSlices::Fitted(Rules::new(6, 10.0 / 9.0))),
            (false, ZoneSlices::Fixed(200)),
            (true, ZoneSlices::Fitted(Rules::new(6, 1.0))),
        ] {
            for waves in [Waves::default(), wavy()] {
                let pair = pair(sigma, hertz, slices.clone(), waves);
                for (tilt, direction) in [(0.0, 0.3), (0.4, -2.0), (-0.7, 1.1)] {
                    let l = 6.24e-3 - ball.radius + 15e-6;
                    let d = pair.race.a + sigma * l * f64::cos(tilt);
                    let (sin, cos) = f64::sin_cos(direction);
                    let place = Vector3::new(d * cos, d * sin, pair.race.centre + l * tilt.sin());
                    let found = pair.tangent(&ball, &place);
                    let force = pair.elastic(&ball, &place);
                    let stiffness = pair.stiffness_by_differences(&ball, &place, 1e-8);
                    let analytic = found.stiffness.unwrap();
                    worst[0] = worst[0].max((found.force - force).norm() / force.norm());
                    let kind = if matches!(slices, ZoneSlices::Fitted(_)) {
                        1
                    } else {
                        2
                    };
                    let error = (analytic - stiffness).norm() / stiffness.norm();
                    worst[kind] = worst[kind].max(error);
                }
            }
        }
    }
    println!("force, stiffness on nodes and on slices: {worst:?}");
    assert!(
        worst[0] < 1e-11 && worst[1] < 1e-6 && worst[2] < 5e-3,
        "{worst:?}"
    );
}

/// Truth: the kernel, differentiated by itself.
#[test]
fn the_form_by_hand_is_the_kernels() {
    let slices = ZoneSlices::Fitted(Rules::new(6, 10.0 / 9.0));
    for sigma in [1.0, -1.0] {
        let pair = pair(sigma, false, slices.clone(), Waves::default());
        for (tilt, approach) in [(0.0, 15e-6), (0.4, 2e-6), (-0.7, 40e-6)] {
            let l = 6.24e-3 - 6e-3 + approach;
            let (sin, cos) = f64::sin_cos(tilt);
            let section = Section::new::<false, false>(6e-3, 6.24e-3, l * cos, -l * sin);
            let (written, differentiated) = (
                pair.meridional(&section, 0.0).unwrap(),
                pair.differentiated(&section, 0.0),
            );
            for i in 0..2 {
                let off =
                    (written.force[i] - differentiated.force[i]).abs() / differentiated.force[0];
                assert!(off < 1e-12, "{tilt} {approach}: {off:e}");
                for j in 0..2 {
                    let off = (written.slope[i][j] - differentiated.slope[i][j]).abs();
                    let off = off / differentiated.slope[0][0].abs();
                    assert!(off < 1e-10, "{tilt} {approach}: {off:e}");
                }
            }
        }
    }
}
