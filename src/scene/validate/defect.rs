//! Defects.

use std::f64::consts::PI;
use std::fmt::Display;

use super::check::{below, finite, positive, within};
use super::race::limits;
use crate::base::error::{Error, Result};
use crate::base::quantities;
use crate::scene::{Defect, Floor, Row, Scene, Surface, Width};

pub(super) fn defect(scene: &Scene, path: &str, defect: &Defect) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    let row = scene.row_index(path, defect.row)?;
    let radius = row.ball_diameter / 2.0;
    within(&at("angle"), defect.angle, -1e3..=1e3, "rad")?;
    if defect.is_steep() {
        between_walls(path, defect)?;
    } else if defect.is_pit() {
        pit(scene, path, row, defect)?;
    } else {
        positive(&at("edge_radius"), defect.edge_radius, "m")?;
    }
    if defect.is_cap() {
        only_what_a_cap_has(path, defect)?;
    } else if !defect.is_pit() {
        positive(&at("length"), defect.length, "m")?;
    }
    width(&at("width"), &defect.width)?;
    if let Some(offset) = defect.axial_offset.number() {
        finite(&at("axial_offset"), offset)?;
    }
    match (defect.on, defect.ball) {
        (Surface::Ball, Some(ball)) if ball < row.ball_count => {
            if defect.is_cap() {
                cap(path, row, defect)?;
            } else if defect.is_pit() {
                on_ball(path, row, defect)?;
            } else if scene.balls_turn() {
                let allowed = r#""cap" or "pit" for a ball that spins freely: a patch has its length along the axis"#;
                return Err(Error::scene(at("shape"), "absent", allowed));
            } else {
                on_ball(path, row, defect)?;
            }
        }
        (Surface::Ball, ball) => {
            let given = ball.map_or_else(|| "absent".to_owned(), |b| b.to_string());
            return Err(Error::scene(
                at("ball"),
                given,
                format!(
                    "a ball from 0 to {}, since the defect is on a ball",
                    row.ball_count - 1
                ),
            ));
        }
        (_, Some(ball)) => {
            return Err(Error::scene(
                at("ball"),
                ball,
                "absent for a defect on a race",
            ));
        }
        (surface, None) => on_race(path, row, defect, surface == Surface::OuterRace)?,
    }
    if let Some(Floor { depth, elements }) = &defect.floor {
        within(&at("floor.depth"), *depth, 0.0..=radius / 2.0, "m")?;
        if !(1..=1000).contains(elements) {
            return Err(Error::scene(at("floor.elements"), elements, "1 to 1000"));
        }
    }
    Ok(())
}

/// A defect with walls is a patch of one width, whose fault circles follow from the walls.
fn between_walls(path: &str, defect: &Defect) -> Result<()> {
    let refuse = |field: &str, value: &dyn Display, allowed: &str| {
        Err(Error::scene(format!("{path}.{field}"), value, allowed))
    };
    if defect.shape.is_some() {
        return refuse("walls", &"steep", "absent for a cap or a pit");
    }
    if defect.edge_radius != 0.0 {
        let allowed = "absent with steep walls, from which it follows";
        return refuse("edge_radius", &defect.edge_radius, allowed);
    }
    match &defect.width {
        Width::Constant(_) => Ok(()),
        Width::Profile(_) => refuse("width", &"a profile", "one number with steep walls"),
    }
}

/// A pit has a width and perhaps a length, lies in a plain groove, and overlaps no other defect.
fn pit(scene: &Scene, path: &str, row: &Row, defect: &Defect) -> Result<()> {
    let refuse = |field: &str, value: &dyn Display, allowed: &str| {
        Err(Error::scene(format!("{path}.{field}"), value, allowed))
    };
    within(&format!("{path}.length"), defect.length, 0.0..=1.0, "m")?;
    if defect.edge_radius != 0.0 {
        let allowed = "absent for a pit, whose edge is sharp";
        return refuse("edge_radius", &defect.edge_radius, allowed);
    }
    if defect.floor.is_some() {
        let allowed = "absent for a pit, whose floor no contact meets";
        return refuse("floor", &"given", allowed);
    }
    if matches!(defect.width, Width::Profile(_)) {
        return refuse("width", &"a profile", "one number for a pit");
    }
    if !row.has_plain_grooves() {
        let allowed = "absent in rows with race profiles, gothic arches or rounded shoulders";
        return refuse("shape", &"pit", allowed);
    }
    let others = scene
        .defects
        .iter()
        .filter(|(_, other)| !std::ptr::eq(*other, defect));
    for (name, other) in others {
        if overlaps(row, defect, other) {
            let allowed = format!("apart from defects.{name}, which it overlaps");
            return refuse("angle", &defect.angle, &allowed);
        }
    }
    Ok(())
}

/// Whether two defects of one body overlap; what is yet to be placed is checked again when it is.
fn overlaps(row: &Row, one: &Defect, other: &Defect) -> bool {
    let body = |defect: &Defect| (defect.on, defect.row, defect.ball);
    let [pitch, ball] = [row.pitch_diameter / 2.0, row.ball_diameter / 2.0];
    let radius = match one.on {
        Surface::OuterRace => pitch + ball,
        Surface::InnerRace => pitch - ball,
        Surface::Ball => ball,
    };
    let aside = (one.angle - other.angle).rem_euclid(2.0 * PI);
    let apart = radius * aside.min(2.0 * PI - aside);
    let across = match (one.axial_offset.number(), other.axial_offset.number()) {
        (Some(one), Some(other)) => (one - other).abs(),
        (None, None) => 0.0,
        _ => f64::INFINITY,
    };
    body(one) == body(other)
        && apart < f64::midpoint(one.width.largest(), other.width.largest())
        && across < f64::midpoint(one.extent(), other.extent())
}

