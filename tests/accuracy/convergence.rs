//! The integrator against problems with a known answer.
//!
//! Each test names its truth. Nothing here depends on bearings.

use crate::common::slope;
use std::ops::ControlFlow;

use ballrace::integrate::{
    DORMAND_PRINCE, DenseStep, Failure, FailureKind, Observer, Options, Solution, StepStatistics,
    System, Tableau, Tolerance, VERNER, integrate,
};

/// A right-hand side from a closure; remembers when and where it was last asked.
struct Ode<F> {
    dim: usize,
    f: F,
    calls: usize,
    last: (f64, Vec<f64>),
}

impl<F: FnMut(f64, &[f64], &mut [f64])> Ode<F> {
    fn new(dim: usize, f: F) -> Self {
        Self {
            dim,
            f,
            calls: 0,
            last: (f64::NAN, vec![f64::NAN; dim]),
        }
    }
}

impl<F: FnMut(f64, &[f64], &mut [f64])> System for Ode<F> {
    fn dim(&self) -> usize {
        self.dim
    }

    fn rhs(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        self.calls += 1;
        self.last.0 = t;
        self.last.1.copy_from_slice(y);
        (self.f)(t, y, dy);
    }
}

/// Dormand–Prince with a uniform tolerance.
fn solve<S: System, O: Observer<S>>(
    system: &mut S,
    span: (f64, f64),
    y0: &[f64],
    rtol: f64,
    options: &Options,
    observer: &mut O,
) -> Result<Solution, Failure> {
    let tolerance = Tolerance::uniform(y0.len(), rtol, rtol).unwrap();
    let tableau = &DORMAND_PRINCE;
    integrate(system, tableau, span, y0, &tolerance, options, observer)
}

fn fixed(h: f64) -> Options {
    Options {
        fixed_step: Some(h),
        ..Options::default()
    }
}

/// `y' = y cos t`, `y(0) = 1`, whose solution is `exp(sin t)`.
fn wave(t: f64, y: &[f64], dy: &mut [f64]) {
    dy[0] = y[0] * t.cos();
}

fn wave_truth(t: f64) -> f64 {
    t.sin().exp()
}

/// Errors at the end and, largest over the run, between the steps.
fn errors(tableau: &Tableau, h: f64) -> (f64, f64) {
    let mut between: f64 = 0.0;
    let mut watch = |_: &mut _, step: &DenseStep<'_>, _: &StepStatistics| {
        for part in 0..=10 {
            let t = step.t0() + f64::from(part) / 10.0 * (step.t1() - step.t0());
            let mut y = [0.0];
            step.interpolate(t, &mut y);
            between = between.max((y[0] - wave_truth(t)).abs());
        }
        ControlFlow::Continue(())
    };
    let mut system = Ode::new(1, wave);
    let tolerance = Tolerance::uniform(1, 1e-6, 1e-6).unwrap();
    let end = integrate(
        &mut system,
        tableau,
        (0.0, 2.0),
        &[1.0],
        &tolerance,
        &fixed(h),
        &mut watch,
    )
    .unwrap();
    ((end.y[0] - wave_truth(2.0)).abs(), between)
}

const STEPS: [f64; 5] = [0.1, 0.05, 0.04, 0.025, 0.02];

/// Truth: the analytic solution, and the order proved for the method.
#[test]
fn solution_is_of_order_five() {
    let points: Vec<_> = STEPS
        .iter()
        .map(|&h| (h, errors(&DORMAND_PRINCE, h).0))
        .collect();
    let order = slope(&points);
    assert!((order - 5.0).abs() < 0.15, "{order}: {points:?}");
}

/// Truth: the same, for the pair of order six: its large coefficients leave it few steps between the coarse ones
/// and rounding.
#[test]
fn verner_is_of_order_six() {
    let points = [0.4, 0.2, 0.1, 0.05].map(|h| (h, errors(&VERNER, h).0));
    let order = slope(&points);
    assert!((order - 6.0).abs() < 0.25, "{order}: {points:?}");
}

