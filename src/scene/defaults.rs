//! Defaults as functions, as serde needs them.

pub(super) fn schema() -> u32 {
    super::SCHEMA
}

pub(super) fn side() -> i8 {
    1
}

pub(super) fn gravity() -> [f64; 3] {
    [0.0, -9.81, 0.0]
}
