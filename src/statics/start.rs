//! How a run begins: at rest in the cage's frame, or rolling from nominal places ([*How a run
//! begins*](crate::equations#how-a-run-begins-and-how-it-goes-on) and [*Rings that
//! tilt*](crate::equations#rings-that-tilt-balls-that-spin-freely)).

use crate::base::error::{Error, Result};
use crate::contact::attitude_rates;
use crate::model::{BodyId, Carried, Dof, Layout, Model, Race};
use crate::statics::{self, RaceControl, Spacing, rolling};

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

/// The state at t = 0, rings where given motions have them.
///
/// # Errors
/// [`Error::Equilibrium`] if the load cannot be carried; [`Error::Argument`] for a state of wrong length or
/// with a number that is not finite.
pub fn start(model: &Model, start: &Start) -> Result<Vec<f64>> {
    let mut y = begin(model, start)?;
    model.follow_given(0.0, &mut y);
    Ok(y)
}

fn begin(model: &Model, start: &Start) -> Result<Vec<f64>> {
    match start {
        Start::Rolling => {
            let mut y = vec![0.0; model.dim()];
            for (place, body) in Layout::each_mut(&mut y).iter_mut().zip(&model.bodies) {
                *place = body.nominal;
            }
            tilt(model, &mut y);
            rolling::nominally(model, &mut y);
            hold(model, &mut y);
            seat_cages(model, &mut y);
            face(model, &mut y);
            Ok(y)
        }
        Start::Equilibrium => from_equilibrium(model, Spacing::Equal),
        Start::State(state) => {
            check_length(state.len(), model.dim())?;
            match state.iter().position(|x| !x.is_finite()) {
                Some(i) => Err(Error::argument(
                    format!("start[{i}]"),
                    state[i],
                    "a finite number",
                )),
                None => given(model, state),
            }
        }
    }
}

/// Equilibrium in the cage's frame, with balls that roll.
pub(crate) fn from_equilibrium(model: &Model, spacing: Spacing) -> Result<Vec<f64>> {
    let mut y = statics::in_motion(model, RaceControl::Friction, spacing)?;
    hold(model, &mut y);
    seat_cages(model, &mut y);
    face(model, &mut y);
    Ok(y)
}

/// A state of the right length, with attitudes that are some and that change as the balls turn.
fn given(model: &Model, state: &[f64]) -> Result<Vec<f64>> {
    let (mut y, layout) = (state.to_vec(), model.layout());
    for ball in layout.tumbling().map(BodyId::ball) {
        let attitude = Dof::ATTITUDE.map(|dof| y[layout.at(ball, dof)]);
        let length = attitude.iter().map(|e| e * e).sum::<f64>().sqrt();
        if (length - 1.0).abs() > LENGTH {
            return Err(Error::argument(
                format!("start[{}]", layout.at(ball, Dof::E0)),
                format!("{attitude:?}"),
                "the four Euler parameters of a ball, whose squares add up to 1 within 1 %",
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

/// Lets the cages that are rings stand with each ball in the middle of its pocket, or lie on their lands, and turn with their balls in the
/// mean.
pub(crate) fn seat_cages(model: &Model, y: &mut [f64]) {
    let layout = model.layout();
    for (at, row) in model.rows.iter().enumerate() {
        let Some(cage) = &row.cage else { continue };
        let body = layout.cage(at);
        let orbit = model.orbit_speed(at, y);
        let mut place = model.bodies[body].nominal;
        let carrier = match &cage.carried {
            Carried::Held => None,
            Carried::Land(land) => Some(land.race.ring()),
            Carried::Balls | Carried::Spring(_) => Some(BodyId::OUTER),
        };
        if let Some(carrier) = carrier {
            let centre = layout.motion(y, carrier).centre + cage.sag(model.scene.gravity);
            (place[Dof::X], place[Dof::Y]) = (centre.x, centre.y);
        }
        let (places, speeds) = y.split_at_mut(layout.half());
        *layout.of_mut(places, body) = place;
        *layout.of_mut(speeds, body) = [0.0, 0.0, 0.0, orbit];
    }
}

/// Stops balls where they are held.
fn hold(model: &Model, y: &mut [f64]) {
    let layout = model.layout();
    let moving = layout
        .degrees()
        .filter(|(body, _)| layout.as_ball(*body).is_some());
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

/// Gives rings their nominal tilts.
fn tilt(model: &Model, y: &mut [f64]) {
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
/// [`Error::Argument`] names the lengths.
pub fn check_length(length: usize, dim: usize) -> Result<()> {
    if length == dim {
        return Ok(());
    }
    Err(Error::argument(
        "start",
        format!("{length} numbers"),
        format!("{dim} numbers, named by the model"),
    ))
}
