//! Lines at the fault frequencies of the rows, with their harmonics and sidebands.

use super::shaft::{RingTurns, SHARE, Shaft};
use super::spectrum::Spectrum;
use super::transform::squared_envelope;
use super::{Feature, named};
use crate::scene::{Orders, Row};
use crate::signals::kinematics::RowKinematics;

/// A line is sought this far from its measured frequency: a part of the run has a mean of its own.
const MEASURED: f64 = 0.005;

/// A line nearer to 0 than this many bins drowns in the Hann window's main lobe around it.
const BINS: f64 = 2.0;

/// Harmonics of a line that are added up, itself the first.
const HARMONICS: u8 = 3;

/// The line of a fault.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FaultOrder {
    pub name: &'static str,
    /// Order of the fault in turns of the shaft against the outer ring.
    pub order: f64,
    /// How far from there its line is sought, as a share of it.
    share: f64,
    /// Distance of its sidebands, where what turns past the load makes it stronger and weaker: the ring for a race, the cage for a
    /// ball. Loads stand in space; 0 of a ring that stands, though its speed is given.
    sidebands: Option<f64>,
}

/// The faults of a row by their orders: the cage's in space, those of balls that pass a place of the outer and of the inner race, and
/// of places of a ball that pass a race: it meets both in a turn, so twice the ball's spin. They are what the row did, or, of a
/// record without measured kinematics, those of pure rolling at the nominal contact angle.
pub(super) fn faults(row: &Row, did: Option<&RowKinematics>, turns: RingTurns) -> [FaultOrder; 4] {
    let Orders {
        ftf,
        bpfo,
        bpfi,
        bsf,
    } = row.geometry().orders();
    let measured = did.map(|did| did.orders(row.ball_count));
    let ([ftf, bpfo, bpfi], share) =
        measured.map_or(([ftf, bpfo, bpfi], SHARE), |(orders, _)| (orders, MEASURED));
    let spin = measured.and_then(|(_, spin)| spin);
    let (bsf, share_of_ball) = spin.map_or((bsf, SHARE), |spin| (spin, MEASURED));
    // The cage goes round with the outer ring.
    let ftf = turns.outer.map_or(ftf, |outer| (ftf + outer).abs());
    let fault = |name, order, sidebands| FaultOrder {
        name,
        order,
        share,
        sidebands,
    };
    [
        fault("ftf", ftf, None),
        fault("bpfo", bpfo, turns.outer.map(f64::abs)),
        fault("bpfi", bpfi, Some(turns.inner.abs())),
        FaultOrder {
            share: share_of_ball,
            ..fault("2bsf", 2.0 * bsf, Some(ftf))
        },
    ]
}

/// A bearing's record, of whose signals lines are sought.
pub(super) struct LineSearch<'a> {
    pub rows: &'a [Row],
    pub kinematics: &'a [RowKinematics],
    pub turns: RingTurns,
    /// Absent where its speed is not known.
    pub shaft: Option<&'a Shaft>,
    /// Sampling rate, and the band of the envelope \[Hz\].
    pub fs: f64,
    pub band: Option<[f64; 2]>,
    /// Whether the record is long and steady enough for standard errors.
    pub certain: bool,
}

/// Lines of a signal and of its squared envelope at the frequencies of every row; without values where the speed of the
/// shaft is not known.
pub(super) fn of(name: &str, x: &[f64], search: &LineSearch<'_>) -> Vec<Feature> {
    let &LineSearch { fs, band, .. } = search;
    let spectra = search.shaft.map(|shaft| {
        let envelope = squared_envelope(x, fs, band);
        let spectrum = |x: &[f64]| {
            let (x, rate) = shaft.by_angle(x, fs);
            let bin = rate / x.len() as f64;
            (Spectrum::new(&x, rate), shaft.frequency(), bin)
        };
        [spectrum(x), spectrum(&envelope)]
    });
    let mut found = Vec::new();
    for (row, of) in search.rows.iter().enumerate() {
        let did = search.kinematics.iter().find(|did| did.row == row);
        for fault in faults(of, did, search.turns) {
            for (i, suffix) in ["", "_envelope"].into_iter().enumerate() {
                let lines = spectra.as_ref().map(|spectra| {
                    let (spectrum, shaft, bin) = &spectra[i];
                    Lines::of(&fault, spectrum, *shaft, *bin)
                });
                let prefix = named(name, &format!("row{row}.{}{suffix}", fault.name));
                found.extend(Lines::features(
                    lines.flatten().as_ref(),
                    &prefix,
                    &fault,
                    search.certain,
                ));
            }
        }
    }
    found
}

