//! Pits smaller than their contact (`docs/model.md`, *Defects*): limits, symmetry, conservation, stability.

use std::f64::consts::{FRAC_PI_2, PI};

use ballrace::dynamics::contributions;
use ballrace::inspect::contact;
use ballrace::scene::{Defect, Drive, NormalLaw, Pit, Probe, Scene, Spin, Surface, presets};
use ballrace::{Race, Signals, Start, compile, start};

use crate::common::{apart, effects, oiled, one_ball, run, short};
use crate::energy::{LAWS, coasting, drift, with_pit};

const SURFACES: [Surface; 3] = [Surface::OuterRace, Surface::InnerRace, Surface::Ball];

/// A pit of row 0, of ball 0 where it is a ball's, which lies at an angle.
fn pit(on: Surface, angle: f64, diameter: f64) -> Defect {
    let mut pit = Defect::of(Pit::of_width(diameter), on, angle);
    pit.ball = (on == Surface::Ball).then_some(0);
    pit
}

fn with(mut scene: Scene, defects: &[Defect]) -> Scene {
    for (i, defect) in defects.iter().enumerate() {
        scene.defects.insert(format!("pit{i}"), defect.clone());
    }
    scene
}

fn without_defects(mut scene: Scene) -> Scene {
    scene.defects.clear();
    scene
}

/// What contacts do to the ball of a scene of one, at its start, along x, y, z and about z \[N\], \[N m\].
fn on_ball(scene: &Scene) -> [f64; 4] {
    let model = compile(scene).unwrap();
    let y = start(&model, &Start::Rolling).unwrap();
    let parts = contributions(&model, 0.0, &y);
    let contact = &parts.iter().find(|(name, _)| *name == "contact").unwrap().1;
    [8, 9, 10, 11].map(|i| contact[i])
}

fn differ(one: [f64; 4], other: [f64; 4]) -> f64 {
    (0..3)
        .map(|i| (one[i] - other[i]).abs())
        .fold(0.0, f64::max)
}

/// Limit: under a film that gets thinner a pitted contact tends to the dry one, in proportion to the film.
#[test]
fn a_thin_film_leaves_a_dry_pit() {
    for law in [NormalLaw::Hertz, NormalLaw::iso16281()] {
        for on in SURFACES {
            let angle = if on == Surface::Ball { 0.01 } else { 0.002 };
            let mut dry = with(one_ball(8e-6), &[pit(on, angle, 0.25e-3).at_offset(0.0)]);
            dry.contact.law = law.clone();
            let lost = differ(on_ball(&dry), on_ball(&without_defects(dry.clone())));
            let off = [1.0, 1e-2, 1e-4, 1e-6].map(|slow| {
                let mut wet = oiled(dry.clone());
                let oil = wet.lubricant.as_mut().unwrap();
                effects(oil, "film");
                (oil.reference_load, oil.reference_speed) = (Some(250.0), Some(188.0 * slow));
                let healthy = on_ball(&without_defects(wet.clone()));
                // Both contacts of a ball have films: what is left of their forces is not the pit's.
                let (found, plain) = (on_ball(&wet), on_ball(&without_defects(dry.clone())));
                let film = [0, 1, 2, 3].map(|i| healthy[i] - plain[i]);
                let dry = on_ball(&dry);
                differ([0, 1, 2, 3].map(|i| found[i] - film[i]), dry) / lost
            });
            println!("{law:?} {on:?}: loses {lost:.2} N, {off:?}");
            assert!(lost > 1.0, "{lost}");
            assert!(off[0] > 1e-3 && off[3] < 1e-5, "{off:?}");
            assert!(
                off.windows(2).all(|pair| pair[1] < pair[0] / 10.0),
                "{off:?}"
            );
        }
    }
}

