//! Rows whose balls keep their axial places and touch both races in closed form: one loop along the balls.

use std::array::from_fn;

use super::{Kind, Single};
use crate::contact::{InPlane, LevelBalls, LevelRace, Motion, Pair, Sight};
use crate::dynamics::state::{State, Table};
use crate::model::Model;
use crate::simd::{LANES, Simd, Vector, Wide};

/// A row and what its contacts need.
#[derive(Debug, Clone)]
pub(super) struct LevelRow {
    row: usize,
    /// Its first ball among all.
    first: usize,
    count: usize,
    /// 1 for a ball, 0 for what is left of the last register.
    there: Vec<f64>,
    races: [LevelSide; 2],
    must_look: bool,
}

#[derive(Debug, Clone)]
struct LevelSide {
    form: InPlane,
    /// 1 where ball and race are whole.
    whole: Vec<f64>,
    /// Raise of the race under the balls \[m\].
    raise: Vec<f64>,
}

impl LevelRow {
    /// None where a contact has no closed form.
    pub fn new(model: &Model, row: usize, kind: &Kind) -> Option<Self> {
        let compiled = &model.rows[row];
        let balls = compiled.first..compiled.first + compiled.count;
        let radius = model.balls[compiled.first].side.radius;
        let alike = |j: usize| model.balls[j].side.radius == radius;
        if !kind.closed || !balls.clone().all(alike) {
            return None;
        }
        let padded = compiled.count.next_multiple_of(LANES);
        let of = |value: fn(&Model, usize) -> bool| -> Vec<f64> {
            (0..padded)
                .map(|k| f64::from(k < compiled.count && value(model, compiled.first + k)))
                .collect()
        };
        let side = |side: usize| {
            let offset = kind.offset(model, row, side)?;
            Some(LevelSide {
                form: InPlane::new(&compiled.pairs[side], radius, offset)?,
                whole: of(|model, j| model.balls[j].side.faults.is_empty()),
                raise: vec![0.0; padded],
            })
        };
        Some(Self {
            row,
            first: compiled.first,
            count: compiled.count,
            there: of(|_, _| true),
            races: [side(0)?, side(1)?],
            must_look: compiled
                .pairs
                .iter()
                .any(|pair| !pair.waves.is_round() || !pair.faults.is_empty()),
        })
    }

    pub fn row(&self) -> usize {
        self.row
    }

    /// Whether its races are anywhere raised by waves, or have defects.
    pub fn must_look(&self) -> bool {
        self.must_look
    }

    /// Notes where waves raise the races and where defects may be seen.
    // Taken into the evaluation it would burden those that do without.
    #[inline(never)]
    pub fn look(&mut self, model: &Model, state: &State, rings: &[Motion; 2]) {
        let row = &model.rows[self.row];
        for ((side, pair), ring) in self.races.iter_mut().zip(&row.pairs).zip(rings) {
            let balls = row.first..row.first + row.count;
            let apart = |j: usize| state.motion(2 + j).centre - ring.centre;
            for (j, (raise, whole)) in balls.zip(side.raise.iter_mut().zip(&mut side.whole)) {
                if !pair.waves.is_round() {
                    *raise = pair.waves.at(apart(j).y.atan2(apart(j).x) - ring.theta);
                }
                *whole = f64::from(model.balls[j].side.faults.is_empty());
            }
            for fault in &pair.faults {
                let Sight { middle, bound } = fault.sight(ring.theta);
                let balls = row.first..row.first + row.count;
                for (j, whole) in balls.zip(&mut side.whole) {
                    let apart = apart(j);
                    if apart.x * middle[0] + apart.y * middle[1] > bound * apart.norm() {
                        *whole = 0.0;
                    }
                }
            }
        }
    }
}

/// What the contacts of a row have told, besides the forces on the balls.
pub(super) struct LevelSums<'a> {
    /// On the two rings.
    pub rings: &'a mut [[f64; 4]; 2],
    /// Contacts that are left to be evaluated one by one.
    pub singles: &'a mut Vec<Single>,
    /// Slices whose damping wanted to pull.
    pub pulls: &'a mut u32,
    /// The first ball that has left its groove.
    pub lost: &'a mut Option<usize>,
}

/// Evaluates a row.
pub(super) struct EvaluateLevel<'a> {
    pub row: &'a LevelRow,
    pub pairs: &'a [Pair; 2],
    pub state: &'a State,
    pub rings: &'a [Motion; 2],
    pub forces: &'a mut Table,
    pub sums: LevelSums<'a>,
}

impl Wide for EvaluateLevel<'_> {
    type Output = ();

    // Compiled for the level that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            row,
            pairs,
            state,
            rings,
            forces,
            sums,
        } = self;
        let zero = Vector::all(simd, 0.0);
        let races: [LevelRace<'_, S>; 2] =
            from_fn(|side| LevelRace::new(simd, &pairs[side], &row.races[side].form, &rings[side]));
        let mut on_rings = [[zero; 2]; 2];
        let mut pulls = [zero; 2];
        let from = 2 + row.first;
        let count = row.count.div_ceil(Vector::<S>::LANES);
        let all = |of| Vector::<S>::registers(of, count);
        let [x, y, ..] = state.q.directions().map(|of| all(&of[from..]));
        let [vx, vy, ..] = state.v.directions().map(|of| all(&of[from..]));
        let [fx, fy, ..] = forces
            .directions_mut()
            .map(|of| Vector::<S>::registers_mut(&mut of[from..], count));
        let there = all(&row.there);
        let raise = [0, 1].map(|side: usize| all(&row.races[side].raise));
        let whole = [0, 1].map(|side: usize| all(&row.races[side].whole));
        for i in 0..count {
            let load = |of: &[S::f64s]| Vector::of(simd, of[i]);
            let [x, y, vx, vy] = [load(x), load(y), load(vx), load(vy)];
            let there = zero.below(load(there));
            let mut on_balls = [zero; 2];
            for (side, race) in races.iter().enumerate() {
                let found = race.press(&LevelBalls {
                    x,
                    y,
                    vx,
                    vy,
                    raise: load(raise[side]),
                    whole: zero.below(load(whole[side])),
                });
                for (i, force) in [found.x, found.y].into_iter().enumerate() {
                    on_balls[i] += force;
                    on_rings[side][i] += force;
                }
                pulls[side] += found.pulls.choose(Vector::all(simd, 1.0), zero);
                let (careful, lost) = (found.careful.and(there), found.lost.and(there));
                if careful.or(lost).any() {
                    let ball = |lane: usize| row.first + i * Vector::<S>::LANES + lane;
                    let singles = careful.lanes().map(|lane| Single::new(side, ball(lane)));
                    sums.singles.extend(singles);
                    *sums.lost = sums.lost.or_else(|| lost.lanes().next().map(ball));
                }
            }
            (load(fx) + on_balls[0]).put(&mut fx[i]);
            (load(fy) + on_balls[1]).put(&mut fy[i]);
        }
        for (side, [x, y]) in on_rings.into_iter().enumerate() {
            sums.rings[side][0] -= x.sum();
            sums.rings[side][1] -= y.sum();
            // A count that fits: at most a thousand balls.
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let pulls = pulls[side].sum() as u32;
            *sums.pulls += pulls * pairs[side].slices.count();
        }
    }
}
