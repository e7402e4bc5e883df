//! Compilation of the scene's names and numbers to the model's arrays.

use std::f64::consts::PI;
use std::iter;

use super::body::{Body, Degree, ball_mass, conformity, groove_radius, ring_mass};
use super::loads::{loads, moments};
use super::race::{RaceGeometry, geometry};
use super::ring::layout_of;
use super::{
    Ball, BodyId, CageModel, Dof, Fineness, Model, Race, RingModel, RowModel, Scales, Spring,
    SqueezeModel, StructureModel, UnbalanceModel, demand, nodes,
};
use crate::base::error::{Error, Result};
use crate::base::quantities::number;
use crate::contact::hertz::Hertz;
use crate::contact::{
    BallSide, Damping, Elastic, Law, MOST_AT_ONCE, Pair, Rules, Shape, Squeeze, SurfaceDefect,
    Torus, Traction, V2, Waves, ZoneSlices, met_at_once,
};
use crate::scene::{self, Defect, Mount, Row, Scene, Surface};
use crate::simd::{InstructionSet, LANES};
use crate::tilt::Inertia;

/// Checks and compiles a scene whose defects all have numbers for their places; [`crate::compile()`] gives them those.
pub(crate) fn compile_placed(scene: &Scene) -> Result<Model> {
    scene.validate()?;
    demand::check(scene)?;
    let (outer, on_outer) = ring(scene, &scene.outer_ring, Race::Outer)?;
    let (inner, on_inner) = ring(scene, &scene.inner_ring, Race::Inner)?;
    let (mut bodies, rings) = (vec![outer, inner], [on_outer, on_inner]);
    for race in Race::BOTH {
        if scene.given_speed(race.into()).is_some() {
            bodies[race.ring().index()].degrees[Dof::Theta] = Degree::Driven;
        }
    }
    let mut rows = Vec::new();
    let mut balls = Vec::new();
    for (i, row) in scene.rows.iter().enumerate() {
        let [outer, inner] = Race::BOTH.map(|race| pair(scene, i, row, race));
        let ((outer, on_outer), (inner, on_inner)) = (outer?, inner?);
        rows.push(RowModel {
            first: balls.len(),
            count: row.ball_count,
            pairs: [outer, inner],
            hertz: [on_outer, on_inner],
            cage_distance: row.pitch_diameter * (PI / row.ball_count as f64).sin(),
            side: f64::from(row.side),
            class: i,
            texture_widths: None,
            drag: 0.0,
            squeeze: squeeze(scene.contact_of(row), row),
            cage: scene.cage_ring().map(|ring| {
                let (ball, _) = ball_mass(scene, row, row.ball_diameter);
                Box::new(CageModel::new(scene, ring, i, row, ball))
            }),
        });
        for index in 0..row.ball_count {
            let error = row.diameter_errors.get(index).copied().unwrap_or(0.0);
            let diameter = row.ball_diameter + error;
            let (mass, inertia) = ball_mass(scene, row, diameter);
            let angle = row.start_angle + 2.0 * PI * index as f64 / row.ball_count as f64;
            let (sin, cos) = angle.sin_cos();
            let pitch = row.pitch_diameter / 2.0;
            let [x, y] = match &rows[i].cage {
                None => [pitch * cos, pitch * sin],
                Some(cage) => in_pocket(scene, cage, row.start_angle, index).into(),
            };
            bodies.push(Body {
                nominal: [x, y, row.axial_position, 0.0],
                name: format!("row{i}.ball{index}"),
                mass: [mass, mass, mass, inertia],
                degrees: row.ball_support.mounts(Mount::Free).map(Degree::from),
            });
            let side = BallSide {
                defects: ball_defects(scene, i, index, diameter / 2.0, &rows[i].hertz),
                ..BallSide::whole(diameter / 2.0)
            };
            balls.push(Ball {
                row: i,
                index,
                side,
            });
        }
    }
    bodies.extend(cages(scene, &rows));
    classify(&mut rows);
    let structure = scene.structure.as_ref();
    let structure = structure.map(|of| StructureModel::new(of, &bodies[0]));
    bodies.extend(structure.iter().flat_map(StructureModel::bodies));
    let unbalances = unbalances(scene, &bodies, &rings)?;
    let mut model = Model {
        scene: scene.clone(),
        layout: layout_of(scene),
        rows,
        balls,
        loads: loads(scene, &rings),
        moments: moments(scene),
        tilts: scene.tilts(),
        rings,
        unbalances,
        springs: springs(&bodies, structure.is_some()),
        structure,
        mobility: bodies.iter().map(Body::mobility).collect(),
        bodies,
        scales: Scales::default(),
        fineness: Fineness::of(scene.solver.rtol),
        instructions: InstructionSet::chosen().map_err(|unknown| {
            let allowed = format!("one of {}, or unset", unknown.available.join(", "));
            Error::scene("BALLRACE_SIMD", unknown.value, allowed)
        })?,
    };
    model.scales = Scales::of(&model);
    model.widen_pits();
    check_pits_at_once(&model)?;
    fit_nodes(&mut model);
    Ok(model)
}

