//! Eight balls of an implicit stage between both races, ready for any velocities.

use std::array::from_fn;

use nalgebra::Vector3;

use crate::contact::{
    AXIAL, Around, EightContacts, FREE, PlaneVector, Raise, SlicePack, SlicePacking, Slopes,
    StageContacts, StageElements, StageWrench, V2, Wrench, in_contact,
};
use crate::dynamics::{SideConstants, Touching, View};
use crate::model::{BodyId, DOFS, Dof, Model, Race};
use crate::simd::{LANES, Lanes, Mask, Task};

/// What a ball may meet at one ring.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) enum Met {
    #[default]
    Nothing,
    /// A race without a defect in reach: how it and the ball are raised.
    Whole([Raise<f64>; 2]),
    /// Perhaps a defect: evaluated alone.
    Faulted,
}

/// Up to eight balls that touch something; the last one fills the lanes that are left.
#[derive(Debug, Clone, Default)]
pub(super) struct StageBatch<const N: usize> {
    /// The class of their rows.
    class: usize,
    pub balls: [usize; LANES],
    pub count: usize,
    meetings: [[Met; LANES]; 2],
    pub sides: [Side<N>; 2],
}

/// Their contacts with one ring.
#[derive(Debug, Clone, Default)]
pub(super) struct Side<const N: usize> {
    held: StageContacts,
    nodes: StageElements,
    /// Slices of contacts that are evaluated alone, and the numbers of these.
    packs: Vec<(usize, SlicePack)>,
    /// These contacts: their lane, and what their slices share.
    singles: Vec<(usize, Around)>,
    /// Axial places of the balls, in the ring's frame.
    raised: Lanes,
    /// Forces on the balls that do not depend on velocities, of waves and of the ends of defects: (x, y, z, about z …).
    aside: [Lanes; FREE],
    /// Whether any touches.
    pub touches: bool,
    /// Force and moment on the balls, in (x, y, z, about z …) of the ring's frame, with slopes.
    pub wrenches: StageWrench<N>,
    /// Of the moments what turns caps of the balls across the ring's axis.
    pub on_caps: PlaneVector,
}

impl<const N: usize> Side<N> {
    /// From the ring's centre to the balls', in the ring's frame.
    pub fn apart(&self) -> [Lanes; 3] {
        let [x, y] = self.held.apart;
        [x, y, self.raised]
    }

    /// What one of them does to its ball, where that is, and what of the moment turns its caps across the ring's axis.
    pub fn of(&self, lane: usize) -> (Wrench, Vector3<f64>, V2) {
        let number = |i: usize| self.wrenches.wrench.get(i).map_or(0.0, |of| of[lane]);
        let wrench = Wrench {
            force: Vector3::new(number(0), number(1), number(2)),
            moment: Vector3::new(number(AXIAL), number(AXIAL + 1), number(3)),
        };
        let [x, y] = self.on_caps;
        let place = self.apart().map(|along| along[lane]);
        (wrench, place.into(), V2::new(x[lane], y[lane]))
    }
}

impl<const N: usize> StageBatch<N> {
    /// Empties it, for balls of a class of rows.
    pub fn clear(&mut self, class: usize) {
        (self.class, self.count) = (class, 0);
        self.meetings = [[Met::Nothing; LANES]; 2];
    }

    /// Takes another ball.
    pub fn push(&mut self, ball: usize, meetings: [Met; 2]) {
        self.balls[self.count..].fill(ball);
        for (lanes, meeting) in self.meetings.iter_mut().zip(meetings) {
            lanes[self.count] = meeting;
        }
        self.count += 1;
    }

