//! When the step collapses: how it is seen, and which contacts did it.

use crate::forces;
use crate::model::{BodyId, Dof, Model, Race};

/// Steps in a row below the limit that make a collapse.
const PATIENCE: usize = 1000;
/// Share of the contacts' 1/ω, or of a smaller largest step, below which a step leads nowhere: at 1e-5 a
/// millisecond takes more than ten million steps.
const HOPELESS: f64 = 1e-5;
/// Contacts, cages and supports that an error names at most.
const NAMED: usize = 4;

/// Counts hopelessly small steps.
pub(crate) struct Crawl {
    limit: f64,
    steps: usize,
}

impl Crawl {
    pub fn new(model: &Model, max_step: f64) -> Self {
        Self {
            limit: HOPELESS * max_step.min(1.0 / model.scales.frequency),
            steps: 0,
        }
    }

    /// Whether the run is no longer worth waiting for after an accepted step.
    pub fn after(&mut self, step: f64) -> bool {
        self.steps = if step < self.limit { self.steps + 1 } else { 0 };
        self.steps >= PATIENCE
    }
}

/// What held up a run: a contact, the cage or a support.
pub(crate) struct Culprit {
    /// `row0.ball3.outer` (ball and race), `row0.cage` or `outer.support`.
    pub name: String,
    /// A body it acts on.
    pub body: BodyId,
    /// What it does, in numbers.
    state: String,
    /// Rate at which its friction and damping change the motion of what it acts on \[1/s\].
    rate: f64,
}

impl std::fmt::Display for Culprit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            name, state, rate, ..
        } = self;
        write!(f, "{name} ({state}rate {rate:.1e} 1/s)")
    }
}

/// The contacts that touch, cages and supports of a body in a state, the fastest first; all without a body. An
/// explicit step is held below about 3.3 over the rate.
pub(crate) fn culprits(model: &Model, y: &[f64], body: Option<BodyId>) -> Vec<Culprit> {
    let concerns = |touched: &[BodyId]| body.is_none_or(|b| touched.contains(&b));
    let contacts = (0..model.balls.len())
        .flat_map(|j| Race::BOTH.map(|race| (j, race)))
        .filter(|&(j, race)| concerns(&[BodyId::ball(j), race.ring()]))
        .filter_map(|(j, race)| contact(model, y, j, race));
    let cages = (0..model.rows.len())
        .filter(|&row| {
            let links = |ball: usize| model.balls[ball].row == row;
            body.is_none_or(|body| body.as_ball().is_some_and(links))
        })
        .filter_map(|row| cage(model, row));
    let supports = model.layout().bodies();
    let supports = supports
        .filter(|&body| concerns(&[body]))
        .filter_map(|body| support(model, body));
    let mut found: Vec<Culprit> = contacts.chain(cages).chain(supports).collect();
    found.sort_by(|a, b| b.rate.total_cmp(&a.rate));
    found.truncate(NAMED);
    found
}

/// A sliding ball's N (1/m + R²/I) μ(u)/√(u² + v_s²), and Hunt–Crossley's 3/2 α_d N/m.
fn contact(model: &Model, y: &[f64], j: usize, race: Race) -> Option<Culprit> {
    let (ball, body) = (&model.balls[j], &model.bodies[BodyId::ball(j)]);
    let pair = &model.rows[ball.row].pairs[race];
    let contact = model.contact(y, j, race);
    let mobility = 1.0 / body.mass[Dof::X] + ball.side.radius.powi(2) / body.mass[Dof::Theta];
    let friction = pair
        .friction
        .map_or(0.0, |law| law.factor(contact.slip) * mobility);
    let damping = 1.5 * pair.damping / body.mass[Dof::X];
    (contact.load > 0.0).then(|| Culprit {
        name: format!("{}.{}", body.name, race.name()),
        body: BodyId::ball(j),
        state: format!(
            "load {:.3e} N, slip {:.3e} m/s, ",
            contact.load, contact.slip
        ),
        rate: contact.load * (friction + damping),
    })
}

/// The links of the cage that damp a ball.
fn cage(model: &Model, row: usize) -> Option<Culprit> {
    let rate = forces::cage::rate(model, row);
    (rate > 0.0).then(|| Culprit {
        name: format!("row{row}.cage"),
        body: model.rows[row].first_body(),
        state: String::new(),
        rate,
    })
}

/// The fastest direction of a body's dampers.
fn support(model: &Model, body: BodyId) -> Option<Culprit> {
    let rate = forces::support::rate(model, body);
    (rate > 0.0).then(|| Culprit {
        name: format!("{}.support", model.bodies[body].name),
        body,
        state: String::new(),
        rate,
    })
}
