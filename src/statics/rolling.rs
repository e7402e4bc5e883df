//! The speeds of balls that roll where they stand: nominally, or at the contact angles of a state ([*How a run
//! begins*](crate::equations#how-a-run-begins-and-how-it-goes-on) and [*Rings that
//! tilt*](crate::equations#rings-that-tilt-balls-that-spin-freely)).

use crate::contact::V2;
use crate::inspect;
use crate::inspect::ContactSummary;
use crate::model::{Between, BodyId, Dof, Layout, Model, PureRolling, Race};

/// Control of the axis about which a ball spins that spins freely, and so of how fast its row goes round.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum RaceControl {
    /// Friction at both races, as a run has it.
    #[default]
    Friction,
    /// The outer race, on which the ball does not pivot: Jones' hypothesis, an idealisation of fast bearings.
    Outer,
}

impl RaceControl {
    /// The same on a model: where balls do not spin freely there is nothing to control.
    pub(crate) fn on(self, model: &Model) -> Self {
        if model.balls_turn() {
            self
        } else {
            Self::Friction
        }
    }
}

/// Sets the speeds at which the balls roll at the contact angles of a state; those of nominal angles where a row carries nothing.
pub(crate) fn at_contacts(model: &Model, control: RaceControl, y: &mut [f64]) {
    nominally(model, y);
    roll_at_contacts(model, control, y);
}

/// Sets pure-rolling speeds at the places of a state.
pub(crate) fn nominally(model: &Model, y: &mut [f64]) {
    let layout = model.layout();
    let [outer, inner] = model.scene.ring_speeds(0.0);
    for (race, speed) in Race::BOTH.into_iter().zip([outer, inner]) {
        y[layout.speed_at(race.ring(), Dof::Theta)] = speed;
    }
    for (j, ball) in model.balls.iter().enumerate() {
        let (orbit, spin) = model.rolling_speeds(ball.row);
        set_orbit(layout, y, BodyId::ball(j), orbit);
        y[layout.speed_at(BodyId::ball(j), Dof::Theta)] = spin;
        if model.balls_turn() {
            let row = &model.scene.rows[ball.row];
            let angle = row.contact_angle * f64::from(row.side);
            let between = Between {
                radius: row.ball_diameter / 2.0,
                distance: row.pitch_diameter / 2.0,
                angles: [angle; 2],
                speed: inner - outer,
            };
            let rolling = between.resisted([1.0; 2]).turned_by(outer);
            set_turning(
                model,
                y,
                BodyId::ball(j),
                [rolling.axial, rolling.outward, 0.0],
            );
        }
    }
}

/// Lets a ball turn, about z, outwards and along its orbit \[rad/s\].
pub(super) fn set_turning(
    model: &Model,
    y: &mut [f64],
    ball: BodyId,
    [axial, outward, along]: [f64; 3],
) {
    let layout = model.layout();
    y[layout.speed_at(ball, Dof::Theta)] = axial;
    if model.balls_turn() {
        let [x, y_, _] = layout.centre(y, ball);
        let n = V2::new(x, y_).normalize();
        y[layout.speed_at(ball, Dof::TurnX)] = outward * n.x - along * n.y;
        y[layout.speed_at(ball, Dof::TurnY)] = outward * n.y + along * n.x;
    }
}

/// Lets a ball turn about the axis.
fn set_orbit(layout: Layout, y: &mut [f64], ball: BodyId, orbit: f64) {
    let [x, y_, _] = layout.centre(y, ball);
    y[layout.speed_at(ball, Dof::X)] = -orbit * y_;
    y[layout.speed_at(ball, Dof::Y)] = orbit * x;
}

