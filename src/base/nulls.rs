//! Numbers that are none in a document. JSON has no word for NaN and infinities: `null` stands for both, and is read as NaN.

use serde::{Deserialize, Deserializer};

/// A number that may be none.
struct Nullable(f64);

impl<'de> Deserialize<'de> for Nullable {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        // Formats that are not for people write a number as it is, without a mark that it is there.
        if from.is_human_readable() {
            let found = Option::<f64>::deserialize(from)?;
            Ok(Self(found.unwrap_or(f64::NAN)))
        } else {
            f64::deserialize(from).map(Self)
        }
    }
}

/// Reads a number that may be none.
pub fn number<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Nullable::deserialize(from).map(|number| number.0)
}

/// Reads two numbers that may be none.
pub fn pair<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 2], D::Error> {
    <[Nullable; 2]>::deserialize(from).map(|pair| pair.map(|number| number.0))
}

/// Reads numbers that may be none.
pub fn numbers<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    let found = Vec::<Nullable>::deserialize(from)?;
    Ok(found.into_iter().map(|number| number.0).collect())
}
