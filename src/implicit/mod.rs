//! Implicit velocities: v = base + γh a(t, q, v) by Newton's method at fixed places.
//!
//! Friction is the stiffest part of the model, and linearising it once a step is not enough: within a step
//! slices go over from sticking to sliding. So the nodes of every contact are found once a stage
//! (`stage.rs`), and their forces are iterated on velocities alone. The matrix is an arrow
//! (`arrow.rs`) of a 4×4 block a ball and 8×8 for the rings; cage links and supports are in the residual, not in
//! the matrix: their damping is slow and converges by itself. A matrix serves as many stages and steps as
//! corrections by it shrink fast, which at a steady roll are many.

mod arrow;
mod linear;
mod stage;
mod stage_batch;

use nalgebra::{Matrix4, Vector4};

use crate::contact::AXIAL;
use crate::dynamics::{Dynamics, View};
use crate::integrate::{ImplicitVelocity, Stuck, System};
use crate::model::{BodyId, DOFS, Layout, Race};

pub(crate) use linear::Damped;
use stage::{Largest, Stage};
use stage_batch::Velocities;

/// Iterations before a stage is given up and the step tried again smaller.
const MOST_ITERATIONS: usize = 20;

/// Size of a correction over that of the one before it, above which the next stage gets a new matrix.
const WORN: f64 = 0.1;

/// The same ratio, above which the next correction of this stage gets a new matrix.
const SLOW: f64 = 0.3;

/// The same ratio, above which that new matrix is made of secants.
const DIVERGING: f64 = 0.7;

/// Error of a velocity at which corrections end, over the one that the tolerance allows. With ten times as much, the
/// accelerations show it at loose tolerances; one more correction costs less than smaller steps.
const RESIDUAL_SHARE: f64 = 0.002;

/// A right-hand side whose velocities can be solved for, with the memory that takes.
#[derive(Debug)]
pub struct ImplicitDynamics<'d, 'm> {
    /// The right-hand side, of states of all bodies.
    pub dynamics: &'d mut Dynamics<'m>,
    stage: Stage<AXIAL>,
}

impl<'d, 'm> ImplicitDynamics<'d, 'm> {
    /// For the states of all bodies that `dynamics` takes.
    pub fn new(dynamics: &'d mut Dynamics<'m>) -> Self {
        let stage = Stage::new(dynamics.model(), dynamics.rows_in_motion());
        Self { dynamics, stage }
    }

    /// The fastest rate \[1/s\] at which friction and damping let velocities decay, or a bound not far above it.
    pub(crate) fn fastest_rate(&mut self, t: f64, y: &[f64]) -> f64 {
        self.find_elements(t, y);
        self.stage.secant = false;
        self.stage.forces(self.dynamics, &Velocities::Of(y), true);
        let mobility = &self.dynamics.model().mobility;
        let mut fastest: f64 = 0.0;
        for batch in self.stage.batches() {
            for (lane, ball) in batch.balls[..batch.count].iter().enumerate() {
                let mobility = Vector4::from(mobility[BodyId::ball(*ball)]);
                let root = Matrix4::from_diagonal(&mobility.map(f64::sqrt));
                let slope = |i: usize, j: usize| {
                    let of = |race: Race| batch.sides[race].wrenches.slope[i][j][lane];
                    of(Race::Outer) + of(Race::Inner)
                };
                let block = root * Matrix4::from_fn(slope) * root;
                // Friction's part is symmetric, damping's nearly: the spectral norm of the symmetric part.
                let symmetric = (block + block.transpose()) / 2.0;
                fastest = fastest.max(symmetric.symmetric_eigenvalues().amax());
            }
        }
        fastest
    }

    /// Finds the nodes of all contacts at the places of a state.
    fn find_elements(&mut self, t: f64, y: &[f64]) {
        self.dynamics.read(t, y);
        self.stage
            .find_elements(self.dynamics, &View::parallel(self.dynamics.state()));
    }

    /// The residual base + γh a − v with the last reactions of the contacts.
    fn residual(&mut self, t: f64, y: &[f64], base: &[f64], gamma_h: f64) {
        let Self { dynamics, stage } = self;
        dynamics.sum_with(t, y, |forces| stage.add_to(forces));
        let (bases, velocities) = (Layout::each(base), Layout::each(&y[y.len() / 2..]));
        let bodies = bases.iter().zip(velocities).enumerate();
        for (residual, (b, (base, v))) in stage.residual.iter_mut().zip(bodies) {
            let acceleration = dynamics.acceleration(t, BodyId::new(b));
            for i in 0..DOFS {
                residual[i] = base[i] + acceleration[i] * gamma_h - v[i];
            }
        }
    }

