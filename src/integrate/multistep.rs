//! The steps before the current one, and the polynomial through their accelerations.

use super::combine::combine;
use crate::base::words::{Remembered, Words};

/// Accelerations that a step knows at most: at its end, at its beginning and at the two before.
pub(super) const NODES: usize = 4;

/// The place of the derivative at the end of a step, after those at its beginning and before.
pub(super) const NEW: usize = NODES - 1;

/// Weights of accelerations in a velocity, as polynomials in the share θ of the step: d₀θ + d₁θ² + d₂θ³ + d₃θ⁴.
pub(super) type AdamsWeights = [[f64; NODES]; NODES];

/// Weights of the accelerations that are known at the beginning of a step.
pub(super) type KnownWeights = [f64; NODES - 1];

/// The steps behind, as far as they are known.
#[derive(Debug, Clone, Copy)]
pub(super) struct History {
    /// Accelerations known at the beginning of a step: 1 after a start, at most 3.
    known: usize,
    /// How far before the beginning of the step the second and the third of them are.
    before: [f64; 2],
    /// Length of the last attempt, and what it was made of.
    h: f64,
    pub(super) formulae: Formulae,
    /// Whether fast velocities follow backward differences.
    pub(super) is_blended: bool,
    /// Attempts since that was decided, and for how many Adams' formula is kept.
    since: usize,
    pause: usize,
    /// Length of the step when the last trial began.
    tried_at: f64,
}

/// Decays of a velocity within a step at which Adams' formula is unstable: with an exact matrix it is from three on.
const UNSTABLE: f64 = 3.5;
/// Decays at which it may be unstable with a matrix made before, in steps near the longest one and in shorter ones.
const DOUBTFUL: f64 = 1.2;
const DOUBTFUL_SHORT: f64 = 0.1;
/// Attempts for which backward differences are tried, and by how much steps must grow by them; attempts before they are tried again.
const TRIAL: usize = 32;
const GAIN: f64 = 1.25;
const PAUSE: usize = 64;
const LONGEST_PAUSE: usize = 4096;
/// Share of the longest step below which a step is short.
const SHORT: f64 = 0.25;

impl History {
    /// Nothing is known but the beginning.
    pub(super) fn new() -> Self {
        Self {
            known: 1,
            before: [0.0; 2],
            h: 0.0,
            formulae: Formulae::default(),
            is_blended: false,
            since: 0,
            pause: PAUSE,
            tried_at: 0.0,
        }
    }

    /// Prepares an attempt of a length, of a system whose velocities decay at some rate and whose oscillations allow steps up to a longest one: the
    /// formulae of the last attempt serve where its times are the same.
    pub(super) fn attempt(&mut self, h: f64, relaxation: f64, longest: f64) {
        self.h = h;
        self.choose(relaxation * h, h < SHORT * longest);
        let times = [1.0, 0.0, -self.before[0] / h, -self.before[1] / h];
        if self.formulae.known != self.known || self.formulae.times != times {
            self.formulae = Formulae::new(times, self.known);
        }
    }

    /// Chooses how velocities are corrected, by how many times the fastest decays in the step.
    ///
    /// Adams' formula costs less, and may hold steps short already where its matrix is only nearly right: friction that sticks now was
    /// slipping when it was made. So the other one is tried: where steps do not become longer by it, it is left, and tried again later
    /// and later.
    fn choose(&mut self, decays: f64, is_short: bool) {
        let is_doubtful = decays > if is_short { DOUBTFUL_SHORT } else { DOUBTFUL };
        let is_certain = decays > UNSTABLE;
        self.since = self.since.saturating_add(1);
        if !self.is_blended {
            if is_certain || is_doubtful && self.since > self.pause {
                (self.is_blended, self.since, self.tried_at) = (true, 0, self.h);
            }
        } else if self.since > TRIAL && !is_certain {
            let pays = is_doubtful && self.h > GAIN * self.tried_at;
            self.pause = if pays {
                PAUSE
            } else {
                (2 * self.pause).min(LONGEST_PAUSE)
            };
            (self.is_blended, self.since) = (pays, 0);
        }
    }

    /// Takes the last attempt into what is known.
    pub(super) fn advance(&mut self) {
        self.before = [self.h, self.h + self.before[0]];
        self.known = (self.known + 1).min(NODES - 1);
    }
}

