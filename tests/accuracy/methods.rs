//! The methods against each other, and each against what is proved of it.
//!
//! Each test names its truth.

use std::f64::consts::FRAC_PI_2;
use std::ops::ControlFlow;

use ballrace::compile;
use ballrace::integrate::{
    self, Adams, DORMAND_PRINCE, DenseStep, LinearlyImplicit, Options, StepStatistics, System,
    Tableau, Tolerance, VERNER, integrate,
};
use ballrace::scene::{Friction, Method, presets};
use ballrace::{Bandwidth, Run, Scene, Signals, simulate};

/// An oscillator rubbed by regularised Coulomb friction against a belt that moves: q' = v,
/// v' = −q − rate·s·(v − w)/√((v − w)² + s²), w = cos t. Its fastest rate is `rate`.
struct Rubbed {
    rate: f64,
    slip_speed: f64,
    /// Velocities at which the right-hand side was asked for.
    asked: usize,
    /// What was prepared.
    matrix: f64,
    relaxation: f64,
}

impl Rubbed {
    fn new(rate: f64) -> Self {
        Self {
            rate,
            slip_speed: 0.5,
            asked: 0,
            matrix: 1.0,
            relaxation: 0.0,
        }
    }

    fn acceleration(&self, t: f64, q: f64, v: f64) -> (f64, f64) {
        let u = v - t.cos();
        let root = (u * u + self.slip_speed * self.slip_speed).sqrt();
        let strength = self.rate * self.slip_speed;
        (
            -q - strength * u / root,
            -strength * (self.slip_speed / root).powi(2) / root,
        )
    }
}

impl System for Rubbed {
    fn dim(&self) -> usize {
        2
    }

    fn rhs(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        self.asked += 1;
        dy[0] = y[1];
        dy[1] = self.acceleration(t, y[0], y[1]).0;
    }
}

impl LinearlyImplicit for Rubbed {
    fn prepare(&mut self, t: f64, y: &[f64], gamma_h: f64, reach: f64) {
        let slope = self.acceleration(t, y[0], y[1]).1;
        // A spring of 1 pulls back.
        (self.matrix, self.relaxation) = (1.0 - gamma_h * (slope - reach), -slope);
    }

    fn solve(&mut self, r: &mut [f64]) {
        r[0] /= self.matrix;
    }

    fn relaxation(&self) -> f64 {
        self.relaxation
    }

    fn longest(&self) -> f64 {
        0.1
    }
}

fn fixed(h: f64) -> Options {
    Options {
        fixed_step: Some(h),
        ..Options::default()
    }
}

/// End state, largest difference between dense output and `truth`, and effort.
fn follow<M: integrate::StepMethod<Rubbed>>(
    method: &M,
    rate: f64,
    end: f64,
    options: &Options,
    truth: impl Fn(f64) -> f64,
) -> (Vec<f64>, f64, StepStatistics) {
    let mut system = Rubbed::new(rate);
    let mut between: f64 = 0.0;
    let mut watch = |_: &mut _, step: &DenseStep<'_>, _: &StepStatistics| {
        for part in 0..5 {
            let t = step.t0() + f64::from(part) / 5.0 * (step.t1() - step.t0());
            let mut y = [0.0; 2];
            step.interpolate(t, &mut y);
            between = between.max((y[0] - truth(t)).abs());
        }
        ControlFlow::Continue(())
    };
    let tolerance = Tolerance::uniform(2, 1e-9, 1e-9).unwrap();
    let y0 = [0.3, 0.8];
    let solution = integrate(
        &mut system,
        method,
        (0.0, end),
        &y0,
        &tolerance,
        options,
        &mut watch,
    );
    let solution = solution.unwrap();
    (solution.y, between, solution.stats)
}

