//! Numbers of a part of a scene with what is allowed of each. The file of the part lists them next to its fields; `validate` checks them,
//! and the schema of documents states them.

use std::ops::{Bound, RangeBounds, RangeInclusive};

/// Range of numbers that are allowed.
pub(crate) type NumberRange = (Bound<f64>, Bound<f64>);

/// Finite numbers above 0.
pub(super) const POSITIVE: NumberRange = (Bound::Excluded(0.0), Bound::Excluded(f64::INFINITY));

/// Places of a bearing or its shaft \[m\].
pub(super) const PLACES: RangeInclusive<f64> = -100.0..=100.0;

/// Angles on a body \[rad\].
pub(super) const ANGLES: RangeInclusive<f64> = -1e3..=1e3;

/// Numbers above 0, and at most this.
pub(super) const fn up_to(most: f64) -> NumberRange {
    (Bound::Excluded(0.0), Bound::Included(most))
}

/// A number of which the range alone is asked.
pub(super) const UNSAID: f64 = f64::NAN;

/// Numbers of a part by its name.
pub(super) type PartNumbers = (&'static str, Vec<BoundedNumber>);

/// A number of a part.
pub(crate) struct BoundedNumber {
    /// Field of the part.
    pub field: &'static str,
    /// Place in the list that the field is.
    pub item: Option<usize>,
    /// Absent where it is not given.
    pub value: Option<f64>,
    pub range: NumberRange,
    /// Empty for a number without one.
    pub unit: &'static str,
}

impl BoundedNumber {
    /// A number, which may be absent, within a range.
    pub fn new(
        field: &'static str,
        value: impl Into<Option<f64>>,
        range: impl RangeBounds<f64>,
        unit: &'static str,
    ) -> Self {
        Self {
            field,
            item: None,
            value: value.into(),
            range: (range.start_bound().cloned(), range.end_bound().cloned()),
            unit,
        }
    }

    /// Numbers of a list, all within a range; of an empty one the range alone.
    pub fn each(
        field: &'static str,
        values: &[f64],
        range: impl RangeBounds<f64> + Clone,
        unit: &'static str,
    ) -> Vec<Self> {
        let of = |item: usize| Self {
            item: Some(item),
            ..Self::new(field, values.get(item).copied(), range.clone(), unit)
        };
        (0..values.len().max(1)).map(of).collect()
    }
}
