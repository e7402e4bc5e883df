//! Reduction of a run: which degrees of freedom it integrates, and why not the others.
//!
//! Left out by default is only what does not change the motion: directions that cannot accelerate (held, driven, or without any
//! moment), and those that a mirror symmetry of scene *and* start keeps at rest or makes a copy of others. Approximations are made
//! on request ([`crate::scene::Approximations`]).

mod course;
mod grounds;
mod request;
mod space;
mod symmetry;

use std::ops::Range;

use crate::model::{BodyId, BodyKind, DOFS, Dof, Layout, Model};

use course::{Orbit, Prescribed};
use grounds::{Grounds, Reason, is_felt};

/// The degrees of freedom that a run integrates, and what becomes of the others.
///
/// The states of a run stand direction by direction (x of all bodies that keep it, then y, z, θ; then the
/// velocities in the same order), so that neighbours lie side by side.
#[derive(Debug, Clone)]
pub struct Reduction {
    stretches: Vec<Stretch>,
    kept: usize,
    prescribed: Vec<Prescribed>,
    /// Prescribed motions that some force depends on.
    felt: Vec<Prescribed>,
    /// Rows that turn as one.
    orbits: Vec<Orbit>,
    /// Rows whose contacts are evaluated.
    pub(crate) rows: Range<usize>,
    /// Condition that all bodies stay in the planes of their rows.
    pub(crate) plane: bool,
    /// Axial places of rings and rows that are kept.
    pub(crate) axial_places: Option<AxialPlaces>,
    /// The second row is the first one's mirror image.
    pub(crate) mirrored: bool,
    omissions: Vec<Omission>,
    obstacles: Vec<Obstacle>,
}

/// Degrees of freedom that a run leaves out.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct Omission {
    /// Name of the directions, such as `z`.
    pub what: String,
    /// Number of degrees of freedom.
    pub degrees: usize,
    /// Why they may go.
    pub reason: String,
}

/// A reduction that the scene does not allow.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct Obstacle {
    /// The reduction.
    pub what: String,
    /// Reason that stands against it.
    pub reason: String,
}

/// Axial places that rings and rows keep.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AxialPlaces {
    /// Places of outer and inner ring \[m\].
    pub rings: [f64; 2],
    /// Places of the balls of each row \[m\].
    pub rows: Vec<f64>,
}

impl AxialPlaces {
    /// The one that a body keeps \[m\].
    pub fn of(&self, model: &Model, body: BodyId) -> f64 {
        match model.layout().kind(body) {
            BodyKind::Ring(race) => self.rings[race],
            BodyKind::Cage(row) => self.rows[row],
            BodyKind::Mode(_) => 0.0,
            BodyKind::Ball(ball) => self.rows[model.balls[ball].row],
        }
    }
}

/// Neighbouring bodies that keep a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stretch {
    pub dof: Dof,
    pub first: BodyId,
    pub count: usize,
    /// Place of the first among the states.
    pub at: usize,
}

impl Stretch {
    /// Numbers of the bodies among all.
    pub fn bodies(&self) -> Range<usize> {
        self.first.range(self.count)
    }

    /// Places of the bodies among the states.
    pub fn states(&self) -> Range<usize> {
        self.at..self.at + self.count
    }
}

impl Reduction {
    /// Keeps everything.
    fn none(model: &Model) -> Self {
        let mut whole = Self {
            stretches: Vec::new(),
            kept: 0,
            prescribed: Vec::new(),
            felt: Vec::new(),
            orbits: Vec::new(),
            rows: 0..model.rows.len(),
            plane: false,
            axial_places: None,
            mirrored: false,
            omissions: Vec::new(),
            obstacles: Vec::new(),
        };
        whole.keep(model.layout(), |_, _| true);
        whole
    }

    /// The reduction of a run from a state of all bodies; absent where it integrates all states in the order of
    /// [`Model::names`], since rings tilt or balls spin freely.
    ///
    /// # Panics
    /// If the length of `start` is wrong.
    pub fn of(model: &Model, start: &[f64]) -> Option<Self> {
        Self::since(model, 0.0, start)
    }

    /// The reduction as of [`Self::of`], of a run that goes on from a state at a time \[s\].
    pub(crate) fn since(model: &Model, t: f64, start: &[f64]) -> Option<Self> {
        assert_eq!(start.len(), model.dim(), "length of the state");
        let solver = &model.scene.solver;
        if !model.is_spatial() {
            return Some(Self::leaving_out(model, t, start, solver.reduce));
        }
        if !solver.reduce {
            return None;
        }
        Self::in_space(model, t, start).ok()
    }

