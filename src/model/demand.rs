//! Memory that a scene needs once it is compiled and has settled, computed before any of it is allocated.

use crate::base::error::Result;
use crate::base::memory;
use crate::scene::{Defect, Probe, Profile, Row, Scene, TimeFunction, Waviness, Width};

/// Copies of a scene's lists that are held at once: the document, the scene as placed, frozen to settle and
/// handed over. Measured with tables of 10⁶ points: 9.
const COPIES: f64 = 12.0;
/// A load, defect or probe with its name \[bytes\].
const ENTRY: f64 = 400.0;
/// A ball: its body, its contacts in the static solve, and what an evaluation notes of it \[bytes\]. Measured with
/// 16 rows of 1000: 5 kB.
const BALL: f64 = 10_000.0;
/// A ball that a defect may meet, as it is watched \[bytes\].
const WATCHED_BALL: f64 = 64.0;

/// Refuses to compile what does not fit into memory.
pub(super) fn check(scene: &Scene) -> Result<()> {
    let balls: usize = scene.rows.iter().map(|row| row.ball_count).sum();
    memory::check(bytes(scene), || {
        format!(
            "a model of {balls} balls, {} defects and {} numbers in lists; give the scene fewer of them",
            scene.defects.len(),
            numbers(scene)
        )
    })
}

fn bytes(scene: &Scene) -> f64 {
    let entries =
        scene.loads.len() + scene.moments.len() + scene.probes.len() + scene.defects.len();
    let balls = |defect: &Defect| scene.rows[defect.row].ball_count as f64;
    COPIES * (8.0 * numbers(scene) as f64 + ENTRY * entries as f64)
        + WATCHED_BALL * scene.defects.values().map(balls).sum::<f64>()
        + BALL
            * scene
                .rows
                .iter()
                .map(|row| row.ball_count as f64)
                .sum::<f64>()
}

/// Numbers in the lists of a scene, whose lengths have no limit.
fn numbers(scene: &Scene) -> usize {
    let values = scene.values_in_time().into_iter().map(in_time);
    let widths = scene.defects.values().map(|of| of.damage.width_along());
    let defects = widths.map(|width| match width.as_ref() {
        Width::Constant(_) => 1,
        Width::Profile(profile) => profile.positions.len() + profile.widths.len(),
    });
    let probes = scene.probes.values().map(|probe| match probe {
        Probe::Slices(of) => of.times.len(),
        _ => 0,
    });
    let rows = scene.rows.iter().map(|row: &Row| {
        let waves = row.outer_waviness.len() + row.inner_waviness.len();
        waves * size_of::<Waviness>() / size_of::<f64>() + row.diameter_errors.len()
    });
    values.chain(defects).chain(probes).chain(rows).sum()
}

fn in_time(value: &TimeFunction) -> usize {
    match value {
        TimeFunction::Profile(Profile::Table { times, values }) => times.len() + values.len(),
        TimeFunction::Profile(Profile::Spline { times, .. }) => 3 * times.len(),
        _ => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use crate::model::compile_placed;
    use crate::scene::Drive;
    use crate::scene::presets;

    #[test]
    fn what_does_not_fit_is_not_compiled() {
        let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        let times: Vec<f64> = (0..1000).map(f64::from).collect();
        scene.drive = Drive::Speed(TimeFunction::Profile(Profile::Table {
            values: vec![1.0; times.len()],
            times,
        }));
        let compiled = |scene: &Scene| memory::within(200e3, || compile_placed(scene));
        let error = compiled(&scene).unwrap_err();
        assert!(
            matches!(error, Error::Memory { .. }) && error.to_string().contains("2002 numbers"),
            "{error}"
        );
        scene.drive = Drive::Speed(1.0.into());
        assert!(compiled(&scene).is_ok());
    }
}
