//! An accepted step as a polynomial in time.

use std::fmt;

use super::combine::combine;
use super::multistep;

/// Stages a step can have at most; bounds the weights kept on the stack.
pub(super) const MAX_STAGES: usize = 16;

/// Weights of a step's derivatives within it.
#[derive(Clone, Copy)]
pub(super) enum Weights<'a> {
    /// A Runge–Kutta method's: of every derivative in every state.
    OfDerivatives(&'a [[f64; 4]]),
    /// Weights of every acceleration in velocities, and integrated once more in positions.
    OfAccelerations(&'a multistep::AdamsWeights),
}

/// An accepted step, as the observer sees it.
#[derive(Clone, Copy)]
pub struct DenseStep<'a> {
    weights: Weights<'a>,
    t0: f64,
    t1: f64,
    h: f64,
    y0: &'a [f64],
    y1: &'a [f64],
    k: &'a [Vec<f64>],
}

impl<'a> DenseStep<'a> {
    pub(super) fn new(
        weights: Weights<'a>,
        t0: f64,
        t1: f64,
        h: f64,
        y0: &'a [f64],
        y1: &'a [f64],
        k: &'a [Vec<f64>],
    ) -> Self {
        Self {
            weights,
            t0,
            t1,
            h,
            y0,
            y1,
            k,
        }
    }

    /// Time at the start of the step.
    #[must_use]
    pub fn t0(&self) -> f64 {
        self.t0
    }

    /// Time at the end of the step; exactly the breakpoint, if it ends on one.
    #[must_use]
    pub fn t1(&self) -> f64 {
        self.t1
    }

    /// The step size; `t1 − t0` but for the rounding of the times.
    #[must_use]
    pub fn h(&self) -> f64 {
        self.h
    }

    /// The state at [`DenseStep::t0`].
    #[must_use]
    pub fn y0(&self) -> &'a [f64] {
        self.y0
    }

    /// The state at [`DenseStep::t1`].
    #[must_use]
    pub fn y1(&self) -> &'a [f64] {
        self.y1
    }

    /// The derivative at the end of the step, from the left.
    #[must_use]
    pub fn dy1(&self) -> &'a [f64] {
        &self.k[self.k.len() - 1]
    }

    /// Writes the state at time `t` into `out`, without evaluating the system.
    ///
    /// Accurate between `t0` and `t1`, to the order of the tableau's dense
    /// output; outside it extrapolates the same polynomial, and the error grows
    /// fast.
    ///
    /// # Panics
    /// If `out` is longer than the state.
    #[inline]
    pub fn interpolate(&self, t: f64, out: &mut [f64]) {
        // Over t1 − t0, not h: the end of the step is then exactly θ = 1.
        let theta = (t - self.t0()) / (self.t1() - self.t0());
        match self.weights {
            Weights::OfDerivatives(weights) => self.by_derivatives(theta, weights, out),
            Weights::OfAccelerations(weights) => self.by_accelerations(theta, weights, out),
        }
    }

    fn by_derivatives(&self, theta: f64, polynomials: &[[f64; 4]], out: &mut [f64]) {
        let mut weights = [0.0; MAX_STAGES];
        for (weight, d) in weights.iter_mut().zip(polynomials) {
            *weight = theta * (d[0] + theta * (d[1] + theta * (d[2] + theta * d[3])));
        }
        let stages = polynomials.len();
        combine(
            out,
            Some(self.y0),
            self.h,
            &weights[..stages],
            &self.k[..stages],
        );
    }

    fn by_accelerations(&self, theta: f64, weights: &multistep::AdamsWeights, out: &mut [f64]) {
        let half = self.y0.len() / 2;
        let (q, v) = out.split_at_mut(half.min(out.len()));
        let accelerations = [0, 1, 2, 3].map(|i| &self.k[i][half..]);
        multistep::advance(q, v, self.y0, self.h, theta, weights, &accelerations);
    }
}

impl fmt::Debug for DenseStep<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("DenseStep")
            .field("t0", &self.t0)
            .field("t1", &self.t1)
            .field("h", &self.h)
            .finish_non_exhaustive()
    }
}
