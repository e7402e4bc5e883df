//! Numbers that are possible but improbably small, or written as if in another unit.

use std::f64::consts::TAU;

use super::{Doubt, millimetres};
use crate::base::quantities::number;
use crate::scene::{Drive, Scene};

/// Width of a defect \[m\]: contacts are some tenths of a millimetre wide, and roughness is flattened in them.
const WIDTH: f64 = 20e-6;
/// Speed times pitch diameter, n d_m \[mm/min\], below that of the slowest bearings, some ten thousand in wind turbines, and above
/// that of trials that all but stand still: where turns a second were taken for turns a minute.
const SLOW: std::ops::Range<f64> = 1e2..2e3;
/// Load over ISO 76's static rating C₀, and load \[N\]: makers ask for a hundredth of the dynamic rating at least.
const LOAD_SHARE: f64 = 1e-3;
const LOAD: f64 = 50.0;
/// ISO 76's C₀ over Z D² cos α of deep-groove and angular-contact ball bearings \[Pa\].
const RATING: f64 = 14e6;

pub(super) fn look(scene: &Scene, found: &mut Vec<Doubt>) {
    for (name, defect) in &scene.defects {
        let width = defect.damage.width();
        if width > 0.0 && width < WIDTH {
            let usual = "less than a fiftieth of a millimetre: contacts are far wider, and it has hardly any effect; widths are in \
                         metres, width_mm in millimetres";
            let path = format!("defects.{name}.width");
            found.push(Doubt::new(path, millimetres(width), usual));
        }
    }
    speed(scene, found);
    loads(scene, found);
}

fn speed(scene: &Scene, found: &mut Vec<Doubt>) {
    if matches!(scene.drive, Drive::Torque { .. }) {
        return;
    }
    let turns = scene.peak_relative_speed() * 60.0 / TAU;
    let pitches = scene.rows.iter().map(|row| row.pitch_diameter);
    let factor = turns * 1e3 * pitches.fold(0.0, f64::max);
    if SLOW.contains(&factor) {
        let usual = format!(
            "times the pitch diameter {} mm/min, slower than any machine's bearing; drive.speed is in radians a second, \
             speed_rpm in turns a minute",
            number(factor)
        );
        let value = format!("{} 1/min", number(turns));
        found.push(Doubt::new("drive.speed", value, usual));
    }
}

/// Doubts about all loads together, where nothing else presses the balls.
fn loads(scene: &Scene, found: &mut Vec<Doubt>) {
    let preloaded = scene
        .rows
        .iter()
        .any(|row| row.axial_preload > 0.0 || row.clearance < 0.0);
    let sizes = || {
        scene
            .loads
            .iter()
            .map(|(name, load)| (name, load.force.peak()))
    };
    let sum: f64 = sizes().map(|(_, size)| size).sum();
    let ratings = scene.rows.iter().map(|row| {
        RATING * row.ball_count as f64 * row.ball_diameter.powi(2) * row.contact_angle.cos()
    });
    let rating: f64 = ratings.sum();
    if preloaded
        || !scene.unbalances.is_empty()
        || !(sum > 0.0 && sum < LOAD.min(LOAD_SHARE * rating))
    {
        return;
    }
    if let Some((name, size)) = sizes().max_by(|a, b| a.1.total_cmp(&b.1)) {
        let usual = format!(
            "less than a thousandth of the static load rating, near {} kN, under which balls hardly roll; loads are in \
             newtons",
            number(1e-3 * rating)
        );
        let path = format!("loads.{name}.force");
        found.push(Doubt::new(path, format!("{} N", number(size)), usual));
    }
}
