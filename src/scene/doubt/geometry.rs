//! Rows, rings, materials, defects.

use std::f64::consts::PI;

use super::{Doubt, angle, length, millimetres};
use crate::base::quantities::{self, number};
use crate::scene::{Material, Ring, Row, Scene, Waviness};

/// Largest ball, largest pitch or ring diameter, and any other length \[m\]: a bearing of a bore of one metre has balls of
/// some 70 mm and is 1.42 m wide outside (dimension series 10 of ISO 15).
const LARGEST_BALL: f64 = 0.2;
const LARGEST_RING: f64 = 1.5;
const LARGEST: f64 = 1.0;
/// Ball over pitch diameter: thin-section bearings are near 0.02, those of dimension series 4 near 0.35.
const BALL_SHARE: [f64; 2] = [0.01, 0.6];
/// Groove radius over ball diameter: 0.51 to 0.54 for most, up to 0.57 for miniature bearings.
const CONFORMITY: [f64; 2] = [0.505, 0.6];
/// Largest clearance and interference over ball diameter.
const LARGEST_GAP: f64 = 0.02;
const INTERFERENCE: f64 = 0.01;
/// How far the pitch circle may lie from the middle of a bearing's section, over the section's height. In the catalogue by less
/// than a tenth; in thrust bearings and wheel hubs with flanges further.
const ASIDE: f64 = 0.25;
/// Density \[kg/m³\] from plastics to hard metal, Young's modulus \[Pa\] from plastics to diamond.
const DENSITY: [f64; 2] = [500.0, 25e3];
const MODULUS: [f64; 2] = [1e9, 1.5e12];

impl Doubt {
    /// Doubt about a defect that is narrower than the contacts that meet it \[m\].
    pub(crate) fn narrow_defect(name: &str, width: f64, contact: f64) -> Self {
        Self::new(
            format!("defects.{name}.width"),
            quantities::length(width),
            format!(
                "at least 1.3 times the width of the contacts that meet it ({}): narrower, the model's fault circles take less load \
                 from the contact than a real slot does; a pit (shape = \"pit\") takes the right part",
                quantities::length(contact)
            ),
        )
    }
}

pub(super) fn look(scene: &Scene, found: &mut Vec<Doubt>) {
    for (i, row) in scene.rows.iter().enumerate() {
        let path = format!("rows[{i}]");
        diameters(&path, row, found);
        gaps(&path, row, found);
        waves(&path, row, found);
        balls(&path, row, scene.ball_material_of(row), found);
        if let Some(own) = &row.ball_material {
            material(&format!("{path}.ball_material"), own, found);
        }
    }
    boundary(scene, found);
    let (rings, first) = (&scene.materials.rings, &scene.rows[0]);
    ring("outer_ring", &scene.outer_ring, rings, first, found);
    ring("inner_ring", &scene.inner_ring, rings, first, found);
    material("materials.rings", rings, found);
    material("materials.balls", &scene.materials.balls, found);
    for (name, defect) in &scene.defects {
        angle(format!("defects.{name}.angle"), defect.angle, found);
    }
}

fn diameters(path: &str, row: &Row, found: &mut Vec<Doubt>) {
    let (ball, pitch) = (row.ball_diameter, row.pitch_diameter);
    length(format!("{path}.ball_diameter"), ball, LARGEST_BALL, found);
    length(format!("{path}.pitch_diameter"), pitch, LARGEST_RING, found);
    let share = format!("{path}.ball_diameter / pitch_diameter");
    within(share, ball / pitch, BALL_SHARE, found);
    let conformities = [
        ("outer_conformity", row.outer_conformity),
        ("inner_conformity", row.inner_conformity),
    ];
    for (field, conformity) in conformities {
        within(format!("{path}.{field}"), conformity, CONFORMITY, found);
    }
    let place = format!("{path}.axial_position");
    length(place, row.axial_position, LARGEST, found);
    angle(format!("{path}.start_angle"), row.start_angle, found);
}

/// Small lengths, against the ball: the widest clearance group of a miniature bearing (C5 of ISO 5753-1) is 37 µm.
fn gaps(path: &str, row: &Row, found: &mut Vec<Doubt>) {
    let worst = |errors: &[f64]| errors.iter().fold(0.0_f64, |w, e| w.max(e.abs()));
    let smallest = [
        ("clearance", row.clearance, 50e-6, LARGEST_GAP),
        ("axial_preload", row.axial_preload, 0.2e-3, 0.05),
        ("diameter_errors", worst(&row.diameter_errors), 10e-6, 0.005),
    ];
    for (field, value, least, share) in smallest {
        let most = (share * row.ball_diameter).max(least);
        length(format!("{path}.{field}"), value, most, found);
    }
    interference(path, row, found);
}

/// Fits and heat take a clearance of 5 to 40 µm away and rarely more.
fn interference(path: &str, row: &Row, found: &mut Vec<Doubt>) {
    let most = (INTERFERENCE * row.ball_diameter).max(20e-6);
    // A larger one is reported as a length.
    let largest = (LARGEST_GAP * row.ball_diameter).max(50e-6);
    if row.clearance < -most && -row.clearance <= largest {
        let usual = format!(
            "an interference that presses every ball as heavy loads do; fits and heat leave at most {} in a bearing of this size; \
             lengths are in metres",
            micrometres(most)
        );
        let value = micrometres(row.clearance);
        found.push(Doubt::new(format!("{path}.clearance"), value, usual));
    }
}

