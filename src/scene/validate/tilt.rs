//! Rings that tilt: how far, on what supports, and under which moments.

use nalgebra::Matrix6;

use super::check::{self, entry_name, numbers, within};
use super::load::{direction, time_function};
use crate::base::error::{Error, Result};
use crate::base::quantities::number;
use crate::scene::{
    CoupledSupport, Moment, Mount, Profile, RingName, Scene, Support, TimeFunction,
};

/// The furthest that a ring may tilt \[rad\].
const FURTHEST: f64 = 0.5;
/// The furthest place that a ring may be given along an axis \[m\].
const FURTHEST_PLACE: f64 = 0.1;
/// How far a coupled support may miss being symmetric and positive semidefinite, over its largest entry: rounding.
const ROUNDING: f64 = 1e-9;

/// A ring's own fields.
pub(super) fn ring(scene: &Scene, name: RingName) -> Result<()> {
    let (path, ring, speed) = match name {
        RingName::Outer => ("outer_ring", &scene.outer_ring, "outer_speed"),
        RingName::Inner => ("inner_ring", &scene.inner_ring, "drive.speed"),
    };
    let turned_by = scene.given_speed(name).map(|_| speed);
    let at = |field: &str| format!("{path}.{field}");
    if let Some([x, y]) = ring.tilt
        && (!(x.is_finite() && y.is_finite()) || x.hypot(y) > FURTHEST)
    {
        let allowed = format!("two numbers whose magnitude, √(x² + y²), is at most {FURTHEST} rad");
        return Err(Error::scene(at("tilt"), format!("{:?}", [x, y]), allowed));
    }
    for (field, mount) in [
        ("tilt_x", &ring.support.tilt_x),
        ("tilt_y", &ring.support.tilt_y),
    ] {
        check::mount(&at(&format!("support.{field}")), mount.as_ref(), true)?;
    }
    given(&at("support"), &ring.support)?;
    if let Some(coupled) = &ring.support.coupled {
        support(&at("support.coupled"), coupled, turned_by)?;
    }
    match turned_by {
        Some(speed) if ring.support.theta.is_some() => Err(Error::scene(
            at("support.theta"),
            "a mount",
            format!("absent, since {speed} turns the {} ring", name.name()),
        )),
        _ => Ok(()),
    }
}

/// Directions whose motion is given, which has to be smooth: accelerations follow from it.
fn given(path: &str, support: &Support) -> Result<()> {
    for (field, mount) in [
        ("x", &support.x),
        ("y", &support.y),
        ("z", &support.z),
        ("theta", &support.theta),
        ("tilt_x", &support.tilt_x),
        ("tilt_y", &support.tilt_y),
    ] {
        let Some(Mount::Given(motion)) = mount else {
            continue;
        };
        let path = format!("{path}.{field}.given");
        let (limit, unit) = match field {
            "theta" => {
                let allowed =
                    "a speed instead: drive.speed of the inner ring, outer_speed of the outer";
                return Err(Error::scene(path, "a motion about z", allowed));
            }
            "tilt_x" | "tilt_y" => (FURTHEST, "rad"),
            _ => (FURTHEST_PLACE, "m"),
        };
        time_function(&path, motion, limit, unit)?;
        let shape = match **motion {
            TimeFunction::Profile(Profile::Ramp { .. }) => "ramp",
            TimeFunction::Profile(Profile::Table { .. }) => "table",
            _ => continue,
        };
        let allowed = "a number, a sine or a spline, since a ring's velocity must not jump";
        return Err(Error::scene(path, shape, allowed));
    }
    Ok(())
}

/// A coupled support, of a ring whose rotation a speed may prescribe.
fn support(path: &str, coupled: &CoupledSupport, turned_by: Option<&str>) -> Result<()> {
    let CoupledSupport {
        stiffness,
        damping,
        axial_position: _,
    } = coupled;
    numbers(path, coupled.numbers())?;
    for (field, rows) in [("stiffness", stiffness), ("damping", damping)] {
        let path = format!("{path}.{field}");
        for (i, row) in rows.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                within(&format!("{path}[{i}][{j}]"), *entry, -1e15..=1e15, "")?;
            }
        }
        let matrix = Matrix6::from_fn(|i, j| rows[i][j]);
        let largest = matrix.amax();
        if (matrix - matrix.transpose()).amax() > ROUNDING * largest {
            let given = "a matrix that is not symmetric";
            return Err(Error::scene(path, given, "a symmetric matrix"));
        }
        let least = matrix.symmetric_eigenvalues().min();
        if least < -ROUNDING * largest {
            let given = format!("a matrix with the eigenvalue {}", number(least));
            let allowed = "a positive semidefinite matrix, without eigenvalues below 0";
            return Err(Error::scene(path, given, allowed));
        }
        if let Some(speed) = turned_by
            && rows[5] != [0.0; 6]
        {
            let allowed = format!("0 in the row and column of θ, since {speed} turns the ring");
            return Err(Error::scene(path, format!("{:?}", rows[5]), allowed));
        }
    }
    Ok(())
}

/// Moments, and places of loads and unbalances on rings.
pub(super) fn loads(scene: &Scene) -> Result<()> {
    for (name, moment) in &scene.moments {
        entry_name("moments", name)?;
        let Moment {
            ring: _,
            direction: about,
            moment,
        } = moment;
        direction(&format!("moments.{name}"), about)?;
        time_function(&format!("moments.{name}.moment"), moment, 1e12, "N m")?;
    }
    for (name, load) in &scene.loads {
        numbers(&format!("loads.{name}"), load.numbers())?;
    }
    for (name, unbalance) in &scene.unbalances {
        let path = format!("unbalances.{name}");
        let (ring, turns) = match unbalance.ring {
            RingName::Outer => (
                &scene.outer_ring,
                scene.outer_ring.support.mounts(Mount::Fixed)[3] != Mount::Fixed,
            ),
            RingName::Inner => (
                &scene.inner_ring,
                scene.given_speed(RingName::Inner).is_none(),
            ),
        };
        if ring.tilts() && turns {
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
