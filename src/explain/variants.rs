//! What a scene would cost with something taken away or simplified.

use serde::Serialize;

use super::cost::{self, Cost};
use crate::model::{Model, Reduction};
use crate::scene::{Friction, Load, Scene, Slices, Surface};

/// The same scene with one change.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Variant {
    /// What is changed.
    pub change: String,
    /// What that does to the answer, where it is known.
    pub note: String,
    /// States that a run would integrate.
    pub kept: usize,
    /// Estimated time for a simulated second \[s\].
    pub seconds: f64,
}

/// Share of the cost below which a change is worth telling; nearer to it the clock decides.
const HELPS: f64 = 0.95;

/// A change that may make a scene cheaper; nothing where it does not apply.
type Change = fn(&Scene) -> Option<Scene>;

/// Changes by name, and what they do to the answer.
const CHANGES: [(&str, &str, Change); 11] = [
    (
        "with approximations.rolling",
        "of faulted races: rms to 16 %, rate of impacts to 0.7 %",
        |scene| {
            let mut changed = scene.clone();
            changed.approximations.rolling = true;
            (has_impacts(scene) && changed != *scene).then_some(changed)
        },
    ),
    (
        "with approximations.rolling and plane",
        "of faulted races: rms to 23 %, rate of impacts to 0.7 %",
        |scene| {
            let mut changed = scene.clone();
            (changed.approximations.rolling, changed.approximations.plane) = (true, true);
            (has_impacts(scene) && has_thrust(scene) && changed != *scene).then_some(changed)
        },
    ),
    (
        "with approximations.one_row",
        "the row left out carries less than 2 % of the load",
        |scene| {
            let mut changed = scene.clone();
            changed.approximations.one_row = true;
            (changed != *scene).then_some(changed)
        },
    ),
    ("without friction", "another answer", |scene| {
        (scene.friction != Friction::None).then(|| Scene {
            friction: Friction::None,
            ..scene.clone()
        })
    }),
    ("without the cage", "another answer", |scene| {
        scene.cage.as_ref().map(|_| Scene {
            cage: None,
            ..scene.clone()
        })
    }),
    ("without damping in contacts", "another answer", |scene| {
        let mut changed = scene.clone();
        changed.contact.damping = 0.0;
        (scene.contact.damping > 0.0).then_some(changed)
    }),
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
        "on 4 nodes",
        "normal force to 4e-4, friction to some 10 %",
        |scene| {
            let mut changed = scene.clone();
            changed.contact.slices = Slices::Fitted(4);
            (scene.contact.slices != changed.contact.slices).then_some(changed)
        },
    ),
    (
        "on 6 fitted nodes instead of slices",
        "closer to the converged force",
        |scene| {
            let mut changed = scene.clone();
            changed.contact.slices = Slices::Fitted(6);
            matches!(scene.contact.slices, Slices::Fixed(_)).then_some(changed)
        },
    ),
];

/// All that help, the cheapest first. They are timed at the scene's own start, and take its steps.
pub(super) fn of(model: &Model, y0: &[f64], cost: &Cost) -> Vec<Variant> {
    let mut variants = Vec::new();
    let reduction_now = model.reduction(y0);
    let own = reduction_now.as_ref().map_or(model.dim(), Reduction::dim);
    for (change, note, apply) in CHANGES {
        let Some(scene) = apply(model.scene()) else {
            continue;
        };
        // What the scene does not allow, or what would not hold, is no offer.
        let Ok(changed) = Model::new(&scene) else {
            continue;
        };
        let reduction = changed.reduction(y0);
        if obstacles(reduction.as_ref()) > obstacles(reduction_now.as_ref()) {
            continue;
        }
        let kept = reduction.map_or(changed.dim(), |r| r.dim());
        // The integrator's share goes with the states.
        let share = (cost.evaluation - cost.right_hand_side).max(0.0) * kept as f64 / own as f64;
        let evaluation = cost::right_hand_side(&changed, y0) + share;
        variants.push(Variant {
            change: change.to_owned(),
            note: note.to_owned(),
            kept,
            seconds: cost.evaluations * evaluation,
        });
    }
    variants.retain(|variant| variant.seconds < HELPS * cost.seconds);
    variants.push(Variant {
        change: "with twice the largest step at rtol 1e-3".to_owned(),
        note: "accelerations to 0.3 %; solver.frequency_cap = false, solver.max_step".to_owned(),
        kept: own,
        seconds: 0.5 * cost.seconds,
    });
    variants.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    variants
}

fn obstacles(reduction: Option<&Reduction>) -> usize {
    reduction.map_or(0, |reduction| reduction.obstacles().len())
}

fn is_thrust(load: &Load) -> bool {
    load.direction[2] != 0.0 && load.force.peak() > 0.0
}

fn has_thrust(scene: &Scene) -> bool {
    scene.loads.values().any(is_thrust)
}

/// Impacts outshine what approximations get wrong; a healthy race has nothing else to show.
fn has_impacts(scene: &Scene) -> bool {
    let mut defects = scene.defects.values();
    defects.any(|defect| defect.on != Surface::Ball)
}
