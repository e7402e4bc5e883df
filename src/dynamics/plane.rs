//! Nothing but contacts in closed form, cage and steady loads in a plane: one loop along the balls, straight from
//! states to rates.
//!
//! To put them into tables and back would cost more than the forces. What this loop does not know — a contact out of
//! the reach of its form or whose damping pulls, a lost ball — is left to those.

// Everything here must be compiled for the instructions of its caller.
#![allow(clippy::inline_always)]

use super::others::pull;
use super::state::{State, Table};
use crate::contact::{InPlane, LevelBalls, LevelRace, Motion, Pair, V2};
use crate::model::{Model, Reduction, Spring};
use crate::scene::{Cage, Drive, TimeFunction};
use crate::simd::{Level, Simd, Vector, Wide};

/// A model of this kind.
#[derive(Debug)]
pub(super) struct Plane {
    rows: Vec<Balls>,
    /// Outer and inner ring along x and y.
    rings: [[Direction; 2]; 2],
    /// How many contacts one stands for.
    times: f64,
}

/// Balls of a row, all alike.
#[derive(Debug)]
struct Balls {
    row: usize,
    count: usize,
    /// Places of the first ball's x and y among the states.
    at: [usize; 2],
    forms: [InPlane; 2],
    /// Along x and y \[N\].
    steady: [f64; 2],
    mobility: f64,
    /// Along x and y what the link in front of a ball puts on it, and with the opposite sign on the next one \[N\]:
    /// first that of the last ball, which ends the ring, then that of the first and so on to the last.
    links: [Vec<f64>; 2],
}

/// A ring along one direction.
#[derive(Debug)]
struct Direction {
    /// Among the states; none where it is held.
    at: Option<usize>,
    /// Where it is held \[m\].
    place: f64,
    steady: f64,
    mobility: f64,
    spring: Option<Spring>,
}

/// What a plane stands on.
pub(super) struct Ground<'a> {
    pub model: &'a Model,
    pub reduction: &'a Reduction,
    pub state: &'a State,
    /// Gravity and loads.
    pub steady: &'a Table,
    pub springs: &'a [Spring],
}

impl Plane {
    /// For rows whose contacts all have a closed form; none if there is more to the model.
    ///
    /// Comes with the level that is to run it: its registers reach over the end of no row.
    pub fn new(ground: &Ground<'_>, forms: &[(usize, [InPlane; 2])]) -> Option<(Level, Self)> {
        let Ground {
            model, reduction, ..
        } = ground;
        let varies = |force: &TimeFunction| !matches!(force, TimeFunction::Constant(_));
        let is_timed = model.loads.iter().any(|load| varies(&load.force))
            || !model.unbalances.is_empty()
            || matches!(model.scene.drive, Drive::Torque { .. })
            || !reduction.felt().is_empty();
        let is_plane = reduction.degrees().all(|(_, direction)| direction < 2)
            && reduction.orbits().next().is_none()
            && ground.springs.iter().all(|spring| spring.body < 2);
        let are_all = forms.iter().map(|(row, _)| *row).eq(reduction.rows.clone());
        if is_timed || !is_plane || !are_all {
            return None;
        }
        let rows = forms
            .iter()
            .map(|(row, forms)| Balls::new(ground, *row, forms));
        let rows: Vec<Balls> = rows.collect::<Option<_>>()?;
        let links = rows.iter().map(|row| row.count - 1).min()?;
        let plane = Self {
            rows,
            rings: [0, 1]
                .map(|ring| [0, 1].map(|direction| Direction::new(ground, ring, direction))),
            times: if reduction.mirrored { 2.0 } else { 1.0 },
        };
        Some((model.level.filled_by(links)?, plane))
    }
}

impl Balls {
    fn new(ground: &Ground<'_>, row: usize, forms: &[InPlane; 2]) -> Option<Self> {
        let compiled = &ground.model.rows[row];
        let first = 2 + compiled.first;
        let at = |body: usize, direction: usize| ground.reduction.place(body, direction);
        let of = |body: usize, direction: usize| {
            let mobility = ground.model.mobility[body][direction];
            (ground.steady.get(body, direction), mobility)
        };
        let (x, y) = (at(first, 0)?, at(first, 1)?);
        let alike = |k: usize| {
            at(first + k, 0) == Some(x + k)
                && at(first + k, 1) == Some(y + k)
                && of(first + k, 0) == of(first, 0)
                && of(first + k, 1) == (of(first, 1).0, of(first, 0).1)
        };
        let count = compiled.count;
        (0..count).all(alike).then(|| Self {
            row,
            count,
            at: [x, y],
            forms: forms.clone(),
            steady: [0, 1].map(|direction| of(first, direction).0),
            mobility: of(first, 0).1,
            links: [0, 1].map(|_| vec![0.0; count + 1]),
        })
    }
}

