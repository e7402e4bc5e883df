//! The low-pass through which signals are decimated.
//!
//! A sinc under a Kaiser window, with time in samples of the output, f_c = 1/2 of their rate and q = β² (1 − u²)/4:
//!
//! ```text
//! h(t) = sinc(t) w(u),   w(u) = I₀(β √(1 − u²)) / I₀(β) = Σ qᵏ/k!² / I₀(β),   u = t / T
//! ```
//!
//! On a grid of M points a sample these are the coefficients of `scipy.signal.firwin(2 · HALF · M − 1, fs / 2,
//! window=("kaiser", BETA), fs=M · fs)`; M is known only when a run begins. They are symmetric: no frequency is
//! delayed against another, and the delay is none since a sample takes from both sides of its time. Flat within
//! 0.004 dB up to 0.4 fs, 83 dB down beyond 0.6 fs; what lies between is folded into the band above 0.4 fs.
//!
//! An acceleration is the filtered derivative of a velocity, and so the velocity filtered by the derivative h′(t):
//! no evaluation of the model is needed for it.
//!
//! Source: J. F. Kaiser, *Nonrecursive digital filter design using the I₀-sinh window function*, IEEE ISCAS 1974;
//! A. V. Oppenheim, R. W. Schafer, *Discrete-Time Signal Processing*, 3rd ed., section 7.5.3.

use std::f64::consts::PI;

/// Samples of the output from the middle of the filter to either end.
pub(super) const HALF: usize = 14;
/// Kaiser's β for 84 dB: 0.1102 (84 − 8.7).
const BETA: f64 = 8.298_06;
/// Share of the sampling rate up to which the filter is flat.
pub(super) const FLAT: f64 = 0.4;

/// The coefficients for one grid.
///
/// They stand phase by phase: what a point of the grid gives to the `2 · HALF` samples around it, in their order.
#[derive(Debug, Clone)]
pub(super) struct Taps {
    oversampling: usize,
    smooth: Vec<f64>,
    slope: Vec<f64>,
}

impl Taps {
    /// The filter for `oversampling` points of the grid a sample, at least two, and samples at `fs` \[Hz\].
    pub fn new(oversampling: usize, fs: f64) -> Self {
        let reach = (HALF * oversampling - 1) as f64;
        let (mut smooth, mut slope) = (Vec::new(), Vec::new());
        let (mut gain, mut ramp) = (0.0, 0.0);
        for phase in 0..oversampling {
            for sample in 1..=2 * HALF {
                // From the point of the grid to the sample; the last of phase 0 lies beyond the filter's end.
                let points = (oversampling * sample) as f64 - (oversampling * HALF + phase) as f64;
                let (h, rate) = if points.abs() > reach {
                    (0.0, 0.0)
                } else {
                    kernel(points / oversampling as f64, reach / oversampling as f64)
                };
                smooth.push(h);
                slope.push(rate);
                gain += h;
                ramp -= rate * points / oversampling as f64;
            }
        }
        // Of a constant the filter makes itself, of a ramp its slope, exactly.
        for (h, rate) in smooth.iter_mut().zip(&mut slope) {
            *h /= gain;
            *rate *= fs / ramp;
        }
        Self {
            oversampling,
            smooth,
            slope,
        }
    }

    /// Points of the grid from the middle of the filter to its last.
    pub fn reach(&self) -> i64 {
        signed(HALF * self.oversampling) - 1
    }

    /// Points of the grid in so many samples.
    pub fn points(&self, samples: usize) -> i64 {
        signed(samples * self.oversampling)
    }

    /// Samples that need nothing of a point of the grid, nor of any after it.
    pub fn finished(&self, point: i64) -> usize {
        // The last of them takes from `reach` points after its own.
        let last = (point - 1 - self.reach()).div_euclid(signed(self.oversampling));
        index((last + 1).max(0))
    }

    /// The samples that a point of the grid counts for, from the first on, and where their coefficients begin.
    fn place(&self, point: i64) -> (i64, usize) {
        let over = signed(self.oversampling);
        let first = point.div_euclid(over) + 1 - signed(HALF);
        (first, 2 * HALF * index(point.rem_euclid(over)))
    }

    /// Adds what a value at a point of the grid gives to the samples around it, or to those there are.
    #[inline(always)]
    pub fn spread(&self, how: SampleKind, point: i64, value: f64, samples: &mut [f64]) {
        let (first, at) = self.place(point);
        let taps = match how {
            SampleKind::Smooth => &self.smooth[at..at + 2 * HALF],
            SampleKind::Slope => &self.slope[at..at + 2 * HALF],
        };
        // Before sample 0 there is none.
        let skipped = index((-first).clamp(0, signed(taps.len())));
        let from = index(first.max(0)).min(samples.len());
        let (samples, taps) = (&mut samples[from..], &taps[skipped..]);
        let count = samples.len().min(taps.len());
        let (samples, last) = samples[..count].as_chunks_mut::<4>();
        let (taps, last_taps) = taps[..count].as_chunks::<4>();
        for (samples, taps) in samples.iter_mut().zip(taps) {
            *samples = std::array::from_fn(|i| samples[i] + taps[i] * value);
        }
        for (sample, tap) in last.iter_mut().zip(last_taps) {
            *sample += tap * value;
        }
    }
}