/// Slopes of the errors of the end state over halved steps.
fn orders<M: integrate::StepMethod<Rubbed>>(method: &M, rate: f64, steps: &[f64]) -> Vec<f64> {
    let exact = follow(&VERNER, rate, 1.0, &fixed(1e-3), |_| 0.0).0;
    let error = |h: f64| {
        let end = follow(method, rate, 1.0, &fixed(h), |_| 0.0).0;
        (end[0] - exact[0]).hypot(end[1] - exact[1])
    };
    let errors: Vec<f64> = steps.iter().map(|&h| error(h)).collect();
    errors
        .windows(2)
        .zip(steps.windows(2))
        .map(|(e, h)| (e[0] / e[1]).ln() / (h[0] / h[1]).ln())
        .collect()
}

fn has_order<M: integrate::StepMethod<Rubbed>>(method: &M, order: f64, steps: &[f64]) {
    let measured = orders(method, 6.0, steps);
    for slope in &measured {
        let name = method.tableau().name;
        assert!(
            (-0.25..0.4).contains(&(slope - order)),
            "{name}: {measured:?}"
        );
    }
}

/// Truth: the order proved for each method, on a smooth problem that depends on time, place and velocity.
#[test]
fn every_method_has_its_order() {
    let steps = [0.02, 0.01, 0.005];
    has_order(&DORMAND_PRINCE, 5.0, &steps);
}

/// Truth: a dense output of order p has a local error of order p + 1, the cubic's included.
#[test]
fn dense_outputs_have_their_order() {
    let truth = {
        // The right-hand side is smooth: tiny steps of the highest order stand for the solution.
        let mut places = vec![];
        let mut system = Rubbed::new(2.0);
        let mut watch = |_: &mut Rubbed, step: &DenseStep<'_>, _: &StepStatistics| {
            places.push(step.y0()[0]);
            ControlFlow::Continue(())
        };
        let tolerance = Tolerance::uniform(2, 1e-9, 1e-9).unwrap();
        let span = (0.0, 1.0);
        integrate(
            &mut system,
            &VERNER,
            span,
            &[0.3, 0.8],
            &tolerance,
            &fixed(1e-3),
            &mut watch,
        )
        .unwrap();
        places
    };
    // Fifths of the steps below fall on whole milliseconds.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let at = |t: f64| truth[(t * 1e3).round() as usize];
    let order = |method: &dyn Fn(f64) -> f64| (method(0.1) / method(0.05)).log2();
    let tableaux: [(&Tableau, f64); 2] = [(&DORMAND_PRINCE, 5.0), (&VERNER, 4.0)];
    for (tableau, least) in tableaux {
        let measured = order(&|h| follow(tableau, 2.0, 1.0, &fixed(h), at).1);
        assert!(measured > least - 0.3, "{}: {measured}", tableau.name);
    }
}

/// Adams' method with its own way to follow the error.
fn by_adams(rate: f64, end: f64, rtol: f64) -> (f64, StepStatistics) {
    let mut system = Rubbed::new(rate);
    let tolerance = Tolerance::uniform(2, rtol, rtol).unwrap();
    let options = Options {
        controller: integrate::StepMethod::<Rubbed>::controller(&Adams),
        ..Options::default()
    };
    let found = integrate(
        &mut system,
        &Adams,
        (0.0, end),
        &[0.3, 0.8],
        &tolerance,
        &options,
        &mut (),
    );
    let found = found.unwrap();
    let exact = follow(&VERNER, rate, end, &fixed(1e-2 / rate), |_| 0.0).0;
    assert_eq!(
        found.stats.nfev,
        found.stats.accepted + found.stats.rejected + 2
    );
    let error = (found.y[0] - exact[0]).hypot(found.y[1] - exact[1]);
    (error, found.stats)
}

/// Truth: a method of order four errs by the fourth power of its step, which is one over its evaluations.
#[test]
fn adams_errs_by_the_fourth_power_of_its_step() {
    let found = [1e-7, 1e-9, 1e-11].map(|rtol| by_adams(6.0, 10.0, rtol));
    for pair in found.windows(2) {
        let steps = pair[1].1.nfev as f64 / pair[0].1.nfev as f64;
        let order = (pair[0].0 / pair[1].0).ln() / steps.ln();
        assert!((3.5..5.0).contains(&order), "{order}: {found:?}");
    }
}

