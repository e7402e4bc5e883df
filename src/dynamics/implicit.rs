//! Implicit velocities: v = base + γh a(t, q, v) by Newton's method at fixed places.
//!
//! Friction is the stiffest part of the model, and linearising it once a step is not enough: within a step
//! slices go over from sticking to sliding. So the slices of every contact are found once
//! ([`Grip`]), and their forces are iterated on velocities alone. The matrix is an [`Arrow`] of a 4×4
//! block a ball and 8×8 for the rings; cage links and supports are in the residual, not in the matrix: their
//! damping is slow and converges by itself.

use nalgebra::{Matrix4, SVector, Vector4};
use rayon::prelude::*;

use super::arrow::Arrow;
use super::grip::{Grip, carried};
use super::state::Table;
use super::{Dynamics, motion};
use crate::contact::Law;
use crate::integrate::{ImplicitVelocity, Stuck};
use crate::model::{Degree, Model};

/// Iterations before a stage is given up and the step tried again smaller.
const MOST_ITERATIONS: usize = 20;

/// Ratio of one correction to that before it, above which the next one follows secants.
const DIVERGING: f64 = 0.7;

/// Residual of a velocity over what the tolerance sees of it.
const RESIDUAL_SHARE: f64 = 0.02;

/// Memory of the iteration.
#[derive(Debug, Clone)]
pub(super) struct Implicit {
    /// Contacts with outer and inner race, by ball.
    grips: Vec<[Grip; 2]>,
    arrow: Arrow,
    residual: Vec<Vector4<f64>>,
    slopes: Vec<[Matrix4<f64>; 2]>,
    /// Whether slopes are secants, since tangents led astray.
    secant: bool,
}

impl Implicit {
    fn new(balls: usize) -> Self {
        Self {
            grips: vec![<[Grip; 2]>::default(); balls],
            arrow: Arrow::new(balls),
            residual: vec![Vector4::zeros(); balls + 2],
            slopes: vec![[Matrix4::zeros(); 2]; balls],
            secant: false,
        }
    }

    /// Finds the slices of all contacts.
    fn grip(&mut self, dynamics: &Dynamics<'_>, y: &[f64]) {
        let model = dynamics.model;
        let rings = [motion(y, 0), motion(y, 1)];
        let find = |(j, grips): (usize, &mut [Grip; 2])| {
            let ball = &model.balls[j];
            let place = motion(y, 2 + j);
            for ((grip, ring), pair) in grips
                .iter_mut()
                .zip(&rings)
                .zip(&model.rows[ball.row].pairs)
            {
                let flat = matches!(pair.law, Law::Hertz(_));
                grip.open(ball.side.radius, flat, place.centre - ring.centre);
                pair.evaluate(&ball.side, &place, ring, grip);
            }
        };
        match &dynamics.pool {
            Some(pool) => pool.install(|| self.grips.par_iter_mut().enumerate().for_each(find)),
            None => self.grips.iter_mut().enumerate().for_each(find),
        }
    }

    /// Contact forces on all bodies at the velocities of `y`, with their slopes by the twists.
    fn contacts(&mut self, model: &Model, y: &[f64], forces: &mut Table) {
        for (j, ball) in model.balls.iter().enumerate() {
            for (s, pair) in model.rows[ball.row].pairs.iter().enumerate() {
                let grip = &self.grips[j][s];
                if grip.is_empty() {
                    continue;
                }
                let carried = carried(grip.apart);
                let twist = velocity(y, 2 + j) - carried * velocity(y, s);
                let (wrench, slope) = grip.wrench_and_slope(pair, &twist, self.secant);
                forces.add(2 + j, &wrench.into());
                forces.add(s, &(-carried.tr_mul(&wrench)).into());
                self.slopes[j][s] = slope;
            }
        }
    }

