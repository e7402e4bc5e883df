//! How accelerations depend on velocities and places, with the contacts held where they are.
//!
//! The default method solves for that once a step, by a matrix that serves many steps ([`Damped`]). Friction is the stiffest part of the
//! model. The matrix is an arrow (`arrow.rs`) of a 4×4 block a ball and 8×8 for the rings, or 6×6 and 12×12 where rings tilt or balls spin
//! freely; cage links and coupled supports are not in it: their damping is slow. Nor are gyroscopic moments of the rings.

mod apart;
mod arrow;
mod carrier;
mod held_balls;
mod linear;
mod matrices;
mod matrix;

pub(crate) use linear::Damped;

/// Scenes by which the matrix is tested.
#[cfg(test)]
mod tests {
    use crate::contact;
    use crate::scene::{
        Friction, Lubricant, Mount, NormalLaw, Slices, Spin, Texture, Waviness, presets,
    };
    use crate::statics::compile;
    use crate::{Model, Scene, Start, start};

    /// A scene whose nodes weigh the same for friction as for the normal force: held contacts keep what they weigh as they keep where
    /// they are, and the right-hand side does not.
    pub(super) fn compiled(scene: &Scene) -> Model {
        let mut model = compile(scene).unwrap();
        for pair in model.rows.iter_mut().flat_map(|row| &mut row.pairs) {
            if let contact::ZoneSlices::Fitted(rules) = &pair.slices {
                let exponent = pair.law.elastic.exponent();
                let plain = contact::Rules::for_friction(rules.count(), exponent, 0);
                pair.slices = contact::ZoneSlices::Fitted(plain);
            }
        }
        model
    }

    /// A state off any symmetry, in motion.
    pub(super) fn state(model: &Model) -> Vec<f64> {
        let mut y = start(model, &Start::Equilibrium).unwrap();
        let half = y.len() / 2;
        for (i, (_, dof)) in model.layout().degrees().enumerate() {
            let scale = if dof.is_rotation() { 100.0 } else { 1.0 };
            y[half + i] += 0.02 * (i as f64).sin() * scale;
        }
        y
    }

    pub(super) fn scenes() -> Vec<Scene> {
        let mut wheel = presets::wheel_bearing(3000.0);
        let mut hertz = presets::deep_groove_6205(2000.0, 500.0, 1800.0);
        (wheel.cage, hertz.cage) = (None, None);
        // Under a loaded ball at the start.
        let spall = wheel.defects.get_mut("spall").unwrap();
        (spall.angle, spall.axial_offset) = (-1.6, 2.0e-3.into());
        hertz.friction = Friction::Stribeck {
            static_coefficient: 0.12,
            kinetic_coefficient: 0.05,
            stribeck_speed: 0.3,
            slip_speed: 0.02,
        };
        let mut traction = wheel.clone();
        traction.friction = Friction::Traction {
            a: 0.05,
            b: 0.2,
            c: 3.0,
            d: 0.02,
            slip_speed: 0.01,
        };
        // Slices that pull, and whose friction then is none.
        let mut pulling = wheel.clone();
        (pulling.contact.damping, pulling.contact.clamp_pull) = (40.0, false);
        pulling.contact.slices = Slices::Fixed(30);
        let mut smooth = wheel.clone();
        smooth.friction = Friction::None;
        // Forces of places alone: of waves, and of a defect's ends.
        let mut uneven = wheel.clone();
        uneven.contact.law = NormalLaw::Hertz;
        uneven.rows[0].inner_waviness = vec![Waviness {
            order: 20,
            amplitude: 2e-6,
            phase: 0.3,
        }];
        let mut texture = Texture::of_races(5e-9);
        texture.ball = 5e-9;
        uneven.rows[1].texture = Some(texture);
        // Rows of other laws, cuts and friction.
        let mut unlike = wheel.clone();
        unlike.rows[1].contact = Some(hertz.contact.clone());
        unlike.rows[1].friction = Some(hertz.friction.clone());
        vec![wheel, hertz, traction, pulling, smooth, uneven, unlike]
    }

    fn in_oil(scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        scene.name.push_str(" in oil");
        scene.lubricant = Some(Lubricant::named("vg68", 328.15));
        scene
    }

    /// Whole contacts and some with a defect.
    pub(super) fn oiled_wheel() -> Scene {
        in_oil(&scenes()[0])
    }

    /// Nothing of the oil but its rolling resistance.
    pub(super) fn rolling() -> Scene {
        let mut scene = in_oil(&scenes()[4]);
        let only = scene.lubricant.as_mut().unwrap();
        (only.film, only.damping, only.traction) = (false, false, false);
        scene
    }

    /// Scenes with rings that tilt and rock, with balls that spin freely, and with both.
    pub(super) fn spatial() -> Vec<Scene> {
        let all = || scenes().into_iter().chain([oiled_wheel(), rolling()]);
        let mut found: Vec<Scene> = all().map(|scene| spinning(&scene)).collect();
        found.extend(all().map(|scene| tilted(&scene)));
        found.extend(all().map(|scene| tilted(&spinning(&scene))));
        found
    }

    fn spinning(scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        scene.name.push_str(" spinning");
        scene.spin = Some(Spin::Free);
        scene
    }

    /// The scene tilted by so much that a matrix of parallel rings would be seen.
    fn tilted(scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        scene.name.push_str(" tilted");
        let support = &mut scene.inner_ring.support;
        (support.tilt_x, support.tilt_y) = (Some(Mount::Free), Some(Mount::Free));
        scene.outer_ring.tilt = Some([0.004, -0.006]);
        scene.inner_ring.centre_of_mass = Some(4e-3);
        scene
    }
}
