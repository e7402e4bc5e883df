//! Dents with a raised rim: limits, what they do to a bearing, and what is refused.

use std::f64::consts::FRAC_PI_2;

use ballrace::scene::{Damage, Defect, Dent, Pit, Scene, Surface, presets};
use ballrace::{Error, Signals, compile, explain};

use crate::common::{apart, rms, run, short};

const SURFACES: [Surface; 3] = [Surface::OuterRace, Surface::InnerRace, Surface::Ball];

/// A 6205 with a damage of a surface that ball 0 meets soon, or has.
fn bearing(on: Surface, damage: Damage) -> Scene {
    let mut scene = presets::deep_groove_6205(400.0, 150.0, 3000.0);
    let ahead = match on {
        Surface::OuterRace => 0.06,
        Surface::InnerRace => -0.09,
        _ => 0.35,
    };
    let defect = Defect::of(damage, on, ahead - FRAC_PI_2);
    scene.defects.insert("dent".to_owned(), defect);
    scene
}

fn dent(width: f64, depth: f64, rim_height: f64) -> Damage {
    Dent::of_width(width)
        .depth(depth)
        .rim_height(rim_height)
        .into()
}

fn ay(scene: &Scene) -> Vec<f64> {
    let out: Signals = run(scene, &short(2e-3));
    out.get("outer.ay").unwrap().to_vec()
}

/// Limit: without a size a dent is healthy, bit for bit, and the smaller it is the less it does.
#[test]
fn a_dent_without_width_is_healthy() {
    for on in SURFACES {
        let mut healthy = bearing(on, dent(0.0, 8e-6, 0.3e-6));
        let none = ay(&healthy);
        healthy.defects.clear();
        let truth = ay(&healthy);
        let off = [0.2e-3, 0.1e-3, 0.05e-3]
            .map(|width| apart(&ay(&bearing(on, dent(width, 8e-6, 0.3e-6))), &truth));
        println!("{on:?}: {off:?}");
        // Contacts over it are evaluated one by one, in another order of sums.
        assert!(apart(&none, &truth) < 1e-6, "{on:?}");
        assert!(
            off[0] > 1e-3 && off.windows(2).all(|pair| pair[1] < 0.6 * pair[0]),
            "{off:?}"
        );
    }
}

/// Limit: a deep dent without a rim is the pit of its size; a rim of some tenths of a micrometre is heard beside it.
#[test]
fn a_deep_dent_without_a_rim_is_a_pit() {
    for on in SURFACES {
        let pit = ay(&bearing(on, Pit::of_width(0.2e-3).into()));
        let deep = ay(&bearing(on, dent(0.2e-3, 1e-4, 0.0)));
        let rimmed = ay(&bearing(on, dent(0.2e-3, 1e-4, 0.4e-6)));
        let (same, heard) = (apart(&deep, &pit), apart(&rimmed, &pit));
        println!(
            "{on:?}: {same:.1e}, rim {heard:.1e}, {:.2} m/s²",
            rms(&rimmed)
        );
        // Steps see a rim, which is narrower.
        assert!(
            same < 1e-3 && heard > 30.0 * same,
            "{on:?}: {same:e} {heard:e}"
        );
    }
}

/// Explanations say what a dent does to the most loaded contact that meets it: less than a pit, the higher its rim.
#[test]
fn explanations_weigh_the_rim() {
    let lost = |rim: f64| {
        let scene = bearing(Surface::OuterRace, dent(0.2e-3, 8e-6, rim));
        let found = explain(&scene).unwrap().pits;
        println!("{}", found[0]);
        assert!(found[0].to_string().contains("dent on the outer race"));
        found[0].lost
    };
    let lost = [0.0, 0.3e-6, 0.6e-6].map(lost);
    assert!(
        lost.windows(2).all(|pair| pair[1] < pair[0] - 1.0),
        "{lost:?}"
    );
}

/// One error that names the field.
#[test]
fn impossible_dents_are_refused() {
    let of = |field: &str, value: f64| {
        let scene = bearing(Surface::OuterRace, dent(0.2e-3, 8e-6, 0.3e-6));
        let path = format!("defects.dent.{field}");
        match scene
            .with(&[(&path, value.into())])
            .map(|scene| compile(&scene))
        {
            Err(Error::Scene { path, .. }) | Ok(Err(Error::Scene { path, .. })) => path,
            other => panic!("{:?}", other.map(|_| ())),
        }
    };
    assert_eq!(of("depth", -1e-6), "defects.dent.depth");
    assert_eq!(of("rim_height", 1e-3), "defects.dent.rim_height");
    assert_eq!(of("edge_radius", 1e-4), "defects.dent.edge_radius");
    assert_eq!(of("length", -1e-4), "defects.dent.length");
    // Beyond what is smaller than its contact.
    assert_eq!(of("width", 1.5e-3), "defects.dent.width");
    let mut pitted = bearing(Surface::OuterRace, dent(0.2e-3, 8e-6, 0.3e-6));
    pitted.defects.get_mut("dent").unwrap().damage = Pit::of_width(0.2e-3).into();
    match pitted.with(&[("defects.dent.depth", 1e-6.into())]) {
        Err(Error::Scene { path, .. }) => assert_eq!(path, "defects.dent.depth"),
        other => panic!("{other:?}"),
    }
}