    /// Finds the nodes of all contacts at the places of a state.
    pub fn find_elements(
        &mut self,
        model: &Model,
        constants: &[SideConstants; 2],
        views: &[View<'_>; 2],
    ) {
        for race in Race::BOTH {
            let meetings = self.meetings[race];
            let side = &mut self.sides[race];
            side.nodes.clear();
            side.packs.clear();
            side.singles.clear();
            side.touches = meetings.iter().any(|m| *m != Met::Nothing);
            if !side.touches {
                side.wrenches = StageWrench::default();
                continue;
            }
            let whole = |lane: usize| matches!(meetings[lane], Met::Whole(_));
            side.held = model.instructions.run(FindElements {
                class: self.class,
                nodes: &mut side.nodes,
                race,
                contacts: &from_fn(|lane| {
                    let [raise, swell] = match meetings[lane] {
                        Met::Whole(raises) => raises,
                        Met::Nothing | Met::Faulted => [Raise::default(); 2],
                    };
                    let ball = self.balls[lane];
                    Touching { ball, raise, swell }
                }),
                whole: Mask::from_fn(whole),
                constants,
                model,
                view: &views[race],
                free: N > AXIAL,
            });
            side.aside = [Lanes::ZERO; FREE];
            side.aside[..AXIAL].copy_from_slice(&side.held.aside);
            let View { q, ring, .. } = &views[race];
            let place = |ball: usize| q.get(BodyId::ball(ball), Dof::Z) - ring.z;
            side.raised = Lanes::from_fn(|lane| place(self.balls[lane]));
            for (lane, ball) in self.balls[..self.count].iter().enumerate() {
                if meetings[lane] != Met::Nothing && !side.held.regular.lane(lane) {
                    side.single(lane, model, *ball, race, &views[race]);
                }
            }
        }
    }

    /// Finds what all contacts do at some velocities.
    pub fn forces(&mut self, model: &Model, views: &[View<'_>; 2]) {
        model.instructions.run(StageForces::<N, false> {
            batch: self,
            model,
            views,
            slopes: Slopes::default(),
        });
    }

    /// The same with the slopes; see [`crate::contact::Pair::force`].
    pub fn forces_and_slopes(&mut self, model: &Model, views: &[View<'_>; 2], slopes: Slopes) {
        model.instructions.run(StageForces::<N, true> {
            batch: self,
            model,
            views,
            slopes,
        });
    }
}

impl<const N: usize> Side<N> {
    /// The slices of a contact that is evaluated alone.
    fn single(&mut self, lane: usize, model: &Model, ball: usize, race: Race, view: &View<'_>) {
        let compiled = &model.balls[ball];
        let pair = &model.rows[compiled.row].pairs[race];
        let at = view.ball(ball);
        let mut packing = SlicePacking {
            lane,
            packs: &mut self.packs,
            outwards: at.seen_from(&view.ring).centre.normalize(),
            aside: [0.0; FREE],
            exponent: pair.law.elastic.exponent(),
            count: 0,
            contacts: &mut self.singles,
            around: self.held.around.of(lane),
            is_new: true,
        };
        pair.evaluate_into(&compiled.side, &at, &view.ring, &mut packing);
        for (sum, part) in self.aside.iter_mut().zip(packing.aside) {
            sum[lane] += part;
        }
    }
}

/// Finds the nodes of whole contacts.
struct FindElements<'a> {
    class: usize,
    nodes: &'a mut StageElements,
    race: Race,
    contacts: &'a [Touching; LANES],
    whole: Mask,
    constants: &'a [SideConstants; 2],
    model: &'a Model,
    view: &'a View<'a>,
    /// Whether balls spin freely.
    free: bool,
}

impl Task for FindElements<'_> {
    type Output = StageContacts;

    // Compiled for the instruction set that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn run<const FMA: bool>(self) -> StageContacts {
        let mut eight = EightContacts::default();
        self.constants[self.race].eight(self.class, self.contacts, self.view, &mut eight);
        let pair = &self.model.rows[self.class].pairs[self.race];
        let ring = &self.view.ring;
        let instructions = self.model.instructions;
        let balls = self.contacts.iter().map(|contact| contact.ball);
        let turning = self.free.then(|| self.view.turning(balls));
        let of = (&eight, turning);
        pair.stage_elements::<FMA>(of, ring, self.whole, instructions, self.nodes)
    }
}

/// Finds what the nodes do.
struct StageForces<'a, const N: usize, const SLOPE: bool> {
    batch: &'a mut StageBatch<N>,
    model: &'a Model,
    views: &'a [View<'a>; 2],
    slopes: Slopes,
}

impl<const N: usize, const SLOPE: bool> Task for StageForces<'_, N, SLOPE> {
    type Output = ();

    // Compiled for the instruction set that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Self {
            batch,
            model,
            views,
            slopes,
        } = self;
        for race in Race::BOTH {
            let side = &mut batch.sides[race];
            if !side.touches {
                continue;
            }
            let (n_e, apart) = (side.held.n_e, side.held.apart);
            let pair = &model.rows[batch.class].pairs[race];
            let view = &views[race];
            let ring = view.v.of(race.ring());
            let mut twist = [Lanes::ZERO; N];
            for (lane, ball) in batch.balls.iter().enumerate() {
                let ball = BodyId::ball(*ball);
                let v = view.v.of(ball);
                for i in 0..DOFS {
                    twist[i][lane] = v[i];
                }
                if N > AXIAL {
                    for (i, across) in view.across(ball).into_iter().enumerate() {
                        twist[AXIAL + i][lane] = across;
                    }
                }
            }
            // w = v_b − v_r − θ̇_r ẑ × a.
            twist[0] = twist[0] - ring[0] + apart[1] * ring[3];
            twist[1] = twist[1] - ring[1] - apart[0] * ring[3];
            twist[2] = twist[2] - ring[2];
            twist[3] = twist[3] - ring[3];
            let local = in_contact(&twist, n_e);
            let held = (&mut side.nodes, &side.held);
            let found =
                pair.stage_forces::<FMA, SLOPE, N>(held, &local, slopes, model.instructions);
            let sum = &mut side.wrenches;
            sum.wrench = found.wrench;
            if SLOPE {
                sum.slope = found.slope;
            }
            pair.rolling_resistance::<SLOPE, N>(&side.held.around, &local, sum);
            sum.turn::<SLOPE>(n_e);
            for (wrench, aside) in sum.wrench.iter_mut().zip(side.aside) {
                *wrench += aside;
            }
            if N > AXIAL {
                side.on_caps.copy_from_slice(&side.aside[AXIAL..]);
            }
            for (contact, pack) in &side.packs {
                let (lane, around) = &side.singles[*contact];
                let all = twist.map(|w| Lanes::all(w[*lane]));
                let mut part = StageWrench::default();
                let mut local = in_contact(&all, pack.n_e);
                pack.approach(&mut local);
                let element = (&pack.element, Some(&pack.rolling));
                pair.force::<FMA, SLOPE, N>(element, around, &local, slopes, &mut part);
                let [along, across] = pack.swing(&mut part.wrench);
                let [n_x, n_y] = pack.n_e;
                side.on_caps[0][*lane] += (along * n_x - across * n_y).sum();
                side.on_caps[1][*lane] += (along * n_y + across * n_x).sum();
                part.turn::<SLOPE>(pack.n_e);
                sum.gather::<SLOPE>(*lane, &part);
            }
            for (lane, around) in &side.singles {
                let all = twist.map(|w| Lanes::all(w[*lane]));
                let n_e = n_e.map(|n| Lanes::all(n[*lane]));
                let mut part = StageWrench::default();
                pair.rolling_resistance::<SLOPE, N>(around, &in_contact(&all, n_e), &mut part);
                part.turn::<SLOPE>(n_e);
                sum.add_lane::<SLOPE>(*lane, &part);
            }
        }
    }
}