impl Direction {
    fn new(ground: &Ground<'_>, ring: usize, direction: usize) -> Self {
        let holds = |spring: &&Spring| (spring.body, spring.direction) == (ring, direction);
        Self {
            at: ground.reduction.place(ring, direction),
            place: ground.state.q.get(ring, direction),
            steady: ground.steady.get(ring, direction),
            mobility: ground.model.mobility[ring][direction],
            spring: ground.springs.iter().find(holds).copied(),
        }
    }

    /// Place and speed.
    #[inline(always)]
    fn of(&self, q: &[f64], v: &[f64]) -> (f64, f64) {
        self.at.map_or((self.place, 0.0), |at| (q[at], v[at]))
    }
}

/// Rates of a state; false where they are left to others.
pub(super) struct Rates<'a> {
    pub plane: &'a mut Plane,
    pub model: &'a Model,
    pub y: &'a [f64],
    pub dy: &'a mut [f64],
}

impl Wide for Rates<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let Self {
            plane,
            model,
            y,
            dy,
        } = self;
        let (q, v) = y.split_at(y.len() / 2);
        let (rates, accelerations) = dy.split_at_mut(q.len());
        rates.copy_from_slice(v);
        let rings = [plane.motion(0, q, v), plane.motion(1, q, v)];
        let mut on_rings = [[0.0; 2]; 2];
        for row in &mut plane.rows {
            let compiled = &model.rows[row.row];
            if let Some(cage) = &model.scene.cage {
                row.link(simd, (cage, compiled.cage_distance), q, v);
            }
            let contacts = (&compiled.pairs, &rings);
            let states = (q, v, &mut *accelerations);
            let plain = if row.forms.iter().all(InPlane::is_middle) {
                row.press::<S, true>(simd, contacts, states, &mut on_rings)
            } else {
                row.press::<S, false>(simd, contacts, states, &mut on_rings)
            };
            if !plain {
                return false;
            }
        }
        for (ring, forces) in plane.rings.iter().zip(on_rings) {
            for (direction, force) in ring.iter().zip(forces) {
                direction.accelerate(plane.times * force, (q, v, accelerations));
            }
        }
        true
    }
}

impl Plane {
    #[inline(always)]
    fn motion(&self, ring: usize, q: &[f64], v: &[f64]) -> Motion {
        let [(x, vx), (y, vy)] = [self.rings[ring][0].of(q, v), self.rings[ring][1].of(q, v)];
        Motion {
            centre: V2::new(x, y),
            velocity: V2::new(vx, vy),
            z: 0.0,
            theta: 0.0,
            vz: 0.0,
            omega: 0.0,
        }
    }
}

impl Direction {
    /// Writes what a force of contacts, the spring and steady forces add up to.
    #[inline(always)]
    fn accelerate(&self, force: f64, (q, v, to): (&[f64], &[f64], &mut [f64])) {
        let Some(at) = self.at else { return };
        let spring = self.spring.map_or(0.0, |spring| {
            spring.stiffness * (q[at] - spring.nominal) + spring.damping * v[at]
        });
        to[at] = (force + self.steady - spring) * self.mobility;
    }
}

