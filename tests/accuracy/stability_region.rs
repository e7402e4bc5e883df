//! How far the default method is stable: by the polynomials of its formulae, and as its steps run.
//!
//! The test equation is q″ = −q − 2ζ q′, of frequency 1, in steps of h; d = 2ζh is how often velocities decay in a step. With a matrix that
//! knows both, a step solves for q, V = hv and A = h²a, as polynomials in the shift ξ by a step,
//!
//! ξ²(ξ − 1) Q = (ξ² + ρξ²(ξ − 1)) V + (π − ρα) A,
//! (ξ²(ξ − 1) − c²zβ) V = (σ − c²zξ³) A,
//! A = −h²Q − d V,
//!
//! with Adams' and Störmer's formulae: α and π predict V and Q from the last three A, σ corrects V, ρ is the correction of Q over that of V; β
//! are backward differences of order three, z = −d − ρh² is hJ, and c = 0 for Adams' formula alone. The determinant of these three is the
//! characteristic polynomial: stable is where its roots lie within the unit circle. `python benches/stability_region.py` draws it.
//!
//! Source: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., sections III.1 and III.10 for the coefficients;
//! Jury (1964), *Theory and Application of the z-Transform Method*, for the criterion.

use std::ops::ControlFlow;

use ballrace::integrate::{
    Adams, DenseStep, LinearlyImplicit, Options, StepStatistics, System, Tolerance, integrate,
};

/// Coefficients by powers of ξ from 0.
type Polynomial = [f64; 7];

fn polynomial(coefficients: &[f64], over: f64) -> Polynomial {
    let mut all = [0.0; 7];
    for (to, from) in all.iter_mut().zip(coefficients) {
        *to = from / over;
    }
    all
}

fn sum(terms: &[(f64, Polynomial)]) -> Polynomial {
    let mut all = [0.0; 7];
    for (weight, of) in terms {
        for (to, from) in all.iter_mut().zip(of) {
            *to += weight * from;
        }
    }
    all
}

fn product(a: &Polynomial, b: &Polynomial) -> Polynomial {
    let mut all = [0.0; 7];
    for (i, x) in a.iter().enumerate() {
        for (to, y) in all[i..].iter_mut().zip(b) {
            *to += x * y;
        }
    }
    all
}

/// Which formula corrects velocities.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Formula {
    Adams,
    Blended,
}

/// The characteristic polynomial of a step, of an oscillation by hω and d, or of a decay alone where hω is 0.
fn characteristic(formula: Formula, h: f64, d: f64) -> Polynomial {
    let sigma = polynomial(&[1.0, -5.0, 19.0, 9.0], 24.0);
    let alpha = polynomial(&[5.0, -16.0, 23.0], 12.0);
    let pi = polynomial(&[3.0, -10.0, 19.0], 24.0);
    let backward = polynomial(&[-2.0, 9.0, -18.0, 11.0], 6.0);
    let rho = (38.0 / 360.0) / (9.0 / 24.0);
    let blend = match formula {
        Formula::Adams => 0.0,
        Formula::Blended => (3.0 / 8.0) / (1.0 + f64::sqrt(1.0 - 3.0 / 8.0 * 11.0 / 6.0)),
    };
    let z = blend * blend * (-d - rho * h * h);
    let squared = polynomial(&[0.0, 0.0, 1.0], 1.0);
    let cubed = polynomial(&[0.0, 0.0, 0.0, 1.0], 1.0);
    let difference = sum(&[(1.0, cubed), (-1.0, squared)]);
    let velocity = [
        sum(&[(1.0, difference), (-z, backward)]),
        sum(&[(z, cubed), (-1.0, sigma)]),
    ];
    let decay = sum(&[(1.0, velocity[0]), (-d, velocity[1])]);
    if h == 0.0 {
        return decay;
    }
    let place = [
        sum(&[(-1.0, squared), (-rho, difference)]),
        sum(&[(-1.0, pi), (rho, alpha)]),
    ];
    sum(&[
        (1.0, product(&difference, &decay)),
        (h * h, product(&place[0], &velocity[1])),
        (-h * h, product(&place[1], &velocity[0])),
    ])
}

/// Whether all roots lie within the unit circle, by Jury's criterion.
fn is_stable(polynomial: &Polynomial) -> bool {
    let degree = polynomial.iter().rposition(|x| *x != 0.0).unwrap();
    let mut p = polynomial[..=degree].to_vec();
    while p.len() > 1 {
        let n = p.len() - 1;
        if p[0].abs() >= p[n].abs() {
            return false;
        }
        let next = (0..n).map(|k| p[k + 1] - p[0] / p[n] * p[n - 1 - k]);
        p = next.collect();
    }
    true
}

