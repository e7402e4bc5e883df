//! A cage that is a rigid ring: a body with an angle θ_c, and with a place c where its centre is free. Pocket k has the direction
//! r_k = (cos a_k, sin a_k), t_k = ẑ × r_k, a_k = θ_c + 2πk/Z + ε_k ([*Cage*](crate::equations#cage-supports-loads-drive)).
//!
//! ```text
//! e = p_b − c     lead g = e·t_k     n = ±t_k towards the wall     δ = |g| − c_p         straight walls along r_k
//! q = e − r r_k                      n = q/|q|                     δ = |q| − c_p         round pockets, where balls carry the cage
//! N = max(0, k_p δ + d_p s(δ/δ₀) δ̇)      δ̇ = (v_b − ċ)·n − θ̇_c (e × n)      s(x) = x² (3 − 2x), 1 from x = 1
//! u = (v_b − ċ)·τ + R θ̇_b − θ̇_c (e·n + R)      τ = ẑ × n      f = −μ_p N u/√(u² + v_s²)
//! ```
//!
//! On the ball −N n + f τ and the moment R f; on the cage the opposite force at c, with the moment N (e × n) − f (e·n + R). Energy k_p δ²/2,
//! power (N − k_p δ) δ̇ − f u. Pockets without clearance hold the ball from both sides: N = k_p g + d_p ġ, of either sign.
//!
//! A centre that is held is the outer ring's, which takes the forces on it. A centred one is free, on a spring and a damper to the outer
//! ring's centre, which act at c and move there with the ring:
//!
//! ```text
//! F = −k_h (c − c_r) − d_h (ċ − ċ_r − θ̇_r ẑ × (c − c_r))      on the cage; on the ring −F at c
//! ```
//!
//! A land carries a free one on a ring with its centre at c_r:
//! with h = c − c_r beyond c_g, along n = h/|h|, at the point c ± R_l n of both (outer and inner ring)
//!
//! ```text
//! N = max(0, k_l δ + d_l s(δ/δ₀) δ̇)      w = (ċ − ċ_r)·τ ± θ̇_c R_l − θ̇_r (|h| ± R_l)      f = −μ_l N w/√(w² + v_s²)
//! ```

use nalgebra::Vector3;

use super::super::{Account, Asymmetry, Damper, Force, ForceSums, Instant, RingWrench, State, Use};
use super::centre::{Centred, on_land, unbalanced};
use super::pocket::{InPocket, Turning, Wall, towards, wall};
use crate::contact::{Motion, V2, cross};
use crate::model::{BodyId, CageModel, Carried, Model, Race, RowModel};

/// All cages that are rings.
#[derive(Debug)]
pub(crate) struct CageRings;

