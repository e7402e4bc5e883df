//! Bodies, races and directions, and the one place that gives their offsets in a state vector.
//!
//! A state vector holds the places of all bodies, then their speeds in the same order. Tilts of rings, as far as they move,
//! stand behind all bodies in each half, and behind them the rotations of freely spinning balls about x and y. No other file computes with the number of a body's directions or with the bodies before
//! the balls: another direction is a change of this file.

mod index;

use std::ops::Range;

use super::{DOFS, Dof};
use crate::contact::Motion;
use crate::scene::RingName;

/// Bodies before the first ball: one ring a race.
pub(crate) const RINGS: usize = Race::BOTH.len();

/// Race of a row, one of two, and the ring that carries it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Race {
    /// Race on the outer ring.
    #[default]
    Outer,
    /// Race on the inner ring.
    Inner,
}

impl Race {
    /// Outer, then inner: the order of everything that has one entry a race.
    pub const BOTH: [Self; 2] = [Self::Outer, Self::Inner];

    /// The race opposite.
    #[must_use]
    #[inline]
    pub fn other(self) -> Self {
        match self {
            Self::Outer => Self::Inner,
            Self::Inner => Self::Outer,
        }
    }

    /// The ring that carries it.
    #[inline]
    pub const fn ring(self) -> BodyId {
        BodyId(self as usize)
    }

    /// `outer` or `inner`: as in the names of states and columns.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Outer => "outer",
            Self::Inner => "inner",
        }
    }

    /// σ of [*Geometry of a row*](crate::equations#geometry-of-a-row): +1 where a ball touches outwards, −1 where it touches inwards.
    #[inline]
    pub const fn sigma(self) -> f64 {
        match self {
            Self::Outer => 1.0,
            Self::Inner => -1.0,
        }
    }
}

impl From<RingName> for Race {
    fn from(name: RingName) -> Self {
        match name {
            RingName::Outer => Self::Outer,
            RingName::Inner => Self::Inner,
        }
    }
}

impl From<Race> for RingName {
    fn from(race: Race) -> Self {
        match race {
            Race::Outer => Self::Outer,
            Race::Inner => Self::Inner,
        }
    }
}

/// Kind of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum BodyKind {
    /// The ring that carries a race.
    Ring(Race),
    /// A ball, by its number among the balls of all rows.
    Ball(usize),
    /// A cage that is a ring, by its row.
    Cage(usize),
    /// A mode of the structure around the outer ring, by its number; its coordinate stands along x.
    Mode(usize),
}

/// A body of a model: outer ring, inner ring, all balls row by row, the cages that are rings, then the modes of a structure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct BodyId(usize);

impl BodyId {
    /// The outer ring.
    pub const OUTER: Self = Race::Outer.ring();
    /// The inner ring.
    pub const INNER: Self = Race::Inner.ring();

    /// A ball by its number among the balls of all rows.
    #[inline]
    pub const fn ball(ball: usize) -> Self {
        Self(RINGS + ball)
    }

    /// A body by its number among all bodies, as in [`crate::Model::bodies`].
    #[inline]
    pub const fn new(index: usize) -> Self {
        Self(index)
    }

    /// The body's number among all bodies.
    #[inline]
    pub const fn index(self) -> usize {
        self.0
    }

    /// The numbers of so many bodies from this one on, which are neighbours in any table of bodies.
    #[inline]
    pub(crate) fn range(self, count: usize) -> Range<usize> {
        self.0..self.0 + count
    }

    /// The body so many places after it.
    #[inline]
    pub(crate) const fn after(self, count: usize) -> Self {
        Self(self.0 + count)
    }
}

/// Layout of a state vector: where the places and speeds of all bodies stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    bodies: usize,
    /// Cages that are rings, behind the balls.
    cages: usize,
    /// Modes of a structure, behind the cages.
    modes: usize,
    /// Tilts of outer and inner ring that move: bits in the order of their places.
    tilts: u8,
    /// Whether balls spin freely.
    turns: bool,
    /// The balls that have an attitude: from this one on, so many.
    tumbling: [usize; 2],
}

impl Layout {
    /// The layout of two rings and so many balls.
    #[inline]
    pub const fn of_balls(balls: usize) -> Self {
        Self {
            bodies: RINGS + balls,
            cages: 0,
            modes: 0,
            tilts: 0,
            turns: false,
            tumbling: [0; 2],
        }
    }

    /// The same with cages that are rings.
    pub(crate) fn with_cages(self, cages: usize) -> Self {
        Self {
            bodies: self.bodies - self.cages + cages,
            cages,
            ..self
        }
    }

