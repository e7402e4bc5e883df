//! Checks of single numbers, mounts and names.

use std::ops::RangeInclusive;

use crate::base::error::{Error, Result};
use crate::base::quantities;
use crate::scene::Mount;
use crate::scene::numbers::{BoundedNumber, NumberRange};
use crate::scene::path::shown;

pub(super) fn finite(path: &str, value: f64) -> Result<()> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(Error::scene(path, value, "a finite number"))
    }
}

/// Check of a positive number in some unit.
pub(super) fn positive(path: &str, value: f64, unit: &str) -> Result<()> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    let allowed = format!("a finite number above 0 {unit}");
    Err(Error::scene(path, value, allowed.trim_end()))
}

/// Check of a number in some unit, above 0 and at most a bound.
pub(super) fn up_to(path: &str, value: f64, most: f64, unit: &str) -> Result<()> {
    if value > 0.0 && value <= most {
        return Ok(());
    }
    let most = match unit {
        "m" => quantities::length(most),
        _ => format!("{} {unit}", quantities::number(most)),
    };
    Err(Error::scene(
        path,
        value,
        format!("above 0 and at most {most}"),
    ))
}

/// Check of a number in some unit, or none, within a range.
pub(super) fn within(path: &str, value: f64, range: RangeInclusive<f64>, unit: &str) -> Result<()> {
    if range.contains(&value) {
        return Ok(());
    }
    let ends = [*range.start(), *range.end()];
    let [from, to] = if unit == "m" {
        ends.map(quantities::length)
    } else {
        ends.map(quantities::number)
    };
    let allowed = match unit {
        "" | "m" => format!("from {from} to {to}"),
        _ => format!("from {from} to {to} {unit}"),
    };
    Err(Error::scene(path, value, allowed))
}

/// Check of the numbers of a part.
pub(super) fn numbers(path: &str, of: impl IntoIterator<Item = BoundedNumber>) -> Result<()> {
    of.into_iter().try_for_each(|number| {
        let path = format!("{path}.{}", number.field);
        match number.range {
            NumberRange::Within(range) => within(&path, number.value, range, number.unit),
            NumberRange::UpTo(most) => up_to(&path, number.value, most, number.unit),
        }
    })
}

/// Check of a place of a bearing or its shaft \[m\].
pub(super) fn place(path: &str, value: f64) -> Result<()> {
    within(path, value, -100.0..=100.0, "m")
}

/// Check of a length \[m\] below a limit.
pub(super) fn below(path: &str, value: f64, limit: f64, what: &str) -> Result<()> {
    if value < limit {
        Ok(())
    } else {
        let allowed = format!("below {what}, {}", quantities::length(limit));
        Err(Error::scene(path, value, allowed))
    }
}

/// Check of a direction along an axis, or one that turns.
pub(super) fn mount(path: &str, mount: Option<&Mount>, turns: bool) -> Result<()> {
    let Some(Mount::Spring { stiffness, damping }) = mount else {
        return Ok(());
    };
    let units = if turns {
        ["N m/rad", "N m s/rad"]
    } else {
        ["N/m", "N s/m"]
    };
    let at = |field: &str| format!("{path}.spring.{field}");
    within(&at("stiffness"), *stiffness, 0.0..=1e15, units[0])?;
    within(&at("damping"), *damping, 0.0..=1e12, units[1])
}

pub(super) fn entry_name(collection: &str, name: &str) -> Result<()> {
    let good = !name.is_empty()
        && name
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if good {
        Ok(())
    } else {
        Err(Error::scene(
            format!("{collection}.{}", shown(name)),
            name,
            "a name of letters, digits, _ and -",
        ))
    }
}
