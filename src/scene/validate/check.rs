//! The single checks.

use std::ops::RangeInclusive;

use crate::error::{Error, Result};
use crate::told::number;

pub(super) fn finite(path: &str, value: f64) -> Result<()> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(Error::scene(path, value, "a finite number"))
    }
}

pub(super) fn positive(path: &str, value: f64) -> Result<()> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(Error::scene(path, value, "a finite number above 0"))
    }
}

pub(super) fn within(path: &str, value: f64, range: RangeInclusive<f64>) -> Result<()> {
    if range.contains(&value) {
        Ok(())
    } else {
        Err(Error::scene(
            path,
            value,
            format!(
                "from {} to {}",
                number(*range.start()),
                number(*range.end())
            ),
        ))
    }
}

pub(super) fn below(path: &str, value: f64, limit: f64, what: &str) -> Result<()> {
    if value < limit {
        Ok(())
    } else {
        Err(Error::scene(
            path,
            value,
            format!("below {what}, {}", number(limit)),
        ))
    }
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
            format!("{collection}.{name}"),
            name,
            "a name of letters, digits, _ and -",
        ))
    }
}
