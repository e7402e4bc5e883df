//! Spalls between steep walls against a solver by boundary elements: what a contact of 250 N loses at fixed approach, on
//! the outer race of a 6205, at distances from an edge and in the middle of slots. `--nocapture` shows every case.

use crate::common::one_ball;

use ballrace::inspect::contact;
use ballrace::scene::{Damage, Defect, Scene, SteepPatch, Surface, Value};
use ballrace::{Error, Model, Race, Start, compile, start};

/// The reference contact is pressed by 250 N at this interference \[m\]: both races give way.
const SQUEEZE: f64 = 18.62e-6;
/// Radius of the outer race \[m\].
const RADIUS: f64 = 23.49e-3;

fn load(model: &Model, race: Race) -> f64 {
    let healthy = compile(&one_ball(SQUEEZE)).unwrap();
    let y = start(&healthy, &Start::Rolling).unwrap();
    contact(model, &y, 0, race).unwrap().load
}

/// A spall of a width \[m\] across the race whose nearer edge is so far beyond the contact's middle \[m\].
fn spall(width: f64, inside: f64) -> Defect {
    let angle = (width / 2.0 - inside) / RADIUS;
    Defect::of(
        SteepPatch::of_width(width).length(4e-3),
        Surface::OuterRace,
        angle,
    )
    .at_offset(0.0)
}

fn with(defect: &Defect) -> Scene {
    let mut scene = one_ball(SQUEEZE);
    scene.defects.insert("spall".to_owned(), defect.clone());
    scene
}

/// What the contact loses \[N\].
fn lost(defect: &Defect) -> f64 {
    let whole = load(&compile(&one_ball(SQUEEZE)).unwrap(), Race::Outer);
    assert!((whole - 250.0).abs() < 1.0, "{whole}");
    whole - load(&compile(&with(defect)).unwrap(), Race::Outer)
}

#[test]
fn contacts_unload_before_steep_walls() {
    for (inside, solver) in [
        (0.2e-3, 245.0),
        (0.1e-3, 134.0),
        (0.0, 34.0),
        (-0.1e-3, 0.2),
    ] {
        let found = lost(&spall(2e-3, inside));
        println!(
            "{:+.1} mm from an edge: solver {solver} N, here {found:.1} N",
            1e3 * inside
        );
        assert!((found - solver).abs() < 16.0, "{found}");
    }
    for (width, solver) in [(0.4e-3, 244.0), (0.3e-3, 164.0)] {
        let found = lost(&spall(width, width / 2.0));
        println!(
            "slot of {:.1} mm: solver {solver} N, here {found:.1} N",
            1e3 * width
        );
        assert!((found - solver).abs() < 10.0, "{found}");
    }
}

/// A run's scene has the numbers, by the half-width of its contact, and runs as they stand there.
#[test]
fn walls_are_numbers_once_placed() {
    let placed = compile(&with(&spall(0.4e-3, 0.2e-3))).unwrap();
    let damage = &placed.scene().defects["spall"].damage;
    let Damage::Patch(patch) = damage else {
        panic!("{damage:?}");
    };
    assert_eq!(patch.edge_radius, 7.94e-3 / 4.0);
    let half = damage.width() - 0.4e-3;
    assert!((half / 0.1179e-3 - 1.0).abs() < 0.01, "{half}");
    let again = compile(placed.scene()).unwrap();
    assert_eq!(load(&again, Race::Outer), load(&placed, Race::Outer));
}

#[test]
fn walls_that_cannot_be_are_refused() {
    let refused = |change: &dyn Fn(&mut Scene)| {
        let mut scene = with(&spall(0.4e-3, 0.2e-3));
        change(&mut scene);
        match compile(&scene) {
            Err(Error::Scene { path, allowed, .. }) => format!("{path}: {allowed}"),
            other => panic!("{:?}", other.map(|_| ())),
        }
    };
    let in_document = |field: &str, value: Value| {
        let path = format!("defects.spall.{field}");
        match with(&spall(0.4e-3, 0.2e-3)).with(&[(&path, value)]) {
            Err(Error::Scene { path, allowed, .. }) => format!("{path}: {allowed}"),
            other => panic!("{other:?}"),
        }
    };
    let edged = in_document("edge_radius", 0.3e-3.into());
    assert!(edged.starts_with("defects.spall.edge_radius"));
    assert!(in_document("shape", "pit".into()).starts_with("defects.spall.walls"));
    let narrow = refused(&|scene| {
        let spall = scene.defects.get_mut("spall").unwrap();
        spall.damage.set_width(0.25e-3);
    });
    println!("{narrow}");
    assert!(narrow.starts_with("defects.spall.width") && narrow.contains("is a pit"));
    // Without a loaded contact nothing says how wide one is.
    let loose = refused(&|scene| scene.rows[0].clearance = 50e-6);
    println!("{loose}");
    assert!(loose.starts_with("defects.spall.walls"));
}
