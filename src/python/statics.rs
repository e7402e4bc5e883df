//! Equilibria, and what follows from them; each is passed as a dict of the arrays of its class in `ballrace.statics`.

use numpy::{Element, IntoPyArray, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::answer::{answering, forced};
use super::errors::{OrRaise, to_json};
use super::forces::{Passed, Raised};
use ballrace::bindings::{self, RowRolling, place};
use ballrace::{
    BallEquilibrium, Equilibrium, EquivalentLoads, Error, RaceControl, Result, RowKinematics,
    Scene, equilibrium_under,
};

/// A column of a table of balls: its name, and its value of a ball.
type Column = (&'static str, fn(&BallEquilibrium) -> f64);

/// Results for the balls at every position of the cage.
const TURNING: [Column; 5] = [
    ("angle", |ball| ball.angle),
    ("outer_load", |ball| ball.outer.load),
    ("outer_angle", |ball| ball.outer.angle.unwrap_or(f64::NAN)),
    ("inner_load", |ball| ball.inner.load),
    ("inner_angle", |ball| ball.inner.angle.unwrap_or(f64::NAN)),
];
/// Further results at one position.
const STANDING: [Column; 8] = [
    ("radius", |ball| ball.radius),
    ("z", |ball| ball.z),
    ("outer_deflection", |ball| ball.outer.deflection),
    ("outer_zone_centre", |ball| {
        ball.outer.zone_centre.unwrap_or(f64::NAN)
    }),
    ("inner_deflection", |ball| ball.inner.deflection),
    ("inner_zone_centre", |ball| {
        ball.inner.zone_centre.unwrap_or(f64::NAN)
    }),
    ("outer_pressure", |ball| ball.outer.pressure),
    ("inner_pressure", |ball| ball.inner.pressure),
];

/// Results of a ring about x and y: name, and both values.
type OfRing = (&'static str, fn(&Equilibrium) -> [f64; 2]);

/// Tilts and moments.
const OF_RINGS: [OfRing; 4] = [
    ("outer_tilt", |found| found.outer_tilt),
    ("inner_tilt", |found| found.inner_tilt),
    ("outer_moment", |found| found.outer_moment),
    ("inner_moment", |found| found.inner_moment),
];

/// Hypothesis on how balls spin, by its name.
fn control(name: &str) -> Result<RaceControl> {
    match name {
        "friction" => Ok(RaceControl::Friction),
        "outer" => Ok(RaceControl::Outer),
        other => {
            let allowed = "\"friction\" or \"outer\"";
            Err(Error::argument(
                "race_control",
                format!("{other:?}"),
                allowed,
            ))
        }
    }
}

/// Static equilibrium.
#[pyfunction]
#[pyo3(signature = (scene, race_control, forces = Vec::new()))]
pub(super) fn equilibrium<'py>(
    py: Python<'py>,
    scene: &str,
    race_control: &str,
    forces: Vec<Passed>,
) -> PyResult<Bound<'py, PyDict>> {
    let control = control(race_control).or_raise(py)?;
    let mut scene = Scene::from_json_unchecked(scene).or_raise(py)?;
    let raised = Raised::of_forces(&mut scene, forces);
    let found = forced(py, None, &raised, move |_| {
        equilibrium_under(&scene, control)
    })?;
    arrays(py, &found)
}

/// Tangent stiffness there.
#[pyfunction]
pub(super) fn stiffness<'py>(py: Python<'py>, scene: &str) -> PyResult<Bound<'py, PyDict>> {
    let found = solved(py, scene, ballrace::stiffness)?;
    let all = PyDict::new(py);
    set(&all, "inner", found.inner.concat(), &[3, 3])?;
    set(&all, "rings", found.rings.concat(), &[6, 6])?;
    set(&all, "inner_spatial", found.inner_spatial.concat(), &[5, 5])?;
    set(
        &all,
        "rings_spatial",
        found.rings_spatial.concat(),
        &[10, 10],
    )?;
    all.set_item("equilibrium", arrays(py, &found.equilibrium)?)?;
    Ok(all)
}

/// Stiffness and damping for a rotor, in the mean over so many positions of the cage per pitch.
#[pyfunction]
pub(super) fn dynamic_coefficients<'py>(
    py: Python<'py>,
    scene: &str,
    positions: usize,
) -> PyResult<Bound<'py, PyDict>> {
    let of = move |scene: &Scene| ballrace::dynamic_coefficients(scene, positions);
    let found = solved(py, scene, of)?;
    let all = PyDict::new(py);
    set(&all, "stiffness", found.stiffness.concat(), &[5, 5])?;
    set(&all, "damping", found.damping.concat(), &[5, 5])?;
    all.set_item("equilibrium", arrays(py, &found.equilibrium)?)?;
    Ok(all)
}

/// A scene as JSON with a number for the axial place of every defect, as a run has it.
#[pyfunction]
pub(super) fn placed(py: Python<'_>, scene: &str) -> PyResult<String> {
    solved(py, scene, |scene| Ok(place(scene)?.0.to_json()))
}

/// How much faster balls go round with their axis held than free, and by how much loads differ, as shares, and whether that is nothing;
/// none where nothing turns or rubs.
#[pyfunction]
pub(super) fn axis_held(py: Python<'_>, scene: &str) -> PyResult<Option<(f64, f64, bool)>> {
    let found = solved(py, scene, ballrace::axis_held)?;
    Ok(found.map(|of| (of.orbit, of.load, of.is_same())))
}

