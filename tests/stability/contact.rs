//! Where contacts break methods: order at make and break, energy, damping that pulls.
//!
//! Each test names the failure, shows it, and shows what happens here instead. `--nocapture` prints the numbers.

use crate::common;
use std::ops::ControlFlow;

use ballrace::compile;
use ballrace::contact::Elastic;
use ballrace::contact::iso16281::Iso16281;
use ballrace::dynamics::Dynamics;
use ballrace::dynamics::rhs;
use ballrace::inspect;
use ballrace::integrate::{DORMAND_PRINCE, DenseStep, Options, System, Tolerance, integrate};
use ballrace::scene::{NormalLaw, Scene};
use ballrace::{Bandwidth, Model, Race, Run, Start, start};
use common::{ball_mass, one_ball, restitution_of, rms, run, slope};

/// A mass that flies against one slice of the ISO law: ẍ = −F(x)/m.
struct Slice {
    law: Elastic,
    mass: f64,
}

impl System for Slice {
    fn dim(&self) -> usize {
        2
    }

    fn rhs(&mut self, _: f64, y: &[f64], dy: &mut [f64]) {
        let force = if y[0] > 0.0 {
            self.law.force(y[0], 1e-3)
        } else {
            0.0
        };
        dy.copy_from_slice(&[y[1], -force / self.mass]);
    }
}

/// States at the end of fixed steps of Dormand–Prince, the breakpoints met exactly.
fn fixed<S: System>(system: &mut S, y0: &[f64], end: f64, h: f64, breakpoints: &[f64]) -> Vec<f64> {
    let options = Options {
        fixed_step: Some(h),
        breakpoints: breakpoints.to_vec(),
        ..Options::default()
    };
    let tolerance = Tolerance::uniform(y0.len(), 0.0, 1.0).unwrap();
    let span = (0.0, end);
    integrate(
        system,
        &DORMAND_PRINCE,
        span,
        y0,
        &tolerance,
        &options,
        &mut (),
    )
    .unwrap()
    .y
}

/// Failure: a contact that begins within a step takes the method's order five away. Over a step that meets a force
/// s^q the velocity is off by h^{q+1}: 2.11 for one slice of exponent 10/9.
/// What locating the event buys: the force still rises like t^q from it, so the order stays; only the constant falls.
/// Truth: the exponent, and the same impact by steps a thousand times finer.
#[test]
fn a_slice_begins_at_order_two() {
    let (speed, mass) = (0.1, ball_mass());
    let mut slice = Slice {
        law: Elastic::Iso16281(Iso16281::new(3.5948e10, 0.5, 7.94e-3)),
        mass,
    };
    // Well inside the contact, before it is deepest.
    let inside = 8e-6;
    let orders = [false, true].map(|located| {
        let points: Vec<(f64, f64)> = (0..6)
            .map(|k| {
                let h = 2e-6 * 0.5_f64.powi(k);
                // The contact begins anywhere in a step.
                let errors: Vec<f64> = (0..20)
                    .map(|i| {
                        let lead = h * (3.0 + f64::from(i) / 20.0);
                        let y0 = [-speed * lead, speed];
                        let stop = [lead];
                        let stops = if located { &stop[..] } else { &[] };
                        let rough = fixed(&mut slice, &y0, lead + inside, h, stops)[1];
                        let fine = fixed(&mut slice, &y0, lead + inside, h / 1024.0, &stop)[1];
                        rough - fine
                    })
                    .collect();
                (h, rms(&errors) / speed)
            })
            .collect();
        (slope(&points), points[3].1)
    });
    println!("(order, error at 0.25 µs) without and with location: {orders:?}");
    assert!(
        orders
            .iter()
            .all(|(order, _)| (order - 19.0 / 9.0).abs() < 0.02)
    );
    assert!(orders[1].1 < 0.1 * orders[0].1);
}

/// The ball of `one_ball` in a clearance, its place and speed towards the outer race when it is `lead` seconds before
/// the touch.
fn flying(damping: f64, speed: f64, lead: f64) -> (Scene, Vec<f64>) {
    let mut scene = one_ball(-1e-3);
    scene.contact.damping = damping;
    let model = compile(&scene).unwrap();
    let mut y = start(&model, &Start::Rolling).unwrap();
    let half = y.len() / 2;
    y[half..].fill(0.0);
    y[8] += 0.25e-3 - speed * lead;
    y[half + 8] = speed;
    (scene, y)
}

