//! Analytic: what is conservative conserves. Without damping, friction and drive the energy stays — kinetic, contacts,
//! supports, gravity, less the work of the loads — over both normal laws, with defects on each body, with waves, and
//! with two rows that are not alike: to 1e-5 of the range of the kinetic energy.

use crate::common;
use std::f64::consts::FRAC_PI_2;

use ballrace::compile;
use ballrace::dynamics::rhs;
use ballrace::scene::{
    Cap, Defect, Dent, Drive, Floor, Friction, GothicArch, Mount, NormalLaw, Patch, Pit, Probe,
    RingName, Scene, Slices, Surface, Texture, Unbalance, Waviness, Width, WidthProfile, presets,
};
use ballrace::{Error, Run, Signals, Start, equilibrium, start};
use common::{effects, oiled, patch, run, short, through_points};

pub(crate) const LAWS: [NormalLaw; 2] = [
    NormalLaw::Hertz,
    NormalLaw::Iso16281 {
        constant: 7.765e10,
        length_ratio: 0.5,
    },
];

/// A 6205 under radial load and thrust whose inner ring coasts at 3000 rpm: nothing gives or takes energy but the loads.
pub(crate) fn coasting(law: &NormalLaw) -> Scene {
    conservative(presets::deep_groove_6205(400.0, 150.0, 3000.0), law)
}

fn conservative(mut scene: Scene, law: &NormalLaw) -> Scene {
    scene.contact.law = law.clone();
    scene.contact.slices = Slices::Fitted(8);
    scene.contact.damping = 0.0;
    (scene.friction, scene.cage) = (Friction::None, None);
    scene.drive = Drive::Torque {
        value: 0.0.into(),
        initial_speed: scene.drive.initial_speed(),
    };
    for ring in [&mut scene.outer_ring, &mut scene.inner_ring] {
        let support = &mut ring.support;
        for mount in [&mut support.x, &mut support.y, &mut support.z] {
            if let Some(Mount::Spring { damping, .. }) = mount {
                *damping = 0.0;
            }
        }
    }
    scene.probes = [
        ("e".to_owned(), Probe::energy()),
        ("inner".to_owned(), Probe::motion("inner")),
    ]
    .into();
    scene
}

/// A defect that ball 0 meets, or has, a millisecond or so after it was at −90°.
fn defect(scene: &Scene, on: Surface) -> Defect {
    let ball = &equilibrium(scene).unwrap().balls[0];
    // Angle run by the contact on the surface in 1.2 ms: of the cage, of cage less inner ring, of ball less cage.
    let (angle, place, width) = match on {
        Surface::OuterRace => (0.15, ball.outer.zone_centre.unwrap(), 0.5e-3),
        Surface::InnerRace => (-0.23, ball.inner.zone_centre.unwrap(), 0.5e-3),
        _ => (0.9, 0.0, 0.5e-3),
    };
    let mut defect = Defect::of(
        // Within the zone, which is as long as 1.5 mm or so.
        Patch::of_width(width)
            .length(if on == Surface::Ball { 2.2e-3 } else { 0.6e-3 })
            .edge_radius(0.2e-3),
        on,
        angle - FRAC_PI_2,
    )
    .at_offset(place + 0.1e-3);
    defect.ball = (on == Surface::Ball).then_some(0);
    defect
}

fn with_defect(law: &NormalLaw, on: Surface, change: impl Fn(&mut Defect)) -> Scene {
    let mut scene = coasting(law);
    let mut defect = defect(&scene, on);
    change(&mut defect);
    scene.defects.insert("spall".to_owned(), defect);
    scene
}

/// A pit a fifth of a millimetre wide where ball 0 meets it as it meets [`defect`].
pub(crate) fn with_pit(law: &NormalLaw, on: Surface) -> Scene {
    with_defect(law, on, |defect| {
        let ball = defect.ball;
        *defect = Defect::of(Pit::of_width(0.2e-3), on, defect.angle);
        defect.ball = ball;
    })
}

