//! The squared envelope of a record and its spectrum.

use super::samples::check_samples;
use super::transform::{amplitudes, squared_envelope as envelope};
use super::{FeatureOptions, check_record};
use crate::base::error::Result;

/// The squared envelope of a signal within a band \[Hz\] with sharp edges, by default all frequencies: the square of its analytic
/// signal's magnitude, in the unit of `x` squared.
///
/// `fs` is the sampling rate \[Hz\]. The first and the last few periods of the lower edge carry the filter's ringing (J. Antoni,
/// R. B. Randall, Mech. Syst. Signal Process. 20 (2006) 308).
///
/// # Errors
/// [`Error::Record`](crate::Error::Record) for samples that are not finite, [`Error::Argument`](crate::Error::Argument) for a sampling rate that is none,
/// or a band beyond it.
pub fn squared_envelope(x: &[f64], fs: f64, band: Option<[f64; 2]>) -> Result<Vec<f64>> {
    let options = FeatureOptions {
        band,
        ..FeatureOptions::default()
    };
    check_record(&options, x.len() as f64 / fs, fs)?;
    check_samples("x", x)?;
    Ok(envelope(x, fs, band))
}

/// The spectrum of the squared envelope of a signal within a band: frequencies from 0 to fs/2 \[Hz\], and amplitudes in the unit of `x`
/// squared. A defect's impacts have lines there at their rate ([`crate::fault_frequencies()`]) and its multiples.
///
/// ```
/// use std::f64::consts::TAU;
/// // Resonance at 200 Hz that something excites 20 times a second: the square of 1 + 0.5 cos has a line of height 1.
/// let burst = |t: f64| (1.0 + 0.5 * (TAU * 20.0 * t).cos()) * (TAU * 200.0 * t).sin();
/// let x: Vec<f64> = (0..1000).map(|i| burst(f64::from(i) / 1000.0)).collect();
/// let (f, value) = ballrace::squared_envelope_spectrum(&x, 1000.0, Some([150.0, 250.0]))?;
/// assert!(f[20] == 20.0 && (value[20] - 1.0).abs() < 1e-9);
/// # Ok::<(), ballrace::Error>(())
/// ```
///
/// # Errors
/// As [`squared_envelope()`].
pub fn squared_envelope_spectrum(
    x: &[f64],
    fs: f64,
    band: Option<[f64; 2]>,
) -> Result<(Vec<f64>, Vec<f64>)> {
    let envelope = squared_envelope(x, fs, band)?;
    let value = amplitudes(&envelope, envelope.len());
    let spacing = fs / x.len() as f64;
    let f = (0..value.len()).map(|k| k as f64 * spacing).collect();
    Ok((f, value))
}
