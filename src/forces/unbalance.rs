//! Unbalances: masses off the centre of a ring that turns.
//!
//! The ring's mass m and its inertia I about its own centre are those of the whole, its centre of mass stands at
//! u/m = Σ m e r̂ / m from the centre, so with ψ the angle of each r̂ (Lagrange)
//!
//! ```text
//! m ẍ = F_x + m e (ω² cos ψ + ω̇ sin ψ)        m ÿ = F_y + m e (ω² sin ψ − ω̇ cos ψ)
//! I ω̇ = T + u × g − u × (ẍ, ÿ)
//! ```
//!
//! With a driven speed ω̇ is known. Else the first two in the third give it, over 1 − (u_x²/m_y + u_y²/m_x)/I, which is above 0
//! where the ring's inertia about its centre of mass is.

use nalgebra::Vector3;

use super::{Account, Asymmetry, Damper, Force, Instant, RingWrench, State, Use, drive};
use crate::contact::{V2, cross};
use crate::model::{DOFS, Dof, Model, Race, UnbalanceModel};
use crate::tilt::Frame;

/// Unbalances of both rings.
#[derive(Debug)]
pub(crate) struct Unbalances;

impl Force for Unbalances {
    fn name(&self) -> &'static str {
        "unbalance"
    }

    fn contribution(&self) -> &'static str {
        "load"
    }

    fn used(&self, model: &Model) -> Use {
        Use::evaluated(!model.unbalances.is_empty())
    }

    fn waits_for_others(&self) -> bool {
        true
    }

    fn given_others(
        &self,
        model: &Model,
        at: &Instant<'_>,
        race: Race,
        others: &[f64; DOFS],
    ) -> Option<RingWrench> {
        Some(match at.rings {
            None => on(model, at.t, at.state, race, others),
            Some(_) => on_tilted(model, at.t, at.state, race, &at.frame(race)),
        })
    }

    fn account(&self, model: &Model, y: &[f64]) -> Account {
        let [kinetic, gravity] = energies(model, y);
        Account {
            kinetic,
            gravity,
            ..Account::default()
        }
    }

    fn dampers(&self, _model: &Model) -> Vec<Damper> {
        Vec::new()
    }

    /// Centrifugal forces, the ring at angle 0.
    fn at_start(&self, model: &Model, race: Race) -> RingWrench {
        let speed = model.scene.ring_speeds(0.0)[race];
        let mut sum = RingWrench::default();
        for unbalance in model.unbalances.iter().filter(|u| u.ring == race) {
            let (sin, cos) = unbalance.angle.sin_cos();
            let size = unbalance.moment * speed * speed;
            let force = Vector3::new(size * cos, size * sin, 0.0);
            sum.force += force;
            sum.moment += (Vector3::z() * unbalance.place).cross(&force);
        }
        sum
    }

    fn asymmetry(&self, model: &Model) -> Asymmetry {
        let off = |unbalance: &UnbalanceModel| unbalance.place != 0.0;
        let is_off = model.unbalances.iter().any(off);
        Asymmetry {
            along_z: None,
            tilting: is_off.then(|| "an unbalance is off the ring's centre of mass".to_owned()),
            turns_with_ring: !model.unbalances.is_empty(),
        }
    }
}

/// Wrench of the unbalances of a ring that stays parallel, from all other forces on it.
fn on(model: &Model, t: f64, state: &State, ring: Race, others: &[f64; DOFS]) -> RingWrench {
    let mut sum = RingWrench::default();
    let of_ring = model.unbalances.iter().filter(|u| u.ring == ring);
    if of_ring.clone().next().is_none() {
        return sum;
    }
    let motion = state.motion(ring.ring());
    let square = motion.omega * motion.omega;
    let direction = |u: &UnbalanceModel| motion.direction_of(u.angle).sin_cos();
    let mut whole = V2::zeros();
    for unbalance in of_ring.clone() {
        let (sin, cos) = direction(unbalance);
        whole += V2::new(cos, sin) * unbalance.moment;
    }
    let [gx, gy, _] = model.scene.gravity;
    let mobility = &model.mobility[ring.ring()];
    let [place, speed] = [&state.q, &state.v].map(|half| half.of(ring.ring()));
    let along = |dof: Dof, force: f64| {
        let given = model.given_acceleration(ring, dof, t, [place[dof], speed[dof]]);
        given.unwrap_or(mobility[dof] * force)
    };
    let accelerate = |spin: f64| {
        V2::new(
            along(Dof::X, others[Dof::X] + square * whole.x + spin * whole.y),
            along(Dof::Y, others[Dof::Y] + square * whole.y - spin * whole.x),
        )
    };
    let weight = cross(whole, V2::new(gx, gy));
    let driven = drive::acceleration(model, ring, t);
    let spin = driven.unwrap_or_else(|| {
        let coupled = mobility[Dof::Y] * whole.x * whole.x + mobility[Dof::X] * whole.y * whole.y;
        let torque = others[Dof::Theta] + weight - cross(whole, accelerate(0.0));
        mobility[Dof::Theta] * torque / (1.0 - mobility[Dof::Theta] * coupled)
    });
    for unbalance in of_ring {
        let (sin, cos) = direction(unbalance);
        sum.force.x += unbalance.moment * (square * cos + spin * sin);
        sum.force.y += unbalance.moment * (square * sin - spin * cos);
    }
    sum.moment.z = weight - cross(whole, accelerate(spin));
    sum
}

/// The same for a ring that tilts, whose rotation is driven or held: the force of a ring that does not, turned with it, and its
/// moment about the centre of mass.
fn on_tilted(model: &Model, t: f64, state: &State, ring: Race, frame: &Frame) -> RingWrench {
    let mut sum = RingWrench::default();
    let motion = state.motion(ring.ring());
    let driven = drive::acceleration(model, ring, t);
    let (square, spin) = (motion.omega * motion.omega, driven.unwrap_or(0.0));
    for unbalance in model.unbalances.iter().filter(|u| u.ring == ring) {
        let (sin, cos) = motion.direction_of(unbalance.angle).sin_cos();
        let force = Vector3::new(square * cos + spin * sin, square * sin - spin * cos, 0.0);
        let force = frame.to_scene(&(force * unbalance.moment));
        sum.force += force;
        sum.moment += (frame.axis() * unbalance.place).cross(&force);
    }
    sum
}

/// Kinetic energy that unbalances add, and energy in the field of gravity \[J\].
fn energies(model: &Model, y: &[f64]) -> [f64; 2] {
    let mut energies = [0.0; 2];
    let [gx, gy, _] = model.scene.gravity;
    for unbalance in &model.unbalances {
        let ring = model.layout().motion(y, unbalance.ring.ring());
        let (sin, cos) = ring.direction_of(unbalance.angle).sin_cos();
        let along = ring.velocity.y * cos - ring.velocity.x * sin;
        energies[0] += unbalance.moment * ring.omega * along;
        energies[1] -= unbalance.moment * (gx * cos + gy * sin);
    }
    energies
}