/// A dent with a rim in the place of the pit.
pub(crate) fn with_dent(law: &NormalLaw, on: Surface) -> Scene {
    with_defect(law, on, |defect| {
        *defect = Defect::of(
            Dent::of_width(0.2e-3).depth(8e-6).rim_height(0.4e-6),
            on,
            defect.angle,
        );
    })
}

fn wave(order: u32) -> Vec<Waviness> {
    vec![Waviness::new(order, 2e-6, 0.4)]
}

fn scenes(law: &NormalLaw) -> Vec<(&'static str, Scene)> {
    let wavy = |outer: bool| {
        let mut scene = coasting(law);
        let row = &mut scene.rows[0];
        let races = [&mut row.inner_waviness, &mut row.outer_waviness];
        *races.into_iter().nth(usize::from(outer)).unwrap() = wave(30);
        scene
    };
    let plain = |_: &mut Defect| {};
    let mut both = with_defect(law, Surface::OuterRace, plain);
    both.rows[0].outer_waviness = wave(30);
    let points = |scene: &Scene| through_points(scene, 300);
    vec![
        ("points", points(&coasting(law))),
        (
            "outer race of points",
            points(&with_defect(law, Surface::OuterRace, plain)),
        ),
        (
            "ball on points",
            points(&with_defect(law, Surface::Ball, plain)),
        ),
        ("waves on points", points(&both)),
        ("four points, outer race", four_points(law)),
        ("healthy", coasting(law)),
        ("outer race", with_defect(law, Surface::OuterRace, plain)),
        ("inner race", with_defect(law, Surface::InnerRace, plain)),
        ("ball", with_defect(law, Surface::Ball, plain)),
        (
            "cap",
            with_defect(law, Surface::Ball, |d| {
                *d = Defect::of(
                    Cap::of_width(1e-3).edge_radius(0.2e-3),
                    Surface::Ball,
                    d.angle,
                )
                .at_offset(0.3e-3);
            }),
        ),
        (
            "floor",
            with_defect(law, Surface::OuterRace, |d| {
                let (_, width, floor) = patch(d);
                (*width, *floor) = (1e-3.into(), Some(Floor::new(8e-6, 3)));
            }),
        ),
        (
            "width that varies",
            with_defect(law, Surface::OuterRace, |d| {
                *patch(d).1 = Width::Profile(WidthProfile::new(
                    vec![-0.3e-3, 0.3e-3],
                    vec![0.4e-3, 0.7e-3],
                ));
            }),
        ),
        ("pit outside", with_pit(law, Surface::OuterRace)),
        ("pit inside", with_pit(law, Surface::InnerRace)),
        ("pit of a ball", with_pit(law, Surface::Ball)),
        ("dent outside", with_dent(law, Surface::OuterRace)),
        ("dent inside", with_dent(law, Surface::InnerRace)),
        ("dent of a ball", with_dent(law, Surface::Ball)),
        (
            "pit on texture",
            textured(with_pit(law, Surface::OuterRace)),
        ),
        ("waves outside", wavy(true)),
        ("waves inside", wavy(false)),
        ("waves and a defect", both),
        ("texture", textured(coasting(law))),
        ("texture of balls", {
            let mut scene = textured(coasting(law));
            let texture = scene.rows[0].texture.as_mut().unwrap();
            (texture.outer, texture.inner, texture.ball) = (0.0, 0.0, 5e-9);
            scene
        }),
        (
            "texture and a ball's defect",
            textured(with_defect(law, Surface::Ball, plain)),
        ),
        (
            "texture and a defect",
            textured(with_defect(law, Surface::OuterRace, plain)),
        ),
        ("two rows", two_rows(law)),
    ]
}

/// Every surface as rough as any that is finished.
fn textured(mut scene: Scene) -> Scene {
    let mut texture = Texture::of_races(5e-9);
    texture.ball = 2e-9;
    scene.rows[0].texture = Some(texture);
    scene
}

/// Both races gothic arches, and a defect on one.
fn four_points(law: &NormalLaw) -> Scene {
    let mut scene = coasting(law);
    let arch = GothicArch::new(0.3);
    let row = &mut scene.rows[0];
    (row.outer_arch, row.inner_arch) = (Some(arch.clone()), Some(arch));
    let mut spall = defect(&scene, Surface::OuterRace);
    *patch(&mut spall).0 = 2e-3;
    scene.defects.insert("spall".to_owned(), spall);
    scene
}

