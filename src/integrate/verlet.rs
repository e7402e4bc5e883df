//! Velocity Verlet.

use super::System;
use super::combine::combine;
use super::method::Method;
use super::step::{Stepper, check_finite};
use super::tableau::{Tableau, hermite};

/// Velocity Verlet for q' = v, v' = a(t, q, v) with a state \[q, v\]: order two, fixed steps
/// ([`Options::fixed_step`](super::Options::fixed_step)), one evaluation a step.
///
/// Positions move by hv + h²a/2, velocities by the mean of both ends' accelerations. An acceleration that
/// depends on velocity is evaluated at the new positions with the velocities foretold, v + ha, and kept for the
/// next step; without such a dependence the method is symplectic. So the last evaluation of a step is at the new
/// positions, but at velocities wrong by O(h²).
///
/// Source: Swope, Andersen, Berens, Wilson (1982), J. Chem. Phys. 76, 637–649.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct VelocityVerlet;

/// Both weights one half, over \[v, a\] and \[v + ha, a₁\]: just the formulae above.
const WEIGHTS: Tableau = Tableau {
    name: "velocity Verlet",
    order: 2,
    error_order: 0,
    stages: 2,
    c: &[0.0, 1.0],
    a: &[&[], &[1.0]],
    b: &[1.0 / 2.0, 1.0 / 2.0],
    b_err: &[0.0, 0.0],
    fsal: true,
    dense: &hermite::<2, 2>(&[1.0 / 2.0, 1.0 / 2.0]),
    stability_limit: f64::INFINITY,
};

impl<S: System> Method<S> for VelocityVerlet {
    fn tableau(&self) -> &Tableau {
        &WEIGHTS
    }

    fn attempt(
        &self,
        work: &mut Stepper<'_>,
        system: &mut S,
        (_, t1): (f64, f64),
        h: f64,
        latest: f64,
    ) -> Result<(), usize> {
        let half = work.y.len() / 2;
        // The derivative from the step before has the velocities foretold.
        work.k[0][..half].copy_from_slice(&work.y[half..]);
        combine(&mut work.stage, Some(&work.y), h, &[1.0], &work.k);
        work.k[1][..half].copy_from_slice(&work.stage[half..]);
        combine(&mut work.y1, Some(&work.y), h, WEIGHTS.b, &work.k);
        work.stage[..half].copy_from_slice(&work.y1[..half]);
        system.rhs(t1.min(latest), &work.stage, &mut work.k[1]);
        work.calls += 1;
        check_finite(&work.k[1])?;
        combine(&mut work.y1, Some(&work.y), h, WEIGHTS.b, &work.k);
        work.error.fill(0.0);
        Ok(())
    }
}
