//! Energies and dissipated powers of a state.

use serde::{Deserialize, Serialize};

use super::powers::ContactPowers;
use crate::contact::{ContactForce, OilForce, Sink};
use crate::forces::{self, Account};
use crate::model::{Dof, Model, Race};

/// Energies \[J\] and dissipated powers \[W\]. Loads, drive and given motions do work on top of these.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Energy {
    /// Kinetic energy of all bodies that move.
    pub kinetic: f64,
    /// Stored in contacts.
    pub contact: f64,
    /// Stored in supports.
    pub support: f64,
    /// Stored in the cage, of a ring on its land too.
    pub cage: f64,
    /// Energy in the field of gravity, 0 at the origin.
    pub gravity: f64,
    /// Power lost to contact damping, of steel, oil and squeeze films.
    pub damping_power: f64,
    /// Power lost to friction where surfaces slip.
    pub friction_power: f64,
    /// Power lost to the rolling resistance of oil and steel; 0 without a lubricant.
    pub rolling_power: f64,
    /// Power lost in supports and cage.
    pub support_power: f64,
}

impl Energy {
    /// Sum of stored and kinetic energy \[J\].
    pub fn total(&self) -> f64 {
        self.kinetic + self.contact + self.support + self.cage + self.gravity
    }

    /// Names, units and values, in order.
    pub fn entries(&self) -> [(&'static str, &'static str, f64); 10] {
        [
            ("kinetic", "J", self.kinetic),
            ("contact", "J", self.contact),
            ("support", "J", self.support),
            ("cage", "J", self.cage),
            ("gravity", "J", self.gravity),
            ("total", "J", self.total()),
            ("damping_power", "W", self.damping_power),
            ("friction_power", "W", self.friction_power),
            ("rolling_power", "W", self.rolling_power),
            ("support_power", "W", self.support_power),
        ]
    }
}

#[derive(Default)]
struct Contacts {
    energy: f64,
    powers: ContactPowers,
}

impl Sink for Contacts {
    fn asks_energy(&self) -> bool {
        true
    }

    fn force(&mut self, force: &ContactForce) {
        self.energy += force.energy;
        self.powers.force(force);
    }

    fn oil(&mut self, oil: &OilForce) {
        self.powers.oil(oil);
    }
}

/// Energies and dissipated powers of a state.
pub(crate) fn energy(model: &Model, y: &[f64]) -> Energy {
    let mut energy = Energy::default();
    let layout = model.layout();
    for id in layout.bodies() {
        let body = &model.bodies[id];
        for dof in Dof::ALL {
            let speed = y[layout.speed_at(id, dof)];
            energy.kinetic += 0.5 * body.mass[dof] * speed * speed;
        }
        if layout.has(id, Dof::TurnX) {
            let [x, y] = Dof::TURNS.map(|dof| y[layout.speed_at(id, dof)]);
            energy.kinetic += 0.5 * body.mass[Dof::Theta] * (x * x + y * y);
        }
    }
    if model.tilts() {
        energy.kinetic += of_tilt(model, y);
    }
    let mut sum = Account::default();
    for force in forces::ALL {
        sum += force.account(model, y);
    }
    // Named one by one, so that the compiler asks about a new field.
    let Account {
        kinetic,
        support,
        cage,
        gravity,
        power,
        damping,
    } = sum;
    energy.kinetic += kinetic;
    (energy.cage, energy.support) = (cage, support);
    (energy.gravity, energy.support_power) = (gravity, power);
    let mut contacts = Contacts::default();
    for (j, ball) in model.balls.iter().enumerate() {
        for race in Race::BOTH {
            let [at, ring] = model.facing(y, j, race);
            let pair = &model.rows[ball.row].pairs[race];
            pair.evaluate(&ball.side, &at, &ring, &mut contacts);
        }
    }
    energy.contact = contacts.energy;
    let powers = contacts.powers;
    energy.damping_power = powers.damping + damping;
    energy.friction_power = powers.slip;
    energy.rolling_power = powers.rolling;
    energy
}

/// Energy of the rotations of rings that tilt beside those about z \[J\].
fn of_tilt(model: &Model, y: &[f64]) -> f64 {
    let of = |race: Race| {
        let inertia = &model.rings[race].inertia;
        let spin = y[model.layout().speed_at(race.ring(), Dof::Theta)];
        let whole = model.tilted(y, race).rotation.kinetic_energy(inertia);
        whole - 0.5 * inertia.polar * spin * spin
    };
    Race::BOTH.map(of).into_iter().sum()
}

/// Forces of the cage links of a row, positive in tension, or of the pockets of a ring on its balls, positive on one that leads \[N\]; empty
/// without a cage.
pub(crate) fn cage_forces(model: &Model, y: &[f64], row: usize) -> Vec<f64> {
    if model.rows[row].cage.is_some() {
        return forces::cage::ring::pocket_forces(model, y, row);
    }
    let links = forces::cage::links::of_row(model, y, &model.rows[row]);
    links.iter().map(|link| link.force).collect()
}
