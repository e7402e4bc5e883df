//! Instruction sets: one program for three of them.

use std::fmt;

use super::vector::Wide;
#[cfg(target_arch = "x86_64")]
use pulp::NullaryFnOnce;
use pulp::{Scalar256b, Simd};

/// An instruction set, named as in the x86-64 psABI. Elsewhere only [`InstructionSet::BASELINE`] exists.
///
/// Results differ between levels by rounding: the upper two fuse products and sums.
#[derive(Debug, Clone, Copy)]
pub struct InstructionSet(Level);

/// The proof that a processor has the instructions goes with each.
#[derive(Debug, Clone, Copy)]
enum Level {
    /// Set that every processor of the architecture has (SSE2, NEON).
    Baseline,
    /// AVX2 and FMA.
    #[cfg(target_arch = "x86_64")]
    V3(pulp::x86::V3),
    /// AVX-512.
    #[cfg(target_arch = "x86_64")]
    V4(pulp::x86::V4),
}

/// Work that is compiled once an instruction set.
pub(crate) trait Task {
    type Output;

    /// Runs the task; `FMA` says whether fused products are instructions. Wants `#[inline(always)]`.
    fn run<const FMA: bool>(self) -> Self::Output;
}

impl InstructionSet {
    /// Set that every processor of the architecture has.
    pub const BASELINE: Self = Self(Level::Baseline);

    /// Levels of this processor, widest first.
    pub fn available() -> Vec<Self> {
        #[cfg(target_arch = "x86_64")]
        {
            let v4 = pulp::x86::V4::try_new().map(Level::V4);
            let v3 = pulp::x86::V3::try_new().map(Level::V3);
            let all = v4.into_iter().chain(v3).chain([Level::Baseline]);
            all.map(Self).collect()
        }
        #[cfg(not(target_arch = "x86_64"))]
        {
            vec![Self::BASELINE]
        }
    }

    /// Names of all levels that this program is compiled for, widest first, whether this processor has them or not.
    pub fn known() -> &'static [&'static str] {
        if cfg!(target_arch = "x86_64") {
            &["x86-64-v4", "x86-64-v3", "baseline"]
        } else {
            &["baseline"]
        }
    }

    /// Name of the set, as the environment variable takes it.
    pub fn name(&self) -> &'static str {
        match self.0 {
            Level::Baseline => "baseline",
            #[cfg(target_arch = "x86_64")]
            Level::V3(_) => "x86-64-v3",
            #[cfg(target_arch = "x86_64")]
            Level::V4(_) => "x86-64-v4",
        }
    }

    /// Runs a task with the instructions of this set.
    #[inline]
    pub(crate) fn run<T: Task>(self, task: T) -> T::Output {
        match self.0 {
            // NEON has fused products everywhere.
            Level::Baseline if cfg!(target_arch = "aarch64") => baseline::<_, true>(task),
            Level::Baseline => baseline::<_, false>(task),
            #[cfg(target_arch = "x86_64")]
            Level::V3(instructions) => instructions.vectorize(Fused(task)),
            #[cfg(target_arch = "x86_64")]
            Level::V4(instructions) => instructions.vectorize(Fused(task)),
        }
    }
}

impl InstructionSet {
    /// Runs a task that is written for registers of any width.
    #[inline]
    pub(crate) fn run_wide<T: Wide>(self, task: T) -> T::Output {
        match self.0 {
            Level::Baseline => Scalar256b.vectorize(task),
            #[cfg(target_arch = "x86_64")]
            Level::V3(instructions) => Simd::vectorize(instructions, task),
            #[cfg(target_arch = "x86_64")]
            Level::V4(instructions) => Simd::vectorize(instructions, task),
        }
    }
}

/// Runs a task without any instructions of its own. A function apart, so that the other sets' frames need not its memory, which without
/// optimisation is half a megabyte.
fn baseline<T: Task, const FMA: bool>(task: T) -> T::Output {
    task.run::<FMA>()
}

/// A task on an instruction set that fuses.
#[cfg(target_arch = "x86_64")]
struct Fused<T>(T);

#[cfg(target_arch = "x86_64")]
impl<T: Task> NullaryFnOnce for Fused<T> {
    type Output = T::Output;

    #[inline(always)]
    fn call(self) -> T::Output {
        self.0.run::<true>()
    }
}

impl PartialEq for InstructionSet {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl fmt::Display for InstructionSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Analytic: known levels and those at hand have the same names.
    #[test]
    fn levels_at_hand_are_known() {
        let known = InstructionSet::known();
        assert!(
            InstructionSet::available()
                .iter()
                .all(|instructions| known.contains(&instructions.name()))
        );
    }
}