/// Limit: films over pits neither damp nor rub here, and keep energy.
#[test]
fn a_film_over_a_pit_keeps_energy() {
    for law in &LAWS {
        for on in SURFACES {
            let mut scene = oiled(with_pit(law, on));
            effects(scene.lubricant.as_mut().unwrap(), "film");
            scene.drive = Drive::Speed(scene.drive.initial_speed().into());
            if on == Surface::InnerRace {
                scene.probes.insert("torque".to_owned(), Probe::torque());
            }
            let found = drift(&scene, 6e-3);
            println!("{law:?}, {on:?}: {found:.1e}");
            assert!(found < 1e-5, "{law:?}, {on:?}: {found:.1e}");
        }
    }
}

/// A 6205 under load and thrust with a pit that ball 0 meets soon, or has, all of it turned by an angle.
fn turned_by(on: Surface, angle: f64) -> Scene {
    let mut scene = presets::deep_groove_6205(400.0, 150.0, 4500.0);
    // Angle run by the contact on the surface in 0.7 ms or so, as of `energy::defect`.
    let ahead = match on {
        Surface::OuterRace => 0.12,
        Surface::InnerRace => -0.19,
        Surface::Ball => 0.75,
        other => panic!("{other:?}"),
    };
    // A number: what is placed where the contact runs is rounded to a nanometre.
    let place = if on == Surface::InnerRace {
        -1.0e-3
    } else {
        1.0e-3
    };
    let pit = pit(on, ahead - FRAC_PI_2 + angle, 0.3e-3).at_offset(place);
    scene.defects.insert("pit".to_owned(), pit);
    scene.rows[0].start_angle += angle;
    let (sin, cos) = angle.sin_cos();
    let turned = |[x, y, z]: [f64; 3]| [cos * x - sin * y, sin * x + cos * y, z];
    for load in scene.loads.values_mut() {
        load.direction = turned(load.direction);
    }
    scene.gravity = turned(scene.gravity);
    scene
}

/// Accelerations of the outer ring in the plane, turned back by an angle.
fn turned_back(out: &Signals, angle: f64) -> Vec<f64> {
    let [x, y] = ["outer.ax", "outer.ay"].map(|name| out.get(name).unwrap());
    let (sin, cos) = angle.sin_cos();
    let along = x.iter().zip(y).map(|(x, y)| cos * x + sin * y);
    let across = x.iter().zip(y).map(|(x, y)| cos * y - sin * x);
    along.chain(across).collect()
}

/// A run of 2.5 ms at a tight tolerance, turned back by an angle.
fn exactly(scene: &Scene, angle: f64) -> Vec<f64> {
    let mut asked = short(2.5e-3);
    asked.rtol = Some(1e-9);
    turned_back(&run(scene, &asked), angle)
}

/// Symmetry: pit, balls and loads turned together give the same run, turned, as exactly as statics finds where it starts.
/// By this angle the outer race's pit comes to where angles begin anew.
#[test]
fn no_direction_of_a_pit_is_special() {
    for on in SURFACES {
        let record = |angle: f64| exactly(&turned_by(on, angle), angle);
        let healthy = without_defects(turned_by(on, 0.0));
        let (plain, other) = (record(0.0), record(4.6));
        let felt = apart(&exactly(&healthy, 0.0), &plain);
        let found = apart(&other, &plain);
        println!("{on:?}: {found:.1e}, without the pit {felt:.1e}");
        assert!(found < 1e-4 && felt > 0.1, "{found:e} {felt:e}");
    }
}

/// Conservation: the pit of a ball that spins about any axis, without friction.
#[test]
fn pits_of_balls_that_spin_freely_keep_energy() {
    for law in &LAWS {
        let mut scene = with_pit(law, Surface::Ball);
        scene.spin = Some(Spin::Free);
        let found = drift(&scene, 6e-3);
        let quiet = run(&without_defects(scene.clone()), &short(3e-3));
        let pitted = run(&scene, &short(3e-3));
        let [healthy, felt] = [&quiet, &pitted].map(|out| out.get("inner.ay").unwrap().to_vec());
        let felt = apart(&felt, &healthy);
        println!("{law:?}: {found:.1e}, moves by {felt:.1e}");
        assert!(found < 1e-5, "{law:?}: {found:.1e}");
        assert!(felt > 1e-3, "{felt}");
    }
}

