//! Meaning of the law of a scene's contacts at its own load.

use std::fmt;

use serde::Serialize;

use crate::model::{Model, Race};
use crate::scene::NormalLaw;
use crate::statics::Equilibrium;

/// Approach of ball and race in the most loaded contact at the start, compared with Hertz's theory.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct LawExplanation {
    /// The law.
    pub law: NormalLaw,
    /// The most loaded contact, such as `row0.ball3.inner`.
    pub contact: String,
    /// Load of that contact \[N\].
    pub load: f64,
    /// How far ball and race approach under it \[m\].
    pub approach: f64,
    /// The same by Hertz's theory \[m\].
    pub hertz_approach: f64,
    /// Largest Hertz pressure in it \[Pa\].
    pub pressure: f64,
}

/// The explanation of the scene's law at its start; absent where no contact is loaded.
pub(super) fn of(model: &Model, at_start: &Equilibrium) -> Option<LawExplanation> {
    let contacts = at_start.balls.iter().flat_map(|ball| {
        [
            (ball, Race::Outer, &ball.outer),
            (ball, Race::Inner, &ball.inner),
        ]
    });
    let (ball, race, contact) = contacts.max_by(|a, b| a.2.load.total_cmp(&b.2.load))?;
    let ring = race.name();
    (contact.load > 0.0).then(|| LawExplanation {
        law: {
            let scene = model.scene();
            scene.contact_of(&scene.rows[ball.row]).law.clone()
        },
        contact: format!("row{}.ball{}.{ring}", ball.row, ball.ball),
        load: contact.load,
        approach: contact.deflection,
        hertz_approach: model.rows[ball.row].hertz[race].approach(contact.load),
        pressure: contact.pressure,
    })
}

impl fmt::Display for LawExplanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: under {:.0} N, the largest load, {} deflects by {:.2} µm",
            self.law.description(),
            self.load,
            self.contact,
            1e6 * self.approach
        )?;
        if self.law != NormalLaw::Hertz {
            write!(
                f,
                ", {:.2} × Hertz's {:.2} µm",
                self.approach / self.hertz_approach,
                1e6 * self.hertz_approach
            )?;
        }
        write!(
            f,
            "; largest Hertz pressure {:.2} GPa",
            1e-9 * self.pressure
        )
    }
}
