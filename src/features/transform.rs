//! Squared envelope and amplitudes of a signal by Fourier transforms; `ballrace.spectra` shows them to Python.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::sync::Arc;

use realfft::num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

use super::moments::sum;

/// Samples of all lengths together whose plans a thread keeps: some 32 MB.
const KEPT: usize = 1 << 20;

/// Plans of transforms. Twiddle factors cost more than the transforms that use them, and signals of a campaign are all of one
/// length, so each thread keeps those of the lengths it has met.
#[derive(Default)]
struct Plans {
    planner: RealFftPlanner<f64>,
    lengths: BTreeSet<usize>,
}

thread_local! {
    static PLANS: RefCell<Plans> = RefCell::default();
}

impl Plans {
    fn planner(&mut self, length: usize) -> &mut RealFftPlanner<f64> {
        if self.lengths.insert(length) && self.lengths.iter().sum::<usize>() > KEPT {
            *self = Self::default();
            self.lengths.insert(length);
        }
        &mut self.planner
    }
}

fn forward(length: usize) -> Arc<dyn RealToComplex<f64>> {
    PLANS.with_borrow_mut(|plans| plans.planner(length).plan_fft_forward(length))
}

fn inverse(length: usize) -> Arc<dyn ComplexToReal<f64>> {
    PLANS.with_borrow_mut(|plans| plans.planner(length).plan_fft_inverse(length))
}

/// The Fourier transform at the frequencies from 0 to half the sampling rate.
fn transformed(mut x: Vec<f64>) -> Vec<Complex64> {
    let plan = forward(x.len());
    let mut lines = plan.make_output_vec();
    let done = plan.process(&mut x, &mut lines);
    done.expect("buffers are of the plan's lengths");
    lines
}

/// The real signal of a length that has given lines.
fn signal_of(mut lines: Vec<Complex64>, length: usize) -> Vec<f64> {
    let plan = inverse(length);
    let mut x = plan.make_output_vec();
    // Mean and Nyquist line of a real signal are real.
    lines[0].im = 0.0;
    if length.is_multiple_of(2) {
        lines[length / 2].im = 0.0;
    }
    let done = plan.process(&mut lines, &mut x);
    done.expect("buffers are of the plan's lengths");
    x
}

/// Squared magnitude of the analytic signal within a band \[Hz\] with sharp edges, by default all frequencies: the signal and
/// its Hilbert transform, whose lines are those of the signal turned by −90° (J. Antoni, R. B. Randall, Mech. Syst. Signal
/// Process. 20 (2006) 308).
pub fn squared_envelope(x: &[f64], fs: f64, band: Option<[f64; 2]>) -> Vec<f64> {
    let count = x.len();
    if count == 0 {
        return Vec::new();
    }
    let scale = 1.0 / count as f64;
    let within = |k: usize| {
        let f = k as f64 * fs / count as f64;
        band.is_none_or(|[low, high]| low <= f && f <= high)
    };
    let lines = transformed(x.to_vec()).into_iter().enumerate();
    let lines: Vec<_> = lines
        .map(|(k, line)| line * if within(k) { scale } else { 0.0 })
        .collect();
    let turned = lines.iter().enumerate().map(|(k, line)| match k {
        // The analytic signal has mean and Nyquist line once, all others twice.
        _ if k == 0 || 2 * k == count => Complex64::default(),
        _ => Complex64::new(line.im, -line.re),
    });
    let hilbert = signal_of(turned.collect(), count);
    let in_band = signal_of(lines, count);
    let both = in_band.iter().zip(&hilbert);
    both.map(|(x, h)| x * x + h * h).collect()
}

/// A signal without its mean, weighed with a Hann window so that the magnitude of its Fourier transform is the amplitude.
pub fn hann_weighted(x: &[f64]) -> Vec<f64> {
    let count = x.len();
    // It adds up to the number of samples, and is the same from both ends.
    let rising = |i: usize| 1.0 - (TAU * (i as f64 + 0.5) / count as f64).cos();
    let half: Vec<f64> = (0..count.div_ceil(2)).map(rising).collect();
    let window = half.iter().chain(half[..count / 2].iter().rev());
    let mut weighted: Vec<f64> = window.clone().zip(x).map(|(w, x)| w * x).collect();
    let mean = sum(&weighted, &|x| x) / count as f64;
    let scale = 2.0 / count as f64;
    for ((weighted, w), x) in weighted.iter_mut().zip(window).zip(x) {
        *weighted = scale * w * (x - mean);
    }
    weighted
}

/// Amplitudes under a Hann window at multiples of fs / `length` from 0 to fs/2, the signal followed by zeros up to that length.
/// A sine of amplitude 2 has a line of height 2.
pub fn amplitudes(x: &[f64], length: usize) -> Vec<f64> {
    let mut weighted = hann_weighted(x);
    weighted.resize(length, 0.0);
    if length == 0 {
        return weighted;
    }
    let lines = transformed(weighted);
    lines.iter().map(|line| line.norm()).collect()
}
