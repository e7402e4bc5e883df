use super::super::laws::elastic::tests::laws;
use super::super::{Cut, Elastic, Law, Shape, Torus, Waves};
use super::*;
use crate::scene::Waviness;

fn pair(sigma: f64, elastic: Elastic, slices: ZoneSlices, waves: Waves) -> Pair {
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
        let both = |elastic: Elastic| {
            let fitted = ZoneSlices::Fitted(Rules::new(6, elastic.exponent()));
            [fitted, ZoneSlices::Fixed(200)].map(|slices| (elastic, slices))
        };
        for (elastic, slices) in laws(sigma, 12e-3).into_iter().flat_map(both) {
            for waves in [Waves::default(), wavy()] {
                let pair = pair(sigma, elastic, slices.clone(), waves);
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
    let on_surface = |elastic: &Elastic| elastic.cut() == Cut::BallSurface;
    let pairs = [1.0, -1.0].into_iter().flat_map(|sigma| {
        let laws = laws(sigma, 12e-3).into_iter().filter(on_surface);
        laws.map(move |elastic| {
            let slices = ZoneSlices::Fitted(Rules::new(6, elastic.exponent()));
            pair(sigma, elastic, slices, Waves::default())
        })
    });
    for pair in pairs {
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
