//! A whole contact in closed form: without friction and defects its force depends on the approach alone.
//!
//! * Hertz's law is F = K δ^{3/2} along the common normal, whatever the contact angle.
//! * Of the ISO law, for a ball that keeps its axial place in the groove, F / δ^{29/18} of the force in the plane is a
//!   smooth function of δ (a slice's 10/9, and ½ for the length of the zone): a polynomial through the sums over the
//!   same fitted nodes.

// Everything here must be compiled for the instructions of its caller.
#![allow(clippy::inline_always)]

use std::f64::consts::PI;

mod axially_fixed;

pub(crate) use axially_fixed::{AxiallyFixedBalls, AxiallyFixedRace};

use super::laws::elastic::ten_ninths;
use super::profile::{SHALLOW, Section, Zone};
use super::{Elastic, Pair, Rules, ZoneSlices, kernel};
use crate::simd::{Simd, Vector};

/// Share of the ball's radius at which a zone ends with the ball.
const EDGE: f64 = 1.0 - 1e-9;
/// Largest error of the polynomial over the force: rounding. Off the groove's middle the sums themselves are not known
/// better than the second.
const BOUND: (f64, f64) = (1e-12, 1e-10);
/// Number of a polynomial's coefficients.
const TERMS: usize = 14;
/// Half-length of the zone over the ball's radius up to which the polynomial is tried first.
const REACH: f64 = 0.85;

/// F = δ^{29/18} Σ c_k x^k, x from −1 to 1 as δ goes from 0 to its limit.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Series {
    coefficients: [f64; TERMS],
    scale: f64,
    limit: f64,
    /// Largest error over the force, at points between those that it goes through.
    error: f64,
}

/// K of Hertz's law \[N/m^{3/2}\], where a contact follows it as a whole: not with friction, nor on fixed slices, whose
/// sum has kinks.
pub(crate) fn hertz_stiffness(pair: &Pair) -> Option<f64> {
    rules(pair)?;
    elastic_stiffness(pair)
}

/// The same for elastic forces alone.
pub(super) fn elastic_stiffness(pair: &Pair) -> Option<f64> {
    match (&pair.slices, &pair.law.elastic) {
        (ZoneSlices::Fitted(_), Elastic::Hertz(law)) => {
            Some(4.0 / 3.0 * law.slope * (2.0 / law.curvature).sqrt())
        }
        _ => None,
    }
}

/// The nodes of a contact that could have a closed form: of a torus without friction and oil.
fn rules(pair: &Pair) -> Option<&Rules> {
    match &pair.slices {
        ZoneSlices::Fitted(rules) if pair.law.is_elastic_or_damped() && pair.shape.is_torus() => {
            Some(rules)
        }
        _ => None,
    }
}

/// The force in the plane of balls that keep their axial place in the groove.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct InPlane {
    pub law: LawInPlane,
    /// Ball radius \[m\].
    pub radius: f64,
    /// The balls' axial place from the groove's centre \[m\].
    pub offset: f64,
    /// The approach up to which it holds \[m\].
    pub limit: f64,
}

/// Force by approach.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum LawInPlane {
    /// K of Hertz's law, along the common normal.
    Hertz(f64),
    /// Sum of the slices of the ISO law in the plane.
    Iso(Series),
}

impl InPlane {
    /// Whether the balls are in the middle of the groove.
    pub fn is_middle(&self) -> bool {
        self.offset == 0.0
    }

    /// The closed form for balls of a radius; none where there is friction, where slices are fixed, or where no polynomial reaches the
    /// bound.
    pub fn new(pair: &Pair, radius: f64, offset: f64) -> Option<Self> {
        let rules = rules(pair)?;
        let place = BallInGroove {
            pair,
            radius,
            offset,
        };
        let limit = place.limit();
        let (law, limit) = if let Some(stiffness) = hertz_stiffness(pair) {
            (LawInPlane::Hertz(stiffness), limit)
        } else {
            let series = Series::new(
                |approach| place.force(rules, approach),
                limit,
                place.bound(),
            )?;
            let limit = series.limit;
            (LawInPlane::Iso(series), limit)
        };
        Some(Self {
            law,
            radius,
            offset,
            limit,
        })
    }
}

/// A ball at some axial place in a groove.
struct BallInGroove<'a> {
    pair: &'a Pair,
    radius: f64,
    offset: f64,
}

