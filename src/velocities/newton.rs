//! Newton's iteration for the velocities of a stage.

use super::stage::{Largest, Stage, Velocity};
use crate::contact::attitude_accelerations;
use crate::dynamics::Dynamics;
use crate::integrate::Stuck;
use crate::model::{BodyId, DOFS, Dof, Layout, Model};

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
pub(super) const RESIDUAL_SHARE: f64 = 0.002;

/// What solves for velocities, of bodies of any number of directions.
pub(super) trait Solves: std::fmt::Debug {
    /// As [`crate::integrate::ImplicitVelocity::solve_velocity`].
    fn solve(
        &mut self,
        dynamics: &mut Dynamics<'_>,
        t: f64,
        y: &mut [f64],
        stage: &StageEquation<'_>,
    ) -> Result<usize, Stuck>;
}

/// v = base + γh a.
#[derive(Debug, Clone, Copy)]
pub(super) struct StageEquation<'a> {
    pub base: &'a [f64],
    pub gamma_h: f64,
}

/// The memory that it takes.
#[derive(Debug)]
pub(super) struct Newton<const N: usize> {
    pub stage: Stage<N>,
    /// Velocities beside the directions that every body has.
    across: Vec<Velocity>,
    accelerations: Vec<f64>,
}

impl<const N: usize> Newton<N> {
    pub fn new(dynamics: &Dynamics<'_>) -> Self {
        let model = dynamics.model();
        let velocities = model.layout().degrees().enumerate();
        Self {
            stage: Stage::new(model, dynamics.rows_in_motion()),
            across: velocities
                .filter_map(Velocity::of)
                .filter(|velocity| velocity.place >= DOFS)
                .collect(),
            accelerations: vec![0.0; model.layout().half()],
        }
    }

    /// Finds the nodes of all contacts at the places of a state.
    pub fn find_elements(&mut self, dynamics: &mut Dynamics<'_>, t: f64, y: &[f64]) {
        dynamics.look(t, y);
        self.stage.find_elements(dynamics, &dynamics.views());
        self.stage.slopes.secant = false;
    }

    /// The residual base + γh a − v with the last reactions of the contacts.
    fn residual(
        &mut self,
        dynamics: &mut Dynamics<'_>,
        t: f64,
        y: &[f64],
        StageEquation { base, gamma_h }: &StageEquation<'_>,
    ) {
        dynamics.sum_with(t, &self.stage);
        dynamics.accelerate(t, &mut self.accelerations);
        let (a, v) = (&self.accelerations, &y[y.len() / 2..]);
        let [bases, velocities, accelerations] = [base, v, a].map(Layout::each);
        let residuals = &mut self.stage.residual;
        for (b, residual) in residuals.iter_mut().enumerate() {
            for i in 0..DOFS {
                residual[i] = bases[b][i] + accelerations[b][i] * gamma_h - velocities[b][i];
            }
        }
        for Velocity { at, body, place } in &self.across {
            residuals[body.index()][*place] = base[*at] + a[*at] * gamma_h - v[*at];
        }
    }
}

impl<const N: usize> Solves for Newton<N> {
    fn solve(
        &mut self,
        dynamics: &mut Dynamics<'_>,
        t: f64,
        y: &mut [f64],
        equation: &StageEquation<'_>,
    ) -> Result<usize, Stuck> {
        self.find_elements(dynamics, t, y);
        let (model, gamma_h) = (dynamics.model(), equation.gamma_h);
        let limit = velocity_limit(model);
        let half = y.len() / 2;
        let mut worst = Largest::default();
        // Not a number: comparisons with it are false.
        let mut before = f64::NAN;
        let mut anew = !self.stage.is_kept(gamma_h);
        for iteration in 1..=MOST_ITERATIONS {
            if iteration > 1 {
                dynamics.look(t, y);
            }
            self.stage.forces(dynamics, &dynamics.views(), anew);
            self.residual(dynamics, t, y, equation);
            if anew {
                self.stage.factorise(dynamics, &dynamics.views(), gamma_h);
            }
            if !self.stage.correct(model) {
                break;
            }
            worst = self.stage.apply(&mut y[half..], &self.across);
            // What is left after a correction, by the rate at which they shrink (Hairer & Wanner II, IV.8).
            let (size, rate) = (worst.size, worst.size / before);
            if size <= limit || rate < 1.0 && size * rate / (1.0 - rate) <= limit {
                if rate > WORN {
                    self.stage.kept = None;
                }
                tumble(model, y, equation);
                return Ok(iteration);
            }
            (anew, self.stage.slopes.secant) = (rate > SLOW, rate > DIVERGING);
            before = size;
        }
        self.stage.kept = None;
        Err(Stuck {
            state: half + worst.velocity,
            iterations: MOST_ITERATIONS,
        })
    }
}

/// The change of a velocity \[m/s\] below which an iteration is over.
pub(super) fn velocity_limit(model: &Model) -> f64 {
    let scales = &model.scales;
    RESIDUAL_SHARE * model.scene.solver.rtol * scales.approach * scales.frequency
}

/// Writes the rates of Euler parameters, which no force depends on, once it is known how their balls turn.
fn tumble(model: &Model, y: &mut [f64], StageEquation { base, gamma_h }: &StageEquation<'_>) {
    let (layout, k) = (model.layout(), model.attitude_rate());
    for ball in layout.tumbling().map(BodyId::ball) {
        let e = Dof::ATTITUDE.map(|dof| y[layout.at(ball, dof)]);
        let turns = [Dof::TurnX, Dof::TurnY, Dof::Theta];
        let turning = turns.map(|dof| y[layout.speed_at(ball, dof)]);
        let rates =
            turns.map(|dof| (y[layout.speed_at(ball, dof)] - base[layout.at(ball, dof)]) / gamma_h);
        // They answer to their own rates by −2 k alone.
        let found = attitude_accelerations(&rates.into(), &turning.into(), [e, [0.0; 4]], k);
        for (dof, found) in Dof::ATTITUDE.into_iter().zip(found) {
            let rate = (base[layout.at(ball, dof)] + gamma_h * found) / (1.0 + 2.0 * k * gamma_h);
            y[layout.speed_at(ball, dof)] = rate;
        }
    }
}
