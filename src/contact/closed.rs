//! A whole contact in one number: without friction and defects its force depends on the approach alone.
//!
//! * Hertz's law is F = K δ^{3/2} along the common normal, whatever the contact angle.
//! * Of the ISO law, for a ball level with its groove, F / δ^{29/18} is a smooth function of δ (a slice's 10/9, and ½
//!   for the length of the zone): a polynomial through the sums over the same fitted nodes.

// Everything here must be compiled for the instructions of its caller.
#![allow(clippy::inline_always)]

use std::f64::consts::PI;

use super::power::ten_ninths;
use super::{Law, Motion, Near, Pair, Slices};
use crate::simd::{Counters, Lanes, Mask};

/// Share of the ball's radius at which a zone ends with the ball.
const EDGE: f64 = 1.0 - 1e-9;
/// Largest error of the polynomial over the force: rounding.
const BOUND: f64 = 1e-12;
/// Its coefficients.
const TERMS: usize = 14;
/// Half-length of the zone over the ball's radius up to which the polynomial is tried first.
const REACH: f64 = 0.6;

/// The force of a whole contact.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Closed {
    /// 4/3 k' √(2/κ) of Hertz's law, its K; and the approach at which the zone of a ball that is level with the groove
    /// meets an end.
    Hertz { stiffness: f64, limit: f64 },
    /// The ISO law in the plane.
    Iso(Series),
}

/// F = δ^{29/18} Σ c_k x^k, x from −1 to 1 as δ goes from 0 to its limit.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Series {
    coefficients: [f64; TERMS],
    scale: f64,
    limit: f64,
    /// Largest error over the force, at points between those that it goes through.
    error: f64,
}

impl Closed {
    /// For balls of a radius; none where there is friction, where slices are fixed (their sum has kinks), or where
    /// the polynomial does not reach rounding. In the `plane` only for the ISO law.
    pub fn new(pair: &Pair, radius: f64, plane: bool) -> Option<Self> {
        let Slices::Fitted(rules) = &pair.slices else {
            return None;
        };
        if pair.friction.is_some() {
            return None;
        }
        let shoulder = pair.race.highest.min(-pair.race.lowest);
        match &pair.law {
            Law::Hertz(law) => {
                let reach = (EDGE * radius).min(shoulder);
                Some(Self::Hertz {
                    stiffness: 4.0 / 3.0 * law.slope * (2.0 / law.curvature).sqrt(),
                    limit: 0.5 * law.curvature * reach * reach,
                })
            }
            Law::Iso16281(_) if plane => {
                let sum = |approach: f64| {
                    let level = Profile {
                        radius,
                        r: pair.race.r,
                        approach,
                    };
                    let half = level.half();
                    let force = rules
                        .on([true; 2])
                        .iter()
                        .map(|(x, w)| pair.law.force(level.depth(half * x), half * w));
                    (half, force.sum())
                };
                Series::new(sum, (REACH * radius).min(0.99 * shoulder), radius).map(Self::Iso)
            }
            Law::Iso16281(_) => None,
        }
    }

    /// The approach up to which it holds for a ball that is level with the groove \[m\].
    pub fn limit(&self) -> f64 {
        match self {
            Self::Hertz { limit, .. } => *limit,
            Self::Iso(series) => series.limit,
        }
    }

    /// Forces \[N\] at approaches ≥ 0 \[m\].
    #[inline(always)]
    pub fn force<const FMA: bool>(&self, approach: Lanes) -> Lanes {
        match self {
            Self::Hertz { stiffness, .. } => approach * approach.sqrt() * *stiffness,
            Self::Iso(series) => {
                let x = approach.mul_add::<FMA>(Lanes::all(series.scale), Lanes::all(-1.0));
                let sum = series
                    .coefficients
                    .iter()
                    .rev()
                    .fold(Lanes::ZERO, |sum, c| sum.mul_add::<FMA>(x, Lanes::all(*c)));
                approach.sqrt() * approach.map(ten_ninths::<FMA>) * sum
            }
        }
    }
}

/// A ball level with its groove, without the cancellation of places that are alike.
struct Profile {
    radius: f64,
    r: f64,
    approach: f64,
}

impl Profile {
    /// Half-length of the zone, as in `Meridian::zone`.
    fn half(&self) -> f64 {
        let l = self.approach + self.r - self.radius;
        let sum = self.approach * (l + self.radius + self.r) / (2.0 * l);
        (sum * (2.0 * self.radius - sum)).max(0.0).sqrt()
    }

    /// Penetration δ + (r − √(r² − ζ²)) − (R − √(R² − ζ²)).
    fn depth(&self, zeta: f64) -> f64 {
        let sagitta = |radius: f64| {
            let height = (radius * radius - zeta * zeta).sqrt();
            (height, zeta * zeta / (radius + height))
        };
        let ((a, ball), (b, race)) = (sagitta(self.radius), sagitta(self.r));
        self.approach - (self.r - self.radius) * (ball + race) / (a + b)
    }
}

