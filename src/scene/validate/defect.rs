//! Defects.

use std::f64::consts::PI;
use std::fmt::Display;

use super::check::{below, finite, numbers, within};
use super::race::limits;
use crate::base::error::{Error, Result};
use crate::base::quantities;
use crate::scene::{Defect, Row, Scene, Surface, Width, WidthProfile};

pub(super) fn defect(scene: &Scene, path: &str, defect: &Defect) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    let damage = &defect.damage;
    let row = scene.row_index(path, defect.row)?;
    numbers(path, defect.numbers())?;
    numbers(path, damage.numbers())?;
    if damage.is_small() {
        small(scene, path, row, defect)?;
    }
    if damage.is_of_balls() && defect.on != Surface::Ball {
        let allowed = "absent for a defect on a race";
        return Err(Error::scene(at("shape"), damage.word(), allowed));
    }
    if let Width::Profile(profile) = &*damage.width_along() {
        width(&at("width"), profile)?;
    }
    if let Some(offset) = defect.axial_offset.number() {
        finite(&at("axial_offset"), offset)?;
    }
    surface(scene, path, row, defect)?;
    if let Some(floor) = damage.floor() {
        let most = row.ball_diameter / 4.0;
        within(&at("floor.depth"), floor.depth, 0.0..=most, "m")?;
        numbers(&at("floor"), floor.numbers())?;
    }
    Ok(())
}

/// Check that a defect lies on a ball of its row that it can lie on, or within a race.
fn surface(scene: &Scene, path: &str, row: &Row, defect: &Defect) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    match (defect.on, defect.ball) {
        (Surface::Ball, Some(ball)) if ball < row.ball_count => {
            if scene.balls_turn() && defect.damage.is_patch() {
                let word = defect.damage.word();
                let allowed = format!(
                    r#""cap", "pit" or "dent" for a ball that spins freely: a {word} has its length along the axis"#
                );
                Err(Error::scene(at("shape"), format!("{word:?}"), allowed))
            } else if defect.damage.is_of_balls() {
                cap(path, row, defect)
            } else {
                on_ball(path, row, defect)
            }
        }
        (Surface::Ball, ball) => {
            let given = ball.map_or_else(|| "absent".to_owned(), |b| b.to_string());
            Err(Error::scene(
                at("ball"),
                given,
                format!(
                    "a ball from 0 to {}, since the defect is on a ball",
                    row.ball_count - 1
                ),
            ))
        }
        (_, Some(ball)) => Err(Error::scene(
            at("ball"),
            ball,
            "absent for a defect on a race",
        )),
        (surface, None) => on_race(path, row, defect, surface == Surface::OuterRace),
    }
}

/// Check that a damage smaller than its contact lies in a plain groove, and overlaps no other defect.
fn small(scene: &Scene, path: &str, row: &Row, defect: &Defect) -> Result<()> {
    let refuse = |field: &str, value: &dyn Display, allowed: &str| {
        Err(Error::scene(format!("{path}.{field}"), value, allowed))
    };
    if !row.has_plain_grooves() {
        let allowed = "absent in rows with race profiles, gothic arches or rounded shoulders";
        return refuse("shape", &defect.damage.word(), allowed);
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
    let between = (one.angle - other.angle).rem_euclid(2.0 * PI);
    let apart = radius * between.min(2.0 * PI - between);
    let across = match (one.axial_offset.number(), other.axial_offset.number()) {
        (Some(one), Some(other)) => (one - other).abs(),
        (None, None) => 0.0,
        _ => f64::INFINITY,
    };
    let [one_size, other_size] = [one, other].map(|defect| defect.damage.footprint());
    body(one) == body(other)
        && apart < f64::midpoint(one_size[0], other_size[0])
        && across < f64::midpoint(one_size[1], other_size[1])
}

fn cap(path: &str, row: &Row, defect: &Defect) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    let (radius, width) = (row.ball_diameter / 2.0, defect.damage.width());
    // Then its rim passes a pole at more than 60 degrees from where contacts run.
    below(&at("width"), width, radius, "the ball's radius")?;
    // However the ball turns, the slices that contacts run in are larger.
    if let Some(edge) = defect.damage.edge_radius() {
        let half = radius / 2.0;
        below(&at("edge_radius"), edge, half, "half the ball's radius")?;
    }
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

fn width(path: &str, profile: &WidthProfile) -> Result<()> {
    let WidthProfile { positions, widths } = profile;
    if positions.is_empty() || positions.len() != widths.len() {
        return Err(Error::scene(
            path,
            format!("{} positions, {} widths", positions.len(), widths.len()),
            "as many widths as positions, at least one",
        ));
    }
    numbers(path, profile.numbers())?;
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
    let length = defect.damage.length().unwrap_or(0.0);
    let reach = offset.abs() + length / 2.0;
    if reach >= radius {
        let allowed = format!(
            "|axial_offset| + length/2 below the ball's radius, {}",
            quantities::length(radius)
        );
        return Err(Error::scene(at("length"), length, allowed));
    }
    // Radius of the ball's smallest section that carries the defect.
    let section = (radius * radius - reach * reach).sqrt();
    if let Some(edge) = defect.damage.edge_radius() {
        let what = "the radius of the ball's section where the defect ends";
        below(&at("edge_radius"), edge, section, what)?;
    }
    below(
        &at("width"),
        defect.damage.width(),
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
        let length = defect.damage.length().unwrap_or(0.0);
        let half = length / 2.0;
        if offset - half <= first || offset + half >= last {
            let allowed = format!(
                "a defect within the race: its middle is at {}, {ends}",
                quantities::length(offset)
            );
            return Err(Error::scene(at("length"), length, allowed));
        }
    }
    if let Some(edge) = defect.damage.edge_radius() {
        below(&at("edge_radius"), edge, radius, "the ball's radius")?;
    }
    let race = (row.pitch_diameter - row.ball_diameter) / 2.0;
    below(
        &at("width"),
        defect.damage.width(),
        PI * race / 2.0,
        "a quarter of the race's circumference",
    )?;
    Ok(())
}
