//! Analytic: rings that tilt conserve energy and momentum, lose the reported power, and equal parallel rings where they stand
//! parallel.

use nalgebra::{Rotation3, Vector3};

use super::{Dynamics, rhs};
use crate::base::pool::Pool;
use crate::inspect;
use crate::integrate::{Options, System, Tolerance, VERNER, integrate};
use crate::model::{BodyId, Dof, Model, Race};
use crate::scene::{
    CoupledSupport, Defect, Drive, Friction, Lubricant, Moment, Mount, NormalLaw, Patch, RingName,
    Row, Scene, Slices, Support, Surface, Waviness,
};
use crate::simd::InstructionSet;
use crate::statics::compile;
use crate::statics::start::{Start, start};

const SPRING: Mount = Mount::Spring {
    stiffness: 3e3,
    damping: 0.0,
};

/// Two rows of five balls back to back between rings that are free in all directions, pressed apart.
pub(super) fn free_rings(law: &NormalLaw) -> Scene {
    let row = |side: i8| {
        let mut row = Row::new(5, 9e-3, 40e-3, 0.53, 0.52);
        (row.contact_angle, row.side) = (20_f64.to_radians(), side);
        row.axial_position = -f64::from(side) * 8e-3;
        row.axial_preload = 20e-6;
        row
    };
    let drive = Drive::Torque {
        value: 0.0.into(),
        initial_speed: 150.0,
    };
    let mut scene = Scene::new(vec![row(1), row(-1)], drive);
    scene.rows[1].start_angle = 0.4;
    (scene.contact.law, scene.contact.damping) = (law.clone(), 0.0);
    scene.gravity = [0.0; 3];
    let free = || Some(Mount::Free);
    for ring in [&mut scene.outer_ring, &mut scene.inner_ring] {
        ring.support = Support::new([free(), free(), free(), free()]);
        (ring.support.tilt_x, ring.support.tilt_y) = (free(), free());
        (ring.mass, ring.inertia, ring.transverse_inertia) = (Some(0.2), Some(1e-4), Some(7e-5));
    }
    scene.inner_ring.centre_of_mass = Some(3e-3);
    scene
}

/// A state in which everything moves and is tilted.
pub(super) fn stirred(model: &Model) -> Vec<f64> {
    let mut y = start(model, &Start::Rolling).unwrap();
    let layout = model.layout();
    for (k, race) in Race::BOTH.into_iter().enumerate() {
        let k = k as f64;
        for (i, (dof, speed)) in [
            (Dof::X, 0.02),
            (Dof::Y, -0.03),
            (Dof::Z, 0.04),
            (Dof::TiltX, 3.0),
            (Dof::TiltY, -2.0),
        ]
        .into_iter()
        .enumerate()
        {
            if !layout.has(race.ring(), dof) {
                continue;
            }
            y[layout.at(race.ring(), dof)] = (1e-6 + 1e-6 * k) * (i as f64 - 1.5);
            y[layout.speed_at(race.ring(), dof)] = speed * (1.0 - 1.7 * k);
        }
    }
    y
}

/// Linear and angular momentum of balls and rings, about the origin.
pub(super) fn momenta(model: &Model, y: &[f64]) -> [Vector3<f64>; 2] {
    let layout = model.layout();
    let [mut linear, mut angular] = [Vector3::zeros(); 2];
    for id in layout.bodies() {
        let mut place = Vector3::from(layout.centre(y, id));
        let velocity = Vector3::from(Dof::TRANSLATIONS.map(|dof| y[layout.speed_at(id, dof)]));
        let spin = y[layout.speed_at(id, Dof::Theta)];
        let turning = match Race::BOTH.into_iter().find(|race| race.ring() == id) {
            None => {
                let across = layout.motion(y, id).across;
                Vector3::new(across.x, across.y, spin) * model.bodies[id].mass[Dof::Theta]
            }
            Some(race) => {
                place.z += model.rings[race].centre_of_mass;
                let rotation = model.tilted(y, race).rotation;
                let (axis, turning) = (rotation.frame.axis(), rotation.angular_velocity());
                let about = axis * turning.dot(&axis);
                let inertia = &model.rings[race].inertia;
                about * inertia.polar + (turning - about) * inertia.transverse
            }
        };
        let momentum = velocity * model.bodies[id].mass[Dof::X];
        linear += momentum;
        angular += place.cross(&momentum) + turning;
    }
    [linear, angular]
}

pub(super) fn laws() -> [NormalLaw; 2] {
    [NormalLaw::Hertz, NormalLaw::iso16281()]
}

