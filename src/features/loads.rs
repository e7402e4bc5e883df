//! Extremes of the contact loads, read by probes of their own that leave no columns behind.

use super::Feature;
use crate::model::Race;
use crate::scene::{ContactQuantity, Probe, Scene};
use crate::signals::Signals;

const RACES: [&str; 2] = [Race::Outer.name(), Race::Inner.name()];

/// Name of the probe of a row. One of a user's would have to be named so on purpose.
fn probe_name(row: usize) -> String {
    format!("--features-row{row}")
}

/// The scene with a probe of all contact loads of every row.
pub(crate) fn with_load_probes(scene: &Scene) -> Scene {
    let mut probed = scene.clone();
    probed.probes = scene.recorded().into_owned();
    for row in 0..scene.rows.len() {
        let probe = Probe::Contacts {
            row,
            balls: None,
            races: None,
            quantities: Some(vec![ContactQuantity::Load]),
        };
        probed.probes.insert(probe_name(row), probe);
    }
    probed
}

/// The signals as if `scene` itself had been run.
pub(crate) fn without_load_probes(mut signals: Signals, scene: &Scene) -> Signals {
    let ours: Vec<String> = (0..scene.rows.len())
        .map(|row| probe_name(row) + ".")
        .collect();
    signals
        .columns
        .retain(|column| !ours.iter().any(|name| column.name.starts_with(name)));
    signals.scene.probes.clone_from(&scene.probes);
    signals
}

/// Largest and smallest load of any ball of a row on each race, from a sample on; nothing without the probes.
pub(super) fn extremes(signals: &Signals, first: usize) -> Vec<Feature> {
    let mut found = Vec::new();
    for row in 0..signals.scene.rows.len() {
        for race in RACES {
            let (before, after) = (probe_name(row) + ".", format!(".{race}.load"));
            let mut range: Option<(f64, f64)> = None;
            for column in signals
                .columns
                .iter()
                .filter(|c| c.name.starts_with(&before) && c.name.ends_with(&after))
            {
                for &load in &column.values[first..] {
                    let (low, high) = range.unwrap_or((load, load));
                    range = Some((low.min(load), high.max(load)));
                }
            }
            if let Some((low, high)) = range {
                found.push(Feature::new(format!("row{row}.{race}.load_max"), high));
                found.push(Feature::new(format!("row{row}.{race}.load_min"), low));
            }
        }
    }
    found
}
