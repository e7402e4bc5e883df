//! Analytic: a cage that is a rigid ring. Forces and moments between balls, cage and rings sum to nothing, energy answers for every power,
//! and a single ball that meets the wall of its pocket exchanges momentum with it as two bodies on a spring do.

use crate::common::{Noise, rms};
use ballrace::dynamics::{contributions, rhs};
use ballrace::scene::{
    Cage, CageGuidance, CageRing, Drive, Friction, Method, Mount, Probe, Row, Scene, Spin, Support,
    presets,
};
use ballrace::{Bandwidth, BodyId, Dof, Model, Run, Start, compile, inspect, simulate, start};

const GUIDANCES: [CageGuidance; 5] = [
    CageGuidance::Centred,
    CageGuidance::Held,
    CageGuidance::Outer,
    CageGuidance::Inner,
    CageGuidance::Balls,
];

pub(crate) fn with_ring(mut scene: Scene, change: impl Fn(&mut CageRing)) -> Scene {
    let mut ring = CageRing::default();
    change(&mut ring);
    scene.cage = Some(Cage::ring(ring));
    scene
}

/// A 6205 whose balls touch no race, without anything else that takes energy.
fn loose(change: impl Fn(&mut CageRing)) -> Scene {
    let mut scene = with_ring(presets::deep_groove_6205(0.0, 0.0, 1200.0), change);
    scene.rows[0].clearance = 1e-3;
    scene.friction = Friction::None;
    scene.loads.clear();
    scene.outer_ring.support = Support::default();
    let support = &mut scene.outer_ring.support;
    (support.x, support.y, support.theta) =
        (Some(Mount::Free), Some(Mount::Free), Some(Mount::Free));
    scene.inner_ring.support = Support::default();
    scene.drive = Drive::Torque {
        value: 0.0.into(),
        initial_speed: 125.0,
    };
    scene
}

/// A state in motion with balls, cage and rings up to some way from where they start: most balls at their walls.
fn shaken(model: &Model, noise: &mut Noise) -> Vec<f64> {
    let mut y = start(model, &Start::Rolling).unwrap();
    let layout = model.layout();
    for (body, dof) in layout.degrees().filter(|(_, dof)| Dof::ALL.contains(dof)) {
        let of_cage = body.index() >= 2 + model.scene().rows[0].ball_count;
        let (place, speed) = match dof {
            Dof::X | Dof::Y if of_cage => (60e-6, 0.1),
            Dof::X | Dof::Y => (90e-6, 0.2),
            Dof::Z => (0.0, 0.0),
            _ if of_cage => (2e-3, 3.0),
            _ => (0.3, 40.0),
        };
        y[layout.at(body, dof)] += place * noise.next();
        y[layout.speed_at(body, dof)] += speed * noise.next();
    }
    y
}

/// Forces on all bodies by the cage: along x and y, and about z.
fn by_cage(model: &Model, y: &[f64]) -> Vec<[f64; 3]> {
    let all = contributions(model, 0.0, y);
    let (_, part) = all.iter().find(|(name, _)| *name == "cage").unwrap();
    part.chunks_exact(4).map(|f| [f[0], f[1], f[3]]).collect()
}

#[test]
fn forces_and_moments_sum_to_nothing() {
    for guided in GUIDANCES {
        for clearance in [0.0, 20e-6] {
            if guided == CageGuidance::Balls && clearance == 0.0 {
                continue;
            }
            let scene = loose(|ring| {
                (ring.guided, ring.pocket_clearance) = (guided, Some(clearance));
                ring.pocket_error = 1e-3;
            });
            let model = compile(&scene).unwrap();
            let mut noise = Noise(3);
            for _ in 0..40 {
                let y = shaken(&model, &mut noise);
                let layout = model.layout();
                let (mut sums, mut sizes) = ([0.0; 3], [0.0; 3]);
                for (body, [fx, fy, m]) in layout.bodies().zip(by_cage(&model, &y)) {
                    let place = |dof| y[layout.at(body, dof)];
                    // Held forces act at the outer ring's centre, not at the cage's own place.
                    let turning = [place(Dof::X) * fy, -place(Dof::Y) * fx, m];
                    for (i, part) in [(0, fx), (1, fy)] {
                        sums[i] += part;
                        sizes[i] += part.abs();
                    }
                    for part in turning {
                        sums[2] += part;
                        sizes[2] += part.abs();
                    }
                }
                assert!(sizes[0] > 1.0, "{guided:?}: no ball at a wall");
                for (sum, size) in sums.iter().zip(sizes) {
                    assert!(sum.abs() <= 1e-14 * size, "{guided:?}: {sum:e} of {size:e}");
                }
            }
        }
    }
}