/// Energy and all of both momenta, without friction and damping.
#[test]
fn free_rings_keep_energy_and_momenta() {
    for law in laws() {
        let mut scene = free_rings(&law);
        scene.contact.slices = Slices::Fitted(16);
        let model = compile(&scene).unwrap();
        let y0 = stirred(&model);
        let mut dynamics = Dynamics::new(&model);
        let tolerance = Tolerance::uniform(y0.len(), 1e-13, 1e-13).unwrap();
        let options = Options {
            max_step: 0.2 / model.scales.frequency,
            ..Options::default()
        };
        let nobody = &mut |_: &mut Dynamics<'_>,
                           _: &crate::integrate::DenseStep<'_>,
                           _: &crate::integrate::StepStatistics| {
            std::ops::ControlFlow::Continue(())
        };
        let span = (0.0, 4e-4);
        let end = integrate(
            &mut dynamics,
            &VERNER,
            span,
            &y0,
            &tolerance,
            &options,
            nobody,
        );
        let end = end.unwrap().y;
        let [before, after] = [&y0, &end].map(|y| inspect::raw::energy(&model, y).total());
        println!("{law:?}: energy {before} {:e}", after / before - 1.0);
        assert!((after / before - 1.0).abs() < 1e-9, "{law:?}");
        let tilted = model.tilt(&end, Race::Inner)[0];
        assert!(tilted[0].hypot(tilted[1]) > 1e-5, "{tilted:?}");
        let [from, to] = [&y0, &end].map(|y| momenta(&model, y));
        for (from, to) in from.into_iter().zip(to) {
            println!("{from} {:e}", (from - to).norm());
            assert!((from - to).norm() < 1e-12 * from.norm().max(0.1), "{law:?}");
        }
    }
}

/// Truth: the energy, differentiated along the motion. Its loss is the reported power, with friction, damping, waves, defects,
/// springs of tilts and coupled supports; nothing else is.
#[test]
fn powers_balance() {
    for law in laws() {
        let mut scene = free_rings(&law);
        scene.friction = Friction::Coulomb {
            coefficient: 0.1,
            slip_speed: 0.05,
        };
        scene.contact.damping = 0.3;
        scene.contact.slices = Slices::Fitted(24);
        (scene.inner_ring.support.tilt_x, scene.gravity) = (Some(SPRING), [1.0, -9.81, 3.0]);
        scene.inner_ring.tilt = Some([2e-4, -1e-4]);
        let mut coupled = CoupledSupport::new([[0.0; 6]; 6]);
        for (i, size) in [1e6, 2e6, 3e6, 40.0, 50.0, 2.0].into_iter().enumerate() {
            (coupled.stiffness[i][i], coupled.damping[i][i]) = (size, 1e-4 * size);
        }
        for (i, j, size) in [(0, 4, 3e3), (1, 3, -4e3), (2, 5, 500.0)] {
            (coupled.stiffness[i][j], coupled.stiffness[j][i]) = (size, size);
            (coupled.damping[i][j], coupled.damping[j][i]) = (1e-4 * size, 1e-4 * size);
        }
        coupled.axial_position = 0.02;
        scene.outer_ring.support.coupled = Some(Box::new(coupled));
        let wave = Waviness::new(7, 1e-6, 0.3);
        scene.rows[0].inner_waviness = vec![wave];
        let spall = Defect::of(
            Patch::of_width(0.4e-3).length(4e-3).edge_radius(0.2e-3),
            Surface::InnerRace,
            0.05,
        );
        scene
            .defects
            .insert("spall".to_owned(), spall.at_offset(0.0));
        let model = compile(&scene).unwrap();
        let y = stirred(&model);
        let mut dy = vec![0.0; y.len()];
        rhs(&model, 0.0, &y, &mut dy);
        let moved = |h: f64| -> Vec<f64> { y.iter().zip(&dy).map(|(y, d)| y + h * d).collect() };
        let energy = |h: f64| inspect::raw::energy(&model, &moved(h)).total();
        let h = 2e-9;
        let rate =
            (8.0 * (energy(h) - energy(-h)) - energy(2.0 * h) + energy(-2.0 * h)) / (12.0 * h);
        let powers = inspect::raw::energy(&model, &y);
        let lost = powers.damping_power + powers.friction_power + powers.support_power;
        println!("{law:?}: {rate} {lost} {}", powers.friction_power);
        assert!(powers.friction_power > 1.0 && powers.support_power > 1e-3);
        // The nodes of a law in slices are exact to so much.
        assert!((rate + lost).abs() < 2e-5 * lost, "{law:?}: {rate} {lost}");
    }
}

