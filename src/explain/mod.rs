//! Explanation of what a scene is compiled to: what a run integrates and leaves out, what that costs, and what would make it cheaper.

mod cost;
mod law;
mod oil;
mod pit;
mod space;
mod texture;
mod variants;

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;

use crate::base::error::Result;
use crate::base::interrupt;
use crate::contact::DefectContact;
use crate::dynamics::Dynamics;
use crate::model::{Model, Placed, Race};
use crate::reduction::{Obstacle, Omission, Reduction};
use crate::run;
use crate::scene::{Defect, Doubt, Scene, Spin, Surface};
use crate::signals::touched::{MostLoaded, Touched, compiled, is_there};
use crate::statics::compile;
use crate::statics::start::{Start, start};
use crate::statics::{AxisHeld, DefectPasses, axis_doubt, axis_held, describe, place};

pub use cost::Cost;
pub use law::LawExplanation;
pub use oil::OilExplanation;
pub use pit::PitExplanation;
pub use texture::TextureExplanation;
pub use variants::Variant;

/// Explanation of a run of a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Explanation {
    /// Name of the scene.
    pub name: String,
    /// Two rings and all balls.
    pub bodies: usize,
    /// States of all bodies: a place and a speed for each of four directions.
    pub states: usize,
    /// States that a run integrates.
    pub kept: usize,
    /// Parts that are left out, and why that changes nothing.
    pub omissions: Vec<Omission>,
    /// Parts that cannot be left out, and why.
    pub obstacles: Vec<Obstacle>,
    /// The contacts of every race.
    pub contacts: Vec<ContactKind>,
    /// Forces that the scene has, and that are evaluated in a run.
    pub evaluated: Vec<&'static str>,
    /// Forces that are set once, before the run.
    pub constant: Vec<&'static str>,
    /// Forces that the scene does not have: no code runs for them.
    pub absent: Vec<&'static str>,
    /// Cost of a run, measured here and now.
    pub cost: Cost,
    /// Changes that would make it cheaper, the cheapest first; those of its oil also where they would not.
    pub variants: Vec<Variant>,
    /// Meaning of the contacts' law; absent where none is loaded.
    pub law: Option<LawExplanation>,
    /// The oils of the rows that have one.
    pub oils: Vec<OilExplanation>,
    /// The textures of races and balls.
    pub textures: Vec<TextureExplanation>,
    /// The pits that a loaded contact meets.
    pub pits: Vec<PitExplanation>,
    /// Doubts about the scene, about the pressure in its contacts and about its films.
    pub doubts: Vec<Doubt>,
    /// Places of defects, and what contacts carry there at the healthy bearing's equilibrium: over a turn of
    /// the inner race or the ball past all balls; of one on the outer race with a ball at its angle.
    pub defects: Vec<Touched>,
    /// Spin of the balls.
    pub spin: Spin,
    /// Changes at rest by holding the balls' axis along the bearing's; absent where nothing turns or rubs.
    pub axis: Option<AxisHeld>,
    /// Notes on the scene to read before believing a long run.
    pub notes: Vec<String>,
}

/// How the contacts of a race are evaluated.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct ContactKind {
    /// Name of the race, such as `row 0, outer race`.
    pub race: String,
    /// Number of balls.
    pub contacts: usize,
    /// Evaluation of a contact: `6 nodes`, `3 of 6 nodes (mirror symmetry)`, `50 slices`, `image of row 0`.
    pub evaluation: String,
}