/// Corrects the speeds of loaded balls for their operating contact angles: a row orbits at the load-weighted
/// mean of the rates at which its balls would roll on both races, and each ball spins as its contacts ask.
///
/// With levers ρ = R cos α of the two contacts and a ball at radius r, seen from the outer ring, no slip on the outer race means
/// θ̇ = −ω_c r/ρ_o, on the inner θ̇ = (ω_c r − Ω(r − ρ_i))/ρ_i; both hold for ω_c r (1 + ρ_i/ρ_o) = Ω(r − ρ_i).
/// The nominal angle would leave a thrust-loaded bearing to find its speeds by friction.
fn roll_at_contacts(model: &Model, control: RaceControl, y: &mut [f64]) {
    if model.balls_turn() {
        return roll_freely(model, control, y);
    }
    let layout = model.layout();
    let [turned, inner] = model.scene.ring_speeds(0.0);
    let speed = inner - turned;
    for row in 0..model.rows.len() {
        let mut rolling = Vec::new();
        let (mut weighted, mut weight) = (0.0, 0.0);
        for j in model.rows[row].balls() {
            let contacts = Race::BOTH.map(|race| inspect::raw::contact(model, y, j, race));
            let load = contacts[0].load.min(contacts[1].load);
            let [x, y_, _] = layout.centre(y, BodyId::ball(j));
            let r = x.hypot(y_);
            let levers = contacts
                .map(|c| (c.load > 0.0).then(|| model.balls[j].side.radius * c.angle.cos()));
            if let [Some(outer), Some(inner)] = levers {
                weighted += load * speed * (r - inner) / (r * (1.0 + inner / outer));
                weight += load;
            }
            rolling.push((j, r, levers, contacts.map(|c| c.load)));
        }
        let orbit = if weight > 0.0 {
            weighted / weight
        } else {
            speed * model.rolling_shares(row).0
        };
        for (j, r, [outer, inner], [on_outer, on_inner]) in rolling {
            set_orbit(layout, y, BodyId::ball(j), orbit + turned);
            let spins = [
                outer.map(|lever| (-orbit * r / lever, on_outer)),
                inner.map(|lever| ((orbit * r - speed * (r - lever)) / lever, on_inner)),
            ];
            let (sum, load) = spins
                .into_iter()
                .flatten()
                .fold((0.0, 0.0), |(sum, all), (spin, load)| {
                    (sum + spin * load, all + load)
                });
            if load > 0.0 {
                y[layout.speed_at(BodyId::ball(j), Dof::Theta)] = sum / load + turned;
            }
        }
    }
}

/// The same of balls that spin freely: each as its contacts ask that resist pivoting like Q a², all of a row with one orbit speed.
fn roll_freely(model: &Model, control: RaceControl, y: &mut [f64]) {
    let layout = model.layout();
    for row in &model.rows {
        let balls = row
            .balls()
            .map(|j| (j, between_races(model, control, y, j)));
        let found: Vec<_> = balls.filter_map(|(j, found)| Some((j, found?))).collect();
        let weight: f64 = found.iter().map(|(_, (load, _))| load).sum();
        if weight == 0.0 {
            continue;
        }
        let weighted = found.iter().map(|(_, (load, of))| load * of.orbit);
        let orbit = weighted.sum::<f64>() / weight;
        for j in row.balls() {
            set_orbit(layout, y, BodyId::ball(j), orbit);
        }
        for (j, (_, rolling)) in found {
            set_turning(
                model,
                y,
                BodyId::ball(j),
                [rolling.axial, rolling.outward, 0.0],
            );
        }
    }
}

/// How a ball that spins freely rolls, and the smaller of its loads \[N\]; none where it is loose.
fn between_races(
    model: &Model,
    control: RaceControl,
    y: &[f64],
    j: usize,
) -> Option<(f64, PureRolling)> {
    let contacts = Race::BOTH.map(|race| inspect::raw::contact(model, y, j, race));
    let load = contacts[0].load.min(contacts[1].load);
    if load == 0.0 {
        return None;
    }
    let [x, y_, _] = model.layout().centre(y, BodyId::ball(j));
    let side = model.rows[model.balls[j].row].side;
    let between = Between {
        radius: model.balls[j].side.radius,
        distance: x.hypot(y_),
        angles: contacts.map(|contact| contact.angle * side),
        speed: model.scene.relative_speed(0.0),
    };
    let rolling = match control {
        RaceControl::Friction => between.resisted(contacts.map(|contact| resistance(&contact))),
        RaceControl::Outer => between.controlled_by(Race::Outer),
    };
    Some((
        load,
        rolling.turned_by(model.scene.ring_speeds(0.0)[Race::Outer]),
    ))
}

/// How a contact resists pivoting, but for a factor: load times the square of the half-length of its zone \[N m²\].
fn resistance(contact: &ContactSummary) -> f64 {
    let half = 0.5 * contact.zone_width / contact.angle.cos();
    contact.load * half * half
}