/// Limits: rings that may tilt and stand parallel have the accelerations of rings that may not.
#[test]
fn parallel_rings_are_those_that_do_not_tilt() {
    for law in laws() {
        let mut scene = free_rings(&law);
        scene.friction = Friction::Coulomb {
            coefficient: 0.1,
            slip_speed: 0.05,
        };
        let loose = compile(&scene).unwrap();
        let mut y = stirred(&loose);
        let half = y.len() / 2;
        for (at, (_, dof)) in loose.layout().degrees().enumerate() {
            if Dof::TILTS.contains(&dof) {
                (y[at], y[half + at]) = (0.0, 0.0);
            }
        }
        for ring in [&mut scene.outer_ring, &mut scene.inner_ring] {
            (ring.support.tilt_x, ring.support.tilt_y) = (None, None);
        }
        let held = compile(&scene).unwrap();
        assert!(loose.tilts() && !held.tilts());
        let bodies = held.layout().half();
        let plain = [&y[..bodies], &y[half..half + bodies]].concat();
        let mut dy = [vec![0.0; y.len()], vec![0.0; plain.len()]];
        rhs(&loose, 0.0, &y, &mut dy[0]);
        rhs(&held, 0.0, &plain, &mut dy[1]);
        let size = dy[1].iter().fold(0.0, |m: f64, a| m.max(a.abs()));
        for at in 0..bodies {
            let (a, b) = (dy[0][half + at], dy[1][bodies + at]);
            assert!((a - b).abs() < 1e-10 * size, "{law:?} {at}: {a} {b}");
        }
        // What the moments on held rings would do tilts those that are free.
        for race in Race::BOTH {
            let ring = race.ring();
            let [about_x, _] = inspect::raw::moments(&held, 0.0, &plain)[race];
            let layout = loose.layout();
            let found = dy[0][layout.speed_at(ring, Dof::TiltX)];
            let inertia = loose.rings[race].inertia;
            // Less the gyroscopic term, which is 0 at no rate.
            let expected = about_x / inertia.transverse;
            assert!((found - expected).abs() < 1e-9 * size, "{found} {expected}");
        }
    }
}

/// Symmetry: balls, rings and their axes turned about any axis are pressed by the same forces, turned.
#[test]
fn forces_turn_with_the_bearing() {
    let model = compile(&free_rings(&NormalLaw::Hertz)).unwrap();
    let mut y = stirred(&model);
    let half = y.len() / 2;
    y[half..].fill(0.0);
    let about = Vector3::new(0.05, -0.08, 1.0);
    let turn = Rotation3::new(about);
    let mut turned = y.clone();
    let layout = model.layout();
    for id in layout.bodies() {
        let race = Race::BOTH.into_iter().find(|race| race.ring() == id);
        let offset = race.map_or(0.0, |race| model.rings[race].centre_of_mass);
        let centre = Vector3::from(layout.centre(&y, id)) + Vector3::z() * offset;
        let moved = turn * centre - Vector3::z() * offset;
        for dof in Dof::TRANSLATIONS {
            turned[layout.at(id, dof)] = moved[dof.index()];
        }
        if let Some(race) = race {
            let axis = turn * model.tilted(&y, race).rotation.frame.axis();
            turned[layout.at(id, Dof::TiltX)] = -axis.y;
            turned[layout.at(id, Dof::TiltY)] = axis.x;
        }
    }
    let forces = |y: &[f64]| Dynamics::new(&model).forces(0.0, y);
    let [one, other] = [forces(&y), forces(&turned)];
    let size = one.iter().flatten().fold(0.0, |m: f64, f| m.max(f.abs()));
    assert!(size > 10.0);
    for (a, b) in one.iter().zip(&other) {
        let (a, b) = (
            Vector3::new(a[0], a[1], a[2]),
            Vector3::new(b[0], b[1], b[2]),
        );
        assert!((turn * a - b).norm() < 1e-9 * size, "{a} {b}");
    }
    let moments = |y: &[f64]| inspect::raw::moments(&model, 0.0, y);
    assert_ne!(moments(&y), moments(&turned));
}

/// Limits: a ring that is held at a tilt of next to nothing is one that is held parallel.
#[test]
fn a_tilt_of_next_to_nothing_does_nothing() {
    let mut scene = free_rings(&NormalLaw::Hertz);
    for ring in [&mut scene.outer_ring, &mut scene.inner_ring] {
        (ring.support.tilt_x, ring.support.tilt_y) = (None, None);
    }
    let plain = compile(&scene).unwrap();
    scene.inner_ring.tilt = Some([1e-12, 2e-12]);
    let crooked = compile(&scene).unwrap();
    assert_eq!(plain.names(), crooked.names());
    let y = stirred(&plain);
    let rates = |model: &Model| {
        let mut dy = vec![0.0; y.len()];
        rhs(model, 0.0, &y, &mut dy);
        dy
    };
    let (a, b) = (rates(&plain), rates(&crooked));
    let size = a.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
    for (a, b) in a.iter().zip(&b) {
        assert!((a - b).abs() < 1e-6 * size, "{a} {b}");
    }
}

