//! Amplitudes of lines, between the entries of a spectrum.

use super::transform::amplitudes;

/// Bins from a line in which noise is looked for: where the Hann window's transform of the line itself is 0.
const BESIDE: [u8; 4] = [2, 3, 4, 5];

/// Amplitude spectrum under a Hann window, padded so that a line is seen between the bins.
pub(super) struct Spectrum {
    amplitudes: Vec<f64>,
    /// Distance of the entries \[Hz\].
    spacing: f64,
}

impl Spectrum {
    /// A sine of amplitude 2 has a line of height 2.
    pub fn new(x: &[f64], fs: f64) -> Self {
        let padded = (4 * x.len()).next_power_of_two();
        Self {
            amplitudes: amplitudes(x, padded),
            spacing: fs / padded as f64,
        }
    }

    /// Highest frequency of the spectrum \[Hz\].
    pub fn top(&self) -> f64 {
        (self.amplitudes.len() - 1) as f64 * self.spacing
    }

    /// Place \[Hz\] and height of the highest amplitude from `low` to `high` \[Hz\], between the entries on a parabola through
    /// the highest and its neighbours. At most an eighth of a bin from an entry, the parabola of the Hann window's main lobe
    /// is good to 1e-4.
    pub fn highest(&self, low: f64, high: f64) -> (f64, f64) {
        let range = index((low / self.spacing).ceil())..=index((high / self.spacing).floor());
        let within = range.max_by(|&i, &j| self.amplitudes[i].total_cmp(&self.amplitudes[j]));
        let edges = [low, high].map(|f| (f, self.at(f)));
        let summit = within.map(|top| self.summit(top));
        let all = edges.into_iter().chain(summit);
        all.max_by(|a, b| a.1.total_cmp(&b.1)).expect("two edges")
    }

    /// Standard error of a line's amplitude in the noise beside it, of a record whose bins have a width \[Hz\]; absent where there
    /// is nothing beside it.
    ///
    /// Noise adds to the line's amplitude the part of it that is in phase: half of its mean square there. That is the same
    /// in the bins nearby, of which the median counts: sidebands and other lines stand out of it. The squares of noise
    /// have an exponential distribution, whose median is ln 2 of its mean. What pulses vary in height and in time is noise
    /// of this kind (D. C. Rife, R. R. Boorstyn, IEEE Trans. Inf. Theory 20 (1974) 591). Parts of a record, each with its own
    /// transform, would leak: beside a line of 1e-3 m/s² may stand a signal of 100.
    pub fn error(&self, place: f64, bin: f64) -> Option<f64> {
        let away = BESIDE.map(|bins| f64::from(bins) * bin);
        let places = away.into_iter().flat_map(|d| [place - d, place + d]);
        let inside = places.filter(|f| *f >= 2.0 * bin && *f + 2.0 * bin < self.top());
        let mut squares: Vec<f64> = inside.map(|f| self.at(f).powi(2)).collect();
        squares.sort_by(f64::total_cmp);
        let count = squares.len();
        let middle = 0.5 * (squares.get(count / 2)? + squares[(count - 1) / 2]);
        Some((middle / std::f64::consts::LN_2 / 2.0).sqrt())
    }

    /// Value at a frequency, on the parabola through the nearest entry and its neighbours.
    fn at(&self, f: f64) -> f64 {
        let place = f / self.spacing;
        let i = index(place.round()).max(1);
        let [left, middle, right] = [i - 1, i, i + 1].map(|i| self.amplitudes[i]);
        let s = place - i as f64;
        middle + s * (right - left) / 2.0 + s * s * (left - 2.0 * middle + right) / 2.0
    }

    /// Place \[Hz\] and height of the summit of the parabola through an entry and its neighbours, if the entry is above
    /// them.
    fn summit(&self, i: usize) -> (f64, f64) {
        let [left, top, right] = [i - 1, i, i + 1].map(|i| self.amplitudes[i]);
        let bend = left - 2.0 * top + right;
        if top < left || top < right || bend >= 0.0 {
            return (i as f64 * self.spacing, top);
        }
        let shift = (left - right) / (2.0 * bend);
        let height = top - (left - right).powi(2) / (8.0 * bend);
        ((i as f64 + shift) * self.spacing, height)
    }
}

/// Frequencies are above 0 and below fs/2, and so are the entries beside them.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
fn index(place: f64) -> usize {
    place as usize
}

#[cfg(test)]
mod tests {
    use super::super::transform::squared_envelope;
    use super::*;

    fn sine(amplitude: f64, f: f64, fs: f64, count: u32) -> Vec<f64> {
        (0..count)
            .map(|i| amplitude * (std::f64::consts::TAU * f * f64::from(i) / fs + 0.3).sin())
            .collect()
    }

    /// Analytic: a sine between two bins, of a record of prime length, keeps its amplitude.
    #[test]
    fn a_sine_has_its_amplitude() {
        for f in [50.0, 50.13, 50.37, 50.5] {
            let found = Spectrum::new(&sine(3.0, f, 1000.0, 1009), 1000.0)
                .highest(45.0, 55.0)
                .1;
            assert!((found / 3.0 - 1.0).abs() < 2e-4, "{f}: {found}");
        }
    }

    /// Analytic: the squared envelope of (1 + m cos Ωt) sin ωt is (1 + m cos Ωt)²; with lines of 2m at Ω and
    /// m²/2 at 2Ω. A band without the carrier has none.
    #[test]
    fn the_envelope_drops_the_carrier() {
        let burst: Vec<f64> = sine(1.0, 200.0, 1000.0, 1000)
            .iter()
            .enumerate()
            .map(|(i, x)| x * (1.0 + 0.5 * (std::f64::consts::TAU * 7.0 * i as f64 / 1000.0).cos()))
            .collect();
        let envelope = squared_envelope(&burst, 1000.0, Some([150.0, 250.0]));
        assert!((envelope[0] - 2.25).abs() < 1e-9, "{}", envelope[0]);
        let spectrum = Spectrum::new(&envelope, 1000.0);
        assert!((spectrum.highest(6.0, 8.0).1 - 1.0).abs() < 1e-3);
        assert!((spectrum.highest(13.0, 15.0).1 - 0.125).abs() < 1e-3);
        let beside = squared_envelope(&burst, 1000.0, Some([300.0, 400.0]));
        assert!(beside.iter().all(|x| *x < 1e-20));
    }
}
