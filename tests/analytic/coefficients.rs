//! Analytic: stiffness and damping for rotors. Without dampers and friction they are the static stiffness; under thrust the damping is
//! that of two contacts in series at the contact angle, and turns with the cage.

use ballrace::scene::{Friction, NormalLaw, Scene, presets};
use ballrace::{DynamicCoefficients, dynamic_coefficients, equilibrium, stiffness};

/// Without a cage and gravity, by Hertz's law.
fn plain(mut scene: Scene) -> Scene {
    (scene.cage, scene.gravity, scene.friction) = (None, [0.0; 3], Friction::None);
    scene.contact.law = NormalLaw::Hertz;
    scene
}

fn coefficients(scene: &Scene) -> DynamicCoefficients {
    dynamic_coefficients(scene, 1).unwrap()
}

#[test]
fn without_dampers_it_is_the_static_stiffness() {
    for speed in [0.0, 6000.0] {
        let mut scene = plain(presets::deep_groove_6205(500.0, 200.0, speed));
        scene.contact.damping = 0.0;
        let (found, wanted) = (coefficients(&scene), stiffness(&scene).unwrap());
        for i in 0..5 {
            for j in 0..5 {
                let of = |i: usize| wanted.inner_spatial[i][i];
                let error = found.stiffness[i][j] - wanted.inner_spatial[i][j];
                let scale = (of(i) * of(j)).sqrt();
                assert!(
                    error.abs() < 1e-4 * scale,
                    "{speed} {i} {j}: {}",
                    error / scale
                );
                assert!(found.damping[i][j].abs() < 1e-9 * scale, "{speed} {i} {j}");
            }
        }
    }
}

/// Dampers c = 1.5 α F and springs k = 1.5 F / δ of both contacts of a ball in series, at its contact angle.
fn in_series(scene: &Scene) -> (f64, f64) {
    let still = equilibrium(scene).unwrap();
    let ball = &still.balls[0];
    let [outer, inner] = [&ball.outer, &ball.inner];
    let damper = |load: f64| 1.5 * scene.contact.damping * load;
    let spring = |load: f64, approach: f64| 1.5 * load / approach;
    let [c_o, c_i] = [outer, inner].map(|contact| damper(contact.load));
    let [k_o, k_i] = [outer, inner].map(|contact| spring(contact.load, contact.deflection));
    let series = (c_o * k_i.powi(2) + c_i * k_o.powi(2)) / (k_o + k_i).powi(2);
    (series, inner.angle.unwrap())
}

#[test]
fn under_thrust_it_is_damped_by_contacts_in_series() {
    let scene = plain(presets::deep_groove_6205(0.0, 500.0, 0.0));
    let (found, (series, angle)) = (coefficients(&scene), in_series(&scene));
    let axial = 9.0 * series * angle.sin().powi(2);
    let radial = 4.5 * series * angle.cos().powi(2);
    let of = |i: usize| found.damping[i][i];
    assert!((of(2) / axial - 1.0).abs() < 0.01, "{} {axial}", of(2));
    for i in [0, 1] {
        assert!((of(i) / radial - 1.0).abs() < 0.01, "{} {radial}", of(i));
    }
    assert!(found.damping[0][1].abs() < 1e-6 * radial);
}

#[test]
fn dampers_turn_with_the_cage() {
    let scene = plain(presets::deep_groove_6205(0.0, 500.0, 1800.0));
    let found = coefficients(&scene);
    // Of pure rolling at the angle of the inner contacts; the outer ones differ little from it.
    let angle = equilibrium(&scene).unwrap().balls[0].inner.angle.unwrap();
    let row = &scene.rows[0];
    let gamma = row.ball_diameter * angle.cos() / row.pitch_diameter;
    let orbit = 0.5 * scene.drive.initial_speed() * (1.0 - gamma);
    let turning = orbit * found.damping[0][0];
    let (xy, yx) = (found.stiffness[0][1], found.stiffness[1][0]);
    assert!((xy / turning - 1.0).abs() < 0.01, "{xy} {turning}");
    assert!((yx / turning + 1.0).abs() < 0.01, "{yx} {turning}");
}