impl Force for CageRings {
    fn name(&self) -> &'static str {
        "cage ring"
    }

    fn contribution(&self) -> &'static str {
        "cage"
    }

    fn used(&self, model: &Model) -> Use {
        Use::evaluated(model.scene.cage_ring().is_some())
    }

    fn add(&self, model: &Model, at: &Instant<'_>, sums: &mut ForceSums<'_>) {
        for (row, of) in model.rows[..at.rows].iter().enumerate() {
            if let Some(cage) = &of.cage {
                add(model, row, cage, at, sums);
            }
        }
    }

    fn account(&self, model: &Model, y: &[f64]) -> Account {
        let mut account = Account::default();
        for (at, row) in model.rows.iter().enumerate() {
            let Some(cage) = &row.cage else { continue };
            let (turning, balls) = motions(model, y, at);
            for wall in walls(row, cage, &turning, |k| balls[k]).flatten() {
                account.cage += wall.energy;
                account.power += wall.power;
            }
            let ring = |race: Race| model.layout().motion(y, race.ring());
            match &cage.carried {
                Carried::Spring(spring) => {
                    let ring = ring(Race::Outer);
                    let centred = Centred::new(spring, &turning, &ring);
                    account.cage += centred.energy;
                    account.power += centred.power;
                }
                Carried::Land(land) => {
                    let pressed = on_land(cage, land, &turning, &ring(land.race));
                    if let Some(pressed) = pressed {
                        account.cage += pressed.energy;
                        account.power += pressed.power;
                    }
                }
                Carried::Held | Carried::Balls => {}
            }
            let (u, [gx, gy, _]) = (turning.direction() * cage.unbalance, model.scene.gravity);
            account.kinetic += turning.omega * cross(u, turning.velocity);
            account.gravity -= u.dot(&V2::new(gx, gy));
        }
        account
    }

    fn dampers(&self, model: &Model) -> Vec<Damper> {
        let rows = model.rows.iter().enumerate();
        let of = |(at, row): (usize, &RowModel)| {
            let cage = row.cage.as_ref()?;
            let turning = row.count as f64 * cage.radius * cage.radius / cage.inertia;
            Some(Damper {
                name: format!("row{at}.cage"),
                body: row.first_body(),
                rate: cage.damping * (1.0 / cage.ball_mass + turning),
            })
        };
        rows.filter_map(of).collect()
    }

    fn at_start(&self, _model: &Model, _race: Race) -> RingWrench {
        RingWrench::default()
    }

    fn asymmetry(&self, _model: &Model) -> Asymmetry {
        Asymmetry::default()
    }
}

/// Forces of the cage of a row, and on it.
fn add(model: &Model, at: usize, cage: &CageModel, on: &Instant<'_>, sums: &mut ForceSums<'_>) {
    let (row, body, state) = (&model.rows[at], model.layout().cage(at), on.state);
    let centre = match cage.carried {
        Carried::Held => BodyId::OUTER,
        Carried::Spring(_) | Carried::Land(_) | Carried::Balls => body,
    };
    let turning = Turning::new(&plane(state, body), &plane(state, centre));
    let (mut force, mut moment) = (V2::zeros(), 0.0);
    let [x, y, _, _] = state.q.directions();
    let [vx, vy, _, spin] = state.v.directions();
    for k in 0..row.count {
        let ball = row.first_body().after(k);
        let i = ball.index();
        let radius = model.balls[row.first + k].side.radius;
        let of = InPocket {
            centre: V2::new(x[i], y[i]),
            velocity: V2::new(vx[i], vy[i]),
            spin: spin[i],
            radius,
        };
        let Some(pressed) = wall(cage, &turning, k, &of) else {
            continue;
        };
        let on_ball = pressed.on_body();
        let turns = radius * pressed.friction;
        sums.on.add(ball, &[on_ball.x, on_ball.y, 0.0, turns]);
        force -= on_ball;
        moment += pressed.on_cage();
    }
    let press = |sums: &mut ForceSums<'_>, race: Race, force: V2, moment: f64| {
        let about = on.frame(race).axis() * moment;
        let wrench = RingWrench {
            force: Vector3::new(force.x, force.y, 0.0) * on.times,
            moment: about * on.times,
        };
        sums.add(race, &wrench);
    };
    match &cage.carried {
        Carried::Held => {
            press(sums, Race::Outer, force, 0.0);
            force = V2::zeros();
        }
        Carried::Spring(spring) => {
            let ring = plane(state, BodyId::OUTER);
            let centred = Centred::new(spring, &turning, &ring);
            force -= centred.on_ring;
            press(sums, Race::Outer, centred.on_ring, centred.about_ring);
        }
        Carried::Land(land) => {
            let ring = plane(state, land.race.ring());
            if let Some(pressed) = on_land(cage, land, &turning, &ring) {
                let on_cage = pressed.on_body();
                let [of_cage, of_ring] = pressed.levers;
                force += on_cage;
                moment += pressed.friction * of_cage;
                press(sums, land.race, -on_cage, -pressed.friction * of_ring);
            }
        }
        Carried::Balls => {}
    }
    sums.on.add(body, &[force.x, force.y, 0.0, moment]);
    if cage.unbalance > 0.0 {
        let others = sums.on.of(body);
        let more = unbalanced(model, cage, &turning, &others);
        sums.on.add(body, &more);
    }
}