/// Truth: −dU/dt is what conservative forces do, and friction and dampers lose what the power says. With each origin by itself.
#[test]
fn energy_answers_for_every_power() {
    type Change = fn(&mut CageRing);
    let origins: [(&str, Change); 4] = [
        ("springs", |r| {
            (r.damping, r.friction, r.land_friction) = (Some(0.0), 0.0, 0.0);
        }),
        ("dampers", |r| (r.friction, r.land_friction) = (0.0, 0.0)),
        ("friction", |r| {
            (r.damping, r.land_friction) = (Some(0.0), 0.0);
        }),
        ("land", |r| r.friction = 0.0),
    ];
    for guided in GUIDANCES {
        for (name, change) in origins {
            for clearance in [0.0, 20e-6] {
                if guided == CageGuidance::Balls && clearance == 0.0 {
                    continue;
                }
                let scene = loose(|ring| {
                    (ring.guided, ring.pocket_clearance) = (guided, Some(clearance));
                    change(ring);
                });
                let model = compile(&scene).unwrap();
                let layout = model.layout();
                let (mut noise, mut most) = (Noise(5), 0.0_f64);
                for _ in 0..20 {
                    let y = shaken(&model, &mut noise);
                    let half = layout.half();
                    let moved = |way: f64| {
                        let mut y = y.clone();
                        for i in 0..half {
                            y[i] += way * y[half + i];
                        }
                        inspect::energy(&model, &y).unwrap().cage
                    };
                    let step = 1e-8;
                    let stored = (moved(step) - moved(-step)) / (2.0 * step);
                    let (mut work, mut size) = (0.0, 0.0);
                    for (body, f) in layout.bodies().zip(by_cage(&model, &y)) {
                        for (dof, f) in [Dof::X, Dof::Y, Dof::Theta].into_iter().zip(f) {
                            let part = f * y[layout.speed_at(body, dof)];
                            work += part;
                            size += part.abs();
                        }
                    }
                    let lost = inspect::energy(&model, &y).unwrap().support_power;
                    assert!(lost >= -1e-12 * size, "{guided:?} {name}: {lost:e} W");
                    most = most.max((work + stored + lost).abs() / size);
                }
                println!("{guided:?}, {name}, {clearance}: {most:.1e}");
                assert!(most < 1e-7, "{guided:?} {name}: {most:e}");
            }
        }
    }
}

/// Truth: Lagrange's equations of a body whose centre of mass is off its centre keep energy and both momenta, here in free flight in the
/// field of gravity.
#[test]
fn an_unbalanced_cage_keeps_energy() {
    for guided in [
        CageGuidance::Centred,
        CageGuidance::Outer,
        CageGuidance::Balls,
    ] {
        let scene = loose(|ring| {
            (ring.guided, ring.eccentricity) = (guided, 2e-3);
            (ring.damping, ring.friction, ring.land_friction) = (Some(0.0), 0.0, 0.0);
        });
        let model = compile(&scene).unwrap();
        let mut noise = Noise(9);
        for _ in 0..20 {
            let y = shaken(&model, &mut noise);
            let mut rates = vec![0.0; y.len()];
            rhs(&model, 0.0, &y, &mut rates);
            let total = |way: f64| {
                let moved: Vec<f64> = y.iter().zip(&rates).map(|(y, r)| y + way * r).collect();
                let energy = inspect::energy(&model, &moved).unwrap();
                [energy.total(), energy.kinetic]
            };
            let step = 1e-8;
            let [up, down] = [total(step), total(-step)];
            let [all, kinetic] = [0, 1].map(|i| (up[i] - down[i]) / (2.0 * step));
            let lost = inspect::energy(&model, &y).unwrap().support_power;
            assert!(
                (all + lost).abs() < 1e-6 * kinetic.abs() + 1e-6,
                "{guided:?}: {all:e} W and {lost:e} W of {kinetic:e} W"
            );
        }
    }
}

/// One ball and the cage of a bearing so large that its pocket moves along a line.
fn one_ball(change: impl Fn(&mut CageRing)) -> Scene {
    let mut scene = Scene::new(
        vec![Row::new(1, 8e-3, 2.0, 0.53, 0.53)],
        Drive::Speed(0.0.into()),
    );
    scene.rows[0].clearance = 3e-3;
    scene.rows[0].ball_mass = Some(2e-3);
    scene.inner_ring.support.x = Some(Mount::Fixed);
    scene.inner_ring.support.y = Some(Mount::Fixed);
    scene.inner_ring.support.z = Some(Mount::Fixed);
    scene.gravity = [0.0; 3];
    scene.solver.method = Method::Verner;
    scene.probes.insert("cage".to_owned(), Probe::cage(0));
    let motion = Probe::motion("row0.ball0");
    scene.probes.insert("ball".to_owned(), motion);
    with_ring(scene, |ring| {
        (ring.mass, ring.friction, ring.damping) = (Some(5e-3), 0.0, Some(0.0));
        ring.guided = CageGuidance::Held;
        ring.pocket_clearance = Some(50e-6);
        ring.stiffness = Some(3e5);
        change(ring);
    })
}

