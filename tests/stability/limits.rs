//! Where the step size fails: stability limits, and loose tolerances that cost more or lie.
//!
//! Each test names the failure, shows it, and shows what happens here instead. `--nocapture` prints the numbers.

use crate::common;
use ballrace::compile;
use ballrace::dynamics::Dynamics;
use ballrace::dynamics::rhs;
use ballrace::inspect;
use ballrace::integrate::{
    DORMAND_PRINCE, FailureKind, Options, Solution, System, Tableau, Tolerance, integrate,
};
use ballrace::scene::{Friction, Method};
use ballrace::{Model, Race, Run, Signals, Start, Warning, start};
use common::{apart, one_ball, run, short, soon_over_the_spall};

/// A method, its stability polynomial's coefficients from z² on, and where it ends on the two axes.
struct Case {
    tableau: &'static Tableau,
    polynomial: &'static [f64],
    real: f64,
    imaginary: f64,
}

/// Literature: Hairer, Wanner, *Solving Ordinary Differential Equations II*, section IV.2, for the polynomial.
const CASES: [Case; 1] = [Case {
    tableau: &DORMAND_PRINCE,
    polynomial: &[1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 600.0],
    real: 3.3066,
    imaginary: 0.9972,
}];

/// ẍ = −2 ζ x' − x, whose λ are −ζ ± i √(1 − ζ²): of size 1. With ζ > 1 only the decay x' = −x.
struct Mode(f64);

impl Mode {
    /// Size of the coordinate along an eigenvector, |v − λ̄ x|, which a step multiplies by just |R|.
    fn amplitude(&self, y: &[f64]) -> f64 {
        match y {
            [x, v] => (x * x + 2.0 * self.0 * x * v + v * v).sqrt(),
            _ => y[0].abs(),
        }
    }
}

impl System for Mode {
    fn dim(&self) -> usize {
        if self.0 > 1.0 { 1 } else { 2 }
    }

    fn rhs(&mut self, _: f64, y: &[f64], dy: &mut [f64]) {
        if let [x, v] = y {
            dy.copy_from_slice(&[*v, -2.0 * self.0 * v - x]);
        } else {
            dy[0] = -y[0];
        }
    }
}

/// Amplitude after steps of a method, over that at the start; infinite where it overflows; and the run.
fn after(
    mode: &mut Mode,
    tableau: &Tableau,
    steps: f64,
    options: &Options,
    rtol: f64,
) -> (f64, Option<Solution>) {
    let y0 = vec![1.0; mode.dim()];
    let span = (0.0, steps * options.fixed_step.unwrap_or(1.0));
    let tolerance = Tolerance::uniform(y0.len(), rtol, rtol).unwrap();
    match integrate(mode, tableau, span, &y0, &tolerance, options, &mut ()) {
        Ok(end) => (mode.amplitude(&end.y) / mode.amplitude(&y0), Some(end)),
        Err(failure) => {
            assert_eq!(failure.kind, FailureKind::NonFinite);
            (f64::INFINITY, None)
        }
    }
}

fn fixed(h: f64) -> Options {
    Options {
        fixed_step: Some(h),
        ..Options::default()
    }
}

