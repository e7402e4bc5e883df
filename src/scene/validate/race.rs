//! Shapes of races.

use super::check::{numbers, within};
use crate::base::error::{Error, Result};
use crate::base::quantities;
use crate::scene::numbers::up_to;
use crate::scene::{Contact, GothicArch, RaceProfile, Row};

/// Fewest and most points of a profile.
const POINTS: (usize, usize) = (4, 10_000);

/// The fields of a row for one of its races.
struct RaceFields<'a> {
    name: &'a str,
    shoulders: Option<[f64; 2]>,
    edge: Option<f64>,
    profile: &'a Option<RaceProfile>,
    arch: &'a Option<GothicArch>,
}

/// The races of a row whose balls follow a contact law.
pub(super) fn races(path: &str, row: &Row, contact: &Contact) -> Result<()> {
    let outer = RaceFields {
        name: "outer",
        shoulders: row.outer_shoulders,
        edge: row.outer_shoulder_radius,
        profile: &row.outer_profile,
        arch: &row.outer_arch,
    };
    let inner = RaceFields {
        name: "inner",
        shoulders: row.inner_shoulders,
        edge: row.inner_shoulder_radius,
        profile: &row.inner_profile,
        arch: &row.inner_arch,
    };
    race(path, row, contact, &outer)?;
    race(path, row, contact, &inner)
}

fn race(path: &str, row: &Row, contact: &Contact, of: &RaceFields<'_>) -> Result<()> {
    let at = |field: &str| format!("{path}.{}_{field}", of.name);
    if let Some(profile) = of.profile {
        only(&at("arch"), of.arch.is_some(), "a profile")?;
        only(
            &at("shoulders"),
            of.shoulders.is_some(),
            "a profile, which ends with its points",
        )?;
        points(&at("profile"), row, profile)?;
    }
    if let Some(arch) = of.arch {
        gothic(&at("arch"), arch, of.shoulders)?;
    }
    let Some(edge) = of.edge else { return Ok(()) };
    let path = at("shoulder_radius");
    within(&path, edge, up_to(row.ball_diameter), "m")?;
    only(
        &path,
        of.profile.is_some() || of.arch.is_some(),
        "a profile or an arch",
    )?;
    if of.shoulders.is_none() {
        let allowed = format!("absent without {}", at("shoulders"));
        return Err(Error::scene(path, edge, allowed));
    }
    if contact.law.is_flat() {
        let allowed = "absent with Hertz's law, which does not include the end of a groove; contact.law = iso16281 does";
        return Err(Error::scene(path, edge, allowed));
    }
    Ok(())
}

/// Refuses a field that another one excludes.
fn only(path: &str, given: bool, beside: &str) -> Result<()> {
    if given {
        return Err(Error::scene(
            path,
            "given",
            format!("absent beside {beside}"),
        ));
    }
    Ok(())
}

fn points(path: &str, row: &Row, profile: &RaceProfile) -> Result<()> {
    let RaceProfile { z, r } = profile;
    if z.len() != r.len() || !(POINTS.0..=POINTS.1).contains(&z.len()) {
        return Err(Error::scene(
            path,
            format!("{} places, {} radii", z.len(), r.len()),
            format!("as many radii as places, {} to {}", POINTS.0, POINTS.1),
        ));
    }
    let reach = 2.0 * row.ball_diameter;
    for (i, z) in z.iter().enumerate() {
        within(&format!("{path}.z[{i}]"), *z, -reach..=reach, "m")?;
    }
    for (i, pair) in z.windows(2).enumerate() {
        if pair[1] <= pair[0] {
            return Err(Error::scene(
                format!("{path}.z[{}]", i + 1),
                pair[1],
                format!("above the place before it, {}", quantities::length(pair[0])),
            ));
        }
    }
    numbers(path, profile.numbers())
}

fn gothic(path: &str, arch: &GothicArch, shoulders: Option<[f64; 2]>) -> Result<()> {
    numbers(path, arch.numbers())?;
    let angle = arch.shim_angle;
    if shoulders.is_some_and(|s| s.iter().any(|shoulder| *shoulder <= angle)) {
        let allowed = "below both shoulder angles";
        return Err(Error::scene(format!("{path}.shim_angle"), angle, allowed));
    }
    Ok(())
}

/// Ends of a race, from the row's plane \[m\]; without what shoulders leave of a race that has none.
pub(super) fn limits(row: &Row, outer: bool) -> [f64; 2] {
    let (f, shoulders, profile, arch, sign) = if outer {
        let own = (&row.outer_profile, &row.outer_arch);
        (
            row.outer_conformity,
            row.outer_shoulders,
            own.0,
            own.1,
            -1.0,
        )
    } else {
        let own = (&row.inner_profile, &row.inner_arch);
        (row.inner_conformity, row.inner_shoulders, own.0, own.1, 1.0)
    };
    let side = f64::from(row.side);
    let preload = if outer { 0.0 } else { side * row.axial_preload };
    if let Some(profile) = profile {
        return [0, profile.z.len() - 1].map(|i| profile.z[i] + preload);
    }
    // Axial place of a groove's centre from the row's plane ([*Geometry of a row*](crate::equations#geometry-of-a-row)).
    let centre = |groove: f64, angle: f64, side: f64| {
        sign * side * (groove - row.ball_diameter / 2.0) * angle.sin() + preload
    };
    let ends = |groove: f64| shoulders.map_or([groove; 2], |s| s.map(|angle| groove * angle.sin()));
    if let Some(arch) = arch {
        let [low, high] = arch
            .conformities
            .unwrap_or([f; 2])
            .map(|f| f * row.ball_diameter);
        // The flank towards +z is struck from a centre at −z, of either ring.
        let of = |groove: f64, towards: f64| centre(groove, arch.shim_angle, -sign * towards);
        return [of(low, -1.0) - ends(low)[0], of(high, 1.0) + ends(high)[1]];
    }
    let groove = f * row.ball_diameter;
    let middle = centre(groove, row.contact_angle, side);
    [middle - ends(groove)[0], middle + ends(groove)[1]]
}
