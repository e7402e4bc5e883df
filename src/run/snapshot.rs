//! Everything that a paused run needs to go on, in this process or another.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::Run;
use super::prepare::Prepared;
use super::settle::Settled;
use crate::base::error::{Error, Result};
use crate::model::Placed;
use crate::scene::{RingForces, Scene, TimeFunction};
use crate::signals::{Accuracy, Statistics};

/// A [`Simulation`](crate::Simulation) at a time: what it needs to go on from there, bit by bit.
///
/// As a document ([`Snapshot::to_json`]) it goes on in another process of the same version. Of forces by code of a program's own
/// ([`Scene::ring_forces`]) it has the names; [`Snapshot::from_json_with`] takes the code.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Snapshot {
    version: String,
    time: f64,
    scene: Scene,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    compiled_with: BTreeMap<String, TimeFunction>,
    run: Run,
    placed: BTreeMap<String, Placed>,
    settled: Settled,
    accuracy: Option<Accuracy>,
    remembered: Remembrance,
}

/// Memory of a run between its pieces.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Remembrance {
    /// The motion and what is recorded of it, as words.
    pub trajectory: Vec<u64>,
    pub recorder: Vec<u64>,
    /// Points a sample at which filtered signals are read.
    pub oversampling: usize,
    /// Statistics of the run before its scene was changed.
    pub earlier: Option<Statistics>,
}

impl Snapshot {
    pub(super) fn new(time: f64, run: &Run, prepared: &Prepared, remembered: Remembrance) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            time,
            scene: prepared.scene.clone(),
            compiled_with: prepared.compiled_with.clone(),
            run: run.clone(),
            placed: prepared.placed.clone(),
            settled: prepared.settled.clone(),
            accuracy: prepared.accuracy,
            remembered,
        }
    }

    /// Reads one from JSON.
    ///
    /// # Errors
    /// [`Error::Snapshot`] where it is none, of another version, or of a scene with [`Scene::ring_forces`].
    pub fn from_json(text: &str) -> Result<Self> {
        Self::from_json_with(text, RingForces::default())
    }

    /// Reads one from JSON whose scene has forces by code of the program's own: they act again by their names.
    ///
    /// # Errors
    /// As [`Self::from_json`]; [`Error::Snapshot`] also where the names are not those of the scene.
    pub fn from_json_with(text: &str, forces: RingForces) -> Result<Self> {
        let refused = |reason: String| refused_at("snapshot", "another document", reason);
        let mut document: Value = serde_json::from_str(text).map_err(|e| refused(e.to_string()))?;
        check(document["version"].as_str().unwrap_or("unknown"))?;
        let scene = document.get_mut("scene").and_then(Value::as_object_mut);
        let named = scene.and_then(|scene| scene.remove("ring_forces"));
        check_names(named.as_ref(), &forces)?;
        let mut read: Self =
            serde_json::from_value(document).map_err(|e| refused(e.to_string()))?;
        read.scene.ring_forces = forces;
        Ok(read)
    }

    /// JSON of the snapshot on one line.
    ///
    /// # Panics
    /// Never: every snapshot has a JSON form.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("a snapshot is a JSON document")
    }

    /// The time \[s\].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The scene, as it was then.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The run.
    pub fn run(&self) -> &Run {
        &self.run
    }

    pub(super) fn prepared(&self) -> Prepared {
        Prepared {
            scene: self.scene.clone(),
            compiled_with: self.compiled_with.clone(),
            placed: self.placed.clone(),
            settled: self.settled.clone(),
            accuracy: self.accuracy,
        }
    }

    pub(super) fn remembered(&self) -> &Remembrance {
        &self.remembered
    }
}

/// Refuses forces that are not those of the document.
fn check_names(named: Option<&Value>, forces: &RingForces) -> Result<()> {
    let of_scene = named.and_then(Value::as_array).into_iter().flatten();
    let of_scene: Vec<&str> = of_scene.filter_map(Value::as_str).collect();
    let given: Vec<&str> = forces.iter().map(|(name, _)| name).collect();
    if of_scene == given {
        return Ok(());
    }
    let list = |names: &[&str]| match names {
        [] => "none".to_owned(),
        _ => names.join(", "),
    };
    let allowed = format!(
        "the forces of the snapshot's scene ({}), given to Snapshot::from_json_with",
        list(&of_scene)
    );
    let path = "snapshot.scene.ring_forces";
    Err(refused_at(path, &list(&given), allowed))
}

/// Refuses what another version has written, whose motion would not go on as it was.
fn check(version: &str) -> Result<()> {
    let here = env!("CARGO_PKG_VERSION");
    if version == here {
        return Ok(());
    }
    let allowed = format!("{here}, the version that restores it");
    Err(refused_at("snapshot.version", version, allowed))
}

pub(super) fn refused_at(path: &str, value: &str, allowed: String) -> Error {
    Error::Snapshot {
        path: path.to_owned(),
        value: value.to_owned(),
        allowed,
    }
}
