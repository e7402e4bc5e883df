//! One knob: nodes, tolerance and step cap for a requested accuracy of the accelerations.

use serde::Serialize;

use crate::error::{Error, Result};
use crate::model::Model;
use crate::scene::{Method, Scene, Slices};

/// What a run with a requested accuracy chose, and what it expects of that.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Accuracy {
    /// Relative error of the outer ring's acceleration that was asked for, root mean square over the predictable
    /// horizon of some milliseconds from a given state.
    pub requested: f64,
    /// Relative tolerance chosen.
    pub rtol: f64,
    /// Largest step over 1/ω of the highest contact frequency.
    pub step_share: f64,
    /// Nodes or slices of a contact with the outer and with the inner race.
    pub nodes: [usize; 2],
    /// Error of contact and friction force on either race over the normal force, measured when the scene was
    /// compiled; absent with fixed slices, which are kept as they are.
    pub force_error: Option<[f64; 2]>,
    /// Error of the integration that steps of this size leave.
    pub integration_error: f64,
}

/// Error of the acceleration after 6 ms with an impact for steps of 1/ω, and the power of the step that it goes
/// with: measured on the faulted wheel bearing with Dormand–Prince, 2e-5 at half of it, 3e-3 at twice.
const ERROR: f64 = 3e-4;
const ORDER: f64 = 3.5;
/// Largest step over 1/ω: beyond it the method is not stable.
const LARGEST: f64 = 2.0;

// On 24 random bearings asked for 1 % (`tests/accuracy.rs`) these shares met it in 24, ten times the force and a
// hundred times the tolerance in 20. The worst of a hundred scenes is far from the usual one: quiet signals are small
// differences of large forces, and edges met at speed want short steps.
/// Share of the request that is left to the step cap.
const MARGIN: f64 = 0.05;
/// Tolerance over the request, and the tightest.
const TOLERANCE: (f64, f64) = (1e-6, 1e-10);
/// Error of a force over the request, and the least that is asked for.
const FORCE: (f64, f64) = (1e-6, 1e-9);

/// Checks a request and puts nodes, tolerance and step share into a scene; returns the share.
pub(crate) fn apply(requested: f64, scene: &mut Scene) -> Result<f64> {
    if !(1e-4..=1e-1).contains(&requested) {
        return Err(Error::scene("accuracy", requested, "1e-4 to 1e-1"));
    }
    if scene.solver.method != Method::DormandPrince {
        let allowed =
            "dormand-prince where `accuracy` is given: its choice is measured on that method";
        return Err(Error::scene(
            "method",
            format!("{:?}", scene.solver.method),
            allowed,
        ));
    }
    scene.solver.rtol = (TOLERANCE.0 * requested).max(TOLERANCE.1);
    if !matches!(scene.contact.slices, Slices::Fixed(_)) {
        scene.contact.slices = Slices::Accuracy((FORCE.0 * requested).max(FORCE.1));
    }
    Ok((MARGIN * requested / ERROR).powf(1.0 / ORDER).min(LARGEST))
}

impl Accuracy {
    /// What a model and a step share give.
    pub(crate) fn of(requested: f64, model: &Model, step_share: f64) -> Self {
        Self {
            requested,
            rtol: model.scene.solver.rtol,
            step_share,
            nodes: model.slices(),
            force_error: model.force_error,
            integration_error: ERROR * step_share.powf(ORDER),
        }
    }
}