/// A ball that spins freely with friction and a pit runs by both kinds of methods alike.
#[test]
fn a_free_ball_with_a_pit_runs() {
    let mut scene = turned_by(Surface::Ball, 0.0);
    scene.spin = Some(Spin::Free);
    let record = |rtol: Option<f64>| {
        let mut asked = short(2.5e-3);
        asked.rtol = rtol;
        let out = run(&scene, &asked);
        assert!(out.warnings().is_empty(), "{:?}", out.warnings());
        turned_back(&out, 0.0)
    };
    let found = apart(&record(None), &record(Some(1e-8)));
    println!("{found:.1e}");
    assert!(found < 2e-2, "{found:e}");
}

/// Stability: however light a contact is, and wherever a pit lies in it, it takes a part of the force and never pulls the ball.
#[test]
fn light_contacts_push_at_a_pit() {
    let squeeze = 16e-6;
    let mut least: f64 = 1.0;
    for (on, race, sigma) in [
        (Surface::OuterRace, Race::Outer, 1.0),
        (Surface::InnerRace, Race::Inner, -1.0),
    ] {
        for diameter in [0.1e-3, 0.3e-3, 0.8e-3] {
            for place in 0..24_u32 {
                let angle = 2e-3 * f64::from(place % 6);
                let across = 0.2e-3 * f64::from(place / 6);
                let pit = pit(on, angle, diameter).at_offset(across);
                let pitted = compile(&with(one_ball(squeeze), &[pit])).unwrap();
                let whole = compile(&one_ball(squeeze)).unwrap();
                let mut y = start(&whole, &Start::Rolling).unwrap();
                let middle = y[8];
                for approach in [0.01e-6, 0.03e-6, 0.1e-6, 0.3e-6, 1e-6, 3e-6] {
                    y[8] = middle - sigma * (squeeze / 4.0 - approach);
                    let [before, left] =
                        [&whole, &pitted].map(|model| contact(model, &y, 0, race).unwrap().load);
                    assert!(before > 1e-3, "{before}");
                    least = least.min(left / before);
                    assert!(
                        left > 0.0 && left <= before * (1.0 + 1e-12),
                        "{on:?} {diameter} {angle} {across} {approach}: {left} of {before} N"
                    );
                }
            }
        }
    }
    println!("what is left: {least:.1e} at least");
    assert!(least < 0.5, "no pit is felt: {least}");
}

/// Stability: a lightly loaded bearing runs over its pits without a pull or a warning, and steps resolve them.
#[test]
fn a_light_bearing_runs_over_pits() {
    for on in SURFACES {
        let mut scene = turned_by(on, 0.0);
        scene.loads.get_mut("radial").unwrap().force = 12.0.into();
        scene.loads.get_mut("axial").unwrap().force = 5.0.into();
        scene
            .defects
            .get_mut("pit")
            .unwrap()
            .damage
            .set_width(0.15e-3);
        let out = run(&scene, &short(3e-3));
        let mut exact = short(3e-3);
        exact.rtol = Some(1e-8);
        let fine = run(&scene, &exact);
        let found = apart(&turned_back(&out, 0.0), &turned_back(&fine, 0.0));
        println!("{on:?}: {found:.1e}");
        assert_eq!(out.stats.clamped_pulls, 0);
        // So light a load is doubted, and the axis that is held; of pits nothing is told.
        let told: Vec<String> = out.warnings().iter().map(ToString::to_string).collect();
        assert!(told.iter().all(|text| !text.contains("pit")), "{told:?}");
        assert!(found < 0.05, "{found:e}");
    }
}

