//! Cost of a scene with something taken away or simplified.

use serde::Serialize;

use super::cost::{self, Cost};
use crate::model::Model;
use crate::reduction::Reduction;
use crate::run::Run;
use crate::scene::{Load, Scene, Slices};
use crate::statics::compile;
use crate::statics::start::{Start, start};

/// The same scene with one change.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Variant {
    /// Change of the scene.
    pub change: String,
    /// Note on what the change does to the answer, where it is known.
    pub note: String,
    /// States that a run would integrate.
    pub kept: usize,
    /// Estimated time for a simulated second \[s\].
    pub seconds: f64,
}

/// Share of the cost below which a change is offered; nearer to it the timing is not accurate enough.
const HELPS: f64 = 0.95;

/// Changes that leave out the oil or a part of it: offered whatever they cost, for their effect on the result.
const WITHOUT_OIL: &str = "without oil";
const WITHOUT_ROLLING: &str = "without rolling resistance";
const WITHOUT_FILM_DAMPING: &str = "without the film's damping";
const OF_OIL: [&str; 3] = [WITHOUT_OIL, WITHOUT_ROLLING, WITHOUT_FILM_DAMPING];

/// A change that may make a scene cheaper; nothing where it does not apply.
type Change = fn(&Scene) -> Option<Scene>;

/// Changes by name, and what they do to the answer.
const CHANGES: [(&str, &str, Change); 10] = [
    ("without friction", "another answer", |scene| {
        let mut changed = scene.clone();
        changed.remove_friction();
        (changed != *scene).then_some(changed)
    }),
    ("without the cage", "another answer", |scene| {
        scene.cage.as_ref().map(|_| Scene {
            cage: None,
            ..scene.clone()
        })
    }),
    ("without damping in contacts", "another answer", |scene| {
        let mut changed = scene.clone();
        changed.contacts_mut().for_each(|of| of.damping = 0.0);
        (changed != *scene).then_some(changed)
    }),
    (
        WITHOUT_OIL,
        "of a 6205 under 500 N: rms with a spall to 11 %, healthy to 30 %, friction torque 0.2 instead of 9.7 N mm",
        |scene| {
            let mut changed = scene.clone();
            changed.remove_lubricants();
            (changed != *scene).then_some(changed)
        },
    ),
    (
        WITHOUT_ROLLING,
        "of a 6205 under 500 N: rms with a spall to 2 %, healthy to 31 %, friction torque 1.4 instead of 9.7 N mm",
        |scene| {
            let mut changed = scene.clone();
            changed.lubricants_mut().for_each(|of| of.rolling = false);
            (changed != *scene).then_some(changed)
        },
    ),
    (
        WITHOUT_FILM_DAMPING,
        "of a 6205 under 500 N: rms with a spall to 12 %, healthy to 9 %",
        |scene| {
            let mut changed = scene.clone();
            changed.lubricants_mut().for_each(|of| of.damping = false);
            (changed != *scene).then_some(changed)
        },
    ),
    ("without defects", "another answer", |scene| {
        let mut changed = scene.clone();
        changed.defects.clear();
        (!scene.defects.is_empty()).then_some(changed)
    }),
    ("without thrust", "another answer", |scene| {
        let mut changed = scene.clone();
        changed.loads.retain(|_, load| !is_thrust(load));
        has_thrust(scene).then_some(changed)
    }),
    ("without waviness", "another answer", |scene| {
        let mut changed = scene.clone();
        for row in &mut changed.rows {
            row.outer_waviness.clear();
            row.inner_waviness.clear();
        }
        (changed != *scene).then_some(changed)
    }),
    (
        "on 6 fitted nodes instead of slices",
        "closer to the converged force",
        |scene| {
            let mut changed = scene.clone();
            for contact in changed.contacts_mut() {
                if matches!(contact.slices, Slices::Fixed(_)) {
                    contact.slices = Slices::Fitted(6);
                }
            }
            (changed != *scene).then_some(changed)
        },
    ),
];

/// The variants that help or are of the oil, the cheapest first. Each is started and timed as the scene itself was.
pub(super) fn of(model: &Model, y0: &[f64], cost: &Cost) -> Vec<Variant> {
    let mut variants: Vec<Variant> = offers(model)
        .into_iter()
        .filter_map(|(change, note, changed)| {
            let y0 = &changed.layout().carry(y0, model.layout());
            Some(Variant {
                change: change.to_owned(),
                note: note.to_owned(),
                kept: Reduction::of(&changed, y0).map_or(changed.dim(), |r| r.dim()),
                seconds: seconds(&changed)?,
            })
        })
        .collect();
    variants.retain(|variant| {
        variant.seconds < HELPS * cost.seconds || OF_OIL.contains(&variant.change.as_str())
    });
    variants.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    variants
}

/// Time for a simulated second, measured; nothing where the model does not start.
fn seconds(model: &Model) -> Option<f64> {
    let y0 = start(model, &Start::Equilibrium).ok()?;
    Some(cost::of(model, &y0).ok()?.seconds)
}

/// Changes that apply to a scene, with their notes and models. What the scene does not allow is no offer.
fn offers(model: &Model) -> Vec<(&'static str, &'static str, Model)> {
    CHANGES
        .into_iter()
        .filter_map(|(change, note, apply)| {
            let changed = compile(&apply(model.scene())?)
                .ok()?
                .recorded_to(Run::default().band());
            Some((change, note, changed))
        })
        .collect()
}

fn is_thrust(load: &Load) -> bool {
    load.direction[2] != 0.0 && load.force.peak() > 0.0
}

fn has_thrust(scene: &Scene) -> bool {
    scene.loads.values().any(is_thrust)
}

/// The truth is what the scenes have; no clock has a part in it.
#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Lubricant, Probe, presets};

    fn offered(scene: &Scene) -> Vec<&'static str> {
        let model = compile(scene).unwrap();
        let offers = offers(&model);
        offers.into_iter().map(|(change, _, _)| change).collect()
    }

    /// A probe of the oil goes with it; a part that is left out already is not offered.
    #[test]
    fn oil_can_be_taken_away_by_its_parts() {
        let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        let mut oil = Lubricant::named("vg68", 328.15);
        oil.damping = false;
        scene.lubricant = Some(oil);
        scene
            .probes
            .insert("oil".to_owned(), Probe::Lubrication { row: 0 });
        let found = offered(&scene);
        assert!(
            found.contains(&WITHOUT_OIL) && found.contains(&WITHOUT_ROLLING),
            "{found:?}"
        );
        assert!(!found.contains(&WITHOUT_FILM_DAMPING), "{found:?}");
    }

    #[test]
    fn what_a_scene_has_can_be_taken_away() {
        let found = offered(&presets::deep_groove_6205(500.0, 0.0, 1800.0));
        for change in ["without friction", "without the cage"] {
            assert!(found.contains(&change), "{change}");
        }
        for change in [
            "without oil",
            "without rolling resistance",
            "without defects",
            "without thrust",
            "without waviness",
        ] {
            assert!(!found.contains(&change), "{change}");
        }
    }
}
