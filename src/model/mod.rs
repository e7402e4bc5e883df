//! The compiled scene: indices, arrays and constants that a run only reads.
//!
//! Bodies stand in one order everywhere: outer ring, inner ring, balls row by row, cages that are rings, modes of a structure. The state vector holds
//! (x, y, z, θ) of every body, then (vx, vy, vz, ω) of every body; [`Layout`] says where, also of what tilts and spins freely.

mod at_rest;
mod body;
mod cage;
mod compile;
mod demand;
mod dof;
mod given;
mod layout;
mod loads;
mod nodes;
mod oil;
mod passes;
mod place;
mod race;
mod reference;
mod ring;
mod rolling;
mod scales;
mod steps;
mod structure;
mod texture;

use std::ops::Range;

use crate::contact::hertz::Hertz;
use crate::contact::{BallSide, Pair, Squeeze, ZoneSlices};
use crate::scene::{Component, Scene};
use crate::simd::{InstructionSet, LANES};

pub(crate) use at_rest::{AtRest, HeaviestContact, RaceLoads};
pub use body::{Body, Degree};
pub(crate) use cage::{CageModel, Carried, CentringSpring, Land};
pub(crate) use compile::compile_placed;
pub use dof::{DOFS, Dof};
pub(crate) use layout::RINGS;
pub use layout::{BodyId, BodyKind, Layout, Race};
pub(crate) use loads::{LoadModel, MomentModel};
pub(crate) use passes::compile;
pub use place::Placed;
pub(crate) use place::place;
pub use ring::layout_of;
pub(crate) use ring::{CoupledModel, RingModel};
pub(crate) use rolling::{Between, PureRolling};
pub use scales::Scales;
pub(crate) use steps::Fineness;
pub(crate) use structure::StructureModel;

/// A compiled scene. Immutable and shared by threads.
///
/// ```
/// use ballrace::{compile, scene::presets};
/// let model = compile(&presets::wheel_bearing(3000.0)).unwrap();
/// assert_eq!(model.dim(), 8 * 28);
/// assert_eq!(model.names()[4 * 28 + 1], "outer.vy");
/// ```
#[derive(Debug, Clone)]
pub struct Model {
    pub(crate) scene: Scene,
    pub(crate) bodies: Vec<Body>,
    pub(crate) rows: Vec<RowModel>,
    pub(crate) balls: Vec<Ball>,
    pub(crate) loads: Vec<LoadModel>,
    pub(crate) unbalances: Vec<UnbalanceModel>,
    pub(crate) springs: Vec<Spring>,
    /// Inverse of the mass of every body's free directions, 0 for the others.
    pub(crate) mobility: Vec<[f64; DOFS]>,
    pub(crate) rings: [RingModel; 2],
    /// Structure on which the outer ring stands.
    pub(crate) structure: Option<StructureModel>,
    /// Whether a ring is tilted or may tilt.
    tilts: bool,
    layout: Layout,
    /// Moments that act on the rings.
    pub(crate) moments: Vec<MomentModel>,
    pub(crate) scales: Scales,
    pub(crate) fineness: Fineness,
    pub(crate) instructions: InstructionSet,
}

/// A row compiled.
#[derive(Debug, Clone)]
pub(crate) struct RowModel {
    /// Index of its first ball among all balls.
    pub first: usize,
    pub count: usize,
    /// Contacts with the outer and the inner race.
    pub pairs: [Pair; 2],
    /// Hertz's contacts with the same, whatever the law: pressures, and what the law is compared with.
    pub hertz: [Hertz; 2],
    /// Distance of neighbouring balls ℓ₀.
    pub cage_distance: f64,
    pub side: f64,
    /// The first row like it ([`RowModel::is_like`]), which may be itself.
    pub class: usize,
    /// Half-widths of contacts by which its texture is averaged, where it has one \[m\].
    pub texture_widths: Option<[f64; 2]>,
    /// Squeeze film of its contacts.
    pub squeeze: Option<SqueezeModel>,
    /// Drag of a ball over the square of its speed \[N s²/m²\].
    pub drag: f64,
    /// Cage of the row, where that is a ring.
    pub cage: Option<Box<CageModel>>,
}

impl RowModel {
    /// Numbers of the row's balls among those of all rows.
    #[inline]
    pub fn balls(&self) -> Range<usize> {
        self.first..self.first + self.count
    }

    /// The body of its first ball; the others follow.
    #[inline]
    pub fn first_body(&self) -> BodyId {
        BodyId::ball(self.first)
    }

    /// Whether the row's contacts follow the same equations as another row's, cut at as many places: kind of law, slices, damping
    /// and friction are the same. Of tori the geometry may differ, and waves and strength of the law, and of films their numbers.
    pub fn is_like(&self, other: &Self) -> bool {
        let mut pairs = self.pairs.iter().zip(&other.pairs);
        pairs.all(|(one, other)| one.is_like(other))
    }

