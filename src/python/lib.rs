//! The module `ballrace._core`: thin, and the only code that uses `pyo3`.
//!
//! A scene is passed as JSON, an array as a numpy array that takes over the vector's memory, an error as
//! an exception of `ballrace.errors`. Everything that users call is in `python/ballrace`.

mod answer;
mod campaign;
mod errors;
mod features;
mod forces;
mod oil;
mod run;
mod scene;
mod simulation;
mod statics;

use pyo3::prelude::*;

/// Compiled core of ballrace; use the package `ballrace` instead.
#[pymodule]
mod _core {
    #[pymodule_export]
    use super::campaign::{available_threads, campaign, check_run, instruction_sets};
    #[pymodule_export]
    use super::features::{
        amplitudes, axis_ratio, by_order, check_samples, feature_columns, hann_weighted, orders,
        rolling_frequencies, run_features, signal_features, squared_envelope, turning,
    };
    #[pymodule_export]
    use super::oil::{named_oils, oil};
    #[pymodule_export]
    use super::run::{CompiledScene, explain, run_from_json, simulate};
    #[pymodule_export]
    use super::scene::{
        preset_angular_contact_pair, preset_cornering_wheel, preset_deep_groove_6205,
        preset_wheel_bearing, scene_doubts, scene_from_json, scene_from_toml, scene_ranges,
        scene_replace, scene_to_toml, time_values,
    };
    #[pymodule_export]
    use super::simulation::GoingRun;
    #[pymodule_export]
    use super::statics::{
        axis_held, dynamic_coefficients, equilibrium, fault_frequencies, load_distribution, placed,
        rolling, stiffness,
    };
}
