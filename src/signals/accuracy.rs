//! Report of a run on the requested accuracy.

use serde::{Deserialize, Serialize};

/// Choice of a run with a requested accuracy, and what it expects of that; errors that are larger together are warned of.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Accuracy {
    /// Relative error of the outer ring's vertical acceleration that was asked for, root mean square over the
    /// predictable horizon of some milliseconds from a given state.
    pub requested: f64,
    /// Relative tolerance chosen.
    pub rtol: f64,
    /// Nodes or slices of a contact with the outer and with the inner race.
    pub nodes: [usize; 2],
    /// Difference to a pilot run of a tenth of the tolerance; of the tightest, to ten times its own.
    pub integration_error: f64,
    /// Difference to a pilot run on the next more nodes; absent with fixed slices, which are kept as they are.
    pub node_error: Option<f64>,
    /// Evaluations that the pilot runs took.
    pub pilot_evaluations: usize,
}