impl Pair {
    /// Forces in closed form on balls that are level with their groove, at velocities along x and y; contacts in
    /// `skip` are left out.
    #[inline(always)]
    pub(crate) fn press_level<const FMA: bool>(
        &self,
        closed: &Closed,
        near: &Near,
        v: [Lanes; 2],
        ring: &Motion,
        skip: Mask,
    ) -> Level {
        let over = Lanes::all(self.race.sigma) / near.distance;
        let n = near.apart.map(|apart| apart * over);
        let beyond = near.approach.above(Lanes::all(closed.limit()));
        let careful = beyond.or(Lanes::ZERO.above(near.e));
        let (vx, vy) = (v[0] - ring.velocity.x, v[1] - ring.velocity.y);
        let speed = vx.mul_add::<FMA>(n[0], vy * n[1]);
        let elastic = closed.force::<FMA>(near.approach.or_zero());
        let damped = elastic * (speed * (1.5 * self.damping) + 1.0);
        let damped = careful.or(skip).choose(Lanes::ZERO, damped);
        let mut pulls = Counters::default();
        pulls.add(Lanes::ZERO.above(damped), self.slices.count());
        let normal = if self.clamp_pull {
            damped.or_zero()
        } else {
            damped
        };
        Level {
            ball: [-(normal * n[0]), -(normal * n[1])],
            pulls: pulls.total(),
            careful,
        }
    }
}

/// What eight contacts put on balls that are level with their groove: the ring gets the opposite.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Level {
    /// Force along x and y \[N\].
    pub ball: [Lanes; 2],
    /// Slices whose damping wanted to pull.
    pub pulls: u32,
    /// Contacts for which the closed form does not hold.
    pub careful: Mask,
}

impl Series {
    /// Through the values of `sum`, half-length of the zone and force by approach, as long as the half-length is at
    /// most `reach`; over less where a polynomial would not do.
    fn new(sum: impl Fn(f64) -> (f64, f64), reach: f64, radius: f64) -> Option<Self> {
        let mut limit = 0.1 * radius;
        for _ in 0..30 {
            if sum(limit).0 <= reach {
                let series = Self::through(|approach| sum(approach).1, limit);
                if series.error <= BOUND {
                    return Some(series);
                }
            }
            limit *= 0.7;
        }
        None
    }

    /// Chebyshev's interpolation, in powers of x.
    fn through(force: impl Fn(f64) -> f64, limit: f64) -> Self {
        const CHECKS: usize = 4 * TERMS + 1;
        let value = |x: f64| {
            let approach = 0.5 * limit * (1.0 + x);
            force(approach) / (approach.sqrt() * ten_ninths::<false>(approach))
        };
        let angle = |k: usize, of: usize| (2 * k + 1) as f64 * PI / (2 * of) as f64;
        let values: Vec<f64> = (0..TERMS).map(|k| value(angle(k, TERMS).cos())).collect();
        let mut coefficients = [0.0; TERMS];
        // T₋₁ = T₁ and T₀ in powers of x.
        let (mut before, mut now) = ([0.0; TERMS], [0.0; TERMS]);
        (before[1], now[0]) = (1.0, 1.0);
        for j in 0..TERMS {
            let sum: f64 = (0..TERMS)
                .map(|k| values[k] * (j as f64 * angle(k, TERMS)).cos())
                .sum();
            let share = sum * if j == 0 { 1.0 } else { 2.0 } / TERMS as f64;
            for (coefficient, power) in coefficients.iter_mut().zip(&now) {
                *coefficient += share * power;
            }
            let mut next = before.map(|power| -power);
            for k in 1..TERMS {
                next[k] += 2.0 * now[k - 1];
            }
            (before, now) = (now, next);
        }
        let at = |x: f64| coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c);
        let error = |k: usize| {
            let x = angle(k, CHECKS).cos();
            (at(x) / value(x) - 1.0).abs()
        };
        Self {
            coefficients,
            scale: 2.0 / limit,
            limit,
            error: (0..CHECKS).map(error).fold(0.0, f64::max),
        }
    }
}

/// The truth is the sum over the nodes.
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_polynomial_reaches_rounding() {
        for f in [0.505, 0.515, 0.524, 0.56] {
            let (radius, r) = (6e-3, 12e-3 * f);
            let rules = super::super::Rules::new(6, 10.0 / 9.0);
            let sum = |approach: f64| {
                let level = Profile {
                    radius,
                    r,
                    approach,
                };
                let half = level.half();
                let force = rules.on([true; 2]).iter();
                let force = force
                    .map(|(x, w)| half * w * ten_ninths::<false>(level.depth(half * x).max(0.0)));
                (half, force.sum())
            };
            let series = Series::new(sum, REACH * radius, radius).unwrap();
            println!("{f}: to {:.1} um, {:.1e}", 1e6 * series.limit, series.error);
            let closed = Closed::Iso(series.clone());
            for share in [1e-6, 0.01, 0.3, 0.77, 1.0] {
                let approach = share * series.limit;
                let force = closed.force::<false>(Lanes::all(approach))[0];
                assert!((force / sum(approach).1 - 1.0).abs() < 2.0 * BOUND);
            }
        }
    }
}
