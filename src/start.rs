//! How a run begins: at rest in the cage's frame, or rolling from nominal places (model sections 8 and 13.5).

use crate::contact::attitude_rates;
use crate::equilibrium;
use crate::error::{Error, Result};
use crate::inspect;
use crate::inspect::ContactSummary;
use crate::model::{Between, BodyId, Dof, Layout, Model, Race, Rolling};

/// How far Euler parameters of a given state may be from length one: they are brought there. Those that are further off are a slip.
const LENGTH: f64 = 5e-3;

/// How a run begins.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub enum Start {
    /// Static equilibrium in the cage's frame, then rolling speeds at the operating contact angles: next to
    /// no transient.
    #[default]
    Equilibrium,
    /// The paper's: nominal places, pure-rolling speeds; a transient of about 0.02 s.
    Rolling,
    /// A given state, as long as [`Model::dim`].
    State(Vec<f64>),
}

/// The state at t = 0.
///
/// # Errors
/// [`Error::Equilibrium`] if the load cannot be carried; [`Error::Scene`] for a state of wrong length or
/// with a number that is not finite.
pub fn start(model: &Model, start: &Start) -> Result<Vec<f64>> {
    match start {
        Start::Rolling => {
            let mut y = vec![0.0; model.dim()];
            for (place, body) in Layout::each_mut(&mut y).iter_mut().zip(&model.bodies) {
                *place = body.nominal;
            }
            lean(model, &mut y);
            roll(model, &mut y);
            hold(model, &mut y);
            face(model, &mut y);
            Ok(y)
        }
        Start::Equilibrium => {
            let mut y = equilibrium::positions(model)?;
            roll(model, &mut y);
            settle_speeds(model, &mut y);
            hold(model, &mut y);
            face(model, &mut y);
            Ok(y)
        }
        Start::State(state) => {
            check_length(state.len(), model.dim())?;
            match state.iter().position(|x| !x.is_finite()) {
                Some(i) => Err(Error::scene(
                    format!("start[{i}]"),
                    state[i],
                    "a finite number",
                )),
                None => given(model, state),
            }
        }
    }
}

/// A state of the right length, with attitudes that are some and that change as the balls turn.
fn given(model: &Model, state: &[f64]) -> Result<Vec<f64>> {
    let (mut y, layout) = (state.to_vec(), model.layout());
    for ball in layout.tumbling().map(BodyId::ball) {
        let attitude = Dof::ATTITUDE.map(|dof| y[layout.at(ball, dof)]);
        let length = attitude.iter().map(|e| e * e).sum::<f64>().sqrt();
        if (length - 1.0).abs() > LENGTH {
            return Err(Error::scene(
                format!("start[{}]", layout.at(ball, Dof::E0)),
                format!("{attitude:?}"),
                "Euler parameters, the four of a ball: their squares add up to 1, within 1 %",
            ));
        }
        turn(layout, &mut y, ball, attitude.map(|e| e / length));
    }
    Ok(y)
}

/// Gives balls that tumble the attitude that their angle about z says.
pub(crate) fn face(model: &Model, y: &mut [f64]) {
    let layout = model.layout();
    for ball in layout.tumbling().map(BodyId::ball) {
        let (sin, cos) = (0.5 * y[layout.at(ball, Dof::Theta)]).sin_cos();
        turn(layout, y, ball, [cos, 0.0, 0.0, sin]);
    }
}

/// Gives a ball an attitude, which changes with its angular velocity: ė = ½ ω e.
fn turn(layout: Layout, y: &mut [f64], ball: BodyId, attitude: [f64; 4]) {
    let rates = attitude_rates(&layout.motion(y, ball).turning(), attitude);
    let each = Dof::ATTITUDE
        .into_iter()
        .zip(attitude.into_iter().zip(rates));
    for (dof, (place, rate)) in each {
        (y[layout.at(ball, dof)], y[layout.speed_at(ball, dof)]) = (place, rate);
    }
}

/// Stops balls where they are held.
fn hold(model: &Model, y: &mut [f64]) {
    let layout = model.layout();
    let moving = layout
        .degrees()
        .filter(|(body, _)| body.as_ball().is_some());
    for (ball, dof) in moving {
        let held = match dof {
            Dof::TurnX | Dof::TurnY => Dof::Theta,
            dof if Dof::ATTITUDE.contains(&dof) => continue,
            dof => dof,
        };
        if model.mobility[ball][held] == 0.0 {
            y[layout.speed_at(ball, dof)] = 0.0;
        }
    }
}