/// Truth: the moment. Pure moments and forces off the centre tilt a ring as their arms say, whatever else is there.
#[test]
fn loads_tilt_by_their_arms() {
    let mut scene = free_rings(&NormalLaw::Hertz);
    scene.inner_ring.centre_of_mass = None;
    let before = compile(&scene).unwrap();
    let load = crate::scene::Load::new(RingName::Inner, [0.0, 0.0, 1.0], 20.0);
    scene
        .loads
        .insert("off".to_owned(), load.at([0.0, -0.3, 0.02]));
    let moment = Moment::new(RingName::Inner, [0.0, 1.0, 0.0], 0.7);
    scene.moments.insert("pure".to_owned(), moment);
    let after = compile(&scene).unwrap();
    let mut y = start(&before, &Start::Rolling).unwrap();
    let half = y.len() / 2;
    y[half..].fill(0.0);
    let rates = |model: &Model| {
        let mut dy = vec![0.0; y.len()];
        Dynamics::new(model).rhs(0.0, &y, &mut dy);
        dy
    };
    let (layout, [a, b]) = (before.layout(), [rates(&before), rates(&after)]);
    let more = |dof: Dof| {
        let at = layout.speed_at(BodyId::INNER, dof);
        b[at] - a[at]
    };
    let inertia = before.rings[Race::Inner].inertia.transverse;
    assert!((more(Dof::TiltX) - 20.0 * -0.3 / inertia).abs() < 1e-6);
    assert!((more(Dof::TiltY) - 0.7 / inertia).abs() < 1e-6);
    assert!((more(Dof::Z) - 20.0 / 0.2).abs() < 1e-6);
    assert!(more(Dof::Theta).abs() < 1e-6);
}

/// Analytic: moments on rings from contacts by eights are those from contacts one by one, at every instruction set and shared by
/// threads, whose number changes no bit.
#[test]
fn moments_by_eights_are_those_of_ones() {
    let pool = Pool::of(2).unwrap();
    for law in laws() {
        let mut oil = Lubricant::named("vg68", 328.15);
        oil.reference_load = Some(200.0);
        for oil in [None, Some(oil)] {
            for slices in [Slices::Fitted(6), Slices::Fixed(60)] {
                let mut scene = free_rings(&law);
                scene.friction = Friction::Coulomb {
                    coefficient: 0.1,
                    slip_speed: 0.05,
                };
                scene.contact.damping = 0.3;
                (scene.contact.slices, scene.lubricant) = (slices, oil.clone());
                scene.rows[0].inner_waviness = vec![Waviness::new(7, 1e-6, 0.3)];
                let spall = Defect::of(
                    Patch::of_width(0.4e-3).length(4e-3).edge_radius(0.2e-3),
                    Surface::InnerRace,
                    0.05,
                );
                let spall = spall.at_offset(0.0);
                scene.defects.insert("spall".to_owned(), spall);
                let compiled = compile(&scene).unwrap();
                let mut y = stirred(&compiled);
                let tilt = compiled.layout().at(BodyId::INNER, Dof::TiltX);
                y[tilt] = 2e-3;
                for instructions in InstructionSet::available() {
                    let model = compiled.clone().with_instructions(instructions);
                    let expected = inspect::raw::moments(&model, 0.0, &y);
                    let moments = |mut dynamics: Dynamics<'_>| {
                        dynamics.forces(0.0, &y);
                        dynamics.tilted.unwrap().moments()
                    };
                    let found = moments(Dynamics::new(&model));
                    if let Some(pool) = &pool {
                        let shared = moments(Dynamics::new(&model).shared(pool.clone()));
                        assert_eq!(found, shared);
                    }
                    let size = found[0].norm() + found[1].norm();
                    assert!(size > 0.1);
                    for race in Race::BOTH {
                        let axis = model.tilted(&y, race).rotation.frame.axis();
                        let across = found[race] - axis * found[race].dot(&axis);
                        for i in 0..2 {
                            let off = (across[i] - expected[race][i]).abs();
                            assert!(off < 1e-11 * size, "{off} {size}");
                        }
                    }
                }
            }
        }
    }
}
