//! The crate as an outside program uses it: nothing but `ballrace`, no preset, no progress callback.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use ballrace::scene::{
    Cage, ContactsProbe, Defect, Drive, Friction, Load, Mount, Patch, Row, Scene, SlicesProbe,
    Support, Surface, Unbalance, Waviness,
};
use ballrace::scene::{Probe, RingName};
use ballrace::{
    Block, Case, Error, FeatureOptions, Race, Run, Start, campaign, compile, dynamics, equilibrium,
    explain, inspect, load_distribution, simulate, simulate_into, start, stiffness,
};

/// Every part of a scene, by constructors and fields.
fn bearing() -> Scene {
    let mut row = Row::new(8, 8e-3, 40e-3, 0.52, 0.52);
    row.clearance = 8e-6;
    row.outer_waviness = vec![Waviness::new(9, 0.1e-6, 0.0)];
    let mut scene = Scene::new(vec![row], Drive::Speed(150.0.into()));
    scene.name = String::from("a stranger's");
    let spring = Some(Mount::Spring {
        stiffness: 1e8,
        damping: 300.0,
    });
    scene.outer_ring.mass = Some(0.2);
    scene.outer_ring.support = Support::new([spring.clone(), spring.clone(), spring, None]);
    scene.inner_ring.mass = Some(1.0);
    scene.inner_ring.support.x = Some(Mount::Spring {
        stiffness: 0.0,
        damping: 300.0,
    });
    scene.friction = Friction::Coulomb {
        coefficient: 0.05,
        slip_speed: 0.1,
    };
    scene.cage = Some(Cage::new(1e6, 20.0, 0.1e-3));
    let down = Load::new(RingName::Inner, [0.0, -1.0, 0.0], 800.0);
    let axial = Load::new(RingName::Inner, [0.0, 0.0, 1.0], 200.0);
    scene.loads = BTreeMap::from([("down".to_owned(), down), ("axial".to_owned(), axial)]);
    let unbalance = Unbalance::new(RingName::Inner, 1e-5, 0.0);
    scene.unbalances.insert("shaft".to_owned(), unbalance);
    let spall = Defect::of(
        Patch::of_width(0.5e-3).length(1e-3).edge_radius(0.2e-3),
        Surface::OuterRace,
        -1.4,
    );
    scene.defects.insert("spall".to_owned(), spall);
    let motion = Probe::motion("outer");
    scene.probes.insert("outer".to_owned(), motion);
    scene
}

fn short() -> Run {
    Run {
        duration: 1e-3,
        ..Run::default()
    }
}

#[test]
fn a_scene_built_by_constructors_runs() {
    let scene = bearing();
    assert_eq!(Scene::from_toml(&scene.to_toml()).unwrap(), scene);
    let out = simulate(&scene, &short()).unwrap();
    let ay = out.get("outer.ay").unwrap();
    assert_eq!(ay.len(), 50);
    assert!(ay.iter().all(|a| a.is_finite()) && ay.iter().any(|a| *a != 0.0));
}

/// Limit: at equilibrium the contacts of the outer ring carry the loads.
#[test]
fn contacts_are_read_from_a_state() {
    let mut scene = bearing();
    scene.defects.clear();
    let model = compile(&scene).unwrap();
    let y = start(&model, &Start::Equilibrium).unwrap();
    let axial: f64 = (0..8)
        .map(|ball| inspect::contact(&model, &y, ball, Race::Outer).unwrap())
        .filter(|contact| contact.load > 0.0)
        .map(|contact| contact.load * contact.angle.sin())
        .sum();
    assert!((axial.abs() - 200.0).abs() < 2.0, "{axial}");
    let mut dy = vec![0.0; model.dim()];
    dynamics::rhs(&model, 0.0, &y, &mut dy);
    assert!(dy.iter().all(|rate| rate.is_finite()));
    let forces = dynamics::contributions(&model, 0.0, &y);
    assert!(forces.iter().any(|(name, _)| *name == "contact"));
}

#[test]
fn statics_and_costs_are_public() {
    let scene = bearing();
    let found = equilibrium(&scene).unwrap();
    assert_eq!(found.balls.len(), 8);
    assert!(found.inner[1] < 0.0 && found.largest_pressure() > 0.0);
    assert_eq!(stiffness(&scene).unwrap().rings.len(), 6);
    assert_eq!(load_distribution(&scene, 3).unwrap().equilibria.len(), 3);
    assert!(!explain(&scene).unwrap().to_string().is_empty());
}

