//! Pits of races and balls: where they lie, and what part of a contact's load they may release. The forces that follow are in
//! `scalar/over_defects/pits.rs`.

use nalgebra::Vector3;

use super::SurfaceDefect;
use super::hole::{Hole, PittedContact, Yield};
use crate::contact::hertz::Hertz;
use crate::contact::{Motion, wrapped};
use crate::scene::Defect;

/// A pit, compiled; its place is that of its [`SurfaceDefect`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::contact) struct Pit {
    pub hole: Hole,
    /// Of contacts with the outer and the inner race, where it can meet them.
    pub contacts: [PittedContact; 2],
    /// Radius of the surface there \[m\].
    pub radius: f64,
    /// Half of the angle over which a contact as wide as under the typical load meets it \[rad\].
    pub span: f64,
}

/// Pits that a contact meets at once, at most.
pub(crate) const MOST_PITS: usize = 4;

/// How many pits of a race one contact may meet at once.
pub(crate) fn pits_at_once(defects: &[SurfaceDefect]) -> usize {
    let pits = defects.iter().filter(|defect| defect.is_pit());
    let beyond = |one: &SurfaceDefect, other: &SurfaceDefect| {
        let apart = wrapped(other.angle - one.angle);
        (0.0..=one.reach + other.reach).contains(&apart)
    };
    let from = |one: &SurfaceDefect| pits.clone().filter(|other| beyond(one, other)).count();
    pits.clone().map(from).max().unwrap_or(0)
}

impl SurfaceDefect {
    /// A pit whose middle lies at `middle` on a surface of a radius there \[m\], met by contacts of these kinds with the outer and the inner
    /// race, that are so wide under eight times a typical load \[m\].
    pub(crate) fn pit(
        defect: &Defect,
        middle: f64,
        radius: f64,
        contacts: [PittedContact; 2],
    ) -> Self {
        let along = defect.width.largest() / 2.0;
        let across = if defect.length > 0.0 {
            defect.length / 2.0
        } else {
            along
        };
        let pit = Pit {
            hole: Hole::new([across, along]),
            contacts,
            radius,
            span: along / radius,
        };
        Self {
            pit: Some(pit),
            ..Self::new(defect, middle, radius)
        }
    }

    /// Whether it is a pit.
    pub(crate) fn is_pit(&self) -> bool {
        self.pit.is_some()
    }

    /// Takes over the half-width of contacts under a typical load \[m\]: a pit is met from so far away on, and looked for from twice as far,
    /// as under eight times the load.
    pub(crate) fn widen(&mut self, half_width: f64) {
        if let Some(pit) = &mut self.pit {
            pit.span = (pit.hole.along() + half_width) / pit.radius;
            self.reach = (pit.hole.along() + 2.0 * half_width) / pit.radius;
        }
    }

    /// Whether it is too large for its contact under a load \[N\]: longer than nine tenths of it, or releasing 1.8 times its energy, beyond
    /// which a solver by boundary elements loses something else.
    pub(crate) fn outgrows(&self, contact: &Hertz, load: f64) -> bool {
        const LONGEST: f64 = 0.9;
        const MOST_RELEASED: f64 = 1.8;
        let (Some(pit), Some((_, released))) = (&self.pit, self.takes(contact, load)) else {
            return false;
        };
        pit.hole.across() > LONGEST * contact.half_length * load.cbrt() || released > MOST_RELEASED
    }

    /// What a pit takes of a contact's load at its middle, at one and the same approach \[N\], and X; none of other defects.
    pub(crate) fn takes(&self, contact: &Hertz, load: f64) -> Option<(f64, f64)> {
        let (of, depth) = (PittedContact::of(contact), contact.approach(load));
        let released = self.pit?.hole.released(&of, depth, [0.0; 2]);
        let found = Yield::of(&of, 0.4 * load * depth, &[released]);
        Some((load * (1.0 - found.share), found.exponent))
    }

    /// The direction of a ball's pit in the frame in which the ball is seen.
    pub(in crate::contact) fn pit_pole(&self, ball: &Motion) -> Option<Vector3<f64>> {
        let along = self.middle / self.pit?.radius;
        let across = (1.0 - along * along).max(0.0).sqrt();
        let (sin, cos) = self.angle.sin_cos();
        Some(ball.carried(&Vector3::new(across * cos, across * sin, along)))
    }
}
