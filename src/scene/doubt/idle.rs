//! Fields without effect, since the model does not include it or a held ring carries it.

use super::{Doubt, millimetres};
use crate::base::quantities::number;
use crate::scene::{Load, Material, Mount, Ring, RingName, Row, Scene, Spin, Surface};

/// A moment \[N m\] that counts as none.
const NO_MOMENT: f64 = 1e-9;
/// Share of a modulus by which materials differ without being meant to.
const MODULUS: f64 = 0.03;
/// Contact angle from which a bearing takes thrust one way \[rad\]; deep groove bearings are given 0.
const ANGULAR: f64 = 0.1;
/// Thrust over radial load from which contact angles of a deep groove bearing are some 10°.
const THRUST: f64 = 0.5;

/// Words for the axis of a moment.
const AXES: [&str; 3] = ["tilting about x", "tilting about y", "turning about z"];

pub(super) fn look(scene: &Scene, found: &mut Vec<Doubt>) {
    moments(scene, found);
    tables(scene, found);
    preload(scene, found);
    thrust(scene, found);
    moduli(scene, found);
    balls(scene, found);
}

/// Moments, and loads off the centre, about directions in which their ring is held.
fn moments(scene: &Scene, found: &mut Vec<Doubt>) {
    let mut check = |path: String, ring: RingName, moment: [f64; 3], about: &[usize]| {
        let [.., theta, tilt_x, tilt_y, _, _] = scene.moves(ring as usize);
        let driven = scene.given_speed(ring).is_some();
        let moves = [tilt_x, tilt_y, theta && !driven];
        let is_lost = |axis: &&usize| !moves[**axis] && moment[**axis].abs() > NO_MOMENT;
        for axis in about.iter().filter(is_lost) {
            let name = ring.name();
            let give = match axis {
                2 => "drive it by a torque, or let it turn".to_owned(),
                _ => format!("give {name}_ring.support.tilt_x and tilt_y a mount"),
            };
            let usual = format!(
                "has no effect, since the scene keeps the {name} ring from {}; {give}",
                AXES[*axis]
            );
            let value = format!("{} N m", number(moment[*axis]));
            found.push(Doubt::new(path.clone(), value, usual));
        }
    };
    for (name, load) in &scene.loads {
        if let Some(moment) = moment_of(scene, load) {
            check(format!("loads.{name}.at"), load.ring, moment, &[0, 1]);
        }
    }
    for (name, moment) in &scene.moments {
        let size = moment.moment.peak() / length(moment.direction);
        let all = moment.direction.map(|d| d * size);
        check(format!("moments.{name}"), moment.ring, all, &[0, 1, 2]);
    }
}

/// Tables of forces along directions in which their ring is held.
fn tables(scene: &Scene, found: &mut Vec<Doubt>) {
    for (name, table) in &scene.table_forces {
        let moves = scene.moves(table.ring as usize);
        let acts = |axis: usize| table.direction[axis] != 0.0 && moves[axis];
        if !(0..3).any(acts) {
            let ring = table.ring.name();
            found.push(Doubt::new(
                format!("table_forces.{name}.direction"),
                format!("{:?}", table.direction),
                format!(
                    "has no effect, since the scene holds the {ring} ring along it; give {ring}_ring.support a spring or set it free"
                ),
            ));
        }
    }
}

