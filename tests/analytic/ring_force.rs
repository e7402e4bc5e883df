//! Analytic: a force on a ring by a table or by a program's own code is a force like any. A spring by either equals a support of the same
//! stiffness in equilibria, runs, energies and reductions; a pull that grows with the displacement softens a mount by its slope.

use std::ops::ControlFlow;
use std::sync::Arc;

use ballrace::inspect::energy;
use ballrace::scene::{
    Mount, RingForce, RingForces, RingMotion, RingName, Scene, TableForce, presets,
};
use ballrace::{
    Case, Error, FeatureOptions, Run, Simulation, Snapshot, campaign, compile, equilibrium,
    explain, simulate, stiffness,
};

const STIFFNESS: f64 = 3e7;
const DAMPING: f64 = 300.0;

/// Stiffness and damping of the outer ring along y.
#[derive(Debug)]
struct Linear {
    stiffness: f64,
    damping: f64,
    plane: bool,
}

impl RingForce for Linear {
    fn ring(&self) -> RingName {
        RingName::Outer
    }

    fn wrench(&self, _: f64, ring: &RingMotion) -> [f64; 6] {
        let force = -self.stiffness * ring.place[1] - self.damping * ring.velocity[1];
        [0.0, force, 0.0, 0.0, 0.0, 0.0]
    }

    fn stiffness(&self) -> f64 {
        self.stiffness.abs()
    }

    fn damping(&self) -> f64 {
        self.damping
    }

    fn energy(&self, ring: &RingMotion) -> f64 {
        0.5 * self.stiffness * ring.place[1].powi(2)
    }

    fn keeps_plane(&self) -> bool {
        self.plane
    }
}

fn spring(stiffness: f64, damping: f64) -> Mount {
    Mount::Spring { stiffness, damping }
}

/// A 6205 whose outer ring moves along x and y.
fn mounted(y: Mount) -> Scene {
    let mut scene = presets::deep_groove_6205(800.0, 0.0, 1800.0);
    let support = &mut scene.outer_ring.support;
    (support.x, support.y) = (Some(spring(STIFFNESS, DAMPING)), Some(y));
    scene
}

fn by_code(plane: bool) -> Scene {
    let mut scene = mounted(Mount::Free);
    let force = Linear {
        stiffness: STIFFNESS,
        damping: DAMPING,
        plane,
    };
    scene.ring_forces.insert("spring", Arc::new(force));
    scene
}

fn by_table() -> Scene {
    let mut scene = mounted(Mount::Free);
    let forces = [1e-5 * STIFFNESS, -2e-5 * STIFFNESS];
    let mut table = TableForce::new(RingName::Outer, [0.0, 3.0, 0.0], [-1e-5, 2e-5], forces);
    table.damping = DAMPING;
    scene.table_forces.insert("spring".to_owned(), table);
    scene
}

/// The scene that is known, and the same by code and by a table.
fn all() -> [Scene; 3] {
    [
        mounted(spring(STIFFNESS, DAMPING)),
        by_code(true),
        by_table(),
    ]
}

#[test]
fn a_spring_has_the_equilibrium_of_a_support() {
    let [known, others @ ..] = all().map(|scene| equilibrium(&scene).unwrap());
    for other in others {
        for (known, other) in [(known.outer, other.outer), (known.inner, other.inner)] {
            for i in 0..3 {
                assert!((known[i] - other[i]).abs() < 1e-11, "{known:?} {other:?}");
            }
        }
    }
    assert!(known.outer[1] < -1e-5);
}

#[test]
fn a_spring_runs_as_a_support_does() {
    let run = Run {
        duration: 2e-3,
        settle: Some(0.0),
        rtol: Some(1e-9),
        ..Run::default()
    };
    let [known, others @ ..] = all().map(|scene| simulate(&scene, &run).unwrap());
    let known = known.get("outer.ay").unwrap();
    let size = known.iter().fold(0.0, |most: f64, a| most.max(a.abs()));
    for other in &others {
        for (known, other) in known.iter().zip(other.get("outer.ay").unwrap()) {
            assert!((known - other).abs() < 1e-5 * size, "{known} {other}");
        }
    }
}

