//! No more model than the scene needs: which degrees of freedom a run integrates, and why not the others.
//!
//! All of it is exact. Left out are directions that cannot accelerate (held, driven, or without any moment), and
//! those that a mirror symmetry of scene *and* start keeps at rest or makes a copy of others.

mod symmetry;

use super::{Degree, Model};
use crate::scene::{Drive, TimeFunction};

/// The degrees of freedom that a run integrates, and what becomes of the others.
///
/// The states of a run stand direction by direction (x of all bodies that keep it, then y, z, θ; then the
/// velocities in the same order), so that neighbours lie side by side.
#[derive(Debug, Clone)]
pub struct Reduction {
    stretches: Vec<Stretch>,
    kept: usize,
    coasts: Vec<Coast>,
    /// Those that some force depends on.
    felt: Vec<Coast>,
    /// All bodies stay in the planes of their rows.
    pub(crate) plane: bool,
    /// The second row is the first one's mirror image.
    pub(crate) mirrored: bool,
    /// Contacts may be evaluated in closed form.
    pub(crate) closed: bool,
    omissions: Vec<Omission>,
    obstacles: Vec<Obstacle>,
}

/// Degrees of freedom that a run leaves out.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct Omission {
    /// What they are, such as `z`.
    pub what: String,
    /// How many.
    pub degrees: usize,
    /// Why they may go.
    pub reason: String,
}

/// A reduction that the scene does not allow.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct Obstacle {
    /// The reduction.
    pub what: String,
    /// What stands against it.
    pub reason: String,
}

/// Neighbouring bodies that keep a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stretch {
    pub direction: usize,
    pub first: usize,
    pub count: usize,
    /// Place of the first among the states.
    pub at: usize,
}

/// A degree of freedom whose speed does not depend on any force.
#[derive(Debug, Clone)]
pub(crate) struct Coast {
    pub body: usize,
    pub direction: usize,
    place: f64,
    speed: f64,
    /// The drive, which prescribes the change of speed.
    drive: Option<TimeFunction>,
}

impl Coast {
    /// Place and speed at a time.
    pub fn at(&self, t: f64) -> (f64, f64) {
        match &self.drive {
            Some(drive) => {
                let extra = self.speed - drive.at(0.0);
                (
                    self.place + extra * t + drive.integral(t),
                    extra + drive.at(t),
                )
            }
            None => (self.place + self.speed * t, self.speed),
        }
    }
}

/// Why a degree of freedom is not integrated.
#[derive(Clone, Copy, PartialEq)]
enum Reason {
    Held,
    Driven,
    NoMoment,
    Mirror,
    Copy,
}

impl Reason {
    const ALL: [Self; 5] = [
        Self::Held,
        Self::Driven,
        Self::NoMoment,
        Self::Mirror,
        Self::Copy,
    ];

    fn describe(self) -> (&'static str, &'static str) {
        match self {
            Self::Held => ("held directions", "they do not move"),
            Self::Driven => ("rotation of the inner ring", "the drive prescribes it"),
            Self::NoMoment => ("spin of balls", "no friction: nothing turns them"),
            Self::Mirror => ("z", "mirror symmetry"),
            Self::Copy => ("balls of row 1", "mirror image of row 0"),
        }
    }
}

impl Reduction {
    /// Keeps everything.
    pub fn none(model: &Model) -> Self {
        let mut whole = Self {
            stretches: Vec::new(),
            kept: 0,
            coasts: Vec::new(),
            felt: Vec::new(),
            plane: false,
            mirrored: false,
            closed: false,
            omissions: Vec::new(),
            obstacles: Vec::new(),
        };
        whole.keep(model, |_, _| true);
        whole
    }

    /// Leaves out what does not change the motion from a start, a state of all bodies.
    pub fn of(model: &Model, start: &[f64]) -> Self {
        let mut reduction = Self::none(model);
        let mut obstacle = |what: &str, reason: String| {
            let what = what.to_owned();
            reduction.obstacles.push(Obstacle { what, reason });
        };
        let plane = symmetry::about_rows(model, start)
            .map_err(|reason| obstacle("motion in the plane", reason));
        let mirrored = symmetry::of_rows(model, start)
            .map(|reason| reason.map_err(|reason| obstacle("one row for two", reason)));
        if model.rows[0].pairs[0].friction.is_some() {
            obstacle("balls without spin", "friction turns them".to_owned());
        }
        reduction.closed = true;
        reduction.plane = plane.is_ok();
        reduction.mirrored = matches!(mirrored, Some(Ok(())));
        reduction.leave_out(model, start);
        reduction
    }

    fn leave_out(&mut self, model: &Model, start: &[f64]) {
        let reasons: Vec<[Option<Reason>; 4]> = (0..model.bodies.len())
            .map(|body| std::array::from_fn(|direction| self.reason(model, body, direction)))
            .collect();
        self.keep(model, |body, direction| reasons[body][direction].is_none());
        for reason in Reason::ALL {
            let of = |degrees: &[Option<Reason>; 4]| {
                degrees.iter().filter(|r| **r == Some(reason)).count()
            };
            let degrees = reasons.iter().map(of).sum();
            if degrees > 0 {
                let (what, reason) = reason.describe();
                self.omissions.push(Omission {
                    what: what.to_owned(),
                    degrees,
                    reason: reason.to_owned(),
                });
            }
        }
        let half = start.len() / 2;
        for (body, reasons) in reasons.iter().enumerate() {
            for (direction, reason) in reasons.iter().enumerate() {
                let Some(reason) = *reason else { continue };
                let state = 4 * body + direction;
                let (place, speed) = match reason {
                    Reason::Copy => continue,
                    Reason::Mirror => (model.bodies[body].nominal[direction], 0.0),
                    _ => (start[state], start[half + state]),
                };
                let drive = match &model.scene.drive {
                    Drive::Speed(value) if reason == Reason::Driven => Some(value.clone()),
                    _ => None,
                };
                let moves = speed != 0.0 || drive.is_some();
                let coast = Coast {
                    body,
                    direction,
                    place,
                    speed,
                    drive,
                };
                if moves && reason != Reason::NoMoment {
                    self.felt.push(coast.clone());
                }
                self.coasts.push(coast);
            }
        }
    }