/// A pitch diameter that lies beside the middle of bore and outside diameter.
fn boundary(scene: &Scene, found: &mut Vec<Doubt>) {
    let rings = [&scene.inner_ring, &scene.outer_ring].map(|ring| ring.diameter);
    let [Some(bore), Some(outside)] = rings else {
        return;
    };
    let (middle, height) = (f64::midpoint(bore, outside), (outside - bore) / 2.0);
    for (i, row) in scene.rows.iter().enumerate() {
        // Beyond any ring they are reported already, or stand for a housing and a shaft.
        let is_off = (row.pitch_diameter - middle).abs() > ASIDE * height;
        if is_off && height > row.ball_diameter && height < 6.0 * row.ball_diameter {
            let usual = format!(
                "bore and outside diameter, {} and {}, put the balls near {}; a bearing whose rings were changed keeps the rows \
                 that it had",
                millimetres(bore),
                millimetres(outside),
                millimetres(middle)
            );
            let value = millimetres(row.pitch_diameter);
            found.push(Doubt::new(
                format!("rows[{i}].pitch_diameter"),
                value,
                usual,
            ));
        }
    }
}

fn micrometres(x: f64) -> String {
    format!("{} µm", number(1e6 * x))
}

fn waves(path: &str, row: &Row, found: &mut Vec<Doubt>) {
    let most = (0.005 * row.ball_diameter).max(20e-6);
    let mut look = |field: &str, waves: &[Waviness]| {
        for (i, wave) in waves.iter().enumerate() {
            let at = |name: &str| format!("{path}.{field}[{i}].{name}");
            length(at("amplitude"), wave.amplitude, most, found);
            angle(at("phase"), wave.phase, found);
        }
    };
    look("outer_waviness", &row.outer_waviness);
    look("inner_waviness", &row.inner_waviness);
}

/// A given mass or inertia of a ball that is not that of a ball of its material within a factor of ten.
fn balls(path: &str, row: &Row, material: &Material, found: &mut Vec<Doubt>) {
    let solid = material.density * PI / 6.0 * row.ball_diameter.powi(3);
    let inertia = 0.1 * row.ball_mass.unwrap_or(solid) * row.ball_diameter.powi(2);
    let given = [
        ("ball_mass", row.ball_mass, solid, "kg"),
        ("ball_inertia", row.ball_inertia, inertia, "kg m²"),
    ];
    for (field, value, usual, unit) in given {
        if let Some(value) = value
            && !(0.1..=10.0).contains(&(value / usual))
        {
            let usual = format!("a solid ball of this diameter has {} {unit}", number(usual));
            let value = format!("{} {unit}", number(value));
            found.push(Doubt::new(format!("{path}.{field}"), value, usual));
        }
    }
}

fn ring(path: &str, ring: &Ring, material: &Material, row: &Row, found: &mut Vec<Doubt>) {
    let at = |field: &str| format!("{path}.{field}");
    let or_none = Option::unwrap_or_default;
    length(at("diameter"), or_none(ring.diameter), LARGEST_RING, found);
    length(at("width"), or_none(ring.width), LARGEST, found);
    let Some(mass) = ring.mass else { return };
    // Of the ring alone, some; with a rotor, up to ten times a ball of steel as large as the pitch circle.
    let alone = material.density * PI * row.pitch_diameter * 0.3 * row.ball_diameter.powi(2);
    let rotor = 10.0 * material.density * PI / 6.0 * row.pitch_diameter.powi(3);
    let (least, most) = (1e-2 * alone, rotor.max(1e3));
    if !(least..=most).contains(&mass) {
        let usual = format!(
            "a ring of this size, with what moves with it, has {} to {} kg; masses are in kilograms",
            number(least),
            number(most)
        );
        found.push(Doubt::new(at("mass"), format!("{mass} kg"), usual));
    }
}

fn material(path: &str, material: &Material, found: &mut Vec<Doubt>) {
    let [low, high] = DENSITY;
    if !(low..=high).contains(&material.density) {
        let usual = format!("solids have {low} to {high} kg/m³, steel 7850");
        let value = format!("{} kg/m³", material.density);
        found.push(Doubt::new(format!("{path}.density"), value, usual));
    }
    let [low, high] = MODULUS;
    if !(low..=high).contains(&material.youngs_modulus) {
        let usual = format!(
            "materials of bearings have {} to {} GPa, steel 206; moduli are in pascals",
            1e-9 * low,
            1e-9 * high
        );
        let value = format!("{} GPa", number(1e-9 * material.youngs_modulus));
        found.push(Doubt::new(format!("{path}.youngs_modulus"), value, usual));
    }
}

/// A ratio outside what bearings have.
fn within(path: String, value: f64, [low, high]: [f64; 2], found: &mut Vec<Doubt>) {
    if !(low..=high).contains(&value) {
        let usual = format!("bearings have {low} to {high}");
        found.push(Doubt::new(path, number(value), usual));
    }
}
