//! One program for three instruction sets.

use std::ffi::OsStr;
use std::fmt;
use std::sync::OnceLock;

use pulp::{NullaryFnOnce, Scalar256b, Simd};
use serde::Serialize;

use super::proof::wrong_primitive;
use super::vector::{Vector, Wide};

/// The environment variable that overrides the choice.
const VARIABLE: &str = "BALLRACE_SIMD";

/// An instruction set, named as in the x86-64 psABI. Elsewhere only [`InstructionSet::BASELINE`] exists.
///
/// Results differ between levels by rounding: the upper two fuse products and sums.
#[derive(Debug, Clone, Copy)]
pub struct InstructionSet(Level);

/// The proof that a processor has the instructions goes with each.
#[derive(Debug, Clone, Copy)]
enum Level {
    /// What every processor of the architecture has (SSE2, NEON).
    Baseline,
    /// AVX2 and FMA.
    #[cfg(target_arch = "x86_64")]
    V3(pulp::x86::V3),
    /// AVX-512.
    #[cfg(target_arch = "x86_64")]
    V4(pulp::x86::V4),
}

/// An instruction set that is not known or that this processor does not have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownInstructionSet {
    /// What was asked for.
    pub value: String,
    /// What there is.
    pub available: Vec<&'static str>,
}

/// An instruction set that this processor says it has and that does not compute what it should; a narrower one is used instead.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Distrust {
    /// Name of the instruction set.
    pub instructions: &'static str,
    /// The primitive that erred first; `contacts` where the primitives did not and contacts did.
    pub primitive: &'static str,
    /// Name of the instruction set that is used.
    pub used: &'static str,
}

/// The first instruction set that errs nowhere, or the last, and what was wrong with the first.
fn trusted(
    levels: Vec<InstructionSet>,
    wrong: impl Fn(InstructionSet) -> Option<&'static str>,
) -> (InstructionSet, Option<Distrust>) {
    let last = levels[levels.len() - 1];
    let (first, error) = (levels[0], wrong(levels[0]));
    let used = levels
        .into_iter()
        .find(|instructions| wrong(*instructions).is_none())
        .unwrap_or(last);
    let distrust = error.map(|primitive| Distrust {
        instructions: first.name(),
        primitive,
        used: used.name(),
    });
    (used, distrust)
}

/// Work that is compiled once an instruction set.
pub(crate) trait Task {
    type Output;

    /// Does it; `FMA` says whether fused products are instructions. Wants `#[inline(always)]`.
    fn run<const FMA: bool>(self) -> Self::Output;
}

impl InstructionSet {
    /// What every processor of the architecture has.
    pub const BASELINE: Self = Self(Level::Baseline);

    /// All levels of this processor, widest first.
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

    /// The instruction set that the environment variable `BALLRACE_SIMD` names, or the widest; a narrower one where that does not
    /// compute what it should ([`InstructionSet::distrust`]).
    ///
    /// # Errors
    /// [`UnknownInstructionSet`] if the variable names none that this processor has.
    pub fn chosen() -> Result<Self, UnknownInstructionSet> {
        Self::choice().clone().map(|(instructions, _)| instructions)
    }

    /// What was wrong with the instruction set that this process would have used, if anything: its primitives are compared with
    /// the same on single numbers once, at first use.
    pub fn distrust() -> Option<Distrust> {
        Self::choice()
            .clone()
            .ok()
            .and_then(|(_, distrust)| distrust)
    }

    /// The instruction set of this process; the baseline if the environment names none of this processor.
    pub(crate) fn current() -> Self {
        Self::chosen().unwrap_or(Self::BASELINE)
    }