#[test]
fn a_spring_stores_what_a_support_does() {
    let [known, others @ ..] = all().map(|scene| {
        let model = compile(&scene).unwrap();
        let mut y = vec![0.0; model.dim()];
        for (i, (place, moved)) in y.iter_mut().zip([1e-5, -2e-5, 0.0]).enumerate() {
            *place = moved * (1.0 + i as f64);
        }
        energy(&model, &y).unwrap().support
    });
    assert!(known > 0.0);
    for other in others {
        assert!((known - other).abs() < 1e-12 * known, "{known} {other}");
    }
}

#[test]
fn a_run_leaves_out_what_a_force_leaves_alone() {
    let kept = |scene: &Scene| explain(scene).unwrap();
    let [known, coded, tabled] = all().map(|scene| kept(&scene));
    assert_eq!([known.kept; 2], [coded.kept, tabled.kept]);
    assert!(coded.evaluated.contains(&"ring forces"));
    assert!(!known.evaluated.contains(&"ring forces"));
    let off = kept(&by_code(false));
    assert!(off.kept > coded.kept);
    let because = "may act off the plane";
    assert!(
        off.obstacles
            .iter()
            .any(|of| format!("{of:?}").contains(because))
    );
}

/// A magnetic pull k_m y on a ring on a mount of stiffness k, which carries all of a load F: y = F/(k − k_m).
#[test]
fn a_pull_softens_a_mount() {
    let mut scene = mounted(spring(STIFFNESS, DAMPING));
    scene.gravity = [0.0; 3];
    let pull = Linear {
        stiffness: -0.4 * STIFFNESS,
        damping: 0.0,
        plane: true,
    };
    scene.ring_forces.insert("pull", Arc::new(pull));
    let sunk = equilibrium(&scene).unwrap().outer[1];
    // What the cage holds of the contacts' forces along the orbit is not in the sum: some u/r of it.
    let closed = -800.0 / (0.6 * STIFFNESS);
    assert!(
        (sunk - closed).abs() < 2e-3 * closed.abs(),
        "{sunk} {closed}"
    );
}

#[test]
fn a_document_has_no_code() {
    let scene = by_code(true);
    let text = scene.to_json();
    let refused = Scene::from_json(&text).unwrap_err().to_string();
    assert!(refused.contains("ring_forces") && refused.contains("spring"));
    let wider = scene.with(&[("rows[0].clearance", 2e-5.into())]).unwrap();
    assert_eq!(wider.ring_forces, scene.ring_forces);
}

#[test]
fn a_table_is_in_the_document_and_checked() {
    let scene = by_table();
    assert_eq!(Scene::from_toml(&scene.to_toml()).unwrap(), scene);
    let refused = |path: &str, value: serde_json::Value| {
        let path = format!("table_forces.spring.{path}");
        let found = scene.with(&[(&path, value)]).unwrap_err().to_string();
        assert!(found.starts_with(&path), "{found}");
    };
    refused("places", serde_json::json!([0.0, 0.0]));
    refused("forces", serde_json::json!([1.0]));
    refused("damping", serde_json::json!(-1.0));
    refused("direction", serde_json::json!([0.0, 0.0, 0.0]));
}

/// Pushes by 1 N until a time \[s\], then as told.
#[derive(Debug)]
struct Until {
    time: f64,
    after: fn() -> f64,
    bound: f64,
}

impl RingForce for Until {
    fn ring(&self) -> RingName {
        RingName::Outer
    }

    fn wrench(&self, t: f64, _: &RingMotion) -> [f64; 6] {
        let y = if t < self.time { 1.0 } else { (self.after)() };
        [0.0, y, 0.0, 0.0, 0.0, 0.0]
    }

    fn damping(&self) -> f64 {
        self.bound
    }
}

fn faulty(time: f64, after: fn() -> f64, bound: f64) -> Scene {
    let mut scene = mounted(spring(STIFFNESS, DAMPING));
    scene.ring_forces.insert(
        "good",
        Arc::new(Until {
            time: 1.0,
            after: || 0.0,
            bound: 0.0,
        }),
    );
    scene
        .ring_forces
        .insert("seal", Arc::new(Until { time, after, bound }));
    scene
}

