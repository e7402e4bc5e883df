//! Positions and velocities of balls in the frame in which their contacts with one ring are evaluated.

use crate::contact::{Across, Motion, TiltedRing};
use crate::forces::{State, Table};
use crate::model::{BodyId, DOFS, Model, Race};
use crate::simd::{LANES, Lanes, Task};
use crate::tilt::Frame;

/// View of all balls before one ring: in the scene's frame, or in that of a ring that may tilt, where it stands still.
#[derive(Debug, Clone, Copy)]
pub(crate) struct View<'a> {
    pub q: &'a Table,
    pub v: &'a Table,
    /// The state that is viewed.
    state: &'a State,
    pub ring: Motion,
    /// The view of the ring that tilts; none where rings stand parallel.
    pub tilted: Option<&'a RingView>,
}

impl<'a> View<'a> {
    /// Both rings of a state in which they stand parallel.
    pub fn parallel(state: &'a State) -> [Self; 2] {
        Race::BOTH.map(|race| Self::of_parallel(state, race))
    }

    /// The view of a ring that stands parallel.
    fn of_parallel(state: &'a State, race: Race) -> Self {
        Self {
            q: &state.q,
            v: &state.v,
            state,
            ring: state.motion(race.ring()),
            tilted: None,
        }
    }

    /// Angular velocity of a ball across the ring's axis, along x and y \[rad/s\].
    #[inline]
    pub fn across(&self, ball: BodyId) -> [f64; 2] {
        self.tilted.map_or([0.0; 2], |of| {
            [of.across[0][ball.index()], of.across[1][ball.index()]]
        })
    }

    /// The same of eight balls.
    pub fn turning(&self, balls: impl Iterator<Item = usize>) -> Across {
        let mut turning = [Lanes::ZERO; 2];
        if let Some(of) = self.tilted {
            for (lane, ball) in balls.enumerate() {
                let body = BodyId::ball(ball).index();
                turning[0][lane] = of.across[0][body];
                turning[1][lane] = of.across[1][body];
            }
        }
        turning
    }

    /// A ball.
    pub fn ball(&self, ball: usize) -> Motion {
        let motion = self.state.motion(BodyId::ball(ball));
        match self.tilted {
            None => motion,
            Some(tilted) => tilted.ring.facing(&motion)[0],
        }
    }
}

/// View of all balls in the frame of a ring that may tilt.
#[derive(Debug)]
pub(crate) struct RingView {
    race: Race,
    /// Whether balls are turned into its frame: not before a ring that stays parallel, if they spin about the axis.
    tilts: bool,
    /// The ring as it stands.
    pub ring: TiltedRing,
    q: Table,
    /// The rings' own are 0.
    v: Table,
    /// Angular velocities of all bodies across the axis, along x and y \[rad/s\].
    across: [Vec<f64>; 2],
}

impl RingView {
    /// Views of both rings; none where nothing turns about x or y.
    pub fn both(model: &Model) -> Option<[Self; 2]> {
        let (bodies, state) = (model.bodies.len(), State::new(model));
        let of = |race| Self {
            race,
            tilts: model.balls_turn() || model.ring_tilts(race),
            ring: state.tilted(model, race),
            q: Table::zeros(bodies),
            v: Table::zeros(bodies),
            across: [(); 2].map(|()| vec![0.0; bodies + LANES]),
        };
        model.is_spatial().then(|| Race::BOTH.map(of))
    }

    /// Turns all balls of a state into the frames of both rings.
    pub fn look<'a>(both: &'a mut [Self; 2], model: &Model, state: &'a State) -> [View<'a>; 2] {
        for view in &mut *both {
            view.ring = state.tilted(model, view.race);
        }
        model.instructions.run(Look { both, state });
        both.each_ref().map(|ring| ring.view(state))
    }

    /// The view that contacts have.
    pub fn view<'a>(&'a self, state: &'a State) -> View<'a> {
        if !self.tilts {
            return View::of_parallel(state, self.race);
        }
        View {
            q: &self.q,
            v: &self.v,
            state,
            ring: self.ring.standing(),
            tilted: Some(self),
        }
    }

    /// Whether the row's balls spin freely.
    pub fn balls_turn(&self) -> bool {
        self.ring.balls_turn()
    }

    /// The ring's frame.
    pub fn frame(&self) -> &Frame {
        &self.ring.rotation.frame
    }
}

/// Turns all balls into the frames of both rings, eight at a time.
struct Look<'a> {
    both: &'a mut [RingView; 2],
    state: &'a State,
}

impl Task for Look<'_> {
    type Output = ();

    #[inline(always)]
    fn run<const FMA: bool>(self) {
        for view in self.both.iter_mut().filter(|view| view.tilts) {
            view.turn::<FMA>(self.state);
        }
    }
}

impl RingView {
    /// Turns all balls into this ring's frame.
    #[inline(always)]
    fn turn<const FMA: bool>(&mut self, state: &State) {
        let State { q, v, .. } = state;
        let ([x, y, z, theta], [vx, vy, vz, omega]) = (q.directions(), v.directions());
        let bodies = x.len() - LANES;
        let (to_q, to_v) = (self.q.directions_mut(), self.v.directions_mut());
        let [across_x, across_y] = &mut self.across;
        for first in (BodyId::ball(0).index()..bodies).step_by(LANES) {
            let of = |from: &[f64]| Lanes::from_slice(&from[first..]);
            let places = [of(x), of(y), of(z)];
            let velocities = [of(vx), of(vy), of(vz)];
            let mut spins = [Lanes::ZERO, Lanes::ZERO, of(omega)];
            if let Some([x, y]) = state.across() {
                (spins[0], spins[1]) = (of(x), of(y));
            }
            let [places, velocities, spins] = self.ring.see::<_, FMA>(places, velocities, spins);
            for k in 0..3 {
                places[k].to_slice(&mut to_q[k][first..]);
                velocities[k].to_slice(&mut to_v[k][first..]);
            }
            of(theta).to_slice(&mut to_q[DOFS - 1][first..]);
            spins[2].to_slice(&mut to_v[DOFS - 1][first..]);
            spins[0].to_slice(&mut across_x[first..]);
            spins[1].to_slice(&mut across_y[first..]);
        }
    }
}