impl Remembered for History {
    fn pass(&mut self, words: &mut Words) {
        self.known.pass(words);
        self.before.pass(words);
        self.h.pass(words);
        self.is_blended.pass(words);
        self.since.pass(words);
        self.pause.pass(words);
        self.tried_at.pass(words);
        let Formulae {
            mut known,
            mut times,
            ..
        } = self.formulae;
        known.pass(words);
        times.pass(words);
        if words.loads() {
            // All else follows from these.
            let is_made = (1..NODES).contains(&known);
            self.formulae = if is_made {
                Formulae::new(times, known)
            } else {
                Formulae::default()
            };
            self.known = self.known.clamp(1, NODES - 1);
        }
    }
}

/// A step by polynomials through accelerations, for a length of 1; those not known weigh nothing.
///
/// The polynomial through the known accelerations predicts velocity, position and acceleration at the step's end. That through the new
/// acceleration as well differs from it by a multiple of what the new one differs from the predicted; so does that of one order less,
/// which is without the oldest. So the correction of the velocity says everything: that of the position, and both errors.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Formulae {
    known: usize,
    /// Times of the accelerations, that at the end of the step first.
    times: [f64; NODES],
    /// Weights of the known accelerations in the predicted position, velocity and acceleration.
    pub predicted: [KnownWeights; 3],
    /// γ, of the new acceleration in the velocity.
    pub gamma: f64,
    /// Correction of the position over that of the velocity, and the errors of both over it.
    pub reach: f64,
    pub errors: [f64; 2],
    /// Weights of the velocities at those times in h times the acceleration at the end of the step: backward differences.
    pub backward: [f64; NODES],
    /// c, for which 1 − (γ + c²b) hJ + c²h²J² = (1 − chJ)², with b the first of these.
    pub blend: f64,
    /// Weights of all accelerations within the step, in the order of the derivatives: the new one last.
    pub weights: AdamsWeights,
}

impl Formulae {
    fn new(times: [f64; NODES], known: usize) -> Self {
        let before = integrals(&times[1..=known]);
        let (velocity, position) = at(1.0, &before);
        let all = integrals(&times[..=known]);
        let (of_velocity, of_position) = at(1.0, &all);
        let (less_velocity, less_position) = at(1.0, &integrals(&times[..known]));
        let gamma = of_velocity[0];
        let first = |of: [f64; NODES]| [of[0], of[1], of[2]];
        let backward = all.map(curvature);
        // Real up to steps that grow almost twofold; beyond, the square is only near.
        let blend = gamma / (1.0 + (1.0 - gamma * backward[0]).max(0.0).sqrt());
        let [new, rest @ ..] = all;
        Self {
            backward,
            blend,
            known,
            times,
            predicted: [first(position), first(velocity), first(before.map(slope))],
            gamma,
            reach: of_position[0] / gamma,
            errors: [
                (of_position[0] - less_position[0]) / gamma,
                1.0 - less_velocity[0] / gamma,
            ],
            weights: [rest[0], rest[1], rest[2], new],
        }
    }
}

/// The polynomial whose integral has these coefficients, at the end of the step.
fn slope(integral: [f64; NODES]) -> f64 {
    let powers = integral
        .iter()
        .zip(1..)
        .map(|(d, power)| d * f64::from(power));
    powers.sum()
}

/// The slope of that polynomial there.
fn curvature(integral: [f64; NODES]) -> f64 {
    let powers = integral.iter().zip(1..);
    let terms = powers.map(|(d, power)| d * f64::from(power * (power - 1)));
    terms.sum()
}

/// Integrals from 0 to θ of Lagrange's polynomials over some times.
pub(super) fn integrals(times: &[f64]) -> AdamsWeights {
    let mut all = [[0.0; NODES]; NODES];
    for (i, weights) in all.iter_mut().enumerate().take(times.len()) {
        // Π (θ − τⱼ)/(τᵢ − τⱼ), factor by factor.
        let mut basis = [1.0, 0.0, 0.0, 0.0];
        for (j, time) in times.iter().enumerate().filter(|(j, _)| *j != i) {
            let scale = 1.0 / (times[i] - time);
            let degree = if j > i { j } else { j + 1 };
            for power in (0..=degree).rev() {
                let lower = if power > 0 { basis[power - 1] } else { 0.0 };
                basis[power] = scale * (lower - time * basis[power]);
            }
        }
        for (power, (weight, coefficient)) in weights.iter_mut().zip(basis).enumerate() {
            *weight = coefficient / (power + 1) as f64;
        }
    }
    all
}

/// Weights of accelerations at a share θ of the step: in the velocity, over h, and in the position, over h².
pub(super) fn at(theta: f64, weights: &AdamsWeights) -> ([f64; NODES], [f64; NODES]) {
    let velocity = weights.map(|d| theta * (d[0] + theta * (d[1] + theta * (d[2] + theta * d[3]))));
    let position = weights.map(|d| {
        let inner = d[1] / 3.0 + theta * (d[2] / 4.0 + theta * d[3] / 5.0);
        theta * theta * (d[0] / 2.0 + theta * inner)
    });
    (velocity, position)
}