/// Lines of a spectrum at a fault's frequency.
struct Lines {
    line: f64,
    /// Root of the sum of the squares of the line and its harmonics.
    harmonics: f64,
    /// The same of the two sidebands.
    sidebands: f64,
    /// Standard errors of the lines.
    errors: [f64; 3],
}

/// An amplitude and its standard error.
type Amplitude = (f64, f64);

/// Times its standard error that a line stands out of the noise, so that its place is known, and with it those of its harmonics
/// and sidebands: of another they are read at a random place, which their error does not include.
const STANDS_OUT: f64 = 3.0;

/// Root of the sum of the squares of some lines. Pulses that vary in height change all their harmonics together.
fn together(lines: &[Amplitude]) -> Amplitude {
    let sum = |of: &dyn Fn(&Amplitude) -> f64| lines.iter().map(of).sum::<f64>();
    let root = sum(&|(line, _)| line * line).sqrt();
    let error = sum(&|(line, error)| line * error) / root;
    (root, if root > 0.0 { error } else { 0.0 })
}

impl Lines {
    /// The lines in a spectrum over units in which the shaft has a frequency and a record has a bin. Absent where the record is too
    /// short for the line, or sampled too slowly.
    fn of(fault: &FaultOrder, spectrum: &Spectrum, shaft: f64, bin: f64) -> Option<Self> {
        let near = fault.order * shaft;
        let width = (fault.share * near).max(bin);
        let top = spectrum.top();
        if near < BINS * bin || near + width + bin >= top {
            return None;
        }
        let (place, line) = spectrum.highest(near - width, near + width);
        let with_error = |(place, line)| (line, spectrum.error(place, bin).unwrap_or(f64::NAN));
        let beside = |f: f64| {
            let inside = f >= BINS * bin && f + 2.0 * bin < top;
            inside.then(|| with_error(spectrum.highest(f - bin, f + bin)))
        };
        let line = with_error((place, line));
        let higher = (2..=HARMONICS).filter_map(|k| beside(place * f64::from(k)));
        let family: Vec<Amplitude> = std::iter::once(line).chain(higher).collect();
        let distance = fault.sidebands.unwrap_or(0.0) * shaft;
        let sides = [place - distance, place + distance].map(beside);
        let sides: Vec<Amplitude> = sides.into_iter().flatten().collect();
        let (harmonics, mut sidebands) = (together(&family), together(&sides));
        if distance == 0.0 {
            sidebands = (f64::NAN, f64::NAN);
        }
        let stands_out = line.0 > STANDS_OUT * line.1;
        let known = |error: f64| if stands_out { error } else { f64::NAN };
        Some(Self {
            line: line.0,
            harmonics: harmonics.0,
            sidebands: sidebands.0,
            errors: [line.1, known(harmonics.1), known(sidebands.1)],
        })
    }

