//! The structure around the outer ring.

use nalgebra::Matrix3;

use super::check::{entry_name, numbers, within};
use crate::base::error::{Error, Result};
use crate::base::quantities::number;
use crate::scene::structure::SHAPES;
use crate::scene::{Compliance, Mode, Mount, Scene, Structure};

/// Most modes of a structure.
const MOST: usize = 200;
/// How far a compliance may miss being symmetric and positive semidefinite, over its largest entry: rounding.
const ROUNDING: f64 = 1e-9;
/// The axes, as in the fields of a support.
const AXES: [&str; 3] = ["x", "y", "z"];

pub(super) fn structure(scene: &Scene, of: &Structure) -> Result<()> {
    // Named one by one, so that the compiler asks about a new field.
    let Structure {
        modes,
        static_compliance,
    } = of;
    if modes.is_empty() || modes.len() > MOST {
        let given = format!("{} modes", modes.len());
        return Err(Error::scene(
            "structure.modes",
            given,
            format!("1 to {MOST}"),
        ));
    }
    for (i, each) in modes.iter().enumerate() {
        mode(&format!("structure.modes[{i}]"), each)?;
    }
    let support = &scene.outer_ring.support;
    if support.coupled.is_some() {
        let allowed =
            "absent where a structure carries the outer ring, by springs along x, y and z";
        return Err(Error::scene(
            "outer_ring.support.coupled",
            "a coupled support",
            allowed,
        ));
    }
    let residual = static_compliance.as_ref().map(Compliance::matrix);
    if let Some(matrix) = &residual {
        compliance(matrix)?;
    }
    // What the structure moves hangs on a spring.
    let mounts = support.mounts(Mount::Fixed);
    for (axis, mount) in mounts[..3].iter().enumerate() {
        let path = format!("outer_ring.support.{}", AXES[axis]);
        let moves = modes.iter().any(|mode| mode.seat[axis] != 0.0);
        let gives = residual.is_some_and(|matrix| matrix[axis][axis] != 0.0);
        let is_sprung = matches!(mount, Mount::Spring { stiffness, .. } if *stiffness > 0.0);
        if (moves && !mount.gives()) || (gives && !is_sprung) {
            let given = match mount {
                Mount::Fixed => "fixed",
                Mount::Free => "free",
                Mount::Given(_) => "a given motion",
                Mount::Spring { .. } => "no stiffness",
            };
            let allowed = format!(
                "a spring with a stiffness, since the structure moves the seat along {}",
                AXES[axis]
            );
            return Err(Error::scene(path, given, allowed));
        }
    }
    Ok(())
}

fn mode(path: &str, mode: &Mode) -> Result<()> {
    numbers(path, mode.numbers())?;
    for (name, shape) in &mode.sensors {
        entry_name(&format!("{path}.sensors"), name)?;
        for (i, part) in shape.iter().enumerate() {
            within(&format!("{path}.sensors.{name}[{i}]"), *part, SHAPES, "")?;
        }
    }
    Ok(())
}

fn compliance(matrix: &[[f64; 3]; 3]) -> Result<()> {
    let path = "structure.static_compliance";
    let matrix = Matrix3::from_fn(|i, j| matrix[i][j]);
    for entry in matrix.iter() {
        within(path, *entry, -1.0..=1.0, "m/N")?;
    }
    let limit = ROUNDING * matrix.amax();
    let least = || matrix.symmetric_eigenvalues().min();
    if (matrix - matrix.transpose()).amax() <= limit && least() >= -limit {
        return Ok(());
    }
    let given = format!(
        "a matrix with the smallest eigenvalue {} m/N",
        number(matrix.symmetric_eigenvalues().min())
    );
    let allowed = "symmetric and positive semidefinite: a static load must not give energy";
    Err(Error::scene(path, given, allowed))
}