/// Truth: Verner's method at a hundredth of the time in which friction acts. Steps of the default method do not depend on how stiff
/// friction is; Dormand–Prince's do.
#[test]
fn stiff_friction_holds_no_steps_short() {
    let counts = [1e3, 1e5, 1e6].map(|rate| {
        let (error, stats) = by_adams(rate, 0.02, 1e-9);
        println!("{rate:e}: {error:.1e} in {}", stats.nfev);
        assert!(error < 3e-9, "{rate}: {error:e}");
        stats.nfev
    });
    assert!(4 * counts[2] < 5 * counts[0], "{counts:?}");
    let (_, _, explicit) = follow(&DORMAND_PRINCE, 1e6, 0.02, &Options::default(), |_| 0.0);
    assert!(explicit.nfev > 100 * counts[2], "{explicit:?} {counts:?}");
}

/// A body that is pushed for a tenth of a second, and given a rate at which it relaxes.
struct Pushed {
    relaxation: f64,
}

impl System for Pushed {
    fn dim(&self) -> usize {
        2
    }

    fn rhs(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        (dy[0], dy[1]) = (y[1], (1.0 - 10.0 * t).max(0.0));
    }
}

impl LinearlyImplicit for Pushed {
    fn prepare(&mut self, _: f64, _: &[f64], _: f64, _: f64) {}

    fn solve(&mut self, _: &mut [f64]) {}

    fn relaxation(&self) -> f64 {
        self.relaxation
    }

    fn longest(&self) -> f64 {
        0.1
    }
}

/// Exact: what is not pushed any more has no acceleration. A rest that shrinks from step to step would end in numbers below
/// 1e-308, by which a processor calculates a hundred times as slowly.
#[test]
fn accelerations_that_end_are_zero() {
    let tolerance = Tolerance::uniform(2, 1e-9, 1e-9).unwrap();
    for relaxation in [0.0, 1e4] {
        let mut after = 0;
        let mut watch = |_: &mut Pushed, step: &DenseStep<'_>, _: &StepStatistics| {
            if step.t1() > 0.105 {
                assert_eq!(step.dy1()[1], 0.0, "at {}", step.t1());
                after += 1;
            }
            ControlFlow::Continue(())
        };
        let found = integrate(
            &mut Pushed { relaxation },
            &Adams,
            (0.0, 1.0),
            &[0.0, 0.0],
            &tolerance,
            &fixed(0.01),
            &mut watch,
        );
        found.unwrap();
        assert!(after > 80);
    }
}

/// The amplification of y' = λy over a step, |R(hλ)|, run through the method's own coefficients.
fn amplification(t: &Tableau, real: f64, imaginary: f64) -> f64 {
    let mut k: Vec<(f64, f64)> = Vec::new();
    let stage = |row: &[f64], k: &[(f64, f64)]| {
        row.iter()
            .zip(k)
            .fold((1.0, 0.0), |sum: (f64, f64), (a, k)| {
                (sum.0 + a * k.0, sum.1 + a * k.1)
            })
    };
    for row in t.a {
        let y = stage(row, &k);
        k.push((real * y.0 - imaginary * y.1, real * y.1 + imaginary * y.0));
    }
    let end = stage(t.b, &k);
    end.0.hypot(end.1)
}

