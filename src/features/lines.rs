//! Lines at the fault frequencies of the rows.

use std::f64::consts::TAU;

use rustfft::FftPlanner;

use super::Feature;
use super::spectrum::{Spectrum, squared_envelope};
use crate::scene::{Drive, Scene};

const NAMES: [&str; 4] = ["ftf", "bpfo", "bpfi", "bsf"];

/// A line is sought this far from its kinematic frequency: the operating contact angle differs from the
/// nominal one, by 10° at most, and the balls slip a little.
const SHARE: f64 = 0.02;

/// A line nearer to 0 than this many bins drowns in the Hann window's main lobe around it.
const BINS: f64 = 2.0;

/// Fault frequencies of every row \[Hz\]: cage (FTF), balls passing a place of the outer and of the inner race
/// (BPFO, BPFI), spin of a ball (BSF). Absent where the speed is not known beforehand or changes by more than
/// the width in which a line is sought.
pub(super) fn fault_frequencies(scene: &Scene, from: f64, to: f64) -> Vec<Option<[f64; 4]>> {
    let shaft = shaft_frequency(scene, from, to);
    let rows = scene.rows.iter();
    rows.map(|row| shaft.map(|shaft| row.orders().map(|order| order * shaft)))
        .collect()
}

/// Mean of the given speed over a part of the run \[Hz\].
fn shaft_frequency(scene: &Scene, from: f64, to: f64) -> Option<f64> {
    let Drive::Speed(speed) = &scene.drive else {
        return None;
    };
    let places = (0..=1000).map(|i| from + (to - from) * f64::from(i) / 1000.0);
    let speeds: Vec<f64> = places.map(|t| speed.at(t) / TAU).collect();
    let mean = speeds.iter().sum::<f64>() / speeds.len() as f64;
    let steady = speeds
        .iter()
        .all(|s| (s - mean).abs() <= SHARE * mean.abs());
    steady.then_some(mean.abs())
}

/// Lines of a signal and of its squared envelope at the frequencies of every row.
pub(super) fn of(
    planner: &mut FftPlanner<f64>,
    name: &str,
    x: &[f64],
    fs: f64,
    band: Option<[f64; 2]>,
    faults: &[Option<[f64; 4]>],
) -> Vec<Feature> {
    let bin = fs / x.len() as f64;
    let plain = Spectrum::new(planner, x, fs);
    let envelope = {
        let envelope = squared_envelope(planner, x, fs, band);
        Spectrum::new(planner, &envelope, fs)
    };
    let mut found = Vec::new();
    for (row, frequencies) in faults.iter().enumerate() {
        for (i, fault) in NAMES.iter().enumerate() {
            let near = frequencies
                .map(|f| (f[i], (SHARE * f[i]).max(bin)))
                .filter(|(f, width)| *f >= BINS * bin && f + width + bin < fs / 2.0);
            for (suffix, spectrum) in [("", &plain), ("_envelope", &envelope)] {
                found.push(Feature {
                    name: format!("{name}.row{row}.{fault}{suffix}"),
                    value: near.map(|(f, width)| spectrum.highest(f - width, f + width)),
                });
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::presets;

    /// Literature: orders of the bearing 6205 of the Case Western Reserve data, BPFO 3.5848, BPFI 5.4152,
    /// FTF 0.3983, twice BSF 4.7135 of the ball diameter 7.94 mm on 39.04 mm.
    #[test]
    fn orders_of_the_6205() {
        let mut row = presets::deep_groove_6205(500.0, 0.0, 1800.0).rows[0].clone();
        (row.ball_count, row.contact_angle) = (9, 0.0);
        (row.ball_diameter, row.pitch_diameter) = (7.94e-3, 39.04e-3);
        let found = row.orders();
        for (found, wanted) in found
            .into_iter()
            .zip([0.3983, 3.5848, 5.4152, 4.7135 / 2.0])
        {
            assert!((found - wanted).abs() < 6e-5, "{found} {wanted}");
        }
    }

    /// A record too short for a line has none, and says so for every name.
    #[test]
    fn a_short_record_has_no_lines() {
        let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        let faults = fault_frequencies(&scene, 0.0, 1e-3);
        let found = of(&mut FftPlanner::new(), "x", &[1.0; 50], 50e3, None, &faults);
        assert_eq!(found.len(), 8);
        assert!(found.iter().all(|f| f.value.is_none()));
    }
}