    /// Standard errors have a value where `certain`.
    fn features(
        lines: Option<&Self>,
        prefix: &str,
        fault: &FaultOrder,
        certain: bool,
    ) -> Vec<Feature> {
        let mut features = Vec::new();
        let mut add = |suffix: &str, value: fn(&Self) -> f64, error: usize| {
            let value = lines.map_or(f64::NAN, value);
            let error = lines.filter(|_| certain).map(|lines| lines.errors[error]);
            let error = error.unwrap_or(f64::NAN);
            let name = format!("{prefix}{suffix}");
            features.extend(Feature::with_error(name, value, Some(error)));
        };
        add("", |lines| lines.line, 0);
        add("_harmonics", |lines| lines.harmonics, 1);
        if fault.sidebands.is_some() {
            add("_sidebands", |lines| lines.sidebands, 2);
        }
        features
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::super::noise::uniform;
    use super::*;
    use crate::scene::{Drive, Profile, Scene, TimeFunction, presets};

    fn scene() -> Scene {
        presets::deep_groove_6205(500.0, 0.0, 1800.0)
    }

    fn features(scene: &Scene, x: &[f64], fs: f64) -> Vec<Feature> {
        let shaft = Shaft::of(scene, 0.0, x.len(), fs);
        let search = LineSearch {
            rows: &scene.rows,
            kinematics: &[],
            turns: RingTurns::INNER,
            shaft: shaft.as_ref(),
            fs,
            band: None,
            certain: true,
        };
        of("x", x, &search)
    }

    fn lines(scene: &Scene, x: &[f64], fs: f64) -> impl Fn(&str) -> Option<f64> + use<> {
        let found = features(scene, x, fs);
        move |name: &str| {
            let wanted = format!("x.row0.{name}");
            let feature = found.iter().find(|feature| feature.name == wanted);
            feature.unwrap_or_else(|| panic!("{wanted}")).value
        }
    }

    /// Literature: orders of the bearing 6205 of the Case Western Reserve data, BPFO 3.5848, BPFI 5.4152,
    /// FTF 0.3983, twice BSF 4.7135 of the ball diameter 7.94 mm on 39.04 mm.
    #[test]
    fn orders_of_the_6205() {
        let found = faults(&scene().rows[0], None, RingTurns::INNER);
        for (found, wanted) in found.into_iter().zip([0.3983, 3.5848, 5.4152, 4.7135]) {
            assert!((found.order - wanted).abs() < 6e-5, "{found:?} {wanted}");
        }
    }

    /// A record too short for a line has none, and says so for every name.
    #[test]
    fn a_short_record_has_no_lines() {
        let found = features(&scene(), &[1.0; 50], 50e3);
        assert_eq!(found.len(), 2 * 2 * (2 + 2 + 3 + 3));
        assert!(found.iter().all(|f| f.value.is_none()));
    }

    /// Analytic: amplitudes 2, 1 and 0.5 at BPFI and its harmonics, 0.6 and 0.8 a turn of the shaft beside it.
    #[test]
    fn a_family_is_added_up() {
        let (scene, fs, shaft) = (scene(), 20e3, 30.0);
        let inner = faults(&scene.rows[0], None, RingTurns::INNER)[2].order * shaft;
        let parts = [
            (2.0, inner),
            (1.0, 2.0 * inner),
            (0.5, 3.0 * inner),
            (0.6, inner - shaft),
            (0.8, inner + shaft),
        ];
        let x: Vec<f64> = (0..20_000)
            .map(|i| f64::from(i) / fs)
            .map(|t| parts.iter().map(|(a, f)| a * (TAU * f * t).sin()).sum())
            .collect();
        let found = lines(&scene, &x, fs);
        for (name, wanted) in [
            ("bpfi", 2.0),
            ("bpfi_harmonics", 5.25_f64.sqrt()),
            ("bpfi_sidebands", 1.0),
        ] {
            let value = found(name).unwrap();
            assert!((value / wanted - 1.0).abs() < 2e-3, "{name}: {value}");
        }
        assert!(found("bpfo").unwrap() < 0.02);
    }

    /// Analytic: in white noise of variance σ² an amplitude under the Hann window has a variance of 2σ²/n · 3/2, both in the record and
    /// as reported, of the line and of its family. For the family more is reported, (2 + 1 + 0.5)/√5.25 times, since lines of amplitudes
    /// 2, 1 and 0.5 are taken to vary together. A line without noise has no error, and one below the noise no family.
    #[test]
    fn a_line_in_noise_is_as_uncertain_as_reported() {
        let (scene, fs, count) = (scene(), 20e3, 10_000);
        let outer = faults(&scene.rows[0], None, RingTurns::INNER)[1].order * 30.0;
        let mut uniform = uniform(11);
        let mut record = |sigma: f64| -> Vec<f64> {
            (0..count)
                .map(|i| {
                    let angle = TAU * outer * f64::from(i) / fs;
                    let line = 2.0 * angle.sin() + (2.0 * angle).sin() + 0.5 * (3.0 * angle).sin();
                    // Uniform noise of variance 1.
                    line + sigma * 12.0_f64.sqrt() * (uniform() - 0.5)
                })
                .collect()
        };
        let theory = (3.0 / f64::from(count)).sqrt();
        let mut all = Vec::new();
        for _ in 0..100 {
            let found = lines(&scene, &record(1.0), fs);
            all.push(
                ["bpfo", "bpfo_se", "bpfo_harmonics", "bpfo_harmonics_se"]
                    .map(|name| found(name).unwrap()),
            );
        }
        let mean = |i: usize| all.iter().map(|line| line[i]).sum::<f64>() / 100.0;
        let spread = |i: usize| {
            let squares = all.iter().map(|line| (line[i] - mean(i)).powi(2));
            (squares.sum::<f64>() / 99.0).sqrt()
        };
        for (i, factor) in [(0, 1.0), (2, 3.5 / 5.25_f64.sqrt())] {
            let (spread, reported) = (spread(i), mean(i + 1) / factor);
            assert!((spread / theory - 1.0).abs() < 0.2, "{spread} {theory}");
            assert!(
                (reported / theory - 1.0).abs() < 0.15,
                "{reported} {theory}"
            );
        }
        let lost = lines(&scene, &record(100.0), fs);
        assert!(lost("bpfo_se").is_some() && lost("bpfo_harmonics_se").is_none());
        let clean = lines(&scene, &record(0.0), fs);
        assert!(clean("bpfo_se").unwrap() < 1e-3 * clean("bpfo").unwrap());
    }

    /// Analytic: a fault strikes at its order of a shaft that runs up from 20 to 40 Hz; in time it has no line.
    #[test]
    fn a_run_up_has_lines_over_the_angle() {
        let (mut scene, fs, count) = (scene(), 20e3, 20_000);
        scene.drive = Drive::Speed(TimeFunction::Profile(Profile::Ramp {
            from: TAU * 20.0,
            to: TAU * 40.0,
            start: 0.0,
            end: 1.0,
        }));
        let outer = faults(&scene.rows[0], None, RingTurns::INNER)[1].order;
        let x: Vec<f64> = (0..count)
            .map(|i| f64::from(i) / fs)
            .map(|t| 3.0 * (TAU * outer * (20.0 * t + 10.0 * t * t)).sin())
            .collect();
        let value = lines(&scene, &x, fs)("bpfo").unwrap();
        assert!((value / 3.0 - 1.0).abs() < 2e-3, "{value}");
        // From rest on, and back to it: from where a turn has twenty times the samples of the fastest.
        let rises = [(0.0, 40.0, 1.0), (0.0, 40.0, 0.5), (40.0, 0.0, 1.0)];
        for (from, to, end) in rises {
            let speed = Profile::Ramp {
                from: TAU * from,
                to: TAU * to,
                start: 0.0,
                end,
            };
            scene.drive = Drive::Speed(TimeFunction::Profile(speed));
            let turned = |t: f64| {
                let ramp = t.min(end);
                from * ramp + (to - from) * ramp * ramp / (2.0 * end) + to * (t - ramp)
            };
            let x: Vec<f64> = (0..count)
                .map(|i| 3.0 * (TAU * outer * turned(f64::from(i) / fs)).sin())
                .collect();
            let value = lines(&scene, &x, fs)("bpfo").unwrap();
            assert!((value / 3.0 - 1.0).abs() < 1e-2, "{from} {to}: {value}");
            let shaft = Shaft::of(&scene, 0.0, x.len(), fs).unwrap();
            let begins = if from == 0.0 { 0.05 * end } else { 0.0 };
            assert!((shaft.first() as f64 / fs - begins).abs() < 2.0 / fs);
        }
        // One that turns back has no turns.
        scene.drive = Drive::Speed(TimeFunction::Profile(Profile::Ramp {
            from: -TAU * 20.0,
            to: TAU * 40.0,
            start: 0.0,
            end: 1.0,
        }));
        assert_eq!(lines(&scene, &x, fs)("bpfo"), None);
        scene.drive = Drive::Torque {
            value: 1.0.into(),
            initial_speed: 100.0,
        };
        assert_eq!(lines(&scene, &x, fs)("bpfo"), None);
    }
}
