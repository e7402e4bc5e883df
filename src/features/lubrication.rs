//! Least films, mean friction torque and mean losses, of what probes of a row's oil have recorded.

use super::Feature;
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
pub(super) fn of(recorded: &Recorded<'_>, first: usize) -> Vec<Feature> {
    let found = columns(recorded.scene).into_iter().filter_map(|name| {
        let values = &recorded.get(&name)?[first..];
        let is_film = matches!(name.rsplit('.').next(), Some("film" | "lambda"));
        Some(if is_film {
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            Feature::new(format!("{name}_min"), least)
        } else {
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            Feature::new(format!("{name}_mean"), mean)
        })
    });
    found.collect()
}