/// The same for a whole ball on the race: its zone grows from a point, so that the summed ISO law rises like s^{29/18}
/// and begins at order 2.61, Hertz's s^{3/2} at 2.5.
#[test]
fn a_ball_begins_at_order_two_and_a_half() {
    let speed = 0.1;
    let inside = 8e-6;
    for law in NormalLaw::all() {
        let expected = match law {
            NormalLaw::Iso16281 { .. } => 47.0 / 18.0,
            NormalLaw::Hertz => 2.5,
            other => panic!("the order at which {other:?} begins"),
        };
        let points: Vec<(f64, f64)> = (0..5)
            .map(|k| {
                let h = 2e-6 * 0.5_f64.powi(k);
                let errors: Vec<f64> = (0..12)
                    .map(|i| {
                        let lead = h * (3.0 + f64::from(i) / 12.0);
                        let (mut scene, y0) = flying(0.0, speed, lead);
                        scene.contact.law = law.clone();
                        let model = compile(&scene).unwrap();
                        let mut dynamics = Dynamics::new(&model);
                        let v = y0.len() / 2 + 8;
                        let end = lead + inside;
                        let rough = fixed(&mut dynamics, &y0, end, h, &[])[v];
                        let fine = fixed(&mut dynamics, &y0, end, h / 64.0, &[lead])[v];
                        rough - fine
                    })
                    .collect();
                (h, rms(&errors) / speed)
            })
            .collect();
        let order = slope(&points);
        println!("{law:?}: {order:.3} (expected {expected:.3}): {points:?}");
        assert!((order - expected).abs() < 0.05, "{order}");
    }
}

/// Total energy of a state, relative to the ball's at the start above rest.
fn energies(model: &Model, h: f64, steps: usize, verlet: bool, y0: &[f64]) -> Vec<f64> {
    let mut energies = Vec::new();
    if verlet {
        let (mut y, mut dy) = (y0.to_vec(), y0.to_vec());
        let half = y.len() / 2;
        rhs(model, 0.0, &y, &mut dy);
        for _ in 0..steps {
            for i in 0..half {
                y[half + i] += 0.5 * h * dy[half + i];
                y[i] += h * y[half + i];
            }
            rhs(model, 0.0, &y, &mut dy);
            for i in 0..half {
                y[half + i] += 0.5 * h * dy[half + i];
            }
            energies.push(inspect::energy(model, &y).unwrap().total());
        }
    } else {
        let options = Options {
            fixed_step: Some(h),
            ..Options::default()
        };
        let tolerance = Tolerance::uniform(y0.len(), 0.0, 1.0).unwrap();
        let mut watch = |_: &mut Dynamics<'_>, step: &DenseStep<'_>, _: &_| {
            energies.push(inspect::energy(model, step.y1()).unwrap().total());
            ControlFlow::Continue(())
        };
        let span = (0.0, steps as f64 * h);
        let mut dynamics = Dynamics::new(model);
        integrate(
            &mut dynamics,
            &DORMAND_PRINCE,
            span,
            y0,
            &tolerance,
            &options,
            &mut watch,
        )
        .unwrap();
    }
    energies
}

/// Failure: Dormand–Prince is not symplectic; an undamped contact loses or gains energy with every period, where
/// velocity Verlet only wavers. Truth: conservation; Hunt–Crossley's own loss for comparison.
/// Instead: at the step cap the drift is far below the loss of the lightest physical damping.
#[test]
fn energy_drifts_less_than_damping_takes() {
    // A ball squeezed between both races, which swings by a tenth of the approach.
    let scene = one_ball(10e-6);
    let model = compile(&scene).unwrap();
    let frequency = model.scales().frequency;
    let swing = |scene: &Scene| {
        let model = compile(scene).unwrap();
        let mut y = start(&model, &Start::Rolling).unwrap();
        let v = y.len() / 2 + 8;
        y[v] = 0.05;
        (model, y)
    };
    let (model, y0) = swing(&scene);
    // Kinetic energy at the start measures what there is to lose.
    let whole = inspect::energy(&model, &y0).unwrap().kinetic;
    // Steps of 1/(n ω): n steps to a radian, 6.28 n to a period.
    let drift = |n: u32, verlet: bool| {
        let h = 1.0 / (f64::from(n) * frequency);
        let e = energies(&model, h, 1257 * n as usize, verlet, &y0);
        let tenth = e.len() / 10;
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        let (first, last) = (mean(&e[..tenth]), mean(&e[e.len() - tenth..]));
        (last - first) / whole / (0.9 * 200.0)
    };
    let mut damped = scene.clone();
    damped.contact.damping = 0.2;
    let (damped, y) = swing(&damped);
    let lost = energies(&damped, 0.05 / frequency, 126 * 20, false, &y);
    let physical = (lost.last().unwrap() - lost[0]) / whole / 20.0;
    for n in [1, 2, 4, 10] {
        println!(
            "h = 1/({n} ω): Dormand-Prince {:.1e} a period, Verlet {:.1e}; damping takes {physical:.1e}",
            drift(n, false),
            drift(n, true)
        );
    }
    assert!(drift(1, false).abs() < 1e-2 * physical.abs());
    assert!(drift(2, false).abs() < 1e-3 * physical.abs());
    assert!(drift(4, true).abs() < 1e-5);
    // Verlet wavers instead of drifting: ten times the step makes no more of it than Dormand-Prince's 1/(2 ω).
    assert!(drift(1, false).abs() > 5.0 * drift(1, true).abs());
}

