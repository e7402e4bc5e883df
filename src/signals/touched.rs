//! Defects that balls met in a run: how often they passed, and the loads of their contacts there.
//!
//! A *pass* is the time that a ball's contact takes over the arc of a defect; it counts as soon as the contact touches
//! the defect, or else when the ball has left it: a run that ends earlier does not count it. Positions are checked after accepted steps,
//! and between passes only when a ball may have covered half of its distance, so that this takes no time.

mod remembered;

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::base::nulls;

use crate::contact::{ContactDirection, DefectContact, Pair, SurfaceDefect, ZoneSlices};
use crate::dynamics::Dynamics;
use crate::integrate::DenseStep;
use crate::model::{Model, Placed, Race};
use crate::scene::{Defect, Doubt, Scene, Surface};

/// Record of a defect: its place, and what met it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Touched {
    /// Name of the defect.
    pub name: String,
    /// Surface on which the defect lies.
    pub on: Surface,
    /// Axial place of its middle, from the row's plane (races) or the ball's centre \[m\].
    #[serde(deserialize_with = "nulls::number")]
    pub axial_offset: f64,
    /// Origin of that number.
    pub placed: Placed,
    /// How often a ball came by: a contact of the race, or one of the ball's two contacts, passed over its arc. One that
    /// had touched nothing and was still over it when the run ended is not counted.
    pub passes: usize,
    /// Number of these passes in which a contact was loaded within the defect's length.
    pub touched: usize,
    /// Largest normal force of a contact within its length, to about a percent \[N\].
    pub largest_load: f64,
    /// Place at which the most loaded contact ran that passed, measured as `axial_offset` \[m\]; absent without load.
    pub contact_offset: Option<f64>,
    /// Width of that contact along rolling, 2b of Hertz's ellipse \[m\]; absent without load.
    pub contact_width: Option<f64>,
}

impl Touched {
    /// The record of a defect of a compiled scene that nothing has met.
    pub(crate) fn not_yet(name: &str, defect: &Defect, placed: Placed) -> Self {
        Self {
            name: name.to_owned(),
            on: defect.on,
            axial_offset: defect.axial_offset.number().unwrap_or(f64::NAN),
            placed,
            passes: 0,
            touched: 0,
            largest_load: 0.0,
            contact_offset: None,
            contact_width: None,
        }
    }

    /// The record with the most loaded contact that met the defect, if any, whose axial place is measured from `origin` \[m\].
    pub(crate) fn met(
        mut self,
        model: &Model,
        defect: &Defect,
        origin: f64,
        most: Option<MostLoaded>,
    ) -> Self {
        let width = |most: MostLoaded| {
            let hertz = &model.rows[defect.row].hertz[most.race];
            2.0 * hertz.half_width * most.load.cbrt()
        };
        self.contact_offset = most.map(|most| most.place - origin);
        self.contact_width = most.map(width);
        self
    }

    /// Doubt about a defect that is narrower than the contacts that meet it and is not a pit ([*Defects*](crate::equations#defects)).
    pub(crate) fn doubt(&self, scene: &Scene) -> Option<Doubt> {
        let defect = &scene.defects[&self.name];
        let (width, contact) = (defect.damage.width(), self.contact_width?);
        let is_narrow = defect.damage.is_patch() && width < NARROWEST * contact;
        is_narrow.then(|| Doubt::narrow_defect(&self.name, width, contact))
    }

    /// Share of the passes that touched it, 0 to 1; none without a pass.
    pub fn share(&self) -> Option<f64> {
        (self.passes > 0).then(|| self.touched as f64 / self.passes as f64)
    }
}

/// Whether a defect has any width; one without is healthy, and is not reported.
pub(crate) fn is_there(defect: &Defect) -> bool {
    defect.damage.width() > 0.0
}

/// Width of a defect over that of its contact from which fault circles unload it as a solver by boundary elements does; below, by a slot
/// as wide as a contact, by a third of it and less.
const NARROWEST: f64 = 1.3;

/// Half-widths from the middle at which a pass is over: a ball that rattles at the edge comes by once.
const AWAY: f64 = 1.2;
/// Share of the time to the next pass after which it is looked again.
const HALFWAY: f64 = 0.5;
/// The most, since speeds change \[s\].
const LONGEST: f64 = 1e-3;
/// Looks while a contact passes, at least, and the longest time between them \[s\].
const LOOKS: f64 = 32.0;
const OVER: f64 = 20e-6;

/// Slices that contacts are looked at with, at least: loads to about a percent, for a fifth of an evaluation's cost.
const SLICES: usize = 48;
/// Slices over the length of a defect, at least, and of a ball at most.
const WITHIN: f64 = 4.0;
const FINEST: usize = 1000;

/// Follows a run.
pub(crate) struct DefectWatch {
    defects: Vec<Watched>,
    /// States of all bodies.
    y: Vec<f64>,
    /// Time of the next look \[s\].
    next: f64,
}

