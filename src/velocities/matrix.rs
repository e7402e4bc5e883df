//! The contacts, held at the places of a state, and the matrix of their slopes.

use super::arrow::{Arrow, EightOnRing};
use super::carrier::{Carrier, RingRotation};
use super::held_balls::{HeldBalls, Met};
use crate::base::pool;
use crate::contact::AXIAL;
use crate::dynamics::{Batch, Dynamics, Guarantees, View};
use crate::model::{BodyId, DOFS, Dof, Model, Race};
use crate::simd::{LANES, Lanes, Simd, Task, Wide};

/// Place of a velocity that is not corrected.
pub(super) const NOWHERE: usize = usize::MAX;
/// Relative change of γh up to which a matrix serves on.
const SAME: f64 = 0.2;

/// The matrix, with the memory that making it takes.
#[derive(Debug, Clone)]
pub(super) struct ContactMatrix<const N: usize> {
    /// Used to search what touches.
    search: Batch,
    /// Contacts that every ball may have with both rings.
    meetings: Vec<[Met; 2]>,
    /// The balls that meet something, by eights: the first `active` of these.
    batches: Vec<HeldBalls<N>>,
    active: usize,
    arrow: Arrow<N>,
    /// Places of velocities among those that are corrected: of eight balls by their directions (along x, y and z, about z, and turning
    /// about x and y), and of both rings by theirs (tilts in place of turning). [`NOWHERE`] where there is none.
    places: Vec<[[usize; LANES]; N]>,
    ring_places: [[usize; N]; 2],
    /// γh of the matrix, once there is one.
    kept: Option<f64>,
}

impl<const N: usize> ContactMatrix<N> {
    /// The matrix for the contacts of all rows.
    pub fn new(model: &Model) -> Self {
        let balls = model.balls.len();
        let eights = model.classes().map(|class| model.eights(class)).sum();
        Self {
            search: Batch::new(model, Guarantees::default()),
            meetings: vec![<[Met; 2]>::default(); balls],
            batches: vec![HeldBalls::default(); eights],
            active: 0,
            arrow: Arrow::new(eights),
            places: vec![[[NOWHERE; LANES]; N]; eights],
            ring_places: [[NOWHERE; N]; 2],
            kept: None,
        }
    }

    /// Finds the nodes of all contacts at a state of all bodies, as they are seen there.
    pub fn find_elements(&mut self, dynamics: &Dynamics<'_>, views: &[View<'_>; 2]) {
        let model = dynamics.current_model();
        if model.has_films_in_motion() {
            self.search.update_films(model);
        }
        self.search.find(model, views);
        self.gather(model);
        let constants = &self.search.constants;
        let find = |batch: &mut HeldBalls<N>| batch.find_elements(model, constants, views);
        let batches = &mut self.batches[..self.active];
        pool::each(dynamics.pool(), batches, find);
    }

    /// The balls that meet something, by eights of one class of rows: first those between both rings, so that others may go
    /// without one.
    fn gather(&mut self, model: &Model) {
        self.meetings.fill(<[Met; 2]>::default());
        for race in Race::BOTH {
            for contact in self.search.touching(race) {
                // Held elements are those of a torus.
                let row = &model.rows[model.balls[contact.ball].row];
                self.meetings[contact.ball][race] = if row.pairs[race].shape.is_torus() {
                    Met::Whole([contact.raise, contact.swell])
                } else {
                    Met::Alone
                };
            }
        }
        for (race, ball) in self.search.defective() {
            self.meetings[ball][race] = Met::Alone;
        }
        self.active = 0;
        for class in model.classes() {
            let mut taken = 0;
            for wanted in [2, 1] {
                for (ball, meetings) in self.meetings.iter().enumerate() {
                    let meets = |meeting: &&Met| **meeting != Met::Nothing;
                    let is_wanted = meetings.iter().filter(meets).count() == wanted;
                    if !is_wanted || model.rows[model.balls[ball].row].class != class {
                        continue;
                    }
                    let batch = &mut self.batches[self.active + taken / LANES];
                    if taken.is_multiple_of(LANES) {
                        batch.clear(class);
                    }
                    batch.push(ball, *meetings);
                    taken += 1;
                }
            }
            self.active += taken.div_ceil(LANES);
        }
    }

    /// Finds how the contacts answer to the velocities that are seen, and to places that move by so much with these \[s\].
    pub fn find_slopes(&mut self, dynamics: &Dynamics<'_>, views: &[View<'_>; 2], reach: f64) {
        let model = dynamics.current_model();
        let find = |batch: &mut HeldBalls<N>| batch.find_slopes(model, views, reach);
        let batches = &mut self.batches[..self.active];
        pool::each(dynamics.pool(), batches, find);
    }

    /// Makes the matrix of the last slopes.
    pub fn factorise(&mut self, dynamics: &Dynamics<'_>, views: &[View<'_>; 2], gamma_h: f64) {
        dynamics.model().instructions.run(Factorise {
            work: self,
            dynamics,
            views,
            gamma_h,
        });
        self.kept = Some(gamma_h);
    }

    /// Whether the matrix that is there was made for nearly the same γh.
    pub fn is_like(&self, gamma_h: f64) -> bool {
        let same = |kept: f64| (gamma_h / kept - 1.0).abs() < SAME;
        self.kept.is_some_and(same)
    }

    /// How much of the fastest velocity the matrix takes off in γh.
    pub fn stiffest(&self) -> f64 {
        self.arrow.stiffest
    }

    /// Takes over where the velocities of bodies stand among those that are corrected.
    pub fn locate(&mut self, places: &[[usize; N]]) {
        self.ring_places = Race::BOTH.map(|race| places[race.ring().index()]);
        for (eight, batch) in self.places.iter_mut().zip(&self.batches[..self.active]) {
            for (i, lanes) in eight.iter_mut().enumerate() {
                *lanes = batch
                    .balls
                    .map(|ball| places[BodyId::ball(ball).index()][i]);
            }
        }
    }

    /// Replaces residuals of velocities by their corrections; a singular matrix corrects nothing.
    pub fn correct(&mut self, model: &Model, residual: &mut [f64]) {
        model.instructions.run_wide(Correct {
            work: self,
            residual,
        });
    }
}

