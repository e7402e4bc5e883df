//! How fast forces change a motion, for the step that a method bears.

use super::{cage, leaning, support};
use crate::contact::Pair;
use crate::model::{Dof, Model};

/// Rates under the scene's own loads \[1/s\].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Rates {
    /// At which contact damping ends the motion of a ball between its races.
    pub damping: f64,
    /// The highest at which friction, damping, cage or supports change a motion.
    pub fastest: f64,
}

impl Rates {
    /// Under the load of the heaviest ball ([`crate::model::Scales::load`]).
    pub fn of(model: &Model) -> Self {
        let (mut rates, load) = (Self::default(), model.scales.load);
        for (i, row) in model.rows.iter().enumerate() {
            let body = &model.bodies[row.first_body()];
            let radius = model.balls[row.first].side.radius;
            // Both races rub on a ball, and turn it more easily than they shift it.
            let turned = radius * radius / body.mass[Dof::Theta];
            let mobility = turned.max(1.0 / body.mass[Dof::X]);
            let rubbing = |pair: &Pair| pair.law.traction.map_or(0.0, |law| law.at(0.0));
            let friction: f64 = row.pairs.iter().map(rubbing).sum();
            // Hunt and Crossley's 3/2 α_d N on either side.
            let damping: f64 = row.pairs.iter().map(|pair| pair.law.damping.rate()).sum();
            rates.damping = rates.damping.max(load * damping / body.mass[Dof::X]);
            rates.fastest = rates.fastest.max(load * friction * mobility);
            rates.fastest = rates.fastest.max(cage::rate(model, i));
        }
        let bodies = model.layout().bodies();
        let supports = bodies.map(|id| support::rate(model, id).max(leaning::rate(model, id)));
        rates.fastest = supports.fold(rates.fastest.max(rates.damping), f64::max);
        rates
    }
}
