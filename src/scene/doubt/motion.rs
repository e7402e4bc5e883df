//! Friction, cage, drive, gravity, loads.

use std::f64::consts::TAU;

use super::{Doubt, angle, length, phase};
use crate::base::quantities::number;
use crate::scene::contact::extreme_slip;
use crate::scene::numbers::BoundedNumber;
use crate::scene::{CageRing, Contact, Drive, Friction, Row, Scene, TimeFunction};

/// Speed times pitch diameter, n d_m \[mm/min\]: bearings of aircraft engines come near it, and one of 120 mm bore on a
/// test rig reached 3.9 million (E. N. Bamberger, E. V. Zaretsky, H. Signer, NASA TN D-7870, 1975).
const SPEED_FACTOR: f64 = 3e6;
/// The same of bearings whose balls touch in the middle of the groove: makers' reference speeds of deep groove bearings in oil
/// end near 1.1 million (6205: 28 000 1/min), and those for grease or by the cage's strength near 700 000.
const DEEP_GROOVE: f64 = 1.2e6;
/// Nominal contact angle up to which a bearing is one of them \[rad\]; spindles and dental turbines begin at 12°.
const DEEP_GROOVE_ANGLE: f64 = 0.17;
/// Coefficient of friction of any bearing material, dry.
const FRICTION: f64 = 1.0;
/// Speed below which friction fades \[m/s\]: faster slip is seen by few contacts at all.
const SLIP: f64 = 10.0;
/// Acceleration of gravity \[m/s²\]: a hundred times the earth's.
const GRAVITY: f64 = 1e3;
/// Hunt–Crossley damping \[s/m\]: K. H. Hunt, F. R. E. Crossley, *J. Appl. Mech.* 42 (1975) 440, have 0.08 to 0.32 of steel,
/// bronze and ivory.
const DAMPING: f64 = 5.0;
/// Stiffness of a steel ball on a race under usual loads over its diameter \[N/m²\]: 5.4·10⁷ N/m in a 6205.
const CONTACT: f64 = 6.8e9;
/// Centrifugal acceleration of a ball over that of gravity from which it is pressed on the outer race all the way round: with less it
/// rattles in any cage.
const PRESSED: f64 = 4.0;
/// Unbalance \[kg m\]; that of a machine is balanced to some µm times its mass (ISO 21940-11).
const UNBALANCE: f64 = 1.0;

pub(super) fn look(scene: &Scene, found: &mut Vec<Doubt>) {
    friction("friction", &scene.friction, found);
    for (i, row) in scene.rows.iter().enumerate() {
        if let Some(own) = &row.friction {
            friction(&format!("rows[{i}].friction"), own, found);
        }
    }
    damping("contact", &scene.contact, found);
    for (i, row) in scene.rows.iter().enumerate() {
        if let Some(own) = &row.contact {
            damping(&format!("rows[{i}].contact"), own, found);
        }
    }
    if let Some(cage) = scene.cage_links() {
        let most = 0.5 * scene.rows[0].ball_diameter;
        length("cage.play".to_owned(), cage.play, most, found);
    }
    if let Some(ring) = scene.cage_ring() {
        pockets(scene, ring, found);
    }
    speed(scene, found);
    let gravity = scene.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
    if gravity > GRAVITY {
        let usual = "more than a hundred times the earth's 9.81 m/s²";
        let value = format!("{} m/s²", number(gravity));
        found.push(Doubt::new("gravity", value, usual));
    }
    for (name, load) in &scene.loads {
        phase(&format!("loads.{name}.force"), &load.force, found);
    }
    for (name, unbalance) in &scene.unbalances {
        angle(format!("unbalances.{name}.angle"), unbalance.angle, found);
        if unbalance.moment >= UNBALANCE {
            let [outer, inner] = scene.peak_speeds();
            let speed = inner.max(outer);
            let force = unbalance.moment * speed.powi(2);
            let usual = format!(
                "machines keep below {UNBALANCE} kg m; it pulls with {} N at {} 1/min",
                number(force),
                number(speed * 60.0 / TAU)
            );
            let value = format!("{} kg m", number(unbalance.moment));
            found.push(Doubt::new(
                format!("unbalances.{name}.moment"),
                value,
                usual,
            ));
        }
    }
}