/// A defect and the contacts that may meet it.
struct Watched {
    name: String,
    shape: SurfaceDefect,
    on: Surface,
    /// Origin from which its axial place is measured, in the frame of its body \[m\].
    origin: f64,
    /// Outer and inner race, to be looked at with few slices; they have all defects of the row, which share them.
    pairs: Arc<[Pair; 2]>,
    contacts: Vec<WatchedContact>,
    passes: usize,
    touched: usize,
    largest_load: f64,
    /// The most loaded contact that passed.
    most: Option<MostLoaded>,
}

/// A contact at a defect.
#[derive(Clone, Copy, Default)]
pub(crate) struct MostLoaded {
    /// \[N\]
    pub load: f64,
    /// Axial place, in the frame of the defect's body \[m\].
    pub place: f64,
    pub race: Race,
}

impl MostLoaded {
    /// The more loaded one of two.
    pub fn or(self, other: Option<Self>) -> Option<Self> {
        let is_more = self.load > other.map_or(0.0, |other| other.load);
        if is_more { Some(self) } else { other }
    }
}

/// Races by row and number of slices.
type Pairs = BTreeMap<(usize, usize), Arc<[Pair; 2]>>;

/// A contact that may meet a defect.
struct WatchedContact {
    /// Ball among all balls.
    ball: usize,
    race: Race,
    /// Angle between its direction and the defect's when last looked at \[rad\]; NaN before.
    offset: f64,
    pass: Pass,
}

#[derive(Clone, Copy, PartialEq)]
enum Pass {
    None,
    Untouched,
    Touched,
}

/// How a contact stands to a defect.
struct DefectView {
    /// Angle between its direction and the defect's \[rad\].
    offset: f64,
    /// Rate of that angle \[rad/s\].
    rate: f64,
    /// Half of the angle over which it meets the defect \[rad\].
    half: f64,
}

impl DefectWatch {
    /// The watch of a run of a model that has begun nowhere yet.
    pub fn new(model: &Model) -> Self {
        let defects = model.scene().defects.iter();
        let mut pairs = BTreeMap::new();
        Self {
            defects: defects
                .filter(|(_, defect)| is_there(defect))
                .map(|(name, defect)| Watched::new(model, name, defect, &mut pairs))
                .collect(),
            y: Vec::new(),
            next: f64::NEG_INFINITY,
        }
    }

    /// Prepares for a run from a state of all bodies.
    pub fn prepare(&mut self, start: &[f64]) {
        self.y = start.to_vec();
    }

    /// Goes on with another model; defects of the same names keep their counts.
    pub fn change(&mut self, model: &Model, start: &[f64]) {
        let before = std::mem::replace(self, Self::new(model));
        self.prepare(start);
        for of in before.defects {
            let mut named = self.defects.iter_mut();
            if let Some(same) = named.find(|other| other.name == of.name) {
                (same.passes, same.touched) = (of.passes, of.touched);
                (same.largest_load, same.most) = (of.largest_load, of.most);
                if same.contacts.len() == of.contacts.len() {
                    same.contacts = of.contacts;
                }
            }
        }
    }

    /// An accepted step.
    pub fn step(&mut self, dynamics: &Dynamics<'_>, step: &DenseStep<'_>) {
        let t = step.t1();
        if t < self.next || self.defects.is_empty() {
            return;
        }
        dynamics.expand(t, step.y1(), &mut self.y);
        let (model, y) = (dynamics.model(), &self.y);
        let waits = self.defects.iter_mut().map(|of| of.look(model, y));
        self.next = t + waits.fold(f64::INFINITY, f64::min).min(LONGEST);
    }

    /// Records of the defects, given where they were placed.
    pub fn results(&self, model: &Model, placed: &BTreeMap<String, Placed>) -> Vec<Touched> {
        let of = |watched: &Watched| {
            let defect = &model.scene().defects[&watched.name];
            let placed = placed.get(&watched.name).copied();
            Touched {
                passes: watched.passes,
                touched: watched.touched,
                largest_load: watched.largest_load,
                ..Touched::not_yet(&watched.name, defect, placed.unwrap_or(Placed::Given))
            }
            .met(model, defect, watched.origin, watched.most)
        };
        self.defects.iter().map(of).collect()
    }
}

/// A defect of a compiled scene as its contacts see it, and the place from which its axial place is measured \[m\].
pub(crate) fn compiled(model: &Model, defect: &Defect) -> (SurfaceDefect, f64) {
    let (row, pairs) = (
        &model.scene().rows[defect.row],
        &model.rows[defect.row].pairs,
    );
    let (hertz, widths) = (
        &model.rows[defect.row].hertz,
        model.typical_widths(defect.row),
    );
    let on_race = |race: Race| {
        let mut shape = SurfaceDefect::of_race(defect, row, &hertz[race], |z, length| {
            pairs[race].radii(z, length)
        });
        shape.widen(widths[race]);
        (shape, row.axial_position)
    };
    match defect.on {
        Surface::OuterRace => on_race(Race::Outer),
        Surface::InnerRace => on_race(Race::Inner),
        Surface::Ball => {
            let ball = model.rows[defect.row].first + defect.ball.unwrap_or(0);
            let mut shape = SurfaceDefect::of_ball(defect, model.balls[ball].side.radius, hertz);
            shape.widen(widths[0].max(widths[1]));
            (shape, 0.0)
        }
    }
}

