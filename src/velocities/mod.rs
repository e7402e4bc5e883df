//! Implicit velocities: v = base + γh a(t, q, v) by Newton's method at fixed places.
//!
//! Friction is the stiffest part of the model, and linearising it once a step is not enough: within a step
//! slices go over from sticking to sliding. So the nodes of every contact are found once a stage
//! (`stage.rs`), and their forces are iterated on velocities alone (`newton.rs`). The matrix is an arrow
//! (`arrow.rs`) of a 4×4 block a ball and 8×8 for the rings, or 6×6 and 12×12 where rings tilt or balls spin freely; cage links and
//! coupled supports are in the residual, not in the matrix: their damping is slow and converges by itself. So are gyroscopic moments of
//! the rings. A matrix serves as many stages and steps as corrections by it shrink fast, which at a steady roll are many.

mod arrow;
mod carrier;
mod factors;
mod linear;
mod newton;
mod stage;
mod stage_batch;

use crate::contact::{AXIAL, FREE};
use crate::dynamics::Dynamics;
use crate::integrate::{ImplicitVelocity, Stuck, System};

pub(crate) use linear::Damped;
use newton::{Newton, Solves, StageEquation};

/// A right-hand side whose velocities can be solved for, with the memory that takes.
#[derive(Debug)]
pub struct ImplicitDynamics<'d, 'm> {
    /// The right-hand side, of states of all bodies.
    pub dynamics: &'d mut Dynamics<'m>,
    newton: Box<dyn Solves>,
}

impl<'d, 'm> ImplicitDynamics<'d, 'm> {
    /// For the states of all bodies that `dynamics` takes.
    pub fn new(dynamics: &'d mut Dynamics<'m>) -> Self {
        let newton: Box<dyn Solves> = if dynamics.leans() {
            Box::new(Newton::<FREE>::new(dynamics))
        } else {
            Box::new(Newton::<AXIAL>::new(dynamics))
        };
        Self { dynamics, newton }
    }
}

impl System for ImplicitDynamics<'_, '_> {
    fn dim(&self) -> usize {
        self.dynamics.dim()
    }

    fn rhs(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        self.dynamics.rhs(t, y, dy);
    }
}

impl ImplicitVelocity for ImplicitDynamics<'_, '_> {
    fn solve_velocity(
        &mut self,
        t: f64,
        y: &mut [f64],
        base: &[f64],
        gamma_h: f64,
    ) -> Result<usize, Stuck> {
        let equation = StageEquation { base, gamma_h };
        self.newton.solve(self.dynamics, t, y, &equation)
    }
}

/// The truth is the right-hand side itself.
#[cfg(test)]
mod tests {
    use super::newton::{RESIDUAL_SHARE, velocity_limit};
    use super::stage::Velocity;
    use super::*;
    use crate::contact;
    use crate::scene::{
        Defect, Drive, Friction, Lubricant, Mount, NormalLaw, Slices, Spin, Texture, TimeFunction,
        Waviness, presets,
    };
    use crate::statics::compile;
    use crate::{BodyId, Dof, Model, Scene, Start, start};

    fn accelerations(model: &Model, y: &[f64]) -> Vec<f64> {
        let mut dy = vec![0.0; y.len()];
        Dynamics::new(model).rhs(0.0, y, &mut dy);
        dy.split_off(y.len() / 2)
    }

    /// A scene whose nodes weigh the same for friction as for the normal force: a stage holds what they weigh as it holds where
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

    /// (1 − γh ∂a/∂v) x = r holds for the correction x of any residual r, with ∂a/∂v by central differences.
    fn matrix_is_the_derivative<const N: usize>(scenes: &[Scene]) {
        for scene in scenes {
            let model = compiled(scene);
            let y = state(&model);
            let half = y.len() / 2;
            let mut dynamics = Dynamics::new(&model);
            let mut newton = Newton::<N>::new(&dynamics);
            newton.find_elements(&mut dynamics, 0.0, &y);
            let (work, views) = (&mut newton.stage, dynamics.views());
            work.forces(&dynamics, &views, true);
            let velocities: Vec<Velocity> = model
                .layout()
                .degrees()
                .enumerate()
                .filter_map(Velocity::of)
                .collect();
            let residual: Vec<f64> = (0..half).map(|i| (1.0 + i as f64).sin()).collect();
            for Velocity { at, body, place } in &velocities {
                work.residual[body.index()][*place] = residual[*at];
            }
            let gamma_h = 1e-6;
            work.factorise(&dynamics, &views, gamma_h);
            assert!(work.correct(&model));
            let mut x = vec![0.0; half];
            for Velocity { at, body, place } in &velocities {
                x[*at] = work.residual[body.index()][*place];
            }
            let size = x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let at = |step: f64| {
                let mut y = y.clone();
                for (v, x) in y[half..].iter_mut().zip(&x) {
                    *v += step * x / size;
                }
                accelerations(&model, &y)
            };
            let step = 1e-5;
            for (i, (up, down)) in at(step).into_iter().zip(at(-step)).enumerate() {
                let slope = (up - down) / (2.0 * step) * size;
                let off = x[i] - gamma_h * slope - residual[i];
                assert!(
                    off.abs() < 1e-5 * size,
                    "{}, state {i}: {off:e} of {size}",
                    scene.name
                );
            }
        }
    }

