//! Motions that no force changes.

use crate::model::{BodyId, DOFS, Dof, Layout, Model};
use crate::scene::{Antiderivative, RingName, Scene, TimeFunction};

/// A place whose speed is constant or follows those that are given to the rings.
#[derive(Debug, Clone)]
pub(crate) struct Course {
    place: f64,
    /// The part of the speed that follows no ring.
    speed: f64,
    /// The rings' speeds that change.
    driven: Vec<Driven>,
}

/// A ring's speed that changes, and the share of it that a speed changes by.
#[derive(Debug, Clone)]
struct Driven {
    share: f64,
    speed: TimeFunction,
    turned: Antiderivative,
}

impl Driven {
    /// Additions to a place and to a speed at a time.
    fn at(&self, t: f64) -> (f64, f64) {
        (
            self.share * self.turned.at(&self.speed, t),
            self.share * self.speed.at(t),
        )
    }
}

impl Course {
    /// A course at a constant speed, at a place at a time.
    pub fn steady(t: f64, place: f64, speed: f64) -> Self {
        Self {
            place: place - speed * t,
            speed,
            driven: Vec::new(),
        }
    }

    /// A course at a place at a time, with a speed that changes with shares of those of outer and inner ring.
    pub fn driven(t: f64, place: f64, speed: f64, shares: [f64; 2], scene: &Scene) -> Self {
        let of_ring = |(ring, share)| match scene.given_speed(ring)? {
            TimeFunction::Constant(_) => None,
            speed => Some(Driven {
                share,
                speed: speed.clone(),
                turned: Antiderivative::new(speed),
            }),
        };
        let shares = [RingName::Outer, RingName::Inner].into_iter().zip(shares);
        let shares = shares.filter(|(_, share)| *share != 0.0);
        let driven: Vec<Driven> = shares.filter_map(of_ring).collect();
        let (turned, following) = sum(&driven, t);
        let extra = speed - following;
        Self {
            place: place - (extra * t + turned),
            speed: extra,
            driven,
        }
    }

    /// A course in proportion to the rings' speed against each other, seen from the outer ring: as at that time, or by a given share where
    /// they then turn as one.
    pub fn geared(t: f64, place: f64, speed: f64, at_rest: f64, scene: &Scene) -> Self {
        let [outer, inner] = scene.ring_speeds(t);
        let share = if inner == outer {
            at_rest
        } else {
            (speed - outer) / (inner - outer)
        };
        Self::driven(t, place, speed, [1.0 - share, share], scene)
    }

    /// Whether the body ever leaves its place.
    pub fn moves(&self) -> bool {
        self.speed != 0.0 || !self.driven.is_empty()
    }

    /// Place and speed at a time.
    pub fn at(&self, t: f64) -> (f64, f64) {
        if self.driven.is_empty() {
            return (self.place + self.speed * t, self.speed);
        }
        let (turned, speed) = sum(&self.driven, t);
        (self.place + self.speed * t + turned, self.speed + speed)
    }

    /// Acceleration at a time.
    pub fn rate(&self, t: f64) -> f64 {
        let of = |driven: &Driven| driven.share * driven.speed.rate(t);
        self.driven.iter().map(of).sum()
    }
}

/// Sum of the additions of all courses to a place and to a speed at a time.
fn sum(driven: &[Driven], t: f64) -> (f64, f64) {
    driven.iter().fold((0.0, 0.0), |(place, speed), each| {
        let (turned, of) = each.at(t);
        (place + turned, speed + of)
    })
}

/// A degree of freedom whose motion is prescribed.
#[derive(Debug, Clone)]
pub(crate) struct Prescribed {
    pub body: BodyId,
    pub dof: Dof,
    pub course: Course,
}

/// A row whose balls turn about the axis as one, each on its own radius.
#[derive(Debug, Clone)]
pub(crate) struct Orbit {
    /// Body of its first ball.
    pub first: BodyId,
    /// Directions of the balls at the start; or their places, where radii do not change.
    pub starts: Vec<[f64; 2]>,
    /// Place of the first radius among the states, if they are: they stand where x would, their speeds where vx.
    pub at: Option<usize>,
    /// Angle from the start.
    course: Course,
}

/// How far an orbit has turned.
pub(crate) struct Turn {
    sin: f64,
    cos: f64,
    /// \[rad/s\]
    pub speed: f64,
    /// \[rad/s²\]
    rate: f64,
}

