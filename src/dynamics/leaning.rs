//! Contacts and moments of rings that may tilt and of balls that spin freely: contacts are evaluated in the frames of their rings.
//!
//! All balls are first turned into each ring's frame; there the ring stands still, and the contacts are those of parallel rings but
//! for what balls slip that turn across the ring's axis. Balls that spin about the axis of parallel rings do not come here.

use nalgebra::Vector3;
use rayon::ThreadPool;

use super::batch::{Batch, RingView};
use crate::contact::attitude_rates;
use crate::forces::{self, State, Table, drive};
use crate::model::{BodyId, Degree, Dof, Model, Race};

/// What an evaluation knows of what turns about x and y.
#[derive(Debug)]
pub(super) struct Leaning {
    rings: [RingView; 2],
    /// Moments about the rings' centres of mass, in the scene's frame \[N m\].
    moments: [Vector3<f64>; 2],
    /// Moments about x and y on balls that spin freely \[N m\]; none where they do not.
    across: Vec<[f64; 2]>,
}

impl Leaning {
    /// None where nothing turns about x or y.
    pub fn new(model: &Model) -> Option<Box<Self>> {
        RingView::both(model).map(|rings| {
            let moments = [Vector3::zeros(); 2];
            let turning = if model.balls_turn() {
                model.balls.len()
            } else {
                0
            };
            Box::new(Self {
                rings,
                moments,
                across: vec![[0.0; 2]; turning],
            })
        })
    }

    /// Adds the forces of all contacts at a state; returns the moments on both rings about their axes \[N m\].
    pub fn add_contacts(
        &mut self,
        model: &Model,
        state: &State,
        contacts: &mut Batch,
        forces: &mut Table,
        pool: Option<&ThreadPool>,
    ) -> [f64; 2] {
        let views = RingView::look(&mut self.rings, model, state);
        let on_rings = contacts.add_leaning(forces, model, &views, pool);
        contacts.moments_on_balls(&mut self.across);
        for race in Race::BOTH {
            let [force, moment] = &on_rings[race];
            let [force, moment] = self.rings[race].ring.about_centre(force, moment);
            forces.add(race.ring(), &[force.x, force.y, force.z, 0.0]);
            self.moments[race] = moment;
        }
        on_rings.map(|[_, moment]| moment.z)
    }

    /// Moments about the rings' centres of mass in the last evaluation, in the scene's frame \[N m\].
    #[cfg(test)]
    pub fn moments(&self) -> [Vector3<f64>; 2] {
        self.moments
    }

    /// Adds what else acts on the rings.
    pub fn add_applied(&mut self, model: &Model, t: f64, state: &State, forces: &mut Table) {
        let rings = self.rings.each_ref().map(|view| &view.ring);
        forces::leaning::add(model, t, state, rings, (forces, &mut self.moments));
    }

    /// Writes the accelerations of the rings' rotations, and of balls that spin freely: a sphere has no gyroscopic moment.
    pub fn accelerate(&self, model: &Model, t: f64, state: &State, accelerations: &mut [f64]) {
        let layout = model.layout();
        for (j, moments) in self.across.iter().enumerate() {
            let ball = BodyId::ball(j);
            for (dof, moment) in Dof::TURNS.into_iter().zip(moments) {
                accelerations[layout.at(ball, dof)] = moment * model.mobility[ball][Dof::Theta];
            }
        }
        for ball in layout.tumbling().map(BodyId::ball) {
            tumble(model, state, ball, accelerations);
        }
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
            let rotation = &self.rings[race].ring.rotation;
            let found = rotation.accelerations(inertia, moment, &prescribed);
            for (dof, found) in [Dof::TiltX, Dof::TiltY, Dof::Theta].into_iter().zip(found) {
                if layout.has(ring, dof) {
                    accelerations[layout.at(ring, dof)] = found;
                }
            }
        }
    }
}

/// Writes how the rates of a ball's Euler parameters change, ë = ½ ω̇ e − ¼ ω² e, once its angular acceleration is there.
fn tumble(model: &Model, state: &State, ball: BodyId, accelerations: &mut [f64]) {
    let layout = model.layout();
    let motion = state.motion(ball);
    let Some(attitude) = motion.attitude else {
        return;
    };
    let turning =
        [Dof::TurnX, Dof::TurnY, Dof::Theta].map(|dof| accelerations[layout.at(ball, dof)]);
    let found = attitude_rates(&Vector3::from(turning), attitude);
    let square = 0.25 * motion.turning().norm_squared();
    for ((dof, found), e) in Dof::ATTITUDE.into_iter().zip(found).zip(attitude) {
        accelerations[layout.at(ball, dof)] = found - square * e;
    }
}
