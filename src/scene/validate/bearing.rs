//! Rows, rings and supports.

use std::f64::consts::PI;

use super::check::{self, numbers, within};
use crate::base::error::{Error, Result};
use crate::base::quantities;
use crate::scene::{Mount, RingName, Row, Scene, Support};

pub(super) fn row(path: &str, row: &Row) -> Result<()> {
    numbers(path, row.numbers())?;
    circle_of_balls(path, row)?;
    angles_and_places(path, row)?;
    deviations(path, row)?;
    let at = |field: &str| format!("{path}.{field}");
    if row.ball_support.is_spatial() {
        let allowed = "mounts of x, y, z and theta only, since balls have no tilt";
        let given = "a tilt or a coupled support";
        return Err(Error::scene(at("ball_support"), given, allowed));
    }
    let mounts = row.ball_support.mounts(Mount::Free);
    if mounts.iter().any(|mount| matches!(mount, Mount::Given(_))) {
        let allowed =
            "free, fixed or sprung directions, since only rings can follow a given motion";
        return Err(Error::scene(at("ball_support"), "a given motion", allowed));
    }
    support(&at("ball_support"), &row.ball_support)
}

/// Balls that fit on their pitch circle.
fn circle_of_balls(path: &str, row: &Row) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    let (d, dm) = (row.ball_diameter, row.pitch_diameter);
    if dm <= d {
        return Err(Error::scene(
            at("pitch_diameter"),
            dm,
            format!("more than the ball diameter, {}", quantities::length(d)),
        ));
    }
    let count = row.ball_count as f64;
    let gap = dm * (PI / count).sin();
    if row.ball_count == 1 || gap > d {
        return Ok(());
    }
    let allowed = format!(
        "less than the distance of neighbouring balls, {}, for {count} balls on pitch diameter {}",
        quantities::length(gap),
        quantities::length(dm)
    );
    Err(Error::scene(at("ball_diameter"), d, allowed))
}

/// Grooves and where they stand.
fn angles_and_places(path: &str, row: &Row) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    if row.side != 1 && row.side != -1 {
        return Err(Error::scene(at("side"), row.side, "+1 or -1"));
    }
    let d = row.ball_diameter;
    within(&at("clearance"), row.clearance, -d / 10.0..=d / 2.0, "m")?;
    within(
        &at("axial_preload"),
        row.axial_preload,
        -d / 2.0..=d / 2.0,
        "m",
    )?;
    Ok(())
}

/// Deviations of races and balls from their nominal shape.
fn deviations(path: &str, row: &Row) -> Result<()> {
    let d = row.ball_diameter;
    for (field, waves) in [
        ("outer_waviness", &row.outer_waviness),
        ("inner_waviness", &row.inner_waviness),
    ] {
        for (i, wave) in waves.iter().enumerate() {
            let path = format!("{path}.{field}[{i}]");
            numbers(&path, wave.numbers())?;
            let path = format!("{path}.amplitude");
            within(&path, wave.amplitude, 0.0..=d / 10.0, "m")?;
        }
    }
    if !row.diameter_errors.is_empty() && row.diameter_errors.len() != row.ball_count {
        return Err(Error::scene(
            format!("{path}.diameter_errors"),
            format!("{} values", row.diameter_errors.len()),
            format!("none, or one for each of the {} balls", row.ball_count),
        ));
    }
    // A larger ball must still be smaller than both grooves.
    let largest = (2.0 * row.outer_conformity.min(row.inner_conformity) - 1.0) * d * 0.5;
    for (i, error) in row.diameter_errors.iter().enumerate() {
        within(
            &format!("{path}.diameter_errors[{i}]"),
            *error,
            -d / 10.0..=largest,
            "m",
        )?;
    }
    Ok(())
}

pub(super) fn ring(scene: &Scene, name: RingName) -> Result<()> {
    let (path, ring, outer, absent) = match name {
        RingName::Outer => ("outer_ring", &scene.outer_ring, true, Mount::Fixed),
        RingName::Inner => ("inner_ring", &scene.inner_ring, false, Mount::Free),
    };
    let at = |field: &str| format!("{path}.{field}");
    numbers(path, ring.numbers())?;
    if let Some(diameter) = ring.diameter {
        for (i, row) in scene.rows.iter().enumerate() {
            let (dm, d) = (row.pitch_diameter, row.ball_diameter);
            if outer && diameter <= dm + d || !outer && diameter >= dm - d {
                let (word, limit) = if outer {
                    ("above", dm + d)
                } else {
                    ("below", dm - d)
                };
                return Err(Error::scene(
                    at("diameter"),
                    diameter,
                    format!(
                        "{word} the groove bottom of rows[{i}], {}",
                        quantities::length(limit)
                    ),
                ));
            }
        }
    }
    if ring.mass.is_none() && (ring.diameter.is_none() || ring.width.is_none()) {
        let mounts = ring.support.mounts(absent);
        let tilts = ring.support.tilt_mounts();
        let mut all = mounts[..3].iter().chain(&tilts);
        if all.any(Mount::gives) {
            return Err(Error::scene(
                at("mass"),
                "absent",
                "a mass, or diameter and width to compute it from, since the ring can move",
            ));
        }
    }
    support(&at("support"), &ring.support)
}

fn support(path: &str, support: &Support) -> Result<()> {
    for (direction, mount) in [
        ("x", &support.x),
        ("y", &support.y),
        ("z", &support.z),
        ("theta", &support.theta),
    ] {
        let turns = direction == "theta";
        check::mount(&format!("{path}.{direction}"), mount.as_ref(), turns)?;
    }
    Ok(())
}
