//! Approximations by request do what they say and nothing else; what they cost in accuracy is measured in
//! `benches/approximations.py`.

use crate::common;
use std::f64::consts::PI;

use ballrace::Reduction;
use ballrace::compile;
use ballrace::dynamics::Dynamics;
use ballrace::dynamics::rhs;
use ballrace::inspect;
use ballrace::integrate::System;
use ballrace::scene::{
    Approximations, Defect, Drive, Friction, Method, Mount, NormalLaw, Patch, Profile, Scene,
    Surface, TimeFunction, presets,
};
use ballrace::{Model, Race, Run, Start, simulate, start};
use common::Noise;

const ROLLING: Approximations = {
    let mut asked = Approximations::NONE;
    asked.rolling = true;
    asked
};
const SYMMETRIC: Approximations = {
    let mut asked = Approximations::NONE;
    asked.plane = true;
    asked
};
const ONE_ROW: Approximations = {
    let mut asked = Approximations::NONE;
    asked.one_row = true;
    asked
};
const FLAT: Approximations = {
    let mut asked = Approximations::NONE;
    asked.rolling = true;
    asked.plane = true;
    asked
};

fn wheel(law: NormalLaw, approximations: Approximations) -> Scene {
    let mut scene = presets::wheel_bearing(3000.0);
    scene.contact.law = law;
    scene.approximations = approximations;
    scene
}

/// Thrust that takes the load off a row.
fn thrust(approximations: Approximations) -> Scene {
    let mut scene = presets::wheel_bearing(20e3);
    scene.loads.get_mut("radial").unwrap().force = 500.0.into();
    scene.approximations = approximations;
    scene
}

/// States of all bodies and of a run near the start, at a time.
struct Shaken<'m> {
    model: &'m Model,
    dynamics: Dynamics<'m>,
    t: f64,
    y: Vec<f64>,
    full: Vec<f64>,
    rates: Vec<f64>,
}

impl<'m> Shaken<'m> {
    fn new(model: &'m Model, seed: u64) -> Self {
        let y0 = start(model, &Start::Equilibrium).unwrap();
        let mut dynamics = Dynamics::reduced(model, Reduction::of(model, &y0).unwrap(), &y0);
        let mut noise = Noise(seed);
        let mut shaken = y0.clone();
        let half = shaken.len() / 2;
        for i in (0..half).filter(|i| i % 4 < 3) {
            shaken[i] += 5e-6 * noise.next();
            shaken[half + i] += 0.1 * noise.next();
        }
        let y = dynamics.compress(&shaken);
        let t = 2e-3 * (1.0 + noise.next());
        let (mut full, mut rates, mut dy) = (y0.clone(), y0, vec![0.0; y.len()]);
        dynamics.rhs(t, &y, &mut dy);
        dynamics.expand(t, &y, &mut full);
        dynamics.expand_rates(t, &y, &dy, &mut rates);
        Self {
            model,
            dynamics,
            t,
            y,
            full,
            rates,
        }
    }

    /// Rates of the free bodies there, without what the scene gives up.
    fn free(&self) -> Vec<f64> {
        let mut rates = self.full.clone();
        rhs(self.model, self.t, &self.full, &mut rates);
        rates
    }
}

/// Accelerations of a body along x, y, z and about z.
fn acceleration(rates: &[f64], body: usize) -> &[f64] {
    let half = rates.len() / 2;
    &rates[half + 4 * body..half + 4 * body + 4]
}

/// Analytic: rings feel what free balls would put on them, and a ball moves along its radius as if it were free.
#[test]
fn rolling_balls_feel_their_radial_forces() {
    for seed in 0..10 {
        let model = compile(&wheel(NormalLaw::iso16281(), ROLLING)).unwrap();
        let shaken = Shaken::new(&model, seed);
        let free = shaken.free();
        for ring in 0..2 {
            let [found, wanted] = [&shaken.rates, &free].map(|rates| acceleration(rates, ring));
            for i in 0..3 {
                // A micrometre of approach is worth some 1e4 m/s².
                assert!(
                    (found[i] - wanted[i]).abs() < 1e-6,
                    "{ring} {i}: {found:?} {wanted:?}"
                );
            }
        }
        for body in 2..model.body_count() {
            let [found, wanted] = [&shaken.rates, &free].map(|rates| acceleration(rates, body));
            let place = &shaken.full[4 * body..4 * body + 2];
            let radial = |a: &[f64]| (a[0] * place[0] + a[1] * place[1]) / place[0].hypot(place[1]);
            let (a, b) = (radial(found), radial(wanted));
            assert!((a - b).abs() < 1e-9 * b.abs() + 1e-4, "{body}: {a} {b}");
            assert!(
                (found[2] - wanted[2]).abs() < 1e-9 * wanted[2].abs() + 1e-4,
                "{body}: z"
            );
        }
    }
}

