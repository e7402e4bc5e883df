//! Moments of a signal.

use super::{Feature, named};

/// rms √⟨x²⟩, peak max |x|, crest factor peak/rms, and kurtosis ⟨(x − ⟨x⟩)⁴⟩ / ⟨(x − ⟨x⟩)²⟩², which is 3 for
/// Gaussian noise and 1.5 for a sine.
pub(super) fn of(name: &str, x: &[f64]) -> [Feature; 4] {
    let count = x.len() as f64;
    let mean = sum(x, &|x| x) / count;
    let square = sum(x, &|x| x * x) / count;
    let second = sum(x, &|x| (x - mean).powi(2));
    let fourth = sum(x, &|x| (x - mean).powi(4));
    let (rms, peak) = (
        square.sqrt(),
        x.iter().fold(0.0, |p: f64, x| p.max(x.abs())),
    );
    let feature = |what: &str, value| Feature::new(named(name, what), value);
    [
        feature("rms", rms),
        feature("peak", peak),
        feature("crest_factor", peak / rms),
        feature("kurtosis", count * fourth / (second * second)),
    ]
}

/// The sum of a function of every sample, by halves, so that its rounding error does not grow with the number of samples.
pub(super) fn sum(x: &[f64], of: &impl Fn(f64) -> f64) -> f64 {
    if x.len() <= 64 {
        return x.iter().map(|x| of(*x)).sum();
    }
    let (left, right) = x.split_at(x.len() / 2);
    sum(left, of) + sum(right, of)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Analytic: a sine has peak A, rms A/√2, crest factor √2 and kurtosis 3/2, whatever it stands on for the
    /// last.
    #[test]
    fn a_sine_has_known_moments() {
        let sine: Vec<f64> = (0..1000)
            .map(|i| 2.0 * (std::f64::consts::TAU * f64::from(i) / 100.0).sin())
            .collect();
        let found = of("x", &sine).map(|f| f.value.unwrap());
        let wanted = [2.0_f64.sqrt(), 2.0, 2.0_f64.sqrt(), 1.5];
        for (found, wanted) in found.into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
        }
        let raised: Vec<f64> = sine.iter().map(|x| x + 5.0).collect();
        assert!((of("x", &raised)[3].value.unwrap() - 1.5).abs() < 1e-9);
    }

    /// Analytic: silence has no crest factor and no kurtosis.
    #[test]
    fn silence_has_no_shape() {
        let found = of("x", &[0.0; 10]).map(|f| f.value);
        assert_eq!(found, [Some(0.0), Some(0.0), None, None]);
    }
}
