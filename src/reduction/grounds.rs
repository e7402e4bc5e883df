//! Grounds on which directions are left out, and how they move nevertheless.

use super::AxialPlaces;
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
    Rolling,
    AxiallyFixed,
    Idle,
}

impl Reason {
    pub(super) const ALL: [Self; 9] = every!(Reason:
        Held,
        Driven(Race::Outer),
        Driven(Race::Inner),
        NoMoment,
        Mirror,
        Copy,
        Rolling,
        AxiallyFixed,
        Idle,
    );

    pub(super) fn describe(self) -> (&'static str, &'static str) {
        match self {
            Self::Held => ("held directions", "they do not move"),
            Self::Driven(Race::Outer) => ("rotation of the outer ring", "its speed is given"),
            Self::Driven(Race::Inner) => ("rotation of the inner ring", "the drive prescribes it"),
            Self::NoMoment => ("spin of balls", "no friction: nothing turns them"),
            Self::Mirror => ("z", "mirror symmetry"),
            Self::Copy => ("balls of row 1", "mirror image of row 0"),
            Self::Rolling => (
                "orbit and spin of balls",
                "by request: they roll, without friction and cage",
            ),
            Self::AxiallyFixed => ("z", "by request: axial places are kept"),
            Self::Idle => (
                "balls of the unloaded row",
                "by request: they carry less than 2 % of the load",
            ),
        }
    }
}

/// Grounds of a scene for leaving directions out, found before the choice is made.
#[derive(Default)]
pub(super) struct Grounds {
    /// Whether directions that do not change the motion are left out.
    pub exact: bool,
    pub plane: bool,
    pub mirrored: bool,
    /// Axial places of rings and rows.
    pub axial_places: Option<AxialPlaces>,
    /// The row that is left out.
    pub idle: Option<usize>,
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
        if row.is_some() && self.idle == row {
            return Some(Reason::Idle);
        }
        match model.bodies[body].degrees[dof] {
            Degree::Fixed => self.exact.then_some(Reason::Held),
            Degree::Driven if dof != Dof::Theta => None,
            Degree::Driven => {
                let race = Race::BOTH.into_iter().find(|race| race.ring() == body);
                race.filter(|_| self.exact).map(Reason::Driven)
            }
            Degree::Free { stiffness, damping } => match (dof, ball) {
                (Dof::Z, _) if self.plane => Some(Reason::Mirror),
                // The image pulls the rings the other way.
                (Dof::Z, None) if self.mirrored => Some(Reason::Mirror),
                (Dof::Z, _) if self.axial_places.is_some() => Some(Reason::AxiallyFixed),
                (Dof::Y | Dof::Theta, Some(_)) if model.scene.approximations.rolling => {
                    Some(Reason::Rolling)
                }
                (Dof::Theta, Some(ball)) if self.exact => {
                    let smooth = !model.rows[ball.row].turns_balls();
                    let whole = ball.side.defects.is_empty() && ball.side.waves.is_round();
                    let loose = stiffness == 0.0 && damping == 0.0;
                    (smooth && whole && loose).then_some(Reason::NoMoment)
                }
                _ => None,
            },
        }
    }

    /// How a direction that is left out moves, from a start; none where those that are kept determine it.
    pub fn course(
        &self,
        model: &Model,
        t: f64,
        start: &[f64],
        body: BodyId,
        dof: Dof,
        reason: Reason,
    ) -> Option<Course> {
        let layout = model.layout();
        let (place, speed) = (
            start[layout.at(body, dof)],
            start[layout.speed_at(body, dof)],
        );
        let scene = &model.scene;
        match (reason, dof) {
            (Reason::Copy, _) | (Reason::Rolling, Dof::Y) => None,
            (Reason::Idle, Dof::X | Dof::Y) if layout.as_ball(body).is_some() => None,
            (Reason::Mirror, _) => Some(Course::steady(t, model.bodies[body].nominal[dof], 0.0)),
            (Reason::AxiallyFixed, _) => {
                let places = self.axial_places.as_ref()?;
                Some(Course::steady(t, places.of(model, body), 0.0))
            }
            // The cage of a row that is left out turns on.
            (Reason::Idle, Dof::X | Dof::Y | Dof::Z) => Some(Course::steady(t, place, 0.0)),
            (Reason::Driven(of), _) => {
                let follows = Race::BOTH.map(|race| f64::from(race == of));
                Some(Course::driven(t, place, speed, follows, scene))
            }
            (Reason::Rolling, _) => {
                let row = model.balls[layout.as_ball(body)?].row;
                let (_, at_rest) = model.rolling_shares(row);
                Some(Course::geared(t, place, speed, at_rest, scene))
            }
            _ => Some(Course::steady(t, place, speed)),
        }
    }
}

/// Whether forces depend on a degree of freedom that runs its course.
pub(super) fn is_felt(model: &Model, motion: &Prescribed, reason: Reason) -> bool {
    match reason {
        Reason::NoMoment | Reason::Idle => false,
        // The angle of a smooth, round and balanced ring has no effect, its speed one on films that follow it.
        Reason::Driven(race) => {
            let on_ring = model.rows.iter().any(|row| {
                let pair = &row.pairs[race];
                pair.law.turns_balls() || !pair.defects.is_empty() || !pair.waves.is_round()
            });
            let turns = forces::ALL.iter().any(|force| force.turns_with_ring(model));
            on_ring || model.has_films_in_motion() || turns
        }
        // Only a defect makes the angle of a ball matter.
        Reason::Rolling => {
            let ball = model.layout().as_ball(motion.body);
            let ball = ball.map(|j| &model.balls[j].side);
            ball.is_some_and(|side| !side.defects.is_empty())
        }
        _ => true,
    }
}
