//! How runs begin: balls that are held stay, and what a given state says of attitudes is held to what they are.

use ballrace::dynamics::rhs;
use ballrace::scene::{Cap, Defect, Mount, Scene, Spin, Surface, presets};
use ballrace::{Error, Model, Start, compile, explain, start};

/// A 6205 under thrust whose ball 2 has a cap and whose balls spin freely.
fn capped() -> Scene {
    let mut scene = presets::deep_groove_6205(300.0, 600.0, 1500.0);
    scene.spin = Some(Spin::Free);
    let cap = Defect::of(Cap::of_width(1e-3).edge_radius(0.05e-3), Surface::Ball, 0.3).on_ball(2);
    scene.defects.insert("pit".to_owned(), cap);
    scene
}

fn at(model: &Model, name: &str) -> usize {
    model.names().iter().position(|n| n == name).unwrap()
}

/// Analytic: what cannot move has no speed, whether it turns about one axis or about any.
#[test]
fn held_balls_stay() {
    for spin in [None, Some(Spin::Free)] {
        let mut scene = capped();
        scene.spin = spin;
        scene.cage = None;
        scene.rows[0].ball_support.x = Some(Mount::Fixed);
        scene.rows[0].ball_support.theta = Some(Mount::Fixed);
        let model = compile(&scene).unwrap();
        for from in [Start::Rolling, Start::Equilibrium] {
            let y = start(&model, &from).unwrap();
            let mut rates = vec![0.0; y.len()];
            rhs(&model, 0.0, &y, &mut rates);
            let moves = |place: &str| {
                let i = at(&model, &format!("row0.ball2.{place}"));
                rates[i] != 0.0 || rates[i + y.len() / 2] != 0.0
            };
            let turns = ["turn_x", "turn_y", "e0", "e1", "e2", "e3"];
            let turns = turns.into_iter().filter(|_| spin.is_some());
            for place in ["x", "theta"].into_iter().chain(turns) {
                assert!(!moves(place), "{from:?} {place}");
            }
            assert!(moves("y"), "{from:?}");
        }
    }
}

/// Four zeros are no attitude; one that is next to length one is brought there, and changes as the ball turns, whatever the state
/// says of its rate.
#[test]
fn given_attitudes_are_attitudes() {
    let model = compile(&capped()).unwrap();
    let mut y0 = start(&model, &Start::Equilibrium).unwrap();
    let first = at(&model, "row0.ball2.e0");
    let given = |y: &[f64]| start(&model, &Start::State(y.to_vec()));
    assert_eq!(given(&y0).unwrap(), y0);
    // e0 = 1: ė = ½ (0, ω).
    y0[first..first + 4].copy_from_slice(&[1.0, 0.0, 0.0, 0.0]);
    y0[at(&model, "row0.ball2.turn_x") + model.dim() / 2] = 40.0;
    let rates = at(&model, "row0.ball2.ve0");
    assert_eq!(given(&y0).unwrap()[rates..rates + 2], [0.0, 20.0]);
    // Errors of the steps that led there are taken back: a state of a run is one to begin with.
    y0[first..first + 4].copy_from_slice(&[1.0 + 1e-4, 0.0, 0.0, 0.0]);
    assert_eq!(given(&y0).unwrap()[first], 1.0);
    y0[first] = 0.0;
    match given(&y0) {
        Err(Error::Argument { path, allowed, .. }) => {
            assert_eq!(path, format!("start[{first}]"));
            assert!(allowed.contains("Euler parameters"), "{allowed}");
        }
        other => panic!("{other:?}"),
    }
}

/// What explains a scene also looks at it without its defects, whose balls then have no attitude.
#[test]
fn scenes_with_tumbling_balls_are_explained() {
    let found = explain(&capped()).unwrap();
    assert!(found.variants.iter().all(|of| of.kept <= found.kept));
}
