//! Contacts and moments of rings that may tilt and of balls that spin freely: contacts are evaluated in the frames of their rings.
//!
//! All balls are first turned into each ring's frame; there the ring stands still, and the contacts are those of parallel rings
//! with the additional slip of balls that turn across the ring's axis. Not used where balls spin about the axis of parallel rings.

use nalgebra::Vector3;

use super::batch::{Batch, OnRings, RingView};
use crate::base::pool::Pool;
use crate::contact::{TiltedRing, attitude_accelerations};
use crate::forces::{State, Table, drive};
use crate::model::{BodyId, Degree, Dof, Model, Race};

/// Data of an evaluation for rotations about x and y.
#[derive(Debug)]
pub(super) struct SpatialWork {
    rings: [RingView; 2],
    /// Moments about the rings' centres of mass, in the scene's frame \[N m\].
    moments: [Vector3<f64>; 2],
    /// Moments about x and y on balls that spin freely \[N m\]; none where they do not.
    across: Vec<[f64; 2]>,
}

impl SpatialWork {
    /// The tilted part; none where nothing turns about x or y.
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
        pool: Option<&Pool>,
    ) -> [f64; 2] {
        let views = RingView::look(&mut self.rings, model, state);
        let on_rings = contacts.add_tilted(forces, model, &views, pool);
        contacts.moments_on_balls(&mut self.across);
        self.carry(&on_rings, forces);
        on_rings.map(|[_, moment]| moment.z)
    }

    /// Adds what contacts do to the rings.
    fn carry(&mut self, on_rings: &OnRings, forces: &mut Table) {
        for race in Race::BOTH {
            let [force, moment] = &on_rings[race];
            let [force, moment] = self.rings[race].ring.about_centre(force, moment);
            forces.add(race.ring(), &[force.x, force.y, force.z, 0.0]);
            self.moments[race] = moment;
        }
    }

    /// Moments about the rings' centres of mass in the last evaluation, in the scene's frame \[N m\].
    #[cfg(test)]
    pub fn moments(&self) -> [Vector3<f64>; 2] {
        self.moments
    }

    /// The rings, and the moments on them to add to.
    pub fn rings_and_moments(
        &mut self,
    ) -> (Option<[&TiltedRing; 2]>, Option<&mut [Vector3<f64>; 2]>) {
        let rings = self.rings.each_ref().map(|view| &view.ring);
        (Some(rings), Some(&mut self.moments))
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
            let (of, moment) = (&self.rings[race].ring, &self.moments[race]);
            let spin = drive::acceleration(model, race, t).unwrap_or_default();
            let [places, rates] = state.tilt(race);
            let given = |i: usize| {
                let tilt = Dof::TILTS[i];
                let given = model.given_acceleration(race, tilt, t, [places[i], rates[i]]);
                given.unwrap_or_default()
            };
            let prescribed = [given(0), given(1), spin];
            let found = turning_accelerations(model, race, of, moment, prescribed);
            for (dof, found) in [Dof::TiltX, Dof::TiltY, Dof::Theta].into_iter().zip(found) {
                if layout.has(ring, dof) {
                    accelerations[layout.at(ring, dof)] = found;
                }
            }
        }
    }
}

/// Accelerations of a ring's tilts and of its spin under a moment about its centre of mass \[N m\], with those of given tilts and of a
/// driven spin \[rad/s²\].
pub(crate) fn turning_accelerations(
    model: &Model,
    race: Race,
    ring: &TiltedRing,
    moment: &Vector3<f64>,
    driven: [f64; 3],
) -> [f64; 3] {
    let [x, y, spin] = driven;
    let prescribed = [(Dof::TiltX, x), (Dof::TiltY, y), (Dof::Theta, spin)].map(|(dof, driven)| {
        match model.degree(race, dof) {
            Degree::Free { .. } => None,
            Degree::Fixed => Some(0.0),
            Degree::Driven => Some(driven),
        }
    });
    let inertia = &model.rings[race].inertia;
    ring.rotation.accelerations(inertia, moment, &prescribed)
}

/// Writes how the rates of a ball's Euler parameters change, once its angular acceleration is there.
fn tumble(model: &Model, state: &State, ball: BodyId, accelerations: &mut [f64]) {
    let layout = model.layout();
    let Some(attitude) = state.attitude(ball) else {
        return;
    };
    let turning =
        [Dof::TurnX, Dof::TurnY, Dof::Theta].map(|dof| accelerations[layout.at(ball, dof)]);
    let found = attitude_accelerations(
        &turning.into(),
        &state.motion(ball).turning(),
        attitude,
        model.stabilisation_rate(),
    );
    for (dof, found) in Dof::ATTITUDE.into_iter().zip(found) {
        accelerations[layout.at(ball, dof)] = found;
    }
}