    /// The same with modes of a structure.
    pub(crate) fn with_modes(self, modes: usize) -> Self {
        Self {
            bodies: self.bodies - self.modes + modes,
            modes,
            ..self
        }
    }

    /// Number of balls.
    #[inline]
    const fn balls(self) -> usize {
        self.bodies - RINGS - self.cages - self.modes
    }

    /// Ring, ball, cage or mode.
    #[inline]
    pub const fn kind(self, body: BodyId) -> BodyKind {
        match body.0 {
            0 => BodyKind::Ring(Race::Outer),
            1 => BodyKind::Ring(Race::Inner),
            at if at < RINGS + self.balls() => BodyKind::Ball(at - RINGS),
            at if at < self.bodies - self.modes => BodyKind::Cage(at - RINGS - self.balls()),
            at => BodyKind::Mode(at + self.modes - self.bodies),
        }
    }

    /// The number of a ball among those of all rows; none for other bodies.
    #[inline]
    pub const fn as_ball(self, body: BodyId) -> Option<usize> {
        match self.kind(body) {
            BodyKind::Ball(ball) => Some(ball),
            BodyKind::Ring(_) | BodyKind::Cage(_) | BodyKind::Mode(_) => None,
        }
    }

    /// The cage of a row, which is a ring.
    #[inline]
    pub const fn cage(self, row: usize) -> BodyId {
        BodyId(RINGS + self.balls() + row)
    }

    /// The numbers of the modes among all bodies.
    #[inline]
    pub(crate) const fn modes(self) -> Range<usize> {
        self.bodies - self.modes..self.bodies
    }

    /// A mode of the structure.
    #[inline]
    pub const fn mode(self, mode: usize) -> BodyId {
        BodyId(self.bodies - self.modes + mode)
    }

    /// The same where balls spin freely, some of them with an attitude.
    pub(crate) fn with_turns(self, tumbling: Range<usize>) -> Self {
        Self {
            turns: true,
            tumbling: [tumbling.start, tumbling.len()],
            ..self
        }
    }

    /// The balls that have an attitude.
    #[inline]
    pub fn tumbling(self) -> Range<usize> {
        self.tumbling[0]..self.tumbling[0] + self.tumbling[1]
    }

    /// The same where some tilts about x and y of the rings move.
    pub(crate) fn with_tilts(self, moving: [[bool; 2]; RINGS]) -> Self {
        let bits = moving.as_flattened().iter().enumerate();
        let tilts = bits.fold(0, |tilts, (bit, moves)| tilts | u8::from(*moves) << bit);
        Self { tilts, ..self }
    }

    /// Whether a state vector holds a direction of a body.
    #[inline]
    pub const fn has(self, body: BodyId, dof: Dof) -> bool {
        match dof {
            Dof::TiltX | Dof::TiltY => body.0 < RINGS && self.tilts >> tilt_bit(body, dof) & 1 == 1,
            Dof::TurnX | Dof::TurnY => {
                self.turns && body.0 >= RINGS && body.0 < RINGS + self.balls()
            }
            Dof::E0 | Dof::E1 | Dof::E2 | Dof::E3 => {
                let [first, count] = self.tumbling;
                body.0 >= RINGS + first && body.0 < RINGS + first + count
            }
            _ => true,
        }
    }

    /// Length of a state vector.
    #[inline]
    pub const fn dim(self) -> usize {
        2 * self.half()
    }

    /// Number of places, and of speeds.
    #[inline]
    pub const fn half(self) -> usize {
        self.first_attitude() + 4 * self.tumbling[1]
    }

    /// Offset at which the turning of balls begins.
    #[inline]
    const fn first_turn(self) -> usize {
        DOFS * self.bodies + self.tilts.count_ones() as usize
    }

    /// Offset at which the attitudes of balls begin.
    #[inline]
    const fn first_attitude(self) -> usize {
        let turns = if self.turns { 2 * self.balls() } else { 0 };
        self.first_turn() + turns
    }

    /// Offset of a place in a state vector, or of a speed among the speeds.
    #[inline]
    pub const fn at(self, body: BodyId, dof: Dof) -> usize {
        match dof {
            Dof::TiltX | Dof::TiltY => {
                let before = self.tilts & ((1 << tilt_bit(body, dof)) - 1);
                DOFS * self.bodies + before.count_ones() as usize
            }
            Dof::TurnX => self.first_turn() + 2 * (body.0 - RINGS),
            Dof::TurnY => self.first_turn() + 2 * (body.0 - RINGS) + 1,
            Dof::E0 | Dof::E1 | Dof::E2 | Dof::E3 => {
                let ball = body.0 - RINGS - self.tumbling[0];
                self.first_attitude() + 4 * ball + (dof.index() - Dof::E0.index())
            }
            _ => DOFS * body.0 + dof.index(),
        }
    }