/// How values on the grid become samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SampleKind {
    /// Filtered.
    Smooth,
    /// Filtered and differentiated in time.
    Slope,
}

/// A count as a number that may be subtracted from.
#[allow(clippy::cast_possible_wrap)]
pub(super) fn signed(n: usize) -> i64 {
    n as i64
}

/// A number that is not negative, as an index.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
fn index(n: i64) -> usize {
    debug_assert!(n >= 0);
    n as usize
}

/// h and h′ at `t` of a filter that ends at ± `end`, but for their scale.
fn kernel(t: f64, end: f64) -> (f64, f64) {
    let u = t / end;
    let (window, rate) = window(u);
    let (sinc, slope) = if t == 0.0 {
        (1.0, 0.0)
    } else {
        let sinc = (PI * t).sin() / (PI * t);
        (sinc, ((PI * t).cos() - sinc) / t)
    };
    (sinc * window, slope * window + sinc * rate / end)
}

/// Kaiser's window and its derivative at `u` from −1 to 1, but for I₀(β).
fn window(u: f64) -> (f64, f64) {
    let q = BETA * BETA / 4.0 * (1.0 - u * u);
    let (mut term, mut sum, mut slope) = (1.0, 1.0, 0.0);
    for k in 1..60 {
        let k = f64::from(k);
        // d/dq of qᵏ/k!² is the term before over k.
        slope += term / k;
        term *= q / (k * k);
        sum += term;
    }
    (sum, -slope * BETA * BETA / 2.0 * u)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TAU: f64 = 2.0 * PI;

    /// Coefficients of SciPy from the middle outwards: point of the grid, coefficient.
    const SCIPY: [(usize, f64); 6] = [
        (0, 0.333_333_642_334_819_55),
        (1, 0.275_027_379_436_492_4),
        (2, 0.136_561_591_775_401_92),
        (4, -0.066_405_479_909_938_85),
        (20, 0.005_153_633_488_189_555),
        (41, -1.189_529_511_909_022_3e-5),
    ];

    /// Coefficients by the distance from a sample in points of the grid, from 0 on, as if fs were 1.
    fn sides(oversampling: usize) -> (Taps, [Vec<f64>; 2]) {
        let taps = Taps::new(oversampling, 1.0);
        let of = |how| {
            (0..=taps.reach())
                .map(|point| {
                    let mut sample = [0.0];
                    taps.spread(how, point, 1.0, &mut sample);
                    sample[0]
                })
                .collect()
        };
        let found = [of(SampleKind::Smooth), of(SampleKind::Slope)];
        (taps, found)
    }

    /// Independent: `scipy.signal.firwin(83, 0.5, window=("kaiser", 8.29806), fs=3)` from its middle, scipy 1.16.
    #[test]
    fn coefficients_are_scipys() {
        let (_, [smooth, _]) = sides(3);
        for (point, wanted) in SCIPY {
            assert!((smooth[point] - wanted).abs() < 1e-15, "{point}");
        }
    }

    /// Analytic: of the discrete transforms of both filters, on fine and coarse grids: flat to 0.4 fs, 83 dB down from
    /// 0.6 fs to half the grid's rate.
    #[test]
    fn magnitudes_are_flat_and_fall() {
        for oversampling in [2, 3, 7, 64] {
            let (_, [smooth, slope]) = sides(oversampling);
            let half = oversampling as f64 / 2.0;
            for i in 1..=4000 {
                let f = half * f64::from(i) / 4000.0;
                let sum = |taps: &[f64], of: fn(f64) -> f64| -> f64 {
                    let at = |k: usize| of(TAU * f * k as f64 / oversampling as f64);
                    (1..taps.len()).map(|k| 2.0 * taps[k] * at(k)).sum()
                };
                let gain = (smooth[0] + sum(&smooth, f64::cos)).abs();
                // A point after a sample counts with a positive sign: the transform is i times the sine's.
                let derived = sum(&slope, f64::sin).abs() / (TAU * f);
                for gain in [gain, derived] {
                    let decibel = 20.0 * gain.log10();
                    assert!(
                        f > FLAT || decibel.abs() < 0.004,
                        "{oversampling}: {f} {decibel}"
                    );
                    assert!(f < 0.6 || decibel < -83.0, "{oversampling}: {f} {decibel}");
                }
            }
        }
    }

    /// Limit: of a constant the filter makes itself, of a ramp its value and its slope, without delay.
    #[test]
    fn ramps_keep_value_and_slope() {
        for oversampling in [2, 5, 40] {
            let taps = Taps::new(oversampling, 10.0);
            let (mut value, mut slope) = ([0.0; 3], [0.0; 3]);
            let reach = taps.reach();
            for point in -reach..=reach + 2 * signed(oversampling) {
                let x = 4.0 + 3.0 * point as f64 / (10.0 * oversampling as f64);
                taps.spread(SampleKind::Smooth, point, x, &mut value);
                taps.spread(SampleKind::Slope, point, x, &mut slope);
            }
            for k in 0..3 {
                assert!(
                    (value[k] - (4.0 + 0.3 * k as f64)).abs() < 1e-13,
                    "{value:?}"
                );
                assert!((slope[k] - 3.0).abs() < 1e-11, "{slope:?}");
            }
        }
    }
}
