//! Rows that differ in law, friction, damping, slices, material and balls: each keeps its own.
//!
//! Analytic: rows share nothing but the rings, so the forces of a bearing are those of its rows alone, and on the rings their
//! sum.

use ballrace::InstructionSet;
use ballrace::Reduction;
use ballrace::compile;
use ballrace::dynamics::Dynamics;
use ballrace::dynamics::contributions;
use ballrace::integrate::System;
use ballrace::scene::{
    Contact, Friction, Material, Method, NormalLaw, Scene, Slices, Support, presets,
};
use ballrace::{BodyId, Dof, Layout, Model, Run, Start, equilibrium, simulate, start};

/// Rows of a wheel bearing, the second and third unlike the first in all that a row may say for itself.
fn unlike(rows: usize) -> Scene {
    let mut scene = presets::wheel_bearing(0.0);
    scene.defects.clear();
    scene.loads.clear();
    scene.gravity = [0.0; 3];
    for ring in [&mut scene.outer_ring, &mut scene.inner_ring] {
        (ring.mass, ring.inertia) = (Some(1.0), Some(1e-3));
        ring.support = Support::default();
    }
    let third = scene.rows[1].clone();
    scene.rows.push(third);
    let [_, second, third] = &mut scene.rows[..] else {
        unreachable!("two rows and one more");
    };
    second.ball_diameter *= 0.9;
    second.ball_count -= 2;
    second.ball_material = Some(Material::new(3200.0, 310e9, 0.26));
    let mut own = Contact::default();
    own.law = NormalLaw::Hertz;
    own.slices = Slices::Fitted(7);
    own.damping = 0.5;
    own.clamp_pull = true;
    second.contact = Some(own);
    second.friction = Some(Friction::None);
    third.axial_position *= 3.0;
    let mut own = Contact::default();
    own.law = NormalLaw::Iso16281 {
        constant: 5e10,
        length_ratio: 0.4,
    };
    own.slices = Slices::Fixed(40);
    own.damping = 0.1;
    own.clamp_pull = false;
    third.contact = Some(own);
    third.friction = Some(Friction::Stribeck {
        static_coefficient: 0.12,
        kinetic_coefficient: 0.05,
        stribeck_speed: 0.3,
        slip_speed: 0.02,
    });
    scene.rows.truncate(rows);
    scene
}

/// One of its rows between the same rings.
fn alone(scene: &Scene, row: usize) -> Scene {
    let mut scene = scene.clone();
    scene.rows = vec![scene.rows[row].clone()];
    scene
}

/// A state in which most contacts are pressed, and move.
fn pressed(model: &Model) -> Vec<f64> {
    let mut y = start(model, &Start::Rolling).unwrap();
    let layout = model.layout();
    for (i, (body, dof)) in layout.degrees().enumerate() {
        let noise = (i as f64 * 1.7).sin();
        let (place, speed) = if dof.is_rotation() {
            (0.1, 3.0)
        } else {
            (20e-6, 0.02)
        };
        y[layout.at(body, dof)] += place * noise;
        y[layout.speed_at(body, dof)] += speed * noise.cos();
    }
    y
}

/// The states of both rings and of the balls from `first` on, as the row alone has them.
fn own(layout: Layout, y: &[f64], alone: Layout, first: usize) -> Vec<f64> {
    let mut own = vec![0.0; alone.dim()];
    for (body, dof) in alone.degrees() {
        let of = alone
            .as_ball(body)
            .map_or(body, |j| BodyId::ball(first + j));
        own[alone.at(body, dof)] = y[layout.at(of, dof)];
        own[alone.speed_at(body, dof)] = y[layout.speed_at(of, dof)];
    }
    own
}

#[test]
fn forces_are_those_of_the_rows_alone() {
    for rows in [2, 3] {
        let scene = unlike(rows);
        for instructions in InstructionSet::available() {
            let model = compile(&scene).unwrap().with_instructions(instructions);
            let y = pressed(&model);
            let forces = Dynamics::new(&model).forces(0.0, &y);
            let mut on_rings = [[0.0; 4]; 2];
            let largest = forces
                .as_flattened()
                .iter()
                .fold(0.0, |most: f64, force| most.max(force.abs()));
            let mut first = 0;
            for row in 0..rows {
                // One by one, by no vector instructions.
                let model_alone = compile(&alone(&scene, row)).unwrap();
                let layout = model_alone.layout();
                let y = own(model.layout(), &y, layout, first);
                let mut sums = vec![[0.0; 4]; model_alone.body_count()];
                for (_, part) in contributions(&model_alone, 0.0, &y) {
                    for (sum, part) in sums.as_flattened_mut().iter_mut().zip(part) {
                        *sum += part;
                    }
                }
                for (body, sum) in layout.bodies().zip(sums) {
                    let Some(j) = layout.as_ball(body) else {
                        for dof in Dof::ALL {
                            on_rings[body.index()][dof] += sum[dof];
                        }
                        continue;
                    };
                    let found = forces[BodyId::ball(first + j)];
                    for dof in Dof::ALL {
                        let apart = (found[dof] - sum[dof]).abs();
                        assert!(
                            apart <= 1e-12 * largest,
                            "{instructions}: row {row} of {rows}, ball {j}, {dof:?}: {apart:e} of {largest}"
                        );
                    }
                }
                first += scene.rows[row].ball_count;
            }
            for (ring, sum) in on_rings.iter().enumerate() {
                for dof in Dof::ALL {
                    let apart = (forces[ring][dof] - sum[dof]).abs();
                    assert!(
                        apart <= 1e-11 * largest,
                        "{instructions}: ring {ring}, {dof:?}: {apart:e}"
                    );
                }
            }
        }
    }
}