/// How the rows of a scene roll, its defects left out: each with its mean contact angle \[rad\], the turns of its balls around and of a ball against that
/// \[Hz\]; none where nothing drives a row.
#[pyfunction]
pub(super) fn rolling(
    py: Python<'_>,
    scene: &str,
    race_control: &str,
) -> PyResult<Vec<Option<(f64, f64, f64)>>> {
    let control = control(race_control).or_raise(py)?;
    let found = solved(py, scene, move |scene| {
        bindings::rolling(&ballrace::compile(scene)?, control)
    })?;
    let rows = found.into_iter();
    Ok(rows
        .map(|row| row.map(|of: RowRolling| (of.angle, of.cage, of.spin)))
        .collect())
}

/// Fault frequencies of a row of a scene under its load at speeds of outer and inner ring \[Hz\], with what a run measured of it, as JSON.
#[pyfunction]
pub(super) fn fault_frequencies(
    py: Python<'_>,
    scene: &str,
    row: usize,
    speeds: [f64; 2],
    race_control: &str,
    kinematics: Option<&str>,
) -> PyResult<String> {
    let control = control(race_control).or_raise(py)?;
    let did: Option<RowKinematics> = kinematics
        .map(serde_json::from_str)
        .transpose()
        .map_err(|e| Error::argument("kinematics", kinematics.unwrap_or_default(), e.to_string()))
        .or_raise(py)?;
    let found = solved(py, scene, move |scene| {
        bindings::frequencies_at(scene, row, speeds, control, did.as_ref())
    })?;
    to_json(&found)
}

/// Loads at so many positions of the cage per pitch.
#[pyfunction]
pub(super) fn load_distribution<'py>(
    py: Python<'py>,
    scene: &str,
    positions: usize,
) -> PyResult<Bound<'py, PyDict>> {
    let of = move |scene: &Scene| ballrace::load_distribution(scene, positions);
    let found = solved(py, scene, of)?;
    let all = PyDict::new(py);
    name(&all, &found.equilibria[0])?;
    let shape = [found.turn.len(), found.equilibria[0].balls.len()];
    let balls = || found.equilibria.iter().flat_map(|at| &at.balls);
    for (name, of) in TURNING {
        set(&all, name, balls().map(of).collect(), &shape)?;
    }
    let equivalent = |of: fn(&EquivalentLoads) -> f64| found.equivalent.iter().map(of).collect();
    let rows = [found.equivalent.len()];
    set(&all, "outer_equivalent", equivalent(|row| row.outer), &rows)?;
    set(&all, "inner_equivalent", equivalent(|row| row.inner), &rows)?;
    for (name, of) in OF_RINGS {
        let values = found.equilibria.iter().flat_map(of).collect();
        set(&all, name, values, &[shape[0], 2])?;
    }
    set(&all, "turn", found.turn, &shape[..1])?;
    let by_pressure =
        |a: &&Equilibrium, b: &&Equilibrium| a.largest_pressure().total_cmp(&b.largest_pressure());
    let worst = found.equilibria.iter().max_by(by_pressure);
    all.set_item("warnings", worst.map_or_else(Vec::new, warnings_of))?;
    Ok(all)
}

/// Solution of a scene as JSON.
fn solved<T: Send + 'static>(
    py: Python<'_>,
    scene: &str,
    of: impl FnOnce(&Scene) -> ballrace::Result<T> + Send + 'static,
) -> PyResult<T> {
    let scene = scene.to_owned();
    answering(py, None, move |_| of(&Scene::from_json_unchecked(&scene)?))
}

fn arrays<'py>(py: Python<'py>, found: &Equilibrium) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    name(&all, found)?;
    set(&all, "outer", found.outer.to_vec(), &[3])?;
    set(&all, "inner", found.inner.to_vec(), &[3])?;
    for (name, of) in OF_RINGS {
        set(&all, name, of(found).to_vec(), &[2])?;
    }
    for (name, of) in TURNING.into_iter().chain(STANDING) {
        let values = found.balls.iter().map(of).collect();
        set(&all, name, values, &[found.balls.len()])?;
    }
    all.set_item("iterations", found.iterations)?;
    all.set_item("films", to_json(&found.films)?)?;
    all.set_item("warnings", warnings_of(found))?;
    all.set_item("residual", found.residual)?;
    all.set_item("residual_share", found.residual_share)?;
    Ok(all)
}

fn warnings_of(found: &Equilibrium) -> Vec<String> {
    found.doubts.iter().map(ToString::to_string).collect()
}

/// Enters which balls of which rows they are.
// At most thousands.
#[allow(clippy::cast_possible_wrap)]
fn name(to: &Bound<'_, PyDict>, found: &Equilibrium) -> PyResult<()> {
    let column = |of: fn(&BallEquilibrium) -> usize| -> Vec<i64> {
        found.balls.iter().map(|ball| of(ball) as i64).collect()
    };
    let shape = [found.balls.len()];
    set(to, "row", column(|ball| ball.row), &shape)?;
    set(to, "ball", column(|ball| ball.ball), &shape)
}

/// Enters an array, which takes over the vector's memory.
fn set<T: Element>(
    to: &Bound<'_, PyDict>,
    name: &str,
    values: Vec<T>,
    shape: &[usize],
) -> PyResult<()> {
    let array = values.into_pyarray(to.py());
    match shape {
        [_] => to.set_item(name, array),
        _ => to.set_item(name, array.reshape(shape)?),
    }
}
