//! The relative speed of the rings, on which films depend.

/// Powers of w̃ that films need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SpeedPowers {
    /// w̃ = √(w² + 1/400).
    pub ratio: f64,
    /// X = w̃^{2/3}.
    pub two_thirds: f64,
    /// Y = w̃^{3/4}.
    pub three_quarters: f64,
}

impl SpeedPowers {
    /// The rings' speed over the reference speed: its floor keeps films smooth through standstill (12.9).
    pub fn new(w: f64) -> Self {
        let ratio = (w * w + 1.0 / 400.0).sqrt();
        let root = ratio.sqrt();
        Self {
            ratio,
            two_thirds: ratio.cbrt().powi(2),
            three_quarters: root * root.sqrt(),
        }
    }
}
