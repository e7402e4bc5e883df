//! The decay of a start's transient before t = 0 ([*How a run begins*](crate::equations#how-a-run-begins-and-how-it-goes-on)).
//!
//! An equilibrium does not include friction, and places unloaded balls only as `statics::fallen` estimates: in a fast 6205 the outer
//! ring's vibration is steady from three quarters of a turn of the cage on. So a run begins a little earlier, with loads and drive as they
//! are at t = 0, and with rings and cage turned back: at t = 0 balls and defects are where the scene puts them, except for the slip of
//! the balls and the play of the cage.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};

use super::Run;
use super::follow::{Interval, Trajectory};
use super::settings::{options, threads};
use super::step_limit;
use super::watch::StepWatch;
use crate::base::error::Result;
use crate::contact::Pair;
use crate::dynamics::Dynamics;
use crate::inspect;
use crate::integrate::{DenseStep, Options};
use crate::model::{BodyId, Degree, Dof, Model, Race, RowModel};
use crate::reduction::Reduction;
use crate::run::pool::on;
use crate::run::selftest;
use crate::scene::{Drive, Scene, Surface, TimeFunction};
use crate::statics::start::{Start, face, from_equilibrium, start};
use crate::statics::{Spacing, compile};

/// Decay times of the slowest ring to wait for. Measured on a 6205 under thrust: what the start leaves is 3000 times
/// the later signal, e⁸, and contacts and the other ring damp too.
const DECAYS: f64 = 7.0;
/// The longest time that is chosen \[s\]: what has not settled by then rarely does.
const LONGEST: f64 = 0.1;
/// Turn of the cage in which loose balls find their places and speeds \[rad\], and the longest time that they take \[s\]; a 6205 at 1800 1/min
/// waits longer, 36 ms, for its inner ring, which contacts alone damp. Over three loads and three starts its outer ring then vibrates over
/// the first four ball passes 0.85, 0.96, 1.12 and 1.08 times as much as later; after 12 ms 1.9, 0.7, 0.7 and 1.5 times, after 24 ms 0.6, 0.8,
/// 1.4 and 1.0, and from balls equally far apart without settling 8.6, 5.2, 4.8 and 1.1.
const TAKE_UP: f64 = 0.75 * TAU;
const LONGEST_TAKE_UP: f64 = 0.012;
/// Ball passes to wait for at least: in a wheel bearing under 3 kN of thrust the vibration in the first is twice that in the third.
const PASSES: f64 = 2.0;

/// Time before t = 0 \[s\] until which steps have a tolerance looser than 1e-7 and a longer cap by the contacts' frequency: none of it is
/// recorded, and the measure above is the same (over three loads and 24 starts 0.86, 1.29, 0.95 and 0.92 instead of 0.87, 1.29, 0.96 and
/// 0.92) for half of the evaluations. The rest is what contacts need to stop ringing by such steps.
const FINE: f64 = 3e-3;
const COARSE: f64 = 1e-5;
/// That cap over the one for the whole signal. Without any, steps of changing length ask for a new matrix of the contacts every few steps: a
/// 6205 then settles in 45 ms instead of 33, in VG 68 in 111 instead of 64.
const LONG: f64 = 2.2;

/// State from which a run goes on at t = 0, and what it took to get there.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Settled {
    #[serde(skip)]
    pub from: Start,
    /// Time before t = 0 \[s\].
    pub seconds: f64,
    pub accepted: usize,
    pub nfev: usize,
}