/// Truth: the analytic solution between the steps; a fourth-order interpolant
/// has a local error of order five.
#[test]
fn dense_output_is_of_local_order_five() {
    let points: Vec<_> = STEPS
        .iter()
        .map(|&h| (h, errors(&DORMAND_PRINCE, h).1))
        .collect();
    let order = slope(&points);
    assert!(order > 4.8, "{order}: {points:?}");
}

/// A method is data: the classical fourth-order one, which is not FSAL, runs in
/// the same loop. Truth: the analytic solution.
#[test]
fn another_tableau_is_one_constant() {
    const CLASSICAL: Tableau = Tableau {
        name: "classical Runge-Kutta",
        order: 4,
        error_order: 3,
        stages: 4,
        c: &[0.0, 0.5, 0.5, 1.0],
        a: &[&[], &[0.5], &[0.0, 0.5], &[0.0, 0.0, 1.0]],
        b: &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
        b_err: &[0.0; 4],
        fsal: false,
        dense: &[
            [1.0, -1.5, 2.0 / 3.0, 0.0],
            [0.0, 1.0, -2.0 / 3.0, 0.0],
            [0.0, 1.0, -2.0 / 3.0, 0.0],
            [0.0, -0.5, 2.0 / 3.0, 0.0],
            [0.0; 4],
        ],
        stability_limit: 2.785,
    };
    let measured = STEPS.map(|h| (h, errors(&CLASSICAL, h)));
    let order = slope(&measured.map(|(h, e)| (h, e.0)));
    assert!((order - 4.0).abs() < 0.15, "{order}: {measured:?}");
    let order = slope(&measured.map(|(h, e)| (h, e.1)));
    assert!(order > 3.8, "{order}: {measured:?}");
}

/// The Kepler ellipse of eccentricity 0.6, from its nearest point.
fn kepler(_: f64, y: &[f64], dy: &mut [f64]) {
    let r3 = (y[0] * y[0] + y[1] * y[1]).powf(1.5);
    dy.copy_from_slice(&[y[2], y[3], -y[0] / r3, -y[1] / r3]);
}

/// Truth: after one period the body is back where it began. The global error
/// follows the tolerance over six decades.
#[test]
fn kepler_error_is_proportional_to_the_tolerance() {
    let y0 = [0.4, 0.0, 0.0, 2.0];
    let period = 2.0 * std::f64::consts::PI;
    let points: Vec<_> = (4..=10)
        .map(|n| {
            let rtol = 10.0_f64.powi(-n);
            let mut system = Ode::new(4, kepler);
            let options = Options::default();
            let end = solve(&mut system, (0.0, period), &y0, rtol, &options, &mut ()).unwrap();
            let error = y0
                .iter()
                .zip(&end.y)
                .fold(0.0_f64, |e, (a, b)| e.max((a - b).abs()));
            assert!(error < 1000.0 * rtol, "{rtol:e}: {error:e}");
            (rtol, error)
        })
        .collect();
    let proportion = slope(&points);
    assert!((proportion - 1.0).abs() < 0.2, "{proportion}: {points:?}");
}