/// One error for bad input, which names the field.
#[test]
fn a_campaign_keeps_its_failures() {
    let mut broken = bearing();
    broken.rows[0].ball_diameter = -1.0;
    let cases = [bearing(), broken].map(|scene| Case::new(scene, short()));
    let mut done = 0;
    let outcomes = campaign(cases, 2, &FeatureOptions::default(), &mut |count| {
        done = count;
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!((outcomes.len(), done), (2, 2));
    assert!(outcomes[0].result.is_ok());
    match &outcomes[1].result {
        Err(Error::Scene { path, .. }) => assert_eq!(path, "rows[0].ball_diameter"),
        other => panic!("{other:?}"),
    }
}

/// What calls return is data for any format of serde; numbers that are none are null in JSON.
#[test]
fn results_are_serialised() {
    let out = simulate(&bearing(), &short()).unwrap();
    let document = serde_json::to_value(&out).unwrap();
    let column = |name: &str| {
        let columns = document["columns"].as_array().unwrap();
        columns.iter().find(|c| c["name"] == name).unwrap().clone()
    };
    let ay = column("outer.ay")["values"].clone();
    let ay: Vec<f64> = serde_json::from_value(ay).unwrap();
    assert_eq!(ay, out.get("outer.ay").unwrap());

    let model = compile(&bearing()).unwrap();
    let y = start(&model, &Start::Equilibrium).unwrap();
    let energy = inspect::energy(&model, &y).unwrap();
    let written = serde_json::to_value(energy).unwrap();
    assert_eq!(written["contact"], energy.contact);
    // The ball on top bears nothing.
    let free = inspect::contact(&model, &y, 2, Race::Inner).unwrap();
    assert_eq!(free.load, 0.0);
    assert!(serde_json::to_value(free).unwrap()["angle"].is_null());

    let error = simulate(&Scene::new(Vec::new(), Drive::Speed(1.0.into())), &short());
    let error = serde_json::to_value(error.unwrap_err()).unwrap();
    assert_eq!(error["Scene"]["path"], "rows");
}

/// What a service moves to threads, or shares between them.
#[test]
fn scenes_runs_and_results_may_go_to_other_threads() {
    fn shared<T: Send + Sync>() {}
    shared::<Scene>();
    shared::<Run>();
    shared::<ballrace::Model>();
    shared::<ballrace::Simulation>();
    shared::<ballrace::Snapshot>();
    shared::<ballrace::Signals>();
    shared::<ballrace::Block>();
    shared::<ballrace::Equilibrium>();
    shared::<ballrace::FaultFrequencies>();
    shared::<ballrace::Outcome>();
    shared::<Error>();
}

/// Results that are written can be read.
#[test]
fn results_are_read_as_they_were_written() {
    fn again<T: serde::Serialize + serde::de::DeserializeOwned>(of: &T) -> T {
        serde_json::from_str(&serde_json::to_string(of).unwrap()).unwrap()
    }
    /// Numbers that are none are not equal, and are written alike.
    fn keeps<T: serde::Serialize + serde::de::DeserializeOwned>(of: &T) {
        let written = serde_json::to_string(of).unwrap();
        assert_eq!(serde_json::to_string(&again(of)).unwrap(), written);
    }
    let mut scene = bearing();
    // Contacts without load have no angle.
    let contacts = ContactsProbe::of_row(0);
    scene.probes.insert("c".to_owned(), contacts.into());
    let slices = SlicesProbe::at([0.5e-3]);
    scene.probes.insert("s".to_owned(), slices.into());
    let out = simulate(&scene, &short()).unwrap();
    let without = |name: &str| out.get(name).unwrap().iter().any(|x| x.is_nan());
    assert!(without("c.ball2.inner.angle") && !out.slices.is_empty());
    keeps(&out);
    let same = again(&out);
    assert_eq!((&same.scene, &same.stats), (&out.scene, &out.stats));
    assert_eq!(same.get("outer.ay"), out.get("outer.ay"));
    assert!(same.get("c.ball2.inner.angle").unwrap()[0].is_nan());
    assert_eq!(same.provenance, out.provenance);
    let mut taken = None;
    let mut sink = |block: Block| {
        taken = Some(block);
        ControlFlow::Continue(())
    };
    simulate_into(&scene, &short(), &mut sink, &mut |_| {
        ControlFlow::Continue(())
    })
    .unwrap();
    keeps(&taken.unwrap());
    let features = ballrace::features(&out, &FeatureOptions::default()).unwrap();
    assert_eq!(again(&features), features);

    let found = equilibrium(&bearing()).unwrap();
    assert_eq!(again(&found), found);
    let found = stiffness(&bearing()).unwrap();
    assert_eq!(again(&found), found);
    let found = load_distribution(&bearing(), 2).unwrap();
    assert_eq!(again(&found), found);
    let found = ballrace::dynamic_coefficients(&bearing(), 1).unwrap();
    assert_eq!(again(&found), found);
    let found = ballrace::axis_held(&bearing()).unwrap();
    assert_eq!(again(&found), found);
    let case = Case::new(bearing(), short());
    assert_eq!(again(&case), case);

    let model = compile(&bearing()).unwrap();
    let state = start(&model, &Start::Equilibrium).unwrap();
    for ball in 0..8 {
        keeps(&inspect::contact(&model, &state, ball, Race::Inner).unwrap());
    }
    keeps(&inspect::lubrication(&model, &state, 0).unwrap());
    keeps(&inspect::energy(&model, &state).unwrap());
    let rates = ballrace::fault_frequencies(&bearing(), 0).unwrap();
    assert_eq!(again(&rates), rates);
}

/// Options are written with what they have in later versions too.
#[test]
fn options_are_written_with_the_rest_by_default() {
    let run = Run {
        duration: 1e-3,
        ..Default::default()
    };
    let options = FeatureOptions {
        skip: 0.5e-3,
        ..Default::default()
    };
    let out = simulate(&bearing(), &run).unwrap();
    assert!(!ballrace::features(&out, &options).unwrap().is_empty());
    let steps = ballrace::integrate::Options {
        max_step: 1e-5,
        ..Default::default()
    };
    assert!(steps.max_step < ballrace::integrate::Options::default().max_step);
}
