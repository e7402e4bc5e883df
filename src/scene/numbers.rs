//! Numbers of a part of a scene with what is allowed of each. The file of the part lists them next to its fields; `validate` checks them.

use std::ops::RangeInclusive;

/// A number of a part.
pub(super) struct BoundedNumber {
    /// Path of the field within the part.
    pub field: &'static str,
    pub value: f64,
    pub range: NumberRange,
    /// Empty for a number without one.
    pub unit: &'static str,
}

impl BoundedNumber {
    /// A number within a range, both ends too.
    pub fn within(
        field: &'static str,
        value: f64,
        range: RangeInclusive<f64>,
        unit: &'static str,
    ) -> Self {
        Self {
            field,
            value,
            range: NumberRange::Within(range),
            unit,
        }
    }
}

/// Range of numbers that are allowed.
pub(super) enum NumberRange {
    /// Both ends too.
    Within(RangeInclusive<f64>),
    /// Numbers above 0, and at most this.
    UpTo(f64),
}