/// Pockets that are as stiff as contacts, and those whose friction lifts balls off the outer race more than that of the
/// default ones does: of those very small and slow bearings rattle, too, as real ones do.
fn pockets(scene: &Scene, ring: &CageRing, found: &mut Vec<Doubt>) {
    let [gx, gy, _] = scene.gravity;
    let gravity = gx.hypot(gy);
    let [outer, inner] = scene.peak_speeds();
    for row in &scene.rows {
        let (d, pitch) = (row.ball_diameter, row.pitch_diameter / 2.0);
        let density = scene.ball_material_of(row).density;
        let ball = row
            .ball_mass
            .unwrap_or(density * std::f64::consts::PI / 6.0 * d.powi(3));
        let stiffness = ring.stiffness(d);
        let turning = row.ball_count as f64 * pitch * pitch / ring.inertia(row);
        let most = 2.0 * CONTACT * d / (1.0 + ball * turning);
        if stiffness > most {
            let usual = format!(
                "balls and cage vibrate on it faster than balls on their races, which shortens the steps; {} N/m would be as fast",
                number(most)
            );
            let value = format!("{} N/m", number(stiffness));
            found.push(Doubt::new("cage.ring.stiffness", value, usual));
        }
        let ftf = row.geometry().orders().ftf;
        let thrown = (ftf * inner + (1.0 - ftf) * outer).powi(2) * pitch;
        let fall = |of: &CageRing| {
            (4.0 * gravity * of.pocket_clearance(d) * of.stiffness(d) * ball).sqrt()
        };
        let usually = CageRing::default();
        let least = usually.friction * fall(&usually);
        let fall = fall(ring);
        let held = 0.5 * ball * (thrown - gravity);
        if thrown > PRESSED * gravity && ring.friction * fall > held.max(least) {
            let usual = format!(
                "balls that fall through their pockets meet the wall with up to {} N, and friction of more than {} N lifts them off \
                 the outer race: a healthy bearing rattles. {} would be the most",
                number(fall),
                number(held),
                number(held / fall)
            );
            found.push(Doubt::new(
                "cage.ring.friction",
                number(ring.friction),
                usual,
            ));
        }
    }
}

fn damping(path: &str, contact: &Contact, found: &mut Vec<Doubt>) {
    if contact.damping > DAMPING {
        let usual = "impacts of steel balls give 0.08 to 0.32 s/m (Hunt and Crossley 1975); with so much damping a ball that meets a \
                     race at 0.1 m/s hardly springs back";
        let value = format!("{} s/m", number(contact.damping));
        found.push(Doubt::new(format!("{path}.damping"), value, usual));
    }
}

fn friction(path: &str, friction: &Friction, found: &mut Vec<Doubt>) {
    let Some((law, numbers)) = friction.numbers() else {
        return;
    };
    let number_of = |of: BoundedNumber| Some((of.field, of.value?));
    let mut numbers: Vec<_> = numbers.into_iter().filter_map(number_of).collect();
    if let Friction::Traction { a, b, c, d, .. } = *friction {
        let slip = extreme_slip([a, b, c]);
        let peak = ((a + b * slip) * (-c * slip).exp() + d).max(a + d).max(d);
        numbers.push(("largest coefficient", peak));
    }
    for (field, value) in numbers {
        if field.ends_with("coefficient") && value > FRICTION {
            let usual = "rolling bearings have 0.001 to 0.2, dry steel less than 1";
            found.push(Doubt::new(
                format!("{path}.{law}.{field}"),
                number(value),
                usual,
            ));
        }
    }
    if let Some(speed) = friction.slip_speed().filter(|speed| *speed > SLIP) {
        let usual = "below it friction fades, so that rolling balls would have none; speeds are in metres a second";
        let value = format!("{} m/s", number(speed));
        found.push(Doubt::new(format!("{path}.{law}.slip_speed"), value, usual));
    }
}

fn speed(scene: &Scene, found: &mut Vec<Doubt>) {
    let peak = scene.peak_relative_speed();
    let turns = peak * 60.0 / TAU;
    let factor = |row: &Row| turns * 1e3 * row.pitch_diameter;
    let is_deep_groove = |row: &Row| row.contact_angle < DEEP_GROOVE_ANGLE;
    let limit = |row: &Row| {
        if is_deep_groove(row) {
            DEEP_GROOVE
        } else {
            SPEED_FACTOR
        }
    };
    // The row that is furthest beyond what it can bear.
    let share = |row: &&Row| factor(row) / limit(row);
    let Some(row) = scene
        .rows
        .iter()
        .max_by(|a, b| share(a).total_cmp(&share(b)))
    else {
        return;
    };
    let outer = scene.outer_speed.as_ref();
    if let Some(speed) = outer {
        phase("outer_speed", speed, found);
    }
    let path = match &scene.drive {
        Drive::Speed(speed) if speed.peak() < outer.map_or(0.0, TimeFunction::peak) => {
            phase("drive.speed", speed, found);
            "outer_speed"
        }
        Drive::Speed(speed) => {
            phase("drive.speed", speed, found);
            "drive.speed"
        }
        Drive::Torque { value, .. } => {
            phase("drive.torque.value", value, found);
            "drive.torque.initial_speed"
        }
    };
    if factor(row) > limit(row) {
        let fastest = if is_deep_groove(row) {
            "deep groove bearings in oil"
        } else {
            "the fastest bearings, of aircraft engines,"
        };
        let usual = format!(
            "{} 1/min, times the pitch diameter {} mm/min, where {fastest} come near {}; speeds are in radians a second: {} \
             1/min would be {} rad/s",
            number(turns),
            number(factor(row)),
            number(limit(row)),
            number(peak),
            number(peak * TAU / 60.0)
        );
        let value = format!("{} rad/s", number(peak));
        found.push(Doubt::new(path, value, usual));
    }
}
