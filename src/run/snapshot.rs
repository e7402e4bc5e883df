//! Everything that a paused run needs to go on, in this process or another.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::Run;
use super::prepare::Prepared;
use super::settle::Settled;
use crate::base::error::{Error, Result};
use crate::model::Placed;
use crate::scene::{Scene, TimeFunction};
use crate::signals::{Accuracy, Statistics};

/// A [`Simulation`](crate::Simulation) at a time: what it needs to go on from there, bit by bit.
///
/// As a document ([`Snapshot::to_json`]) it goes on in another process of the same version; forces by code of a program's own
/// ([`Scene::ring_forces`]) cannot be read again.
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
    /// [`Error::Scene`] where it is none, or of another version.
    pub fn from_json(text: &str) -> Result<Self> {
        let refused = |reason: String| Error::scene("snapshot", "another document", reason);
        let document: Value = serde_json::from_str(text).map_err(|e| refused(e.to_string()))?;
        check(document["version"].as_str().unwrap_or("unknown"))?;
        serde_json::from_value(document).map_err(|e| refused(e.to_string()))
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

/// Refuses what another version has written, whose motion would not go on as it was.
fn check(version: &str) -> Result<()> {
    let here = env!("CARGO_PKG_VERSION");
    if version == here {
        return Ok(());
    }
    let allowed = format!("{here}, the version that restores it");
    Err(Error::scene("snapshot.version", version, allowed))
}