    /// Why a degree of freedom can be left out.
    fn reason(&self, model: &Model, body: usize, direction: usize) -> Option<Reason> {
        let ball = body.checked_sub(2).map(|j| &model.balls[j]);
        if self.mirrored && ball.is_some_and(|ball| ball.row == 1) {
            return Some(Reason::Copy);
        }
        match model.bodies[body].degrees[direction] {
            Degree::Fixed => Some(Reason::Held),
            Degree::Driven => Some(Reason::Driven),
            Degree::Free { stiffness, damping } => match (direction, ball) {
                (2, _) if self.plane => Some(Reason::Mirror),
                // The image pulls the rings the other way.
                (2, None) if self.mirrored => Some(Reason::Mirror),
                (3, Some(ball)) => {
                    let smooth = model.rows[ball.row].pairs[0].friction.is_none();
                    let whole = ball.side.faults.is_empty();
                    let loose = stiffness == 0.0 && damping == 0.0;
                    (smooth && whole && loose).then_some(Reason::NoMoment)
                }
                _ => None,
            },
        }
    }

    /// Lists what is kept, direction by direction.
    fn keep(&mut self, model: &Model, keeps: impl Fn(usize, usize) -> bool) {
        self.stretches.clear();
        self.kept = 0;
        for direction in 0..4 {
            for body in (0..model.bodies.len()).filter(|body| keeps(*body, direction)) {
                match self.stretches.last_mut() {
                    Some(last)
                        if last.direction == direction && last.first + last.count == body =>
                    {
                        last.count += 1;
                    }
                    _ => self.stretches.push(Stretch {
                        direction,
                        first: body,
                        count: 1,
                        at: self.kept,
                    }),
                }
                self.kept += 1;
            }
        }
    }

    /// Number of states of a run: a place and a speed for each degree of freedom that is kept.
    pub fn dim(&self) -> usize {
        2 * self.kept
    }

    /// What is left out.
    pub fn omissions(&self) -> &[Omission] {
        &self.omissions
    }

    /// What cannot be.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    pub(crate) fn stretches(&self) -> &[Stretch] {
        &self.stretches
    }

    /// What moves by itself and is felt by some force.
    pub(crate) fn felt(&self) -> &[Coast] {
        &self.felt
    }

    /// The kept degrees of freedom in their order, as (body, direction).
    pub(crate) fn degrees(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.stretches
            .iter()
            .flat_map(|s| (0..s.count).map(|i| (s.first + i, s.direction)))
    }

    /// The kept states out of those of all bodies.
    ///
    /// # Panics
    /// If `full` is too short.
    pub fn compress(&self, full: &[f64]) -> Vec<f64> {
        let (q, v) = full.split_at(full.len() / 2);
        let of = |half: &'_ [f64]| -> Vec<f64> {
            self.degrees()
                .map(|(body, direction)| half[4 * body + direction])
                .collect()
        };
        [of(q), of(v)].concat()
    }

    /// The states of all bodies at a time, from those that are kept. `full` holds them from another time, or from
    /// the start.
    pub(crate) fn expand(&self, model: &Model, t: f64, y: &[f64], full: &mut [f64]) {
        let half = full.len() / 2;
        self.spread(y, full);
        for coast in &self.coasts {
            let state = 4 * coast.body + coast.direction;
            (full[state], full[half + state]) = coast.at(t);
        }
        if self.mirrored {
            let axial = f64::midpoint(
                model.scene.rows[0].axial_position,
                model.scene.rows[1].axial_position,
            );
            copy_row(model, full, 2.0 * axial);
        }
    }

    /// Rates of all states from those of the kept ones and the places and speeds of all.
    pub(crate) fn expand_rates(&self, model: &Model, t: f64, rates: &[f64], full: &mut [f64]) {
        let half = full.len() / 2;
        self.spread(rates, full);
        for coast in &self.coasts {
            let state = 4 * coast.body + coast.direction;
            full[state] = coast.at(t).1;
            full[half + state] = coast.drive.as_ref().map_or(0.0, |drive| drive.rate(t));
        }
        if self.mirrored {
            copy_row(model, full, 0.0);
        }
    }

    fn spread(&self, y: &[f64], full: &mut [f64]) {
        let half = full.len() / 2;
        for s in &self.stretches {
            for i in 0..s.count {
                let state = 4 * (s.first + i) + s.direction;
                full[state] = y[s.at + i];
                full[half + state] = y[self.kept + s.at + i];
            }
        }
    }
}

/// Makes the second row the image of the first, whose axial places z become `sum` − z.
fn copy_row(model: &Model, full: &mut [f64], sum: f64) {
    let (first, second) = (2 + model.rows[0].first, 2 + model.rows[1].first);
    let half = full.len() / 2;
    for (offset, sum) in [(0, sum), (half, 0.0)] {
        for k in 0..model.rows[0].count {
            let (from, to) = (offset + 4 * (first + k), offset + 4 * (second + k));
            full.copy_within(from..from + 4, to);
            full[to + 2] = sum - full[from + 2];
        }
    }
}
