//! One program for three levels of instructions.

use std::fmt;
use std::sync::OnceLock;

use pulp::{NullaryFnOnce, Scalar256b, Simd};

use super::vector::Wide;

/// The environment variable that overrides the choice.
const VARIABLE: &str = "BALLRACE_SIMD";

/// A level of vector instructions, named as in the x86-64 psABI. Elsewhere only [`Level::Baseline`] exists.
///
/// Results differ between levels by rounding: the upper two fuse products and sums.
#[derive(Debug, Clone, Copy)]
pub enum Level {
    /// What every processor of the architecture has (SSE2, NEON).
    Baseline,
    /// AVX2 and FMA.
    #[cfg(target_arch = "x86_64")]
    V3(pulp::x86::V3),
    /// AVX-512.
    #[cfg(target_arch = "x86_64")]
    V4(pulp::x86::V4),
}

/// A level that is not known or that this processor does not have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownLevel {
    /// What was asked for.
    pub value: String,
    /// What there is.
    pub available: Vec<&'static str>,
}

/// Work that is compiled once a level.
pub(crate) trait Task {
    type Output;

    /// Does it; `FMA` says whether fused products are instructions. Wants `#[inline(always)]`.
    fn run<const FMA: bool>(self) -> Self::Output;
}

impl Level {
    /// All levels of this processor, widest first.
    pub fn available() -> Vec<Self> {
        #[cfg(target_arch = "x86_64")]
        {
            let v4 = pulp::x86::V4::try_new().map(Self::V4);
            let v3 = pulp::x86::V3::try_new().map(Self::V3);
            v4.into_iter().chain(v3).chain([Self::Baseline]).collect()
        }
        #[cfg(not(target_arch = "x86_64"))]
        {
            vec![Self::Baseline]
        }
    }

    /// The level that the environment variable `BALLRACE_SIMD` names, or the widest.
    ///
    /// # Errors
    /// [`UnknownLevel`] if the variable names none that this processor has.
    pub fn chosen() -> Result<Self, UnknownLevel> {
        let available = Self::available();
        let Some(value) = std::env::var_os(VARIABLE).filter(|value| !value.is_empty()) else {
            return Ok(available[0]);
        };
        available
            .iter()
            .copied()
            .find(|level| value == level.name())
            .ok_or_else(|| UnknownLevel {
                value: value.to_string_lossy().into_owned(),
                available: available.iter().map(Self::name).collect(),
            })
    }

    /// The level of this process, read once; the baseline if the environment names none of this processor.
    pub(crate) fn current() -> Self {
        static CURRENT: OnceLock<Level> = OnceLock::new();
        *CURRENT.get_or_init(|| Self::chosen().unwrap_or(Self::Baseline))
    }

    /// Its name, as the environment variable takes it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            #[cfg(target_arch = "x86_64")]
            Self::V3(_) => "x86-64-v3",
            #[cfg(target_arch = "x86_64")]
            Self::V4(_) => "x86-64-v4",
        }
    }

    /// Does a task with the instructions of this level.
    #[inline]
    pub(crate) fn run<T: Task>(self, task: T) -> T::Output {
        match self {
            // NEON has fused products everywhere.
            Self::Baseline if cfg!(target_arch = "aarch64") => task.run::<true>(),
            Self::Baseline => task.run::<false>(),
            #[cfg(target_arch = "x86_64")]
            Self::V3(level) => level.vectorize(Fused(task)),
            #[cfg(target_arch = "x86_64")]
            Self::V4(level) => level.vectorize(Fused(task)),
        }
    }
}

impl Level {
    /// This level, or one whose registers so many numbers fill.
    pub(crate) fn filled_by(self, count: usize) -> Option<Self> {
        let lanes = |level: &Self| match level {
            #[cfg(target_arch = "x86_64")]
            Self::V4(_) => 8,
            _ => 4,
        };
        let narrower = match self {
            #[cfg(target_arch = "x86_64")]
            Self::V4(level) => Self::V3(*level),
            other => other,
        };
        [self, narrower]
            .into_iter()
            .find(|level| lanes(level) <= count)
    }

    /// Does a task that is written for registers of any width.
    #[inline]
    pub(crate) fn run_wide<T: Wide>(self, task: T) -> T::Output {
        match self {
            Self::Baseline => Scalar256b.vectorize(task),
            #[cfg(target_arch = "x86_64")]
            Self::V3(level) => Simd::vectorize(level, task),
            #[cfg(target_arch = "x86_64")]
            Self::V4(level) => Simd::vectorize(level, task),
        }
    }
}

/// A task on a level that fuses.
#[cfg(target_arch = "x86_64")]
struct Fused<T>(T);

#[cfg(target_arch = "x86_64")]
impl<T: Task> NullaryFnOnce for Fused<T> {
    type Output = T::Output;

    // Into the function that pulp compiles for the level.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn call(self) -> T::Output {
        self.0.run::<true>()
    }
}

impl PartialEq for Level {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
