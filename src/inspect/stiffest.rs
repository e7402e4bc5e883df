//! The elements that limit an explicit step: contacts, cages and supports with the highest rates.

use crate::base::quantities::{force, number};
use crate::forces::{self, Damper};
use crate::inspect::raw::contact;
use crate::model::{BodyId, BodyKind, Dof, Model, Race};

/// Elements that are named at most.
const NAMED: usize = 4;

/// A contact, a cage or a support.
pub(crate) struct StiffElement {
    /// `row0.ball3.outer` (ball and race), `row0.cage` or `outer.support`.
    pub name: String,
    /// A body it acts on.
    pub body: BodyId,
    /// State of the element, in numbers.
    state: String,
    /// Rate at which its friction and damping change the motion of what it acts on \[1/s\].
    rate: f64,
}

impl std::fmt::Display for StiffElement {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            name, state, rate, ..
        } = self;
        write!(f, "{name} ({state}rate {} 1/s)", number(*rate))
    }
}

/// The contacts that touch, cages and supports of a body in a state, the fastest first; all without a body. An
/// explicit step is held below about 3.3 over the rate.
pub(crate) fn stiffest(model: &Model, y: &[f64], body: Option<BodyId>) -> Vec<StiffElement> {
    let concerns = |touched: &[BodyId]| body.is_none_or(|b| touched.contains(&b));
    let contacts = (0..model.balls.len())
        .flat_map(|j| Race::BOTH.map(|race| (j, race)))
        .filter(|&(j, race)| concerns(&[BodyId::ball(j), race.ring()]))
        .filter_map(|(j, race)| of_contact(model, y, j, race));
    let others = forces::ALL
        .into_iter()
        .flat_map(|force| force.dampers(model));
    let others = others.filter(|damper| damper.rate > 0.0 && concerned(model, body, damper.body));
    let others = others.map(|Damper { name, body, rate }| StiffElement {
        name,
        body,
        state: String::new(),
        rate,
    });
    let mut found: Vec<StiffElement> = contacts.chain(others).collect();
    found.sort_by(|a, b| b.rate.total_cmp(&a.rate));
    found.truncate(NAMED);
    found
}

/// A sliding ball's N (1/m + R²/I) μ(u)/√(u² + v_s²), and Hunt–Crossley's 3/2 α_d N/m.
fn of_contact(model: &Model, y: &[f64], j: usize, race: Race) -> Option<StiffElement> {
    let (ball, body) = (&model.balls[j], &model.bodies[BodyId::ball(j)]);
    let pair = &model.rows[ball.row].pairs[race];
    let contact = contact(model, y, j, race);
    let mobility = 1.0 / body.mass[Dof::X] + ball.side.radius.powi(2) / body.mass[Dof::Theta];
    let traction = pair.law.traction;
    let friction = traction.map_or(0.0, |law| law.at(contact.slip) * mobility);
    let damping = pair.law.damping.rate() / body.mass[Dof::X];
    (contact.load > 0.0).then(|| StiffElement {
        name: format!("{}.{}", body.name, race.name()),
        body: BodyId::ball(j),
        state: format!(
            "load {}, slip {} m/s, ",
            force(contact.load),
            number(contact.slip)
        ),
        rate: contact.load * (friction + damping),
    })
}

/// Whether a body is the one that is asked for, or a ball of the same row; all are where none is asked for.
fn concerned(model: &Model, asked: Option<BodyId>, body: BodyId) -> bool {
    let row = |of: BodyId| match model.layout().kind(of) {
        BodyKind::Ball(ball) => Some(model.balls[ball].row),
        BodyKind::Cage(row) => Some(row),
        BodyKind::Ring(_) | BodyKind::Mode(_) => None,
    };
    asked.is_none_or(|asked| asked == body || row(asked).is_some() && row(asked) == row(body))
}
