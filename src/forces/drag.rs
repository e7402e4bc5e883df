//! Drag of oil in the balls' way: −½ ρ X C_d (π D²/4) |v| v on a ball, seen from the housing ([*Film*](crate::equations#film)).

use super::{Account, Asymmetry, Damper, Force, ForceSums, Instant, RingWrench, Use};
use crate::model::{BodyId, Dof, Model, Race};

/// Drag on the balls of all rows.
#[derive(Debug)]
pub(crate) struct Drag;

impl Force for Drag {
    fn name(&self) -> &'static str {
        "drag"
    }

    fn contribution(&self) -> &'static str {
        "friction"
    }

    fn is_rare(&self) -> bool {
        true
    }

    fn used(&self, model: &Model) -> Use {
        Use::evaluated(model.rows.iter().any(|row| row.drag > 0.0))
    }

    fn add(&self, model: &Model, at: &Instant<'_>, sums: &mut ForceSums<'_>) {
        let rows = &model.rows[..at.rows];
        for row in rows.iter().filter(|row| row.drag > 0.0) {
            for ball in row.balls() {
                let body = BodyId::ball(ball);
                let velocity = Dof::TRANSLATIONS.map(|dof| at.state.v.get(body, dof));
                for (dof, force) in Dof::TRANSLATIONS.into_iter().zip(on(row.drag, velocity)) {
                    *sums.on.get_mut(body, dof) += force;
                }
            }
        }
    }

    /// Account of nothing: what drag takes is the oil's, of [`power`].
    fn account(&self, _model: &Model, _y: &[f64]) -> Account {
        Account::default()
    }

    fn dampers(&self, _model: &Model) -> Vec<Damper> {
        Vec::new()
    }

    fn at_start(&self, _model: &Model, _race: Race) -> RingWrench {
        RingWrench::default()
    }

    fn asymmetry(&self, _model: &Model) -> Asymmetry {
        Asymmetry::default()
    }
}

/// Drag on a ball with a velocity \[N\].
pub(crate) fn on(drag: f64, velocity: [f64; 3]) -> [f64; 3] {
    let speed = velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
    velocity.map(|v| -(drag * speed * v))
}

/// Power that it takes out of the balls of a row \[W\].
pub(crate) fn power(model: &Model, y: &[f64], row: usize) -> f64 {
    let (row, layout) = (&model.rows[row], model.layout());
    let of = |ball: usize| {
        let body = BodyId::ball(ball);
        let square: f64 = Dof::TRANSLATIONS
            .iter()
            .map(|dof| y[layout.speed_at(body, *dof)].powi(2))
            .sum();
        row.drag * square * square.sqrt()
    };
    row.balls().map(of).sum()
}