    /// Leaves out what is given up by request and, if `exact` reductions are wanted, what does not change the motion
    /// from a state of all bodies at a time.
    fn leaving_out(model: &Model, t: f64, start: &[f64], exact: bool) -> Self {
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
            let rub: Vec<usize> = (0..model.rows.len())
                .filter(|row| model.rows[*row].turns_balls())
                .collect();
            if rub.len() == model.rows.len() {
                obstacle("balls without spin", "friction turns them".to_owned());
            } else if let Some(row) = rub.first() {
                let reason = format!("friction turns those of row {row}");
                obstacle("balls without spin", reason);
            }
        }
        if wanted.plane {
            grounds.axial_places = request::axial_places(model, start)
                .map_err(|reason| obstacle("axial places that are kept", reason))
                .ok();
        }
        if wanted.one_row && !grounds.mirrored {
            grounds.idle = request::idle_row(model, start)
                .map_err(|reason| obstacle("without the unloaded row", reason))
                .ok();
        }
        (reduction.plane, reduction.mirrored) = (grounds.plane, grounds.mirrored);
        reduction.rows = match grounds.idle {
            Some(row) => 1 - row..2 - row,
            None if grounds.mirrored => 0..1,
            None => 0..model.rows.len(),
        };
        reduction.leave_out(model, t, start, &grounds);
        reduction.axial_places = grounds.axial_places;
        reduction
    }

    fn leave_out(&mut self, model: &Model, t: f64, start: &[f64], grounds: &Grounds) {
        let layout = model.layout();
        let reasons: Vec<[Option<Reason>; DOFS]> = layout
            .bodies()
            .map(|body| Dof::ALL.map(|dof| grounds.reason(model, body, dof)))
            .collect();
        self.keep(layout, |body, dof| reasons[body][dof].is_none());
        for reason in Reason::ALL {
            // A mode has one direction, whatever the table of bodies has for it.
            let counts = |body: &BodyId| !matches!(layout.kind(*body), BodyKind::Mode(_));
            let of = |body: BodyId| {
                let degrees = reasons[body].iter();
                degrees.filter(|r| **r == Some(reason)).count()
            };
            let degrees = layout.bodies().filter(counts).map(of).sum();
            if degrees > 0 {
                let (what, reason) = reason.describe();
                self.omissions.push(Omission {
                    what: what.to_owned(),
                    degrees,
                    reason: reason.to_owned(),
                });
            }
        }
        let of_all_bodies = |(_, dof): &(BodyId, Dof)| Dof::ALL.contains(dof);
        for (body, dof) in layout.degrees().filter(of_all_bodies) {
            let Some(reason) = reasons[body][dof] else {
                continue;
            };
            let Some(course) = grounds.course(model, t, start, body, dof, reason) else {
                continue;
            };
            // What rests where the start has it stays there in all states that are made of the start.
            let [place, speed] =
                [layout.at(body, dof), layout.speed_at(body, dof)].map(|at| start[at]);
            if !course.moves() && course.at(t) == (place, speed) {
                continue;
            }
            let prescribed = Prescribed { body, dof, course };
            if prescribed.course.moves() && is_felt(model, &prescribed, reason) {
                self.felt.push(prescribed.clone());
            }
            self.prescribed.push(prescribed);
        }
        for row in 0..model.rows.len() {
            let idle = grounds.idle == Some(row);
            let copy = grounds.mirrored && row == 1;
            if idle || model.scene.approximations.rolling && !copy {
                let at = self.place(model.rows[row].first_body(), Dof::X);
                self.orbits.push(Orbit::of(model, row, t, start, at));
            }
        }
    }

    /// Place of a degree of freedom among the states, if it is kept.
    pub(crate) fn place(&self, body: BodyId, dof: Dof) -> Option<usize> {
        let holds = |s: &&Stretch| s.dof == dof && s.bodies().contains(&body.index());
        let stretch = self.stretches.iter().find(holds)?;
        Some(stretch.at + body.index() - stretch.first.index())
    }

    /// Lists what is kept, direction by direction.
    fn keep(&mut self, layout: Layout, keeps: impl Fn(BodyId, Dof) -> bool) {
        self.stretches.clear();
        self.kept = 0;
        for dof in Dof::ALL {
            for body in layout.bodies().filter(|body| keeps(*body, dof)) {
                match self.stretches.last_mut() {
                    Some(last) if last.dof == dof && last.first.after(last.count) == body => {
                        last.count += 1;
                    }
                    _ => self.stretches.push(Stretch {
                        dof,
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

    /// The parts that are left out.
    pub fn omissions(&self) -> &[Omission] {
        &self.omissions
    }

    /// The parts that cannot be left out.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    pub(crate) fn stretches(&self) -> &[Stretch] {
        &self.stretches
    }

    /// Motions that go by themselves and are felt by some force.
    pub(crate) fn felt(&self) -> &[Prescribed] {
        &self.felt
    }

    /// Rows that turn as one and whose radii are states, with the place of their first one.
    pub(crate) fn orbits(&self) -> impl Iterator<Item = (&Orbit, usize)> {
        self.orbits
            .iter()
            .filter_map(|orbit| Some((orbit, orbit.at?)))
    }

    /// States that are distances of balls from the shaft, by their places.
    pub(crate) fn radii(&self) -> impl Iterator<Item = (usize, BodyId)> {
        let of = |(orbit, at): (&Orbit, usize)| {
            let first = orbit.first;
            (0..orbit.starts.len()).map(move |k| (at + k, first.after(k)))
        };
        self.orbits().flat_map(of)
    }

    /// The kept degrees of freedom in their order.
    pub(crate) fn degrees(&self) -> impl Iterator<Item = (BodyId, Dof)> + '_ {
        self.stretches
            .iter()
            .flat_map(|s| (0..s.count).map(|i| (s.first.after(i), s.dof)))
    }

    /// The kept states out of those of all bodies.
    ///
    /// # Panics
    /// If `full` is too short.
    pub fn compress(&self, full: &[f64]) -> Vec<f64> {
        let (q, v) = full.split_at(full.len() / 2);
        let of = |half: &'_ [f64]| -> Vec<f64> {
            let bodies = Layout::each(half);
            self.degrees()
                .map(|(body, dof)| bodies[body.index()][dof])
                .collect()
        };
        let mut kept = [of(q), of(v)].concat();
        for orbit in &self.orbits {
            orbit.compress(full, &mut kept);
        }
        kept
    }

    /// The states of all bodies at a time, from those that are kept. `full` holds them from another time, or from
    /// the start: what rests there is not written.
    #[inline]
    pub(crate) fn expand(&self, model: &Model, t: f64, y: &[f64], full: &mut [f64]) {
        let layout = model.layout();
        self.spread(layout, y, full);
        for motion in &self.prescribed {
            let (place, speed) = motion.course.at(t);
            full[layout.at(motion.body, motion.dof)] = place;
            full[layout.speed_at(motion.body, motion.dof)] = speed;
        }
        for orbit in &self.orbits {
            orbit.place(t, y, full);
        }
        if let (true, [first, second]) = (self.mirrored, &model.scene.rows[..]) {
            let axial = f64::midpoint(first.axial_position, second.axial_position);
            let (places, speeds) = full.split_at_mut(layout.half());
            copy_row(model, places, 2.0 * axial);
            copy_row(model, speeds, 0.0);
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
        let layout = model.layout();
        full.fill(0.0);
        self.spread(layout, rates, full);
        for motion in &self.prescribed {
            full[layout.at(motion.body, motion.dof)] = motion.course.at(t).1;
            full[layout.speed_at(motion.body, motion.dof)] = motion.course.rate(t);
        }
        for orbit in &self.orbits {
            orbit.rates(t, y, rates, full);
        }
        let (speeds, accelerations) = full.split_at_mut(layout.half());
        self.mirror(model, speeds);
        self.mirror(model, accelerations);
    }

    /// Mirrors the first row, where one runs for two, into the second: speeds or changes, by body.
    pub(crate) fn mirror(&self, model: &Model, half: &mut [f64]) {
        if self.mirrored {
            copy_row(model, half, 0.0);
        }
    }

    #[inline]
    fn spread(&self, layout: Layout, y: &[f64], full: &mut [f64]) {
        let (places, speeds) = full.split_at_mut(layout.half());
        for (half, from) in [(places, &y[..self.kept]), (speeds, &y[self.kept..])] {
            let bodies = Layout::each_mut(half);
            for s in &self.stretches {
                for (body, number) in bodies[s.bodies()].iter_mut().zip(&from[s.states()]) {
                    body[s.dof] = *number;
                }
            }
        }
    }
}

/// Axial places that rings and rows keep by request, from a state of all bodies in equilibrium; none where that is not asked
/// for or cannot be.
pub(crate) fn axial_places(model: &Model, start: &[f64]) -> Option<AxialPlaces> {
    let axial_places = request::axial_places(model, start);
    axial_places
        .ok()
        .filter(|_| model.scene.approximations.plane)
}

/// Makes the second row the image of the first, whose axial numbers z become `sum` − z; of one half of a state.
fn copy_row(model: &Model, half: &mut [f64], sum: f64) {
    let [first, second] = [0, 1].map(|row| model.rows[row].first_body());
    let bodies = Layout::each_mut(half);
    for k in 0..model.rows[0].count {
        let mut image = bodies[first.after(k).index()];
        image[Dof::Z] = sum - image[Dof::Z];
        bodies[second.after(k).index()] = image;
    }
    if model.rows[0].cage.is_some() {
        let [from, to] = [0, 1].map(|row| model.layout().cage(row).index());
        let mut image = bodies[from];
        image[Dof::Z] = sum - image[Dof::Z];
        bodies[to] = image;
    }
}
