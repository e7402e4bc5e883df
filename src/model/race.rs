//! Geometry of a race ([*Geometry of a row*](crate::equations#geometry-of-a-row)): a torus, a gothic arch of two, or a curve through
//! points.

use super::Race;
use super::body::groove_radius;
use crate::base::error::{Error, Result};
use crate::base::quantities::{length, number};
use crate::contact::{Before, Contour, Curve, Shape, Torus};
use crate::scene::{GothicArch, RaceProfile, Row};

/// A race in its ring's frame.
pub(super) enum RaceGeometry {
    /// A single surface, and the torus that it is or is like.
    One(Torus, Shape),
    /// The flanks of a gothic arch towards −z and +z, and its shim angle \[rad\].
    Arch([Torus; 2], f64),
}

/// Points of a groove with rounded shoulders, and of each rounding: the spline errs by less than 1e-9 of the groove's radius.
const OF_GROOVE: usize = 400;
const OF_EDGE: usize = 60;

/// The race of a row, which errors call `path`.
pub(super) fn geometry(path: &str, row: &Row, race: Race) -> Result<RaceGeometry> {
    let side = f64::from(row.side);
    let nominal = torus(row, race, groove_radius(row, race), row.contact_angle, side);
    let profile = [&row.outer_profile, &row.inner_profile][race];
    let arch = [&row.outer_arch, &row.inner_arch][race];
    let edge = [row.outer_shoulder_radius, row.inner_shoulder_radius][race];
    let path = format!("{path}.{}", race.name());
    if let Some(profile) = profile {
        return points(&format!("{path}_profile"), row, race, profile);
    }
    if let Some(arch) = arch {
        return Ok(RaceGeometry::Arch(flanks(row, race, arch), arch.shim_angle));
    }
    Ok(match edge {
        Some(edge) => rounded(row, race, &nominal, edge),
        None => RaceGeometry::One(nominal, Shape::default()),
    })
}

/// A groove of a radius whose contact is inclined by an angle at zero clearance, to a side of the outer contact.
fn torus(row: &Row, race: Race, r: f64, angle: f64, side: f64) -> Torus {
    let (radius, sigma) = (row.ball_diameter / 2.0, race.sigma());
    let (sin, cos) = angle.sin_cos();
    let shoulders = match race {
        Race::Outer => row.outer_shoulders,
        Race::Inner => row.inner_shoulders,
    };
    let [low, high] = shoulders.map_or([r, r], |angles| angles.map(|angle| r * angle.sin()));
    Torus {
        sigma,
        a: row.pitch_diameter / 2.0 - sigma * (r - radius) * cos + sigma * row.clearance / 4.0,
        centre: row.axial_position - sigma * side * (r - radius) * sin + preload(row, race),
        r,
        lowest: -low,
        highest: high,
    }
}

/// Axial place of a race from where it is without preload \[m\].
fn preload(row: &Row, race: Race) -> f64 {
    match race {
        Race::Outer => 0.0,
        Race::Inner => f64::from(row.side) * row.axial_preload,
    }
}

/// Angle of the nominal normal out of a ball towards +z at a race \[rad\].
fn inclination(row: &Row, race: Race) -> f64 {
    race.sigma() * f64::from(row.side) * row.contact_angle
}

/// Two grooves that a ball touches at the shim angle at zero clearance.
fn flanks(row: &Row, race: Race, arch: &GothicArch) -> [Torus; 2] {
    let own = groove_radius(row, race) / row.ball_diameter;
    let conformities = arch.conformities.unwrap_or([own; 2]);
    [0, 1].map(|flank| {
        let towards = [-1.0, 1.0][flank];
        let r = row.ball_diameter * conformities[flank];
        torus(row, race, r, arch.shim_angle, race.sigma() * towards)
    })
}

/// A race through points, which are those of zero clearance and preload.
fn points(path: &str, row: &Row, race: Race, profile: &RaceProfile) -> Result<RaceGeometry> {
    let (sigma, radius) = (race.sigma(), row.ball_diameter / 2.0);
    let shift = row.axial_position + preload(row, race);
    let z: Vec<f64> = profile.z.iter().map(|z| z + shift).collect();
    let wider = sigma * row.clearance / 4.0;
    let r: Vec<f64> = profile.r.iter().map(|r| r + wider).collect();
    let inclination = inclination(row, race);
    let contour = Contour::new(sigma, Curve::through(&z, &r), radius, inclination);
    let torus = contour.nominal().copied();
    let Some(torus) = torus.filter(|torus| torus.r > radius) else {
        return Err(Error::scene(
            format!("{path}.r"),
            format!("{} radii", profile.r.len()),
            format!(
                "a race that is concave, with a radius of curvature above the ball's, {}, where its normal is at contact_angle, \
                 {} rad",
                length(radius),
                number(inclination)
            ),
        ));
    };
    let pitch = row.pitch_diameter / 2.0;
    let (approach, _) = contour.approach(Before {
        radius,
        d: pitch,
        z: row.axial_position,
    });
    if !(-radius..=radius / 5.0).contains(&approach) {
        return Err(Error::scene(
            format!("{path}.r"),
            format!("{} radii", profile.r.len()),
            format!(
                "a race near the balls: this one would overlap a ball on the pitch circle by {}",
                length(approach)
            ),
        ));
    }
    Ok(RaceGeometry::One(
        torus,
        Shape::points(contour, inclination),
    ))
}

/// A torus whose shoulders fall off with a radius: the groove goes over into an arc that leads to the land.
fn rounded(row: &Row, race: Race, torus: &Torus, edge: f64) -> RaceGeometry {
    let Torus {
        sigma,
        a,
        centre,
        r,
        lowest,
        highest,
    } = *torus;
    let [low, high] = [lowest, highest].map(|x| (x / r).asin());
    let share = |k: usize, of: usize| k as f64 / of as f64;
    // Axial place and radius of a point of a circle about another.
    let at = |(z, height): (f64, f64), radius: f64, angle: f64| {
        (
            z + radius * angle.sin(),
            a + sigma * (height + radius * angle.cos()),
        )
    };
    let arc = |end: f64, angle: f64| {
        let about = (centre + (r + edge) * end.sin(), (r + edge) * end.cos());
        at(about, -edge, angle)
    };
    let first = (0..OF_EDGE).map(|k| arc(low, low * share(k, OF_EDGE)));
    let groove =
        (0..=OF_GROOVE).map(|k| at((centre, 0.0), r, low + (high - low) * share(k, OF_GROOVE)));
    let last = (1..=OF_EDGE).map(|k| arc(high, high * (1.0 - share(k, OF_EDGE))));
    let (z, radii): (Vec<f64>, Vec<f64>) = first.chain(groove).chain(last).unzip();
    let (radius, inclination) = (row.ball_diameter / 2.0, inclination(row, race));
    let contour = Contour::new(sigma, Curve::through(&z, &radii), radius, inclination);
    let [start, end] = contour.ends();
    let torus = Torus {
        lowest: start - centre,
        highest: end - centre,
        ..*torus
    };
    RaceGeometry::One(torus, Shape::points(contour, inclination))
}
