//! Contacts in closed form, cage and steady loads in a plane, without anything else: one loop along the balls, from states
//! to rates.
//!
//! To copy them into tables and back would cost more than the forces. What this loop does not cover (a contact outside the
//! range of its form or whose damping pulls, a lost ball) is left to the tables.

mod rates;

use crate::contact::InPlane;
use crate::forces::{self, Force, State, Table, Use};
use crate::model::{BodyId, BodyKind, Dof, Model, Race, Spring};
use crate::reduction::Reduction;
use crate::scene::Drive;
use crate::simd::InstructionSet;

pub(super) use rates::Rates;

/// A model whose right-hand side is this loop.
#[derive(Debug)]
pub(super) struct Planar {
    rows: Vec<Balls>,
    /// Outer and inner ring along x and y.
    rings: [[Direction; 2]; 2],
    /// How many contacts each evaluated one stands for: two, where the second row is an image of the first.
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
    /// Force along x and y \[N\].
    steady: [f64; 2],
    mobility: f64,
    /// Forces along x and y that the link in front of a ball puts on it, and with the opposite sign on the next one \[N\]:
    /// first that of the last ball, which ends the ring, then that of the first and so on to the last.
    links: [Vec<f64>; 2],
}

/// A ring along one direction.
#[derive(Debug)]
struct Direction {
    /// Index among the states; none where it is held.
    at: Option<usize>,
    /// Place where it is held \[m\].
    place: f64,
    steady: f64,
    mobility: f64,
    spring: Option<Spring>,
}

/// Material from which a planar right-hand side is made.
pub(super) struct Ground<'a> {
    pub model: &'a Model,
    pub reduction: &'a Reduction,
    pub state: &'a State,
    /// Gravity and loads.
    pub steady: &'a Table,
    pub springs: &'a [Spring],
}

impl Planar {
    /// The right-hand side for rows whose contacts all have a closed form; none if there is more to the model.
    ///
    /// Comes with the instruction set that is to run it, whose registers hold no more balls than any row has.
    pub fn new(
        ground: &Ground<'_>,
        forms: &[(usize, [InPlane; 2])],
    ) -> Option<(InstructionSet, Self)> {
        let Ground {
            model, reduction, ..
        } = ground;
        let is_known =
            |force: &dyn Force| force.has_planar_form() || force.used(model) != Use::Evaluated;
        let is_timed = !forces::ALL.into_iter().all(is_known)
            || matches!(model.scene.drive, Drive::Torque { .. })
            || model.has_given_motions()
            || !reduction.felt().is_empty();
        let is_plane = reduction
            .degrees()
            .all(|(_, dof)| Dof::SYMMETRIC.contains(&dof))
            && reduction.orbits().next().is_none()
            && ground
                .springs
                .iter()
                .all(|spring| matches!(model.layout().kind(spring.body), BodyKind::Ring(_)));
        let are_all = forms.iter().map(|(row, _)| *row).eq(reduction.rows.clone());
        if is_timed || !is_plane || !are_all {
            return None;
        }
        let rows = forms
            .iter()
            .map(|(row, forms)| Balls::new(ground, *row, forms));
        let rows: Vec<Balls> = rows.collect::<Option<_>>()?;
        let links = rows.iter().map(|row| row.count - 1).min()?;
        let planar = Self {
            rows,
            rings: Race::BOTH
                .map(|race| Dof::SYMMETRIC.map(|dof| Direction::new(ground, race.ring(), dof))),
            times: if reduction.mirrored { 2.0 } else { 1.0 },
        };
        Some((model.instructions.filled_by(links)?, planar))
    }
}