    /// Made once, at first use.
    fn choice() -> &'static Result<(Self, Option<Distrust>), UnknownInstructionSet> {
        static CHOICE: OnceLock<Result<(InstructionSet, Option<Distrust>), UnknownInstructionSet>> =
            OnceLock::new();
        CHOICE.get_or_init(|| {
            let asked = std::env::var_os(VARIABLE).filter(|value| !value.is_empty());
            let candidates = Self::from_asked(asked.as_deref())?;
            Ok(trusted(candidates, wrong_primitive))
        })
    }

    /// The instruction set that is asked for and those below it.
    fn from_asked(asked: Option<&OsStr>) -> Result<Vec<Self>, UnknownInstructionSet> {
        let mut available = Self::available();
        let Some(value) = asked else {
            return Ok(available);
        };
        match available
            .iter()
            .position(|instructions| value == instructions.name())
        {
            Some(first) => Ok(available.split_off(first)),
            None => Err(UnknownInstructionSet {
                value: value.to_string_lossy().into_owned(),
                available: available.iter().map(Self::name).collect(),
            }),
        }
    }

    /// Its name, as the environment variable takes it.
    pub fn name(&self) -> &'static str {
        match self.0 {
            Level::Baseline => "baseline",
            #[cfg(target_arch = "x86_64")]
            Level::V3(_) => "x86-64-v3",
            #[cfg(target_arch = "x86_64")]
            Level::V4(_) => "x86-64-v4",
        }
    }

    /// Does a task with the instructions of this set.
    #[inline]
    pub(crate) fn run<T: Task>(self, task: T) -> T::Output {
        match self.0 {
            // NEON has fused products everywhere.
            Level::Baseline if cfg!(target_arch = "aarch64") => task.run::<true>(),
            Level::Baseline => task.run::<false>(),
            #[cfg(target_arch = "x86_64")]
            Level::V3(instructions) => instructions.vectorize(Fused(task)),
            #[cfg(target_arch = "x86_64")]
            Level::V4(instructions) => instructions.vectorize(Fused(task)),
        }
    }
}

impl InstructionSet {
    /// Numbers in a register.
    fn lanes(self) -> usize {
        self.run_wide(CountLanes)
    }

    /// This set, or one whose registers so many numbers fill.
    pub(crate) fn filled_by(self, count: usize) -> Option<Self> {
        let narrower = match self.0 {
            #[cfg(target_arch = "x86_64")]
            Level::V4(instructions) => Self(Level::V3(*instructions)),
            _ => self,
        };
        [self, narrower]
            .into_iter()
            .find(|instructions| instructions.lanes() <= count)
    }

    /// Does a task that is written for registers of any width.
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

struct CountLanes;

impl Wide for CountLanes {
    type Output = usize;

    fn with_simd<S: Simd>(self, _: S) -> usize {
        Vector::<S>::LANES
    }
}

/// A task on an instruction set that fuses.
#[cfg(target_arch = "x86_64")]
struct Fused<T>(T);

#[cfg(target_arch = "x86_64")]
impl<T: Task> NullaryFnOnce for Fused<T> {
    type Output = T::Output;

    // Into the function that pulp compiles for the instructions.
    #[allow(clippy::inline_always)]
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

    /// Analytic: what errs is not used, and it is told what was wrong with it.
    #[test]
    fn a_level_that_errs_gives_way_to_the_next() {
        let all = InstructionSet::available();
        assert_eq!(trusted(all.clone(), |_| None), (all[0], None));
        let widest = all[0];
        let (used, distrust) = trusted(all.clone(), |instructions| {
            (instructions == widest).then_some("any")
        });
        assert_eq!(used, *all.get(1).unwrap_or(&InstructionSet::BASELINE));
        let wanted = Distrust {
            instructions: widest.name(),
            primitive: "any",
            used: used.name(),
        };
        assert_eq!(distrust, Some(wanted));
        assert_eq!(trusted(all, |_| Some("any")).0, InstructionSet::BASELINE);
    }

    /// Analytic: what the environment asks for is the widest that is tried.
    #[test]
    fn the_environment_chooses() {
        let names = |asked: &str| {
            InstructionSet::from_asked(Some(OsStr::new(asked)))
                .map(|levels| levels.iter().map(InstructionSet::name).collect::<Vec<_>>())
        };
        assert_eq!(names("baseline"), Ok(vec!["baseline"]));
        assert_eq!(names("mmx").unwrap_err().value, "mmx");
        for (i, instructions) in InstructionSet::available().iter().enumerate() {
            assert_eq!(
                names(instructions.name()).unwrap().len(),
                InstructionSet::available().len() - i
            );
        }
    }

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