impl Balls {
    /// Balls along x or y.
    #[inline(always)]
    fn of<'a>(&self, direction: usize, of: &'a [f64]) -> &'a [f64] {
        &of[self.at[direction]..][..self.count]
    }

    /// The cage.
    #[inline(always)]
    fn link<S: Simd>(&mut self, simd: S, cage: (&Cage, f64), q: &[f64], v: &[f64]) {
        let all = |x: f64| Vector::all(simd, x);
        let of = [self.of(0, q), self.of(1, q), self.of(0, v), self.of(1, v)];
        let last = self.count - 1;
        let mut apart = [all(0.0); 4];
        for (apart, of) in apart.iter_mut().zip(of) {
            *apart = all(of[0] - of[last]);
        }
        let closing = pull(cage, apart);
        for (links, closing) in self.links.iter_mut().zip(closing) {
            (links[0], links[last + 1]) = (closing.first(), closing.first());
        }
        for (at, _) in Vector::<S>::cover(last) {
            for (apart, of) in apart.iter_mut().zip(of) {
                *apart = Vector::load(simd, &of[at + 1..]) - Vector::load(simd, &of[at..]);
            }
            for (links, pull) in self.links.iter_mut().zip(pull(cage, apart)) {
                pull.store(&mut links[at + 1..]);
            }
        }
    }

    /// The contacts, and what all forces on the balls do; false where a contact is not plain.
    #[inline(always)]
    fn press<S: Simd, const MIDDLE: bool>(
        &self,
        simd: S,
        (pairs, rings): (&[Pair; 2], &[Motion; 2]),
        (q, v, to): (&[f64], &[f64], &mut [f64]),
        on_rings: &mut [[f64; 2]; 2],
    ) -> bool {
        let all = |x: f64| Vector::all(simd, x);
        let (zero, mobility) = (all(0.0), all(self.mobility));
        let steady = [all(self.steady[0]), all(self.steady[1])];
        let n = self.count;
        let races = [
            LevelRace::new(simd, &pairs[0], &self.forms[0], &rings[0]),
            LevelRace::new(simd, &pairs[1], &self.forms[1], &rings[1]),
        ];
        let [x, y, vx, vy] = [self.of(0, q), self.of(1, q), self.of(0, v), self.of(1, v)];
        let [ahead, behind] = [1, 0].map(|from| self.links.each_ref().map(|of| &of[from..][..n]));
        let mut sums = [[zero; 2]; 2];
        for (at, again) in Vector::<S>::cover(n) {
            let balls = LevelBalls {
                x: Vector::load(simd, &x[at..]),
                y: Vector::load(simd, &y[at..]),
                vx: Vector::load(simd, &vx[at..]),
                vy: Vector::load(simd, &vy[at..]),
                raise: zero,
                whole: None,
            };
            let outer = races[0].press::<MIDDLE>(&balls);
            let inner = races[1].press::<MIDDLE>(&balls);
            let odd = [outer, inner].map(|of| of.careful.or(of.pulls));
            if odd[0].or(odd[1]).any() {
                return false;
            }
            let forces = [outer.x + inner.x, outer.y + inner.y];
            for (i, force) in forces.into_iter().enumerate() {
                let [ahead, behind] = [ahead[i], behind[i]].map(|of| Vector::load(simd, &of[at..]));
                let force = force + (ahead - behind) + steady[i];
                (force * mobility).store(&mut to[self.at[i]..][..n][at..]);
            }
            for (sums, mut found) in sums.iter_mut().zip([outer, inner]) {
                if again > 0 {
                    let new = all(again as f64 - 0.5).below(Vector::count(simd));
                    (found.x, found.y) = (new.choose(found.x, zero), new.choose(found.y, zero));
                }
                sums[0] += found.x;
                sums[1] += found.y;
            }
        }
        for (on_ring, [x, y]) in on_rings.iter_mut().zip(sums) {
            on_ring[0] -= x.sum();
            on_ring[1] -= y.sum();
        }
        true
    }
}