/// Velocities and positions after a share θ of a step `h`, from those at its beginning and accelerations.
pub(super) fn advance(
    q: &mut [f64],
    v: &mut [f64],
    y: &[f64],
    h: f64,
    theta: f64,
    weights: &AdamsWeights,
    accelerations: &[&[f64]],
) {
    let (positions, velocities) = y.split_at(y.len() / 2);
    let (of_v, of_q) = at(theta, weights);
    combine(v, Some(velocities), h, &of_v, accelerations);
    let mut terms = [velocities; NODES + 1];
    let mut shares = [theta; NODES + 1];
    for (i, acceleration) in accelerations.iter().enumerate() {
        (terms[i + 1], shares[i + 1]) = (acceleration, h * of_q[i]);
    }
    let count = accelerations.len() + 1;
    combine(q, Some(positions), h, &shares[..count], &terms[..count]);
}

/// Truth: a cubic is its own interpolation through four points, and its integrals are known.
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_are_integrated_exactly_over_steps_of_any_length() {
        let (h, before) = (0.3, [0.2, 0.7]);
        let acceleration = |t: f64| 1.0 - 2.0 * t + 3.0 * t * t - 4.0 * t.powi(3);
        let of_v = |t: f64| 0.5 + t - t * t + t.powi(3) - t.powi(4);
        let of_q = |t: f64| {
            2.0 + t / 2.0 + t * t / 2.0 - t.powi(3) / 3.0 + t.powi(4) / 4.0 - t.powi(5) / 5.0
        };
        let mut history = History {
            known: 3,
            before,
            ..History::new()
        };
        history.attempt(h, 0.0, h);
        let known = [0.0, -before[0], -before[1], h].map(|t| [acceleration(t)]);
        let known = known.each_ref().map(|a| &a[..]);
        for theta in [0.0, 0.4, 1.0] {
            let (mut q, mut v) = ([0.0], [0.0]);
            advance(
                &mut q,
                &mut v,
                &[of_q(0.0), of_v(0.0)],
                h,
                theta,
                &history.formulae.weights,
                &known,
            );
            assert!((q[0] - of_q(theta * h)).abs() < 1e-14);
            assert!((v[0] - of_v(theta * h)).abs() < 1e-14);
        }
    }

    /// Truth: the polynomials themselves. A correction of the velocity gives that of the position and the errors.
    #[test]
    fn the_correction_of_the_velocity_says_the_rest() {
        let times = [1.0, 0.0, -0.6, -1.7];
        let accelerations = [0.3, -1.2, 0.7, 2.1];
        for known in 1..NODES {
            let formulae = Formulae::new(times, known);
            let sum = |weights: &[f64], of: &[f64]| -> f64 {
                weights.iter().zip(of).map(|(w, a)| w * a).sum()
            };
            let before = &accelerations[1..=known];
            let [q, v, a] = formulae.predicted.map(|weights| sum(&weights, before));
            let x = formulae.gamma * (accelerations[0] - a);
            let by = |times: &[f64]| {
                let (velocity, position) = at(1.0, &integrals(times));
                let known = &accelerations[..times.len()];
                [sum(&position, known), sum(&velocity, known)]
            };
            let (full, less) = (by(&times[..=known]), by(&times[..known]));
            let corrected = [q + formulae.reach * x, v + x];
            for i in 0..2 {
                assert!((corrected[i] - full[i]).abs() < 1e-14, "{known} {i}");
                let error = formulae.errors[i] * x;
                assert!((error - (full[i] - less[i])).abs() < 1e-14, "{known} {i}");
            }
        }
    }

    /// Truth: with steps alike, Adams' and Störmer's own numbers.
    #[test]
    fn equal_steps_have_the_numbers_in_the_book() {
        let formulae = Formulae::new([1.0, 0.0, -1.0, -2.0], 3);
        let (velocity, position) = at(1.0, &integrals(&formulae.times));
        for (found, book) in velocity.iter().zip([9.0, 19.0, -5.0, 1.0]) {
            assert!((found - book / 24.0).abs() < 1e-15);
        }
        for (found, book) in position.iter().zip([38.0, 171.0, -36.0, 7.0]) {
            assert!((found - book / 360.0).abs() < 1e-15);
        }
        let [_, predicted, _] = formulae.predicted;
        for (found, book) in predicted.iter().zip([23.0, -16.0, 5.0]) {
            assert!((found - book / 12.0).abs() < 1e-14);
        }
    }
}