    /// Whether the row's balls have friction on either race, or are resisted as they roll.
    pub fn has_friction(&self) -> bool {
        self.pairs.iter().any(|pair| pair.law.turns_balls())
    }

    /// Whether races or pockets turn its balls.
    pub fn turns_balls(&self) -> bool {
        let rubs = |cage: &CageModel| cage.friction > 0.0;
        self.has_friction() || self.cage.as_deref().is_some_and(rubs)
    }

    /// Whether the forces of its contacts depend on how fast they slip or close.
    pub fn resists_motion(&self) -> bool {
        self.pairs.iter().any(|pair| pair.law.takes_energy())
    }

    /// Neighbours that the cage links, as indices among all balls: none for one ball, one link for two.
    pub fn links(&self) -> impl Iterator<Item = (usize, usize)> {
        let (first, count) = (self.first, self.count);
        let links = if count < 3 { count - 1 } else { count };
        (0..links).map(move |j| (first + j, first + (j + 1) % count))
    }
}

/// Squeeze film of a row compiled.
#[derive(Debug, Clone)]
pub(crate) struct SqueezeModel {
    pub film: Squeeze,
    /// Radii of the row's balls, padded like a table \[m\].
    pub radii: Vec<f64>,
}

/// A ball compiled.
#[derive(Debug, Clone)]
pub(crate) struct Ball {
    pub row: usize,
    /// Number of the ball in the row.
    pub index: usize,
    pub side: BallSide,
}

/// Spring and damper of a direction of a body against the frame, relaxed at its nominal place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spring {
    pub body: BodyId,
    pub dof: Dof,
    pub stiffness: f64,
    pub damping: f64,
    pub nominal: f64,
}

/// An unbalance compiled.
#[derive(Debug, Clone)]
pub(crate) struct UnbalanceModel {
    pub ring: Race,
    pub moment: f64,
    pub angle: f64,
    /// Axial place, from the ring's centre of mass \[m\].
    pub place: f64,
}

impl Model {
    /// The scene it was compiled from, every defect at its number.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Number of bodies: two rings, all balls, the cages that are rings and the modes of a structure.
    pub fn body_count(&self) -> usize {
        self.bodies.len()
    }

    /// Length of the state vector: a place and a speed for each direction of every body.
    pub fn dim(&self) -> usize {
        self.layout().dim()
    }

    /// Layout of the places and speeds of all bodies in a state vector.
    #[inline]
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// Names of the bodies in their order: `outer`, `inner`, `row0.ball0`, …, of cages that are rings `row0.cage`, and of modes `structure.mode0`.
    pub fn bodies(&self) -> Vec<String> {
        self.bodies.iter().map(|body| body.name.clone()).collect()
    }

    /// Names of the states in their order, such as `outer.x`, `row0.ball3.vz` and, of Euler parameters and their rates,
    /// `row0.ball3.e0` and `row0.ball3.ve0`.
    pub fn names(&self) -> Vec<String> {
        let of = |components: &[Component]| {
            self.bodies
                .iter()
                .flat_map(|body| {
                    components
                        .iter()
                        .map(move |c| format!("{}.{}", body.name, c.label().0))
                })
                .collect::<Vec<_>>()
        };
        let (positions, velocities) = Component::ALL.split_at(DOFS);
        let [places, speeds] = [0, 1].map(|derivative| {
            let beside = self.layout.degrees().skip(DOFS * self.bodies.len());
            let name = |(body, dof): (BodyId, Dof)| {
                let body = &self.bodies[body].name;
                if Dof::ATTITUDE.contains(&dof) {
                    // No probe reads it.
                    return format!("{body}.{}{}", ["", "v"][derivative], dof.name());
                }
                let (label, _) = Component::of(dof.index(), derivative).label();
                format!("{body}.{label}")
            };
            beside.map(name).collect()
        });
        [of(positions), places, of(&velocities[..DOFS]), speeds].concat()
    }

    /// Slices or nodes of a contact with the outer and with the inner race, of the row that has most.
    pub fn slices(&self) -> [usize; 2] {
        Race::BOTH.map(|race| {
            let of = |row: &RowModel| row.pairs[race].slices.count() as usize;
            self.rows.iter().map(of).max().unwrap_or(0)
        })
    }

    /// Classes of rows whose contacts may be evaluated side by side, each by its first row ([`RowModel::is_like`]).
    pub(crate) fn classes(&self) -> impl Iterator<Item = usize> {
        (0..self.rows.len()).filter(|row| self.rows[*row].class == *row)
    }

    /// Groups of eight that the balls of a class make, at most.
    pub(crate) fn eights(&self, class: usize) -> usize {
        let rows = self.rows.iter().filter(|row| row.class == class);
        rows.map(|row| row.count).sum::<usize>().div_ceil(LANES)
    }

