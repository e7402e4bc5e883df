//! Numbers of a ring that may tilt in addition to the four directions of every body.

use nalgebra::{Matrix6, Vector3};

use super::given::GivenMotions;
use super::{BodyId, Degree, Dof, Layout, Model, Race};
use crate::contact::{Motion, TiltedRing};
use crate::scene::{self, CoupledSupport, Mount, Scene, Surface};
use crate::tilt::{Inertia, Rotation};

/// A ring compiled.
#[derive(Debug, Clone)]
pub(crate) struct RingModel {
    pub inertia: Inertia,
    /// Axial place of the centre of mass in the ring's frame \[m\].
    pub centre_of_mass: f64,
    /// Nominal tilt, of a given one that at t = 0 \[rad\].
    pub tilt: [f64; 2],
    /// How each tilt moves.
    pub degrees: [Degree; 2],
    pub coupled: Option<CoupledModel>,
    pub given: GivenMotions,
}

/// Springs and dampers between all directions of a ring, at a place of its axis from the centre of mass \[m\].
#[derive(Debug, Clone)]
pub(crate) struct CoupledModel {
    pub stiffness: Matrix6<f64>,
    pub damping: Matrix6<f64>,
    pub place: f64,
}

impl RingModel {
    pub(super) fn new(ring: &scene::Ring, inertia: Inertia) -> Self {
        let centre_of_mass = ring.centre_of_mass.unwrap_or_default();
        let coupled = |of: &CoupledSupport| CoupledModel {
            stiffness: Matrix6::from_fn(|i, j| of.stiffness[i][j]),
            damping: Matrix6::from_fn(|i, j| of.damping[i][j]),
            place: of.axial_position - centre_of_mass,
        };
        let given = GivenMotions::new(ring);
        let held = ring.tilt.unwrap_or_default();
        let at_start = |dof: Dof| {
            let nominal = held[dof.index() - Dof::TiltX.index()];
            given.of(dof).map_or(nominal, |motion| motion.at(0.0))
        };
        Self {
            inertia,
            centre_of_mass,
            tilt: [Dof::TiltX, Dof::TiltY].map(at_start),
            degrees: ring.support.tilt_mounts().map(Degree::from),
            coupled: ring.support.coupled.as_deref().map(coupled),
            given,
        }
    }

    /// Vector from the centre of mass to a point of the ring's frame \[m\].
    pub fn arm(&self, [x, y, z]: [f64; 3]) -> Vector3<f64> {
        Vector3::new(x, y, z - self.centre_of_mass)
    }
}

/// The layout of all bodies of a scene, cages that are rings and modes of a structure included, of the tilts that move, and of balls that spin freely and tumble with a cap.
pub fn layout_of(scene: &Scene) -> Layout {
    let counts = scene.rows.iter().map(|row| row.ball_count);
    let moves = |ring: &scene::Ring| ring.support.tilt_mounts().map(|of| of != Mount::Fixed);
    let cages = scene.cage_ring().map_or(0, |_| scene.rows.len());
    let layout = Layout::of_balls(counts.clone().sum())
        .with_cages(cages)
        .with_modes(scene.structure.as_ref().map_or(0, |of| of.modes.len()))
        .with_tilts([&scene.outer_ring, &scene.inner_ring].map(moves));
    if !scene.balls_turn() {
        return layout;
    }
    let capped = scene.defects.values().filter_map(|defect| {
        let before: usize = counts.clone().take(defect.row).sum();
        (defect.on == Surface::Ball).then(|| before + defect.ball.unwrap_or(0))
    });
    let first = capped.clone().min().unwrap_or(0);
    layout.with_turns(first..capped.max().map_or(first, |last| last + 1))
}

impl Model {
    /// Whether a ring may tilt, or is tilted from the start.
    #[inline]
    pub(crate) fn tilts(&self) -> bool {
        self.tilts
    }

    /// The same of one ring.
    pub(crate) fn ring_tilts(&self, race: Race) -> bool {
        let moves = |dof: &Dof| self.layout.has(race.ring(), *dof);
        Dof::TILTS.iter().any(moves) || self.rings[race].tilt != [0.0; 2]
    }

    /// Whether no moment turns a ring that stands parallel, and nothing acts on it but contacts, loads and the mounts of its centre.
    pub(crate) fn is_parallel_and_held(&self, race: Race) -> bool {
        let turns = self.degree(race, Dof::Theta).is_free() || self.ring_tilts(race);
        let carries = self.rings[race].coupled.is_some() || !self.scene.unbalances.is_empty();
        !turns && !carries
    }

    /// How a direction of a ring moves.
    pub(crate) fn degree(&self, race: Race, dof: Dof) -> Degree {
        match dof {
            Dof::TiltX => self.rings[race].degrees[0],
            Dof::TiltY => self.rings[race].degrees[1],
            _ => self.bodies[race.ring()].degrees[dof],
        }
    }

    /// Whether balls spin freely: their angular velocity is a vector.
    #[inline]
    pub(crate) fn balls_turn(&self) -> bool {
        self.layout.has(BodyId::ball(0), Dof::TurnX)
    }

    /// Whether anything turns about x or y: contacts are then evaluated in the frames of their rings.
    #[inline]
    pub(crate) fn is_spatial(&self) -> bool {
        self.tilts || self.balls_turn()
    }

    /// Tilt of a ring \[rad\] and its rates \[rad/s\] in a state.
    pub(crate) fn tilt(&self, y: &[f64], race: Race) -> [[f64; 2]; 2] {
        let (layout, mut found) = (self.layout, [self.rings[race].tilt, [0.0; 2]]);
        for (i, dof) in Dof::TILTS.into_iter().enumerate() {
            if layout.has(race.ring(), dof) {
                found[0][i] = y[layout.at(race.ring(), dof)];
                found[1][i] = y[layout.speed_at(race.ring(), dof)];
            }
        }
        found
    }

    /// Largest tilt in a state of the rings that may tilt \[rad\].
    pub(crate) fn largest_tilt(&self, y: &[f64]) -> f64 {
        let may = |race: &Race| {
            Dof::TILTS
                .iter()
                .any(|dof| self.layout.has(race.ring(), *dof))
        };
        let rings = Race::BOTH.into_iter().filter(may);
        rings
            .map(|race| {
                let [[x, y], _] = self.tilt(y, race);
                x.hypot(y)
            })
            .fold(0.0, f64::max)
    }

    /// A ring that may tilt, in a state.
    pub(crate) fn tilted(&self, y: &[f64], race: Race) -> TiltedRing {
        let motion = self.layout.motion(y, race.ring());
        self.tilted_as(race, &motion, self.tilt(y, race))
    }

    /// The same from its motion, tilt and the tilt's rates.
    pub(crate) fn tilted_as(
        &self,
        race: Race,
        motion: &Motion,
        [tilt, rates]: [[f64; 2]; 2],
    ) -> TiltedRing {
        let rotation = Rotation::new(tilt, rates, motion.omega);
        let offset = self.rings[race].centre_of_mass;
        TiltedRing::new(motion, rotation, offset, self.balls_turn())
    }

    /// A ball and a ring in a state as their contact sees them: in the scene's frame, or in that of a ring that tilts.
    pub(crate) fn facing(&self, y: &[f64], ball: usize, race: Race) -> [Motion; 2] {
        let at = self.layout.motion(y, BodyId::ball(ball));
        if self.is_spatial() {
            self.tilted(y, race).facing(&at)
        } else {
            [at, self.layout.motion(y, race.ring())]
        }
    }
}