    fn iterate(
        &mut self,
        t: f64,
        y: &mut [f64],
        base: &[f64],
        gamma_h: f64,
    ) -> Result<usize, Stuck> {
        let model = self.dynamics.model();
        let limit = self.velocity_limit();
        let half = y.len() / 2;
        let mut worst = Largest::default();
        // Not a number: comparisons with it are false.
        let mut before = f64::NAN;
        let mut anew = !self.stage.is_kept(gamma_h);
        self.stage.secant = false;
        for iteration in 1..=MOST_ITERATIONS {
            self.stage.forces(self.dynamics, &Velocities::Of(y), anew);
            self.residual(t, y, base, gamma_h);
            if anew {
                self.stage.factorise(model, gamma_h);
            }
            if !self.stage.correct(model) {
                break;
            }
            worst = self.stage.apply(&mut y[half..]);
            // What is left after a correction, by the rate at which they shrink (Hairer & Wanner II, IV.8).
            let (size, rate) = (worst.size, worst.size / before);
            if size <= limit || rate < 1.0 && size * rate / (1.0 - rate) <= limit {
                if rate > WORN {
                    self.stage.kept = None;
                }
                return Ok(iteration);
            }
            (anew, self.stage.secant) = (rate > SLOW, rate > DIVERGING);
            before = size;
        }
        self.stage.kept = None;
        Err(Stuck {
            state: half + worst.velocity,
            iterations: MOST_ITERATIONS,
        })
    }

    /// The change of a velocity \[m/s\] below which an iteration is over.
    fn velocity_limit(&self) -> f64 {
        let model = self.dynamics.model();
        let scales = &model.scales;
        RESIDUAL_SHARE * model.scene.solver.rtol * scales.approach * scales.frequency
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
        self.find_elements(t, y);
        self.iterate(t, y, base, gamma_h)
    }
}

/// The truth is the right-hand side itself.
#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact;
    use crate::equilibrium::compile;
    use crate::scene::{Friction, Lubricant, NormalLaw, Slices, Waviness, presets};
    use crate::{Model, Scene, Start, start};

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
            if let contact::Slices::Fitted(rules) = &pair.slices {
                let exponent = pair.law.elastic.exponent();
                let plain = contact::Rules::for_friction(rules.count(), exponent, 0);
                pair.slices = contact::Slices::Fitted(plain);
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
    fn matrix_is_the_derivative(scenes: &[Scene]) {
        for scene in scenes {
            let model = compiled(scene);
            let y = state(&model);
            let half = y.len() / 2;
            let mut dynamics = Dynamics::new(&model);
            let mut implicit = ImplicitDynamics::new(&mut dynamics);
            implicit.find_elements(0.0, &y);
            let ImplicitDynamics {
                dynamics,
                stage: mut work,
            } = implicit;
            work.forces(dynamics, &Velocities::Of(&y), true);
            let residual: Vec<f64> = (0..half).map(|i| (1.0 + i as f64).sin()).collect();
            work.residual.copy_from_slice(Layout::each(&residual));
            let gamma_h = 1e-6;
            work.factorise(&model, gamma_h);
            assert!(work.correct(&model));
            let x = work.residual.as_flattened().to_vec();
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
    fn stage_solves_its_equation(scenes: &[Scene]) {
        for scene in scenes {
            let model = compiled(scene);
            let mut y = state(&model);
            let half = y.len() / 2;
            let mut dynamics = Dynamics::new(&model);
            let mut dynamics = ImplicitDynamics::new(&mut dynamics);
            // A fiftieth of what the tolerance sees.
            let limit = 0.02 / RESIDUAL_SHARE * dynamics.velocity_limit();
            for gamma_h in [2e-6, 1.9e-6] {
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
        matrix_is_the_derivative(&scenes());
        matrix_is_the_derivative(&[rolling()]);
    }

    #[test]
    fn the_matrix_is_the_derivative_in_oil() {
        matrix_is_the_derivative(&[oiled_wheel()]);
    }

    #[test]
    fn a_stage_solves_its_equation() {
        stage_solves_its_equation(&scenes());
        stage_solves_its_equation(&[rolling(), oiled_wheel()]);
    }
}
