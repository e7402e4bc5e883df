//! States and sums of forces of all bodies, one array for each direction.

use crate::contact::{Motion, TiltedRing, V2};
use crate::model::{BodyId, DOFS, Dof, Layout, Model, Race};
use crate::simd::{LANES, Lanes};

/// A number a body along x, y, z and about z, each direction padded so that eight neighbours can be read from any
/// body.
#[derive(Debug, Clone)]
pub(crate) struct Table {
    values: Vec<f64>,
    stride: usize,
}

impl Table {
    pub fn zeros(bodies: usize) -> Self {
        let stride = bodies + LANES;
        Self {
            values: vec![0.0; DOFS * stride],
            stride,
        }
    }

    /// Takes over another one of the same size.
    pub fn copy_from(&mut self, other: &Self) {
        self.values.copy_from_slice(&other.values);
    }

    /// Values of all bodies, along one direction.
    #[inline(always)]
    pub fn along(&self, dof: Dof) -> &[f64] {
        &self.values[dof.index() * self.stride..][..self.stride]
    }

    #[inline(always)]
    pub fn along_mut(&mut self, dof: Dof) -> &mut [f64] {
        &mut self.values[dof.index() * self.stride..][..self.stride]
    }

    /// Values of all bodies, direction by direction.
    #[inline(always)]
    pub fn directions(&self) -> [&[f64]; DOFS] {
        [
            self.along(Dof::X),
            self.along(Dof::Y),
            self.along(Dof::Z),
            self.along(Dof::Theta),
        ]
    }

    #[inline(always)]
    pub fn directions_mut(&mut self) -> [&mut [f64]; DOFS] {
        let mut chunks = self.values.chunks_exact_mut(self.stride);
        std::array::from_fn(|_| chunks.next().unwrap_or_default())
    }

    /// Place of a body's number in a direction, the same in all tables of as many bodies.
    #[inline(always)]
    pub fn slot(&self, body: BodyId, dof: Dof) -> usize {
        dof.index() * self.stride + body.index()
    }

    /// The number at a [`Table::slot`].
    #[inline(always)]
    pub fn at(&self, slot: usize) -> f64 {
        self.values[slot]
    }

    #[inline(always)]
    pub fn at_mut(&mut self, slot: usize) -> &mut f64 {
        &mut self.values[slot]
    }

    #[inline(always)]
    pub fn get(&self, body: BodyId, dof: Dof) -> f64 {
        self.at(self.slot(body, dof))
    }

    #[inline(always)]
    pub fn get_mut(&mut self, body: BodyId, dof: Dof) -> &mut f64 {
        let slot = self.slot(body, dof);
        self.at_mut(slot)
    }

    /// The numbers of a body.
    #[inline(always)]
    pub fn of(&self, body: BodyId) -> [f64; DOFS] {
        [
            self.get(body, Dof::X),
            self.get(body, Dof::Y),
            self.get(body, Dof::Z),
            self.get(body, Dof::Theta),
        ]
    }

    #[inline(always)]
    pub fn add(&mut self, body: BodyId, numbers: &[f64; DOFS]) {
        for (direction, number) in numbers.iter().enumerate() {
            self.values[direction * self.stride + body.index()] += number;
        }
    }

    /// Eight neighbours.
    #[inline(always)]
    pub fn eight(&self, first: BodyId, dof: Dof) -> Lanes {
        Lanes::from_slice(&self.values[dof.index() * self.stride + first.index()..][..LANES])
    }

    /// Reads a half of a state vector as `Model` orders it, body by body.
    pub fn read(&mut self, half: &[f64]) {
        let bodies = self.stride - LANES;
        for (body, numbers) in Layout::each(half)[..bodies].iter().enumerate() {
            for (direction, number) in numbers.iter().enumerate() {
                self.values[direction * self.stride + body] = *number;
            }
        }
    }

    /// Writes what [`Table::read`] reads.
    fn write(&self, half: &mut [f64]) {
        let bodies = self.stride - LANES;
        let halves = Layout::each_mut(half)[..bodies].iter_mut();
        for (body, numbers) in halves.enumerate() {
            *numbers = self.of(BodyId::new(body));
        }
    }
}

