//! Mirror symmetries of a scene: of every row about its own plane, and of two rows about the plane between them.
//!
//! They are searched in the compiled model, so that anything that breaks one is found, whichever field it comes from.

use crate::contact::{Pair, SurfaceDefect, Torus};
use crate::forces;
use crate::model::{Ball, BodyId, Dof, Model, Race, RowModel};

/// How far places may be apart that are the same but for rounding \[m\].
const ROUNDING: f64 = 1e-15;
/// Share of the contacts' approach by which a start may miss a symmetry: what its own solution leaves.
const START: f64 = 1e-6;

type Symmetry = Result<(), String>;

fn require(holds: bool, otherwise: impl FnOnce() -> String) -> Symmetry {
    if holds { Ok(()) } else { Err(otherwise()) }
}

/// Whether every row is symmetric about the plane of its ball centres, and stays so.
pub(super) fn about_rows(model: &Model, start: &[f64]) -> Symmetry {
    nothing_axial(model)?;
    for (i, row) in model.rows.iter().enumerate() {
        let plane = model.scene.rows[i].axial_position;
        for race in Race::BOTH {
            let (pair, race) = (&row.pairs[race], race.name());
            let torus = &pair.race;
            require((torus.centre - plane).abs() <= ROUNDING, || {
                format!("the {race} groove of row {i} is not level with its balls")
            })?;
            require(pair.shape.is_torus(), || {
                format!("the {race} race of row {i} is not one torus")
            })?;
            require(torus.lowest == -torus.highest, || {
                format!("the {race} shoulders of row {i} are unequal")
            })?;
            let is_mirrored =
                |defect: &SurfaceDefect| defect.is_image(defect, 2.0 * plane, ROUNDING);
            require(pair.defects.iter().all(is_mirrored), || {
                format!("a defect of the {race} race of row {i} is off the middle")
            })?;
        }
    }
    let is_mirrored = |ball: &Ball| {
        let defects = &ball.side.defects;
        defects.iter().all(|f| f.is_image(f, 0.0, ROUNDING))
    };
    require(model.balls.iter().all(is_mirrored), || {
        "a ball's defect is off the middle".to_owned()
    })?;
    let middles: Vec<f64> = model
        .bodies
        .iter()
        .map(|body| body.nominal[Dof::Z])
        .collect();
    at_rest(model, start, &middles)
}

/// Whether two rows are images of each other and stay so; none for a single row.
pub(super) fn of_rows(model: &Model, start: &[f64]) -> Option<Symmetry> {
    match &model.rows[..] {
        [first, second] => Some(images(model, first, second, start)),
        _ => None,
    }
}

fn images(model: &Model, first: &RowModel, second: &RowModel, start: &[f64]) -> Symmetry {
    nothing_axial(model)?;
    let rows = &model.scene.rows;
    let sum = rows[0].axial_position + rows[1].axial_position;
    require(
        first.count == second.count && first.cage_distance == second.cage_distance,
        || "the rows have different balls".to_owned(),
    )?;
    require(first.cage == second.cage, || {
        "the cages of the rows differ".to_owned()
    })?;
    for race in Race::BOTH {
        require(
            pair_is_image(&first.pairs[race], &second.pairs[race], sum),
            || {
                let race = race.name();
                format!("the {race} races of the rows are no images of each other")
            },
        )?;
    }
    for k in 0..first.count {
        let [a, b] = [first.first + k, second.first + k];
        let (one, other) = (
            &model.bodies[BodyId::ball(a)],
            &model.bodies[BodyId::ball(b)],
        );
        let in_phase =
            Dof::SYMMETRIC.map(|dof| (one.nominal[dof] - other.nominal[dof]).abs() <= ROUNDING);
        require(in_phase == [true; 2], || {
            "the rows are out of phase".to_owned()
        })?;
        let [a, b] = [a, b].map(|j| &model.balls[j].side);
        require(
            one.mass == other.mass
                && one.degrees == other.degrees
                && a.radius == b.radius
                && a.waves == b.waves
                && defects_are_images(&a.defects, &b.defects, 0.0),
            || format!("balls {k} of the rows differ"),
        )?;
    }
    let (places, speeds) = start.split_at(model.layout().half());
    at_rest(model, start, &[0.0, 0.0])?;
    let speed = START * model.scales.approach * model.scales.frequency;
    let apart = |half: &[f64], sum: f64, limit: f64| {
        (0..first.count).all(|k| {
            let of = |row: &RowModel| *model.layout().of(half, row.first_body().after(k));
            let (a, b) = (of(first), of(second));
            let [turn, other] = [a, b].map(|body| body[Dof::Theta]);
            Dof::SYMMETRIC
                .iter()
                .all(|dof| (a[*dof] - b[*dof]).abs() <= limit)
                && (a[Dof::Z] + b[Dof::Z] - sum).abs() <= limit
                && (turn - other).abs() <= 1e-9 * (1.0 + turn.abs())
        })
    };
    require(
        apart(places, sum, START * model.scales.approach) && apart(speeds, 0.0, speed),
        || "the start is not symmetric".to_owned(),
    )
}

