//! Checks of single numbers, mounts and names.

use std::ops::{Bound, RangeBounds};

use crate::base::error::{Error, Result};
use crate::base::quantities;
use crate::scene::Mount;
use crate::scene::numbers::{BoundedNumber, NumberRange, POSITIVE};
use crate::scene::path::shown;

pub(super) fn finite(path: &str, value: f64) -> Result<()> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(Error::scene(path, value, "a finite number"))
    }
}

/// Check of a number in some unit, or none, within a range.
pub(super) fn within(
    path: &str,
    value: f64,
    range: impl RangeBounds<f64>,
    unit: &str,
) -> Result<()> {
    if range.contains(&value) {
        return Ok(());
    }
    let range = (range.start_bound().cloned(), range.end_bound().cloned());
    Err(Error::scene(path, value, allowed(range, unit)))
}

/// Words for a range of numbers in some unit, or none.
fn allowed(range: NumberRange, unit: &str) -> String {
    let number = if unit == "m" {
        quantities::length
    } else {
        quantities::number
    };
    let unit = match unit {
        "" => String::new(),
        _ => format!(" {unit}"),
    };
    if range == POSITIVE {
        return format!("a finite number above 0{unit}");
    }
    let low = match range.0 {
        Bound::Included(low) => format!("from {}", number(low)),
        Bound::Excluded(0.0) => "above 0".to_owned(),
        Bound::Excluded(low) => format!("above {}", number(low)),
        Bound::Unbounded => String::new(),
    };
    let high = match (range.1, range.0) {
        (Bound::Included(high), Bound::Included(_)) => format!(" to {}", number(high)),
        (Bound::Included(high), _) => format!(" and at most {}", number(high)),
        (Bound::Excluded(high), _) => format!(" and below {}", number(high)),
        (Bound::Unbounded, _) => String::new(),
    };
    // Lengths have units of their size.
    let unit = if unit == " m" { "" } else { &unit };
    format!("{low}{high}{unit}")
}

/// Check of the numbers of a part that are given.
pub(super) fn numbers(path: &str, of: impl IntoIterator<Item = BoundedNumber>) -> Result<()> {
    for BoundedNumber {
        field,
        item,
        value,
        range,
        unit,
    } in of
    {
        let Some(value) = value.filter(|value| !range.contains(value)) else {
            continue;
        };
        let item = item.map(|i| format!("[{i}]")).unwrap_or_default();
        let path = format!("{path}.{field}{item}");
        within(path.trim_start_matches('.'), value, range, unit)?;
    }
    Ok(())
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
    let spring = mount.map(|mount| mount.numbers(turns));
    numbers(&format!("{path}.spring"), spring.into_iter().flatten())
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