/// Computed: where |R| passes 1 on both axes. Dormand–Prince: Hairer & Wanner II,
/// section IV.2. The small numbers on the imaginary axis belong to pairs whose |R|
/// passes 1 by less than 10⁻³ there; with a hundredth of damping they reach further.
#[test]
fn stability_limits_of_the_tableaux() {
    let limits = [(&DORMAND_PRINCE, 3.3066, 0.9972), (&VERNER, 4.8553, 2.5849)];
    for (tableau, real, imaginary) in limits {
        let inside = |z: f64, x: f64| amplification(tableau, -z, x) < 1.0 + 1e-11;
        let name = tableau.name;
        assert!(
            inside(real - 1e-3, 0.0) && !inside(real + 1e-3, 0.0),
            "{name}, real"
        );
        let (below, above) = (inside(0.0, imaginary - 1e-3), inside(0.0, imaginary + 1e-3));
        assert!(below && !above, "{name}, imaginary");
    }
}

/// The wheel bearing with a ball that meets the spall at about 0.6 ms.
fn scene(slip_speed: f64) -> Scene {
    let mut scene = presets::wheel_bearing(3000.0);
    scene.friction = Friction::Coulomb {
        coefficient: 0.05,
        slip_speed,
    };
    // From equilibrium the first ball meets it at 5.3 ms.
    let (orbit, _) = compile(&scene).unwrap().rolling_speeds(0);
    scene.defects.get_mut("spall").unwrap().angle = -FRAC_PI_2 - 4.7e-3 * orbit;
    scene
}

fn run(scene: &Scene, method: Method, rtol: f64) -> Signals {
    let run = Run {
        duration: 2e-3,
        fs: 100e3,
        rtol: Some(rtol),
        method: Some(method),
        threads: 1,
        bandwidth: Bandwidth::Raw,
        settle: Some(0.0),
        ..Run::default()
    };
    simulate(scene, &run).unwrap()
}

/// Relative L2 error of the outer ring's acceleration.
fn error(signals: &Signals, truth: &Signals) -> f64 {
    let (mut off, mut size) = (0.0, 0.0);
    for (x, y) in signals
        .get("outer.ay")
        .unwrap()
        .iter()
        .zip(truth.get("outer.ay").unwrap())
    {
        off += (x - y) * (x - y);
        size += y * y;
    }
    (off / size).sqrt()
}

/// Truth: each other at tight tolerance. Every method gives the same signal.
#[test]
fn methods_agree() {
    let scene = scene(0.1);
    let truth = run(&scene, Method::DormandPrince, 1e-9);
    let peak = truth
        .get("outer.ay")
        .unwrap()
        .iter()
        .fold(0.0, |most: f64, a| most.max(a.abs()));
    assert!(peak > 30.0, "no impact: {peak} m/s²");
    for (method, most) in [(Method::Adams, 1e-3), (Method::Verner, 1e-3)] {
        let off = error(&run(&scene, method, 1e-7), &truth);
        assert!(off < most, "{method:?}: {off:e}");
    }
}

/// Truth: Dormand–Prince at tight tolerance. At a slip speed of 1 mm/s the default is within 1 % over an impact for a tenth of the
/// evaluations of the cheapest explicit run that is, and at a tenth of that slip speed takes four times as many at most.
#[test]
fn a_small_slip_speed_costs_the_default_nothing() {
    let scene = scene(1e-3);
    let truth = run(&scene, Method::DormandPrince, 1e-9);
    let found = run(&scene, Method::Adams, 1e-7);
    let off = error(&found, &truth);
    assert!(off < 1e-2, "{off:e}");
    let explicit = [1e-3, 1e-4, 1e-5, 1e-6].map(|rtol| run(&scene, Method::DormandPrince, rtol));
    let cheapest = explicit
        .iter()
        .filter(|signals| error(signals, &truth) < 1e-2)
        .map(|signals| signals.stats.nfev)
        .min()
        .unwrap();
    let ratio = cheapest as f64 / found.stats.nfev as f64;
    let stiffer = run(&self::scene(1e-4), Method::Adams, 1e-7);
    println!(
        "{off:.1e}, {ratio}, {} {}",
        found.stats.nfev, stiffer.stats.nfev
    );
    assert!(ratio > 10.0, "{ratio}");
    assert!(stiffer.stats.nfev < 4 * found.stats.nfev);
}