/// Number of slices of a ball with which a defect of this length is looked at.
fn slices(length: f64, diameter: f64) -> usize {
    // A float becomes the nearest index that exists.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let fine = (WITHIN * diameter / length).ceil() as usize;
    fine.clamp(SLICES, FINEST)
}

impl Watched {
    fn new(model: &Model, name: &str, defect: &Defect, pairs: &mut Pairs) -> Self {
        let row = &model.rows[defect.row];
        let with = |race: Race| row.balls().map(|ball| (ball, race)).collect();
        let at: Vec<(usize, Race)> = match defect.on {
            Surface::OuterRace => with(Race::Outer),
            Surface::InnerRace => with(Race::Inner),
            Surface::Ball => {
                let ball = row.first + defect.ball.unwrap_or(0);
                Race::BOTH.map(|race| (ball, race)).to_vec()
            }
        };
        let contact = |(ball, race)| WatchedContact {
            ball,
            race,
            offset: f64::NAN,
            pass: Pass::None,
        };
        let (shape, origin) = compiled(model, defect);
        let diameter = model.scene().rows[defect.row].ball_diameter;
        let slices = slices(defect.damage.extent(), diameter);
        let pairs = pairs.entry((defect.row, slices)).or_insert_with(|| {
            Arc::new(row.pairs.each_ref().map(|pair| {
                let mut finer = pair.clone();
                finer.change(|flank| flank.slices = ZoneSlices::Fixed(slices));
                finer
            }))
        });
        Self {
            name: name.to_owned(),
            shape,
            on: defect.on,
            origin,
            pairs: Arc::clone(pairs),
            contacts: at.into_iter().map(contact).collect(),
            passes: 0,
            touched: 0,
            largest_load: 0.0,
            most: None,
        }
    }

    /// Looks at all contacts in a state of all bodies; how long until the next look \[s\].
    fn look(&mut self, model: &Model, y: &[f64]) -> f64 {
        let mut wait = f64::INFINITY;
        for i in 0..self.contacts.len() {
            let contact = &mut self.contacts[i];
            let DefectView { offset, rate, half } = contact.look(model, y, &self.shape, self.on);
            let before = std::mem::replace(&mut contact.offset, offset);
            // A narrow one may lie between two steps.
            let across = before.signum() != offset.signum() && (before - offset).abs() < PI;
            if offset.abs() <= half {
                self.meet(i, model, y, offset);
            } else if across && before.abs() > half {
                self.meet(i, model, y, 0.0);
            }
            if offset.abs() > AWAY * half {
                // One that has touched is counted; another only now, since until here it might have.
                let pass = std::mem::replace(&mut self.contacts[i].pass, Pass::None);
                self.passes += usize::from(pass == Pass::Untouched);
            }
            let until = HALFWAY * (offset.abs() - half).max(0.0);
            let over = (2.0 * half / LOOKS).min(OVER * rate.abs());
            wait = wait.min(until.max(over) / rate.abs());
        }
        wait
    }

    /// A contact stands over the defect, this far from its middle \[rad\].
    fn meet(&mut self, contact: usize, model: &Model, y: &[f64], offset: f64) {
        let contact = &mut self.contacts[contact];
        if contact.pass == Pass::None {
            contact.pass = Pass::Untouched;
        }
        let [ball, ring] = model.facing(y, contact.ball, contact.race);
        let at_defect = DefectContact {
            defect: &self.shape,
            on_ball: self.on == Surface::Ball,
            offset,
            ball: &ball,
        };
        let side = &model.balls[contact.ball].side;
        let found = self.pairs[contact.race].load_within(side, &ball, &ring, &at_defect);
        if found.within > 0.0 && contact.pass == Pass::Untouched {
            self.passes += 1;
            self.touched += 1;
            contact.pass = Pass::Touched;
        }
        self.largest_load = self.largest_load.max(found.within);
        let met = MostLoaded {
            load: found.load,
            place: found.place,
            race: contact.race,
        };
        self.most = met.or(self.most);
    }
}

impl WatchedContact {
    fn look(&self, model: &Model, y: &[f64], shape: &SurfaceDefect, on: Surface) -> DefectView {
        let [ball, ring] = model.facing(y, self.ball, self.race);
        let seen = ball.seen_from(&ring);
        let n = seen.centre / seen.centre.norm();
        let (direction, omega) = match (on, self.race) {
            (Surface::Ball, Race::Outer) => (
                ContactDirection::ball(&ball, n, seen.direction()),
                ball.omega,
            ),
            // The inner race is met on the ball's inner side.
            (Surface::Ball, Race::Inner) => (
                ContactDirection::ball(&ball, -n, seen.direction() + PI),
                ball.omega,
            ),
            _ => (
                ContactDirection::race(ring.angle_of(seen.direction())),
                ring.omega,
            ),
        };
        DefectView {
            offset: direction.offset(shape),
            rate: seen.orbit_speed() - direction.turning(shape, omega),
            half: direction.half(shape),
        }
    }
}
