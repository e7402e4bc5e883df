//! What must hold of every outcome: success with finite numbers, or one typed error that says where and what is allowed.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use ballrace::{Column, Error, FeatureOptions, Result, Run, Signals, features};
use serde_json::Value;

use crate::bases;

/// Ends of columns that are not a number where a contact bears nothing, and of what it bears.
const OF_CONTACTS: [&str; 3] = [".angle", ".zone_centre", ".slip"];
const LOAD: &str = ".load";
/// Ends of columns that are not a number where nothing is lubricated.
const OF_FILMS: [&str; 2] = [".film", ".lambda"];

/// Arguments and documents that an error may name beside the fields of a scene and of a run.
const ARGUMENTS: [&str; 6] = ["scene", "run", "columns", "skip", "band", "contact_loads"];

/// What a call gives, if it gives anything; an error must say what it is to say.
pub fn decided<T>(outcome: Result<T>) -> Option<T> {
    outcome.inspect_err(check_message).ok()
}

/// As [`decided`], of a call whose documents have no names of their own but known ones: an error of a field names one.
pub fn of_a_scene<T>(outcome: Result<T>) -> Option<T> {
    if let Err(error) = &outcome {
        let text = error.to_string();
        let of_rust = ["Some(", "None", "NaN"]
            .iter()
            .find(|word| text.contains(**word));
        assert!(of_rust.is_none(), "{text}");
    }
    if let Err(Error::Scene { path, .. } | Error::Argument { path, .. }) = &outcome {
        let first = path.split(['.', '[']).next().unwrap_or_default();
        assert!(known().contains(first), "no field: {path}");
    }
    decided(outcome)
}

/// Checks that an error says something, and where.
fn check_message(error: &Error) {
    let text = error.to_string();
    assert!(!text.trim().is_empty());
    match error {
        Error::Scene { path, allowed, .. } | Error::Argument { path, allowed, .. } => {
            assert!(!path.is_empty(), "no field: {text}");
            assert!(!allowed.is_empty(), "nothing is allowed: {text}");
        }
        Error::Integration {
            time, step, reason, ..
        } => {
            assert!(time.is_finite() && step.is_finite(), "{text}");
            assert!(!reason.is_empty(), "{text}");
        }
        Error::Equilibrium { reason, .. } => assert!(!reason.is_empty(), "{text}"),
        Error::Memory {
            needed, available, ..
        } => assert!(needed > available, "{text}"),
        Error::Interrupted { .. } | Error::Budget { .. } => {}
        other => panic!("{other}"),
    }
}

/// First names of what an error may name.
fn known() -> &'static BTreeSet<String> {
    static KNOWN: OnceLock<BTreeSet<String>> = OnceLock::new();
    KNOWN.get_or_init(|| {
        let run: Value = serde_json::from_str(&Run::default().to_json()).expect("a document");
        let scenes = bases::all().iter().map(|base| &base.document);
        let documents = scenes.chain([&run]).filter_map(Value::as_object);
        let names = documents.flat_map(|document| document.keys().cloned());
        names.chain(ARGUMENTS.map(str::to_owned)).collect()
    })
}

/// Checks that signals, and the features of them, are numbers, but where a column says when it is none.
pub fn finite(out: &Signals) {
    all_finite("t", &out.t);
    for column in &out.columns {
        assert_eq!(column.values.len(), out.t.len(), "{}", column.name);
        let ends =
            |ends: &[&'static str]| ends.iter().find_map(|end| column.name.strip_suffix(end));
        if let Some(contact) = ends(&OF_CONTACTS) {
            finite_under_load(column, out.get(&format!("{contact}{LOAD}")));
        } else if ends(&OF_FILMS).is_none() {
            all_finite(&column.name, &column.values);
        }
    }
    for row in &out.slices {
        all_finite(
            "slices",
            &[
                row.time,
                row.zeta,
                row.z,
                row.width,
                row.penetration,
                row.force,
            ],
        );
    }
    let stats = &out.stats;
    all_finite(
        "stats",
        &[
            stats.largest_step,
            stats.largest_pressure,
            stats.film_slip,
            stats.largest_tilt,
        ],
    );
    for warning in out.warnings() {
        assert!(!warning.to_string().contains("NaN"), "{warning}");
    }
    if let Some(accuracy) = &out.provenance.accuracy {
        let node_error = accuracy.node_error.unwrap_or_default();
        all_finite("accuracy", &[accuracy.integration_error, node_error]);
    }
    if let Some(found) = decided(features(out, &FeatureOptions::default())) {
        all_finite(
            "features",
            &found
                .iter()
                .filter_map(|feature| feature.value)
                .collect::<Vec<_>>(),
        );
    }
}

fn finite_under_load(column: &Column, loads: Option<&[f64]>) {
    for (value, load) in column.values.iter().zip(loads.unwrap_or_default()) {
        assert!(
            value.is_finite() || *load == 0.0,
            "{} is {value} under {load} N",
            column.name
        );
    }
}

fn all_finite(name: &str, values: &[f64]) {
    if let Some(at) = values.iter().position(|value| !value.is_finite()) {
        panic!("{name}[{at}] is {}", values[at]);
    }
}