/// The cages that are rings.
fn cages(scene: &Scene, rows: &[RowModel]) -> impl Iterator<Item = Body> {
    let each = rows.iter().zip(&scene.rows).enumerate();
    each.filter_map(|(i, (row, of))| Some(row.cage.as_ref()?.body(i, of)))
}

/// Place on the pitch circle in the middle of a cage's pocket, where the cage rests.
fn in_pocket(scene: &Scene, cage: &CageModel, turned: f64, pocket: usize) -> V2 {
    let (sin, cos) = turned.sin_cos();
    let own = cage.pockets[pocket];
    let direction = V2::new(cos * own.x - sin * own.y, sin * own.x + cos * own.y);
    let place = cage.sag(scene.gravity) + direction * cage.radius;
    place * (cage.radius / place.norm())
}

/// Refuses more pits than a contact has room for.
fn check_pits_at_once(model: &Model) -> Result<()> {
    for (i, row) in model.rows.iter().enumerate() {
        let balls = model.balls[row.balls()].iter();
        let of_a_ball =
            balls.map(|ball| ball.side.defects.iter().filter(|of| of.is_small()).count());
        let of_a_ball = of_a_ball.max().unwrap_or(0);
        for (race, pair) in Race::BOTH.into_iter().zip(&row.pairs) {
            let count = met_at_once(&pair.defects) + of_a_ball;
            if count > MOST_AT_ONCE {
                return Err(Error::scene(
                    "defects",
                    format!(
                        "{count} pits that a contact of row {i} with the {} race may meet at once",
                        race.name()
                    ),
                    format!("at most {MOST_AT_ONCE}, those of the ball included"),
                ));
            }
        }
    }
    Ok(())
}

/// Gives each race the fewest nodes that reach the accuracy it asks for: rows that are alike in all else the same number, so that
/// they stay alike.
fn fit_nodes(model: &mut Model) {
    let finer = nodes::finer(model);
    weigh_friction(model, finer);
    let fewest: Vec<Option<[ZoneSlices; 2]>> = (0..model.rows.len())
        .map(|row| {
            let scene::Slices::Accuracy(accuracy) =
                model.scene.contact_of(&model.scene.rows[row]).slices
            else {
                return None;
            };
            let alike = |other: &usize| model.rows[*other].class == model.rows[row].class;
            let alike: Vec<usize> = (0..model.rows.len()).filter(alike).collect();
            Some(Race::BOTH.map(|race| nodes::fewest(model, &alike, race, accuracy, finer)))
        })
        .collect();
    for (row, fewest) in model.rows.iter_mut().zip(fewest) {
        for (pair, slices) in row.pairs.iter_mut().zip(fewest.into_iter().flatten()) {
            pair.change(|flank| flank.slices.clone_from(&slices));
        }
    }
    classify(&mut model.rows);
}

/// Gives all nodes weights for friction.
fn weigh_friction(model: &mut Model, finer: usize) {
    for pair in model.rows.iter_mut().flat_map(|row| &mut row.pairs) {
        pair.change(|flank| {
            if let ZoneSlices::Fitted(rules) = &flank.slices {
                let rules = Rules::for_friction(rules.count(), flank.law.elastic.exponent(), finer);
                flank.slices = ZoneSlices::Fitted(rules);
            }
        });
    }
}

/// Sorts rows into classes: contacts of one class differ in numbers that every contact has of its own, and may be evaluated
/// side by side.
pub(super) fn classify(rows: &mut [RowModel]) {
    for row in 0..rows.len() {
        let like = |other: &usize| rows[*other].is_like(&rows[row]);
        rows[row].class = (0..row).find(like).unwrap_or(row);
    }
}