fn short() -> Run {
    Run {
        duration: 2e-3,
        settle: Some(0.0),
        ..Run::default()
    }
}

/// Reliability: a force that is no number is blamed by its name and time, at rest, in a run and between pieces; what comes after on the
/// same thread is not.
#[test]
fn a_force_that_is_no_number_is_blamed() {
    let blamed = |error: Error, since: f64| match error {
        Error::Force {
            path, time, reason, ..
        } => {
            assert_eq!(path, "ring_forces.seal");
            assert!(
                time >= since && time < 2e-3 && reason.contains("[0.0, NaN, 0.0"),
                "{time} {reason}"
            );
        }
        other => panic!("{other}"),
    };
    let at_once = faulty(0.0, || f64::NAN, 0.0);
    blamed(equilibrium(&at_once).unwrap_err(), 0.0);
    blamed(stiffness(&at_once).unwrap_err(), 0.0);
    blamed(simulate(&at_once, &short()).unwrap_err(), 0.0);
    let late = faulty(1e-3, || f64::NAN, 0.0);
    equilibrium(&late).unwrap();
    blamed(simulate(&late, &short()).unwrap_err(), 1e-3);
    let mut pieces = Simulation::begin(&late, &short()).unwrap();
    pieces.advance(5e-4).unwrap();
    blamed(pieces.advance(1e-3).unwrap_err(), 1e-3);
    // The load of this one, nothing else.
    let overloaded = presets::wheel_bearing(1e9);
    assert!(matches!(
        equilibrium(&overloaded),
        Err(Error::Equilibrium { .. })
    ));
    let bound = faulty(1.0, || 0.0, f64::NAN);
    let found = simulate(&bound, &short()).unwrap_err();
    assert!(matches!(found, Error::Scene { path, .. } if path == "ring_forces.seal.damping"));
}

/// Reliability: the panic of a force costs its case of a campaign, under the force's name.
#[test]
fn a_force_that_panics_is_blamed_in_its_case() {
    let scenes = [
        faulty(1e-3, || panic!("no table"), 0.0),
        faulty(1.0, || 0.0, 0.0),
    ];
    let cases = scenes.map(|scene| Case::new(scene, short()));
    let options = FeatureOptions::default();
    let outcomes = campaign(cases, 1, &options, &mut |_| ControlFlow::Continue(())).unwrap();
    match outcomes[0].result.as_ref().unwrap_err() {
        Error::Force {
            path, time, reason, ..
        } => {
            assert_eq!(
                (path.as_str(), reason.as_str()),
                ("ring_forces.seal", "it panicked: no table")
            );
            assert!(*time >= 1e-3);
        }
        other => panic!("{other}"),
    }
    assert!(outcomes[1].result.is_ok());
}

/// Limit: a snapshot's document goes on with the forces that it names, bit by bit, and is refused with others.
#[test]
fn a_snapshot_goes_on_with_its_forces() {
    let scene = by_code(true);
    let mut simulation = Simulation::begin(&scene, &short()).unwrap();
    simulation.advance(1e-3).unwrap();
    let text = simulation.snapshot().to_json();
    let mut renamed = RingForces::default();
    renamed.insert(
        "seal",
        Arc::new(Until {
            time: 1.0,
            after: || 0.0,
            bound: 0.0,
        }),
    );
    for refused in [
        Snapshot::from_json(&text),
        Snapshot::from_json_with(&text, renamed),
    ] {
        let found = refused.unwrap_err().to_string();
        assert!(
            found.starts_with("snapshot.scene.ring_forces") && found.contains("(spring)"),
            "{found}"
        );
    }
    let snapshot = Snapshot::from_json_with(&text, scene.ring_forces.clone()).unwrap();
    let again = ended(Simulation::restore(&snapshot).unwrap());
    assert_eq!(again, ended(simulation));
}

/// What is recorded of the outer ring until the run's end.
fn ended(mut simulation: Simulation) -> Vec<f64> {
    simulation.advance_to(2e-3).unwrap();
    simulation
        .finish()
        .unwrap()
        .get("outer.ay")
        .unwrap()
        .to_vec()
}