fn length(of: [f64; 3]) -> f64 {
    of.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Moment of a load about its ring's centre of mass, where it says its point \[N m\].
fn moment_of(scene: &Scene, load: &Load) -> Option<[f64; 3]> {
    let [x, y, z] = load.at?;
    let z = z - ring(scene, load.ring).centre_of_mass.unwrap_or_default();
    let size = load.force.peak() / length(load.direction);
    let [fx, fy, fz] = load.direction.map(|d| d * size);
    Some([y * fz - z * fy, z * fx - x * fz, x * fy - y * fx])
}

fn ring(scene: &Scene, name: RingName) -> &Ring {
    match name {
        RingName::Outer => &scene.outer_ring,
        RingName::Inner => &scene.inner_ring,
    }
}

/// Whether nothing but the balls holds a ring along z.
fn is_loose(scene: &Scene, name: RingName) -> bool {
    let support = &ring(scene, name).support;
    let absent = match name {
        RingName::Outer => Mount::Fixed,
        RingName::Inner => Mount::Free,
    };
    let [_, _, z, _] = support.mounts(absent);
    let gives = match z {
        Mount::Free => true,
        Mount::Fixed | Mount::Given(_) => false,
        Mount::Spring { stiffness, .. } => stiffness == 0.0,
    };
    gives
        && support
            .coupled
            .as_ref()
            .is_none_or(|of| of.stiffness[2][2] == 0.0)
}

/// A preload that vanishes since a ring is free along z.
fn preload(scene: &Scene, found: &mut Vec<Doubt>) {
    let [row] = scene.rows.as_slice() else {
        return;
    };
    let loose = [RingName::Outer, RingName::Inner]
        .into_iter()
        .find(|name| is_loose(scene, *name));
    if let Some(loose) = loose.filter(|_| row.axial_preload != 0.0) {
        let usual = format!(
            "has no effect, since the {name} ring of this single row is free along z; fix both rings along z \
             (outer_ring.support.z, inner_ring.support.z), preload by an axial load, or give a second row",
            name = loose.name()
        );
        let value = millimetres(row.axial_preload);
        found.push(Doubt::new("rows[0].axial_preload", value, usual));
    }
}

/// Thrust of the inner ring towards +z at t = 0, as it acts on the balls \[N\]; none where both rings are held along z.
fn thrust_of(scene: &Scene) -> Option<f64> {
    let on = |name: RingName| {
        let loads = scene.loads.values().filter(|load| load.ring == name);
        let along =
            loads.map(|load| load.force.at(0.0) * load.direction[2] / length(load.direction));
        is_loose(scene, name).then(|| along.sum::<f64>())
    };
    on(RingName::Inner).or_else(|| on(RingName::Outer).map(|thrust| -thrust))
}

/// Thrust that takes the load off the contacts of angular contact bearings.
fn thrust(scene: &Scene, found: &mut Vec<Doubt>) {
    let Some(thrust) = thrust_of(scene) else {
        return;
    };
    let side = scene.rows[0].side;
    let parts = |row: &Row| {
        let arched = row.outer_arch.is_some() || row.inner_arch.is_some();
        row.contact_angle > ANGULAR && row.side == side && !arched
    };
    if thrust * f64::from(side) < 0.0 && scene.rows.iter().all(parts) {
        let usual = format!(
            "thrust away from the contacts of an angular contact bearing of {}° with side = {side}, whose rings come apart: \
             balls climb the opposite sides of grooves that have no shoulders; turn the load or rows[0].side round",
            number(scene.rows[0].contact_angle.to_degrees())
        );
        let value = format!("{} N", number(thrust));
        found.push(Doubt::new("thrust on the inner ring", value, usual));
    }
}

/// Moduli that the law in slices does not include.
fn moduli(scene: &Scene, found: &mut Vec<Doubt>) {
    let steel = Material::default().youngs_modulus;
    let mut check = |path: String, material: &Material| {
        if (material.youngs_modulus / steel - 1.0).abs() > MODULUS {
            let usual = "has no effect on contacts: the law of ISO 16281 takes its stiffness from its constant \
                         (contact.law.iso16281.constant), which is that of steel; the law \"hertz\" uses the moduli";
            let value = format!("{} GPa", number(1e-9 * material.youngs_modulus));
            found.push(Doubt::new(format!("{path}.youngs_modulus"), value, usual));
        }
    };
    let follows = |row: &Row| scene.contact_of(row).law.is_of_steel();
    if scene.rows.iter().any(follows) {
        check("materials.rings".to_owned(), &scene.materials.rings);
    }
    if scene
        .rows
        .iter()
        .any(|row| follows(row) && row.ball_material.is_none())
    {
        check("materials.balls".to_owned(), &scene.materials.balls);
    }
    for (i, row) in scene
        .rows
        .iter()
        .enumerate()
        .filter(|(_, row)| follows(row))
    {
        if let Some(own) = &row.ball_material {
            check(format!("rows[{i}].ball_material"), own);
        }
    }
}

/// Defects of balls that spin about z at a contact angle.
fn balls(scene: &Scene, found: &mut Vec<Doubt>) {
    if scene.spin == Some(Spin::Free) {
        return;
    }
    let radial = scene.loads.values().map(|load| {
        let [x, y, _] = load.direction;
        load.force.at(0.0).abs() * x.hypot(y) / length(load.direction)
    });
    let thrust = thrust_of(scene).unwrap_or_default().abs();
    let is_pushed = thrust > THRUST * radial.sum::<f64>();
    for (name, defect) in scene
        .defects
        .iter()
        .filter(|(_, of)| of.on == Surface::Ball)
    {
        let angle = scene.rows[defect.row].contact_angle;
        if (is_pushed || angle > ANGULAR) && defect.damage.width() > 0.0 {
            let value = if angle > ANGULAR {
                format!("ball, contact angle {}°", number(angle.to_degrees()))
            } else {
                format!("ball, under {} N of thrust", number(thrust))
            };
            let usual = "balls spin about the bearing's axis, at BSF/cos α, and at a contact angle their defects meet one race \
                         only: the lines differ from those of a real ball; use spin = \"free\"";
            found.push(Doubt::new(format!("defects.{name}.on"), value, usual));
        }
    }
}