/// Truth: the integral of a staircase is exact in every step, if no stage sees
/// the wrong side of a jump. The steps end on the jumps to the last bit.
#[test]
fn jumps_at_breakpoints_integrate_exactly() {
    let breakpoints = vec![0.7, 0.1, f64::from(1_u8) / 3.0, 0.7, -5.0, 9.0];
    let staircase = |t: f64| match t {
        t if t < 0.1 => 1.0,
        t if t < 1.0 / 3.0 => -3.0,
        t if t < 0.7 => 8.0,
        _ => 100.0,
    };
    let truth = 0.1 - 3.0 * (1.0 / 3.0 - 0.1) + 8.0 * (0.7 - 1.0 / 3.0) + 100.0 * (1.0 - 0.7);
    let mut system = Ode::new(1, |t, _: &[f64], dy: &mut [f64]| dy[0] = staircase(t));
    let options = Options {
        breakpoints,
        ..Options::default()
    };
    let mut ends = Vec::new();
    let mut from_left = true;
    let mut watch = |_: &mut _, step: &DenseStep<'_>, _: &StepStatistics| {
        ends.push(step.t1());
        from_left &= step.t1() >= 1.0 || step.dy1()[0] == staircase(step.t1().next_down());
        ControlFlow::Continue(())
    };
    let end = solve(&mut system, (0.0, 1.0), &[0.0], 1e-8, &options, &mut watch).unwrap();
    assert!((end.y[0] - truth).abs() < 1e-13, "{} {truth}", end.y[0]);
    assert_eq!(end.stats.rejected, 0);
    assert!(from_left);
    for stop in [0.1, 1.0 / 3.0, 0.7, 1.0] {
        assert!(ends.contains(&stop), "{stop} is not in {ends:?}");
    }
}

/// A breakpoint on the end of the span hides what begins there.
/// Truth: the integral of 1.
#[test]
fn breakpoint_at_the_end_is_seen_from_the_left() {
    let mut system = Ode::new(1, |t, _: &[f64], dy: &mut [f64]| {
        dy[0] = if t < 1.0 { 1.0 } else { f64::NAN };
    });
    let options = Options {
        breakpoints: vec![1.0],
        ..Options::default()
    };
    let end = solve(&mut system, (0.0, 1.0), &[0.0], 1e-6, &options, &mut ()).unwrap();
    assert!((end.y[0] - 1.0).abs() < 1e-15 && end.t == 1.0);
}

/// After a stop the step size from before it comes back. Truth: with a constant
/// derivative every free step has the largest size, so the sizes are known.
#[test]
fn step_size_is_restored_after_a_stop() {
    let mut system = Ode::new(1, |_, _: &[f64], dy: &mut [f64]| dy[0] = 1.0);
    let options = Options {
        first_step: Some(1.0),
        max_step: 1.0,
        breakpoints: vec![3.5, 6.75, 6.751],
        ..Options::default()
    };
    let mut sizes = Vec::new();
    let mut watch = |_: &mut _, step: &DenseStep<'_>, _: &StepStatistics| {
        sizes.push(step.h());
        ControlFlow::Continue(())
    };
    let end = solve(&mut system, (0.0, 9.0), &[0.0], 1e-6, &options, &mut watch).unwrap();
    let expected = [
        1.0, 1.0, 0.75, 0.75, 1.0, 1.0, 0.625, 0.625, 0.001, 1.0, 0.6245, 0.6245,
    ];
    assert_eq!(sizes.len(), expected.len(), "{sizes:?}");
    for (size, expected) in sizes.iter().zip(expected) {
        assert!((size - expected).abs() < 1e-12, "{sizes:?}");
    }
    assert_eq!(end.stats.smallest_step, 1.0);
    assert_eq!(end.stats.largest_step, 1.0);
    // The first step has size 1 of its own accord; four others were held to it.
    assert_eq!(end.stats.capped, 4);
}

/// Truth: the rule itself. An impulse that no smooth history announces makes
/// rejections; the step after the accepted one that follows never grows.
#[test]
fn no_growth_right_after_a_rejection() {
    let mut system = Ode::new(1, |t: f64, _: &[f64], dy: &mut [f64]| {
        dy[0] = 10.0 * (-((t - 5.0) / 0.1).powi(2)).exp();
    });
    let options = Options {
        max_step: 0.2,
        ..Options::default()
    };
    let mut log = Vec::new();
    let mut watch = |_: &mut _, step: &DenseStep<'_>, stats: &StepStatistics| {
        log.push((stats.rejected, step.h()));
        ControlFlow::Continue(())
    };
    let end = solve(&mut system, (0.0, 11.0), &[0.0], 1e-8, &options, &mut watch).unwrap();
    let mut seen = 0;
    for three in log.windows(3) {
        if three[1].0 > three[0].0 {
            seen += 1;
            assert!(three[2].1 <= three[1].1, "{three:?}");
        }
    }
    assert!(seen > 0);
    // The impulse's area, by Gauss: 10 · 0.1 · √π.
    let error = end.y[0] - std::f64::consts::PI.sqrt();
    assert!(error.abs() < 1e-6, "{error:e}");
}

