//! What a sweep file asks of the crate: its scene, its arguments, and cases with fields replaced by their paths. The Python
//! package builds tables of other kinds; here the ends of their columns are taken.

use std::ops::ControlFlow;

use ballrace::{Case, FeatureOptions, Run, Scene, campaign};
use serde_json::{Map, Value};

use crate::bases;
use crate::check::{decided, finite};

/// Cases of a sweep that are run, and columns that are crossed.
const CASES: usize = 4;
const COLUMNS: usize = 6;
/// Longest run \[s\], and its steps.
const DURATION: f64 = 1e-4;
const STEPS: u64 = 400;

const OPTIONS: [&str; 4] = ["columns", "skip", "band", "contact_loads"];
const NOT_OF_A_RUN: [&str; 9] = [
    "scene",
    "scenes",
    "table",
    "grid",
    "latin_hypercube",
    "sobol",
    "scatter",
    "keep",
    "threads",
];

/// Reads a sweep, and runs some of its cases.
pub fn check(text: &str) {
    let Ok(Value::Object(sweep)) = toml::from_str::<Value>(text) else {
        return;
    };
    let Some(base) = scene(&sweep) else { return };
    let run = |name: &str| !OPTIONS.contains(&name) && !NOT_OF_A_RUN.contains(&name);
    let Some(run) = decided(Run::from_json(&part(&sweep, run).to_string())) else {
        return;
    };
    let options = part(&sweep, |name| OPTIONS.contains(&name));
    let Ok(options) = serde_json::from_value::<FeatureOptions>(options) else {
        return;
    };
    let run = short(run);
    let rows = rows(&sweep);
    let cases = rows.iter().filter_map(|row| decided(base.with(row)));
    let run_of = |scene: Scene| Case::new(scene, run.clone());
    outcomes(cases.map(run_of).collect(), &options);
}

/// The preset that a sweep names, or the first of several.
fn scene(sweep: &Map<String, Value>) -> Option<&'static Scene> {
    let named = sweep.get("scenes").and_then(Value::as_object);
    let name = sweep.get("scene").or_else(|| named?.values().next())?;
    let base = bases::named(&name.as_str()?.replace('_', "-"))?;
    Some(&base.scene)
}

fn part(sweep: &Map<String, Value>, wanted: impl Fn(&str) -> bool) -> Value {
    let entries = sweep.iter().filter(|(name, _)| wanted(name));
    Value::Object(
        entries
            .map(|(name, value)| (name.clone(), value.clone()))
            .collect(),
    )
}

fn short(run: Run) -> Run {
    Run {
        duration: run.duration.min(DURATION),
        max_steps: Some(STEPS as usize),
        time_limit: Some(3.0),
        ..run
    }
}

/// Cases of all columns, crossed: each as what it replaces.
fn rows(sweep: &Map<String, Value>) -> Vec<Vec<(&str, Value)>> {
    let builders = ["grid", "latin_hypercube", "sobol"];
    let tables = builders
        .iter()
        .filter_map(|name| sweep.get(*name)?.as_object());
    let columns = tables.flat_map(|table| {
        table
            .iter()
            .filter(|(name, _)| *name != "n" && *name != "seed")
    });
    let mut rows = vec![Vec::new()];
    for (path, values) in columns.take(COLUMNS) {
        let values = values_of(values);
        let crossed = rows.iter().flat_map(|row: &Vec<(&str, Value)>| {
            values.iter().map(move |value| {
                let mut row = row.clone();
                row.push((path.as_str(), value.clone()));
                row
            })
        });
        rows = crossed.take(CASES).collect();
    }
    rows
}

/// The values of a column: a list, or the ends of one that is given by them.
fn values_of(column: &Value) -> Vec<Value> {
    match column {
        Value::Array(values) => values.clone(),
        Value::Object(ends) => ["from", "to"]
            .iter()
            .filter_map(|end| ends.get(*end).cloned())
            .collect(),
        other => vec![other.clone()],
    }
}

fn outcomes(cases: Vec<Case>, options: &FeatureOptions) {
    let count = cases.len();
    let watch = &mut |_| ControlFlow::Continue(());
    let Some(outcomes) = decided(campaign(cases, 1, options, watch)) else {
        return;
    };
    assert_eq!(outcomes.len(), count);
    for (index, outcome) in outcomes.into_iter().enumerate() {
        assert_eq!(outcome.index, index);
        let Some(finished) = decided(outcome.result) else {
            continue;
        };
        finite(&finished.signals);
        for feature in finished.features {
            assert!(feature.value.is_none_or(f64::is_finite), "{feature:?}");
        }
    }
}
