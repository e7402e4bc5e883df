//! Adams' predictor–corrector for second-order systems: one evaluation a step.
//!
//! For q' = v, v' = a(t, q, v) the accelerations of the last steps are joined by a polynomial. Its integral predicts
//! the velocities, its double integral the positions (Störmer's formulae); there the system is evaluated once, and the
//! polynomial through the new acceleration as well corrects both. Of order four from the third step on, with steps of
//! any length.
//!
//! *Linearly implicit.* Where velocities decay faster than a step, the evaluation at a predicted velocity has an error
//! that grows from step to step. It is known to first order: with x the correction of the velocity,
//! the acceleration at the corrected one is a + (∂a/∂v) x. The place is corrected along with the velocity, by βh/γ x, since
//! both corrections come from that of the acceleration. Hence (1 − γh ∂a/∂v − βh² ∂a/∂q) x = r with r the correction as the
//! evaluation gave it ([`LinearlyImplicit::solve`]). Approximate derivatives do: x is as small as the error of the
//! prediction, so what is wrong in the matrix lowers no order. With them the method is as stable as its corrector: to −3 on
//! the real axis (without, to −0.3); oscillations with half a percent of damping to ωh = 0.89, with five percent to 1.53
//! (without, to 0.68 and 1.02; `tests/accuracy/stability_region.rs`). Velocities that decay faster than that are left to backward
//! differences (`blended.rs`).
//!
//! Source: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., sections III.5 (steps of any
//! length) and III.10 (Störmer); for inexact matrices Steihaug & Wolfbrandt (1979), Math. Comp. 33, 521–534.

use super::LinearlyImplicit;
use super::blended;
use super::combine::{Each, halves, pass};
use super::control::Controller;
use super::failure::Invalid;
use super::method::{Sealed, StepMethod};
use super::multistep::{Formulae, History, KnownWeights, NEW, NODES};
use super::step::Stepper;
use super::tableau::Tableau;
use crate::simd::{Simd, Vector};

/// The method, for states \[q, v\]; see above. After a start and after every breakpoint the first two steps are of lower order,
/// which the error estimate keeps short; with fixed steps ([`Options::fixed_step`](super::Options::fixed_step)) nothing does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Adams;

impl Adams {
    /// Name of the method.
    pub(crate) const NAME: &'static str = "Adams predictor-corrector";
}

/// Coefficients that the driver asks for; those of a step follow from the lengths of the last ones.
const TABLEAU: Tableau = Tableau {
    name: Adams::NAME,
    order: 4,
    error_order: 3,
    stages: NODES,
    c: &[0.0, 0.0, 0.0, 1.0],
    a: &[&[], &[], &[], &[]],
    b: &[0.0; NODES],
    b_err: &[0.0; NODES],
    fsal: true,
    dense: &[[0.0; NODES]; NODES],
    stability_limit: f64::INFINITY,
};

impl Sealed for Adams {}

impl<S: LinearlyImplicit> StepMethod<S> for Adams {
    fn tableau(&self) -> &Tableau {
        &TABLEAU
    }

    fn check(&self, dim: usize, _fixed: bool) -> Result<(), Invalid> {
        if dim.is_multiple_of(2) {
            return Ok(());
        }
        Err(Invalid("states [q, v] are even in number"))
    }

    /// A step that grows more than twofold would extrapolate from accelerations too close to each other.
    fn controller(&self) -> Controller {
        Controller {
            max_factor: 2.0,
            least_growth: 1.1,
            ..Controller::for_order(TABLEAU.error_order)
        }
    }

    fn is_multistep(&self) -> bool {
        true
    }