/// A circle in states 0 and 1, and a third state whose derivative is `f(t)`;
/// the groups are 0, 3 and 7.
fn circle_and(
    f: impl Fn(f64) -> f64,
    options: &Options,
) -> (Result<Solution, Failure>, f64, usize) {
    let mut system = Ode::new(3, |t: f64, y: &[f64], dy: &mut [f64]| {
        dy.copy_from_slice(&[y[1], -y[0], f(t)]);
    });
    let tolerance = Tolerance::new(1e-6, vec![1e-6; 3], &[true; 3], vec![0, 3, 7]).unwrap();
    let (mut reached, mut rejected) = (0.0, 0);
    let mut watch = |_: &mut _, step: &DenseStep<'_>, stats: &StepStatistics| {
        reached = step.t1();
        rejected = stats.rejected;
        ControlFlow::Continue(())
    };
    let (span, y0) = ((0.0, 2.0), [0.0, 1.0, 0.0]);
    let tableau = &DORMAND_PRINCE;
    let result = integrate(
        &mut system,
        tableau,
        span,
        &y0,
        &tolerance,
        options,
        &mut watch,
    );
    (result, reached, rejected)
}

/// Truth: by construction. The third state has no derivative after t = 1, where
/// a step has landed, so every step from there fails, and the tenth is the last:
/// each a fifth of the one before.
#[test]
fn ten_non_finite_steps_in_a_row_are_a_failure() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (max_rejections, last) in [(10, 0.2_f64.powi(9)), (1, 1.0)] {
            let options = Options {
                breakpoints: vec![1.0],
                max_step: 0.01,
                max_rejections,
                ..Options::default()
            };
            let f = |t| if t > 1.0 { bad } else { 0.0 };
            let (result, reached, rejected) = circle_and(f, &options);
            let failure = result.unwrap_err();
            assert_eq!(failure.kind, FailureKind::NonFinite);
            assert_eq!((failure.time, failure.group), (1.0, 7));
            assert_eq!((reached, rejected), (1.0, 0));
            assert!((failure.step / (0.01 * last) - 1.0).abs() < 1e-9);
            assert!(failure.to_string().contains("group 7"), "{failure}");
        }
    }
}

/// Truth: by construction. A wall without a breakpoint can be approached for
/// ever, until the step is lost in the rounding of time.
#[test]
fn wall_of_nan_makes_the_step_too_small() {
    let f = |t| if t >= 1.0 { f64::NAN } else { 0.0 };
    let (result, reached, _) = circle_and(f, &Options::default());
    let failure = result.unwrap_err();
    assert_eq!((failure.kind, failure.group), (FailureKind::TooSmall, 7));
    assert_eq!(failure.time, reached);
    assert!(failure.time < 1.0 && failure.time > 1.0 - 1e-12);
}