    /// Whether the balls of a row have a texture.
    pub(crate) fn has_textured_balls(&self, row: &RowModel) -> bool {
        !self.balls[row.first].side.waves.is_round()
    }

    /// The instruction set that evaluations use.
    pub fn instructions(&self) -> InstructionSet {
        self.instructions
    }

    /// The same model for another instruction set.
    #[must_use]
    pub fn with_instructions(mut self, instructions: InstructionSet) -> Self {
        self.instructions = instructions;
        self
    }

    /// Scales of the scene, which the tolerances and the step cap follow.
    pub fn scales(&self) -> &Scales {
        &self.scales
    }

    /// The radius that makes a length of a body's rotation \[m\]: a ball's own, the pitch radius for a cage, half the
    /// mean pitch diameter of the rows for a ring.
    pub(crate) fn radius(&self, body: BodyId) -> f64 {
        match self.layout.kind(body) {
            BodyKind::Ball(ball) => self.balls[ball].side.radius,
            BodyKind::Cage(row) => self.scene.rows[row].pitch_diameter / 2.0,
            // The coordinate of a mode is a length.
            BodyKind::Mode(_) => 1.0,
            BodyKind::Ring(_) => {
                let pitch = self.scene.rows.iter().map(|row| row.pitch_diameter);
                pitch.sum::<f64>() / self.rows.len() as f64 / 2.0
            }
        }
    }

    /// Length that a change in a direction of a body makes \[m\]: 1 along an axis, its radius about one. Euler parameters
    /// change by half an angle.
    pub(crate) fn lever(&self, body: BodyId, dof: Dof) -> f64 {
        match dof {
            Dof::X | Dof::Y | Dof::Z => 1.0,
            Dof::E0 | Dof::E1 | Dof::E2 | Dof::E3 => 2.0 * self.radius(body),
            _ => self.radius(body),
        }
    }

    /// Rate of the stabilisation that returns Euler parameters to length one and to the ball's angular velocity, and rings to given
    /// motions \[1/s\]: slow against steps, which follow the highest frequency, and fast against the growth of their errors.
    pub(crate) fn stabilisation_rate(&self) -> f64 {
        0.02 * self.scales.frequency
    }

    /// Whether sharing one evaluation among threads pays: below some 7 µs the wait for the last thread costs more
    /// (`cargo bench -p ballrace-benches --bench layers -- threads`).
    pub(crate) fn is_large(&self) -> bool {
        /// Nodes of all contacts from which two threads were faster.
        const BREAK_EVEN: usize = 1500;
        let nodes = |row: &RowModel| -> usize {
            let of = |pair: &Pair| match &pair.slices {
                // About a third of the ball touches.
                ZoneSlices::Fixed(count) => count / 3,
                ZoneSlices::Fitted(rules) => rules.count(),
            };
            row.count * row.pairs.iter().map(of).sum::<usize>()
        };
        self.rows.iter().map(nodes).sum::<usize>() > BREAK_EVEN
    }

    /// Orbit rate of a row's balls and their rotation about z \[rad/s\] for pure rolling at the nominal contact
    /// angle: ω_c = Ω(1 − γ)/2, θ̇_b = −ω_c d_m / (D cos α₀), γ = D cos α₀ / d_m, with Ω of the inner ring against the outer, and
    /// both faster by the outer ring's speed.
    pub fn rolling_speeds(&self, row: usize) -> (f64, f64) {
        let [outer, inner] = self.scene.ring_speeds(0.0);
        let (orbit, spin) = self.rolling_shares(row);
        let speed = inner - outer;
        (speed * orbit + outer, speed * spin + outer)
    }

    /// Speed of a row's balls about the axis in a state of all bodies, in the mean \[rad/s\].
    pub(crate) fn orbit_speed(&self, row: usize, y: &[f64]) -> f64 {
        let row = &self.rows[row];
        let mut speed = 0.0;
        for ball in row.balls() {
            let ball = self.layout().motion(y, BodyId::ball(ball));
            speed += ball.orbit_speed() / row.count as f64;
        }
        speed
    }

    /// The mean orbit rate of all balls against the outer ring over the speed of the inner against it, for pure rolling at the nominal
    /// contact angles.
    pub(crate) fn rolling_share(&self) -> f64 {
        let of = |ball: &Ball| self.rolling_shares(ball.row).0;
        self.balls.iter().map(of).sum::<f64>() / self.balls.len() as f64
    }

    /// [`Self::rolling_speeds`] seen from the outer ring, over the speed of the inner ring against it.
    pub(crate) fn rolling_shares(&self, row: usize) -> (f64, f64) {
        let row = &self.scene.rows[row];
        let gamma = row.ball_diameter * row.contact_angle.cos() / row.pitch_diameter;
        let orbit = (1.0 - gamma) / 2.0;
        (orbit, -orbit / gamma)
    }
}
