//! Checks once in a process that contacts evaluated at an instruction set agree with the same contacts one by one.

use std::sync::OnceLock;

use crate::dynamics::Dynamics;
use crate::dynamics::contributions;
use crate::integrate::System;
use crate::model::{BodyId, Dof, Model};
use crate::reduction::Reduction;
use crate::scene::{Friction, Scene, presets};
use crate::simd::{Distrust, InstructionSet};
use crate::statics::compile;
use crate::statics::start::{Start, start};

/// Largest difference of a body's force, over the largest of all. Both ways agree to about 1e-13; what goes wrong loses whole
/// contacts.
const TOLERANCE: f64 = 1e-9;

/// Evaluation of the contacts of a body, as [`Distrust`] names it.
const CONTACTS: &str = "contacts";

/// The model with its instruction set, or with the next narrower one where contacts do not agree, and what was wrong if anything was.
///
/// An instruction set is tried once a process, in less than a millisecond.
pub(crate) fn trusted(model: Model) -> (Model, Option<Distrust>) {
    let instructions = model.instructions();
    let below = InstructionSet::available()
        .into_iter()
        .skip_while(|other| *other != instructions);
    let used = below.into_iter().find(|instructions| agrees(*instructions));
    let used = used.unwrap_or(InstructionSet::BASELINE);
    let distrust = (used != instructions).then(|| Distrust {
        instructions: instructions.name().into(),
        primitive: CONTACTS.into(),
        used: used.name().into(),
    });
    (
        model.with_instructions(used),
        distrust.or_else(InstructionSet::distrust),
    )
}

/// Whether contacts agree at an instruction set; found out once.
fn agrees(instructions: InstructionSet) -> bool {
    static FOUND: [OnceLock<bool>; 3] = [const { OnceLock::new() }; 3];
    let known = InstructionSet::known()
        .iter()
        .position(|name| *name == instructions.name());
    known
        .is_some_and(|at| *FOUND[at].get_or_init(|| scenes().iter().all(|s| fits(s, instructions))))
}

/// Scenes of the test: whole zones by eights, and halves of zones with a ball over a spall.
fn scenes() -> [Scene; 2] {
    let wheel = presets::wheel_bearing(3000.0);
    let mut spalled = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    spalled.friction = Friction::None;
    spalled.defects.clone_from(&wheel.defects);
    for spall in spalled.defects.values_mut() {
        spall.axial_offset = 0.0.into();
    }
    [wheel, spalled]
}

fn fits(scene: &Scene, instructions: InstructionSet) -> bool {
    difference(scene, instructions).is_ok_and(|apart| apart <= TOLERANCE)
}

/// Largest difference of the accelerations with the inner ring pressed down and balls pressed out, over the largest of all: on
/// either race a contact that is lost is seen.
fn difference(scene: &Scene, instructions: InstructionSet) -> crate::Result<f64> {
    /// Deeper than the clearance, so that the lower balls carry \[m\].
    const PRESSED: f64 = 20e-6;
    /// Distance of the balls from the axis over the pitch circle's radius; the outer race is a quarter of the clearance away.
    const SPREAD: f64 = 1.0 + 5e-4;
    let model = compile(scene)?.with_instructions(instructions);
    let mut y = start(&model, &Start::Rolling)?;
    let layout = model.layout();
    y[layout.at(BodyId::INNER, Dof::Y)] -= PRESSED;
    for ball in 0..model.balls.len() {
        for dof in Dof::SYMMETRIC {
            y[layout.at(BodyId::ball(ball), dof)] *= SPREAD;
        }
    }
    let reduction = Reduction::of(&model, &y);
    let mut dynamics = Dynamics::begin(&model, reduction.as_ref(), &y);
    let own = dynamics.compress(&y);
    let (mut rates, mut found) = (own.clone(), y.clone());
    dynamics.rhs(0.0, &own, &mut rates);
    dynamics.expand_rates(0.0, &rates, &mut found);
    let wanted = one_by_one(&model, &y);
    let apart = |(found, wanted): (&f64, &f64)| (found - wanted).abs();
    let accelerations = &found[y.len() / 2..];
    let worst = accelerations
        .iter()
        .zip(&wanted)
        .map(apart)
        .fold(0.0, f64::max);
    let largest = wanted.iter().copied().map(f64::abs).fold(0.0, f64::max);
    Ok(worst / largest)
}

/// Accelerations of all bodies by the contacts one by one.
fn one_by_one(model: &Model, y: &[f64]) -> Vec<f64> {
    let mut accelerations = vec![0.0; y.len() / 2];
    for (_, part) in contributions(model, 0.0, y) {
        for ((sum, force), mobility) in accelerations
            .iter_mut()
            .zip(part)
            .zip(model.mobility.as_flattened())
        {
            *sum += force * mobility;
        }
    }
    accelerations
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Analytic: one law, evaluated in two ways, in every way that runs have; an instruction set that loses contacts is seen.
    #[test]
    fn levels_of_this_machine_agree() {
        for instructions in InstructionSet::available() {
            for scene in scenes() {
                let apart = difference(&scene, instructions).unwrap();
                println!("{}, {instructions}: {apart:.1e}", scene.name);
                assert!(apart < 1e-11, "{}, {instructions}: {apart:.1e}", scene.name);
            }
        }
        let model = compile(&scenes()[0]).unwrap();
        let instructions = model.instructions();
        let (model, distrust) = trusted(model);
        assert_eq!((model.instructions(), distrust), (instructions, None));
    }
}