/// Explains a scene: compiles it, starts it and times some steps, of which it keeps nothing.
///
/// ```
/// use ballrace::scene::{Friction, presets};
/// let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
/// scene.friction = Friction::None;
/// let found = ballrace::explain(&scene).unwrap();
/// assert_eq!((found.states, found.kept), (88, 44));
/// assert!(found.contacts[0].evaluation.starts_with("3 of 6 nodes"));
/// ```
///
/// # Errors
/// As [`crate::simulate()`].
pub fn explain(scene: &Scene) -> Result<Explanation> {
    let (scene, placed) = place(scene)?;
    let model = compile(&scene)?.recorded_to(run::Run::default().band());
    let y0 = start(&model, &Start::Equilibrium)?;
    let reduction = Reduction::of(&model, &y0);
    let dynamics = Dynamics::begin(&model, reduction.as_ref(), &y0);
    let forces = dynamics.uses();
    let of = |wanted: crate::forces::Use| {
        let named = forces.iter().filter(|(_, kind)| *kind == wanted);
        named.map(|(name, _)| *name).collect()
    };
    let cost = cost::of(&model, &y0)?;
    let variants = variants::of(&model, &y0, &cost);
    // Cut short, timings and variants are none.
    interrupt::check()?;
    let at_start = describe(&model, &y0, 0);
    let defects = defects(&scene, &placed)?;
    let axis = axis_held(&scene).ok().flatten();
    interrupt::check()?;
    Ok(Explanation {
        spin: scene.spin.unwrap_or_default(),
        axis,
        name: scene.name.clone(),
        bodies: model.body_count(),
        states: model.dim(),
        kept: reduction.as_ref().map_or(model.dim(), Reduction::dim),
        omissions: listed(reduction.as_ref(), Reduction::omissions),
        obstacles: if model.is_spatial() && reduction.is_none() {
            Reduction::in_space(&model, 0.0, &y0)
                .err()
                .unwrap_or_default()
        } else {
            listed(reduction.as_ref(), Reduction::obstacles)
        },
        contacts: contacts(&model, &dynamics),
        evaluated: of(crate::forces::Use::Evaluated),
        constant: of(crate::forces::Use::Constant),
        absent: of(crate::forces::Use::Absent),
        variants,
        cost,
        law: law::of(&model, &at_start),
        oils: oil::of(&model)?,
        textures: texture::of(&model),
        pits: pit::of(&scene)?,
        doubts: at_start
            .doubts
            .into_iter()
            .chain(axis_doubt(&scene, axis))
            .chain(defects.iter().filter_map(|of| of.doubt(&scene)))
            .collect(),
        defects,
        notes: run::note(&model)
            .map(str::to_owned)
            .into_iter()
            .chain(space::notes(&model, &y0, reduction.is_some()))
            .collect(),
    })
}

fn listed<T: Clone>(reduction: Option<&Reduction>, list: fn(&Reduction) -> &[T]) -> Vec<T> {
    reduction.map_or_else(Vec::new, |reduction| list(reduction).to_vec())
}

/// Places of the defects of a scene, and whether contacts at equilibrium meet them.
fn defects(scene: &Scene, placed: &BTreeMap<String, Placed>) -> Result<Vec<Touched>> {
    let defects = scene.defects.iter().filter(|(_, defect)| is_there(defect));
    defects
        .map(|(name, defect)| {
            let untouched = Touched::not_yet(name, defect, placed[name]);
            let meeting = DefectPasses::of(scene, defect)?;
            Ok(match meeting {
                Some(meeting) => met(untouched, defect, &meeting),
                None => untouched,
            })
        })
        .collect()
}

/// Adds what contacts at equilibrium carry within a defect.
fn met(mut result: Touched, defect: &Defect, meeting: &DefectPasses) -> Touched {
    let DefectPasses { model, y, contacts } = meeting;
    let (shape, origin) = compiled(model, defect);
    let mut most = None;
    for &(j, race) in contacts {
        let [ball, ring] = model.facing(y, j, race);
        let pair = &model.rows[defect.row].pairs[race];
        let at_defect = DefectContact {
            defect: &shape,
            on_ball: defect.on == Surface::Ball,
            offset: 0.0,
            ball: &ball,
        };
        let found = pair.load_within(&model.balls[j].side, &ball, &ring, &at_defect);
        result.passes += 1;
        result.touched += usize::from(found.within > 0.0);
        result.largest_load = result.largest_load.max(found.within);
        let met = MostLoaded {
            load: found.load,
            place: found.place,
            race,
        };
        most = met.or(most);
    }
    result.met(model, defect, origin, most)
}

