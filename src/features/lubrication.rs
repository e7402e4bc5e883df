//! Least films, mean friction torque and mean losses, from the probes of a row's oil.

use super::Feature;
use super::batches::Batches;
use super::record::Recorded;
use crate::inspect::Lubrication;
use crate::scene::{Probe, Scene};

/// Names of all columns that these features are read from.
pub fn columns(scene: &Scene) -> Vec<String> {
    let recorded = scene.recorded();
    let oils = recorded
        .iter()
        .filter(|(_, probe)| matches!(probe, Probe::Lubrication { .. }));
    oils.flat_map(|(name, _)| Lubrication::LABELS.map(|(label, _)| format!("{name}.{label}")))
        .collect()
}

/// The least film and λ, the mean of torque and losses, from a sample on; nothing of what is not recorded.
pub(super) fn of(recorded: &Recorded<'_>, first: usize, batches: &Batches) -> Vec<Feature> {
    let mut found = Vec::new();
    for name in columns(recorded.scene) {
        let Some(values) = recorded.get(&name).map(|values| &values[first..]) else {
            continue;
        };
        let is_film = matches!(name.rsplit('.').next(), Some("film" | "lambda"));
        let of = if is_film { least } else { mean };
        let error = batches
            .map(|range| of(&values[range]))
            .map_or(f64::NAN, |parts| {
                if is_film {
                    Batches::of_extreme(&parts)
                } else {
                    batches.of_mean(&parts)
                }
            });
        let name = format!("{name}_{}", if is_film { "min" } else { "mean" });
        found.extend(Feature::with_error(name, of(values), Some(error)));
    }
    found
}

fn least(x: &[f64]) -> f64 {
    x.iter().copied().fold(f64::INFINITY, f64::min)
}

fn mean(x: &[f64]) -> f64 {
    x.iter().sum::<f64>() / x.len() as f64
}