/// Truth: by construction. A derivative that is noise at any scale passes at no
/// step size; the error is finite throughout, and the step shrinks to nothing.
#[test]
fn noise_shrinks_the_step_to_nothing() {
    // A hash of the bits of t: numbers from −1 to 1 that know nothing of their neighbours.
    let hash = |t: f64| {
        let bits = t.to_bits().wrapping_mul(0x9E37_79B9_7F4A_7C15);
        2.0 * ((bits ^ (bits >> 29)) >> 12) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let options = Options {
        first_step: Some(0.1),
        ..Options::default()
    };
    // From half a second on, where time itself has a resolution.
    let noise = |t: f64| if t > 0.5 { 1e12 * hash(t) } else { 0.0 };
    let (result, reached, _) = circle_and(noise, &options);
    let failure = result.unwrap_err();
    assert_eq!(failure.kind, FailureKind::TooSmall);
    assert_eq!((failure.time, failure.group), (reached, 7));
}

/// Truth: by construction. No step is needed to see it.
#[test]
fn non_finite_start_is_a_failure() {
    let (result, ..) = circle_and(|_| f64::NAN, &Options::default());
    let failure = result.unwrap_err();
    assert_eq!(failure.kind, FailureKind::NonFinite);
    assert_eq!((failure.time, failure.step, failure.group), (0.0, 0.0, 7));

    let options = Options {
        breakpoints: vec![0.5],
        ..Options::default()
    };
    let (result, reached, _) = circle_and(|t| if t == 0.5 { f64::NAN } else { 0.0 }, &options);
    let failure = result.unwrap_err();
    assert_eq!((failure.kind, failure.time), (FailureKind::NonFinite, 0.5));
    assert_eq!((reached, failure.group), (0.5, 7));

    let mut system = Ode::new(1, |_, _: &[f64], dy: &mut [f64]| dy[0] = 0.0);
    let options = Options::default();
    let failure = solve(
        &mut system,
        (0.0, 1.0),
        &[f64::NAN],
        1e-6,
        &options,
        &mut (),
    );
    assert_eq!(failure.unwrap_err().kind, FailureKind::NonFinite);
}

/// Truth: `exp(−t)`, which a long first step overshoots into the region where
/// the derivative does not exist. The rejection brings it back.
#[test]
fn passing_through_a_non_finite_region_is_recovered() {
    let mut system = Ode::new(1, |_, y: &[f64], dy: &mut [f64]| {
        dy[0] = if y[0] < 0.0 { f64::NAN } else { -y[0] };
    });
    let options = Options {
        first_step: Some(5.0),
        ..Options::default()
    };
    let end = solve(&mut system, (0.0, 5.0), &[1.0], 1e-8, &options, &mut ()).unwrap();
    assert!(end.stats.rejected > 0);
    assert!((end.y[0] - (-5.0_f64).exp()).abs() < 1e-7);
}

/// Truth: multiplication, which rounds once. Time after 200 000 steps of
/// 1 µs, within a run, is right to two ulps at every step.
#[test]
fn time_does_not_drift() {
    let h = 1e-6;
    let mut system = Ode::new(1, |_, _: &[f64], dy: &mut [f64]| dy[0] = 1.0);
    let (mut n, mut worst) = (0.0, 0.0_f64);
    let mut watch = |_: &mut _, step: &DenseStep<'_>, _: &StepStatistics| {
        n += 1.0;
        worst = worst.max((step.t1() - n * h).abs() / (step.t1().next_up() - step.t1()));
        ControlFlow::Continue(())
    };
    solve(&mut system, (0.0, 0.2), &[0.0], 1e-6, &fixed(h), &mut watch).unwrap();
    assert_eq!(n, 2e5);
    assert!(worst <= 2.0, "{worst} ulps");
}