/// Analytic: places, speeds and accelerations of all bodies are each other's derivatives, also where the drive changes
/// its speed and a ball has a defect that shows its spin.
#[test]
fn places_speeds_and_rates_belong_together() {
    let mut scene = wheel(NormalLaw::iso16281(), FLAT);
    scene.drive = Drive::Speed(TimeFunction::Profile(Profile::Sine {
        mean: 150.0,
        amplitude: 100.0,
        frequency: 50.0,
        phase: 0.3,
    }));
    scene.defects.insert(
        "pit".to_owned(),
        Defect::of(
            Patch::of_width(0.5e-3).length(1e-3).edge_radius(0.3e-3),
            Surface::Ball,
            PI,
        )
        .on_ball(3)
        .at_offset(0.0),
    );
    let model = compile(&scene).unwrap();
    let shaken = Shaken::new(&model, 5);
    let (t, h, half) = (shaken.t, 1e-7, shaken.full.len() / 2);
    let mut dy = shaken.y.clone();
    let mut dynamics = Dynamics::reduced(
        &model,
        Reduction::of(&model, &start(&model, &Start::Equilibrium).unwrap()).unwrap(),
        &start(&model, &Start::Equilibrium).unwrap(),
    );
    dynamics.rhs(t, &shaken.y, &mut dy);
    let at = |h: f64| {
        let y: Vec<f64> = shaken.y.iter().zip(&dy).map(|(y, d)| y + h * d).collect();
        let mut full = shaken.full.clone();
        shaken.dynamics.expand(t + h, &y, &mut full);
        full
    };
    let (before, after) = (at(-h), at(h));
    for i in 0..2 * half {
        let slope = (after[i] - before[i]) / (2.0 * h);
        let rate = shaken.rates[i];
        // Rounding of 36 mm and of 10 m/s over the interval.
        let noise = if i < half { 1e-9 } else { 1e-6 };
        assert!(
            (slope - rate).abs() < 1e-6 * rate.abs() + noise / h * 1e-2,
            "{}: {slope} {rate}",
            model.names()[i]
        );
    }
    // The spin follows the drive.
    let body = 2 + 3;
    let share = |full: &[f64]| full[half + 4 * body + 3] / full[half + 7];
    let y0 = start(&model, &Start::Equilibrium).unwrap();
    assert!((share(&shaken.full) / share(&y0) - 1.0).abs() < 1e-12);
}

/// Analytic: with axial places kept, all else feels what it would.
#[test]
fn axial_places_are_kept_and_nothing_else() {
    for approximations in [SYMMETRIC, FLAT] {
        let model = compile(&wheel(NormalLaw::Hertz, approximations)).unwrap();
        let shaken = Shaken::new(&model, 3);
        let free = shaken.free();
        for ring in 0..2 {
            let [found, wanted] = [&shaken.rates, &free].map(|rates| acceleration(rates, ring));
            for i in 0..2 {
                assert!((found[i] - wanted[i]).abs() < 1e-5, "{found:?} {wanted:?}");
            }
            assert_eq!(found[2], 0.0);
        }
        let levels = |row: usize| {
            let balls = (2 + 13 * row)..(2 + 13 * (row + 1));
            balls.map(|body| shaken.full[4 * body + 2])
        };
        for row in 0..2 {
            assert!(levels(row).all(|z| z == levels(row).next().unwrap()));
        }
    }
}