/// Lets rings lean as far as they nominally do.
fn lean(model: &Model, y: &mut [f64]) {
    let layout = model.layout();
    for race in Race::BOTH {
        for (dof, tilt) in Dof::TILTS.into_iter().zip(model.rings[race].tilt) {
            if layout.has(race.ring(), dof) {
                y[layout.at(race.ring(), dof)] = tilt;
            }
        }
    }
}

/// Refuses a state that is not as long as a model's.
///
/// # Errors
/// [`Error::Scene`] names the lengths.
pub fn check_length(length: usize, dim: usize) -> Result<()> {
    if length == dim {
        return Ok(());
    }
    Err(Error::scene(
        "start",
        format!("{length} numbers"),
        format!("{dim} numbers, named by the model"),
    ))
}

/// Sets pure-rolling speeds at the places of a state.
fn roll(model: &Model, y: &mut [f64]) {
    let layout = model.layout();
    y[layout.speed_at(BodyId::INNER, Dof::Theta)] = model.scene.drive.initial_speed();
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
                speed: model.scene.drive.initial_speed(),
            };
            set_spin(layout, y, BodyId::ball(j), &between.resisted([1.0; 2]));
        }
    }
}

/// Lets a ball spin freely.
fn set_spin(layout: Layout, y: &mut [f64], ball: BodyId, rolling: &Rolling) {
    let [x, y_, _] = layout.centre(y, ball);
    let outward = rolling.outward / x.hypot(y_);
    y[layout.speed_at(ball, Dof::Theta)] = rolling.axial;
    y[layout.speed_at(ball, Dof::TurnX)] = outward * x;
    y[layout.speed_at(ball, Dof::TurnY)] = outward * y_;
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
/// With levers ρ = R cos α of the two contacts and a ball at radius r, no slip on the fixed outer race means
/// θ̇ = −ω_c r/ρ_o, on the inner θ̇ = (ω_c r − Ω(r − ρ_i))/ρ_i; both hold for ω_c r (1 + ρ_i/ρ_o) = Ω(r − ρ_i).
/// The nominal angle would leave a thrust-loaded bearing to find its speeds by friction.
fn settle_speeds(model: &Model, y: &mut [f64]) {
    if model.balls_turn() {
        return settle_free(model, y);
    }
    let layout = model.layout();
    let speed = model.scene.drive.initial_speed();
    for row in 0..model.rows.len() {
        let mut rolling = Vec::new();
        let (mut weighted, mut weight) = (0.0, 0.0);
        for j in model.rows[row].balls() {
            let contacts = Race::BOTH.map(|race| inspect::contact(model, y, j, race));
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
            model.rolling_speeds(row).0
        };
        for (j, r, [outer, inner], [on_outer, on_inner]) in rolling {
            set_orbit(layout, y, BodyId::ball(j), orbit);
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
                y[layout.speed_at(BodyId::ball(j), Dof::Theta)] = sum / load;
            }
        }
    }
}

/// The same of balls that spin freely: each as its contacts ask that resist pivoting like Q a², all of a row with one orbit speed.
fn settle_free(model: &Model, y: &mut [f64]) {
    let layout = model.layout();
    for row in &model.rows {
        let balls = row.balls().map(|j| (j, between_races(model, y, j)));
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
            set_spin(layout, y, BodyId::ball(j), &rolling);
        }
    }
}

/// How a ball that spins freely rolls, and the smaller of its loads \[N\]; none where it is loose.
fn between_races(model: &Model, y: &[f64], j: usize) -> Option<(f64, Rolling)> {
    let contacts = Race::BOTH.map(|race| inspect::contact(model, y, j, race));
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
        speed: model.scene.drive.initial_speed(),
    };
    let resistances = contacts.map(|contact| resistance(&contact));
    Some((load, between.resisted(resistances)))
}

/// How a contact resists pivoting, but for a factor: load times the square of the half-length of its zone \[N m²\].
fn resistance(contact: &ContactSummary) -> f64 {
    let half = 0.5 * contact.zone_width / contact.angle.cos();
    contact.load * half * half
}