/// Two rows that are not alike: other balls, another angle, a defect on one.
fn two_rows(law: &NormalLaw) -> Scene {
    let mut scene = conservative(presets::wheel_bearing(2000.0), law);
    let row = &mut scene.rows[1];
    (row.ball_count, row.ball_diameter) = (11, 12.5e-3);
    row.contact_angle *= 1.3;
    let spall = scene.defects.get_mut("spall").unwrap();
    spall.angle += 0.1;
    scene
}

/// Work of the drive up to every sample: of a torque by the angle, of a steady speed by what the balls put on the
/// ring, which must be sampled densely.
fn driven(scene: &Scene, out: &Signals) -> Vec<f64> {
    let of = |name: &str| out.get(name).unwrap();
    if let Drive::Torque { value, .. } = &scene.drive {
        let angle = of("inner.theta");
        return angle
            .iter()
            .map(|turned| value.at(0.0) * (turned - angle[0]))
            .collect();
    }
    let Some(torque) = out.get("torque.inner") else {
        return vec![0.0; out.t.len()];
    };
    let share = -scene.drive.initial_speed() / (24.0 * out.fs);
    let last = torque.len() - 1;
    let steps = (0..last).scan(0.0, |work, i| {
        // Of the cubic through four samples.
        let outer = torque[i.saturating_sub(1)] + torque[(i + 2).min(last)];
        *work += share * (13.0 * (torque[i] + torque[i + 1]) - outer);
        Some(*work)
    });
    std::iter::once(0.0).chain(steps).collect()
}

/// Largest change of the energy less the work of the loads, over the range of the kinetic energy.
pub(crate) fn drift(scene: &Scene, duration: f64) -> f64 {
    let out = run(
        scene,
        &Run {
            rtol: Some(1e-10),
            fs: if scene.probes.contains_key("torque") {
                4e6
            } else {
                200e3
            },
            ..short(duration)
        },
    );
    let of = |name: &str| out.get(name).unwrap();
    let driven = driven(scene, &out);
    let work = |i: usize| -> f64 {
        let along = ["inner.x", "inner.y", "inner.z"].map(|name| of(name)[i]);
        let loads = scene.loads.values().map(|load| {
            let travel: f64 = (0..3).map(|k| load.direction[k] * along[k]).sum();
            load.force.at(0.0) * travel
        });
        loads.sum::<f64>() + driven[i]
    };
    let (total, kinetic) = (of("e.total"), of("e.kinetic"));
    let kept = |i: usize| total[i] - work(i);
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::MIN, f64::max);
    let range = most(&mut kinetic.iter().copied()) + most(&mut kinetic.iter().map(|e| -e));
    most(&mut (0..total.len()).map(|i| (kept(i) - kept(0)).abs())) / range
}