/// With friction so steep that nodes weigh the same for it as for the normal force: else the load of both rows says how finely
/// it is resolved.
fn steep(mut scene: Scene) -> Scene {
    scene.friction = Friction::Coulomb {
        coefficient: 0.05,
        slip_speed: 1e-3,
    };
    scene
}

/// Rates of a bearing that has one of the rows only, where its bodies stand and move like those of a thrust bearing.
fn alone(shaken: &Shaken, row: usize) -> Vec<f64> {
    let mut scene = steep(thrust(Approximations::default()));
    scene.rows = vec![scene.rows[row].clone()];
    scene.defects.retain(|_, defect| defect.row == row);
    for defect in scene.defects.values_mut() {
        defect.row = 0;
    }
    let halves = shaken.full.chunks(shaken.full.len() / 2);
    let y = halves
        .flat_map(|half| [&half[..8], &half[4 * (2 + 13 * row)..][..4 * 13]].concat())
        .collect::<Vec<_>>();
    let mut rates = y.clone();
    rhs(&compile(&scene).unwrap(), shaken.t, &y, &mut rates);
    rates
}

/// Analytic: without a row the rings feel the other one alone.
#[test]
fn an_unloaded_row_goes() {
    let model = compile(&steep(thrust(ONE_ROW))).unwrap();
    let shaken = Shaken::new(&model, 3);
    let reduction = Reduction::of(&model, &shaken.full).unwrap();
    let omitted: Vec<&str> = reduction
        .omissions()
        .iter()
        .map(|o| o.what.as_str())
        .collect();
    assert!(
        omitted.contains(&"balls of the unloaded row"),
        "{omitted:?}"
    );
    assert_eq!(reduction.dim(), 224 - 8 * 13 - 4);
    let free = shaken.free();
    let loads = |row: usize| -> f64 {
        (13 * row..13 * (row + 1))
            .map(|j| {
                inspect::contact(&model, &shaken.full, j, Race::Inner)
                    .unwrap()
                    .load
            })
            .sum()
    };
    let idle = usize::from(loads(1) < loads(0));
    // What the idle row puts on the rings is all that differs: a few newtons of its centrifugal forces.
    let [found, wanted] = [&shaken.rates, &free].map(|rates| acceleration(rates, 1));
    let apart: f64 = (0..3)
        .map(|i| (found[i] - wanted[i]).powi(2))
        .sum::<f64>()
        .sqrt();
    assert!(loads(idle) < 0.02 * loads(1 - idle));
    assert!(apart * 0.6 <= loads(idle) + 1e-6, "{apart}");
    // Nor does the outer ring feel what its balls press on it: some newtons on 0.8 kg.
    let [found, wanted] = [&shaken.rates, &free].map(|rates| acceleration(rates, 0));
    let felt = (0..3).any(|i| (found[i] - wanted[i]).abs() > 0.1);
    assert!(felt, "{found:?} {wanted:?}");
    // What they feel is the other row alone, as a bearing of one row has it.
    let alone = alone(&shaken, 1 - idle);
    for ring in 0..2 {
        let [found, wanted] = [&shaken.rates, &alone].map(|rates| acceleration(rates, ring));
        for i in 0..3 {
            // 20 kN on 0.6 kg.
            assert!(
                (found[i] - wanted[i]).abs() < 1e-12 * 20e3 / 0.6,
                "{ring} {i}: {found:?} {wanted:?}"
            );
        }
    }
    // Its balls go round with the cage.
    let turned = |body: usize| {
        let at = 4 * body;
        let y0 = start(&model, &Start::Equilibrium).unwrap();
        let angle = |y: &[f64]| y[at + 1].atan2(y[at]);
        ballrace::contact::wrapped(angle(&shaken.full) - angle(&y0)) / shaken.t
    };
    let body = 2 + 13 * idle;
    let (orbit, _) = model.rolling_speeds(idle);
    assert!(
        (turned(body) / orbit - 1.0).abs() < 0.05,
        "{}",
        turned(body)
    );
}

type Change = fn(&mut Scene);

