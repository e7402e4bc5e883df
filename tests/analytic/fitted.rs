//! Fitted nodes against a converged sum of fixed slices: healthy, across defects and at a defect's end.

use std::f64::consts::FRAC_PI_2;

use crate::common::rms;
use ballrace::compile;
use ballrace::dynamics::contributions;
use ballrace::scene::{Defect, NormalLaw, Patch, Scene, Slices, Surface, presets};
use ballrace::{Start, start};

/// A single row at a contact angle, loaded by interference, with or without a defect at −90°.
fn scene(law: &NormalLaw, conformity: f64, degrees: f64, defect: Option<Defect>) -> Scene {
    let mut scene = presets::wheel_bearing(0.0);
    scene.contact.law = law.clone();
    scene.rows.truncate(1);
    let row = &mut scene.rows[0];
    (row.outer_conformity, row.inner_conformity) = (conformity, conformity);
    row.contact_angle = degrees.to_radians();
    row.start_angle = -FRAC_PI_2;
    scene.defects = defect.map(|d| ("d".to_owned(), d)).into_iter().collect();
    scene
}

/// Normal forces on ball 0, pressed by an approach in the nominal direction.
fn forces(scene: &Scene, slices: Slices, approach: f64, arc: f64, shift: f64) -> Vec<f64> {
    let mut scene = scene.clone();
    scene.contact.slices = slices;
    let model = compile(&scene).unwrap();
    let mut y = start(&model, &Start::Rolling).unwrap();
    // The ball goes outwards along the contact angle, by arc along the race, by shift along the axis.
    let angle = scene.rows[0].contact_angle;
    let radius = 30e-3 + approach * angle.cos();
    let place = -FRAC_PI_2 + arc / 36e-3;
    (y[8], y[9]) = (radius * place.cos(), radius * place.sin());
    y[10] += approach * angle.sin() + shift;
    // Normal forces on the ball in question.
    let parts = contributions(&model, 0.0, &y);
    let contact = parts.iter().find(|(name, _)| *name == "contact").unwrap();
    contact.1[8..11].to_vec()
}

fn error(a: &[f64], b: &[f64]) -> f64 {
    let norm = |x: &mut dyn Iterator<Item = f64>| x.map(|v| v * v).sum::<f64>().sqrt();
    norm(&mut a.iter().zip(b).map(|(x, y)| x - y)) / norm(&mut b.iter().copied())
}

const LAWS: [NormalLaw; 2] = [
    NormalLaw::Iso16281 {
        constant: 3.5948e10,
        length_ratio: 0.5,
    },
    NormalLaw::Hertz,
];

/// Analytic (converged sum): healthy contacts over loads, angles and conformities.
#[test]
fn healthy_contacts_converge() {
    for law in &LAWS {
        // Hertz's zone is flat: where it is so long that it leaves the ball, at 45°, it is no Hertzian contact.
        let approaches: &[f64] = match law {
            NormalLaw::Iso16281 { .. } => &[5e-6, 10e-6, 20e-6, 40e-6, 60e-6],
            _ => &[5e-6, 10e-6, 20e-6],
        };
        for (m, bound) in [(4, 1e-3), (5, 1e-4), (6, 3e-5), (8, 2e-6)] {
            let mut errors = Vec::new();
            for conformity in [0.505, 0.525, 0.56] {
                for degrees in [0.0, 15.0, 30.0, 45.0] {
                    let scene = scene(law, conformity, degrees, None);
                    // The same zone half-lengths for every conformity, 1.1 to 3.9 mm: a closer groove is stiffer.
                    // At 45° the largest reaches the ball's own end.
                    let closeness = (1.0 - 0.5 / conformity) / (1.0 - 0.5 / 0.525);
                    for approach in approaches.iter().map(|a| a * closeness) {
                        let exact = forces(&scene, Slices::Fitted(40), approach, 0.0, 0.0);
                        errors.push(error(
                            &forces(&scene, Slices::Fitted(m), approach, 0.0, 0.0),
                            &exact,
                        ));
                    }
                }
            }
            println!("{law:?} healthy m = {m}: rms {:.1e}", rms(&errors));
            assert!(rms(&errors) < bound, "{m}: {:.1e}", rms(&errors));
        }
        // And the limit is that of fixed slices.
        let scene = scene(law, 0.525, 15.0, None);
        let exact = forces(&scene, Slices::Fixed(100_000), 20e-6, 0.0, 0.0);
        let fitted = error(&forces(&scene, Slices::Fitted(40), 20e-6, 0.0, 0.0), &exact);
        assert!(fitted < 1e-7, "{fitted:.1e}");
    }
}

