//! Provenance: what a run records about the origin of its signals.

use super::Run;
use super::method;
use super::prepare::Prepared;
use super::step_limit;
use crate::inspect::films;
use crate::integrate::Options;
use crate::model::Model;
use crate::reduction::Reduction;
use crate::scene::SCHEMA;
use crate::signals::kinematics::RowKinematics;
use crate::signals::touched::Touched;
use crate::signals::{Provenance, Sampling};
use crate::simd::Distrust;
use crate::statics::at_speed;
use crate::statics::start::Start;

/// A run that is done.
pub(super) struct Done<'a> {
    pub prepared: &'a Prepared,
    pub model: &'a Model,
    pub distrust: Option<Distrust>,
    pub sampling: Sampling,
    pub threads: usize,
    pub options: &'a Options,
    pub reduction: Option<Reduction>,
    pub defects: Vec<Touched>,
    pub kinematics: Vec<RowKinematics>,
}

/// The provenance of a run.
pub(super) fn provenance(run: &Run, done: Done<'_>) -> Provenance {
    let (model, solver) = (done.model, &done.prepared.scene.solver);
    let start = match run.start {
        Start::Equilibrium => "equilibrium",
        Start::Rolling => "rolling",
        Start::State(_) => "state",
    };
    let (axis, at_rest) = at_speed(&done.prepared.scene).unwrap_or_default();
    Provenance {
        axis,
        at_rest,
        version: env!("CARGO_PKG_VERSION").into(),
        schema: SCHEMA,
        method: method::name(solver.method).to_owned(),
        rtol: model.fineness.rtol,
        by_band: model.fineness.by_band,
        accuracy: done.prepared.accuracy,
        max_step: Some(done.options.max_step).filter(|h| h.is_finite()),
        start: start.into(),
        duration: run.duration,
        threads: done.threads,
        states: done.reduction.as_ref().map_or(model.dim(), Reduction::dim),
        left_out: done
            .reduction
            .as_ref()
            .map_or_else(Vec::new, |reduction| reduction.omissions().to_vec()),
        simd: model.instructions().name().into(),
        distrust: done.distrust,
        architecture: std::env::consts::ARCH.into(),
        bandwidth: done.sampling.bandwidth,
        oversampling: done.sampling.oversampling,
        settled: done.prepared.settled.seconds,
        defects: done.defects,
        kinematics: done.kinematics,
        films: films(model),
        step_limit: step_limit::largest(solver.method, model),
    }
}