fn ring(scene: &Scene, ring: &scene::Ring, race: Race) -> Result<(Body, RingModel)> {
    let label = race.name();
    let absent = match race {
        Race::Outer => Mount::Fixed,
        Race::Inner => Mount::Free,
    };
    let (mass, inertia, transverse) = ring_mass(scene, ring, race);
    for (field, value) in [
        ("mass", mass),
        ("inertia", inertia),
        ("transverse inertia", transverse),
    ] {
        if value <= 0.0 {
            return Err(Error::scene(
                format!("{label}_ring.width"),
                ring.width
                    .map_or("absent".to_owned(), |width| width.to_string()),
                format!(
                    "a ring wide enough for its grooves: its {field} would be {}",
                    number(value)
                ),
            ));
        }
    }
    let of = Inertia {
        polar: inertia,
        transverse,
    };
    let compiled = RingModel::new(ring, of);
    let at_start = |dof| compiled.given.of(dof).map_or(0.0, |motion| motion.at(0.0));
    let body = Body {
        name: label.to_owned(),
        nominal: Dof::ALL.map(at_start),
        mass: [mass, mass, mass, inertia],
        degrees: ring.support.mounts(absent).map(Degree::from),
    };
    Ok((body, compiled))
}

/// Hertz's contact of a ball and one race.
fn hertz(scene: &Scene, row: &Row, race: Race, torus: &Torus, angle: f64) -> Hertz {
    let is_own = torus.r == groove_radius(row, race);
    let own = torus.r / row.ball_diameter;
    Hertz::new(
        torus.sigma,
        row.ball_diameter,
        row.pitch_diameter,
        if is_own { conformity(row, race) } else { own },
        angle,
        scene.ball_material_of(row),
        &scene.materials.rings,
    )
}

/// Geometry and laws of one race ([*Geometry of a row*](crate::equations#geometry-of-a-row)), and Hertz's contact with it.
fn pair(scene: &Scene, index: usize, row: &Row, race: Race) -> Result<(Pair, Hertz)> {
    let path = format!("rows[{index}]");
    let angle = row.contact_angle;
    let (mut pair, hertz) = match geometry(&path, row, race)? {
        RaceGeometry::One(torus, shape) => {
            let hertz = hertz(scene, row, race, &torus, angle);
            let one = Pair {
                shape,
                ..whole(scene, row, torus, hertz)
            };
            check_hollow(&path, &one, race)?;
            (one, hertz)
        }
        RaceGeometry::Arch(flanks, angle) => {
            let hertz = flanks.map(|torus| hertz(scene, row, race, &torus, angle));
            let [low, high] = [0, 1].map(|i| whole(scene, row, flanks[i], hertz[i]));
            let arch = Pair::arch([low, high], angle).ok_or_else(|| {
                Error::scene(
                    format!("{path}.{}_arch.conformities", race.name()),
                    format!("{:?}", flanks.map(|torus| torus.r / row.ball_diameter)),
                    "nearer to each other: the flanks do not meet between a ball's two contacts",
                )
            })?;
            (arch, hertz[1])
        }
    };
    let surface = match race {
        Race::Outer => Surface::OuterRace,
        Race::Inner => Surface::InnerRace,
    };
    let of_race = |defect: &&Defect| defect.on == surface && defect.row == index;
    let defects = scene.defects.values().filter(of_race);
    let defects: Vec<SurfaceDefect> = defects
        .map(|d| SurfaceDefect::of_race(d, row, &hertz, |z, length| pair.radii(z, length)))
        .collect();
    pair.change(|flank| flank.defects.clone_from(&defects));
    Ok((pair, hertz))
}

/// A race without defects and the laws of its contacts.
fn whole(scene: &Scene, row: &Row, torus: Torus, hertz: Hertz) -> Pair {
    let contact = scene.contact_of(row);
    let elastic = Elastic::new(&contact.law, row.ball_diameter, hertz);
    let exponent = elastic.exponent();
    let slices = match contact.slices {
        scene::Slices::Fixed(n) => ZoneSlices::Fixed(n),
        scene::Slices::Fitted(m) => ZoneSlices::Fitted(Rules::new(m, exponent)),
        // Until the fewest are found.
        scene::Slices::Accuracy(_) => ZoneSlices::Fitted(Rules::new(nodes::MANY, exponent)),
    };
    Pair {
        race: torus,
        shape: Shape::default(),
        // Once it is known how wide contacts are.
        waves: Waves::default(),
        law: Law {
            damping: Damping {
                coefficient: contact.damping,
                clamp_pull: contact.clamp_pull,
            },
            traction: Traction::new(scene.friction_of(row)),
            ..Law::elastic(elastic)
        },
        slices,
        defects: Vec::new(),
    }
}

