//! Grounds on which directions are left out, and how they move nevertheless.

use super::course::{Course, Prescribed};
use crate::base::every::every;
use crate::forces;
use crate::model::{BodyId, BodyKind, Degree, Dof, Model, Race};

/// Why a degree of freedom is not integrated.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Reason {
    Held,
    Driven(Race),
    NoMoment,
    Mirror,
    Copy,
}

impl Reason {
    pub(super) const ALL: [Self; 6] = every!(Reason:
        Held,
        Driven(Race::Outer),
        Driven(Race::Inner),
        NoMoment,
        Mirror,
        Copy,
    );

    pub(super) fn describe(self) -> (&'static str, &'static str) {
        match self {
            Self::Held => ("held directions", "they do not move"),
            Self::Driven(Race::Outer) => ("rotation of the outer ring", "its speed is given"),
            Self::Driven(Race::Inner) => ("rotation of the inner ring", "the drive prescribes it"),
            Self::NoMoment => ("spin of balls", "no friction: nothing turns them"),
            Self::Mirror => ("z", "mirror symmetry"),
            Self::Copy => ("balls of row 1", "mirror image of row 0"),
        }
    }
}

/// Grounds of a scene for leaving directions out, found before the choice is made.
pub(super) struct Grounds {
    /// Whether every row is symmetric about its own plane.
    pub plane: bool,
    /// Whether the second row is the first one's mirror image.
    pub mirrored: bool,
}

impl Grounds {
    /// Why a degree of freedom can be left out.
    pub fn reason(&self, model: &Model, body: BodyId, dof: Dof) -> Option<Reason> {
        let kind = model.layout().kind(body);
        let (ball, row) = match kind {
            BodyKind::Ring(_) | BodyKind::Mode(_) => (None, None),
            BodyKind::Ball(j) => (Some(&model.balls[j]), Some(model.balls[j].row)),
            BodyKind::Cage(row) => (None, Some(row)),
        };
        if self.mirrored && row == Some(1) {
            return Some(Reason::Copy);
        }
        match model.bodies[body].degrees[dof] {
            Degree::Fixed => Some(Reason::Held),
            Degree::Driven if dof != Dof::Theta => None,
            Degree::Driven => {
                let race = Race::BOTH.into_iter().find(|race| race.ring() == body);
                race.map(Reason::Driven)
            }
            Degree::Free { stiffness, damping } => match (dof, ball) {
                (Dof::Z, _) if self.plane => Some(Reason::Mirror),
                // The image pulls the rings the other way.
                (Dof::Z, None) if self.mirrored => Some(Reason::Mirror),
                (Dof::Theta, Some(ball)) => {
                    let smooth = !model.rows[ball.row].turns_balls();
                    let whole = ball.side.defects.is_empty() && ball.side.waves.is_round();
                    let loose = stiffness == 0.0 && damping == 0.0;
                    (smooth && whole && loose).then_some(Reason::NoMoment)
                }
                _ => None,
            },
        }
    }
}

impl Prescribed {
    /// How a direction that is left out moves, from a start; none where those that are kept determine it.
    pub(super) fn of(
        model: &Model,
        t: f64,
        start: &[f64],
        (body, dof): (BodyId, Dof),
        reason: Reason,
    ) -> Option<Self> {
        let layout = model.layout();
        let (place, speed) = (
            start[layout.at(body, dof)],
            start[layout.speed_at(body, dof)],
        );
        let course = match reason {
            Reason::Copy => return None,
            Reason::Mirror => Course::steady(t, model.bodies[body].nominal[dof], 0.0),
            Reason::Driven(race) => Course::driven(t, place, speed, race, &model.scene),
            Reason::Held | Reason::NoMoment => Course::steady(t, place, speed),
        };
        Some(Self { body, dof, course })
    }
}

/// Whether forces depend on a degree of freedom that is left out and moves.
pub(super) fn is_felt(model: &Model, reason: Reason) -> bool {
    match reason {
        Reason::NoMoment => false,
        // The angle of a smooth, round and balanced ring has no effect, its speed one on films that follow it.
        Reason::Driven(race) => {
            let on_ring = model.rows.iter().any(|row| {
                let pair = &row.pairs[race];
                pair.law.turns_balls() || !pair.defects.is_empty() || !pair.waves.is_round()
            });
            let turns = forces::ALL
                .iter()
                .any(|force| force.asymmetry(model).turns_with_ring);
            on_ring || model.has_films_in_motion() || turns
        }
        Reason::Held | Reason::Mirror | Reason::Copy => true,
    }
}
