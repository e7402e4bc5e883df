//! Eight balls between both races, held where they are, and how their contact forces depend on velocities.

use std::array::from_fn;

use crate::contact::{
    AXIAL, Around, EightContacts, HeldContacts, HeldElements, HeldSlope, Raise, SlicePack,
    SlicePacking, in_contact,
};
use crate::dynamics::{SideConstants, Touching, View};
use crate::model::{BodyId, DOFS, Dof, Model, Race};
use crate::simd::{LANES, Lanes, Mask, Task};

/// Contact that a ball may have with one ring.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) enum Met {
    #[default]
    Nothing,
    /// A race without a defect in reach: how it and the ball are raised.
    Whole([Raise<f64>; 2]),
    /// Perhaps a defect, or a race that is no torus: evaluated by itself.
    Alone,
}

/// Balls that touch something, up to eight; the last one fills the lanes that are left.
#[derive(Debug, Clone, Default)]
pub(super) struct HeldBalls<const N: usize> {
    /// The class of their rows.
    class: usize,
    pub balls: [usize; LANES],
    pub count: usize,
    meetings: [[Met; LANES]; 2],
    pub sides: [Side<N>; 2],
}

/// Contacts of eight balls with one ring.
#[derive(Debug, Clone, Default)]
pub(super) struct Side<const N: usize> {
    held: HeldContacts,
    nodes: HeldElements,
    /// Slices of contacts that are evaluated alone, and the numbers of these.
    packs: Vec<(usize, SlicePack)>,
    /// Contacts with slices: their lane, and what their slices share.
    singles: Vec<(usize, Around)>,
    /// Axial places of the balls, in the ring's frame.
    raised: Lanes,
    /// Whether any touches.
    pub touches: bool,
    /// Slope of force and moment on the balls, in (x, y, z, about z …) of the ring's frame.
    pub slope: HeldSlope<N>,
}

impl<const N: usize> Side<N> {
    /// Vector from the ring's centre to the balls', in the ring's frame.
    pub fn apart(&self) -> [Lanes; 3] {
        let [x, y] = self.held.apart;
        [x, y, self.raised]
    }
}

impl<const N: usize> HeldBalls<N> {
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
                side.slope = HeldSlope::default();
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
                        Met::Nothing | Met::Alone => [Raise::default(); 2],
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

    /// Finds how all contacts answer to velocities, and to places that move by so much with these \[s\].
    pub fn find_slopes(&mut self, model: &Model, views: &[View<'_>; 2], reach: f64) {
        model.instructions.run(FindSlopes {
            batch: self,
            model,
            views,
            reach,
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
            exponent: pair.law.elastic.exponent(),
            count: 0,
            contacts: &mut self.singles,
            around: self.held.around.of(lane),
            is_new: true,
        };
        pair.evaluate_into(&compiled.side, &at, &view.ring, &mut packing);
    }
}

/// Finds the nodes of whole contacts.
struct FindElements<'a> {
    class: usize,
    nodes: &'a mut HeldElements,
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
    type Output = HeldContacts;

    #[inline(always)]
    fn run<const FMA: bool>(self) -> HeldContacts {
        let mut eight = EightContacts::default();
        self.constants[self.race].eight(self.class, self.contacts, self.view, &mut eight);
        let pair = &self.model.rows[self.class].pairs[self.race];
        let ring = &self.view.ring;
        let instructions = self.model.instructions;
        let balls = self.contacts.iter().map(|contact| contact.ball);
        let turning = self.free.then(|| self.view.turning(balls));
        pair.held_elements::<FMA>(&eight, turning, ring, self.whole, instructions, self.nodes)
    }
}

/// Finds how the nodes answer.
struct FindSlopes<'a, const N: usize> {
    batch: &'a mut HeldBalls<N>,
    model: &'a Model,
    views: &'a [View<'a>; 2],
    reach: f64,
}

impl<const N: usize> Task for FindSlopes<'_, N> {
    type Output = ();

    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Self {
            batch,
            model,
            views,
            reach,
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
            let (nodes, held, sum) = (&mut side.nodes, &side.held, &mut side.slope);
            *sum = pair.slopes::<FMA, N>(nodes, held, &local, reach, model.instructions);
            pair.add_rolling_resistance::<N>(&side.held.around, sum);
            sum.turn(n_e);
            for (contact, pack) in &side.packs {
                let (lane, around) = &side.singles[*contact];
                let all = twist.map(|w| Lanes::all(w[*lane]));
                let mut part = HeldSlope::default();
                let mut local = in_contact(&all, pack.n_e);
                pack.approach(&mut local);
                let rolling = Some(&pack.rolling);
                pair.add_slope::<FMA, N>(&pack.element, rolling, around, &local, reach, &mut part);
                part.turn(pack.n_e);
                sum.gather(*lane, &part);
            }
            for (lane, around) in &side.singles {
                let n_e = n_e.map(|n| Lanes::all(n[*lane]));
                let mut part = HeldSlope::default();
                pair.add_rolling_resistance::<N>(around, &mut part);
                part.turn(n_e);
                sum.add_lane(*lane, &part);
            }
        }
    }
}
