//! Changes at rest by holding the balls' axis along the bearing's, against balls that spin about any axis; and what else their speed
//! does to them.
//!
//! Where both contact angles of a ball are the same and its gyroscopic moment is small, both spins give the same orbit and loads, and
//! the held axis costs a run a third of the states. At speed they part.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::rolling::RaceControl;
use super::steady::{keep, orbit};
use super::{Equilibrium, Spacing, compile, describe, in_motion};
use crate::base::error::Result;
use crate::base::interrupt;
use crate::contact::{V2, centrifugal};
use crate::inspect;
use crate::model::{Between, BodyId, Dof, Model, Race, RowModel};
use crate::scene::{AtSpeed, Doubt, Scene, Spin};

/// Largest share that counts as the same answer.
const SAME: f64 = 2e-3;
/// The same, above which a held axis is doubted: below, presets and documents that hold it differ by the friction of slow balls alone.
const DOUBTED: f64 = 1e-2;
/// Share of the largest load, of a row or of all rows, from which a ball or a row counts as loaded.
const LOADED: f64 = 0.1;
/// Contact angle below which both spins are one \[rad\].
const NO_ANGLE: f64 = 1e-3;
/// Slip speed at which friction slides, for its largest value \[m/s\].
const SLIDING: f64 = 1.0;

/// How much holding the balls' axis along the bearing's changes at rest, against balls that spin about any axis.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct AxisHeld {
    /// How much faster balls go round, against the outer ring, as a share: of the row where it is most.
    pub orbit: f64,
    /// Largest difference of a contact's load, over the largest load of any.
    pub load: f64,
}

impl AxisHeld {
    /// Whether both spins give the same answer, to 0.2 %.
    pub fn is_same(&self) -> bool {
        self.orbit.abs() <= SAME && self.load <= SAME
    }
}

/// Compares a scene without its defects at rest with balls that spin about the axis and about any.
///
/// ```
/// use ballrace::scene::presets;
/// let found = ballrace::axis_held(&presets::deep_groove_6205(500.0, 0.0, 1800.0)).unwrap();
/// assert!(found.unwrap().is_same());
/// ```
///
/// Absent where nothing turns, or no friction says how balls spin.
///
/// # Errors
/// As [`super::equilibrium()`].
pub fn axis_held(scene: &Scene) -> Result<Option<AxisHeld>> {
    compared(&healthy(scene)).map(|(held, _)| held)
}

/// The same, and what is doubtful about the balls at their speed, with the spin that the scene says.
pub(crate) fn at_speed(scene: &Scene) -> Result<(Option<AxisHeld>, Vec<Doubt>)> {
    let healthy = healthy(scene);
    let (held, own) = compared(&healthy)?;
    let mut doubts = own.doubts();
    doubts.extend(axis_doubt(scene, held));
    Ok((held, doubts))
}

/// The doubt about a held axis, where it matters.
pub(crate) fn axis_doubt(scene: &Scene, held: Option<AxisHeld>) -> Option<Doubt> {
    let held = held.filter(|_| scene.spin != Some(Spin::Free))?;
    let matters = held.orbit.abs().max(held.load) > DOUBTED;
    matters.then(|| Doubt::axis(held.orbit, held.load))
}

/// A scene without defects, and without what would have to fit to its spin.
fn healthy(scene: &Scene) -> Scene {
    let mut healthy = scene.clone();
    healthy.defects = BTreeMap::new();
    healthy.probes = BTreeMap::new();
    healthy
}

/// The difference, and the scene at rest.
fn compared(scene: &Scene) -> Result<(Option<AxisHeld>, OneSpin)> {
    let own = OneSpin::of(scene)?;
    if !own.is_driven() {
        return Ok((None, own));
    }
    if !own.has_angles() {
        return Ok((Some(AxisHeld::default()), own));
    }
    let is_free = scene.spin == Some(Spin::Free);
    let other = OneSpin::of(&Scene {
        spin: Some(if is_free { Spin::Axial } else { Spin::Free }),
        ..scene.clone()
    })?;
    let (held, free) = if is_free {
        (&other, &own)
    } else {
        (&own, &other)
    };
    Ok((Some(held.against(free)), own))
}

/// A bearing at rest with the speeds that its balls have.
struct OneSpin {
    model: Model,
    /// Orbit speeds of the rows against the outer ring \[rad/s\]; none of one that nothing drives, or that is idle beside another.
    orbits: Vec<Option<f64>>,
    found: Equilibrium,
}

