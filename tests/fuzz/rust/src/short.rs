//! One short run of a scene with some places changed.

use std::fmt;

use arbitrary::{Arbitrary, Result, Unstructured};
use ballrace::{Error, Run, Scene, Signals, simulate};
use serde_json::{Value, json};

use crate::bases;
use crate::changes::change;
use crate::check::{finite, of_a_scene};

/// Steps that a run may take, and wall time \[s\].
const STEPS: usize = 400;
const TIME: f64 = 3.0;

/// A scene and a run as documents.
pub struct Short {
    document: Value,
    run: Value,
}

/// Both as JSON, to be kept where they are found to go wrong.
impl fmt::Debug for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n{}", self.document, self.run)
    }
}

impl<'a> Arbitrary<'a> for Short {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let bases = bases::all();
        let base = &bases[usize::from(u.arbitrary::<u8>()?) % bases.len()];
        let run = some_run(u)?;
        let mut document = base.document.clone();
        for _ in 0..u.arbitrary::<u8>()? % 6 {
            change(u, &mut document)?;
        }
        Ok(Self { document, run })
    }
}

/// Arguments of a run of a few samples. A byte each, so that a change of one is a change of one.
fn some_run(u: &mut Unstructured<'_>) -> Result<Value> {
    fn one<T: Clone>(u: &mut Unstructured<'_>, of: &[T]) -> Result<T> {
        Ok(of[usize::from(u.arbitrary::<u8>()?) % of.len()].clone())
    }
    let method = one(u, methods())?;
    let fs = one(u, &[1e6, 1e5, 1e7, 2e4])?;
    let samples = 1 + u.arbitrary::<u8>()? % 30;
    let start = one(u, &starts())?;
    let settle = one(u, &[json!(0.0), json!(1e-5), Value::Null])?;
    let rtol = one(u, &[Value::Null, json!(1e-3), json!(1e-12), json!(0.1)])?;
    let bandwidth = one(u, &[Value::Null, json!("auto")])?;
    let threads = one(u, &[1, 1, 1, 2])?;
    let mut run = json!({
        "duration": f64::from(samples) / fs, "fs": fs, "start": start, "settle": settle, "method": method, "rtol": rtol,
        "bandwidth": bandwidth, "threads": threads, "max_steps": STEPS, "time_limit": TIME,
    });
    if one(u, &[false, false, false, false, false, false, false, true])? {
        run["rtol"] = Value::Null;
        run["accuracy"] = json!(1e-2);
    }
    Ok(run)
}

/// Mostly those of which a scene makes the state.
fn starts() -> [Value; 8] {
    let [rolling, rest] = ["rolling", "equilibrium"].map(Value::from);
    let mut starts = std::array::from_fn(|i| {
        if i % 2 == 0 {
            rolling.clone()
        } else {
            rest.clone()
        }
    });
    starts[7] = json!([0.0]);
    starts
}

/// Names of the methods, as the crate's message lists them, and none.
fn methods() -> &'static [Option<String>] {
    static METHODS: std::sync::OnceLock<Vec<Option<String>>> = std::sync::OnceLock::new();
    METHODS.get_or_init(|| {
        let allowed = match Run::from_json(r#"{"method": "?"}"#) {
            Err(Error::Argument { allowed, .. }) => allowed,
            other => panic!("{other:?}"),
        };
        let names = allowed.split('`').skip(3).step_by(2);
        let names = names.map(|name| Some(name.to_owned()));
        std::iter::once(None).chain(names).collect()
    })
}

impl Short {
    /// Runs it, if the scene is one.
    pub fn check(&self) {
        let Some(scene) = of_a_scene(Scene::from_json(&self.document.to_string())) else {
            return;
        };
        let Some(run) = of_a_scene(Run::from_json(&self.run.to_string())) else {
            return;
        };
        let outcome = simulate(&scene, &run);
        self.names_what_was_given(&outcome);
        if let Some(out) = of_a_scene(outcome) {
            finite(&out);
        }
    }

    /// Checks that a number of the run that is refused is the one that was given.
    fn names_what_was_given(&self, outcome: &ballrace::Result<Signals>) {
        let Err(Error::Argument { path, value, .. }) = outcome else {
            return;
        };
        if let Some(given) = self.run.get(path).and_then(Value::as_f64) {
            let refused = value.parse::<f64>().ok();
            assert!(
                refused.is_some_and(|refused| (refused - given).abs() <= 1e-12 * given.abs()),
                "{outcome:?}"
            );
        }
    }
}
