//! The options of a run: one document, which Rust, Python and the command line share.

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::base::error::{Error, Result};
use crate::scene::{Method, interpret};
use crate::signals::Bandwidth;
use crate::statics::start::Start;

/// The options of a run. In a document `start` is `"equilibrium"`, `"rolling"` or the list of a state's numbers, and
/// `bandwidth` is `"auto"` or, for point samples, `null`; absent fields have their defaults, and other fields are refused.
///
/// ```
/// let run = ballrace::Run::from_json(r#"{"duration": 0.5, "method": "verner"}"#)?;
/// assert_eq!((run.duration, run.fs), (0.5, 50e3));
/// assert_eq!(ballrace::Run::from_json(&run.to_json())?, run);
/// # Ok::<(), ballrace::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Run {
    /// Simulated time \[s\]. Default 0.1.
    pub duration: f64,
    /// Sampling rate \[Hz\]. Default 50 000.
    pub fs: f64,
    /// State at the start. Default equilibrium.
    #[serde(with = "starts")]
    pub start: Start,
    /// Relative tolerance; absent: the scene's, by default that which the band of the record asks for.
    pub rtol: Option<f64>,
    /// Relative error of accelerations that is aimed at, 1e-4 to 1e-1: nodes, tolerance and step cap are chosen for it by
    /// pilot runs of the first 3 ms; absent: those of the scene. See [`crate::Accuracy`].
    pub accuracy: Option<f64>,
    /// Method; absent: the scene's.
    pub method: Option<Method>,
    /// Threads that share the balls of one evaluation. Default 0: as many as make it faster. The bits are the same for any.
    pub threads: usize,
    /// Whether signals are filtered before they are sampled. Default [`Bandwidth::Auto`].
    #[serde(with = "bandwidths")]
    pub bandwidth: Bandwidth,
    /// Time before t = 0 in which the transient of the start decays \[s\]; absent: as long as the scene needs from
    /// equilibrium, 0 from any other start. Loads and drive are then as at t = 0, and rings and cage are turned back, so
    /// that at t = 0 they are where the scene puts them except for the slip of the balls. A given state is not turned
    /// back: it is the state before the settling.
    pub settle: Option<f64>,
    /// Wall time that the run may take \[s\], checked about every 20 ms; absent: any. Where it ends a run depends on the
    /// machine; the results of a run that finishes do not.
    pub time_limit: Option<f64>,
    /// Steps that the run may take, accepted and rejected ones; absent: any. Settling and each pilot run for an accuracy may
    /// take as many.
    pub max_steps: Option<usize>,
}

impl Default for Run {
    /// 0.1 s at 50 kHz from equilibrium.
    fn default() -> Self {
        Self {
            duration: 0.1,
            fs: 50e3,
            start: Start::Equilibrium,
            rtol: None,
            accuracy: None,
            method: None,
            threads: 0,
            bandwidth: Bandwidth::Auto,
            settle: None,
            time_limit: None,
            max_steps: None,
        }
    }
}

impl Run {
    /// The longest duration \[s\]: that of a [`crate::Simulation`] without an end of its own, which says how its last samples
    /// differ from those of a run of that length.
    pub const OPEN: f64 = 1e6;

    /// Reads a run from JSON and checks it.
    ///
    /// # Errors
    /// [`Error::Argument`] names the first field that is unknown or not usable.
    pub fn from_json(text: &str) -> Result<Self> {
        let document: Value = serde_json::from_str(text)
            .map_err(|e| Error::argument("run", "not JSON", e.to_string()))?;
        let run: Self = interpret(&document, "run")?;
        run.validate()?;
        Ok(run)
    }

