//! Check of the samples of a record, measured or simulated.

use crate::base::error::{Error, Result};
use crate::base::quantities;

/// Magnitude of a signal: sums of its fourth powers, which a kurtosis takes, are still numbers.
const LARGEST: f64 = 1e60;

/// Refuses samples that are not finite, of which a single one would spoil every line and moment, or too large.
///
/// # Errors
/// [`Error::Record`] with the path that is given, and the first of the samples.
pub fn check_samples(path: &str, x: &[f64]) -> Result<()> {
    let mut wrong = x.iter().enumerate().filter(|(_, x)| !x.is_finite());
    if let Some((at, first)) = wrong.next() {
        let first = if first.is_nan() {
            "nan".to_owned()
        } else {
            first.to_string()
        };
        let more = match wrong.count() {
            0 => String::new(),
            more => format!(", and {more} more like it"),
        };
        let found = format!("{first} in sample {at}{more}");
        return Err(refused(path, found, "finite everywhere".to_owned()));
    }
    let largest = x.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    if largest > LARGEST {
        let found = format!("up to {}", quantities::given(largest));
        let allowed = format!("magnitudes up to {}", quantities::given(LARGEST));
        return Err(refused(path, found, allowed));
    }
    Ok(())
}

fn refused(path: &str, value: String, allowed: String) -> Error {
    Error::Record {
        path: path.to_owned(),
        value,
        allowed,
    }
}