/// A body in the plane.
#[inline]
fn plane(state: &State, body: BodyId) -> Motion {
    let [x, y, z, theta] = state.q.of(body);
    let [vx, vy, vz, omega] = state.v.of(body);
    Motion::new(&[x, y, z, theta], &[vx, vy, vz, omega])
}

/// The cage of a row and its balls in a state of all bodies.
fn motions(model: &Model, y: &[f64], at: usize) -> (Turning, Vec<InPocket>) {
    let (layout, row) = (model.layout(), &model.rows[at]);
    let turning = turning(model, y, at);
    let ball = |j: usize| {
        let motion = layout.motion(y, BodyId::ball(j));
        InPocket {
            centre: motion.centre,
            velocity: motion.velocity,
            spin: motion.omega,
            radius: model.balls[j].side.radius,
        }
    };
    (turning, row.balls().map(ball).collect())
}

fn turning(model: &Model, y: &[f64], at: usize) -> Turning {
    let (layout, body) = (model.layout(), model.layout().cage(at));
    Turning::new(
        &layout.motion(y, body),
        &layout.motion(y, carrier(model, at)),
    )
}

/// The body whose centre is that of a row's cage.
pub(crate) fn carrier(model: &Model, row: usize) -> BodyId {
    match model.rows[row].cage.as_ref().map(|cage| cage.carried) {
        Some(Carried::Held) | None => BodyId::OUTER,
        Some(Carried::Spring(_) | Carried::Land(_) | Carried::Balls) => model.layout().cage(row),
    }
}

fn walls<'a>(
    row: &RowModel,
    cage: &'a CageModel,
    turning: &'a Turning,
    ball: impl Fn(usize) -> InPocket + 'a,
) -> impl Iterator<Item = Option<Wall>> + 'a {
    (0..row.count).map(move |k| wall(cage, turning, k, &ball(k)))
}

/// Forces of the pockets' walls on the balls of a row, positive on a ball that leads \[N\]; empty without a ring.
pub(crate) fn pocket_forces(model: &Model, y: &[f64], at: usize) -> Vec<f64> {
    let row = &model.rows[at];
    let Some(cage) = &row.cage else {
        return Vec::new();
    };
    let (turning, balls) = motions(model, y, at);
    let force = |(k, wall): (usize, Option<Wall>)| {
        wall.map_or(0.0, |wall| {
            let leads = cross(towards(cage, &turning, k), wall.normal) >= 0.0;
            if leads { wall.force } else { -wall.force }
        })
    };
    walls(row, cage, &turning, |k| balls[k])
        .enumerate()
        .map(force)
        .collect()
}

/// A ball that is no longer in its pocket, by its number among all balls, of the first rows, whose balls move: beside it by more than its
/// radius, or on the other side of the axis.
pub(crate) fn out_of_pocket(model: &Model, state: &State, rows: usize) -> Option<usize> {
    for (at, row) in model.rows[..rows].iter().enumerate() {
        let Some(cage) = &row.cage else { continue };
        let centre = plane(state, carrier(model, at));
        let turning = Turning::new(&plane(state, model.layout().cage(at)), &centre);
        let [x, y, ..] = state.q.directions();
        for (k, j) in row.balls().enumerate() {
            let i = BodyId::ball(j).index();
            let e = V2::new(x[i], y[i]) - turning.centre;
            let r = towards(cage, &turning, k);
            let (lead, distance) = (cross(r, e), r.dot(&e));
            // Numbers that are none are out.
            let is_in = lead.abs() <= model.balls[j].side.radius && distance >= 0.0;
            if !is_in {
                return Some(j);
            }
        }
    }
    None
}