/// Truth: a ball that meets a wall of a spring moves as cos and sin until it leaves it; then momentum and energy give the speeds. It is
/// free for c_p/v₀, in contact for π/ω_p.
#[test]
fn a_ball_exchanges_momentum_with_its_pocket() {
    const SPEED: f64 = 0.02;
    let scene = one_ball(|_| {});
    let (ball, cage, stiffness) = (2e-3_f64, 5e-3, 3e5);
    let model = compile(&scene).unwrap();
    let mut y = start(&model, &Start::Rolling).unwrap();
    let layout = model.layout();
    y[layout.speed_at(BodyId::ball(0), Dof::Y)] = SPEED;
    let frequency = (stiffness * (1.0 / ball + 1.0 / cage)).sqrt();
    let (free, contact) = (50e-6 / SPEED, std::f64::consts::PI / frequency);
    let out = simulate(
        &scene,
        &Run {
            duration: free + contact + 1e-4,
            fs: 1e6,
            start: Start::State(y),
            bandwidth: Bandwidth::Raw,
            rtol: Some(1e-12),
            ..Run::default()
        },
    )
    .unwrap();
    let of = |name: &str| out.get(name).unwrap();
    let (force, largest) = (of("cage.pocket0.force"), SPEED * (stiffness / frequency));
    for (t, force) in out.t.iter().zip(force) {
        let wanted = if (free..free + contact).contains(t) {
            largest * (frequency * (t - free)).sin()
        } else {
            0.0
        };
        assert!(
            (force - wanted).abs() < 1e-6 * largest,
            "{t}: {force} for {wanted}"
        );
    }
    let last = out.t.len() - 1;
    // The pitch radius is 1 m.
    let [ball_after, cage_after] = [of("ball.vy")[last], of("cage.omega")[last]];
    let wanted = [
        SPEED * (ball - cage) / (ball + cage),
        2.0 * ball * SPEED / (ball + cage),
    ];
    assert!((ball_after / wanted[0] - 1.0).abs() < 1e-6, "{ball_after}");
    assert!((cage_after / wanted[1] - 1.0).abs() < 1e-6, "{cage_after}");
}

/// Truth: the same bearing in another order. Pockets drawn anew or given shift the balls at the start, which are in their middle.
#[test]
fn a_start_is_in_the_middle_of_all_pockets() {
    for guided in GUIDANCES {
        let scene = with_ring(presets::deep_groove_6205(500.0, 0.0, 1797.0), |ring| {
            (ring.guided, ring.pocket_error, ring.seed) = (guided, 2e-3, 4);
        });
        let model = compile(&scene).unwrap();
        for from in [Start::Equilibrium, Start::Rolling] {
            let y = start(&model, &from).unwrap();
            assert!(
                inspect::cage_forces(&model, &y, 0)
                    .unwrap()
                    .iter()
                    .all(|f| *f == 0.0)
            );
            let (layout, cage) = (model.layout(), model.layout().cage(0));
            let centre = if guided == CageGuidance::Held {
                BodyId::OUTER
            } else {
                cage
            };
            let [cx, cy, _] = layout.centre(&y, centre);
            assert_eq!(y[layout.at(cage, Dof::Theta)], scene.rows[0].start_angle);
            let mut leads = Vec::new();
            for k in 0..9 {
                let [x, y, _] = layout.centre(&y, BodyId::ball(k));
                let pocket = scene.rows[0].start_angle + std::f64::consts::TAU * k as f64 / 9.0;
                let angle = (y - cy).atan2(x - cx) - pocket;
                leads.push(
                    (angle + 15.0 * std::f64::consts::PI) % std::f64::consts::TAU
                        - std::f64::consts::PI,
                );
            }
            // As far as the pockets are from equal distances.
            assert!((0.5e-3..4e-3).contains(&rms(&leads)), "{leads:?}");
        }
        // A cage that hangs on its land is in balance there.
        let y = start(&model, &Start::Equilibrium).unwrap();
        let mut rates = vec![0.0; y.len()];
        rhs(&model, 0.0, &y, &mut rates);
        if let CageGuidance::Outer | CageGuidance::Inner = guided {
            let along = rates[layout_speed(&model, Dof::Y)];
            assert!(along.abs() < 0.06 * 9.81, "{guided:?}: {along} m/s²");
        }
    }
}