    fn attempt(
        &self,
        work: &mut Stepper<'_>,
        system: &mut S,
        _t: f64,
        t1: f64,
        h: f64,
        latest: f64,
    ) -> Result<(), usize> {
        let history = work.history.get_or_insert_with(History::new);
        history.attempt(h, system.relaxation(), system.longest());
        let (formulae, is_blended) = (history.formulae, history.is_blended);
        predict(work, h, &formulae);
        let t1 = t1.min(latest);
        if is_blended {
            return blended::attempt(work, system, t1, h, &formulae);
        }
        work.evaluate(system, t1)?;
        correct(work, system, t1, h, &formulae);
        Ok(())
    }
}

/// Fills the stage, and for a while the error's velocities with the predicted accelerations.
fn predict(work: &mut Stepper<'_>, h: f64, formulae: &Formulae) {
    let half = work.y.len() / 2;
    let known = [0, 1, 2].map(|i| &work.k[i][half..]);
    let [q, v] = halves(&mut work.stage);
    let [_, a] = halves(&mut work.error);
    let weights = formulae.predicted;
    pass(
        &Prediction { h, weights },
        [q, v, a],
        [
            &work.y[..half],
            &work.y[half..],
            known[0],
            known[1],
            known[2],
        ],
    );
}

/// Fills the new state, its derivative and the error by the correction of the velocity.
fn correct<S: LinearlyImplicit>(
    work: &mut Stepper<'_>,
    system: &mut S,
    t1: f64,
    h: f64,
    formulae: &Formulae,
) {
    let half = work.y.len() / 2;
    let (gamma_h, reach) = (formulae.gamma * h, formulae.reach * h);
    let correction = &mut work.y1[half..];
    let accelerations = work.k[NEW][half..].iter().zip(&work.error[half..]);
    for (r, (new, predicted)) in correction.iter_mut().zip(accelerations) {
        *r = (new - predicted) * gamma_h;
    }
    system.prepare(t1, &work.stage, gamma_h, reach);
    system.solve(correction);
    let [q1, x] = halves(&mut work.y1);
    let [rates, new] = halves(&mut work.k[NEW]);
    let [of_q, of_v] = halves(&mut work.error);
    let correction = Correction {
        reach,
        gamma_h,
        errors: [h * formulae.errors[0], formulae.errors[1]],
    };
    let predicted = [&work.stage[..half], &work.stage[half..]];
    pass(&correction, [q1, x, rates, new, of_q, of_v], predicted);
}

/// Position, velocity and acceleration, from those at the beginning of a step and three accelerations.
struct Prediction {
    h: f64,
    weights: [KnownWeights; 3],
}

impl Each<5, 3> for Prediction {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        _: [Vector<S>; 3],
        [q, v, first, second, third]: [Vector<S>; 5],
    ) -> [Vector<S>; 3] {
        let h = q.same(self.h);
        let mut sums = [q; 3];
        for (sum, [a, b, c]) in sums.iter_mut().zip(self.weights) {
            *sum = first.mul_add(q.same(a), second.mul_add(q.same(b), third * c));
        }
        let [place, velocity, acceleration] = sums;
        let moved = h.mul_add(place, v);
        [h.mul_add(moved, q), h.mul_add(velocity, v), acceleration]
    }
}

/// New positions and velocities, their derivatives and errors, from what was predicted and the correction of the velocity. This stands where
/// the new velocity belongs, the predicted acceleration where its error belongs, the evaluated one where the new one belongs.
struct Correction {
    reach: f64,
    gamma_h: f64,
    errors: [f64; 2],
}

impl Each<2, 6> for Correction {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [_, x, _, evaluated, _, predicted]: [Vector<S>; 6],
        [q, v]: [Vector<S>; 2],
    ) -> [Vector<S>; 6] {
        let velocity = v + x;
        // Of an acceleration that was not corrected nothing is left: one of 0 would else decay, through numbers that are slow.
        let damped = x - (evaluated - predicted) * self.gamma_h;
        [
            x.mul_add(x.same(self.reach), q),
            velocity,
            velocity,
            damped.mul_add(x.same(self.gamma_h.recip()), evaluated),
            x * self.errors[0],
            x * self.errors[1],
        ]
    }
}