/// Analytic (converged sum): contacts that a defect cuts, at its ends and inside its arc.
#[test]
fn faulted_contacts_converge() {
    for law in &LAWS {
        for m in [4, 6, 8] {
            let mut errors = Vec::new();
            for on in [Surface::OuterRace, Surface::Ball] {
                for (width, length, offset) in [
                    (1.5e-3, 1.5e-3, 1.2e-3),
                    (0.4e-3, 1e-3, 0.0),
                    (1e-3, 6e-3, 0.3e-3),
                ] {
                    let mut defect = Defect::of(
                        Patch::of_width(width).length(length).edge_radius(0.3e-3),
                        on,
                        -FRAC_PI_2,
                    )
                    .at_offset(offset);
                    defect.ball = (on == Surface::Ball).then_some(0);
                    let scene = scene(law, 0.525, 13.0, Some(defect));
                    for (approach, arc) in [(20e-6, 0.0), (40e-6, 0.1e-3), (40e-6, 0.45e-3)] {
                        let exact = forces(&scene, Slices::Fixed(100_000), approach, arc, 0.0);
                        errors.push(error(
                            &forces(&scene, Slices::Fitted(m), approach, arc, 0.0),
                            &exact,
                        ));
                    }
                }
            }
            let worst = errors.iter().copied().fold(0.0, f64::max);
            println!(
                "{law:?} defective m = {m}: rms {:.1e}, worst {worst:.1e}",
                rms(&errors)
            );
            if m >= 6 {
                assert!(rms(&errors) < 1e-4, "{m}: {:.1e}", rms(&errors));
            }
        }
    }
}

/// Analytic: the force is continuous when the ball shifts axially across a defect's end; that of fixed slices
/// is not.
#[test]
fn no_jump_across_a_defects_end() {
    let defect = Defect::of(
        Patch::of_width(1e-3).length(1.5e-3).edge_radius(0.3e-3),
        Surface::OuterRace,
        -FRAC_PI_2,
    )
    .at_offset(2e-3);
    for law in &LAWS {
        let scene = scene(law, 0.525, 13.0, Some(defect.clone()));
        let largest = |slices: Slices| {
            let all: Vec<_> = (-700..700)
                .map(|k| forces(&scene, slices, 40e-6, 0.0, f64::from(k) * 1e-7))
                .collect();
            let size = all[0].iter().map(|x| x * x).sum::<f64>().sqrt();
            // Second differences: a smooth force leaves next to nothing.
            let bend = |w: &[Vec<f64>], i: usize| (w[0][i] - 2.0 * w[1][i] + w[2][i]).abs();
            let jump = all
                .windows(3)
                .flat_map(|w| (0..w[0].len()).map(move |i| bend(w, i)))
                .fold(0.0, f64::max);
            jump / size
        };
        let (fitted, fixed) = (largest(Slices::Fitted(6)), largest(Slices::Fixed(100)));
        println!("{law:?}: largest second difference: fitted {fitted:.1e}, fixed {fixed:.1e}");
        assert!(
            fitted < 1e-4 && fixed > 20.0 * fitted,
            "{fitted:.1e} {fixed:.1e}"
        );
    }
}