/// Offsets of a velocity: among those of a run, and among those of its body in a [`ContactMatrix`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Velocity {
    pub at: usize,
    pub body: BodyId,
    pub place: usize,
}

impl Velocity {
    /// The velocity of a direction, of which there is none for the rates of Euler parameters: they follow from how a ball turns.
    pub fn of(at: usize, body: BodyId, dof: Dof) -> Option<Self> {
        let place = match dof {
            Dof::TiltX | Dof::TurnX => AXIAL,
            Dof::TiltY | Dof::TurnY => AXIAL + 1,
            _ => Dof::ALL.iter().position(|known| *known == dof)?,
        };
        Some(Self { at, body, place })
    }
}

/// Makes the matrix.
struct Factorise<'a, const N: usize> {
    work: &'a mut ContactMatrix<N>,
    dynamics: &'a Dynamics<'a>,
    views: &'a [View<'a>; 2],
    gamma_h: f64,
}

impl<const N: usize> Task for Factorise<'_, N> {
    type Output = ();

    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let (dynamics, views, gamma_h) = (self.dynamics, self.views, self.gamma_h);
        let (model, mobilities) = (dynamics.model(), dynamics.mobility());
        let ContactMatrix {
            arrow,
            batches,
            active,
            ..
        } = self.work;
        arrow.begin();
        let turns = Race::BOTH.map(|race| views[race].tilted.map(RingRotation::new));
        let turning = if model.balls_turn() { gamma_h } else { 0.0 };
        for (eight, batch) in batches[..*active].iter().enumerate() {
            let mut scale = [Lanes::ZERO; N];
            for (lane, ball) in batch.balls.iter().enumerate() {
                let mobility = mobilities.of(BodyId::ball(*ball));
                for i in 0..DOFS {
                    scale[i][lane] = gamma_h * mobility[i];
                }
                for scale in &mut scale[DOFS..] {
                    // A sphere turns about all axes alike.
                    scale[lane] = turning * mobility[Dof::Theta];
                }
            }
            let contacts = Race::BOTH.map(|race| {
                let (side, turn) = (&batch.sides[race], turns[race]);
                let (slope, apart) = (&side.slope.by, side.apart());
                side.touches.then_some(EightOnRing { slope, apart, turn })
            });
            arrow.eliminate::<FMA>(eight, &contacts, &scale);
        }
        let carriers = Race::BOTH.map(|race| {
            let mobility = mobilities.of(race.ring());
            Carrier::new(model, race, mobility, &views[race], gamma_h)
        });
        let diagonal = Race::BOTH.map(|race| carriers[race].diagonal(model, race));
        arrow.factorise(&diagonal, &carriers);
    }
}

/// Solves for the corrections.
struct Correct<'a, const N: usize> {
    work: &'a mut ContactMatrix<N>,
    residual: &'a mut [f64],
}

impl<const N: usize> Wide for Correct<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { work, residual } = self;
        let ContactMatrix {
            arrow,
            batches,
            active,
            places,
            ring_places,
            ..
        } = work;
        let batches = &batches[..*active];
        arrow.begin_right();
        for (eight, places) in places[..*active].iter().enumerate() {
            let mut right = [Lanes::ZERO; N];
            for (right, lanes) in right.iter_mut().zip(places) {
                *right = Lanes::from_fn(|lane| there(residual, lanes[lane]));
            }
            arrow.eliminate_right(simd, eight, &right);
        }
        let right = ring_places.map(|places| places.map(|at| there(residual, at)));
        let Some(rings) = arrow.rings(&right) else {
            return;
        };
        let mut put = |at: usize, correction: f64| {
            if let Some(to) = residual.get_mut(at) {
                *to = correction;
            }
        };
        for (places, of) in ring_places.iter().zip(&rings) {
            for (at, correction) in places.iter().zip(of) {
                put(*at, *correction);
            }
        }
        let seen = arrow.seen(&rings);
        for (eight, (places, batch)) in places.iter().zip(batches).enumerate() {
            let balls = arrow.balls(simd, eight, &seen);
            for (places, of) in places.iter().zip(&balls) {
                for (at, correction) in places.iter().zip(of.numbers()).take(batch.count) {
                    put(*at, *correction);
                }
            }
        }
    }
}

/// The residual at a place, 0 where there is none.
fn there(residual: &[f64], at: usize) -> f64 {
    residual.get(at).copied().unwrap_or(0.0)
}