impl BallInGroove<'_> {
    fn bound(&self) -> f64 {
        if self.offset == 0.0 { BOUND.0 } else { BOUND.1 }
    }

    /// Ball and groove at an approach, and their zone.
    fn at(&self, approach: f64) -> (Section<f64>, Zone<f64>) {
        let (radius, r) = (self.radius, self.pair.race.r);
        let l = approach + r - radius;
        let e = ((l - self.offset) * (l + self.offset)).sqrt();
        let section = Section {
            // Not l + R − r again, which rounds.
            approach,
            ..Section::new::<false, false>(radius, r, e, -self.offset)
        };
        let cut = self.pair.law.cut();
        let zone = kernel::zone(&cut, &section, cut.half_curvature());
        (section, zone)
    }

    /// Whether nothing cuts the zone off.
    fn is_whole(&self, approach: f64) -> bool {
        let (radius, race) = (self.radius, &self.pair.race);
        let (section, zone) = self.at(approach);
        let (low, high) = zone.ends(section.normal);
        let ball = EDGE * radius;
        section.e > 0.0
            && zone.half <= REACH * radius
            && zone.height > SHALLOW * radius
            && zone.lowest(section.normal) > 0.0
            && -ball < low
            && high < ball
            && race.lowest.max(-EDGE * race.r) < low + self.offset
            && high + self.offset < race.highest.min(EDGE * race.r)
    }

    /// The approach up to which the zone is whole, by bisection.
    fn limit(&self) -> f64 {
        let (mut low, mut high) = (0.0, 0.5 * self.radius);
        for _ in 0..60 {
            let middle = f64::midpoint(low, high);
            if self.is_whole(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    /// The force in the plane by the nodes.
    fn force(&self, rules: &Rules, approach: f64) -> f64 {
        let (_, Zone { half, .. }) = self.at(approach);
        let circles = TwoCircles {
            radius: self.radius,
            r: self.pair.race.r,
            approach,
        };
        let force = rules.on([true; 2]).iter().map(|(x, w)| {
            if self.offset == 0.0 {
                return self
                    .pair
                    .law
                    .elastic
                    .force(circles.depth(half * x), half * w);
            }
            let (depth, stretch) = circles.inclined(self.offset, half * x);
            self.pair.law.elastic.force(depth, half * w * stretch)
        });
        force.sum()
    }
}

/// Ball and groove as two circles.
struct TwoCircles {
    radius: f64,
    r: f64,
    approach: f64,
}

impl TwoCircles {
    /// Penetration of a ball level with the groove, δ + (r − √(r² − ζ²)) − (R − √(R² − ζ²)), without the cancellation
    /// of places that are alike.
    fn depth(&self, zeta: f64) -> f64 {
        let sagitta = |radius: f64| {
            let height = (radius * radius - zeta * zeta).sqrt();
            (height, zeta * zeta / (radius + height))
        };
        let ((a, ball), (b, race)) = (sagitta(self.radius), sagitta(self.r));
        self.approach - (self.r - self.radius) * (ball + race) / (a + b)
    }

    /// Penetration in the plane, ρ + e − √(r² − z²), of a ball off the groove's middle, at u on the common chord; and
    /// dζ/du there.
    fn inclined(&self, offset: f64, u: f64) -> (f64, f64) {
        let l = self.approach + self.r - self.radius;
        let sin = offset / l;
        let cos = (1.0 - sin * sin).sqrt();
        let height = (self.radius * self.radius - u * u).sqrt();
        let (zeta, rho) = (height * sin + u * cos, height * cos - u * sin);
        let z = zeta + offset;
        (
            rho + l * cos - (self.r * self.r - z * z).sqrt(),
            rho / height,
        )
    }
}

impl Series {
    /// The polynomial through the values of a force by approach, up to a limit or as far as a polynomial meets a bound.
    fn new(force: impl Fn(f64) -> f64, limit: f64, bound: f64) -> Option<Self> {
        let mut limit = limit;
        for _ in 0..30 {
            let series = Self::through(&force, limit);
            if series.error <= bound {
                return Some(series);
            }
            limit *= 0.7;
        }
        None
    }

    /// Forces at approaches ≥ 0.
    #[inline(always)]
    pub fn forces<S: Simd>(&self, approach: Vector<S>) -> Vector<S> {
        let all = |x: f64| approach.same(x);
        let x = approach.mul_add(all(self.scale), all(-1.0));
        let [.., last] = self.coefficients;
        let sum = self.coefficients[..TERMS - 1]
            .iter()
            .rev()
            .fold(all(last), |sum, c| sum.mul_add(x, all(*c)));
        approach.sqrt() * approach.map(ten_ninths::<false>) * sum
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
    use crate::contact::iso16281::Iso16281;
    use crate::contact::{Law, Shape, Torus, Waves};
    use crate::simd::InstructionSet;

    struct Forces<'a>(&'a Series, f64);

    impl crate::simd::Wide for Forces<'_> {
        type Output = f64;

        fn with_simd<S: Simd>(self, simd: S) -> f64 {
            let mut forces = [0.0; 8];
            self.0.forces(Vector::all(simd, self.1)).store(&mut forces);
            forces[0]
        }
    }

    #[test]
    fn the_polynomial_reaches_rounding() {
        for (f, offset) in [
            (0.505, 0.0),
            (0.515, 0.0),
            (0.524, 0.0),
            (0.56, 0.0),
            (0.524, 7e-5),
            (0.515, -4e-5),
            (0.524, 1.9e-4),
        ] {
            let (radius, r) = (6e-3, 12e-3 * f);
            let rules = Rules::new(6, 10.0 / 9.0);
            let pair = Pair {
                race: Torus {
                    sigma: 1.0,
                    a: 30e-3,
                    centre: 0.0,
                    r,
                    lowest: -r,
                    highest: r,
                },
                shape: Shape::default(),
                waves: Waves::default(),
                law: Law::elastic(Elastic::Iso16281(Iso16281::new(
                    3.5948e10,
                    0.5,
                    2.0 * radius,
                ))),
                slices: ZoneSlices::Fitted(rules.clone()),
                defects: Vec::new(),
            };
            let place = BallInGroove {
                pair: &pair,
                radius,
                offset,
            };
            let found = InPlane::new(&pair, radius, offset).unwrap();
            let LawInPlane::Iso(series) = &found.law else {
                panic!("another law");
            };
            println!(
                "{f}, {offset}: to {:.1} um, {:.1e}",
                1e6 * found.limit,
                series.error
            );
            for share in [1e-6, 0.01, 0.3, 0.77, 1.0] {
                let approach = share * found.limit;
                let force = InstructionSet::current().run_wide(Forces(series, approach));
                let truth = place.force(&rules, approach);
                // Next to nothing is not known better off the middle.
                let bound = if offset == 0.0 {
                    2.0 * BOUND.0
                } else {
                    BOUND.1 / share.min(1e-2)
                };
                assert!(
                    (force / truth - 1.0).abs() < bound,
                    "{share}: {force} {truth}"
                );
            }
        }
    }
}