impl Turn {
    /// A direction turned.
    pub fn of(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.cos * x - self.sin * y, self.sin * x + self.cos * y]
    }
}

impl Orbit {
    /// The course from a start, a state of all bodies: as fast as the balls of the row are in the mean, and in proportion to the
    /// rings. `at` is the place of the first radius among the states, if they are.
    pub fn of(model: &Model, row: usize, t: f64, start: &[f64], at: Option<usize>) -> Self {
        let layout = model.layout();
        let balls = model.rows[row].balls();
        let starts = balls
            .map(|ball| {
                let [x, y, _] = layout.centre(start, BodyId::ball(ball));
                let square = x * x + y * y;
                let scale = if at.is_some() { square.sqrt() } else { 1.0 };
                [x / scale, y / scale]
            })
            .collect();
        let (at_rest, _) = model.rolling_shares(row);
        Self {
            first: model.rows[row].first_body(),
            starts,
            at,
            course: Course::geared(t, 0.0, model.orbit_speed(row, start), at_rest, &model.scene),
        }
    }

    /// Angle by which it has turned.
    pub fn turn(&self, t: f64) -> Turn {
        let (angle, speed) = self.course.at(t);
        let (sin, cos) = angle.sin_cos();
        Turn {
            sin,
            cos,
            speed,
            rate: self.course.rate(t),
        }
    }

    /// Writes places and speeds of its balls into a state of all bodies, from those that are kept.
    pub(super) fn place(&self, t: f64, y: &[f64], full: &mut [f64]) {
        let turn = self.turn(t);
        let (places, speeds) = halves(full);
        for (k, start) in self.starts.iter().enumerate() {
            let [r, v] = self
                .at
                .map_or([1.0, 0.0], |at| [y[at + k], y[y.len() / 2 + at + k]]);
            let [x, y] = turn.of(*start);
            let body = self.first.after(k).index();
            let w = r * turn.speed;
            set_plane(&mut places[body], [r * x, r * y]);
            set_plane(&mut speeds[body], [v * x - w * y, v * y + w * x]);
        }
    }

    /// The same for the rates.
    pub(super) fn rates(&self, t: f64, y: &[f64], rates: &[f64], full: &mut [f64]) {
        let turn = self.turn(t);
        let (places, speeds) = halves(full);
        for (k, start) in self.starts.iter().enumerate() {
            let [r, v, a] = self.at.map_or([1.0, 0.0, 0.0], |at| {
                [y[at + k], rates[at + k], rates[y.len() / 2 + at + k]]
            });
            let [x, y] = turn.of(*start);
            let body = self.first.after(k).index();
            let w = r * turn.speed;
            set_plane(&mut places[body], [v * x - w * y, v * y + w * x]);
            let (radial, along) = (a - w * turn.speed, 2.0 * v * turn.speed + r * turn.rate);
            let acceleration = [radial * x - along * y, radial * y + along * x];
            set_plane(&mut speeds[body], acceleration);
        }
    }

    /// Radii and their speeds into the kept states, from a state of all bodies.
    pub(super) fn compress(&self, full: &[f64], y: &mut [f64]) {
        let Some(at) = self.at else { return };
        let kept = y.len() / 2;
        let [places, speeds] = [0, 1].map(|half| Layout::each(&full[half * (full.len() / 2)..]));
        for k in 0..self.starts.len() {
            let body = self.first.after(k).index();
            let [x, y_] = Dof::SYMMETRIC.map(|dof| places[body][dof]);
            let [vx, vy] = Dof::SYMMETRIC.map(|dof| speeds[body][dof]);
            let r = x.hypot(y_);
            y[at + k] = r;
            y[kept + at + k] = (x * vx + y_ * vy) / r;
        }
    }
}

/// The numbers of all bodies in both halves of a state vector.
fn halves(full: &mut [f64]) -> (&mut [[f64; DOFS]], &mut [[f64; DOFS]]) {
    let (places, speeds) = full.split_at_mut(full.len() / 2);
    (Layout::each_mut(places), Layout::each_mut(speeds))
}

fn set_plane(body: &mut [f64; DOFS], [x, y]: [f64; 2]) {
    (body[Dof::X], body[Dof::Y]) = (x, y);
}
