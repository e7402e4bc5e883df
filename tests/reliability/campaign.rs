//! Campaigns in one process: order, bits, failures, stopping.

use std::ops::ControlFlow;

use ballrace::scene::presets;
use ballrace::{
    Bandwidth, Case, Error, FeatureOptions, Outcome, Run, Start, campaign, feature_columns,
    simulate, stream,
};

fn run(duration: f64) -> Run {
    Run {
        duration,
        start: Start::Rolling,
        ..Run::default()
    }
}

/// Loads from 0 to 1400 N; the last bearing does not exist.
fn cases() -> Vec<Case> {
    (0..8)
        .map(|i| {
            let mut scene = presets::deep_groove_6205(200.0 * f64::from(i), 0.0, 1800.0);
            if i == 7 {
                scene.rows[0].ball_diameter = -1.0;
            }
            // Of different length, so that they do not finish in their order.
            Case::new(scene, run(1e-3 * f64::from(8 - i)))
        })
        .collect()
}

fn outcomes(threads: usize) -> Vec<Outcome> {
    let options = FeatureOptions {
        contact_loads: true,
        ..FeatureOptions::default()
    };
    campaign(cases(), threads, &options, &mut |_| {
        ControlFlow::Continue(())
    })
    .unwrap()
}

/// Names and bits of all features.
fn bits(outcome: &Outcome) -> Option<Vec<(&str, Option<u64>)>> {
    let finished = outcome.result.as_ref().ok()?;
    let features = finished.features.iter();
    Some(
        features
            .map(|f| (f.name.as_str(), f.value.map(f64::to_bits)))
            .collect(),
    )
}

/// Analytic: a case runs alone on one thread, so its bits are those of a run by itself.
#[test]
fn threads_do_not_change_a_bit() {
    let (one, three) = (outcomes(1), outcomes(3));
    for (i, (a, b)) in one.iter().zip(&three).enumerate() {
        assert_eq!((a.index, b.index), (i, i));
        assert_eq!(bits(a), bits(b));
    }
    let case = &cases()[0];
    let alone = simulate(&case.scene, &case.run).unwrap();
    let among = &three[0].result.as_ref().unwrap().signals;
    assert_eq!(alone.columns, among.columns);
    assert_eq!(alone.scene, among.scene);
}

/// A bearing that cannot be is an outcome with the error of its own, and costs no other.
#[test]
fn a_failed_case_is_an_outcome() {
    let found = outcomes(2);
    assert!(found[..7].iter().all(|o| o.result.is_ok()));
    match &found[7].result {
        Err(Error::Scene { path, .. }) => assert_eq!(path, "rows[0].ball_diameter"),
        other => panic!("{other:?}"),
    }
}

/// Analytic: the features of a signal are those of its samples, after what is to be skipped.
#[test]
fn features_are_those_of_the_signal() {
    let options = FeatureOptions {
        columns: Some(vec!["outer.ay".to_owned()]),
        skip: 2e-3,
        ..FeatureOptions::default()
    };
    let found = campaign(cases().drain(1..2), 1, &options, &mut |_| {
        ControlFlow::Continue(())
    })
    .unwrap();
    let finished = found[0].result.as_ref().unwrap();
    let signal = &finished.signals.get("outer.ay").unwrap()[100..];
    let value = |name: &str| {
        let feature = finished.features.iter().find(|f| f.name == name);
        feature.unwrap_or_else(|| panic!("no {name}")).value
    };
    let peak = signal.iter().fold(0.0_f64, |p, x| p.max(x.abs()));
    assert_eq!(value("outer.ay.peak"), Some(peak));
    let rms = (signal.iter().map(|x| x * x).sum::<f64>() / signal.len() as f64).sqrt();
    let found = value("outer.ay.rms").unwrap();
    assert!((found / rms - 1.0).abs() < 1e-14, "{found} {rms}");
    assert!(
        finished
            .features
            .iter()
            .all(|f| !f.name.starts_with("outer.ax"))
    );
    // 5 ms know nothing of 15 Hz.
    assert_eq!(value("outer.ay.row0.ftf"), None);
}