    /// Solves for the correction of all velocities; `residual` is replaced by it. False if singular.
    fn correct(&mut self, model: &Model, gamma_h: f64) -> bool {
        let scales = [0, 1].map(|s| mobility(model, s) * gamma_h);
        let mut diagonal = SVector::<f64, 8>::repeat(1.0);
        let mut right = SVector::<f64, 8>::zeros();
        for s in 0..2 {
            right
                .fixed_rows_mut::<4>(4 * s)
                .copy_from(&self.residual[s]);
            for i in 0..4 {
                if let Degree::Free { damping, .. } = model.bodies[s].degrees[i] {
                    diagonal[4 * s + i] += scales[s][i] * damping;
                }
            }
        }
        self.arrow.begin(&diagonal, &right);
        for (j, grips) in self.grips.iter().enumerate() {
            let right = &self.residual[2 + j];
            if grips.iter().all(Grip::is_empty) {
                self.arrow.pass(right);
                continue;
            }
            let scale = mobility(model, 2 + j) * gamma_h;
            let mut own = Matrix4::identity();
            let (mut to, mut from) = ([Matrix4::zeros(); 2], [Matrix4::zeros(); 2]);
            for s in 0..2 {
                if grips[s].is_empty() {
                    continue;
                }
                let slope = &self.slopes[j][s];
                let carried = carried(grips[s].apart);
                let ring = scaled(&scales[s], carried.tr_mul(slope));
                let ball = scaled(&scale, *slope);
                own -= ball;
                to[s] = ball * carried;
                from[s] = ring;
                self.arrow.add_ring(s, &(-ring * carried));
            }
            if !self.arrow.eliminate(&own, &to, &from, right) {
                return false;
            }
        }
        let Some(rings) = self.arrow.rings() else {
            return false;
        };
        for s in 0..2 {
            self.residual[s] = rings.fixed_rows::<4>(4 * s).into();
        }
        for j in 0..self.grips.len() {
            self.residual[2 + j] = self.arrow.ball(j, &rings);
        }
        true
    }
}

impl Dynamics<'_> {
    /// The residual base + γh a − v into `implicit`.
    fn residual(&mut self, t: f64, y: &[f64], base: &[f64], gamma_h: f64, work: &mut Implicit) {
        let model = self.model;
        self.read(t, y);
        self.forces.copy_from(&self.constant);
        work.contacts(model, y, &mut self.forces);
        self.others(t);
        for (b, residual) in work.residual.iter_mut().enumerate() {
            let base = Vector4::from_column_slice(&base[4 * b..4 * b + 4]);
            let acceleration = Vector4::from(self.acceleration(t, b));
            *residual = base + acceleration * gamma_h - velocity(y, b);
        }
    }

    fn iterate(
        &mut self,
        t: f64,
        y: &mut [f64],
        base: &[f64],
        gamma_h: f64,
        work: &mut Implicit,
    ) -> Result<usize, Stuck> {
        let half = y.len() / 2;
        let limit = self.velocity_limit();
        let (mut worst, mut before) = (0, 0.0);
        work.secant = false;
        for iteration in 1..=MOST_ITERATIONS {
            self.residual(t, y, base, gamma_h, work);
            if !work.correct(self.model, gamma_h) {
                break;
            }
            let mut largest = 0.0;
            for (b, correction) in work.residual.iter().enumerate() {
                let radius = self.model.radius(b);
                for i in 0..4 {
                    y[half + 4 * b + i] += correction[i];
                    let size = correction[i].abs() * if i == 3 { radius } else { 1.0 };
                    if size > largest || size.is_nan() {
                        (largest, worst) = (size, half + 4 * b + i);
                    }
                }
            }
            // What is left after a correction, by the rate at which they shrink (Hairer & Wanner II, IV.8).
            let rate = largest / before;
            if largest <= limit || rate < 1.0 && largest * rate / (1.0 - rate) <= limit {
                return Ok(iteration);
            }
            work.secant = rate > DIVERGING && before > 0.0;
            before = largest;
        }
        Err(Stuck {
            state: worst,
            iterations: MOST_ITERATIONS,
        })
    }

    fn implicit_memory(&mut self) -> Box<Implicit> {
        let balls = self.model.balls.len();
        self.implicit
            .take()
            .unwrap_or_else(|| Box::new(Implicit::new(balls)))
    }

    /// The change of a velocity \[m/s\] below which an iteration is over.
    fn velocity_limit(&self) -> f64 {
        let scales = &self.model.scales;
        RESIDUAL_SHARE * self.model.scene.solver.rtol * scales.approach * scales.frequency
    }
}

impl ImplicitVelocity for Dynamics<'_> {
    fn solve_velocity(
        &mut self,
        t: f64,
        y: &mut [f64],
        base: &[f64],
        gamma_h: f64,
    ) -> Result<usize, Stuck> {
        let mut work = self.implicit_memory();
        work.grip(self, y);
        let result = self.iterate(t, y, base, gamma_h, &mut work);
        self.implicit = Some(work);
        result
    }

    fn fastest_rate(&mut self, _t: f64, y: &[f64]) -> f64 {
        let mut work = self.implicit_memory();
        work.grip(self, y);
        work.slopes.fill([Matrix4::zeros(); 2]);
        work.secant = false;
        work.contacts(self.model, y, &mut self.forces);
        let rates = work.slopes.iter().enumerate().map(|(j, slopes)| {
            let mobility = mobility(self.model, 2 + j);
            let root = Matrix4::from_diagonal(&mobility.map(f64::sqrt));
            let block = root * (slopes[0] + slopes[1]) * root;
            // Friction's part is symmetric, damping's nearly: the spectral norm of the symmetric part.
            let symmetric = (block + block.transpose()) / 2.0;
            symmetric.symmetric_eigenvalues().amax()
        });
        let fastest = rates.fold(0.0, f64::max);
        self.implicit = Some(work);
        fastest
    }
}

