//! Forces on rings that depend on their motion ([`crate::scene::RingForce`]), by tables and by a user's own code, as one entry of the list.

use nalgebra::Vector3;

use super::{Account, Asymmetry, Damper, Force, ForceSums, Instant, RingWrench, State, Use, blame};
use crate::model::{Dof, Model, Race};
use crate::scene::{RingForce, RingMotion};

/// Forces by code of a user, all of them.
#[derive(Debug)]
pub(crate) struct Outside;

impl Force for Outside {
    fn name(&self) -> &'static str {
        "ring forces"
    }

    fn contribution(&self) -> &'static str {
        "load"
    }

    fn is_rare(&self) -> bool {
        true
    }

    fn used(&self, model: &Model) -> Use {
        Use::evaluated(acts(model))
    }

    fn add(&self, model: &Model, at: &Instant<'_>, sums: &mut ForceSums<'_>) {
        for (path, force) in model.scene.forces_of_motion() {
            let race = Race::from(force.ring());
            let motion = motion(at.state, race);
            sums.add(race, &wrench(&path, force, at.t, &motion));
        }
    }

    fn at_place(&self, model: &Model, race: Race, ring: &RingMotion) -> RingWrench {
        let mut sum = RingWrench::default();
        let each = model.scene.forces_of_motion();
        for (path, force) in each.filter(|(_, force)| Race::from(force.ring()) == race) {
            let found = wrench(&path, force, 0.0, ring);
            sum.force += found.force;
            sum.moment += found.moment;
        }
        sum
    }

    fn account(&self, model: &Model, y: &[f64]) -> Account {
        let mut account = Account::default();
        if !acts(model) {
            return account;
        }
        let mut state = State::new(model);
        state.read(y);
        for (_, force) in model.scene.forces_of_motion() {
            account.support += force.energy(&motion(&state, Race::from(force.ring())));
        }
        account
    }

    fn dampers(&self, model: &Model) -> Vec<Damper> {
        let each = model.scene.forces_of_motion();
        each.map(|(name, force)| {
            let body = Race::from(force.ring()).ring();
            Damper {
                name,
                body,
                rate: force.damping() / model.bodies[body].mass[Dof::X],
            }
        })
        .collect()
    }

    /// Effect at the start of nothing: it depends on the ring's place ([`Self::at_place`]).
    fn at_start(&self, _model: &Model, _race: Race) -> RingWrench {
        RingWrench::default()
    }

    fn asymmetry(&self, model: &Model) -> Asymmetry {
        Asymmetry {
            along_z: off_plane(model),
            tilting: off_plane(model),
            turns_with_ring: acts(model),
        }
    }
}

fn acts(model: &Model) -> bool {
    model.scene.forces_of_motion().next().is_some()
}

fn off_plane(model: &Model) -> Option<String> {
    let mut each = model.scene.forces_of_motion();
    let (name, _) = each.find(|(_, force)| !force.keeps_plane())?;
    Some(format!("{name} may act off the plane"))
}

/// Motion of a ring in a state.
fn motion(state: &State, race: Race) -> RingMotion {
    let [tilt, rates] = state.tilt(race);
    let ring = state.motion(race.ring());
    let [x, y] = ring.centre.into();
    let [vx, vy] = ring.velocity.into();
    RingMotion {
        place: [x, y, ring.z],
        angles: [tilt[0], tilt[1], ring.theta],
        velocity: [vx, vy, ring.vz],
        rates: [rates[0], rates[1], ring.omega],
    }
}

/// Wrench of a force, by its path in the scene, at a time \[s\].
fn wrench(path: &str, force: &dyn RingForce, t: f64, motion: &RingMotion) -> RingWrench {
    let found = blame::called(path, t, || force.wrench(t, motion));
    blame::judge(path, t, &found);
    let [x, y, z, mx, my, mz] = found;
    RingWrench {
        force: Vector3::new(x, y, z),
        moment: Vector3::new(mx, my, mz),
    }
}
