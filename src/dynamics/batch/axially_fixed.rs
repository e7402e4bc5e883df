//! Rows whose balls keep their axial places and touch both races in closed form: one loop along the balls.

use super::{Guarantees, Single, View};
use crate::contact::{AngularReach, AxiallyFixedBalls, AxiallyFixedRace, InPlane, Pair};
use crate::forces::Table;
use crate::model::{BodyId, DOFS, Dof, Model, Race};
use crate::simd::{LANES, Simd, Vector, Wide};

/// A row and what its contacts need.
#[derive(Debug, Clone)]
pub(super) struct AxiallyFixedRow {
    row: usize,
    /// The row's first ball among all.
    first: usize,
    count: usize,
    races: [AxiallyFixedSide; 2],
    must_look: bool,
}

#[derive(Debug, Clone)]
struct AxiallyFixedSide {
    form: InPlane,
    /// 1 for each ball whose contact no defect can reach, 0 for the others.
    whole: Vec<f64>,
    /// Height of the race's waves under each ball, and their slope R'(φ) \[m\].
    raise: Vec<f64>,
    slope: Vec<f64>,
}

impl AxiallyFixedRow {
    /// The row; none where a contact has no closed form.
    pub fn new(model: &Model, row: usize, kind: &Guarantees) -> Option<Self> {
        let compiled = &model.rows[row];
        let balls = compiled.balls();
        let radius = model.balls[compiled.first].side.radius;
        let alike = |j: usize| model.balls[j].side.radius == radius;
        if !kind.closed || !balls.clone().all(alike) || model.has_textured_balls(compiled) {
            return None;
        }
        let padded = compiled.count.next_multiple_of(LANES);
        let side = |race: Race| {
            let offset = kind.offset(model, row, race)?;
            Some(AxiallyFixedSide {
                form: InPlane::new(&compiled.pairs[race], radius, offset)?,
                whole: vec![1.0; padded],
                raise: vec![0.0; padded],
                slope: vec![0.0; padded],
            })
        };
        Some(Self {
            row,
            first: compiled.first,
            count: compiled.count,
            races: [side(Race::Outer)?, side(Race::Inner)?],
            must_look: compiled
                .pairs
                .iter()
                .any(|pair| !pair.waves.is_round() || !pair.defects.is_empty())
                || balls
                    .clone()
                    .any(|j| !model.balls[j].side.defects.is_empty()),
        })
    }

    pub fn row(&self) -> usize {
        self.row
    }

    /// The row's number and the forms for both races, if these are round and nothing has a defect.
    pub fn plain(&self) -> Option<(usize, [InPlane; 2])> {
        let forms = || self.races.each_ref().map(|side| side.form.clone());
        (!self.must_look).then(|| (self.row, forms()))
    }

    /// Whether the row's races are anywhere raised by waves, or something has defects.
    pub fn must_look(&self) -> bool {
        self.must_look
    }

    /// Notes where waves raise the races and where defects may be seen.
    // Inlined into the evaluation it would slow down rows without waves and defects.
    #[inline(never)]
    pub fn look(&mut self, model: &Model, views: &[View<'_>; 2]) {
        let row = &model.rows[self.row];
        for ((side, pair), view) in self.races.iter_mut().zip(&row.pairs).zip(views) {
            let (balls, ring) = (row.balls(), &view.ring);
            let seen = |j: usize| view.ball(j).seen_from(ring);
            for (j, whole) in balls.clone().zip(&mut side.whole) {
                *whole = f64::from(model.balls[j].side.defects.is_empty());
            }
            if !pair.waves.is_round() {
                for (j, (height, slope)) in balls.zip(side.raise.iter_mut().zip(&mut side.slope)) {
                    let raise = pair.waves.raise(ring.angle_of(seen(j).direction()));
                    (*height, *slope) = (raise.height, raise.slope);
                }
            }
            for defect in &pair.defects {
                let AngularReach { middle, bound } = defect.angular_reach(ring.theta);
                let balls = row.balls();
                for (j, whole) in balls.zip(&mut side.whole) {
                    let apart = seen(j).centre;
                    if apart.x * middle[0] + apart.y * middle[1] > bound * apart.norm() {
                        *whole = 0.0;
                    }
                }
            }
        }
    }
}

/// Results of the evaluation of a row besides the forces on its balls.
pub(super) struct AxiallyFixedSums<'a> {
    /// Forces on the two rings.
    pub rings: &'a mut [[f64; DOFS]; 2],
    /// Contacts that are left to be evaluated one by one.
    pub singles: &'a mut Vec<Single>,
    /// Slices whose damping wanted to pull.
    pub pulls: &'a mut u32,
    /// The first ball that has left its groove.
    pub lost: &'a mut Option<usize>,
}

