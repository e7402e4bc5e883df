//! Reduction of a run: which degrees of freedom it integrates, and why not the others.
//!
//! Left out is only what does not change the motion: directions that cannot accelerate (held, driven, or without any
//! moment), and those that a mirror symmetry of scene *and* start keeps at rest or makes a copy of others.

mod course;
mod grounds;
mod space;
mod symmetry;

use std::ops::Range;

use crate::model::{BodyId, BodyKind, DOFS, Dof, Layout, Model};

use course::Prescribed;
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
    /// Condition that all bodies stay in the planes of their rows.
    pub(crate) plane: bool,
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
            plane: false,
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
        match (model.is_spatial(), solver.reduce) {
            (false, true) => Some(Self::leaving_out(model, t, start)),
            (false, false) => Some(Self::none(model)),
            (true, true) => Self::in_space(model, t, start).ok(),
            (true, false) => None,
        }
    }

    /// Leaves out what does not change the motion from a state of all bodies at a time.
    fn leaving_out(model: &Model, t: f64, start: &[f64]) -> Self {
        let mut reduction = Self::none(model);
        let mut obstacle = |what: &str, reason: String| {
            let what = what.to_owned();
            reduction.obstacles.push(Obstacle { what, reason });
        };
        let plane = symmetry::about_rows(model, start)
            .map_err(|reason| obstacle("motion in the plane", reason))
            .is_ok();
        let mirrored = symmetry::of_rows(model, start).is_some_and(|found| {
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
        (reduction.plane, reduction.mirrored) = (plane, mirrored);
        reduction.leave_out(model, t, start, &Grounds { plane, mirrored });
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
            let of = (body, dof);
            let Some(prescribed) = Prescribed::of(model, t, start, of, reason) else {
                continue;
            };
            // What rests where the start has it stays there in all states that are made of the start.
            let [place, speed] =
                [layout.at(body, dof), layout.speed_at(body, dof)].map(|at| start[at]);
            let course = &prescribed.course;
            if !course.moves() && course.at(t) == (place, speed) {
                continue;
            }
            if course.moves() && is_felt(model, reason) {
                self.felt.push(prescribed.clone());
            }
            self.prescribed.push(prescribed);
        }
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
        [of(q), of(v)].concat()
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
        if let (true, [first, second]) = (self.mirrored, &model.scene.rows[..]) {
            let axial = f64::midpoint(first.axial_position, second.axial_position);
            let (places, speeds) = full.split_at_mut(layout.half());
            copy_row(model, places, 2.0 * axial);
            copy_row(model, speeds, 0.0);
        }
    }

    /// Rates of all states from those of the kept states.
    pub(crate) fn expand_rates(&self, model: &Model, t: f64, rates: &[f64], full: &mut [f64]) {
        let layout = model.layout();
        full.fill(0.0);
        self.spread(layout, rates, full);
        for motion in &self.prescribed {
            full[layout.at(motion.body, motion.dof)] = motion.course.at(t).1;
            full[layout.speed_at(motion.body, motion.dof)] = motion.course.rate(t);
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
