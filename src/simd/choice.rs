//! Choice of the instruction set of a process: the widest that exists, or the requested one, if it computes correctly.

use std::borrow::Cow;
use std::ffi::OsStr;
use std::sync::OnceLock;

use serde::{Deserialize, Serialize};

use super::isa::InstructionSet;
use super::proof::wrong_primitive;

/// The environment variable that overrides the choice.
const VARIABLE: &str = "BALLRACE_SIMD";

/// An instruction set that is not known or that this processor does not have.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct UnknownInstructionSet {
    /// Requested value.
    pub value: String,
    /// Sets that there are.
    pub available: Vec<&'static str>,
}

/// An instruction set that this processor says it has and that does not compute what it should; a narrower one is used instead.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Distrust {
    /// Name of the instruction set.
    pub instructions: Cow<'static, str>,
    /// The primitive that erred first; `contacts` where the primitives did not and contacts did.
    pub primitive: Cow<'static, str>,
    /// Name of the instruction set that is used.
    pub used: Cow<'static, str>,
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
        instructions: first.name().into(),
        primitive: primitive.into(),
        used: used.name().into(),
    });
    (used, distrust)
}

impl InstructionSet {
    /// The instruction set that the environment variable `BALLRACE_SIMD` names, or the widest; a narrower one where that does not
    /// compute what it should ([`InstructionSet::distrust`]).
    ///
    /// # Errors
    /// [`UnknownInstructionSet`] if the variable names none that this processor has.
    pub fn chosen() -> Result<Self, UnknownInstructionSet> {
        Self::choice().clone().map(|(instructions, _)| instructions)
    }

    /// Fault of the instruction set that this process would have used, if any: its primitives are compared with
    /// the same on single numbers once, at first use.
    pub fn distrust() -> Option<Distrust> {
        Self::choice()
            .clone()
            .ok()
            .and_then(|(_, distrust)| distrust)
    }

    /// The instruction set of this process; the baseline if the environment names none of this processor.
    pub(crate) fn current() -> Self {
        // In every step: nothing is copied but the set.
        match Self::choice() {
            Ok((instructions, _)) => *instructions,
            Err(_) => Self::BASELINE,
        }
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
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Analytic: a set that errs is not used, and its error is reported.
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
            instructions: widest.name().into(),
            primitive: "any".into(),
            used: used.name().into(),
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
}
