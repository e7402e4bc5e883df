//! Contacts and moments of rings that may tilt: every contact by itself, in the frame of its ring.
//!
//! Right before fast: rings that stay parallel do not come here.

use nalgebra::Vector3;

use super::sums::Spatial;
use crate::contact::LeaningRing;
use crate::forces::{self, State, Table, drive};
use crate::model::{BodyId, Degree, Dof, Model, Race};

/// What an evaluation knows of rings that may tilt.
#[derive(Debug)]
pub(super) struct Leaning {
    rings: [LeaningRing; 2],
    /// Moments about the rings' centres of mass, in the scene's frame \[N m\].
    moments: [Vector3<f64>; 2],
    pub pulls: usize,
    pub truncated: usize,
    /// The first ball that has left its groove.
    pub lost: Option<usize>,
}

impl Leaning {
    /// None where no ring may tilt.
    pub fn new(model: &Model) -> Option<Box<Self>> {
        let state = State::new(model);
        model.leans().then(|| {
            Box::new(Self {
                rings: Race::BOTH.map(|race| state.leaning(model, race)),
                moments: [Vector3::zeros(); 2],
                pulls: 0,
                truncated: 0,
                lost: None,
            })
        })
    }

    /// Adds the forces of all contacts at a state; returns the moments on both rings about their axes \[N m\].
    pub fn add_contacts(&mut self, model: &Model, state: &State, forces: &mut Table) -> [f64; 2] {
        self.rings = Race::BOTH.map(|race| state.leaning(model, race));
        self.moments = [Vector3::zeros(); 2];
        (self.pulls, self.truncated, self.lost) = (0, 0, None);
        for (j, ball) in model.balls.iter().enumerate() {
            let motion = state.motion(BodyId::ball(j));
            for race in Race::BOTH {
                let (pair, ring) = (&model.rows[ball.row].pairs[race], &self.rings[race]);
                let [seen, own] = ring.facing(&motion);
                if pair.has_lost(&ball.side, &seen) {
                    self.lost = self.lost.or(Some(j));
                }
                let mut sum = Spatial::default();
                pair.evaluate(&ball.side, &seen, &own, &mut sum);
                self.pulls += sum.pulls as usize;
                self.truncated += usize::from(sum.truncated);
                let on_ball = sum.wrench.turned(|v| ring.rotation.frame.to_scene(v));
                let [x, y, z] = on_ball.force.into();
                let turning = sum.wrench.moment.z + ring.across(&sum.on_caps);
                forces.add(BodyId::ball(j), &[x, y, z, turning]);
                forces.add(race.ring(), &[-x, -y, -z, 0.0]);
                self.moments[race] += on_ball.moment_on_ring(&ring.arm(&motion));
            }
        }
        Race::BOTH.map(|race| self.moments[race].dot(&self.rings[race].rotation.frame.axis()))
    }

    /// Adds what else acts on the rings.
    pub fn add_applied(&mut self, model: &Model, t: f64, state: &State, forces: &mut Table) {
        forces::leaning::add(model, t, state, forces, &mut self.moments);
    }

    /// Writes the accelerations of the rings' rotations.
    pub fn accelerate(&self, model: &Model, t: f64, accelerations: &mut [f64]) {
        let layout = model.layout();
        for race in Race::BOTH {
            let ring = race.ring();
            let spin = match model.bodies[ring].degrees[Dof::Theta] {
                Degree::Free { .. } => None,
                Degree::Fixed => Some(0.0),
                Degree::Driven => drive::acceleration(model, t),
            };
            let held = |dof| (!layout.has(ring, dof)).then_some(0.0);
            let prescribed = [held(Dof::TiltX), held(Dof::TiltY), spin];
            let (inertia, moment) = (&model.rings[race].inertia, &self.moments[race]);
            let found = self.rings[race]
                .rotation
                .accelerations(inertia, moment, &prescribed);
            for (dof, found) in [Dof::TiltX, Dof::TiltY, Dof::Theta].into_iter().zip(found) {
                if layout.has(ring, dof) {
                    accelerations[layout.at(ring, dof)] = found;
                }
            }
        }
    }
}
