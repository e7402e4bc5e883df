//! The steps behind a step, and the polynomial through their accelerations.

use super::combine::combine;

/// Accelerations that a step knows at most: at its end, at its beginning and at the two before.
pub(super) const NODES: usize = 4;

/// Weights of accelerations in a velocity, as polynomials in the share θ of the step: d₀θ + d₁θ² + d₂θ³ + d₃θ⁴.
pub(super) type Weights = [[f64; NODES]; NODES];

/// The steps behind, as far as they are known.
#[derive(Debug, Clone, Copy)]
pub(super) struct History {
    /// Accelerations known at the beginning of a step: 1 after a start, at most 3.
    pub(super) known: usize,
    /// How far before the beginning of the step the second and the third of them are.
    before: [f64; 2],
    /// Length of the last attempt, and its weights in the order of the derivatives.
    h: f64,
    pub(super) weights: Weights,
}

impl History {
    /// Nothing is known but the beginning.
    pub(super) fn new() -> Self {
        Self {
            known: 1,
            before: [0.0; 2],
            h: 0.0,
            weights: [[0.0; NODES]; NODES],
        }
    }

    /// The same with an attempt of a length, by weights of the accelerations with the new one first.
    pub(super) fn tried(self, h: f64, [new, first, second, third]: Weights) -> Self {
        Self {
            h,
            weights: [first, second, third, new],
            ..self
        }
    }

    /// Takes the last attempt into what is known.
    pub(super) fn advance(&mut self) {
        self.before = [self.h, self.h + self.before[0]];
        self.known = (self.known + 1).min(NODES - 1);
    }

    /// The times of the known accelerations in steps of `h` from its beginning, the end of the step first.
    pub(super) fn times(&self, h: f64) -> [f64; NODES] {
        [1.0, 0.0, -self.before[0] / h, -self.before[1] / h]
    }
}

/// Integrals from 0 to θ of Lagrange's polynomials over some times.
pub(super) fn integrals(times: &[f64]) -> Weights {
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

/// At a share θ of the step: what accelerations weigh in the velocity, over h, and in the position, over h².
pub(super) fn at(theta: f64, weights: &Weights) -> ([f64; NODES], [f64; NODES]) {
    let velocity = weights.map(|d| theta * (d[0] + theta * (d[1] + theta * (d[2] + theta * d[3]))));
    let position = weights.map(|d| {
        let inner = d[1] / 3.0 + theta * (d[2] / 4.0 + theta * d[3] / 5.0);
        theta * theta * (d[0] / 2.0 + theta * inner)
    });
    (velocity, position)
}

/// Velocities and positions after a share θ of a step `h`, from those at its beginning and accelerations.
pub(super) fn advance(
    (q, v): (&mut [f64], &mut [f64]),
    y: &[f64],
    h: f64,
    (theta, weights): (f64, &Weights),
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
        let history = History {
            known: 3,
            before,
            ..History::new()
        };
        let acceleration = |t: f64| 1.0 - 2.0 * t + 3.0 * t * t - 4.0 * t.powi(3);
        let of_v = |t: f64| 0.5 + t - t * t + t.powi(3) - t.powi(4);
        let of_q = |t: f64| {
            2.0 + t / 2.0 + t * t / 2.0 - t.powi(3) / 3.0 + t.powi(4) / 4.0 - t.powi(5) / 5.0
        };
        let known = [h, 0.0, -before[0], -before[1]].map(|t| [acceleration(t)]);
        let known = known.each_ref().map(|a| &a[..]);
        let weights = integrals(&history.times(h));
        for theta in [0.0, 0.4, 1.0] {
            let (mut q, mut v) = ([0.0], [0.0]);
            advance(
                (&mut q, &mut v),
                &[of_q(0.0), of_v(0.0)],
                h,
                (theta, &weights),
                &known,
            );
            assert!((q[0] - of_q(theta * h)).abs() < 1e-14);
            assert!((v[0] - of_v(theta * h)).abs() < 1e-14);
        }
    }

    /// Truth: with steps alike, Adams' and Störmer's own numbers.
    #[test]
    fn equal_steps_have_the_numbers_in_the_book() {
        let history = History {
            known: 3,
            before: [1.0, 2.0],
            ..History::new()
        };
        let (velocity, position) = at(1.0, &integrals(&history.times(1.0)));
        for (found, book) in velocity.iter().zip([9.0, 19.0, -5.0, 1.0]) {
            assert!((found - book / 24.0).abs() < 1e-15);
        }
        for (found, book) in position.iter().zip([38.0, 171.0, -36.0, 7.0]) {
            assert!((found - book / 360.0).abs() < 1e-15);
        }
        let foretold = at(1.0, &integrals(&history.times(1.0)[1..])).0;
        for (found, book) in foretold.iter().zip([23.0, -16.0, 5.0]) {
            assert!((found - book / 12.0).abs() < 1e-14);
        }
    }
}
