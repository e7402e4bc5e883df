//! Adams' predictor–corrector for second-order systems: one evaluation a step.
//!
//! For q' = v, v' = a(t, q, v) the accelerations of the last steps are joined by a polynomial. Its integral foretells
//! the velocities, its double integral the positions (Störmer's formulae); there the system is evaluated once, and the
//! polynomial through the new acceleration as well corrects both. Of order four from the third step on, with steps of
//! any length.
//!
//! *Linearly implicit.* Where velocities die down faster than a step, the evaluation at a foretold velocity answers
//! with a kick that grows from step to step. The kick is known to first order: with x the correction of the velocity,
//! the acceleration at the corrected one is a + (∂a/∂v) x, hence (1 − γh ∂a/∂v) x = r with r the correction as the
//! evaluation gave it ([`LinearlyImplicit::damp`]). An approximate ∂a/∂v does: x is as small as the error of the
//! prediction, so what is wrong in the matrix lowers no order. With it the method is as stable as its corrector: to −3 on
//! the real axis; without, to −0.3.
//!
//! Source: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., sections III.5 (steps of any
//! length) and III.10 (Störmer); for inexact matrices Steihaug & Wolfbrandt (1979), Math. Comp. 33, 521–534.

use super::System;
use super::combine::combine;
use super::control::Controller;
use super::method::Method;
use super::multistep::{History, NODES, Weights, advance, at, integrals};
use super::step::{Stepper, check_finite};
use super::tableau::Tableau;

/// A second-order system that knows roughly how its accelerations answer to velocities.
///
/// The state is \[q, v\], each half of [`System::dim`].
pub trait LinearlyImplicit: System {
    /// Replaces r by the solution x of (1 − γh ∂a/∂v) x = r, with ∂a/∂v from the state `y` or one not long before.
    ///
    /// Leaving r as it is makes the method explicit.
    fn damp(&mut self, t: f64, y: &[f64], gamma_h: f64, r: &mut [f64]);
}

/// The method, for states \[q, v\]; see above. After a start and after every breakpoint the first two steps are of lower order,
/// which the error estimate keeps short; with fixed steps ([`Options::fixed_step`](super::Options::fixed_step)) nothing does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Adams;

/// What the driver asks for; the coefficients of a step follow from the lengths of the last ones.
const TABLEAU: Tableau = Tableau {
    name: "Adams predictor-corrector",
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

impl<S: LinearlyImplicit> Method<S> for Adams {
    fn tableau(&self) -> &Tableau {
        &TABLEAU
    }

    /// A step that grows more than twofold would lean on accelerations too close to each other.
    fn controller(&self) -> Controller {
        Controller {
            max_factor: 2.0,
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
        (_, t1): (f64, f64),
        h: f64,
        latest: f64,
    ) -> Result<(), usize> {
        let history = *work.history.get_or_insert_with(History::new);
        let (known, times) = (history.known, history.times(h));
        let t1 = t1.min(latest);
        foretell(work, h, &integrals(&times[1..=known]), known);
        system.rhs(t1, &work.stage, &mut work.k[NEW]);
        work.calls += 1;
        check_finite(&work.k[NEW])?;
        let weights = integrals(&times[..=known]);
        correct(work, system, t1, h, &weights, known);
        estimate(work, h, &weights, &integrals(&times[..known]), known);
        work.history = Some(history.tried(h, weights));
        Ok(())
    }
}

/// The place of the derivative at the end of the step, after those at its beginning and before.
const NEW: usize = NODES - 1;

/// The accelerations of derivatives, that at the end of the step first: then they are in the order of their times.
fn accelerations(k: &[Vec<f64>]) -> [&[f64]; NODES] {
    [NEW, 0, 1, 2].map(|i| &k[i][k[i].len() / 2..])
}

/// Fills the stage by the polynomial through the known accelerations.
fn foretell(work: &mut Stepper<'_>, h: f64, weights: &Weights, known: usize) {
    let half = work.y.len() / 2;
    let through = &accelerations(&work.k)[1..=known];
    let stage = work.stage.split_at_mut(half);
    advance(stage, &work.y, h, (1.0, weights), through);
}

/// Fills the new state by the polynomial through the new acceleration as well, after that was damped.
fn correct<S: LinearlyImplicit>(
    work: &mut Stepper<'_>,
    system: &mut S,
    t1: f64,
    h: f64,
    weights: &Weights,
    known: usize,
) {
    let half = work.y.len() / 2;
    let of_velocity = at(1.0, weights).0;
    let gamma_h = h * of_velocity[0];
    let (correction, damped) = work.error.split_at_mut(half);
    let through = &accelerations(&work.k)[..=known];
    combine(correction, Some(&work.y[half..]), h, &of_velocity, through);
    for (r, v) in correction.iter_mut().zip(&work.stage[half..]) {
        *r -= v;
    }
    damped.copy_from_slice(correction);
    system.damp(t1, &work.stage, gamma_h, damped);
    let fresh = work.k[NEW][half..].iter_mut();
    for (a, (r, x)) in fresh.zip(correction.iter().zip(&*damped)) {
        *a += (x - r) / gamma_h;
    }
    let through = &accelerations(&work.k)[..=known];
    let new = work.y1.split_at_mut(half);
    advance(new, &work.y, h, (1.0, weights), through);
    work.k[NEW][..half].copy_from_slice(&work.y1[half..]);
}

/// Fills the error: the difference to the corrector of one order less, which does without the oldest acceleration.
fn estimate(work: &mut Stepper<'_>, h: f64, weights: &Weights, less: &Weights, known: usize) {
    let half = work.y.len() / 2;
    let through = &accelerations(&work.k)[..=known];
    let (full, less) = (at(1.0, weights), at(1.0, less));
    let difference = |full: [f64; NODES], less: [f64; NODES]| {
        std::array::from_fn::<f64, NODES, _>(|i| full[i] - less[i])
    };
    let (of_q, of_v) = work.error.split_at_mut(half);
    combine(of_v, None, h, &difference(full.0, less.0), through);
    combine(of_q, None, h * h, &difference(full.1, less.1), through);
}
