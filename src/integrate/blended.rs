//! Adams' corrector for slow velocities, backward differences for those that decay within a step.
//!
//! With r_A(v) what Adams' formula leaves at a new velocity v, and r_B(v) what backward differences over the same times leave of h times
//! the acceleration, v solves
//!
//! r_A − c²hJ r_B = 0, with J = ∂a/∂v + ρ ∂a/∂q.
//!
//! Where hJ is small this is Adams' formula, of its order, with its accuracy for oscillations; where it is large backward differences, which
//! damp. With c from c²b − 2c + γ = 0 (γ weighs the new acceleration in Adams' formula, b the new velocity in the differences) the equation's
//! derivative is −(1 − chJ)², so that two solutions with one matrix give the correction x of the velocity:
//!
//! x = M⁻¹ (c r_B + M⁻¹ (r_A − c r_B)), M = 1 − chJ.
//!
//! Adams' prediction would amplify fast velocities by 2.4 hJ, and with them what is wrong in J. So it is taken for slow ones only, and for
//! fast ones the polynomial through the last velocities: predicted are v_e + M⁻² (v_A − v_e). Stable on the whole negative real axis with a
//! J that is 10 % too small to one that is twice too large (`tests/accuracy/stability_region.rs`); oscillations as Adams' formula.
//!
//! Source: Skeel, Kong (1977), Blended linear multistep methods, ACM Trans. Math. Softw. 3, 326–345.

use super::LinearlyImplicit;
use super::combine::{Each, halves, pass};
use super::multistep::{Formulae, KnownWeights, NEW, NODES};
use super::step::Stepper;
use crate::simd::{Simd, Vector};

/// Tries a step after Adams' prediction: fills the new state, its derivative and the error.
pub(super) fn attempt<S: LinearlyImplicit>(
    work: &mut Stepper<'_>,
    system: &mut S,
    t1: f64,
    h: f64,
    formulae: &Formulae,
) -> Result<(), usize> {
    let half = work.y.len() / 2;
    let (c_h, reach) = (formulae.blend * h, formulae.reach * h);
    system.prepare(t1, &work.y, c_h, reach);
    let gamma_h = formulae.gamma * h;
    let [_, _, extrapolated] = formulae.predicted;
    let fast = Fast {
        gamma_h,
        extrapolated,
    };
    let known = [0, 1, 2].map(|i| &work.k[i][..half]);
    let [q, v] = halves(&mut work.stage);
    let [_, base] = halves(&mut work.error);
    let [_, difference] = halves(&mut work.y1);
    pass(&fast, [base, difference], [v, known[0], known[1], known[2]]);
    system.solve(difference);
    system.solve(difference);
    let damped = DampedPrediction {
        reach,
        extrapolated,
    };
    pass(&damped, [q, v], [difference, known[0], known[1], known[2]]);
    work.evaluate(system, t1)?;

    let known = [0, 1, 2].map(|i| &work.k[i][..half]);
    let [share, correction] = halves(&mut work.y1);
    let residuals = Residuals {
        h,
        gamma_h,
        blend: formulae.blend,
        backward: formulae.backward,
    };
    let (velocities, accelerations) = (&work.stage[half..], &work.k[NEW][half..]);
    let base = &work.error[half..];
    let inputs = [
        velocities,
        accelerations,
        base,
        known[0],
        known[1],
        known[2],
    ];
    pass(&residuals, [share, correction], inputs);
    system.solve(correction);
    pass(&SumOfBoth, [share, correction], []);
    system.solve(correction);
    let [q1, x] = halves(&mut work.y1);
    let [rates, new] = halves(&mut work.k[NEW]);
    let [of_q, of_v] = halves(&mut work.error);
    let end = BlendedEnd {
        reach,
        per_c_h: c_h.recip(),
        errors: [h * formulae.errors[0], formulae.errors[1]],
    };
    let predicted = [&work.stage[..half], &work.stage[half..]];
    pass(&end, [q1, x, rates, new, of_q, of_v], predicted);
    Ok(())
}

/// The velocity on the polynomial through those at the beginning of the step and before.
#[inline(always)]
fn extrapolate<S: Simd>(weights: KnownWeights, of: [Vector<S>; 3]) -> Vector<S> {
    let [first, second, third] = of;
    let [a, b, c] = weights;
    first.mul_add(first.same(a), second.mul_add(first.same(b), third * c))
}

/// Predictions from accelerations and velocities: what Adams' formula adds γh times the new acceleration to, and by how much the predicted
/// velocity differs from the extrapolated one.
struct Fast {
    gamma_h: f64,
    extrapolated: KnownWeights,
}

impl Each<4, 2> for Fast {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [acceleration, _]: [Vector<S>; 2],
        [v, first, second, third]: [Vector<S>; 4],
    ) -> [Vector<S>; 2] {
        let base = v - acceleration * self.gamma_h;
        [
            base,
            v - extrapolate(self.extrapolated, [first, second, third]),
        ]
    }
}

/// Positions and velocities that are predicted with fast ones damped.
struct DampedPrediction {
    reach: f64,
    extrapolated: KnownWeights,
}

impl Each<4, 2> for DampedPrediction {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [q, v]: [Vector<S>; 2],
        [difference, first, second, third]: [Vector<S>; 4],
    ) -> [Vector<S>; 2] {
        let velocity = difference + extrapolate(self.extrapolated, [first, second, third]);
        [(velocity - v).mul_add(q.same(self.reach), q), velocity]
    }
}

/// c r_B, and r_A − c r_B.
struct Residuals {
    h: f64,
    gamma_h: f64,
    blend: f64,
    backward: [f64; NODES],
}

impl Each<6, 2> for Residuals {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        _: [Vector<S>; 2],
        [v, acceleration, base, first, second, third]: [Vector<S>; 6],
    ) -> [Vector<S>; 2] {
        let [new, before @ ..] = self.backward;
        let slope = v.mul_add(v.same(new), extrapolate(before, [first, second, third]));
        let share = (acceleration * self.h - slope) * self.blend;
        let adams = acceleration.mul_add(v.same(self.gamma_h), base - v);
        [share, adams - share]
    }
}

/// Both the sum of both.
struct SumOfBoth;

impl Each<0, 2> for SumOfBoth {
    #[inline(always)]
    fn of<S: Simd>(&self, [share, rest]: [Vector<S>; 2], []: [Vector<S>; 0]) -> [Vector<S>; 2] {
        [share + rest; 2]
    }
}

/// New positions and velocities, their derivatives and errors, from what was predicted, the correction x of the velocity, and M x.
struct BlendedEnd {
    reach: f64,
    per_c_h: f64,
    errors: [f64; 2],
}

impl Each<2, 6> for BlendedEnd {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [product, x, _, evaluated, _, _]: [Vector<S>; 6],
        [q, v]: [Vector<S>; 2],
    ) -> [Vector<S>; 6] {
        let velocity = v + x;
        [
            x.mul_add(x.same(self.reach), q),
            velocity,
            velocity,
            (x - product).mul_add(x.same(self.per_c_h), evaluated),
            x * self.errors[0],
            x * self.errors[1],
        ]
    }
}