/// The truth is what the tables tell.
#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Dynamics;
    use crate::integrate::System;
    use crate::scene::{Friction, NormalLaw, Profile, Scene, presets};
    use crate::{Start, start};

    fn smooth() -> Scene {
        let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        scene.friction = Friction::None;
        scene
    }

    fn with(change: impl Fn(&mut Scene)) -> Scene {
        let mut scene = smooth();
        change(&mut scene);
        scene
    }

    fn two_rows() -> Scene {
        let mut scene = presets::wheel_bearing(0.0);
        scene.defects.clear();
        scene.friction = Friction::None;
        let angle = scene.rows[0].start_angle;
        for row in &mut scene.rows {
            (row.contact_angle, row.start_angle) = (0.0, angle);
        }
        scene
    }

    /// Scenes by name, and how many balls a register may hold at most.
    fn scenes() -> Vec<(&'static str, Scene, usize)> {
        let play = |s: &mut Scene| s.cage.as_mut().unwrap().play = 2e-6;
        let balls = |count: usize| {
            with(|s| {
                s.rows[0].ball_count = count;
                s.rows[0].start_angle = 0.3;
            })
        };
        vec![
            ("Hertz", smooth(), 8),
            ("ISO", with(|s| s.contact.law = NormalLaw::default()), 8),
            ("no cage", with(|s| s.cage = None), 8),
            ("a cage with play", with(play), 8),
            ("eight balls", balls(8), 4),
            ("five balls", balls(5), 4),
            ("four balls", balls(4), 0),
            ("two rows for one", two_rows(), 8),
            (
                "two rows",
                {
                    let mut scene = two_rows();
                    scene.rows[1].start_angle += 0.1;
                    scene.approximations.plane = true;
                    scene
                },
                8,
            ),
            ("friction", presets::deep_groove_6205(500.0, 0.0, 1800.0), 0),
            (
                "thrust",
                with(|s| s.loads.get_mut("axial").unwrap().force = 10.0.into()),
                0,
            ),
            (
                "a load that changes",
                with(|s| {
                    let sine = Profile::Sine {
                        mean: 500.0,
                        amplitude: 10.0,
                        frequency: 50.0,
                        phase: 0.0,
                    };
                    s.loads.get_mut("radial").unwrap().force = TimeFunction::Profile(sine);
                }),
                0,
            ),
        ]
    }

    #[test]
    fn the_loop_and_the_tables_agree() {
        for (name, scene, most) in scenes() {
            for level in Level::available() {
                let model = Model::new(&scene).unwrap().with_level(level);
                let y0 = start(&model, &Start::Equilibrium).unwrap();
                let reduction = model.reduction(&y0).unwrap();
                let mut dynamics = Dynamics::reduced(&model, reduction.clone(), &y0);
                let mut tables = Dynamics::reduced(&model, reduction, &y0);
                let super::super::Order::Kept(kept) = &mut tables.order else {
                    panic!("nothing was left out");
                };
                assert_eq!(kept.plane.take().is_some(), most > 0, "{name}");
                let y = dynamics.compress(&y0);
                let [mut by_loop, mut by_tables] = [vec![f64::NAN; y.len()], y.clone()];
                let mut done = 0;
                for k in 0..50 {
                    // Micrometres and mm/s, different for each.
                    let noise = |i: usize| ((i * i + 7 * k) as f64).sin();
                    let half = y.len() / 2;
                    let scale = |i: usize| if i < half { 2e-6 } else { 2e-3 };
                    let shaken: Vec<f64> =
                        (0..y.len()).map(|i| y[i] + scale(i) * noise(i)).collect();
                    if !dynamics.in_plane(&shaken, &mut by_loop) {
                        continue;
                    }
                    done += 1;
                    tables.rhs(0.0, &shaken, &mut by_tables);
                    let largest = by_tables[half..]
                        .iter()
                        .fold(0.0, |a: f64, b| a.max(b.abs()));
                    for i in 0..y.len() {
                        let apart = (by_loop[i] - by_tables[i]).abs();
                        assert!(apart <= 1e-12 * largest, "{name}, {level}: state {i}");
                    }
                }
                println!("{name}, {level}: {done} of 50");
                assert_eq!(done > 40, most > 0, "{name}, {level}");
            }
        }
    }

    #[test]
    fn what_is_not_plain_is_left_to_the_tables() {
        let scene = smooth();
        let model = Model::new(&scene).unwrap();
        let y0 = start(&model, &Start::Equilibrium).unwrap();
        let reduction = model.reduction(&y0).unwrap();
        let mut dynamics = Dynamics::reduced(&model, reduction, &y0);
        let y = dynamics.compress(&y0);
        let mut dy = y.clone();
        let half = y.len() / 2;
        let at = |direction: usize| {
            let of = (2, direction);
            dynamics.degrees().iter().position(|d| *d == of).unwrap()
        };
        let places = [at(0), at(1)];
        let out = places.map(|i| y[i] / y[places[0]].hypot(y[places[1]]));
        // The first ball into the outer race, and away from there at 100 m/s.
        let [mut pressed, mut torn, mut nowhere] = [0; 3].map(|_| y.clone());
        for (i, out) in places.into_iter().zip(out) {
            pressed[i] += 4e-3 * out;
            torn[i] += 5e-6 * out;
            torn[half + i] = -100.0 * out;
            nowhere[i] = f64::NAN;
        }
        dynamics.rhs(0.0, &y, &mut dy);
        assert_eq!((dynamics.lost(), dynamics.pulls()), (None, 0));
        dynamics.rhs(0.0, &pressed, &mut dy);
        assert_eq!(dynamics.lost(), Some(2));
        dynamics.rhs(0.0, &torn, &mut dy);
        assert_eq!(dynamics.lost(), None);
        assert!(dynamics.pulls() > 0);
        dynamics.rhs(0.0, &y, &mut dy);
        assert_eq!((dynamics.lost(), dynamics.pulls()), (None, 0));
        dynamics.rhs(0.0, &nowhere, &mut dy);
        assert!(dy.iter().any(|rate| !rate.is_finite()));
    }
}