/// What a run leaves out is the row's own affair too.
#[test]
fn reduced_runs_accelerate_as_the_whole_does() {
    let mut instructions = unlike(2);
    instructions.cage = None;
    for row in &mut instructions.rows {
        row.contact_angle = 0.0;
    }
    let mut smooth = instructions.clone();
    smooth.friction = Friction::None;
    for scene in [unlike(2), instructions, smooth] {
        for simd in InstructionSet::available() {
            let model = compile(&scene).unwrap().with_instructions(simd);
            let y = start(&model, &Start::Rolling).unwrap();
            let mut y = y;
            let layout = model.layout();
            y[layout.at(BodyId::INNER, Dof::Y)] -= 20e-6;
            let mut whole = vec![0.0; y.len()];
            Dynamics::new(&model).rhs(0.0, &y, &mut whole);
            let reduction = Reduction::of(&model, &y).unwrap();
            let mut dynamics = Dynamics::reduced(&model, reduction, &y);
            let kept = dynamics.compress(&y);
            let (mut rates, mut found) = (kept.clone(), y.clone());
            dynamics.rhs(0.0, &kept, &mut rates);
            dynamics.expand_rates(0.0, &rates, &mut found);
            let half = layout.half();
            let largest = whole[half..].iter().fold(0.0, |a: f64, b| a.max(b.abs()));
            for at in half..y.len() {
                let apart = (whole[at] - found[at]).abs();
                let (body, dof) = layout.degree(at - half);
                assert!(
                    apart <= 1e-11 * largest,
                    "{simd}: {body:?} {dof:?}: {apart:e} of {largest:e}"
                );
            }
        }
    }
}

#[test]
fn unlike_rows_carry_a_load_and_run() {
    for rows in [2, 3] {
        for method in [Method::DormandPrince, Method::Adams] {
            let mut scene = unlike(rows);
            scene.gravity = [0.0, -9.81, 0.0];
            scene.loads = presets::wheel_bearing(500.0).loads;
            scene.solver.method = method;
            let found = equilibrium(&scene).unwrap();
            assert!(found.residual_share < 1e-4, "{found:?}");
            let run = Run {
                duration: 1e-3,
                ..Run::default()
            };
            let out = simulate(&scene, &run).unwrap();
            let moved = out.get("inner.ay").unwrap();
            assert!(
                moved.iter().all(|a| a.is_finite()),
                "{rows} rows, {method:?}"
            );
        }
    }
}

/// Only its own row says how a row's contacts are cut.
#[test]
fn each_row_has_as_many_nodes_as_it_asks_for() {
    let explanation = ballrace::explain(&unlike(3)).unwrap();
    let evaluations: Vec<&str> = explanation
        .contacts
        .iter()
        .map(|contact| contact.evaluation.as_str())
        .collect();
    let [a, b, c] = [
        "6 nodes, ISO law",
        "7 nodes, Hertz law",
        "40 slices, ISO law",
    ];
    assert_eq!(evaluations, [a, a, b, b, c, c]);
}

#[test]
fn a_bad_row_is_refused_by_its_path() {
    let refusal = |change: fn(&mut Scene)| {
        let mut scene = unlike(2);
        change(&mut scene);
        compile(&scene).unwrap_err().to_string()
    };
    let damping = refusal(|scene| scene.rows[1].contact.as_mut().unwrap().damping = -1.0);
    assert!(damping.contains("rows[1].contact.damping"), "{damping}");
    let density = refusal(|scene| scene.rows[1].ball_material.as_mut().unwrap().density = 0.0);
    assert!(
        density.contains("rows[1].ball_material.density"),
        "{density}"
    );
    let slip = refusal(|scene| {
        scene.rows[1].friction = Some(Friction::Coulomb {
            coefficient: 0.1,
            slip_speed: 0.0,
        });
    });
    assert!(
        slip.contains("rows[1].friction.coulomb.slip_speed"),
        "{slip}"
    );
}
