//! Finds which balls touch which race, eight at a time.

use super::{Batch, Single, Touching, View};
use crate::contact::{HeightTable, Places, Raise};
use crate::forces::Table;
use crate::model::{BodyId, Dof, Model, Race};
use crate::simd::{LANES, Lanes, Mask, Task};

/// Neighbours of a row, up to eight.
#[derive(Debug, Clone)]
pub(super) struct Neighbours {
    pub row: usize,
    pub first: usize,
    radius: Lanes,
    /// Lanes that are balls.
    filled: Mask,
    /// Lanes of balls that have defects of their own.
    defective: Mask,
    /// Whether the balls have a texture.
    textured: bool,
}

impl Neighbours {
    pub fn new(model: &Model, row: usize, first: usize, count: usize) -> Self {
        let lane = |lane: usize| first + lane.min(count - 1);
        Self {
            row,
            first,
            radius: Lanes::from_fn(|i| model.balls[lane(i)].side.radius),
            filled: Mask::from_fn(|i| i < count),
            defective: Mask::from_fn(|i| !model.balls[lane(i)].side.defects.is_empty()),
            textured: model.has_textured_balls(&model.rows[row]),
        }
    }

    /// Textures of its balls, where they have any.
    fn tables<'m>(&self, model: &'m Model) -> Option<[&'m HeightTable; LANES]> {
        let balls = &model.balls[model.rows[self.row].balls()];
        let first = self.first - model.rows[self.row].first;
        let mut tables = [balls[first].side.waves.table()?; LANES];
        for (table, ball) in tables.iter_mut().zip(&balls[first..]) {
            *table = ball.side.waves.table()?;
        }
        Some(tables)
    }

    /// Numbers of its balls along one direction; in lanes that are left, of whatever comes next.
    #[inline(always)]
    fn lanes(&self, of: &Table, dof: Dof) -> Lanes {
        of.eight(BodyId::ball(self.first), dof)
    }

    /// The same along x, y and z.
    #[inline(always)]
    fn along(&self, of: &Table) -> [Lanes; 3] {
        [
            self.lanes(of, Dof::X),
            self.lanes(of, Dof::Y),
            self.lanes(of, Dof::Z),
        ]
    }
}

/// Finds what touches.
pub(super) struct Find<'a> {
    pub batch: &'a mut Batch,
    pub model: &'a Model,
    pub views: &'a [View<'a>; 2],
}

impl Task for Find<'_> {
    type Output = ();

    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Self {
            batch,
            model,
            views,
        } = self;
        for stretch in &batch.stretches {
            let mut lost = Mask::default();
            let class = model.rows[stretch.row].class;
            for race in Race::BOTH {
                let pair = &model.rows[stretch.row].pairs[race];
                let View { q: q_of, ring, .. } = &views[race];
                let mut q = stretch.along(q_of);
                // Cages and modes may lie on the axis, where nothing has a direction.
                q[0] = stretch.filled.choose(q[0], Lanes::all(1.0));
                let mut texture = None;
                if stretch.textured {
                    let turned = stretch.lanes(q_of, Dof::Theta);
                    texture = stretch.tables(model).map(|tables| (tables, turned));
                }
                let places = Places {
                    radius: stretch.radius,
                    q,
                    texture,
                };
                let near = pair.near::<FMA>(&places, ring);
                lost = lost.or(near.lost);
                let touching = near.touching.and(stretch.filled);
                if !touching.any() {
                    continue;
                }
                let defective = near.defective.or(stretch.defective).and(touching);
                for lane in touching.lanes() {
                    let ball = stretch.first + lane;
                    if defective.lane(lane) {
                        batch.singles.push(Single::new(race, ball));
                    } else {
                        let raise = near.raise.of(lane);
                        let mut swell = Raise::default();
                        if let Some(of) = &near.swell {
                            swell = of.of(lane);
                        }
                        let touching = Touching { ball, raise, swell };
                        batch.touching[class][race].push(touching);
                    }
                }
            }
            let lost = lost.and(stretch.filled);
            if lost.any() && batch.lost.is_none() {
                batch.lost = lost.lanes().map(|lane| stretch.first + lane).next();
            }
        }
    }
}