/// Symmetry of tilts: whether rings that may tilt stay parallel in a motion that is its own mirror image: they start so, have their centres of mass in
/// the mirror's plane, and nothing acts on them off it.
pub(super) fn of_tilts(model: &Model, start: &[f64], mirrored: bool) -> Symmetry {
    let rows = &model.scene.rows;
    let (low, high) = rows
        .iter()
        .map(|row| row.axial_position)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| {
            (z.min(low), z.max(high))
        });
    require(mirrored || high - low <= ROUNDING, || {
        "rows that are no images of each other lie beside each other".to_owned()
    })?;
    let (layout, middle) = (model.layout(), f64::midpoint(low, high));
    for race in Race::BOTH {
        let (ring, of) = (&model.rings[race], race.name());
        require(ring.coupled.is_none(), || {
            format!("the {of} ring's support couples directions")
        })?;
        let moves = Dof::TILTS.map(|dof| layout.has(race.ring(), dof)) != [false; 2];
        let level = (ring.centre_of_mass - middle).abs() <= ROUNDING;
        require(!moves || level, || {
            format!("the {of} ring's centre of mass is off the mirror's plane")
        })?;
    }
    no_moments(model)?;
    parallel_at_start(model, start)
}

/// No force may tilt a ring.
fn no_moments(model: &Model) -> Symmetry {
    let found = forces::ALL
        .iter()
        .find_map(|force| force.asymmetry(model).tilting);
    found.map_or(Ok(()), Err)
}

/// Balls must not begin to spin about another axis than the bearing's, nor have a cap, which they carry with them as they turn.
pub(super) fn of_turns(model: &Model, start: &[f64]) -> Symmetry {
    let layout = model.layout();
    require(layout.tumbling().is_empty(), || {
        "a ball has a cap that may tumble".to_owned()
    })?;
    let rests = (0..model.balls.len()).all(|ball| {
        let limit = START * model.scales.approach / model.radius(BodyId::ball(ball));
        Dof::TURNS.iter().all(|dof| {
            let speed = start[layout.speed_at(BodyId::ball(ball), *dof)];
            speed.abs() <= limit * model.scales.frequency
        })
    });
    require(rests, || {
        "balls spin about another axis at the start".to_owned()
    })
}

/// Rings must start parallel, and be held so where they are.
fn parallel_at_start(model: &Model, start: &[f64]) -> Symmetry {
    for race in Race::BOTH {
        let (ring, of) = (&model.rings[race], race.name());
        let limit = START * model.scales.approach / model.radius(race.ring());
        let [tilt, rates] = model.tilt(start, race);
        let rests = tilt.iter().all(|tilt| tilt.abs() <= limit)
            && rates
                .iter()
                .all(|rate| rate.abs() <= limit * model.scales.frequency);
        require(ring.tilt == [0.0; 2] && rests, || {
            format!("the {of} ring tilts at the start")
        })?;
    }
    Ok(())
}

/// Nothing may act along z.
fn nothing_axial(model: &Model) -> Symmetry {
    require(!model.has_given_motions_off_plane(), || {
        "a motion is given out of the plane".to_owned()
    })?;
    let found = forces::ALL
        .iter()
        .find_map(|force| force.asymmetry(model).along_z);
    found.map_or(Ok(()), Err)
}

/// The first bodies must start at these middles and not leave them.
fn at_rest(model: &Model, start: &[f64], middles: &[f64]) -> Symmetry {
    let limit = START * model.scales.approach;
    let layout = model.layout();
    let rests = |(body, middle): (BodyId, &f64)| {
        let z = start[layout.at(body, Dof::Z)];
        let vz = start[layout.speed_at(body, Dof::Z)];
        (z - middle).abs() <= limit && vz.abs() <= limit * model.scales.frequency
    };
    require(layout.bodies().zip(middles).all(rests), || {
        "the start is not symmetric".to_owned()
    })
}

fn pair_is_image(a: &Pair, b: &Pair, sum: f64) -> bool {
    let defects = defects_are_images(&a.defects, &b.defects, sum);
    let image = Pair {
        race: Torus {
            centre: a.race.centre,
            lowest: -b.race.highest,
            highest: -b.race.lowest,
            ..b.race
        },
        defects: a.defects.clone(),
        ..b.clone()
    };
    let tori = a.shape.is_torus() && b.shape.is_torus();
    tori && defects && (a.race.centre + b.race.centre - sum).abs() <= ROUNDING && *a == image
}

/// Whether two sets of defects are images: every one has its own.
fn defects_are_images(a: &[SurfaceDefect], b: &[SurfaceDefect], sum: f64) -> bool {
    let mut left: Vec<&SurfaceDefect> = b.iter().collect();
    a.len() == b.len()
        && a.iter().all(|defect| {
            let found = left
                .iter()
                .position(|other| defect.is_image(other, sum, ROUNDING));
            found.map(|i| left.swap_remove(i)).is_some()
        })
}