/// Stability: the faster a ball, the fewer steps see a pit; the largest step keeps a quarter of its half-width, or of the contact's.
#[test]
fn steps_see_a_pit_at_speed() {
    for (rpm, width) in [
        (3000.0, 0.178e-3),
        (20_000.0, 0.178e-3),
        (30_000.0, 0.06e-3),
    ] {
        let mut scene = turned_by(Surface::OuterRace, 0.0);
        scene.drive = Drive::Speed((rpm * PI / 30.0).into());
        let ahead = 0.12 * (rpm / 3000.0) * 0.4;
        scene.rows[0].start_angle = -FRAC_PI_2 - ahead;
        let defect = scene.defects.get_mut("pit").unwrap();
        defect.angle = -FRAC_PI_2;
        defect.damage.set_width(width);
        let record = |scene: &Scene, rtol: Option<f64>| {
            let mut asked = short(1e-3);
            asked.rtol = rtol;
            run(scene, &asked)
        };
        let out = record(&scene, None);
        let mut often = scene.clone();
        often.solver.max_step = Some(0.2e-6);
        let (fine, healthy) = (
            turned_back(&record(&often, Some(1e-9)), 0.0),
            turned_back(&record(&without_defects(often.clone()), Some(1e-9)), 0.0),
        );
        let found = apart(&turned_back(&out, 0.0), &fine);
        let felt = apart(&healthy, &fine);
        let u = 0.5 * model_speed(&scene);
        let most = width / 2.0 / (4.0 * u);
        println!(
            "{rpm} rpm, {width} m: {found:.1e} of {felt:.1e}, steps {:.2e} of {most:.2e} s",
            out.stats.largest_step
        );
        assert!(out.stats.largest_step <= 1.05 * most);
        assert!(found < 0.02 && found < felt, "{found:e} {felt:e}");
    }
}

/// Speed at which the surfaces of rolling balls and of the outer race pass each other, in sum \[m/s\].
fn model_speed(scene: &Scene) -> f64 {
    let model = compile(scene).unwrap();
    let row = &scene.rows[0];
    2.0 * model.rolling_speeds(0).0 * (row.pitch_diameter + row.ball_diameter) / 2.0
}

/// Limit: small pits apart from each other take what each would take alone, on one body or on two.
#[test]
fn several_pits_add_up() {
    let small = 0.06e-3;
    let (one, other) = (
        pit(Surface::OuterRace, 0.001, small).at_offset(0.1e-3),
        pit(Surface::OuterRace, -0.002, small).at_offset(-0.2e-3),
    );
    for second in [other, pit(Surface::Ball, 0.004, small).at_offset(-0.1e-3)] {
        let held = one_ball(8e-6);
        let whole = on_ball(&held)[0];
        let lost = |pits: &[Defect]| on_ball(&with(held.clone(), pits))[0] - whole;
        let (first, second, both) = (
            lost(std::slice::from_ref(&one)),
            lost(std::slice::from_ref(&second)),
            lost(&[one.clone(), second]),
        );
        println!("{first} {second} {both}");
        assert!(first > 0.1 && second > 0.1);
        assert!((both / (first + second) - 1.0).abs() < 0.02);
    }
}

/// Conservation: pits of both races and of a ball in one run.
#[test]
fn several_pits_keep_energy() {
    for law in &LAWS {
        let mut scene = coasting(law);
        for on in SURFACES {
            let of = with_pit(law, on);
            let pit = of.defects.values().next().unwrap();
            let mut beside = pit.clone();
            beside.angle += 0.02;
            scene = with(scene, &[]);
            scene.defects.insert(format!("{on:?}"), pit.clone());
            if on != Surface::Ball {
                scene.defects.insert(format!("{on:?}_beside"), beside);
            }
        }
        assert_eq!(scene.defects.len(), 5);
        let found = drift(&scene, 6e-3);
        println!("{law:?}: {found:.1e}");
        assert!(found < 1e-5, "{law:?}: {found:.1e}");
    }
}