/// The largest h at which a mode's amplitude does not grow, between 0.3 and 8, by bisection.
fn limit(stable: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.3, 8.0);
    for _ in 0..40 {
        let middle = f64::midpoint(low, high);
        if stable(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// |R(z)| at z = h λ.
fn amplification(polynomial: &[f64], h: f64, damping: f64) -> f64 {
    let (x, y) = if damping > 1.0 {
        (-h, 0.0)
    } else {
        (-h * damping, h * (1.0 - damping * damping).sqrt())
    };
    // Horner's scheme on 1 + z + c₂ z² + …
    let sum = polynomial
        .iter()
        .rev()
        .chain(&[1.0, 1.0])
        .fold((0.0, 0.0), |(a, b), c| (x * a - y * b + c, x * b + y * a));
    sum.0.hypot(sum.1)
}

/// Failure: a fixed step beyond the stability limit diverges, however smooth the solution.
/// Truth: the method's stability polynomial, on both axes and for damped modes, to 1e-3; that |R| stays below 1 for
/// any smaller step is looked at too.
#[test]
fn fixed_steps_diverge_beyond_the_stability_limit() {
    for case in &CASES {
        for (name, damping) in [
            ("real", 2.0),
            ("imaginary", 0.0),
            ("damped 1 %", 0.01),
            ("damped 5 %", 0.05),
            ("damped 20 %", 0.2),
            ("damped 70 %", 0.7),
        ] {
            let stable = |h: f64| amplification(case.polynomial, h, damping) <= 1.0;
            let expected = limit(stable);
            let measured = limit(|h| {
                after(&mut Mode(damping), case.tableau, 1000.0, &fixed(h), 1.0).0 <= 1.0 + 1e-10
            });
            println!(
                "{}, {name}: {measured:.4} ({expected:.4})",
                case.tableau.name
            );
            assert!(
                (measured / expected - 1.0).abs() < 1e-3,
                "{name}: {measured}, not {expected}"
            );
            let published = match name {
                "real" => case.real,
                "imaginary" => case.imaginary,
                _ => continue,
            };
            assert!(
                (measured / published - 1.0).abs() < 1e-3,
                "{name}: {measured}, not {published}"
            );
        }
        assert!((case.tableau.stability_limit / case.real - 1.0).abs() < 1e-4);
    }
}

/// The same modes under step-size control: where a fixed step 5 % beyond the limit has grown a millionfold, the
/// controller keeps the error by steps that stay within the limit on average, and says so in the stiffness count.
/// Truth: stability theory.
#[test]
fn the_controller_holds_where_a_fixed_step_diverges() {
    for (damping, rtol) in [(2.0, 1e-3), (0.2, 1e-3), (0.05, 1e-3)] {
        let polynomial = CASES[0].polynomial;
        let h = 1.05 * limit(|h| amplification(polynomial, h, damping) <= 1.0);
        let (grown, _) = after(&mut Mode(damping), &DORMAND_PRINCE, 1000.0, &fixed(h), 1.0);
        let free = Options {
            first_step: Some(h),
            ..Options::default()
        };
        let (held, end) = after(&mut Mode(damping), &DORMAND_PRINCE, 2000.0 * h, &free, rtol);
        let end = end.unwrap();
        let mean = end.t / end.stats.accepted as f64 / (h / 1.05);
        println!(
            "ζ = {damping}: fixed {grown:.1e}, controlled {held:.1e}, mean step {mean:.3} of the limit, \
             {:.2} at the limit",
            end.stats.share_stiff()
        );
        assert!(grown > 1e6, "{grown}");
        assert!(held < 20.0 * rtol, "{held}");
        assert!(mean < 1.01, "{mean}");
        assert!(damping < 1.0 || end.stats.share_stiff() > 0.3);
    }
}

fn coulomb(coefficient: f64, slip_speed: f64) -> Friction {
    Friction::Coulomb {
        coefficient,
        slip_speed,
    }
}

/// Nothing moves, and the two races press the ball alike: a pulsing load would blur the limit.
fn squeezed_in_balance(model: &Model) -> Vec<f64> {
    let mut y = start(model, &Start::Rolling).unwrap();
    let mut dy = y.clone();
    let (x, ax) = (8, y.len() / 2 + 8);
    let (mut low, mut high) = (y[x] - 5e-6, y[x] + 5e-6);
    for _ in 0..60 {
        y[x] = f64::midpoint(low, high);
        rhs(model, 0.0, &y, &mut dy);
        if dy[ax] > 0.0 {
            low = y[x];
        } else {
            high = y[x];
        }
    }
    y
}

/// Failure: friction shrinks the explicit step with the slip speed, to 3.31/λ.
/// Truth: λ = 5 μ N/(m v_s) against the right-hand side's own derivative; a fixed step 2 % within
/// the limit lets the spin of a squeezed ball die out, 2 % beyond it lets it grow.
#[test]
fn friction_holds_the_step_at_the_stability_limit() {
    for slip_speed in [0.01, 0.001] {
        let mut scene = one_ball(10e-6);
        scene.friction = coulomb(0.05, slip_speed);
        let model = compile(&scene).unwrap();
        let y0 = squeezed_in_balance(&model);
        let loads = Race::BOTH.map(|race| inspect::contact(&model, &y0, 0, race).unwrap().load);
        let mass = 7850.0 * std::f64::consts::PI * 7.94e-3_f64.powi(3) / 6.0;
        let rate = 5.0 * 0.05 * f64::midpoint(loads[0], loads[1]) / (mass * slip_speed);
        let spin = y0.len() - 1;
        let spinning = |omega: f64| {
            let mut y = y0.clone();
            y[spin] = omega;
            y
        };
        let slow = 1e-4 * slip_speed / 4e-3;
        let mut dy = y0.clone();
        rhs(&model, 0.0, &spinning(slow), &mut dy);
        let measured = -dy[spin] / slow;
        let end = |share: f64| {
            let h = share * DORMAND_PRINCE.stability_limit / measured;
            let options = Options {
                fixed_step: Some(h),
                ..Options::default()
            };
            let tolerance = Tolerance::uniform(y0.len(), 0.0, 1.0).unwrap();
            let mut dynamics = Dynamics::new(&model);
            let span = (0.0, 400.0 * h);
            integrate(
                &mut dynamics,
                &DORMAND_PRINCE,
                span,
                &spinning(slow),
                &tolerance,
                &options,
                &mut (),
            )
            .unwrap()
            .y[spin]
                .abs()
                / slow
        };
        println!(
            "v_s = {slip_speed}: 5μN/(m v_s) = {rate:.3e}, measured {measured:.3e} 1/s, spin after 400 steps at 0.98 \
             and 1.02 of 3.31/λ: {:.1e}, {:.1e}",
            end(0.98),
            end(1.02)
        );
        assert!((measured / rate - 1.0).abs() < 0.02, "{measured} {rate}");
        assert!(end(0.98) < 1e-2 && end(1.02) > 1e2);
    }
}

/// The wheel bearing with an impact, at a slip speed and a damping.
fn impact(method: Method, slip_speed: f64, damping: f64, cap: bool, rtol: f64) -> Signals {
    let mut scene = soon_over_the_spall(3000.0);
    scene.friction = coulomb(0.05, slip_speed);
    scene.contact.damping = damping;
    scene.solver.frequency_cap = cap;
    run(
        &scene,
        &Run {
            rtol: Some(rtol),
            method: Some(method),
            ..short(2e-3)
        },
    )
}

/// The pair whose failures these are; the default is judged beside it.
const PAIR: Method = Method::DormandPrince;

fn ay(out: &Signals) -> &[f64] {
    out.get("outer.ay").unwrap()
}

fn doubts_accelerations(out: &Signals) -> bool {
    out.warnings()
        .iter()
        .any(|warning| matches!(warning, Warning::Accelerations { .. }))
}

/// Failure: a loose tolerance reports success with wrong accelerations, because the step sits beyond the contacts'
/// period. Truth: the same run at rtol 1e-10.
/// Instead: the step cap makes the same tolerance right; without it, and where friction or damping are too fast
/// for the cap, the run is warned of.
#[test]
fn a_loose_tolerance_lies_unless_capped_or_warned_of() {
    for (slip_speed, damping, runs) in [
        (
            0.1,
            0.2,
            vec![
                (false, 1e-2, true),
                (true, 1e-2, false),
                (true, 1e-6, false),
            ],
        ),
        (0.01, 0.2, vec![(true, 1e-3, true)]),
        (0.001, 0.2, vec![(true, 1e-4, true), (true, 1e-6, false)]),
        (
            0.1,
            5.0,
            vec![(true, 1e-2, true), (true, 1e-4, true), (true, 1e-6, false)],
        ),
    ] {
        let truth = impact(PAIR, slip_speed, damping, true, 1e-10);
        assert!(!doubts_accelerations(&truth));
        for (cap, rtol, wrong) in runs {
            let out = impact(PAIR, slip_speed, damping, cap, rtol);
            let error = apart(ay(&out), ay(&truth));
            let residual = out.stats.acceleration_residual.unwrap();
            println!(
                "v_s {slip_speed}, α_d {damping}, cap {cap}, rtol {rtol:e}: error {error:.1e}, residual {residual:.1e}, \
                 {} evaluations, {} warnings",
                out.stats.nfev,
                out.warnings().len()
            );
            assert_eq!(error > 0.05, wrong, "{error}");
            assert!(wrong || error < 0.01, "{error}");
            assert_eq!(doubts_accelerations(&out), wrong, "residual {residual}");
        }
    }
}

/// Failure: the default at tolerances looser than its own, with the step cap and without. Truth: the pair at rtol 1e-10.
/// Instead: where its accelerations are wrong by more than 5 % it says so, and at its own tolerance they are right, however
/// fast friction and damping are.
#[test]
fn the_default_is_right_or_says_that_it_is_not() {
    for (slip_speed, damping) in [(0.1, 0.2), (0.01, 0.2), (0.001, 0.2), (0.1, 5.0)] {
        let truth = impact(PAIR, slip_speed, damping, true, 1e-10);
        for (cap, rtol) in [true, false]
            .into_iter()
            .flat_map(|cap| [1e-2, 1e-3, 1e-4, 1e-7].map(|rtol| (cap, rtol)))
        {
            let out = impact(Method::Adams, slip_speed, damping, cap, rtol);
            let error = apart(ay(&out), ay(&truth));
            println!(
                "v_s {slip_speed}, α_d {damping}, cap {cap}, rtol {rtol:e}: error {error:.1e}, residual {:.1e}, {} evaluations",
                out.stats.acceleration_residual.unwrap(),
                out.stats.nfev
            );
            assert!(error < 0.05 || doubts_accelerations(&out), "{error}");
            let by_default = rtol < 1e-6;
            assert!(!by_default || error < 0.003 && !doubts_accelerations(&out));
        }
    }
}

/// Failure: a looser tolerance that costs more. With slip speed 0.001 m/s, rtol 1e-5 chatters across the friction's
/// kink and pays more than 1e-6, which resolves it. Truth: counted evaluations, error against rtol 1e-10.
/// Instead: the warning's residual shows which of the two to believe.
#[test]
fn a_looser_tolerance_can_cost_more() {
    let truth = impact(PAIR, 0.001, 0.2, true, 1e-10);
    let [loose, tight] = [1e-5, 1e-6].map(|rtol| impact(PAIR, 0.001, 0.2, true, rtol));
    let error = |out: &Signals| apart(ay(out), ay(&truth));
    println!(
        "rtol 1e-5: {} evaluations, error {:.1e}; 1e-6: {}, {:.1e}",
        loose.stats.nfev,
        error(&loose),
        tight.stats.nfev,
        error(&tight)
    );
    assert!(loose.stats.nfev > tight.stats.nfev);
    assert!(error(&loose) > 10.0 * error(&tight));
    assert!(doubts_accelerations(&loose) && !doubts_accelerations(&tight));
}

/// Failure: a right-hand side that is not a number anywhere. Instead: ten smaller steps, then an error that says so.
#[test]
fn a_fixed_step_into_nothing_is_an_error() {
    struct Nothing;
    impl System for Nothing {
        fn dim(&self) -> usize {
            1
        }
        fn rhs(&mut self, t: f64, _: &[f64], dy: &mut [f64]) {
            dy[0] = if t > 0.5 { f64::NAN } else { 1.0 };
        }
    }
    let tolerance = Tolerance::uniform(1, 1e-6, 1e-6).unwrap();
    let (span, options) = ((0.0, 1.0), fixed(0.4));
    let failed = integrate(
        &mut Nothing,
        &DORMAND_PRINCE,
        span,
        &[0.0],
        &tolerance,
        &options,
        &mut (),
    );
    assert_eq!(failed.unwrap_err().kind, FailureKind::NonFinite);
}
