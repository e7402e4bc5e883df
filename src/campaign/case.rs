//! The run of one case and its features; all errors become its outcome.

use serde::{Deserialize, Serialize};

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::base::clock;
use crate::base::error::{Error, Result};
use crate::base::interrupt::Interrupt;
use crate::features::{
    Feature, FeatureOptions, Recorded, check, feature_columns, features_of, with_load_probes,
    without_load_probes,
};
use crate::forces::blame;
use crate::run::Run;
use crate::run::simulate_with_progress;
use crate::scene::Scene;
use crate::signals::Signals;

/// A case: what to run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Case {
    /// The scene.
    pub scene: Scene,
    /// Options of the run: how long, how sampled, from what start; its number of threads does not count, it is one.
    pub run: Run,
}

/// The outcome of a case.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Outcome {
    /// Place of the case among all, from 0.
    pub index: usize,
    /// The case's results, or why it failed.
    pub result: Result<Finished>,
    /// Wall time, features included \[s\].
    pub wall_time: f64,
}

/// The results of a case.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Finished {
    /// Features of the case.
    pub features: Vec<Feature>,
    /// Signals of the case.
    pub signals: Signals,
}

impl Case {
    /// A scene and how it is run.
    pub fn new(scene: Scene, run: Run) -> Self {
        Self { scene, run }
    }

    /// Runs it, until done or asked to stop.
    pub(super) fn outcome(
        &self,
        index: usize,
        options: &FeatureOptions,
        stop: &Interrupt,
    ) -> Outcome {
        let begun = clock::now();
        let result = stop.scope(|| guarded(|| self.finish(options, stop)));
        let wall_time = clock::since(begun);
        Outcome {
            index,
            result,
            wall_time,
        }
    }

    fn finish(&self, options: &FeatureOptions, stop: &Interrupt) -> Result<Finished> {
        let run = Run {
            threads: 1,
            ..self.run.clone()
        };
        check(options, &run)?;
        let columns = feature_columns(&self.scene, options)?;
        let mut progress = |_| {
            if stop.is_set() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        if !options.contact_loads {
            let signals = simulate_with_progress(&self.scene, &run, &mut progress)?;
            let features = features_of(&Recorded::from(&signals), &columns, options);
            return Ok(Finished { features, signals });
        }
        let signals = simulate_with_progress(&with_load_probes(&self.scene), &run, &mut progress)?;
        let features = features_of(&Recorded::from(&signals), &columns, options);
        let signals = without_load_probes(signals, &self.scene);
        Ok(Finished { features, signals })
    }
}

/// A panic is a fault of this crate, or of a force of the caller's; of thousands of cases it may cost one.
fn guarded<T>(work: impl FnOnce() -> Result<T>) -> Result<T> {
    blame::forget();
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| {
        let message = blame::message(&*panic);
        Err(blame::blamed(Error::Internal { message }))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::presets;

    #[test]
    fn a_panic_is_an_error_of_its_case() {
        let found = guarded::<()>(|| panic!("ball {} is lost", 3));
        let message = "ball 3 is lost".to_owned();
        assert_eq!(found, Err(Error::Internal { message }));
    }

    /// The static solve itself is stopped: otherwise it would have reported that the load cannot be carried.
    #[test]
    fn a_stop_reaches_the_static_solve_of_a_case() {
        let case = Case {
            scene: presets::wheel_bearing(1e9),
            run: Run::default(),
        };
        let outcome = |stop: &Interrupt| case.outcome(0, &FeatureOptions::default(), stop).result;
        let stop = Interrupt::new();
        assert!(matches!(outcome(&stop), Err(Error::Equilibrium { .. })));
        stop.set();
        assert!(matches!(outcome(&stop), Err(Error::Interrupted { .. })));
    }
}