fn contacts(model: &Model, dynamics: &Dynamics<'_>) -> Vec<ContactKind> {
    let rows = model.scene().rows.iter().enumerate();
    rows.flat_map(|(row, of)| {
        Race::BOTH.map(|race| ContactKind {
            race: format!("row {row}, {} race", race.name()),
            contacts: of.ball_count,
            evaluation: dynamics.evaluation(row, race),
        })
    })
    .collect()
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {} bodies", self.name, self.bodies)?;
        writeln!(
            f,
            "states     {} of {} are integrated",
            self.kept, self.states
        )?;
        for Omission {
            what,
            degrees,
            reason,
        } in &self.omissions
        {
            writeln!(f, "  without  {what} ({} states): {reason}", 2 * degrees)?;
        }
        for Obstacle { what, reason } in &self.obstacles {
            writeln!(f, "  no       {what}: {reason}")?;
        }
        for note in &self.notes {
            writeln!(f, "  note     {note}")?;
        }
        if let Some(axis) = &self.axis {
            writeln!(f, "spin       {}", axis_in_words(axis, self.spin))?;
        }
        writeln!(f, "contacts")?;
        for kind in &self.contacts {
            writeln!(
                f,
                "  {}: {} × {}",
                kind.race, kind.contacts, kind.evaluation
            )?;
        }
        if let Some(law) = &self.law {
            writeln!(f, "law        {law}")?;
        }
        if !self.oils.is_empty() {
            writeln!(f, "oil")?;
        }
        for oil in &self.oils {
            writeln!(f, "  {oil}")?;
        }
        if !self.textures.is_empty() {
            writeln!(f, "texture")?;
        }
        for texture in &self.textures {
            writeln!(f, "  {texture}")?;
        }
        if !self.defects.is_empty() {
            writeln!(f, "defects    at equilibrium")?;
        }
        for defect in &self.defects {
            writeln!(f, "  {}", in_words(defect))?;
        }
        for pit in &self.pits {
            writeln!(f, "  {pit}")?;
        }
        for (name, forces) in [
            ("evaluated", &self.evaluated),
            ("set once", &self.constant),
            ("absent", &self.absent),
        ] {
            if !forces.is_empty() {
                writeln!(f, "{name:<11}{}", forces.join(", "))?;
            }
        }
        for doubt in &self.doubts {
            writeln!(f, "doubtful   {doubt}")?;
        }
        let cost = &self.cost;
        writeln!(
            f,
            "cost       {:.2} s for a simulated second on one thread: {:.0} evaluations of {:.2} µs",
            cost.seconds,
            cost.evaluations,
            1e6 * cost.evaluation
        )?;
        for (name, time) in cost.parts() {
            writeln!(f, "  {:>5.2} µs  {name}", 1e6 * time)?;
        }
        for variant in &self.variants {
            writeln!(
                f,
                "  {:>5.2} ×  {}{}",
                variant.seconds / cost.seconds,
                variant.change,
                if variant.note.is_empty() {
                    String::new()
                } else {
                    format!(" ({})", variant.note)
                }
            )?;
        }
        Ok(())
    }
}

/// Spin of the balls in words, and what the other spin would give.
fn axis_in_words(axis: &AxisHeld, spin: Spin) -> String {
    let by = format!(
        "orbit by {:+.2} %, loads by up to {:.2} % of the largest",
        100.0 * axis.orbit,
        100.0 * axis.load
    );
    match (spin, axis.is_same()) {
        (Spin::Free, false) => {
            format!("free: about the bearing's axis alone it would change the {by}")
        }
        (Spin::Free, true) => format!(
            "free, with three states a ball; spin = \"axial\" would do, which changes the {by}"
        ),
        (Spin::Axial, true) => format!("axial: about any axis it is the same, the {by}"),
        (Spin::Axial, false) => format!("axial, which changes the {by}; use spin = \"free\""),
    }
}

/// Place of a defect in words, why it lies there, and whether contacts meet it.
fn in_words(defect: &Touched) -> String {
    let Touched { name, .. } = defect;
    let place = 1e3 * defect.axial_offset;
    let from = match defect.placed {
        Placed::Given => "as given",
        Placed::Contact => "where contacts run",
        Placed::Nominal => "at the nominal contact angle, since no contact is loaded",
    };
    let met = match (defect.passes, defect.touched) {
        (0, _) => "whether it is touched is unknown without an equilibrium".to_owned(),
        (_, 0) => match defect.contact_offset {
            Some(run) => format!("not touched: contacts run at {:.3} mm", 1e3 * run),
            None => "not touched: no contact is loaded there".to_owned(),
        },
        (1, _) => format!("touched with up to {:.1} N", defect.largest_load),
        (passes, touched) => format!(
            "touched at {touched} of {passes} places of a turn, with up to {:.1} N",
            defect.largest_load
        ),
    };
    format!("{name}: at {place:.3} mm, {from}; {met}")
}