#[test]
fn energy_is_kept() {
    let mut failed = Vec::new();
    for law in &LAWS {
        for (name, scene) in scenes(law) {
            let found = drift(&scene, 6e-3);
            println!("{law:?}, {name}: {found:.1e}");
            if found > 1e-5 {
                failed.push(format!("{law:?}, {name}: {found:.1e}"));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// Under Hertz's law zones go on past the pole of the ball, along the tangent: when they were cut there, 12 nodes let the energy
/// drift.
#[test]
fn steep_contacts_under_high_pressure_keep_energy() {
    for (degrees, thrust, pressure) in [
        (40.0_f64, 36e3, 4.0e9),
        (70.0, 36e3, 3.5e9),
        (80.0, 36e3, 3.5e9),
    ] {
        let mut scene = presets::deep_groove_6205(400.0, thrust, 3000.0);
        scene.rows[0].contact_angle = degrees.to_radians();
        let mut scene = conservative(scene, &NormalLaw::Hertz);
        scene.contact.slices = Slices::Fitted(12);
        let found = equilibrium(&scene).unwrap().largest_pressure();
        let drifts = drift(&scene, 4e-3);
        println!("{degrees}°, {found:.2e} Pa: {drifts:.1e}");
        assert!(found > pressure, "{degrees}°: {found:e} Pa");
        assert!(drifts < 1e-5, "{degrees}°: {drifts:e}");
    }
}

/// Films without damping and friction are layers: a potential of its own, on rings that the drive holds at their speed.
#[test]
fn a_film_keeps_energy() {
    let mut failed = Vec::new();
    for law in &LAWS {
        let plain = |_: &mut Defect| {};
        for on in [Surface::OuterRace, Surface::InnerRace, Surface::Ball] {
            let mut scene = oiled(with_defect(law, on, plain));
            effects(scene.lubricant.as_mut().unwrap(), "film");
            scene.drive = Drive::Speed(scene.drive.initial_speed().into());
            if on == Surface::InnerRace {
                // Of a round, smooth ring the drive feels nothing.
                scene.probes.insert("torque".to_owned(), Probe::torque());
            }
            let found = drift(&scene, 6e-3);
            println!("{law:?}, {on:?}: {found:.1e}");
            if found > 1e-5 {
                failed.push(format!("{law:?}, {on:?}: {found:.1e}"));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// An unbalance of the inner ring.
fn unbalanced(mut scene: Scene, moment: f64, angle: f64) -> Scene {
    let ring = RingName::Inner;
    let unbalance = Unbalance::new(ring, moment, angle);
    scene.unbalances.insert("u".to_owned(), unbalance);
    scene
}

/// A torque speeds up a ring under load with 6 mm of eccentricity: its work is what the energy grows by.
#[test]
fn a_torque_works_on_an_unbalanced_ring() {
    let mut scene = unbalanced(coasting(&LAWS[0]), 6e-3, 0.7);
    if let Drive::Torque { value, .. } = &mut scene.drive {
        *value = 5.0.into();
    }
    let found = drift(&scene, 6e-3);
    println!("{found:.1e}");
    assert!(found < 1e-5, "{found:.1e}");
}

/// Free of its balls and of supports a ring under a torque T turns about its centre of mass, m e/m off its own: the
/// inertia there is I − (m e)²/m, and the centre of mass stays where it is but for its fall.
#[test]
fn a_free_unbalanced_ring_turns_about_its_centre_of_mass() {
    let (moment, angle, torque) = (8e-3, 0.3, 2.0);
    let mut scene = unbalanced(coasting(&LAWS[0]), moment, angle);
    scene.rows[0].clearance = 400e-6;
    scene.loads.clear();
    scene.inner_ring.support = ballrace::scene::Support::default();
    (scene.inner_ring.mass, scene.inner_ring.inertia) = (Some(1.0), Some(2e-4));
    scene.drive = Drive::Torque {
        value: torque.into(),
        initial_speed: 300.0,
    };
    let model = compile(&scene).unwrap();
    let mut y = start(&model, &Start::Rolling).unwrap();
    let (half, inner) = (y.len() / 2, 4);
    y[inner + 3] = 1.1;
    let mut dy = vec![0.0; y.len()];
    rhs(&model, 0.0, &y, &mut dy);
    let [ax, ay, spin] = [0, 1, 3].map(|i| dy[half + inner + i]);
    let omega = y[half + inner + 3];
    assert_eq!(omega, 300.0);
    let expected = torque / (2e-4 - moment * moment);
    assert!((spin / expected - 1.0).abs() < 1e-12, "{spin} {expected}");
    // Of the centre of mass: that of the centre and e (ω̇ t̂ − ω² r̂).
    let (sin, cos) = (1.1_f64 + angle).sin_cos();
    let x = ax - moment * (spin * sin + omega * omega * cos);
    let y = ay + moment * (spin * cos - omega * omega * sin);
    assert!(x.abs() < 1e-9 && (y + 9.81).abs() < 1e-9, "{x} {y}");
    // More than the whole mass at the radius of gyration there cannot be.
    let too_much = unbalanced(scene, 0.02, 0.0);
    let refused = compile(&too_much).unwrap_err();
    assert!(matches!(refused, Error::Scene { path, .. } if path == "unbalances.u.moment"));
}
