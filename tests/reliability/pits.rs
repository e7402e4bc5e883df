//! What pits are refused, by the field to change.

use std::f64::consts::FRAC_PI_2;

use ballrace::scene::{Defect, GothicArch, Patch, Pit, Scene, Surface, Value, presets};
use ballrace::{Error, compile, explain};

use serde_json::json;

use crate::common::through_points;

fn loaded() -> Scene {
    presets::deep_groove_6205(400.0, 150.0, 3000.0)
}

/// A bearing with a pit in its most loaded contact.
fn with_pit() -> Scene {
    let mut scene = loaded();
    let pit = pit(Surface::OuterRace, -FRAC_PI_2, 0.3e-3).at_offset(1e-3);
    scene.defects.insert("pit".to_owned(), pit);
    scene
}

/// A pit of row 0, of ball 0 where it is a ball's, which lies at an angle.
fn pit(on: Surface, angle: f64, diameter: f64) -> Defect {
    let mut pit = Defect::of(Pit::of_width(diameter), on, angle);
    pit.ball = (on == Surface::Ball).then_some(0);
    pit
}

/// Refusals: one error that names the field.
#[test]
fn impossible_pits_are_refused() {
    let refused = |change: &dyn Fn(&mut Scene)| {
        let mut scene = with_pit();
        change(&mut scene);
        match compile(&scene) {
            Err(Error::Scene { path, .. }) => path,
            other => panic!("{:?}", other.map(|_| ())),
        }
    };
    let of = |field: &str, value: Value| {
        let path = format!("defects.pit.{field}");
        match with_pit().with(&[(&path, value)]) {
            Err(Error::Scene { path, .. }) => path,
            Ok(scene) => match compile(&scene) {
                Err(Error::Scene { path, .. }) => path,
                other => panic!("{:?}", other.map(|_| ())),
            },
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(of("edge_radius", 0.1e-3.into()), "defects.pit.edge_radius");
    let floor = json!({ "depth": 1e-6, "elements": 3 });
    assert_eq!(of("floor", floor), "defects.pit.floor");
    let profile = json!({ "positions": [-1e-4, 1e-4], "widths": [1e-4, 2e-4] });
    assert_eq!(of("width", profile), "defects.pit.width");
    assert_eq!(of("length", (-1.0).into()), "defects.pit.length");
    // Beyond 0.9 a, and beyond 1.8 of the energy.
    assert_eq!(of("length", 3e-3.into()), "defects.pit.width");
    assert_eq!(of("width", 1.5e-3.into()), "defects.pit.width");
    let arch = |scene: &mut Scene| scene.rows[0].outer_arch = Some(GothicArch::new(0.3));
    assert_eq!(refused(&arch), "defects.pit.shape");
    let points = |scene: &mut Scene| *scene = through_points(scene, 300);
    assert_eq!(refused(&points), "defects.pit.shape");
}

/// Pits overlap neither each other nor other defects of their body; beside them, on another body or off the middle, they may lie.
#[test]
fn a_pit_that_overlaps_a_defect_is_refused() {
    let compiled = |other: &Defect| {
        let scene = with_pit();
        // Named before and after the pit.
        let found = ["a", "z"].map(|name| {
            let mut scene = scene.clone();
            scene.defects.insert(name.to_owned(), other.clone());
            compile(&scene).map(|_| ())
        });
        found.map(|result| match result {
            Ok(()) => None,
            Err(Error::Scene { path, allowed, .. }) => Some(format!("{path}: {allowed}")),
            Err(other) => panic!("{other}"),
        })
    };
    // Outer race: 23.5 mm, so 1 mm is 0.0426 rad.
    let spall = |angle: f64| {
        Defect::of(
            Patch::of_width(0.7e-3).length(1e-3).edge_radius(0.2e-3),
            Surface::OuterRace,
            angle - FRAC_PI_2,
        )
    };
    for over in [
        spall(0.0),
        spall(0.018),
        pit(Surface::OuterRace, 0.01 - FRAC_PI_2, 0.2e-3),
    ] {
        let [first, last] = compiled(&over);
        let [first, last] = [first.unwrap(), last.unwrap()];
        println!("{first}\n{last}");
        assert!(first.starts_with("defects.pit.angle") || first.starts_with("defects.a.angle"));
        assert!(first.contains("which it overlaps") && last.contains("which it overlaps"));
    }
    let mut elsewhere = spall(0.0);
    elsewhere.on = Surface::InnerRace;
    for apart in [
        spall(0.024),
        elsewhere,
        spall(0.0).at_offset(-0.5e-3),
        pit(Surface::OuterRace, 0.015 - FRAC_PI_2, 0.2e-3),
    ] {
        assert_eq!(compiled(&apart), [None, None], "{apart:?}");
    }
}

/// A contact counts four pits: five that it may meet at once are refused, whosever they are, not five all round.
#[test]
fn more_than_four_pits_at_once_are_refused() {
    let compiled = |on_race: u32, apart: f64, on_ball: u32| {
        let mut scene = loaded();
        for (on, count, apart) in [
            (Surface::OuterRace, on_race, apart),
            (Surface::Ball, on_ball, 1.0),
        ] {
            for i in 0..count {
                let pit = pit(on, apart * f64::from(i), 0.1e-3);
                scene.defects.insert(format!("{on:?}{i}"), pit);
            }
        }
        compile(&scene).map(|_| ()).map_err(|error| match error {
            Error::Scene { path, value, .. } => format!("{path}: {value}"),
            other => panic!("{other}"),
        })
    };
    // 0.106 mm of race, and 4.7 mm.
    let (close, wide) = (0.0045, 0.2);
    for (on_race, apart, on_ball) in [(4, close, 0), (9, wide, 3), (2, close, 2)] {
        compiled(on_race, apart, on_ball).unwrap();
    }
    // A ball's pits count all, wherever they lie on it.
    for (on_race, on_ball) in [(5, 0), (3, 2), (0, 5)] {
        let message = compiled(on_race, close, on_ball).unwrap_err();
        println!("{message}");
        assert!(
            message.starts_with("defects: 5 pits that a contact of row 0"),
            "{message}"
        );
    }
}

/// Analytic: a circle wholly in its contact loses (4/3)(c³/E*) p²/δ whatever the load, 3.49 N for 0.178 mm on the outer race of a
/// 6205; the fields belong together.
#[test]
fn an_explanation_has_what_a_pit_takes() {
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1797.0);
    let seeded = pit(Surface::OuterRace, -FRAC_PI_2, 0.178e-3);
    scene.defects.insert("seeded".to_owned(), seeded);
    let explanation = explain(&scene).unwrap();
    let of = &explanation.pits[0];
    println!("{of}");
    assert!((of.lost / 3.49 - 1.0).abs() < 0.01, "{of:?}");
    // F = K δ^{3/2}: so much less approach takes as much.
    let stiffness = 1.5 * of.load / (of.lost / of.depth);
    assert!((5e-6..12e-6).contains(&stiffness), "approach {stiffness:e}");
    assert!(
        (of.released * of.load - 0.0307 * 250.0).abs() < 1.5,
        "{of:?}"
    );
    // The contact moves over the race with the orbit, 0.398 of the shaft's speed, at 23.49 mm.
    let speed = (of.size[0] + of.contact[0]) / of.duration;
    assert!((speed / 1.76 - 1.0).abs() < 0.02, "{speed}");
    assert!(
        explanation
            .to_string()
            .contains("seeded: pit on the outer race, 0.178 mm: under ")
    );
    assert!(explanation.to_string().contains("takes 3.5 N of it"));
    scene.defects.clear();
    assert!(explain(&scene).unwrap().pits.is_empty());
}
