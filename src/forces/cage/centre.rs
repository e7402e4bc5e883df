//! Centre of a cage that is a ring: what carries it, and a centre of mass beside it; equations are in [`super::ring`].

use super::pocket::{Laws, Turning, Wall};
use crate::contact::{Motion, V2, cross};
use crate::model::{CageModel, CentringSpring, Dof, Land, Model};

/// Force of the spring of a centred cage.
pub(super) struct Centred {
    /// Force on the outer ring \[N\], and moment about its centre \[N m\].
    pub on_ring: V2,
    pub about_ring: f64,
    pub energy: f64,
    pub power: f64,
}

impl Centred {
    pub fn new(spring: &CentringSpring, turning: &Turning, ring: &Motion) -> Self {
        let apart = turning.centre - ring.centre;
        let along = turning.velocity - ring.velocity - V2::new(-apart.y, apart.x) * ring.omega;
        let on_ring = apart * spring.stiffness + along * spring.damping;
        Self {
            on_ring,
            about_ring: cross(apart, on_ring),
            energy: 0.5 * spring.stiffness * apart.norm_squared(),
            power: spring.damping * along.norm_squared(),
        }
    }
}

/// Force of a land on a cage: the levers are those of friction about the centres of cage and ring; none within the clearance.
pub(super) fn on_land(
    cage: &CageModel,
    land: &Land,
    turning: &Turning,
    ring: &Motion,
) -> Option<Wall> {
    let apart = turning.centre - ring.centre;
    let distance = apart.norm();
    let depth = distance - land.clearance;
    if depth <= 0.0 {
        return None;
    }
    // A cage at the very centre of a land without clearance is pushed nowhere.
    let normal = apart / distance.max(f64::MIN_POSITIVE);
    let tangent = V2::new(-normal.y, normal.x);
    let laws = Laws {
        stiffness: land.stiffness,
        damping: land.damping,
        friction: land.friction,
        ..Laws::of_pockets(cage)
    };
    let along = turning.velocity - ring.velocity;
    let closing = along.dot(&normal);
    let force = laws.press(depth, closing);
    let own = land.race.sigma() * land.radius;
    let slip = along.dot(&tangent) + turning.omega * own - ring.omega * (distance + own);
    let friction = laws.rub(force, slip);
    Some(Wall {
        normal,
        force,
        friction,
        levers: [own, distance + own],
        energy: laws.energy(depth),
        power: (force - laws.stiffness * depth) * closing - friction * slip,
    })
}

/// What the distance u/m of the centre of mass from the centre adds to the forces on a free cage and the moment about its centre: as of an
/// unbalanced ring that turns freely ([`crate::forces::unbalance`]).
pub(super) fn unbalanced(
    model: &Model,
    cage: &CageModel,
    turning: &Turning,
    others: &[f64; 4],
) -> [f64; 4] {
    let u = turning.direction() * cage.unbalance;
    let [gx, gy, _] = model.scene.gravity;
    let square = turning.omega * turning.omega;
    let outwards = V2::new(others[Dof::X], others[Dof::Y]) + u * square;
    let weight = cross(u, V2::new(gx, gy));
    let torque = others[Dof::Theta] + weight - cross(u, outwards) / cage.mass;
    let spin = torque / (cage.inertia - u.norm_squared() / cage.mass);
    let more = u * square + V2::new(u.y, -u.x) * spin;
    [
        more.x,
        more.y,
        0.0,
        weight - cross(u, outwards + V2::new(u.y, -u.x) * spin) / cage.mass,
    ]
}