/// Truth: the contract of [`Observer::accepted`]. The system was last asked at
/// the accepted state, to the bit; the observer may ask it elsewhere without
/// changing the run; the polynomial meets both ends.
#[test]
fn observer_finds_the_system_at_the_accepted_state() {
    let options = Options {
        breakpoints: vec![0.5],
        ..Options::default()
    };
    let mut watch = |system: &mut Ode<_>, step: &DenseStep<'_>, _: &StepStatistics| {
        let seen = if step.t1() == 0.5 {
            0.5_f64.next_down()
        } else {
            step.t1()
        };
        assert_eq!(system.last.0, seen);
        assert_eq!(system.last.1, step.y1());
        let (mut at0, mut at1) = ([0.0; 4], [0.0; 4]);
        step.interpolate(step.t0(), &mut at0);
        step.interpolate(step.t1(), &mut at1);
        assert_eq!(at0, step.y0());
        assert!(
            at1.iter()
                .zip(step.y1())
                .all(|(a, b)| (a - b).abs() < 1e-14)
        );
        let mut dy = [0.0; 4];
        system.rhs(step.t1(), step.y1(), &mut dy);
        assert_eq!(dy, step.dy1());
        system.rhs(-7.0, &[9.0; 4], &mut dy);
        ControlFlow::Continue(())
    };
    let y0 = [0.4, 0.0, 0.0, 2.0];
    let mut watched = Ode::new(4, kepler);
    let watched = solve(&mut watched, (0.0, 1.0), &y0, 1e-6, &options, &mut watch).unwrap();
    let mut alone = Ode::new(4, kepler);
    let alone = solve(&mut alone, (0.0, 1.0), &y0, 1e-6, &options, &mut ()).unwrap();
    assert_eq!(watched, alone);
}

/// Truth: the step at which it was to stop.
#[test]
fn observer_ends_the_run() {
    let mut system = Ode::new(4, kepler);
    let mut at = (0.0, Vec::new());
    let mut watch = |_: &mut _, step: &DenseStep<'_>, stats: &StepStatistics| {
        at = (step.t1(), step.y1().to_vec());
        if stats.accepted == 3 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let y0 = [0.4, 0.0, 0.0, 2.0];
    let options = Options::default();
    let end = solve(&mut system, (0.0, 1.0), &y0, 1e-6, &options, &mut watch).unwrap();
    assert!(end.interrupted && end.stats.accepted == 3);
    assert_eq!((end.t, end.y), at);
}

/// Truth: counting by the system itself. Six evaluations per attempt, one at the
/// start, one for the first step size, one after each inner breakpoint.
#[test]
fn evaluations_are_counted_exactly() {
    let y0 = [0.4, 0.0, 0.0, 2.0];
    for (first_step, breakpoints, extra) in [
        (None, vec![], 2),
        (Some(0.5), vec![], 1),
        (Some(0.5), vec![1.0, 2.0], 3),
    ] {
        let options = Options {
            first_step,
            breakpoints,
            ..Options::default()
        };
        let mut accepted = 0;
        let mut smallest = (f64::INFINITY, f64::NAN);
        let mut watch = |_: &mut _, step: &DenseStep<'_>, _: &StepStatistics| {
            accepted += 1;
            if step.h() < smallest.0 {
                smallest = (step.h(), step.t0());
            }
            ControlFlow::Continue(())
        };
        let mut system = Ode::new(4, kepler);
        let end = solve(&mut system, (0.0, 6.0), &y0, 1e-6, &options, &mut watch).unwrap();
        let stats = end.stats;
        assert_eq!(stats.nfev, system.calls);
        assert_eq!(stats.nfev, 6 * (stats.accepted + stats.rejected) + extra);
        assert_eq!(stats.accepted, accepted);
        assert!(first_step.is_none() || stats.rejected > 0);
        assert!(stats.smallest_step >= smallest.0);
        if extra == 2 {
            assert_eq!((stats.smallest_step, stats.smallest_step_time), smallest);
        }
    }
}

/// Truth: stability theory. With `λ = −10⁴` on a smooth slow solution the step
/// is held at `h|λ| ≈ 3.3`; with `λ = −1` accuracy holds it.
#[test]
fn stiffness_is_distinguished_from_accuracy() {
    for (rate, stiff) in [(1e4, true), (1.0, false)] {
        let mut system = Ode::new(1, |t: f64, y: &[f64], dy: &mut [f64]| {
            dy[0] = -rate * (y[0] - t.cos()) - t.sin();
        });
        let options = Options::default();
        let end = solve(&mut system, (0.0, 2.0), &[1.0], 1e-4, &options, &mut ()).unwrap();
        assert!((end.y[0] - 2.0_f64.cos()).abs() < 1e-3);
        let share = end.stats.share_stiff();
        assert!((0.0..=1.0).contains(&share));
        assert_eq!(share > 0.3, stiff, "{share}");
        if stiff {
            let mean = 2.0 / end.stats.accepted as f64 * rate;
            assert!((mean - 3.3).abs() < 0.3, "{mean}");
        }
    }
}