fn layout_speed(model: &Model, dof: Dof) -> usize {
    model.layout().speed_at(model.layout().cage(0), dof)
}

/// Truth: the full model. Runs that leave out held directions, a row that is the image of the other, or motion along z have the same
/// accelerations.
#[test]
fn reductions_change_nothing() {
    use ballrace::Reduction;
    use ballrace::dynamics::Dynamics;
    use ballrace::integrate::System;
    let mut mirrored = presets::wheel_bearing(0.0);
    mirrored.defects.clear();
    mirrored.rows[1].start_angle = mirrored.rows[0].start_angle;
    let scenes = [presets::deep_groove_6205(500.0, 0.0, 1800.0), mirrored];
    for (i, scene) in scenes.into_iter().enumerate() {
        for guided in GUIDANCES {
            let scene = with_ring(scene.clone(), |ring| ring.guided = guided);
            let model = compile(&scene).unwrap();
            let y0 = start(&model, &Start::Equilibrium).unwrap();
            let reduction = Reduction::of(&model, &y0).unwrap();
            let left: Vec<&str> = reduction.omissions().iter().map(|o| &*o.what).collect();
            assert_eq!(left.contains(&"balls of row 1"), i == 1, "{left:?}");
            let mut dynamics = Dynamics::reduced(&model, reduction, &y0);
            let (mut own, mut full) = (vec![0.0; dynamics.dim()], y0.clone());
            let (mut rates, mut wanted) = (y0.clone(), y0.clone());
            let (mut noise, half) = (Noise(1), y0.len() / 2);
            for _ in 0..20 {
                let mut shaken = y0.clone();
                for j in 0..half {
                    let (place, speed) = if j % 4 < 3 { (90e-6, 0.2) } else { (2e-3, 5.0) };
                    shaken[j] += place * noise.next();
                    shaken[half + j] += speed * noise.next();
                }
                let y = dynamics.compress(&shaken);
                dynamics.expand(0.0, &y, &mut full);
                dynamics.rhs(0.0, &y, &mut own);
                rates.copy_from_slice(&full);
                dynamics.expand_rates(0.0, &own, &mut rates);
                rhs(&model, 0.0, &full, &mut wanted);
                let most = wanted[half..].iter().fold(0.0_f64, |m, a| m.max(a.abs()));
                for j in half..2 * half {
                    let off = (rates[j] - wanted[j]).abs();
                    assert!(off < 1e-9 * most, "{guided:?} {j}: {off:e} of {most:e}");
                }
            }
        }
    }
}

/// Truth: the model of parallel rings. Where rings may tilt and balls spin freely the cage does the same.
#[test]
fn tilts_and_free_spin_take_the_cage_along() {
    for guided in GUIDANCES {
        let plain = loose(|ring| ring.guided = guided);
        let mut spatial = plain.clone();
        spatial.spin = Some(Spin::Free);
        let support = &mut spatial.outer_ring.support;
        (support.tilt_x, support.tilt_y) = (Some(Mount::Free), Some(Mount::Free));
        let [plain, spatial] = [plain, spatial].map(|scene| compile(&scene).unwrap());
        let mut noise = Noise(8);
        for _ in 0..10 {
            let y = shaken(&plain, &mut noise);
            let mut wide = vec![0.0; spatial.dim()];
            for (body, dof) in plain.layout().degrees() {
                wide[spatial.layout().at(body, dof)] = y[plain.layout().at(body, dof)];
                wide[spatial.layout().speed_at(body, dof)] = y[plain.layout().speed_at(body, dof)];
            }
            let all = by_cage(&spatial, &wide);
            let size = all
                .as_flattened()
                .iter()
                .fold(0.0_f64, |m, f| m.max(f.abs()));
            for (one, other) in by_cage(&plain, &y).iter().zip(&all) {
                for (one, other) in one.iter().zip(other) {
                    assert!(
                        (one - other).abs() <= 1e-14 * size,
                        "{guided:?}: {one} {other}"
                    );
                }
            }
            let accelerations = |model: &Model, y: &[f64]| {
                let mut rates = vec![0.0; y.len()];
                rhs(model, 0.0, y, &mut rates);
                let cage = model.layout().cage(0);
                [Dof::X, Dof::Y, Dof::Theta].map(|dof| rates[model.layout().speed_at(cage, dof)])
            };
            let (one, other) = (accelerations(&plain, &y), accelerations(&spatial, &wide));
            for (one, other) in one.iter().zip(other) {
                assert!(
                    (one - other).abs() <= 1e-12 * other.abs(),
                    "{guided:?}: {one} {other}"
                );
            }
        }
    }
}