    /// The run as JSON on one line, every field written out.
    ///
    /// # Panics
    /// Never: every run has a JSON form.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("a run is a JSON document")
    }

    /// Frequency up to which signals are recorded \[Hz\]; none for point samples, into which all frequencies fold.
    pub(crate) fn band(&self) -> Option<f64> {
        self.bandwidth.at(self.fs)
    }

    /// Number of samples k / fs below the duration.
    pub(crate) fn samples(&self) -> Result<usize> {
        let count = (self.duration * self.fs).round();
        if count < 1.0 {
            let allowed = format!("at least one sample in {} s", self.duration);
            return Err(Error::argument("fs", self.fs, allowed));
        }
        // At most 1e15 by the limits of duration and rate.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        Ok(count as usize)
    }

    /// Checks what does not depend on its scene.
    ///
    /// # Errors
    /// [`Error::Argument`] names the field.
    pub fn validate(&self) -> Result<()> {
        if !(self.duration > 0.0 && self.duration <= Self::OPEN) {
            let allowed = "above 0 and at most 1e6 s";
            return Err(Error::argument("duration", self.duration, allowed));
        }
        if !(self.fs > 0.0 && self.fs <= 1e9) {
            return Err(Error::argument("fs", self.fs, "above 0 and at most 1e9 Hz"));
        }
        within(
            "rtol",
            self.rtol,
            1e-12..=1e-1,
            "1e-12 to 1e-1, or absent: the scene's",
        )?;
        within(
            "accuracy",
            self.accuracy,
            1e-4..=1e-1,
            "1e-4 to 1e-1, or absent",
        )?;
        let settle = "0 to switch it off, at most 1000 s, or absent: as long as the scene needs";
        within("settle", self.settle, 0.0..=1e3, settle)?;
        let limit = "a finite wall time above 0 [s], or absent for no limit";
        within(
            "time_limit",
            self.time_limit,
            f64::MIN_POSITIVE..=f64::MAX,
            limit,
        )?;
        if self.max_steps == Some(0) {
            let allowed = "at least 1 step, or absent for no limit";
            return Err(Error::argument("max_steps", 0, allowed));
        }
        if let (Some(_), Some(rtol)) = (self.accuracy, self.rtol) {
            let allowed = "absent where `accuracy` is given, which chooses it";
            return Err(Error::argument("rtol", rtol, allowed));
        }
        self.samples().map(|_| ())
    }
}

fn within(name: &str, value: Option<f64>, range: RangeInclusive<f64>, allowed: &str) -> Result<()> {
    match value {
        Some(value) if !range.contains(&value) => Err(Error::argument(name, value, allowed)),
        _ => Ok(()),
    }
}

/// How a document says where a run starts.
mod starts {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

    use crate::statics::start::Start;

    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Written {
        Name(String),
        State(Vec<f64>),
    }

    pub fn serialize<S: Serializer>(start: &Start, to: S) -> Result<S::Ok, S::Error> {
        match start {
            Start::Equilibrium => to.serialize_str("equilibrium"),
            Start::Rolling => to.serialize_str("rolling"),
            Start::State(state) => state.serialize(to),
        }
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Start, D::Error> {
        let known = || de::Error::custom("\"equilibrium\", \"rolling\" or an array of states");
        match Written::deserialize(from).map_err(|_| known())? {
            Written::Name(name) if name == "equilibrium" => Ok(Start::Equilibrium),
            Written::Name(name) if name == "rolling" => Ok(Start::Rolling),
            Written::Name(_) => Err(known()),
            Written::State(state) => Ok(Start::State(state)),
        }
    }
}

/// How a document says whether signals are filtered.
mod bandwidths {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

    use crate::signals::Bandwidth;

    // Serde gives a reference.
    #[allow(clippy::trivially_copy_pass_by_ref)]
    pub fn serialize<S: Serializer>(bandwidth: &Bandwidth, to: S) -> Result<S::Ok, S::Error> {
        let name = match bandwidth {
            Bandwidth::Auto => Some("auto"),
            Bandwidth::Raw => None,
        };
        name.serialize(to)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Bandwidth, D::Error> {
        match Option::<String>::deserialize(from)?.as_deref() {
            Some("auto") => Ok(Bandwidth::Auto),
            None => Ok(Bandwidth::Raw),
            Some(_) => Err(de::Error::custom("\"auto\" or null")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_a_document_both_ways() {
        let run = Run {
            duration: 0.1 + 0.2,
            start: Start::State(vec![0.1, -1.0 / 3.0]),
            rtol: Some(1e-7),
            method: Some(Method::Verner),
            bandwidth: Bandwidth::Raw,
            settle: Some(0.0),
            max_steps: Some(7),
            ..Run::default()
        };
        assert_eq!(Run::from_json(&run.to_json()), Ok(run));
        assert_eq!(Run::from_json("{}"), Ok(Run::default()));
    }

    #[test]
    fn errors_name_the_field() {
        for (text, field) in [
            ("{", "run"),
            ("[0.5, 50e3]", "run"),
            (r#"{"steps": 3}"#, "steps"),
            (r#"{"": 3}"#, r#""""#),
            (r#"{"fs": 0}"#, "fs"),
            (r#"{"duration": "long"}"#, "duration"),
            (r#"{"settle": -1}"#, "settle"),
            (r#"{"rtol": 1}"#, "rtol"),
            (r#"{"accuracy": 1}"#, "accuracy"),
            (r#"{"start": "standing"}"#, "start"),
            (r#"{"time_limit": 0}"#, "time_limit"),
            (r#"{"max_steps": 0}"#, "max_steps"),
            (r#"{"method": "euler"}"#, "method"),
            (r#"{"bandwidth": "none"}"#, "bandwidth"),
        ] {
            let Err(Error::Argument { path, .. }) = Run::from_json(text) else {
                panic!("{text}");
            };
            assert_eq!(path, field);
        }
    }
}