/// Truth: none of these inputs means anything.
#[test]
fn meaningless_input_is_refused() {
    let run = |span, y0: &[f64], options: &Options| {
        let mut system = Ode::new(1, wave);
        let kind = solve(&mut system, span, y0, 1e-6, options, &mut ()).map_err(|f| f.kind);
        matches!(kind, Err(FailureKind::Invalid(_)))
    };
    let good = Options::default();
    assert!(!run((0.0, 1.0), &[1.0], &good));
    assert!(!run((1.0, 1.0), &[1.0], &good));
    assert!(run((1.0, 0.0), &[1.0], &good));
    assert!(run((0.0, f64::INFINITY), &[1.0], &good));
    assert!(run((0.0, 1.0), &[1.0, 2.0], &good));
    for bad in [0.0, -1.0, f64::NAN] {
        let max_step = Options {
            max_step: bad,
            ..good.clone()
        };
        let first_step = Options {
            first_step: Some(bad),
            ..good.clone()
        };
        for options in [max_step, first_step, fixed(bad)] {
            assert!(run((0.0, 1.0), &[1.0], &options));
        }
    }
    let breakpoints = vec![0.5, f64::NAN];
    assert!(run(
        (0.0, 1.0),
        &[1.0],
        &Options {
            breakpoints,
            ..good
        }
    ));
}

/// Truth: by construction. Only the second stage, which has no weight in the
/// solution or the error, is NaN, and the next evaluation swallows it as a
/// comparison would. It must be seen all the same.
#[test]
fn swallowed_nan_is_seen() {
    let mut system = Ode::new(1, |t: f64, y: &[f64], dy: &mut [f64]| {
        dy[0] = if (0.1..0.25).contains(&t) {
            f64::NAN
        } else {
            y[0].max(0.0)
        };
    });
    let failure = solve(&mut system, (0.0, 1.0), &[1.0], 1e-6, &fixed(1.0), &mut ());
    assert_eq!(failure.unwrap_err().kind, FailureKind::NonFinite);
}

/// Truth: Hairer's formula worked by hand for `y' = −y`, `y(0) = 1`. All scales
/// are 2·10⁻⁶, state, slope and bend are 5·10⁵, so `h = (0.01/5·10⁵)^(1/5)`,
/// unless the largest step or the first breakpoint is nearer. The trial goes a
/// hundredth of state over slope, and no further than the step may.
#[test]
fn first_step_follows_the_formula() {
    let formula = (0.01_f64 / 5e5).powf(0.2);
    for (max_step, breakpoint, expected) in [
        (1.0, 0.9, formula),
        (0.015, 0.9, 0.015),
        (1.0, 0.02, 0.02),
        (1.0, 1e-9, 1e-9),
    ] {
        let mut asked = Vec::new();
        let mut system = Ode::new(1, |_, y: &[f64], dy: &mut [f64]| {
            asked.push(y[0]);
            dy[0] = -y[0];
        });
        let options = Options {
            max_step,
            breakpoints: vec![breakpoint],
            ..Options::default()
        };
        let mut watch = |_: &mut _, step: &DenseStep<'_>, stats: &StepStatistics| {
            let right = (step.h() / expected - 1.0).abs() < 1e-6;
            assert!(right && stats.rejected == 0, "{} {expected}", step.h());
            ControlFlow::Break(())
        };
        solve(&mut system, (0.0, 1.0), &[1.0], 1e-6, &options, &mut watch).unwrap();
        let trial = expected.min(0.01);
        assert!(((1.0 - asked[1]) / trial - 1.0).abs() < 1e-6);
    }
}
