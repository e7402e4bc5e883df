//! Loads: forces of fixed direction and a size that may change in time, at points of rings, and moments likewise.
//!
//! They do work on the bearing and store no energy.

use nalgebra::{Vector2, Vector3};

use super::{Account, Asymmetry, Damper, Force, ForceSums, Instant, RingWrench, Use};
use crate::model::{LoadModel, Model, Race};
use crate::scene::TimeFunction;

/// Loads and moments on rings.
#[derive(Debug)]
pub(crate) struct Loads;

impl Force for Loads {
    fn name(&self) -> &'static str {
        "load"
    }

    fn used(&self, model: &Model) -> Use {
        let mut sizes = sizes(model).filter(|size| size.peak() > 0.0);
        if sizes.clone().all(is_constant) {
            Use::constant(sizes.next().is_some())
        } else {
            Use::Evaluated
        }
    }

    fn add_constant(&self, model: &Model, sums: &mut ForceSums<'_>) {
        add(model, true, 0.0, sums);
    }

    fn add(&self, model: &Model, at: &Instant<'_>, sums: &mut ForceSums<'_>) {
        add(model, false, at.t, sums);
        if sums.moments.is_some() {
            for race in Race::BOTH {
                let frame = at.frame(race);
                let wrench = RingWrench {
                    moment: moment(model, at.t, race, |arm| frame.to_scene(arm)),
                    ..RingWrench::default()
                };
                sums.add(race, &wrench);
            }
        }
    }

    /// Account of nothing: loads do work, and store and take nothing.
    fn account(&self, _model: &Model, _y: &[f64]) -> Account {
        Account::default()
    }

    fn dampers(&self, _model: &Model) -> Vec<Damper> {
        Vec::new()
    }

    /// The forces; moments depend on how a ring tilts ([`moment`]).
    fn at_start(&self, model: &Model, race: Race) -> RingWrench {
        let mut sum = RingWrench::default();
        for load in model.loads.iter().filter(|load| load.ring == race) {
            sum.force += at(load, 0.0);
        }
        sum
    }

    fn asymmetry(&self, model: &Model) -> Asymmetry {
        Asymmetry {
            along_z: along_z(model),
            tilting: tilting(model),
            turns_with_ring: false,
        }
    }
}

/// The load that acts along z, in words.
fn along_z(model: &Model) -> Option<String> {
    let mut loads = model.scene.loads.keys().zip(&model.loads);
    let found = loads.find(|(_, load)| load.direction[2] != 0.0 && load.force.peak() != 0.0)?;
    Some(format!("load {:?} acts along z", found.0))
}

/// The load or moment that tilts a ring, in words.
fn tilting(model: &Model) -> Option<String> {
    let tilts = |moment: Vector3<f64>| moment.xy() != Vector2::zeros();
    let mut loads = model.scene.loads.keys().zip(&model.loads);
    let load = loads.find(|(_, load)| {
        let tilts = |arm: Vector3<f64>| tilts(arm.cross(&Vector3::from(load.direction)));
        load.arm.is_some_and(tilts) && load.force.peak() != 0.0
    });
    let mut moments = model.scene.moments.keys().zip(&model.moments);
    let moment =
        moments.find(|(_, of)| tilts(Vector3::from(of.direction)) && of.moment.peak() != 0.0);
    load.map(|(name, _)| format!("load {name:?} acts off the ring's centre"))
        .or(moment.map(|(name, _)| format!("moment {name:?} tilts a ring")))
}

fn sizes(model: &Model) -> impl Iterator<Item = &TimeFunction> + Clone {
    let forces = model.loads.iter().map(|load| &load.force);
    forces.chain(model.moments.iter().map(|moment| &moment.moment))
}

fn is_constant(size: &TimeFunction) -> bool {
    matches!(size, TimeFunction::Constant(_))
}

/// Load at a time \[s\], along x, y and z \[N\].
#[inline]
pub(crate) fn at(load: &LoadModel, t: f64) -> Vector3<f64> {
    Vector3::from(load.direction) * load.force.at(t)
}

/// Loads that stay the same, or those that change; with their moments about z where rings stay parallel.
fn add(model: &Model, steady: bool, t: f64, sums: &mut ForceSums<'_>) {
    let parallel = sums.moments.is_none();
    for load in model
        .loads
        .iter()
        .filter(|load| is_constant(&load.force) == steady)
    {
        let force = at(load, t);
        let arm = load.arm.filter(|_| parallel);
        let moment = arm.map_or_else(Vector3::zeros, |arm| arm.cross(&force));
        sums.add(load.ring, &RingWrench { force, moment });
    }
    let moments = model.moments.iter().filter(|_| parallel);
    for of in moments.filter(|of| is_constant(&of.moment) == steady) {
        let moment = Vector3::from(of.direction) * of.moment.at(t);
        let wrench = RingWrench {
            moment,
            ..RingWrench::default()
        };
        sums.add(of.ring, &wrench);
    }
}

/// Moment of all loads and moments on a ring about its centre of mass at a time \[s\], in the scene's frame \[N m\]; `out` leads vectors of
/// the ring's frame there.
pub(crate) fn moment(
    model: &Model,
    t: f64,
    ring: Race,
    out: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> Vector3<f64> {
    let mut sum = Vector3::zeros();
    for load in model.loads.iter().filter(|load| load.ring == ring) {
        if let Some(arm) = &load.arm {
            sum += out(arm).cross(&at(load, t));
        }
    }
    for moment in model.moments.iter().filter(|moment| moment.ring == ring) {
        sum += Vector3::from(moment.direction) * moment.moment.at(t);
    }
    sum
}