/// Lets a scene settle from the start of a run, for as long as asked or needed. `progress` receives the share of
/// settling and run together.
pub(crate) fn settle(
    scene: &Scene,
    run: &Run,
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Settled> {
    let unsettled = Settled {
        from: run.start.clone(),
        seconds: 0.0,
        accepted: 0,
        nfev: 0,
    };
    let chosen = run.settle.is_none() && run.start == Start::Equilibrium;
    if !chosen && run.settle.is_none_or(|asked| asked == 0.0) {
        return Ok(unsettled);
    }
    let (model, _) = selftest::trusted(compile(&frozen(scene))?.recorded_to(run.band()));
    let y0 = start(&model, &run.start)?;
    let seconds = run.settle.unwrap_or_else(|| needed(&model, &y0));
    if seconds == 0.0 {
        return Ok(unsettled);
    }
    let interval = Interval {
        zero: -seconds,
        from: 0.0,
        to: seconds,
        max_steps: run.max_steps,
    };
    let mut y = before(&model, &run.start, y0, seconds)?;
    let (mut accepted, mut nfev) = (0, 0);
    let mut last: Option<Trajectory> = None;
    for (model, until) in [(&coarse(&model), seconds - FINE), (&model, seconds)] {
        if until <= 0.0 {
            continue;
        }
        let options = Options {
            breakpoints: Vec::new(),
            ..options(model)
        };
        let from = last.as_ref().map_or(0.0, Trajectory::time);
        let reduction = Reduction::since(model, from, &y);
        let dynamics = Dynamics::begin(model, reduction.as_ref(), &y);
        let mut settling = match last {
            None => Trajectory::new(model, y, interval, options.max_step),
            Some(last) => last.after(model, y, options.max_step),
        };
        let part = |done: f64| (from + done * (seconds - from)) / (seconds + run.duration);
        on(
            threads(model, run.threads)?,
            dynamics,
            &mut |done| progress(part(done)),
            |mut dynamics, progress| {
                settling.advance(&mut dynamics, &mut Unseen, until, &options, progress)
            },
        )?;
        let stats = settling.statistics(model);
        (accepted, nfev) = (accepted + stats.accepted, nfev + stats.nfev);
        y = settling.last().to_vec();
        last = Some(settling);
    }
    Ok(Settled {
        from: Start::State(y),
        seconds,
        accepted,
        nfev,
    })
}

/// A model with a loose tolerance and a long cap, which texture and pits do not shorten: none of it is recorded.
fn coarse(model: &Model) -> Model {
    let mut coarse = model.clone();
    coarse.fineness.rtol = coarse.fineness.rtol.max(COARSE);
    coarse.fineness.cap_factor = LONG;
    if coarse.scene.solver.frequency_cap {
        let cap = step_limit::of_contacts(coarse.scene.solver.method, &coarse);
        let solver = &mut coarse.scene.solver;
        solver.max_step = Some(solver.max_step.map_or(cap, |step| step.min(cap)));
        solver.frequency_cap = false;
    }
    coarse
}

/// Observer of nothing while the start settles.
struct Unseen;

impl StepWatch for Unseen {
    fn first(&mut self, _: &mut Dynamics<'_>, _: &[f64]) {}
    fn step(&mut self, _: &mut Dynamics<'_>, _: &DenseStep<'_>, _: f64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// How long a start from equilibrium needs \[s\]: some decay times of the slowest ring, and some ball passes, or where a cage has play and
/// balls are loose what these take. Not at all where nothing takes energy.
fn needed(model: &Model, y0: &[f64]) -> f64 {
    let rings = Race::BOTH.map(|race| decay(model, y0, race));
    let slowest = rings.into_iter().fold(0.0, f64::max);
    let takes_energy = |pair: &Pair| pair.law.takes_energy();
    let mut pairs = model.rows.iter().flat_map(|row| &row.pairs);
    if slowest.is_infinite() && !pairs.any(takes_energy) {
        return 0.0;
    }
    let links = model.scene.cage_links();
    let has_play = links.is_some_and(|cage| cage.play > 0.0);
    let has_play = has_play
        || model
            .rows
            .iter()
            .any(|row| row.cage.as_ref().is_some_and(|cage| cage.clearance > 0.0));
    let times = (0..model.rows.len()).map(|row| {
        let speed = model.orbit_speed(row, y0).abs();
        if has_play && has_loose_balls(model, y0, row) {
            return (TAKE_UP / speed).min(LONGEST_TAKE_UP);
        }
        PASSES * TAU / model.rows[row].count as f64 / speed
    });
    times
        .filter(|time| time.is_finite())
        .fold(DECAYS * slowest, f64::max)
        .min(LONGEST)
}

fn has_loose_balls(model: &Model, y: &[f64], row: usize) -> bool {
    let is_loose = |j| inspect::raw::contact(model, y, j, Race::Inner).load == 0.0;
    model.rows[row].balls().any(is_loose)
}

/// Decay time 2 m/c of a ring's slowest direction \[s\]: damped by its support and by the contacts, each of which damps
/// by (3/2) α_d F and takes half the approach speed of the rings. Infinite where nothing damps it, 0 for one that is held.
fn decay(model: &Model, y: &[f64], race: Race) -> f64 {
    let damping = |row: &RowModel| {
        let loads = row
            .balls()
            .map(|j| inspect::raw::contact(model, y, j, race).load);
        0.5 * row.pairs[race].law.damping.rate() * loads.sum::<f64>()
    };
    let contacts = model.rows.iter().map(damping).sum::<f64>();
    let body = &model.bodies[race.ring()];
    let times = Dof::TRANSLATIONS.into_iter();
    let times = times.filter_map(|dof| match body.degrees[dof] {
        Degree::Free { damping, .. } => Some(2.0 * body.mass[dof] / (damping + contacts)),
        Degree::Fixed | Degree::Driven => None,
    });
    times.fold(0.0, f64::max)
}

/// The scene with loads and drive as they are at t = 0; a driving torque becomes the speed that it has reached.
fn frozen(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    for load in scene.loads.values_mut() {
        load.force = TimeFunction::Constant(load.force.at(0.0));
    }
    for moment in scene.moments.values_mut() {
        moment.moment = TimeFunction::Constant(moment.moment.at(0.0));
    }
    for ring in [&mut scene.outer_ring, &mut scene.inner_ring] {
        ring.support.hold_given();
    }
    let [outer, inner] = scene.ring_speeds(0.0).map(TimeFunction::Constant);
    scene.drive = Drive::Speed(inner);
    scene.inner_ring.support.theta = None;
    scene.outer_speed = scene.outer_speed.map(|_| outer);
    scene.ring_forces = scene.ring_forces.frozen();
    debug_assert!(
        scene
            .values_in_time()
            .iter()
            .all(|value| matches!(value, TimeFunction::Constant(_))),
        "a value that changes in time is not frozen"
    );
    scene
}

/// The state of all bodies at which settling begins: the start with rings, cage and balls wound back by what they
/// turn in the meantime. A given state is left as it is.
fn before(model: &Model, from: &Start, y0: Vec<f64>, seconds: f64) -> Result<Vec<f64>> {
    if matches!(from, Start::State(_)) {
        return Ok(y0);
    }
    let turned = Turned::since(model, &y0, seconds);
    let earlier = compile(&turned.back(&model.scene))?;
    let mut y = match from {
        Start::Equilibrium => from_equilibrium(&earlier, Spacing::Fallen)?,
        _ => start(&earlier, from)?,
    };
    let angle = |body| model.layout().at(body, Dof::Theta);
    for (race, turned) in Race::BOTH.into_iter().zip(turned.rings) {
        y[angle(race.ring())] -= turned;
    }
    for (j, ball) in model.balls.iter().enumerate() {
        y[angle(BodyId::ball(j))] = -turned.balls[ball.row];
    }
    for (row, turned) in turned.rows.iter().enumerate() {
        if model.rows[row].cage.is_some() {
            y[angle(model.layout().cage(row))] = model.scene.rows[row].start_angle - turned;
        }
    }
    face(model, &mut y);
    Ok(y)
}

/// How far bodies turn in a time \[rad\].
struct Turned {
    rings: [f64; 2],
    /// Angle about the axis, a row each.
    rows: Vec<f64>,
    /// Angle about the balls' own centres, in the mean of a row.
    balls: Vec<f64>,
}

impl Turned {
    fn since(model: &Model, y0: &[f64], seconds: f64) -> Self {
        let speed = |body| y0[model.layout().speed_at(body, Dof::Theta)];
        let spin = |row: usize| {
            let row = &model.rows[row];
            let spins = row.balls().map(|j| speed(BodyId::ball(j)));
            spins.sum::<f64>() / row.count as f64
        };
        let rows = 0..model.rows.len();
        // Balls on supports of their own stay where they are.
        let orbit = |row: usize| {
            let ball = &model.bodies[model.rows[row].first_body()];
            let loose = |dof: &Dof| matches!(ball.degrees[*dof], Degree::Free { stiffness, .. } if stiffness == 0.0);
            if Dof::SYMMETRIC.iter().all(loose) {
                model.orbit_speed(row, y0)
            } else {
                0.0
            }
        };
        Self {
            rings: Race::BOTH.map(|race| seconds * speed(race.ring())),
            rows: rows.clone().map(|row| seconds * orbit(row)).collect(),
            balls: rows.map(|row| seconds * spin(row)).collect(),
        }
    }

    /// A scene with all angles as they were before.
    fn back(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        let [outer, inner] = self.rings;
        for (row, turned) in scene.rows.iter_mut().zip(&self.rows) {
            row.start_angle = (row.start_angle - turned) % TAU;
            let waves = [
                (&mut row.outer_waviness, outer),
                (&mut row.inner_waviness, inner),
            ];
            for (waves, turned) in waves.into_iter().filter(|(_, turned)| *turned != 0.0) {
                for wave in waves {
                    wave.phase = (wave.phase + f64::from(wave.order) * turned) % TAU;
                }
            }
        }
        for defect in scene.defects.values_mut() {
            let turned = match defect.on {
                Surface::OuterRace => outer,
                Surface::InnerRace => inner,
                Surface::Ball => self.balls[defect.row],
            };
            defect.angle = (defect.angle - turned) % TAU;
        }
        for unbalance in scene.unbalances.values_mut() {
            let turned = self.rings[Race::from(unbalance.ring)];
            if turned != 0.0 {
                unbalance.angle = (unbalance.angle - turned) % TAU;
            }
        }
        scene
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Cap, Defect, Lubricant, Spin, Surface, presets};

    /// Analytic: a rotation has Euler parameters of length one, and they change by ½ ω e: after thousands of steps too, which let
    /// them drift by some 1e-6 where nothing returns them.
    #[test]
    fn euler_parameters_keep_their_length() {
        let mut scene = presets::deep_groove_6205(500.0, 500.0, 1797.0);
        scene.lubricant = Some(Lubricant::named("vg68", 50.0 + 273.15));
        scene.spin = Some(Spin::Free);
        let cap = Defect::of(
            Cap::of_width(0.5e-3).edge_radius(0.3e-3),
            Surface::Ball,
            -1.57,
        )
        .on_ball(3);
        scene.defects.insert("cap".to_owned(), cap.at_offset(0.0));
        let run = Run {
            settle: Some(0.03),
            ..Run::default()
        };
        let settled = settle(&scene, &run, &mut |_| ControlFlow::Continue(())).unwrap();
        let Start::State(y) = &settled.from else {
            panic!("a state")
        };
        let model = compile(&scene).unwrap();
        let ball = BodyId::ball(3);
        let attitude = model.layout().motion(y, ball).attitude.unwrap();
        let square: f64 = attitude.iter().map(|e| e * e).sum();
        println!("{:e} in {} steps", square - 1.0, settled.accepted);
        assert!((square - 1.0).abs() < 1e-8);
    }
}
