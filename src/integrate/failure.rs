//! How an integration can fail.

use std::error::Error;
use std::fmt;

/// Input that cannot be integrated, and what is wrong with it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Invalid(pub &'static str);

impl fmt::Display for Invalid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

impl Error for Invalid {}

/// Why and where an integration stopped before its end.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Failure {
    /// The last accepted time, at which the failing step began.
    pub time: f64,
    /// The step size that failed; 0 if it never came to a step.
    pub step: f64,
    /// The group whose error was largest or not finite in the last attempt; 0
    /// if none was measured.
    pub group: usize,
    /// The reason.
    pub kind: FailureKind,
}

/// The reason of a [`Failure`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FailureKind {
    /// A state or derivative was not finite, and no smaller step helped.
    NonFinite,
    /// The step has shrunk to the resolution of time.
    TooSmall,
    /// The input is unusable.
    Invalid(Invalid),
}

impl Failure {
    /// A failure before anything was computed.
    pub(super) fn invalid(time: f64, reason: Invalid) -> Self {
        Self {
            time,
            step: 0.0,
            group: 0,
            kind: FailureKind::Invalid(reason),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            time, step, group, ..
        } = self;
        let reason = match self.kind {
            FailureKind::NonFinite => "a number became non-finite",
            FailureKind::TooSmall => "the step fell below the resolution of time",
            FailureKind::Invalid(reason) => return reason.fmt(f),
        };
        write!(
            f,
            "integration stopped at t = {time:e}, step {step:e}: {reason} (group {group})"
        )
    }
}

impl Error for Failure {}