impl OneSpin {
    fn of(scene: &Scene) -> Result<Self> {
        let model = compile(scene)?;
        let mut y = in_motion(&model, RaceControl::Friction, Spacing::Equal)?;
        keep(&model, &mut y);
        let [turned, _] = model.scene.ring_speeds(0.0);
        // With very many slices each of these takes a third of a second.
        interrupt::check()?;
        let found = describe(&model, &y, 0);
        interrupt::check()?;
        let rows = || model.rows.iter();
        let most = rows().map(|row| largest(&found, row)).fold(0.0, f64::max);
        let rows = rows().map(|row| {
            let drives = |j: &usize| inspect::raw::contact(&model, &y, *j, Race::Inner).load > 0.0;
            let is_idle = largest(&found, row) < LOADED * most;
            let ball = row
                .balls()
                .find(drives)
                .filter(|_| row.has_friction() && !is_idle)?;
            Some(orbit(model.layout(), &y, BodyId::ball(ball)) - turned)
        });
        let orbits = rows.collect();
        Ok(Self {
            model,
            orbits,
            found,
        })
    }

    fn is_driven(&self) -> bool {
        self.orbits.iter().flatten().any(|orbit| *orbit != 0.0)
    }

    fn has_angles(&self) -> bool {
        let contacts = self.found.balls.iter().flat_map(|b| [&b.outer, &b.inner]);
        contacts
            .filter_map(|of| of.angle)
            .any(|angle| angle.abs() > NO_ANGLE)
    }

    /// Loads of all contacts \[N\].
    fn loads(&self) -> impl Iterator<Item = f64> {
        let balls = self.found.balls.iter();
        balls.flat_map(|ball| [ball.outer.load, ball.inner.load])
    }

    /// Changes with the axis held, against the same with it free.
    fn against(&self, free: &Self) -> AxisHeld {
        let orbits = self.orbits.iter().zip(&free.orbits);
        let faster = orbits.filter_map(|(held, free)| Some((*held)? / (*free)? - 1.0));
        let largest = free.loads().fold(0.0, f64::max);
        let loads = self.loads().zip(free.loads());
        let apart = loads.map(|(held, free)| (held - free).abs());
        AxisHeld {
            orbit: faster.fold(
                0.0,
                |most, of| if of.abs() > most.abs() { of } else { most },
            ),
            load: apart.fold(0.0, f64::max) / largest,
        }
    }

    fn doubts(&self) -> Vec<Doubt> {
        doubts(&self.model, &self.found)
    }
}

/// Largest load of a row on the inner race \[N\].
fn largest(found: &Equilibrium, row: &RowModel) -> f64 {
    let loads = row.balls().map(|j| found.balls[j].inner.load);
    loads.fold(0.0, f64::max)
}

/// Doubts about balls at their speed.
pub(super) fn doubts(model: &Model, found: &Equilibrium) -> Vec<Doubt> {
    let rows = 0..model.rows.len();
    let judged = rows.filter_map(|row| judged(model, found, row));
    judged.flat_map(|of| Doubt::at_speed(&of)).collect()
}

/// The balls of a row; none where nothing turns them or presses them to the inner race, or another row carries the load.
fn judged(model: &Model, found: &Equilibrium, at: usize) -> Option<AtSpeed> {
    let row = &model.rows[at];
    let [turned, inner] = model.scene.ring_speeds(0.0);
    let (orbit, _) = model.rolling_speeds(at);
    let balls = || row.balls().map(|j| (j, &found.balls[j]));
    let own = largest(found, row);
    let rows = model.rows.iter().map(|row| largest(found, row));
    let is_idle = own < LOADED * rows.fold(0.0, f64::max);
    if own == 0.0 || is_idle || inner == turned {
        return None;
    }
    let (mut thrust, mut radial) = (0.0_f64, V2::zeros());
    let (mut moments, mut held, mut apart) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut thrown = 0.0_f64;
    for (j, of) in balls() {
        let body = &model.bodies[BodyId::ball(j)];
        thrown = thrown.max(centrifugal(body.mass[Dof::X], orbit) * of.radius);
        let (Some(on_inner), Some(on_outer)) = (of.inner.angle, of.outer.angle) else {
            continue;
        };
        thrust += of.inner.load * on_inner.sin();
        radial += V2::new(of.angle.cos(), of.angle.sin()) * (of.inner.load * on_inner.cos());
        if of.inner.load < LOADED * own {
            continue;
        }
        apart = apart.max(on_inner.abs() - on_outer.abs());
        let radius = model.balls[j].side.radius;
        let between = Between {
            radius,
            distance: of.radius,
            angles: [on_outer, on_inner],
            speed: inner - turned,
        };
        let outward = between.resisted([1.0; 2]).outward;
        moments += (body.mass[Dof::Theta] * orbit * outward).abs();
        for (race, load) in Race::BOTH.into_iter().zip([of.outer.load, of.inner.load]) {
            let law = row.pairs[race].law.traction;
            held += law.map_or(0.0, |law| law.at(SLIDING) * SLIDING) * load * radius;
        }
    }
    let is_thrust = thrust.abs() > radial.norm();
    Some(AtSpeed {
        row: at,
        thrust: is_thrust,
        load: if is_thrust {
            thrust.abs() / row.count as f64
        } else {
            own
        },
        centrifugal: thrown,
        gyroscopic: if held > 0.0 { moments / held } else { 0.0 },
        apart,
    })
}