/// Analytic: Stribeck's law for a deep-groove bearing under radial load, F_max = 4.37 F_r / Z without clearance
/// (A. Palmgren); the heaviest ball passes near the middle of the zone, and others are free.
#[test]
fn contact_loads_have_their_extremes() {
    let scene = presets::deep_groove_6205(2000.0, 0.0, 1800.0);
    let balls = f64::from(u32::try_from(scene.rows[0].ball_count).unwrap());
    let run = Run {
        duration: 0.01,
        settle: Some(0.0),
        ..Run::default()
    };
    let options = FeatureOptions {
        contact_loads: true,
        ..FeatureOptions::default()
    };
    let found = campaign([Case::new(scene, run)], 1, &options, &mut |_| {
        ControlFlow::Continue(())
    })
    .unwrap();
    let features = &found[0].result.as_ref().unwrap().features;
    let value = |name: &str| {
        features
            .iter()
            .find(|f| f.name == name)
            .unwrap()
            .value
            .unwrap()
    };
    let stribeck = 4.37 * 2000.0 / balls;
    let ratio = value("row0.inner.load_max") / stribeck;
    assert!((0.9..1.25).contains(&ratio), "{ratio}");
    assert_eq!(value("row0.inner.load_min"), 0.0);
    // Analytic: Hertz's 2.39 GPa under Stribeck's 971 N on the inner race, and a little more with a clearance.
    let stats = &found[0].result.as_ref().unwrap().signals.stats;
    assert_eq!(value("largest_pressure"), stats.largest_pressure);
    assert!((2.39..2.5).contains(&(1e-9 * stats.largest_pressure)));
    // The columns that were read for it are not left behind.
    let signals = &found[0].result.as_ref().unwrap().signals;
    assert!(signals.columns.iter().all(|c| !c.name.contains("load")));
}

/// An option that no run can meet is refused before time is spent.
#[test]
fn options_are_checked() {
    let refused = |options: FeatureOptions| {
        let found = campaign(cases().drain(..1), 1, &options, &mut |_| {
            ControlFlow::Continue(())
        });
        match &found.unwrap()[0].result {
            Err(Error::Argument { path, .. }) => path.clone(),
            other => panic!("{other:?}"),
        }
    };
    let options = FeatureOptions::default;
    assert_eq!(
        refused(FeatureOptions {
            skip: 1.0,
            ..options()
        }),
        "skip"
    );
    let band = Some([100.0, 1e9]);
    assert_eq!(refused(FeatureOptions { band, ..options() }), "band");
    let columns = Some(vec!["outer.az".to_owned(), "outer.by".to_owned()]);
    assert_eq!(
        refused(FeatureOptions {
            columns,
            ..options()
        }),
        "columns"
    );
    let scene = &cases()[0].scene;
    let found = feature_columns(scene, &options()).unwrap();
    assert!(found.contains(&"outer.ay".to_owned()) && !found.contains(&"outer.y".to_owned()));
    let many = campaign(
        cases(),
        5000,
        &options(),
        &mut |_| ControlFlow::Continue(()),
    );
    assert!(matches!(many, Err(Error::Argument { path, .. }) if path == "threads"));
}

/// A stop ends what runs, pulls no further cases, and reports only what has finished: were the long cases not stopped, this would
/// take hours.
#[test]
fn a_stop_ends_the_work() {
    let mut pulled = 0;
    let endless = std::iter::from_fn(|| {
        pulled += 1;
        // Every second one would run for hours.
        let duration = if pulled % 2 == 0 { 1e4 } else { 1e-3 };
        let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        let mut run = run(duration);
        run.fs = 2.0 / duration;
        run.bandwidth = Bandwidth::Raw;
        Some(Case::new(scene, run))
    });
    let mut seen = Vec::new();
    let options = FeatureOptions::default();
    stream(endless, 2, &options, &mut |done| {
        seen.extend(done);
        if seen.is_empty() {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    })
    .unwrap();
    assert!(pulled <= 6, "{pulled}");
    assert!(!seen.is_empty() && seen.iter().all(|o| o.index % 2 == 0 && o.result.is_ok()));
}

/// A number of steps ends a run where it has taken them, on any machine; one that it does not need changes nothing.
#[test]
fn a_budget_of_steps_is_an_outcome() {
    let case = |max_steps| {
        let run = Run {
            max_steps,
            ..run(2e-3)
        };
        Case::new(presets::deep_groove_6205(500.0, 0.0, 1800.0), run)
    };
    let cases = [
        case(None),
        case(Some(30)),
        case(Some(30)),
        case(Some(1_000_000)),
    ];
    let options = FeatureOptions::default();
    let found = campaign(cases, 2, &options, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(bits(&found[0]), bits(&found[3]));
    match (&found[1].result, &found[2].result) {
        (
            Err(Error::Budget {
                time, name, limit, ..
            }),
            Err(again),
        ) => {
            assert!(*time > 0.0 && *time < 2e-3);
            assert_eq!((*name, *limit), ("max_steps", 30.0));
            assert_eq!(found[1].result.as_ref().err(), Some(again));
        }
        other => panic!("{other:?}"),
    }
}
