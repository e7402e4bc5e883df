//! No more model than the scene needs: which degrees of freedom a run integrates, and why not the others.
//!
//! Exact is what goes unasked: directions that cannot accelerate (held, driven, or without any moment), and those that
//! a mirror symmetry of scene *and* start keeps at rest or makes a copy of others. Approximations go by request
//! ([`crate::scene::Approximations`]).

mod course;
mod grounds;
mod request;
mod symmetry;

use std::ops::Range;

use super::Model;

use course::{Coast, Orbit};
use grounds::{Grounds, Reason, is_felt};

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
    /// Rows that turn as one.
    orbits: Vec<Orbit>,
    /// Rows whose contacts are evaluated.
    pub(crate) rows: Range<usize>,
    /// All bodies stay in the planes of their rows.
    pub(crate) plane: bool,
    /// Axial places of rings (first two) and rows that are kept.
    pub(crate) levels: Option<Vec<f64>>,
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

impl Reduction {
    /// Keeps everything.
    fn none(model: &Model) -> Self {
        let mut whole = Self {
            stretches: Vec::new(),
            kept: 0,
            coasts: Vec::new(),
            felt: Vec::new(),
            orbits: Vec::new(),
            rows: 0..model.rows.len(),
            plane: false,
            levels: None,
            mirrored: false,
            closed: false,
            omissions: Vec::new(),
            obstacles: Vec::new(),
        };
        whole.keep(model, |_, _| true);
        whole
    }

    /// Leaves out what is given up by request and, if `exact` reductions are wanted, what does not change the motion
    /// from a start, a state of all bodies.
    pub(super) fn of(model: &Model, start: &[f64], exact: bool) -> Self {
        let mut reduction = Self::none(model);
        let mut obstacle = |what: &str, reason: String| {
            let what = what.to_owned();
            reduction.obstacles.push(Obstacle { what, reason });
        };
        let wanted = model.scene.approximations;
        let mut grounds = Grounds {
            exact,
            ..Grounds::default()
        };
        if exact {
            grounds.plane = symmetry::about_rows(model, start)
                .map_err(|reason| obstacle("motion in the plane", reason))
                .is_ok();
            grounds.mirrored = symmetry::of_rows(model, start).is_some_and(|found| {
                found
                    .map_err(|reason| obstacle("one row for two", reason))
                    .is_ok()
            });
            if model.rows[0].pairs[0].law.traction.is_some() {
                obstacle("balls without spin", "friction turns them".to_owned());
            }
        }
        if wanted.plane {
            grounds.levels = request::levels(model, start)
                .map_err(|reason| obstacle("axial places that are kept", reason))
                .ok();
        }
        if wanted.one_row && !grounds.mirrored {
            grounds.idle = request::idle_row(model, start)
                .map_err(|reason| obstacle("without the unloaded row", reason))
                .ok();
        }
        (reduction.closed, reduction.plane, reduction.mirrored) =
            (exact, grounds.plane, grounds.mirrored);
        reduction.rows = match grounds.idle {
            Some(row) => 1 - row..2 - row,
            None if grounds.mirrored => 0..1,
            None => 0..model.rows.len(),
        };
        reduction.leave_out(model, start, &grounds);
        reduction.levels = grounds.levels;
        reduction
    }

    fn leave_out(&mut self, model: &Model, start: &[f64], grounds: &Grounds) {
        let reasons: Vec<[Option<Reason>; 4]> = (0..model.bodies.len())
            .map(|body| std::array::from_fn(|direction| grounds.reason(model, body, direction)))
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
        for (state, reason) in reasons.iter().flatten().enumerate() {
            let Some(reason) = *reason else { continue };
            let Some(course) = grounds.course(model, start, state, reason) else {
                continue;
            };
            let coast = Coast {
                body: state / 4,
                direction: state % 4,
                course,
            };
            if coast.course.moves() && is_felt(model, &coast, reason) {
                self.felt.push(coast.clone());
            }
            self.coasts.push(coast);
        }
        for row in 0..model.rows.len() {
            let idle = grounds.idle == Some(row);
            let copy = grounds.mirrored && row == 1;
            if idle || model.scene.approximations.rolling && !copy {
                let at = self.place(2 + model.rows[row].first, 0);
                self.orbits.push(Orbit::of(model, row, start, at));
            }
        }
    }

    /// Place of a degree of freedom among the states, if it is kept.
    pub(crate) fn place(&self, body: usize, direction: usize) -> Option<usize> {
        let holds =
            |s: &&Stretch| s.direction == direction && (s.first..s.first + s.count).contains(&body);
        let stretch = self.stretches.iter().find(holds)?;
        Some(stretch.at + body - stretch.first)
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

    /// Rows that turn as one and whose radii are states, with the place of their first one.
    pub(crate) fn orbits(&self) -> impl Iterator<Item = (&Orbit, usize)> {
        self.orbits
            .iter()
            .filter_map(|orbit| Some((orbit, orbit.at?)))
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
        let mut kept = [of(q), of(v)].concat();
        for orbit in &self.orbits {
            orbit.compress(full, &mut kept);
        }
        kept
    }

    /// The states of all bodies at a time, from those that are kept. `full` holds them from another time, or from
    /// the start.
    pub(crate) fn expand(&self, model: &Model, t: f64, y: &[f64], full: &mut [f64]) {
        let half = full.len() / 2;
        self.spread(y, full);
        for coast in &self.coasts {
            let state = 4 * coast.body + coast.direction;
            (full[state], full[half + state]) = coast.course.at(t);
        }
        for orbit in &self.orbits {
            orbit.place(t, y, full);
        }
        if self.mirrored {
            let axial = f64::midpoint(
                model.scene.rows[0].axial_position,
                model.scene.rows[1].axial_position,
            );
            copy_row(model, full, 2.0 * axial);
        }
    }

    /// Rates of all states from the kept states and their rates.
    pub(crate) fn expand_rates(
        &self,
        model: &Model,
        t: f64,
        y: &[f64],
        rates: &[f64],
        full: &mut [f64],
    ) {
        let half = full.len() / 2;
        self.spread(rates, full);
        for coast in &self.coasts {
            let state = 4 * coast.body + coast.direction;
            full[state] = coast.course.at(t).1;
            full[half + state] = coast.course.rate(t);
        }
        for orbit in &self.orbits {
            orbit.rates(t, y, rates, full);
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

impl Model {
    /// Axial places that outer ring, inner ring and the rows of balls keep by request, from a state of all bodies in
    /// equilibrium; none where that is not asked for or cannot be.
    pub(crate) fn levels(&self, start: &[f64]) -> Option<Vec<f64>> {
        let levels = request::levels(self, start);
        levels.ok().filter(|_| self.scene.approximations.plane)
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