    /// What comes out solves the equation that was asked for: by a matrix of its own, and then, for a base and
    /// a guess elsewhere, by the one that is there.
    fn stage_solves_its_equation(scenes: &[Scene], steps: [f64; 2]) {
        for scene in scenes {
            let model = compiled(scene);
            let mut y = state(&model);
            let half = y.len() / 2;
            let mut dynamics = Dynamics::new(&model);
            let mut dynamics = ImplicitDynamics::new(&mut dynamics);
            // A fiftieth of what the tolerance sees.
            let limit = 0.02 / RESIDUAL_SHARE * velocity_limit(&model);
            for gamma_h in steps {
                let base: Vec<f64> = y[half..].iter().map(|v| 1.001 * v).collect();
                let solved = dynamics.solve_velocity(0.0, &mut y, &base, gamma_h);
                solved.unwrap();
                for (i, a) in accelerations(&model, &y).into_iter().enumerate() {
                    let off = y[half + i] - base[i] - gamma_h * a;
                    let (body, dof) = model.layout().degree(i);
                    let radius = if dof.is_rotation() {
                        model.radius(body)
                    } else {
                        1.0
                    };
                    assert!(
                        off.abs() * radius < limit,
                        "{}, γh {gamma_h}, velocity {i}: {off:e}",
                        scene.name
                    );
                }
            }
        }
    }

    #[test]
    fn the_matrix_is_the_derivative_of_the_accelerations() {
        matrix_is_the_derivative::<AXIAL>(&scenes());
        matrix_is_the_derivative::<AXIAL>(&[rolling()]);
    }

    #[test]
    fn the_matrix_is_the_derivative_in_oil() {
        matrix_is_the_derivative::<AXIAL>(&[oiled_wheel()]);
    }

    /// Those scenes with rings that tilt and rock, with balls that spin freely, and with both.
    fn spatial() -> Vec<Scene> {
        let all = || scenes().into_iter().chain([oiled_wheel(), rolling()]);
        let mut found: Vec<Scene> = all().map(|scene| spinning(&scene)).collect();
        found.extend(all().map(|scene| leaning(&scene)));
        found.extend(all().map(|scene| leaning(&spinning(&scene))));
        found
    }

    fn spinning(scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        scene.name.push_str(" spinning");
        scene.spin = Some(Spin::Free);
        scene
    }

    /// By so much that a matrix of parallel rings would be seen.
    fn leaning(scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        scene.name.push_str(" leaning");
        let support = &mut scene.inner_ring.support;
        (support.tilt_x, support.tilt_y) = (Some(Mount::Free), Some(Mount::Free));
        scene.outer_ring.tilt = Some([0.004, -0.006]);
        scene.inner_ring.centre_of_mass = Some(4e-3);
        scene
    }

    /// Balls that spin freely, all with a cap where they touch the outer race.
    fn capped() -> Scene {
        let mut scene = spinning(&scenes()[1]);
        let model = compiled(&scene);
        let y = start(&model, &Start::Equilibrium).unwrap();
        for ball in 0..model.balls.len() {
            let motion = model.layout().motion(&y, BodyId::ball(ball));
            let cap = Defect::cap(motion.direction() + 0.05, 1e-3, 0.3e-3)
                .on_ball(ball)
                .at_offset(0.5e-3);
            scene.defects.insert(format!("cap{ball}"), cap);
        }
        scene
    }

    #[test]
    fn the_matrix_is_the_derivative_in_space() {
        let mut scenes = spatial();
        for scene in &mut scenes {
            // Gyroscopic moments of the rings are not in the matrix.
            scene.drive = Drive::Speed(TimeFunction::Constant(1.0));
        }
        matrix_is_the_derivative::<FREE>(&scenes);
    }

    #[test]
    fn a_stage_solves_its_equation_in_space() {
        // With larger ones the iteration does not end in oil, and a run would take smaller steps.
        let steps = [1e-6, 0.95e-6];
        stage_solves_its_equation(&spatial(), steps);
        let capped = capped();
        let mut whole = capped.clone();
        whole.defects.clear();
        let of = |scene: &Scene| {
            let model = compiled(scene);
            let found = accelerations(&model, &state(&model));
            found[model.layout().at(BodyId::ball(4), Dof::TurnX)]
        };
        assert!(of(&capped) != of(&whole), "no cap is met");
        stage_solves_its_equation(&[leaning(&capped), capped], steps);
    }

    #[test]
    fn a_stage_solves_its_equation() {
        let steps = [2e-6, 1.9e-6];
        stage_solves_its_equation(&scenes(), steps);
        stage_solves_its_equation(&[rolling(), oiled_wheel()], steps);
    }
}