/// Failure: Hunt–Crossley's force, fitted for small α_d v, is often read as restitution 1 − α_d v, which is negative
/// beyond 1. Truth: its closed form.
/// Instead: for α_d v from 0.01 to 5 the rebound follows the closed form and never pulls.
#[test]
fn restitution_stays_positive_and_free_impacts_never_pull() {
    let speed = 0.5;
    for size in [0.01, 0.1, 0.5, 1.0, 2.0, 5.0] {
        let (scene, y0) = flying(size / speed, speed, 1e-6);
        let out = run(
            &scene,
            &Run {
                duration: 0.4e-3,
                fs: 1e6,
                start: Start::State(y0),
                rtol: Some(1e-9),
                threads: 1,
                bandwidth: Bandwidth::Raw,
                settle: Some(0.0),
                ..Run::default()
            },
        );
        let ratio = -out.get("ball.vx").unwrap().last().unwrap() / speed;
        let truth = restitution_of(size);
        println!("α_d v = {size}: restitution {ratio:.6}, closed form {truth:.6}");
        assert!((ratio / truth - 1.0).abs() < 1e-4 && ratio > 0.0);
        assert_eq!(out.stats.clamped_pulls, 0);
    }
}

/// Failure: a contact that is torn apart faster than 2/(3 α_d) would pull, as no dry contact does.
/// Truth: the sign of 1 + 3/2 α_d v_n. Instead: clamped to zero and counted; `clamp_pull = false` keeps the bare sum.
#[test]
fn a_torn_contact_does_not_pull_and_is_counted() {
    for clamp in [true, false] {
        let mut scene = one_ball(80e-6);
        scene.contact.damping = 0.2;
        scene.contact.clamp_pull = clamp;
        // Pulls are counted at the ends of steps, and this contact opens within a few µs.
        scene.solver.max_step = Some(0.2e-6);
        let model = compile(&scene).unwrap();
        let y0 = start(&model, &Start::Rolling).unwrap();
        let v = y0.len() / 2 + 8;
        // 2/(3 · 0.2) = 3.33 m/s.
        for (speed, torn) in [(3.3, false), (3.4, true), (10.0, true)] {
            let mut y = y0.clone();
            y[v] = -speed;
            let mut dynamics = Dynamics::new(&model);
            let mut dy = y.clone();
            dynamics.rhs(0.0, &y, &mut dy);
            let outer: f64 = inspect::slice_forces(&model, &y, 0, Race::Outer)
                .unwrap()
                .iter()
                .map(|slice| slice.force)
                .sum();
            assert_eq!(dynamics.pulls() > 0, torn, "{speed}");
            match (torn, clamp) {
                (false, _) => assert!(outer > 0.0, "{outer}"),
                (true, true) => assert_eq!(outer, 0.0),
                (true, false) => assert!(outer < -1.0, "{outer}"),
            }
        }
        let mut y = y0.clone();
        y[v] = -5.0;
        let out = run(
            &scene,
            &Run {
                duration: 20e-6,
                fs: 10e6,
                start: Start::State(y),
                bandwidth: Bandwidth::Raw,
                ..Run::default()
            },
        );
        println!(
            "clamp {clamp}: {} clamped pulls in {} steps",
            out.stats.clamped_pulls, out.stats.accepted
        );
        assert!(out.stats.clamped_pulls > 0);
    }
}
