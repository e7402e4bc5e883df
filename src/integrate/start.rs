//! The first step size.

use super::System;
use super::combine::combine;
use super::norm::Norm;
use super::step::Stepper;
use super::stops::Stop;

/// A first step from the sizes of the state and of its first two derivatives.
///
/// Expects the derivative at `(t, y)` in the workspace and costs one
/// evaluation. Neither the trial nor the result goes beyond `stop` or is larger
/// than `ceiling`.
///
/// Source: Hairer, Nørsett, Wanner, volume I, section II.4, "Starting step
/// size", with the group norm for theirs.
pub(super) fn first_step<S: System>(
    system: &mut S,
    work: &mut Stepper<'_>,
    norm: &mut Norm<'_>,
    t: f64,
    stop: Stop,
    ceiling: f64,
    error_order: u32,
) -> f64 {
    let most = ceiling.min(stop.time - t);
    let state = norm.measure(&work.y, &work.y, &work.y).value;
    let slope = norm.measure(&work.y, &work.y, &work.k[0]).value;
    let tiny = state < 1e-5 || slope < 1e-5;
    let trial = if tiny { 1e-6 } else { 0.01 * state / slope }.min(most);

    let (known, new) = work.k.split_at_mut(1);
    combine(&mut work.stage, Some(&work.y), trial, &[1.0], known);
    system.rhs((t + trial).min(stop.latest()), &work.stage, &mut new[0]);
    work.calls += 1;
    for (change, (new, old)) in work.error.iter_mut().zip(new[0].iter().zip(&known[0])) {
        *change = new - old;
    }
    let bend = norm.measure(&work.y, &work.y, &work.error).value / trial;
    if !bend.is_finite() {
        return trial;
    }
    let largest = slope.max(bend);
    let second = if largest <= 1e-15 {
        (trial * 1e-3).max(1e-6)
    } else {
        (0.01 / largest).powf(1.0 / f64::from(error_order + 1))
    };
    second.min(100.0 * trial).min(most)
}