/// Evaluates a row.
pub(super) struct EvaluateAxiallyFixed<'a> {
    pub row: &'a AxiallyFixedRow,
    pub pairs: &'a [Pair; 2],
    pub views: &'a [View<'a>; 2],
    pub forces: &'a mut Table,
    pub sums: AxiallyFixedSums<'a>,
}

impl Wide for EvaluateAxiallyFixed<'_> {
    type Output = ();

    // Compiled for the instruction set that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let middle = self.row.races.iter().all(|side| side.form.is_middle());
        match (self.row.must_look, middle) {
            (false, false) => self.all::<S, false, false>(simd),
            (false, true) => self.all::<S, false, true>(simd),
            (true, false) => self.all::<S, true, false>(simd),
            (true, true) => self.all::<S, true, true>(simd),
        }
    }
}

impl EvaluateAxiallyFixed<'_> {
    /// Sums over all balls; `LOOK` where one of their races is raised, or a surface not whole; `MIDDLE` where they are in the
    /// middle of both grooves.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn all<S: Simd, const LOOK: bool, const MIDDLE: bool>(self, simd: S) {
        let Self {
            row,
            pairs,
            views,
            forces,
            sums,
        } = self;
        let (zero, one) = (Vector::all(simd, 0.0), Vector::all(simd, 1.0));
        let [outer, inner] = &row.races;
        let races = [
            AxiallyFixedRace::new(simd, &pairs[0], &outer.form, &views[0].ring),
            AxiallyFixedRace::new(simd, &pairs[1], &inner.form, &views[1].ring),
        ];
        let mut on_rings = [[zero; 3]; 2];
        let mut pulls = [zero; 2];
        let [x, y, ..] = views[0].q.directions();
        let [vx, vy, ..] = views[0].v.directions();
        let [fx, fy, ..] = forces.directions_mut();
        for at in (0..row.count).step_by(Vector::<S>::LANES) {
            let body = BodyId::ball(row.first + at).index();
            let there = Vector::count(simd).below(Vector::all(simd, (row.count - at) as f64));
            let balls = AxiallyFixedBalls {
                // What stands behind the balls, cages and modes, may lie on the axis, where nothing has a direction.
                x: there.choose(Vector::load(simd, &x[body..]), one),
                y: Vector::load(simd, &y[body..]),
                vx: Vector::load(simd, &vx[body..]),
                vy: Vector::load(simd, &vy[body..]),
                raise: zero,
                slope: None,
                whole: Some(there),
            };
            let mut sides = [balls; 2];
            if LOOK {
                for (balls, race) in sides.iter_mut().zip(&row.races) {
                    balls.raise = Vector::load(simd, &race.raise[at..]);
                    balls.slope = Some(Vector::load(simd, &race.slope[at..]));
                    let whole = zero.below(Vector::load(simd, &race.whole[at..]));
                    balls.whole = Some(whole.and(there));
                }
            }
            let found = [
                races[0].forces::<MIDDLE>(&sides[0]),
                races[1].forces::<MIDDLE>(&sides[1]),
            ];
            let [outer, inner] = &found;
            for (along, force) in [(&mut *fx, outer.x + inner.x), (&mut *fy, outer.y + inner.y)] {
                let to = &mut along[body..];
                (Vector::load(simd, to) + force).store(to);
            }
            for race in Race::BOTH {
                on_rings[race][0] += found[race].x;
                on_rings[race][1] += found[race].y;
                if LOOK {
                    on_rings[race][2] += found[race].moment;
                }
                pulls[race] += found[race].pulls.choose(one, zero);
            }
            if outer.left_out.or(inner.left_out).and(there).any() {
                let ball = |lane: usize| row.first + at + lane;
                for race in Race::BOTH {
                    let of = &found[race];
                    let left_out = of.left_out.and(there).lanes();
                    let singles = left_out.map(|lane| Single::new(race, ball(lane)));
                    sums.singles.extend(singles);
                    let lost = races[race].lost(of).and(there).lanes().next();
                    *sums.lost = sums.lost.or(lost.map(ball));
                }
            }
        }
        for race in Race::BOTH {
            let [x, y, moment] = on_rings[race];
            sums.rings[race][Dof::X] -= x.sum();
            sums.rings[race][Dof::Y] -= y.sum();
            sums.rings[race][Dof::Theta] -= moment.sum();
            // A count that fits: at most a thousand balls.
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let pulls = pulls[race].sum() as u32;
            *sums.pulls += pulls * pairs[race].slices.count();
        }
    }
}
