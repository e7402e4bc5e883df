//! Extremes of the contact loads; in a campaign additional probes read them, which add no columns.

use std::ops::Range;

use super::Feature;
use super::batches::Batches;
use super::record::Recorded;
use crate::base::error::{Error, Result};
use crate::scene::{ContactQuantity, ContactsProbe, Probe, RingName, Scene};
use crate::signals::Signals;

const RACES: [RingName; 2] = [RingName::Outer, RingName::Inner];

/// Name of the probe of a row. One of a user's would have to be named so on purpose.
fn probe_name(row: usize) -> String {
    format!("--features-row{row}")
}

/// The scene with a probe of all contact loads of every row.
pub(crate) fn with_load_probes(scene: &Scene) -> Scene {
    let mut probed = scene.clone();
    probed.probes = scene.recorded().into_owned();
    for row in 0..scene.rows.len() {
        let probe = ContactsProbe::of_row(row)
            .quantities([ContactQuantity::Load])
            .into();
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

/// Whether a probe records the load of every ball of a row on a race.
fn records_loads(probe: &Probe, row: usize, race: RingName) -> bool {
    let Probe::Contacts(ContactsProbe {
        row: of,
        balls: None,
        races,
        quantities,
    }) = probe
    else {
        return false;
    };
    let has_race = races.as_ref().is_none_or(|r| r.contains(&race));
    let load = ContactQuantity::Load;
    let has_load = quantities.as_ref().is_none_or(|q| q.contains(&load));
    *of == row && has_race && has_load
}

/// Names of the columns that hold the load of every ball of a row on a race.
///
/// # Errors
/// [`Error::Argument`] if no probe of the scene records them all.
fn columns_of(scene: &Scene, row: usize, race: RingName) -> Result<Vec<String>> {
    let recorded = scene.recorded();
    let Some((name, _)) = recorded
        .iter()
        .find(|(_, probe)| records_loads(probe, row, race))
    else {
        let allowed =
            format!("probes that record the loads of all contacts; none does for row {row}");
        return Err(Error::argument("contact_loads", true, allowed));
    };
    let balls = 0..scene.rows[row].ball_count;
    Ok(balls
        .map(|ball| format!("{name}.ball{ball}.{}.load", label(race)))
        .collect())
}

fn label(race: RingName) -> &'static str {
    match race {
        RingName::Outer => "outer",
        RingName::Inner => "inner",
    }
}

/// Names of all columns that the extremes are read from.
///
/// # Errors
/// [`Error::Argument`] if no probe of the scene records them all.
pub fn columns(scene: &Scene) -> Result<Vec<String>> {
    let mut names = Vec::new();
    for row in 0..scene.rows.len() {
        for race in RACES {
            names.extend(columns_of(scene, row, race)?);
        }
    }
    Ok(names)
}

/// Largest and smallest load of any ball of a row on each race, from a sample on; nothing of what is not recorded.
pub(super) fn extremes(recorded: &Recorded<'_>, first: usize, batches: &Batches) -> Vec<Feature> {
    let mut found = Vec::new();
    for row in 0..recorded.scene.rows.len() {
        for race in RACES {
            let names = columns_of(recorded.scene, row, race).unwrap_or_default();
            let columns = names.iter().filter_map(|name| recorded.get(name));
            let columns: Vec<&[f64]> = columns.map(|values| &values[first..]).collect();
            if columns.is_empty() {
                continue;
            }
            let range = |within: Range<usize>| {
                let loads = columns.iter().flat_map(|values| &values[within.clone()]);
                loads.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], load| {
                    [low.min(*load), high.max(*load)]
                })
            };
            let [low, high] = range(0..columns[0].len());
            let parts = batches.map(range);
            let error = |i: usize| {
                let parts = parts.as_ref().map(|parts| {
                    let extremes: Vec<f64> = parts.iter().map(|part| part[i]).collect();
                    Batches::of_extreme(&extremes)
                });
                Some(parts.unwrap_or(f64::NAN))
            };
            let name = |what: &str| format!("row{row}.{}.{what}", label(race));
            found.extend(Feature::with_error(name("load_max"), high, error(1)));
            found.extend(Feature::with_error(name("load_min"), low, error(0)));
        }
    }
    found
}