fn squeeze(contact: &scene::Contact, row: &Row) -> Option<SqueezeModel> {
    let film = contact.squeeze.filter(|film| film.damping > 0.0)?;
    let errors = row.diameter_errors.iter().copied();
    let errors = errors.chain(iter::repeat(0.0)).take(row.ball_count + LANES);
    Some(SqueezeModel {
        film: Squeeze {
            damping: film.damping,
            thickness: film.thickness,
            pull: film.pull,
        },
        radii: errors.map(|e| 0.5 * (row.ball_diameter + e)).collect(),
    })
}

/// Hertz's law has one curvature and one contact: its races must be concave everywhere, with radii of curvature above the ball's.
fn check_hollow(path: &str, pair: &Pair, race: Race) -> Result<()> {
    if pair.law.cut().is_flat() && !pair.shape.is_hollow() {
        return Err(Error::scene(
            format!("{path}.{}_profile.r", race.name()),
            "a profile that is not",
            "a race that is concave everywhere, with radii of curvature above the ball's, for Hertz's law; contact.law = iso16281 \
             takes any",
        ));
    }
    Ok(())
}

fn ball_defects(
    scene: &Scene,
    row: usize,
    ball: usize,
    radius: f64,
    hertz: &[Hertz; 2],
) -> Vec<SurfaceDefect> {
    scene
        .defects
        .values()
        .filter(|d| d.on == Surface::Ball && d.row == row && d.ball == Some(ball))
        .map(|defect| SurfaceDefect::of_ball(defect, radius, hertz))
        .collect()
}

/// Springs of all bodies to the ground, where those of the outer ring along the axes may end at a seat.
fn springs(bodies: &[Body], is_seated: bool) -> Vec<Spring> {
    let mut springs = Vec::new();
    for (b, body) in bodies.iter().enumerate() {
        for dof in Dof::ALL {
            if is_seated && b == BodyId::OUTER.index() && !dof.is_rotation() {
                continue;
            }
            if let Degree::Free { stiffness, damping } = body.degrees[dof]
                && (stiffness != 0.0 || damping != 0.0)
            {
                springs.push(Spring {
                    body: BodyId::new(b),
                    dof,
                    stiffness,
                    damping,
                    nominal: body.nominal[dof],
                });
            }
        }
    }
    springs
}

/// Unbalances, which on a ring that turns freely must leave it an inertia about its centre of mass.
fn unbalances(
    scene: &Scene,
    bodies: &[Body],
    rings: &[RingModel; 2],
) -> Result<Vec<UnbalanceModel>> {
    let mut sums = [0.0; 2];
    let mut found = Vec::new();
    for (name, unbalance) in &scene.unbalances {
        let ring = Race::from(unbalance.ring);
        let body = &bodies[ring.ring().index()];
        sums[ring] += unbalance.moment;
        let most = (body.mass[Dof::X] * body.mass[Dof::Theta]).sqrt();
        if body.degrees[Dof::Theta].is_free() && sums[ring] >= most {
            return Err(Error::scene(
                format!("unbalances.{name}.moment"),
                unbalance.moment,
                format!(
                    "less, so that the sum of the ring's unbalances is below √(mass · inertia) = {} kg m: \
                     a ring that turns freely needs an inertia about its centre of mass",
                    number(most)
                ),
            ));
        }
        found.push(UnbalanceModel {
            ring,
            moment: unbalance.moment,
            angle: unbalance.angle,
            place: unbalance.axial_position.unwrap_or_default() - rings[ring].centre_of_mass,
        });
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use crate::scene::presets;

    #[test]
    fn a_ring_without_mass_is_refused_by_its_width() {
        let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        scene.outer_ring.width = Some(1e-3);
        let text = crate::compile(&scene).unwrap_err().to_string();
        assert!(text.starts_with("outer_ring.width = 0.001: "), "{text}");
    }
}