/// The rows of a matrix, each times its scale.
fn scaled(scale: &Vector4<f64>, mut matrix: Matrix4<f64>) -> Matrix4<f64> {
    for mut column in matrix.column_iter_mut() {
        column.component_mul_assign(scale);
    }
    matrix
}

/// One over the mass of every degree that forces move.
fn mobility(model: &Model, body: usize) -> Vector4<f64> {
    let body = &model.bodies[body];
    Vector4::from_fn(|i, _| match body.degrees[i] {
        Degree::Free { .. } => 1.0 / body.mass[i],
        Degree::Fixed | Degree::Driven => 0.0,
    })
}

fn velocity(y: &[f64], body: usize) -> Vector4<f64> {
    let half = y.len() / 2;
    Vector4::from_column_slice(&y[half + 4 * body..half + 4 * body + 4])
}

/// The truth is the right-hand side itself.
#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrate::System;
    use crate::scene::{Friction, presets};
    use crate::{Scene, Start, start};

    fn accelerations(model: &Model, y: &[f64]) -> Vec<f64> {
        let mut dy = vec![0.0; y.len()];
        Dynamics::new(model).rhs(0.0, y, &mut dy);
        dy.split_off(y.len() / 2)
    }

    /// A state off any symmetry, in motion.
    fn state(model: &Model) -> Vec<f64> {
        let mut y = start(model, &Start::Equilibrium).unwrap();
        let half = y.len() / 2;
        for (i, v) in y[half..].iter_mut().enumerate() {
            *v += 0.02 * (i as f64).sin() * if i % 4 == 3 { 100.0 } else { 1.0 };
        }
        y
    }

    fn scenes() -> Vec<Scene> {
        let mut wheel = presets::wheel_bearing(3000.0);
        let mut hertz = presets::deep_groove_6205(2000.0, 500.0, 1800.0);
        (wheel.cage, hertz.cage) = (None, None);
        // Under a loaded ball at the start.
        let spall = wheel.defects.get_mut("spall").unwrap();
        (spall.angle, spall.axial_offset) = (-1.6, 2.0e-3);
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
        vec![wheel, hertz, traction]
    }

    /// (1 − γh ∂a/∂v) x = r holds for the correction x of any residual r, with ∂a/∂v by central differences.
    #[test]
    fn the_matrix_is_the_derivative_of_the_accelerations() {
        for scene in scenes() {
            let model = Model::new(&scene).unwrap();
            let y = state(&model);
            let half = y.len() / 2;
            let mut dynamics = Dynamics::new(&model);
            let mut work = dynamics.implicit_memory();
            work.grip(&dynamics, &y);
            work.contacts(&model, &y, &mut dynamics.forces);
            let residual: Vec<f64> = (0..half).map(|i| (1.0 + i as f64).sin()).collect();
            for (b, r) in work.residual.iter_mut().enumerate() {
                *r = Vector4::from_column_slice(&residual[4 * b..4 * b + 4]);
            }
            let gamma_h = 1e-6;
            assert!(work.correct(&model, gamma_h));
            let x: Vec<f64> = work
                .residual
                .iter()
                .flat_map(|x| x.iter().copied())
                .collect();
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

    /// What comes out solves the equation that was asked for.
    #[test]
    fn a_stage_solves_its_equation() {
        for scene in scenes() {
            let model = Model::new(&scene).unwrap();
            let mut y = state(&model);
            let half = y.len() / 2;
            let base = y[half..].to_vec();
            let mut dynamics = Dynamics::new(&model);
            let gamma_h = 2e-6;
            dynamics
                .solve_velocity(0.0, &mut y, &base, gamma_h)
                .unwrap();
            let limit = dynamics.velocity_limit();
            for (i, a) in accelerations(&model, &y).into_iter().enumerate() {
                let off = y[half + i] - base[i] - gamma_h * a;
                let radius = if i % 4 == 3 { model.radius(i / 4) } else { 1.0 };
                assert!(
                    off.abs() * radius < limit,
                    "{}, velocity {i}: {off:e}",
                    scene.name
                );
            }
        }
    }
}