    /// Offset of a speed in a state vector.
    #[inline]
    pub const fn speed_at(self, body: BodyId, dof: Dof) -> usize {
        self.half() + self.at(body, dof)
    }

    /// Body and direction at an offset in either half of a state vector.
    #[inline]
    pub fn degree(self, at: usize) -> (BodyId, Dof) {
        let all = DOFS * self.bodies;
        if at < all {
            return (BodyId(at / DOFS), Dof::ALL[at % DOFS]);
        }
        if let Some(place) = at.checked_sub(self.first_attitude()) {
            let ball = self.tumbling[0] + place / 4;
            return (BodyId(RINGS + ball), Dof::ATTITUDE[place % 4]);
        }
        if let Some(turn) = at.checked_sub(self.first_turn()) {
            return (BodyId(RINGS + turn / 2), Dof::TURNS[turn % 2]);
        }
        let (mut bit, mut left) = (0, at - all);
        while self.tilts >> bit & 1 == 0 || left > 0 {
            left -= (self.tilts >> bit & 1) as usize;
            bit += 1;
        }
        (BodyId(bit / 2), Dof::TILTS[bit % 2])
    }

    /// Directions of all bodies, in the order of the places in a state vector.
    pub fn degrees(self) -> impl Iterator<Item = (BodyId, Dof)> {
        (0..self.half()).map(move |at| self.degree(at))
    }

    /// A state of the same bodies in another layout as one of this: what only that has falls away, what only this has is 0.
    pub(crate) fn carry(self, y: &[f64], from: Self) -> Vec<f64> {
        let mut carried = vec![0.0; self.dim()];
        for (body, dof) in self.degrees().filter(|(body, dof)| from.has(*body, *dof)) {
            carried[self.at(body, dof)] = y[from.at(body, dof)];
            carried[self.speed_at(body, dof)] = y[from.speed_at(body, dof)];
        }
        carried
    }

    /// All bodies in their order.
    pub fn bodies(self) -> impl ExactSizeIterator<Item = BodyId> + Clone {
        (0..self.bodies).map(BodyId)
    }

    /// The numbers of a body in half a state vector.
    ///
    /// # Panics
    /// If there is no such body.
    #[inline]
    pub fn of(self, half: &[f64], body: BodyId) -> &[f64; DOFS] {
        &half.as_chunks().0[body.0]
    }

    /// The same to be written.
    ///
    /// # Panics
    /// If there is no such body.
    #[inline]
    pub fn of_mut(self, half: &mut [f64], body: BodyId) -> &mut [f64; DOFS] {
        &mut half.as_chunks_mut().0[body.0]
    }

    /// The numbers of all bodies in half a state vector, body by body; what stands behind them may look like more bodies.
    #[inline]
    pub fn each(half: &[f64]) -> &[[f64; DOFS]] {
        half.as_chunks().0
    }

    /// The same to be written.
    #[inline]
    pub fn each_mut(half: &mut [f64]) -> &mut [[f64; DOFS]] {
        half.as_chunks_mut().0
    }

    /// Place and motion of a body in a state.
    ///
    /// # Panics
    /// If there is no such body.
    #[inline]
    pub(crate) fn motion(self, y: &[f64], body: BodyId) -> Motion {
        let (q, v) = y.split_at(self.half());
        let motion = Motion::new(self.of(q, body), self.of(v, body));
        if self.has(body, Dof::TurnX) {
            let across = Dof::TURNS.map(|dof| v[self.at(body, dof)]);
            let attitude = || Dof::ATTITUDE.map(|dof| q[self.at(body, dof)]);
            return Motion {
                attitude: self.has(body, Dof::E0).then(attitude),
                ..motion.turning_across(across)
            };
        }
        motion
    }

    /// The place of a body's centre in a state \[m\].
    ///
    /// # Panics
    /// If there is no such body.
    #[inline]
    pub fn centre(self, y: &[f64], body: BodyId) -> [f64; 3] {
        Dof::TRANSLATIONS.map(|dof| y[self.at(body, dof)])
    }
}

/// The bit of a ring's tilt, in the order of their places.
const fn tilt_bit(body: BodyId, tilt: Dof) -> usize {
    2 * body.0 + (tilt.index() - Dof::TiltX.index())
}

#[cfg(test)]
mod tests;