impl Balls {
    fn new(ground: &Ground<'_>, row: usize, forms: &[InPlane; 2]) -> Option<Self> {
        let compiled = &ground.model.rows[row];
        let first = compiled.first_body();
        let at = |body: BodyId, dof: Dof| ground.reduction.place(body, dof);
        let steady = |body: BodyId, dof: Dof| ground.steady.get(body, dof);
        let (x, y) = (at(first, Dof::X)?, at(first, Dof::Y)?);
        let mobility = ground.model.mobility[first][Dof::X];
        let alike = |k: usize| {
            let body = first.after(k);
            [Dof::X, Dof::Y].map(|dof| at(body, dof)) == [Some(x + k), Some(y + k)]
                && Dof::SYMMETRIC.iter().all(|dof| {
                    steady(body, *dof) == steady(first, *dof)
                        && ground.model.mobility[body][*dof] == mobility
                })
        };
        let count = compiled.count;
        (0..count).all(alike).then(|| Self {
            row,
            count,
            at: [x, y],
            forms: forms.clone(),
            steady: Dof::SYMMETRIC.map(|dof| steady(first, dof)),
            mobility,
            links: [0, 1].map(|_| vec![0.0; count + 1]),
        })
    }
}

impl Direction {
    fn new(ground: &Ground<'_>, ring: BodyId, dof: Dof) -> Self {
        let holds = |spring: &&Spring| (spring.body, spring.dof) == (ring, dof);
        Self {
            at: ground.reduction.place(ring, dof),
            place: ground.state.q.get(ring, dof),
            steady: ground.steady.get(ring, dof),
            mobility: ground.model.mobility[ring][dof],
            spring: ground.springs.iter().find(holds).copied(),
        }
    }
}

/// Truth: the tables.
#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Dynamics;
    use crate::integrate::System;
    use crate::scene::{Cage, Friction, NormalLaw, Profile, Scene, TimeFunction, presets};
    use crate::statics::compile;
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
        let play = |s: &mut Scene| {
            let links = s.cage.as_ref().and_then(Cage::links).unwrap();
            s.cage = Some(Cage::new(links.stiffness, links.damping, 2e-6));
        };
        let balls = |count: usize| {
            with(|s| {
                s.rows[0].ball_count = count;
                s.rows[0].start_angle = 0.3;
            })
        };
        vec![
            ("Hertz", smooth(), 8),
            ("ISO", with(|s| s.contact.law = NormalLaw::iso16281()), 8),
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
            for instructions in InstructionSet::available() {
                let model = compile(&scene).unwrap().with_instructions(instructions);
                let y0 = start(&model, &Start::Equilibrium).unwrap();
                let reduction = Reduction::of(&model, &y0).unwrap();
                let mut dynamics = Dynamics::reduced(&model, reduction.clone(), &y0);
                let mut tables = Dynamics::reduced(&model, reduction, &y0);
                let super::super::Order::Kept(kept) = &mut tables.order else {
                    panic!("nothing was left out");
                };
                assert_eq!(kept.planar.take().is_some(), most > 0, "{name}");
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
                        assert!(
                            apart <= 1e-12 * largest,
                            "{name}, {instructions}: state {i}"
                        );
                    }
                }
                println!("{name}, {instructions}: {done} of 50");
                assert_eq!(done > 40, most > 0, "{name}, {instructions}");
            }
        }
    }

    #[test]
    fn what_is_not_plain_is_left_to_the_tables() {
        let scene = smooth();
        let model = compile(&scene).unwrap();
        let y0 = start(&model, &Start::Equilibrium).unwrap();
        let reduction = Reduction::of(&model, &y0).unwrap();
        let mut dynamics = Dynamics::reduced(&model, reduction, &y0);
        let y = dynamics.compress(&y0);
        let mut dy = y.clone();
        let half = y.len() / 2;
        let places = Dof::SYMMETRIC.map(|dof| {
            let of = (BodyId::ball(0), dof);
            dynamics.degrees().iter().position(|d| *d == of).unwrap()
        });
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
        assert_eq!(dynamics.lost(), Some(BodyId::ball(0)));
        dynamics.rhs(0.0, &torn, &mut dy);
        assert_eq!(dynamics.lost(), None);
        assert!(dynamics.pulls() > 0);
        dynamics.rhs(0.0, &y, &mut dy);
        assert_eq!((dynamics.lost(), dynamics.pulls()), (None, 0));
        dynamics.rhs(0.0, &nowhere, &mut dy);
        assert!(dy.iter().any(|rate| !rate.is_finite()));
    }
}
