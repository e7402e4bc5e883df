//! The crate's errors, each with the place, the value and what to try next.

use serde::Serialize;

use thiserror::Error;

use crate::base::quantities;

/// An error of the crate: input that `ballrace` refuses, or work at which it fails.
#[derive(Debug, Clone, PartialEq, Error, Serialize)]
#[non_exhaustive]
pub enum Error {
    /// A field of the scene is not usable. Nothing was computed or written.
    #[error("{path} = {value}: {allowed}")]
    #[non_exhaustive]
    Scene {
        /// Dotted path of the field, such as `rows[0].ball_diameter`.
        path: String,
        /// The offending value as the user wrote it.
        value: String,
        /// Values that are allowed there.
        allowed: String,
    },
    /// An argument of a call, or an option of a run or of features, is not usable. Nothing was computed or written.
    #[error("{path} = {value}: {allowed}")]
    #[non_exhaustive]
    Argument {
        /// Name of the argument or option, such as `duration`.
        path: String,
        /// The offending value as the caller wrote it.
        value: String,
        /// Values that are allowed there.
        allowed: String,
    },
    /// A record is not usable: a sample that is no number, or too large.
    #[error("{path} = {value}: {allowed}")]
    #[non_exhaustive]
    Record {
        /// The record's name as an argument.
        path: String,
        /// Value of the sample that was found, and its place.
        value: String,
        /// Samples that are allowed.
        allowed: String,
    },
    /// A snapshot is not usable: no document of one, of another version or run, or with other forces.
    #[error("{path} = {value}: {allowed}")]
    #[non_exhaustive]
    Snapshot {
        /// Dotted path in the snapshot's document.
        path: String,
        /// Value that was found there.
        value: String,
        /// Values that are allowed there.
        allowed: String,
    },
    /// The static solve found no stable equilibrium.
    #[error("no equilibrium: {reason}")]
    #[non_exhaustive]
    Equilibrium {
        /// Why, and what to try.
        reason: String,
    },
    /// A force by code of the caller ([`crate::scene::RingForce`]) gave what is no force, or panicked in a campaign.
    #[error("{path} at t = {}: {reason}", reached(.time))]
    #[non_exhaustive]
    Force {
        /// Path of the force in the scene, such as `ring_forces.pull`.
        path: String,
        /// Time at which it was called \[s\].
        time: f64,
        /// Number that the force gave, or the message of its panic.
        reason: String,
    },
    /// The integration could not go on.
    #[error(
        "integration stopped at t = {}, step {}, at {body}: {reason}",
        reached(.time),
        quantities::time(.step)
    )]
    #[non_exhaustive]
    Integration {
        /// Time reached \[s\].
        time: f64,
        /// Step size of the last attempt \[s\].
        step: f64,
        /// The body with the largest error, as in the names of the states.
        body: String,
        /// Elements that limit the step, the fastest first: contacts as `row0.ball3.outer` (ball and race), a cage as
        /// `row0.cage`, a support as `outer.support`. Empty if nothing acts there.
        contacts: Vec<String>,
        /// The failure, the contacts at which it happened, and what to try.
        reason: String,
    },
    /// The observer (Ctrl-C, a callback) asked to stop.
    #[error("interrupted at t = {}", reached(.time))]
    #[non_exhaustive]
    Interrupted {
        /// Time reached \[s\].
        time: f64,
    },
    /// The run cost more than [`crate::Run::time_limit`] or [`crate::Run::max_steps`] allows.
    #[error(
        "stopped at t = {}: {name} = {limit} is spent; allow more, or make the run cheaper (`explain` shows how)",
        reached(.time)
    )]
    #[non_exhaustive]
    Budget {
        /// Simulated time reached \[s\].
        time: f64,
        /// The limit, `time_limit` or `max_steps`.
        name: &'static str,
        /// The limit's value, in seconds or steps.
        limit: f64,
    },
    /// More memory would be needed than is available; nothing was computed.
    #[error(
        "{:.2} GiB of memory would be needed where {:.2} GiB are left to use: {what}",
        .needed / quantities::GIB,
        .available / quantities::GIB
    )]
    #[non_exhaustive]
    Memory {
        /// Memory that would be needed \[bytes\].
        needed: f64,
        /// Least of the machine's free memory and what the limits of the process and its control groups leave \[bytes\].
        available: f64,
        /// The purpose of the memory, and how to need less.
        what: String,
    },
    /// A panic in this crate, caught so that one case of many does not stop the others.
    #[error("internal error, please report it: {message}")]
    #[non_exhaustive]
    Internal {
        /// Message of the panic.
        message: String,
    },
}

impl Error {
    /// A field of a scene that is not usable; `value` may be anything that prints.
    #[allow(clippy::needless_pass_by_value)] // so that literals and numbers can be given as they are
    pub fn scene(
        path: impl Into<String>,
        value: impl std::fmt::Display,
        allowed: impl Into<String>,
    ) -> Self {
        Self::Scene {
            path: path.into(),
            value: readable(value.to_string()),
            allowed: allowed.into(),
        }
    }

    /// An argument or option that is not usable; likewise.
    #[allow(clippy::needless_pass_by_value)] // as above
    pub fn argument(
        path: impl Into<String>,
        value: impl std::fmt::Display,
        allowed: impl Into<String>,
    ) -> Self {
        Self::Argument {
            path: path.into(),
            value: readable(value.to_string()),
            allowed: allowed.into(),
        }
    }
}

/// A number with more digits than usual, in the usual form; other text as it is.
fn readable(text: String) -> String {
    if text.len() < 16 {
        return text;
    }
    text.parse().map_or(text, quantities::given)
}

/// Shorthand for results of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// The time that a run has reached, as messages say it; before 0 its start settles.
#[allow(clippy::trivially_copy_pass_by_ref)] // as thiserror gives it
fn reached(time: &f64) -> String {
    let settling = if *time < 0.0 {
        ", while the start settles"
    } else {
        ""
    };
    format!("{}{settling}", quantities::time(time))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_units() {
        let error = Error::Integration {
            time: 1.25e-3,
            step: 3.4e-13,
            body: "outer".to_owned(),
            contacts: Vec::new(),
            reason: "why".to_owned(),
        };
        let text = "integration stopped at t = 1.25 ms, step 3.4e-13 s, at outer: why";
        assert_eq!(error.to_string(), text);
        let text = "interrupted at t = -2 ms, while the start settles";
        assert_eq!(Error::Interrupted { time: -2e-3 }.to_string(), text);
    }

    #[test]
    fn numbers_print_as_people_write_them() {
        let value_of = |value: f64| match Error::scene("a", value, "") {
            Error::Scene { value, .. } => value,
            other => panic!("{other}"),
        };
        assert_eq!(value_of(1e300), "1e300");
        assert_eq!(value_of(-2.5e-300), "-2.5e-300");
        assert_eq!(value_of(0.1), "0.1");
        assert_eq!(value_of(0.1 + 0.2), "0.3");
        assert_eq!(value_of(0.012_345_678_901_234_5), "0.0123456789012345");
        assert_eq!(value_of(f64::INFINITY), "inf");
    }
}
