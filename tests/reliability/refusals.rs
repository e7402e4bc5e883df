//! What cannot be computed is refused by an error that names it: no call panics for a value that a program can give it.

use ballrace::scene::{
    ContactsProbe, Drive, Load, Probe, Profile, RaceProfile, RingName, Scene, SlicesProbe,
    TableForce, TimeFunction, Width, WidthProfile, presets,
};
use ballrace::{
    Error, FeatureOptions, Run, equilibrium, explain, feature_columns, features, load_distribution,
    signal_features, simulate, stiffness,
};

fn short() -> Run {
    Run {
        duration: 1e-4,
        settle: Some(0.0),
        ..Run::default()
    }
}

fn table(times: &[f64], values: &[f64]) -> TimeFunction {
    TimeFunction::Profile(Profile::Table {
        times: times.to_vec(),
        values: values.to_vec(),
    })
}

/// A change of a scene that is to be refused.
type Change = Box<dyn Fn(&mut Scene)>;

fn probe(probe: Probe) -> Change {
    Box::new(move |scene| {
        scene.probes.insert("p".to_owned(), probe.clone());
    })
}

fn probes_of_absent_rows() -> Vec<(&'static str, Change)> {
    let slices = |row| SlicesProbe::at([0.0]).in_row(row).into();
    let mut cases = Vec::new();
    for row in [2, usize::MAX] {
        cases.push(("probes.p.cage.row", probe(Probe::cage(row))));
        let oil = Probe::lubrication(row);
        cases.push(("probes.p.lubrication.row", probe(oil)));
        cases.push((
            "probes.p.contacts.row",
            probe(ContactsProbe::of_row(row).into()),
        ));
        cases.push(("probes.p.slices.row", probe(slices(row))));
    }
    let balls = probe(ContactsProbe::of_row(0).balls([usize::MAX]).into());
    cases.push(("probes.p.contacts.balls", balls));
    cases
}

fn tables() -> Vec<(&'static str, Change)> {
    let mut cases: Vec<(&'static str, Change)> = Vec::new();
    for (times, values) in [
        (&[][..], &[][..]),
        (&[0.0, 1.0], &[1.0]),
        (&[], &[1.0]),
        (&[1.0, 0.0], &[1.0, 2.0]),
        (&[0.0, f64::NAN], &[1.0, 2.0]),
    ] {
        let function = table(times, values);
        let load = function.clone();
        cases.push((
            "loads.p.force",
            Box::new(move |scene| {
                let load = Load::new(RingName::Outer, [0.0, 1.0, 0.0], load.clone());
                scene.loads.insert("p".to_owned(), load);
            }),
        ));
        cases.push((
            "drive.speed",
            Box::new(move |scene| scene.drive = Drive::Speed(function.clone())),
        ));
        let [places, forces] = [times, values].map(<[f64]>::to_vec);
        cases.push((
            "table_forces.p",
            Box::new(move |scene| {
                let (places, forces) = (places.clone(), forces.clone());
                let force = TableForce::new(RingName::Outer, [0.0, 1.0, 0.0], places, forces);
                scene.table_forces.insert("p".to_owned(), force);
            }),
        ));
        let [z, r] = [times, values].map(<[f64]>::to_vec);
        cases.push((
            "rows[0].outer_profile",
            Box::new(move |scene| {
                let profile = RaceProfile::new(z.clone(), r.clone());
                scene.rows[0].outer_profile = Some(profile);
            }),
        ));
    }
    cases
}

fn counts() -> Vec<(&'static str, Change)> {
    let huge: Change = Box::new(|scene| scene.rows[0].ball_count = usize::MAX);
    let none: Change = Box::new(|scene| scene.rows.clear());
    let many: Change = Box::new(|scene| scene.rows = vec![scene.rows[0].clone(); 17]);
    vec![("rows[0].ball_count", huge), ("rows", none), ("rows", many)]
}

#[test]
fn scenes_are_refused_by_the_field() {
    for (field, change) in probes_of_absent_rows()
        .into_iter()
        .chain(tables())
        .chain(counts())
    {
        let mut scene = presets::wheel_bearing(3000.0);
        change(&mut scene);
        let x = vec![0.5; 100];
        let options = FeatureOptions::default();
        let errors = [
            simulate(&scene, &short()).err(),
            explain(&scene).err(),
            equilibrium(&scene).err(),
            stiffness(&scene).err(),
            load_distribution(&scene, 2).err(),
            feature_columns(&scene, &options).err(),
        ];
        // Features of a signal ask for the numbers of balls and for speeds alone.
        let asked = ["rows[0].ball_count", "drive.speed"].contains(&field);
        let features = asked.then(|| signal_features(&x, 1e3, "x", Some(&scene), &options).err());
        for (call, error) in errors.into_iter().chain(features).enumerate() {
            match error {
                Some(Error::Scene { path, .. }) if path.starts_with(field) => {}
                other => panic!("{field}, call {call}: {other:?}"),
            }
        }
        assert!(scene.doubts().is_empty(), "{field}");
    }
}

/// Values of tables that have none are no numbers, and no panics.
#[test]
fn tables_without_a_value_are_no_numbers() {
    let empty = table(&[], &[]);
    assert!(empty.at(0.0).is_nan() && empty.rate(0.0) == 0.0);
    assert!(table(&[0.0, 1.0], &[1.0]).at(0.5).is_nan());
    assert!(table(&[0.0, 1.0], &[1.0]).rate(0.5).is_nan());
    let width = Width::from(WidthProfile::new(vec![0.0, 1.0], vec![1.0]));
    assert!(width.at(0.5).0.is_nan() && width.at(2.0).0.is_nan());
}

#[test]
fn signals_and_rates_are_refused() {
    let refused = |field: &str, found: Result<_, Error>| match found {
        Err(Error::Argument { path, .. }) => assert_eq!(path, field),
        Err(Error::Scene { path, .. }) if field == "rows" => assert_eq!(path, field),
        other => panic!("{field}: {other:?}"),
    };
    let options = FeatureOptions::default();
    for fs in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused("fs", signal_features(&[1.0; 9], fs, "x", None, &options));
    }
    refused("skip", signal_features(&[], 1e3, "x", None, &options));
    let out = simulate(&presets::wheel_bearing(3000.0), &short()).unwrap();
    let mut rate = out.clone();
    rate.fs = 0.0;
    refused("fs", features(&rate, &options));
    let mut unequal = out.clone();
    unequal.columns[1].values.pop();
    refused(
        &unequal.columns[1].name.clone(),
        features(&unequal, &options),
    );
    let mut scene = out;
    scene.scene.rows.clear();
    refused("rows", features(&scene, &options));
}