/// A cap is on a ball, and its size is one width.
fn only_what_a_cap_has(path: &str, defect: &Defect) -> Result<()> {
    let refuse = |field: &str, value: &dyn Display, allowed: &str| {
        Err(Error::scene(format!("{path}.{field}"), value, allowed))
    };
    if defect.on != Surface::Ball {
        return refuse("shape", &"cap", "absent for a defect on a race");
    }
    if defect.length != 0.0 {
        let allowed = "absent for a cap, which is as long as it is wide";
        return refuse("length", &defect.length, allowed);
    }
    match &defect.width {
        Width::Constant(_) => Ok(()),
        Width::Profile(_) => refuse("width", &"a profile", "one number for a cap"),
    }
}

fn cap(path: &str, row: &Row, defect: &Defect) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    let (radius, width) = (row.ball_diameter / 2.0, defect.width.largest());
    // Then its rim passes a pole at more than 60 degrees from where contacts run.
    below(&at("width"), width, radius, "the ball's radius")?;
    // However the ball turns, the slices that contacts run in are larger.
    let (edge, half) = (defect.edge_radius, radius / 2.0);
    below(&at("edge_radius"), edge, half, "half the ball's radius")?;
    let offset = defect.axial_offset.number().unwrap_or(0.0);
    let allowed = "a place on the ball, in size below its radius";
    if offset.abs() < radius {
        Ok(())
    } else {
        let limit = quantities::length(radius);
        Err(Error::scene(
            at("axial_offset"),
            offset,
            format!("{allowed}, {limit}"),
        ))
    }
}

fn width(path: &str, width: &Width) -> Result<()> {
    match width {
        Width::Constant(w) => within(path, *w, 0.0..=10.0, "m"),
        Width::Profile(profile) => {
            let (positions, widths) = (&profile.positions, &profile.widths);
            if positions.is_empty() || positions.len() != widths.len() {
                return Err(Error::scene(
                    path,
                    format!("{} positions, {} widths", positions.len(), widths.len()),
                    "as many widths as positions, at least one",
                ));
            }
            for (i, w) in widths.iter().enumerate() {
                within(&format!("{path}.widths[{i}]"), *w, 0.0..=10.0, "m")?;
            }
            for (i, pair) in positions.windows(2).enumerate() {
                if pair[1].partial_cmp(&pair[0]) != Some(std::cmp::Ordering::Greater) {
                    return Err(Error::scene(
                        format!("{path}.positions[{}]", i + 1),
                        pair[1],
                        format!(
                            "above the position before it, {}",
                            quantities::length(pair[0])
                        ),
                    ));
                }
            }
            finite(&format!("{path}.positions[0]"), positions[0])
        }
    }
}

fn on_ball(path: &str, row: &Row, defect: &Defect) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    let radius = row.ball_diameter / 2.0;
    // At least: one that is yet to be placed is checked again when it is.
    let offset = defect.axial_offset.number().unwrap_or(0.0);
    below(
        &at("axial_offset"),
        offset.abs(),
        radius,
        "the ball's radius in size",
    )?;
    let reach = offset.abs() + defect.length / 2.0;
    if reach >= radius {
        let allowed = format!(
            "|axial_offset| + length/2 below the ball's radius, {}",
            quantities::length(radius)
        );
        return Err(Error::scene(at("length"), defect.length, allowed));
    }
    // Radius of the ball's smallest section that carries the defect.
    let section = (radius * radius - reach * reach).sqrt();
    below(
        &at("edge_radius"),
        defect.edge_radius,
        section,
        "the radius of the ball's section where the defect ends",
    )?;
    below(
        &at("width"),
        defect.width.largest(),
        PI * section,
        "half the circumference of the ball's section where the defect ends",
    )?;
    Ok(())
}

fn on_race(path: &str, row: &Row, defect: &Defect, outer: bool) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    let radius = row.ball_diameter / 2.0;

    let [first, last] = limits(row, outer);
    if let Some(offset) = defect.axial_offset.number() {
        let ends = format!(
            "the race ends at {} and {} from the row's plane",
            quantities::length(first),
            quantities::length(last)
        );
        if offset <= first || offset >= last {
            let allowed = format!("a place on the race: {ends}");
            return Err(Error::scene(at("axial_offset"), offset, allowed));
        }
        let half = defect.length / 2.0;
        if offset - half <= first || offset + half >= last {
            let allowed = format!(
                "a defect within the race: its middle is at {}, {ends}",
                quantities::length(offset)
            );
            return Err(Error::scene(at("length"), defect.length, allowed));
        }
    }
    below(
        &at("edge_radius"),
        defect.edge_radius,
        radius,
        "the ball's radius",
    )?;
    let race = (row.pitch_diameter - row.ball_diameter) / 2.0;
    below(
        &at("width"),
        defect.width.largest(),
        PI * race / 2.0,
        "a quarter of the race's circumference",
    )?;
    Ok(())
}