/// Places and motions of all bodies.
#[derive(Debug, Clone)]
pub(crate) struct State {
    pub q: Table,
    pub v: Table,
    /// Offsets of the tilts of rings and of the rotations of balls that spin freely; none without either.
    layout: Option<Layout>,
    /// Tilt of each ring \[rad\] and its rates \[rad/s\].
    tilts: [[[f64; 2]; 2]; 2],
    /// Angular velocities about x and y of all bodies, padded like a table, where balls spin freely \[rad/s\].
    across: Option<[Vec<f64>; 2]>,
    /// Euler parameters of the balls that have them, and their rates \[1/s\].
    attitudes: Vec<[[f64; 4]; 2]>,
}

impl State {
    pub fn new(model: &Model) -> Self {
        let bodies = model.bodies.len();
        let mut q = Table::zeros(bodies);
        // No body: away from all axes, so that nothing divides by zero there.
        q.along_mut(Dof::X)[bodies..].fill(1.0);
        let v = Table::zeros(bodies);
        Self {
            q,
            v,
            layout: model.is_spatial().then(|| model.layout()),
            tilts: model.rings.each_ref().map(|ring| [ring.tilt, [0.0; 2]]),
            across: model
                .balls_turn()
                .then(|| [(); 2].map(|()| vec![0.0; bodies + LANES])),
            attitudes: vec![[[0.0; 4]; 2]; model.layout().tumbling().len()],
        }
    }

    /// Reads a state vector as `Model` orders it, body by body.
    pub fn read(&mut self, y: &[f64]) {
        let (q, v) = y.split_at(y.len() / 2);
        self.q.read(q);
        self.v.read(v);
        if let Some(layout) = self.layout {
            for race in Race::BOTH {
                for (i, dof) in Dof::TILTS.into_iter().enumerate() {
                    if layout.has(race.ring(), dof) {
                        let at = layout.at(race.ring(), dof);
                        (self.tilts[race][0][i], self.tilts[race][1][i]) = (q[at], v[at]);
                    }
                }
            }
            for (across, dof) in self.across.iter_mut().flatten().zip(Dof::TURNS) {
                for ball in layout.bodies().filter(|body| layout.has(*body, dof)) {
                    across[ball.index()] = v[layout.at(ball, dof)];
                }
            }
            for (j, attitude) in layout.tumbling().zip(&mut self.attitudes) {
                *attitude = [q, v]
                    .map(|half| Dof::ATTITUDE.map(|dof| half[layout.at(BodyId::ball(j), dof)]));
            }
        }
    }

    /// Writes what [`State::read`] reads.
    pub fn write(&self, y: &mut [f64]) {
        let (q, v) = y.split_at_mut(y.len() / 2);
        self.q.write(q);
        self.v.write(v);
    }

    /// Euler parameters of a ball that has them, and their rates \[1/s\].
    pub fn attitude(&self, body: BodyId) -> Option<[[f64; 4]; 2]> {
        let layout = self.layout?;
        let tumbling = layout.tumbling();
        let ball = layout
            .as_ball(body)
            .filter(|ball| tumbling.contains(ball))?;
        Some(self.attitudes[ball - tumbling.start])
    }

    #[inline]
    pub fn motion(&self, body: BodyId) -> Motion {
        let ([x, y, z, theta], [vx, vy, vz, omega]) = (self.q.of(body), self.v.of(body));
        Motion {
            centre: V2::new(x, y),
            z,
            theta,
            velocity: V2::new(vx, vy),
            vz,
            omega,
            across: self.across.as_ref().map_or_else(V2::zeros, |[x, y]| {
                V2::new(x[body.index()], y[body.index()])
            }),
            attitude: self.attitude(body).map(|[attitude, _]| attitude),
            seen_by: None,
        }
    }

    /// Angular velocities about x and y of all bodies, where balls spin freely \[rad/s\].
    #[inline(always)]
    pub fn across(&self) -> Option<&[Vec<f64>; 2]> {
        self.across.as_ref()
    }

    /// A ring that may tilt.
    pub fn tilted(&self, model: &Model, race: Race) -> TiltedRing {
        model.tilted_as(race, &self.motion(race.ring()), self.tilts[race])
    }

    /// Tilt of a ring \[rad\] and its rates \[rad/s\].
    pub fn tilt(&self, race: Race) -> [[f64; 2]; 2] {
        self.tilts[race]
    }

    /// Both rings, by race.
    #[inline]
    pub fn rings(&self) -> [Motion; 2] {
        [self.motion(BodyId::OUTER), self.motion(BodyId::INNER)]
    }
}
