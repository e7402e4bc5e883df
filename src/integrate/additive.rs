//! Additive Runge–Kutta methods: positions explicit, velocities implicit.

use super::System;
use super::combine::combine;
use super::step::{Stepper, check_finite};
use super::tableau::Tableau;

/// A second-order system q' = v, v' = a(t, q, v) that can solve for velocities which its accelerations
/// are too stiff in for an explicit step.
///
/// The state is \[q, v\], each half of [`System::dim`].
pub trait ImplicitVelocity: System {
    /// Solves v = base + γh · a(t, q, v) for v at fixed t and q.
    ///
    /// `y` holds q and a first guess of v on entry, and the solution in place of the guess afterwards;
    /// `base` has half as many entries. The residual must be well below what the tolerance of the
    /// integration can see.
    ///
    /// # Errors
    /// [`Stuck`] if the iteration does not converge; the step is then tried again smaller.
    fn solve_velocity(
        &mut self,
        t: f64,
        y: &mut [f64],
        base: &[f64],
        gamma_h: f64,
    ) -> Result<usize, Stuck>;
}

/// An implicit stage without a solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stuck {
    /// The state whose residual stayed largest.
    pub state: usize,
    /// Iterations spent.
    pub iterations: usize,
}

/// The coefficients of an additive Runge–Kutta pair with the same weights in both parts.
///
/// The explicit tableau moves the positions, the implicit one the velocities. With `implicit` stiffly
/// accurate, the last stage's velocity is the new one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Additive {
    /// The explicit part, with weights, error weights and dense output of both.
    pub explicit: Tableau,
    /// Stage coefficients of the implicit part below the diagonal; row `i` holds `i` entries.
    pub implicit: &'static [&'static [f64]],
    /// The diagonal of all implicit rows but the first, which is explicit.
    pub gamma: f64,
}

impl Additive {
    /// One step, in the workspace of an explicit one: the derivative of a stage is \[v, (v − base)/γh\], so
    /// that weights, error estimate and dense output are those of any tableau.
    ///
    /// The contract is that of [`Stepper::attempt`].
    pub(super) fn step<S: ImplicitVelocity>(
        &self,
        work: &mut Stepper<'_>,
        system: &mut S,
        (t, t1): (f64, f64),
        h: f64,
        latest: f64,
    ) -> Result<(), usize> {
        let Tableau { c, a, b, b_err, .. } = self.explicit;
        let half = work.y.len() / 2;
        let gamma_h = self.gamma * h;
        // The next state's memory serves for the base, until the last derivative is wanted.
        for i in 1..self.explicit.stages {
            let (known, new) = work.k.split_at_mut(i);
            let base = &mut work.y1;
            combine(base, Some(&work.y), h, self.implicit[i], known);
            combine(
                &mut work.stage[..half],
                Some(&work.y[..half]),
                h,
                a[i],
                known,
            );
            // A first guess by the acceleration of the stage before.
            let velocities = work.stage[half..].iter_mut().zip(&base[half..]);
            for ((v, base), a) in velocities.zip(&known[i - 1][half..]) {
                *v = base + gamma_h * a;
            }
            let time = if c[i] == 1.0 { t1 } else { t + c[i] * h };
            work.calls += 1;
            let solved =
                system.solve_velocity(time.min(latest), &mut work.stage, &base[half..], gamma_h);
            work.iterations += solved.unwrap_or_else(|stuck| stuck.iterations);
            solved.map_err(|stuck| stuck.state)?;
            let (rates, accelerations) = new[0].split_at_mut(half);
            let velocities = &work.stage[half..];
            rates.copy_from_slice(velocities);
            for ((acceleration, v), base) in
                accelerations.iter_mut().zip(velocities).zip(&base[half..])
            {
                *acceleration = (v - base) / gamma_h;
            }
            check_finite(&new[0])?;
        }
        let (known, new) = work.k.split_at_mut(self.explicit.stages);
        combine(&mut work.y1, Some(&work.y), h, b, known);
        system.rhs(t1.min(latest), &work.y1, &mut new[0]);
        work.calls += 1;
        check_finite(&new[0])?;
        combine(&mut work.error, None, h, b_err, known);
        Ok(())
    }
}
