//! A step of any tableau, in memory allocated once.

use super::System;
use super::combine::combine;
use super::dense::{DenseStep, Weights};
use super::multistep::{History, NEW};
use super::stiffness::quotient;
use super::tableau::Tableau;
use crate::base::words::{Remembered, Words};
use crate::simd::{InstructionSet, Simd, Vector, Wide};

/// The workspace of a step: the state, the derivatives and what they give.
#[derive(Debug)]
pub struct Stepper<'a> {
    tableau: &'a Tableau,
    /// The accepted state.
    pub(super) y: Vec<f64>,
    /// The state the last attempt ends in.
    pub(super) y1: Vec<f64>,
    /// The error estimate of the last attempt, in units of the states.
    pub(super) error: Vec<f64>,
    /// The last state evaluated before `y1`.
    pub(super) stage: Vec<f64>,
    /// Derivatives: the first at `y`, the last at `y1`, the others between.
    /// A method that is not FSAL has one more than stages.
    pub(super) k: Vec<Vec<f64>>,
    /// The steps behind, for methods that use them. Their derivatives follow the first one.
    pub(super) history: Option<History>,
    /// Evaluations of the right-hand side so far.
    pub(super) calls: usize,
}

impl<'a> Stepper<'a> {
    pub(super) fn new(tableau: &'a Tableau, multistep: bool, y: &[f64]) -> Self {
        let zero = vec![0.0; y.len()];
        let mut made = Self {
            tableau,
            y: y.to_vec(),
            y1: zero.clone(),
            error: zero.clone(),
            stage: zero.clone(),
            k: Vec::new(),
            history: multistep.then(History::new),
            calls: 0,
        };
        made.k = vec![zero; made.derivatives()];
        made
    }

    /// Number of derivatives that it keeps.
    fn derivatives(&self) -> usize {
        self.tableau.stages + usize::from(!self.tableau.fsal)
    }

    /// Evaluates the derivative at `(t, y)`, where no step before supplies it.
    ///
    /// The error is the index of the first non-finite state or derivative.
    pub(super) fn restart<S: System>(&mut self, system: &mut S, t: f64) -> Result<(), usize> {
        check_finite(&self.y)?;
        self.history = self.history.map(|_| History::new());
        system.rhs(t, &self.y, &mut self.k[0]);
        self.calls += 1;
        check_finite(&self.k[0])
    }

    /// Tries a step `h` from `(t, y)`: fills `y1`, the derivatives and `error`.
    ///
    /// `t1` is `t + h` as the clock will show it; stages at the end see just that.
    /// No evaluation sees a time beyond `latest`. A non-finite derivative ends
    /// the attempt at once, with the index of its first non-finite entry.
    pub(super) fn attempt<S: System>(
        &mut self,
        system: &mut S,
        t: f64,
        t1: f64,
        h: f64,
        latest: f64,
    ) -> Result<(), usize> {
        let Tableau { c, a, b, .. } = *self.tableau;
        let last = self.k.len() - 1;
        for i in 1..=last {
            // The stage after the last is the new state of a method without FSAL.
            let (c, row) = if i < c.len() { (c[i], a[i]) } else { (1.0, b) };
            let state = if i == last {
                &mut self.y1
            } else {
                &mut self.stage
            };
            let (known, new) = self.k.split_at_mut(i);
            combine(state, Some(&self.y), h, row, known);
            let time = if c == 1.0 { t1 } else { t + c * h };
            system.rhs(time.min(latest), state, &mut new[0]);
            self.calls += 1;
            check_finite(&new[0])?;
        }
        combine(&mut self.error, None, h, self.tableau.b_err, &self.k);
        Ok(())
    }

    /// Evaluates the derivative at the end of a step, of the state that was predicted there.
    pub(super) fn evaluate<S: System>(&mut self, system: &mut S, t1: f64) -> Result<(), usize> {
        system.rhs(t1, &self.stage, &mut self.k[NEW]);
        self.calls += 1;
        check_finite(&self.k[NEW])
    }

    /// The stiffness quotient at the end of the last attempt; 0 where the last stage but one is not there.
    pub(super) fn stiffness(&self, h: f64, weights: &[f64]) -> f64 {
        let before = self.tableau.stages - 1 - usize::from(self.tableau.fsal);
        if self.tableau.c[before] != 1.0 {
            return 0.0;
        }
        let last = self.k.len() - 1;
        let slopes = [&self.k[last - 1][..], &self.k[last]];
        quotient(h, [&self.stage, &self.y1], slopes, weights)
    }

    /// The last attempt as a polynomial from `t0` to `t1`.
    pub(super) fn dense(&self, t0: f64, t1: f64, h: f64) -> DenseStep<'_> {
        let weights = match &self.history {
            Some(history) => Weights::OfAccelerations(&history.formulae.weights),
            None => Weights::OfDerivatives(self.tableau.dense),
        };
        DenseStep::new(weights, t0, t1, h, &self.y, &self.y1, &self.k)
    }

    /// Whether all vectors are as long as a system has states.
    pub(super) fn is_whole(&self, dim: usize) -> bool {
        let mut all = self.k.iter().chain([&self.y, &self.y1]);
        self.k.len() == self.derivatives() && all.all(|of| of.len() == dim)
    }

    /// Makes the end of the last attempt the accepted state.
    pub(super) fn advance(&mut self) {
        let last = self.k.len() - 1;
        match &mut self.history {
            Some(history) => {
                history.advance();
                self.k.rotate_right(1);
            }
            None => self.k.swap(0, last),
        }
        std::mem::swap(&mut self.y, &mut self.y1);
    }
}

/// The last stage and the error are of no use after a step.
impl Remembered for Stepper<'_> {
    fn pass(&mut self, words: &mut Words) {
        self.y.pass(words);
        self.y1.pass(words);
        self.k.pass(words);
        if let Some(history) = &mut self.history {
            history.pass(words);
        }
        self.calls.pass(words);
    }
}

/// The index of the first non-finite entry, as the error.
pub(super) fn check_finite(x: &[f64]) -> Result<(), usize> {
    if InstructionSet::current().run_wide(Nothing(x)) == 0.0 {
        return Ok(());
    }
    x.iter().position(|x| !x.is_finite()).map_or(Ok(()), Err)
}

/// Zero times every number: zero, unless one of them is not finite.
struct Nothing<'a>(&'a [f64]);

impl Wide for Nothing<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let zero = Vector::all(simd, 0.0);
        let (registers, rest) = Vector::<S>::split(self.0);
        let sum = registers
            .iter()
            .fold(zero, |sum, x| Vector::of(simd, *x).mul_add(zero, sum));
        rest.iter().fold(sum.sum(), |sum, x| sum + 0.0 * x)
    }
}
