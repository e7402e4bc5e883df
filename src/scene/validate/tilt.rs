//! Rings that tilt: how far, on what supports, and under which moments.

use nalgebra::Matrix6;

use super::check::{self, entry_name, place, positive, within};
use super::load::{direction, time_function};
use crate::base::error::{Error, Result};
use crate::base::quantities::number;
use crate::scene::{CoupledSupport, Drive, Mount, Ring, Scene};

/// The furthest that a ring may tilt \[rad\].
const FURTHEST: f64 = 0.5;
/// How far a coupled support may miss being symmetric and positive semidefinite, over its largest entry: rounding.
const ROUNDING: f64 = 1e-9;

/// A ring's own fields; `is_driven` where the drive prescribes its rotation.
pub(super) fn ring(path: &str, ring: &Ring, is_driven: bool) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    if let Some(inertia) = ring.transverse_inertia {
        positive(&at("transverse_inertia"), inertia, "kg m²")?;
    }
    if let Some(centre) = ring.centre_of_mass {
        place(&at("centre_of_mass"), centre)?;
    }
    if let Some([x, y]) = ring.tilt
        && (!(x.is_finite() && y.is_finite()) || x.hypot(y) > FURTHEST)
    {
        let allowed = format!("two numbers, together at most {FURTHEST} rad");
        return Err(Error::scene(at("tilt"), format!("{:?}", [x, y]), allowed));
    }
    for (field, mount) in [
        ("tilt_x", ring.support.tilt_x),
        ("tilt_y", ring.support.tilt_y),
    ] {
        check::mount(&at(&format!("support.{field}")), mount, true)?;
    }
    match &ring.support.coupled {
        Some(coupled) => support(&at("support.coupled"), coupled, is_driven),
        None => Ok(()),
    }
}

/// A coupled support.
fn support(path: &str, coupled: &CoupledSupport, is_driven: bool) -> Result<()> {
    place(&format!("{path}.axial_position"), coupled.axial_position)?;
    for (field, rows) in [
        ("stiffness", coupled.stiffness),
        ("damping", coupled.damping),
    ] {
        let path = format!("{path}.{field}");
        for (i, row) in rows.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                within(&format!("{path}[{i}][{j}]"), *entry, -1e15..=1e15, "")?;
            }
        }
        let matrix = Matrix6::from_fn(|i, j| rows[i][j]);
        let largest = matrix.amax();
        if (matrix - matrix.transpose()).amax() > ROUNDING * largest {
            return Err(Error::scene(path, "not symmetric", "a symmetric matrix"));
        }
        let least = matrix.symmetric_eigenvalues().min();
        if least < -ROUNDING * largest {
            let told = format!("with an eigenvalue of {}", number(least));
            let allowed = "positive semidefinite: no eigenvalue below 0";
            return Err(Error::scene(path, told, allowed));
        }
        if is_driven && rows[5] != [0.0; 6] {
            let allowed = "0 in the row and column of θ, since drive.speed turns the ring";
            return Err(Error::scene(path, format!("{:?}", rows[5]), allowed));
        }
    }
    Ok(())
}

/// Moments, and places of loads and unbalances on rings.
pub(super) fn loads(scene: &Scene) -> Result<()> {
    for (name, moment) in &scene.moments {
        entry_name("moments", name)?;
        direction(&format!("moments.{name}"), &moment.direction)?;
        time_function(
            &format!("moments.{name}.moment"),
            &moment.moment,
            (1e12, "N m"),
        )?;
    }
    for (name, load) in &scene.loads {
        for (i, at) in load.at.unwrap_or_default().into_iter().enumerate() {
            place(&format!("loads.{name}.at[{i}]"), at)?;
        }
    }
    for (name, unbalance) in &scene.unbalances {
        let path = format!("unbalances.{name}");
        let offset = unbalance.axial_position.unwrap_or_default();
        place(&format!("{path}.axial_position"), offset)?;
        let is_driven = matches!(scene.drive, Drive::Speed(_));
        let (ring, turns) = match unbalance.ring {
            crate::scene::RingName::Outer => (
                &scene.outer_ring,
                scene.outer_ring.support.mounts(Mount::Fixed)[3] != Mount::Fixed,
            ),
            crate::scene::RingName::Inner => (&scene.inner_ring, !is_driven),
        };
        if ring.leans() && turns {
            let allowed = "a ring whose rotation is driven or held, where that ring may tilt";
            return Err(Error::scene(
                format!("{path}.ring"),
                unbalance.ring.name(),
                allowed,
            ));
        }
    }
    Ok(())
}