/// Where an approximation would not hold it is not made, and the reason is reported.
#[test]
fn what_does_not_hold_is_not_made_and_reported() {
    let varying = || {
        TimeFunction::Profile(Profile::Ramp {
            from: 20e3,
            to: 10e3,
            start: 0.0,
            end: 1.0,
        })
    };
    let cases: [(&str, Approximations, Change); 2] = [
        ("without the unloaded row", ONE_ROW, |s| {
            s.loads.get_mut("radial").unwrap().force = 7e3.into();
        }),
        ("axial places that are kept", SYMMETRIC, |_| {}),
    ];
    for (what, approximations, change) in cases {
        let mut scene = thrust(approximations);
        change(&mut scene);
        if approximations.plane {
            scene.loads.get_mut("axial").unwrap().force = varying();
        }
        let model = compile(&scene).unwrap();
        let y0 = start(&model, &Start::Equilibrium).unwrap();
        let reduction = Reduction::of(&model, &y0).unwrap();
        assert!(
            reduction.obstacles().iter().any(|o| o.what == what),
            "{:?}",
            reduction.obstacles()
        );
        assert!(
            reduction
                .omissions()
                .iter()
                .all(|o| !o.reason.contains("request"))
        );
    }
}

/// What cannot be is refused by name.
#[test]
fn impossible_requests_are_refused() {
    let cases: [(&str, Approximations, Change); 3] = [
        ("approximations.rolling", ROLLING, |s| {
            s.drive = Drive::Torque {
                value: 1.0.into(),
                initial_speed: 100.0,
            };
        }),
        ("approximations.rolling", ROLLING, |s| {
            s.rows[1].ball_support.x = Some(Mount::Fixed);
        }),
        ("approximations.one_row", ONE_ROW, |s| {
            s.rows.truncate(1);
            s.defects.clear();
            s.probes.clear();
        }),
    ];
    for (field, approximations, change) in cases {
        let mut scene = thrust(approximations);
        change(&mut scene);
        let error = scene.validate().unwrap_err().to_string();
        assert!(error.contains(field), "{error}");
    }
}

/// Golden: contact damping, which balls that roll kinematically keep, holds no steps short.
#[test]
fn rolling_balls_take_steps_as_long_as_free_ones() {
    let evaluations = |approximations| {
        let run = Run {
            duration: 5e-3,
            rtol: Some(1e-7),
            ..Run::default()
        };
        let out = simulate(&thrust(approximations), &run).unwrap();
        out.stats.nfev as f64
    };
    let free = evaluations(Approximations::NONE);
    for approximations in [ROLLING, FLAT] {
        let share = evaluations(approximations) / free;
        assert!(share < 1.3, "{approximations:?}: {share}");
    }
}

/// Against Verner's pair at rtol 1e-10: what the matrix of contact damping does to rolling balls costs no accuracy.
#[test]
fn rolling_balls_accelerate_as_a_better_solution_does() {
    let accelerations = |approximations, method, rtol| {
        let run = Run {
            duration: 3e-3,
            settle: Some(0.0),
            method: Some(method),
            rtol,
            ..Run::default()
        };
        let out = simulate(&wheel(NormalLaw::iso16281(), approximations), &run).unwrap();
        out.get("outer.ay").unwrap().to_vec()
    };
    for approximations in [ROLLING, FLAT] {
        let found = accelerations(approximations, Method::Adams, None);
        let better = accelerations(approximations, Method::Verner, Some(1e-10));
        let off = found.iter().zip(&better).map(|(a, b)| (a - b).powi(2));
        let error = off.sum::<f64>() / better.iter().map(|b| b * b).sum::<f64>();
        println!("{approximations:?}: {:.2e}", error.sqrt());
        assert!(error.sqrt() < 0.01, "{approximations:?}: {error}");
    }
}

/// A run says what it gave up.
#[test]
fn a_run_lists_what_it_gave_up() {
    let scene = wheel(NormalLaw::iso16281(), FLAT);
    let run = Run {
        duration: 1e-4,
        settle: Some(0.0),
        ..Run::default()
    };
    let out = simulate(&scene, &run).unwrap();
    let omissions = out.provenance.left_out.iter();
    let given_up = omissions
        .filter(|o| o.reason.starts_with("by request"))
        .count();
    assert_eq!((out.provenance.states, given_up), (2 * (26 + 4), 2));
    assert_eq!(out.scene, scene);
}