/// Where something that holds for a small number ends, by steps of a hundredth and bisection; nothing up to a million.
fn end_of(holds: impl Fn(f64) -> bool) -> Option<f64> {
    let mut high = 0.05;
    while holds(high) {
        high *= 1.01;
        if high > 1e6 {
            return None;
        }
    }
    let mut low = high / 1.01;
    for _ in 0..40 {
        let middle = f64::midpoint(low, high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(low)
}

/// Size of the largest root.
fn largest_root(polynomial: &Polynomial) -> f64 {
    let shrunk = |by: f64| {
        let mut all = *polynomial;
        for (x, power) in all.iter_mut().zip(0..) {
            *x *= by.powi(power);
        }
        all
    };
    end_of(|by| !is_stable(&shrunk(by))).unwrap()
}

/// An oscillator of frequency 1, or 0 without a spring, with so much damping, of which the matrix knows the spring or not, and the damping by
/// so much of it.
struct Oscillator {
    damping: f64,
    spring: f64,
    stiff: bool,
    known: f64,
    formula: Option<Formula>,
    matrix: f64,
}

impl Oscillator {
    fn new(damping: f64) -> Self {
        Self {
            damping,
            spring: 1.0,
            stiff: true,
            known: 1.0,
            formula: None,
            matrix: 1.0,
        }
    }

    /// A velocity that decays, at a rate of 1.
    fn decay() -> Self {
        Self {
            spring: 0.0,
            ..Self::new(0.5)
        }
    }

    fn by(self, formula: Formula) -> Self {
        Self {
            formula: Some(formula),
            ..self
        }
    }

    /// Positions after the first steps, or velocities without a spring; as many as were taken.
    fn steps(mut self, h: f64, count: u32) -> Vec<f64> {
        let tolerance = Tolerance::uniform(2, 1e-9, 1e-9).unwrap();
        let options = Options {
            fixed_step: Some(h),
            ..Options::default()
        };
        let mut found = Vec::new();
        let mut watch = |of: &mut Self, step: &DenseStep<'_>, _: &StepStatistics| {
            found.push(step.y0()[usize::from(of.spring <= 0.0)]);
            ControlFlow::Continue(())
        };
        let (of, y0) = ((0.0, f64::from(count) * h), [1.0, 1.0 - self.spring]);
        // One that grows ends with an error.
        let _ = integrate(&mut self, &Adams, of, &y0, &tolerance, &options, &mut watch);
        found
    }

    /// How large what began as 1 is after so many steps.
    fn after(self, h: f64, count: u32) -> f64 {
        let found = self.steps(h, count);
        if found.len() + 1 < count as usize {
            return f64::INFINITY;
        }
        let last = found.iter().rev().take(100);
        last.fold(0.0, |most, q| most.max(q.abs()))
    }
}

impl System for Oscillator {
    fn dim(&self) -> usize {
        2
    }

    fn rhs(&mut self, _: f64, y: &[f64], dy: &mut [f64]) {
        (dy[0], dy[1]) = (y[1], -self.spring * y[0] - 2.0 * self.damping * y[1]);
    }
}

impl LinearlyImplicit for Oscillator {
    fn prepare(&mut self, _: f64, _: &[f64], gamma_h: f64, reach: f64) {
        let stiffness = if self.stiff { self.spring * reach } else { 0.0 };
        self.matrix = 1.0 + gamma_h * (2.0 * self.damping * self.known + stiffness);
    }

    fn solve(&mut self, r: &mut [f64]) {
        r[0] /= self.matrix;
    }

    fn relaxation(&self) -> f64 {
        match self.formula {
            Some(Formula::Adams) => 0.0,
            Some(Formula::Blended) => 1e9,
            None => 2.0 * self.damping * self.known,
        }
    }

    fn longest(&self) -> f64 {
        0.1
    }
}

/// Truth: the characteristic polynomial. A thousandth within its limit an oscillation dies out, a thousandth beyond it grows: damped
/// contacts, overdamped ones as in a film, and velocities that decay alone as by stiff friction.
#[test]
fn steps_are_stable_as_far_as_the_polynomial_is() {
    // Damping ratio, and the limit of ωh in `benches/charts/stability_region.csv`.
    let of_adams = [
        (0.005, 0.8859),
        (0.01, 1.032),
        (0.05, 1.528),
        (0.2, 2.473),
        (0.7, 1.675),
    ];
    let blended = [
        (0.005, 0.8625),
        (0.05, 1.562),
        (0.2, 2.672),
        (0.7, 2.283),
        (2.0, 2.71),
        (10.0, 16.13),
    ];
    let cases = of_adams
        .map(|case| (Formula::Adams, case))
        .into_iter()
        .chain(blended.map(|case| (Formula::Blended, case)));
    for (formula, (damping, drawn)) in cases {
        let limit = end_of(|h| is_stable(&characteristic(formula, h, 2.0 * damping * h))).unwrap();
        let count = if damping < 0.02 { 400_000 } else { 20_000 };
        let after = |h| Oscillator::new(damping).by(formula).after(h, count);
        let (inside, outside) = (after(0.999 * limit), after(1.001 * limit));
        println!(
            "{formula:?}, damping {damping}: {limit:.4}, {inside:.1e} within, {outside:.1e} beyond"
        );
        assert!(
            (limit / drawn - 1.0).abs() < 1e-3,
            "{formula:?} {damping}: {limit}"
        );
        assert!(
            inside < 0.1 && outside > 10.0,
            "{formula:?} {damping}: {inside:e} {outside:e}"
        );
    }
    let limit = end_of(|d| is_stable(&characteristic(Formula::Adams, 0.0, d))).unwrap();
    let after = |h| Oscillator::decay().by(Formula::Adams).after(h, 20_000);
    assert!((limit / 3.0 - 1.0).abs() < 1e-6, "{limit}");
    assert!(after(0.999 * limit) < 0.1 && after(1.001 * limit) > 10.0);
    assert_eq!(
        end_of(|d| is_stable(&characteristic(Formula::Blended, 0.0, d))),
        None
    );
    for d in [0.1, 3.0, 30.0, 1e4, 1e6] {
        let after = Oscillator::decay().by(Formula::Blended).after(d, 1000);
        assert!(after < 1e-3, "{d}: {after:e}");
    }
}

/// Truth: the characteristic polynomial. An undamped oscillation grows a little in every step, however short, by its largest root:
/// q₁² − q₀q₂ of three positions in a row grows by its square.
#[test]
fn undamped_oscillations_grow_by_the_largest_root() {
    for h in [0.3, 0.6, 0.9, 1.5] {
        let expected = largest_root(&characteristic(Formula::Adams, h, 0.0)).ln();
        let q = Oscillator::new(0.0).by(Formula::Adams).steps(h, 2000);
        let squared = |n: usize| q[n + 1] * q[n + 1] - q[n] * q[n + 2];
        let measured = (squared(1900) / squared(100)).ln() / 3600.0;
        println!("ωh = {h}: {measured:.4e} a step ({expected:.4e})");
        assert!(
            (measured / expected - 1.0).abs() < 1e-3,
            "{h}: {measured:e}, not {expected:e}"
        );
    }
}

/// Computed: where an eigenvalue of a step's matrix over position, velocity and three accelerations leaves the unit circle, without the
/// stiffness in the method's matrix.
#[test]
fn adams_without_stiffness_in_its_matrix_is_stable_for_shorter_steps() {
    for (damping, limit) in [(0.005, 0.675), (0.01, 0.849), (0.05, 1.024), (0.2, 0.972)] {
        let after = |h: f64| {
            let of = Oscillator::new(damping).by(Formula::Adams);
            Oscillator { stiff: false, ..of }.after(h, 200_000)
        };
        let (inside, outside) = (after(limit - 5e-3), after(limit + 5e-3));
        assert!(
            inside < 1e-3 && outside > 1e3,
            "{damping}: {inside:e} {outside:e}"
        );
    }
}

/// Computed: eigenvalues of a step's matrix over position, three velocities and three accelerations. Velocities that decay up to
/// 10⁶ times within a step die out, where the matrix knows from 0.9 to twice of how fast they decay; with 0.5 they do not.
#[test]
fn velocities_that_decay_within_a_step_die_out() {
    for h in [0.3, 0.8] {
        for decays in [4.0, 10.0, 100.0, 1e4, 1e6] {
            let after = |known| {
                let of = Oscillator::new(0.5 * decays / h);
                Oscillator { known, ..of }.after(h, 200_000)
            };
            for known in [0.9, 1.0, 1.3, 2.0] {
                // Places follow slowly: half a decay or less a step.
                assert!(
                    after(known) <= 1.0,
                    "{h} {decays} {known}: {:e}",
                    after(known)
                );
            }
            assert!(after(0.5) > 1e3, "{h} {decays}");
        }
    }
}
