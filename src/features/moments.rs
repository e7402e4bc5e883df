//! Moments of a signal.

use super::batches::Batches;
use super::{Feature, named};

/// rms √⟨x²⟩, peak max |x|, crest factor peak/rms, and kurtosis ⟨(x − ⟨x⟩)⁴⟩ / ⟨(x − ⟨x⟩)²⟩², which is 3 for
/// Gaussian noise and 1.5 for a sine; with standard errors where there are batches.
pub(super) fn of(name: &str, x: &[f64], batches: Option<&Batches>) -> Vec<Feature> {
    let count = x.len() as f64;
    let mean = sum(x, &|x| x) / count;
    let square = sum(x, &|x| x * x) / count;
    let second = sum(x, &|x| (x - mean).powi(2));
    let fourth = sum(x, &|x| (x - mean).powi(4));
    let (rms, peak) = (square.sqrt(), peak(x));
    let errors = batches.map(|batches| Errors::of(x, mean, batches));
    let feature = |what: &str, value: f64, error: fn(&Errors) -> f64| {
        let error = errors.as_ref().map(error);
        Feature::with_error(named(name, what), value, error)
    };
    let mut found = feature("rms", rms, |errors| errors.rms);
    found.extend(feature("peak", peak, |errors| errors.peak));
    let crest = errors.as_ref().map(|errors| {
        let relative = (errors.peak / peak).hypot(errors.rms / rms);
        relative * peak / rms
    });
    let crest_factor = named(name, "crest_factor");
    found.extend(Feature::with_error(crest_factor, peak / rms, crest));
    let kurtosis = count * fourth / (second * second);
    found.extend(feature("kurtosis", kurtosis, |errors| errors.kurtosis));
    found
}

fn peak(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |p: f64, x| p.max(x.abs()))
}

/// Standard errors; not numbers without batches.
struct Errors {
    rms: f64,
    peak: f64,
    kurtosis: f64,
}

impl Errors {
    fn of(x: &[f64], mean: f64, batches: &Batches) -> Self {
        let Some(parts) = batches.map(|range| MomentSums::of(&x[range], mean)) else {
            return Self {
                rms: f64::NAN,
                peak: f64::NAN,
                kurtosis: f64::NAN,
            };
        };
        let all = parts
            .iter()
            .fold(MomentSums::default(), |all, part| MomentSums {
                count: all.count + part.count,
                sums: std::array::from_fn(|i| all.sums[i] + part.sums[i]),
            });
        let without = |of: &dyn Fn(&MomentSums) -> f64| {
            let rest = parts.iter().map(|part| MomentSums {
                count: all.count - part.count,
                sums: std::array::from_fn(|i| all.sums[i] - part.sums[i]),
            });
            let features: Vec<f64> = rest.map(|rest| of(&rest)).collect();
            batches.jackknife(&features)
        };
        let peaks = batches.map(|range| peak(&x[range])).unwrap_or_default();
        Self {
            rms: without(&|rest| rest.rms(mean)),
            peak: Batches::of_extreme(&peaks),
            kurtosis: without(&MomentSums::kurtosis),
        }
    }
}

/// Sums of the first four powers of what samples differ from the mean of the record.
#[derive(Default)]
struct MomentSums {
    count: f64,
    sums: [f64; 4],
}

impl MomentSums {
    fn of(x: &[f64], mean: f64) -> Self {
        let sums = x.iter().fold([0.0; 4], |[s1, s2, s3, s4], x| {
            let (d, d2) = (x - mean, (x - mean).powi(2));
            [s1 + d, s2 + d2, s3 + d * d2, s4 + d2 * d2]
        });
        Self {
            count: x.len() as f64,
            sums,
        }
    }

    fn rms(&self, mean: f64) -> f64 {
        let [first, second, ..] = self.sums.map(|sum| sum / self.count);
        (second + 2.0 * mean * first + mean * mean).sqrt()
    }

    /// Kurtosis about a mean of its own.
    fn kurtosis(&self) -> f64 {
        let [m, second, third, fourth] = self.sums.map(|sum| sum / self.count);
        let variance = second - m * m;
        let raised = fourth - 4.0 * m * third + 6.0 * m * m * second - 3.0 * m.powi(4);
        raised / (variance * variance)
    }
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
    use super::super::noise::uniform;
    use super::*;

    /// Analytic: a sine has peak A, rms A/√2, crest factor √2 and kurtosis 3/2, whatever it stands on for the
    /// last.
    #[test]
    fn a_sine_has_known_moments() {
        let sine: Vec<f64> = (0..1000)
            .map(|i| 2.0 * (std::f64::consts::TAU * f64::from(i) / 100.0).sin())
            .collect();
        let found = of("x", &sine, None);
        let wanted = [2.0_f64.sqrt(), 2.0, 2.0_f64.sqrt(), 1.5];
        assert_eq!(found.len(), wanted.len());
        for (found, wanted) in found.into_iter().zip(wanted) {
            let value = found.value.unwrap();
            assert!((value - wanted).abs() < 1e-12, "{value} {wanted}");
        }
        let raised: Vec<f64> = sine.iter().map(|x| x + 5.0).collect();
        assert!((of("x", &raised, None)[3].value.unwrap() - 1.5).abs() < 1e-9);
    }

    /// Analytic: a signal of zeros has no crest factor and no kurtosis.
    #[test]
    fn silence_has_no_shape() {
        let found = of("x", &[0.0; 10], None);
        let values: Vec<_> = found.iter().map(|f| f.value).collect();
        assert_eq!(values, [Some(0.0), Some(0.0), None, None]);
    }

    /// Analytic: Gaussian samples, alone or each with 0.9 of the one before (AR(1)), give rms², the mean of squares, a variance of
    /// 2σ⁴/n (1 + ρ²)/(1 − ρ²). Over 300 records of 32 turns: the mean error and the share of records within two of
    /// them of the truth (0.95 of Gauss's law, 0.945 of Student's). The kurtosis of the first has √(24/n).
    #[test]
    fn noise_is_as_uncertain_as_reported() {
        let (records, count) = (300, 16_000);
        let mut uniform = uniform(7);
        let mut gauss =
            || (-2.0 * uniform().ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos();
        for rho in [0.0, 0.9_f64] {
            let (mut rms, mut kurtosis, mut within) = (0.0, 0.0, 0.0);
            let mut peaks = Vec::new();
            let mut of_peak = 0.0;
            for _ in 0..records {
                let mut last = gauss();
                let x: Vec<f64> = (0..count)
                    .map(|_| {
                        last = rho * last + (1.0 - rho * rho).sqrt() * gauss();
                        last
                    })
                    .collect();
                let found = of("", &x, Some(&Batches::new(count, [32.0, 115.0])));
                let value = |name: &str| {
                    let feature = found.iter().find(|f| f.name == name);
                    feature.and_then(|f| f.value).unwrap()
                };
                rms += value("rms_se") / f64::from(records);
                kurtosis += value("kurtosis_se") / f64::from(records);
                of_peak += value("peak_se") / f64::from(records);
                peaks.push(value("peak"));
                let off = (value("rms") - 1.0).abs();
                within += f64::from(u8::from(off < 2.0 * value("rms_se"))) / f64::from(records);
            }
            let square = rho * rho;
            let theory = (0.5 / count as f64 * (1.0 + square) / (1.0 - square)).sqrt();
            assert!((rms / theory - 1.0).abs() < 0.15, "{rms} {theory}");
            assert!((0.91..0.98).contains(&within), "{within}");
            if rho == 0.0 {
                let theory = (24.0 / count as f64).sqrt();
                assert!((kurtosis / theory - 1.0).abs() < 0.15, "{kurtosis}");
            }
            // The law of Gumbel is reached slowly by Gaussian peaks: batches scatter by up to a third more.
            let mean = peaks.iter().sum::<f64>() / f64::from(records);
            let spread = peaks.iter().map(|p| (p - mean).powi(2)).sum::<f64>();
            let ratio = of_peak / (spread / f64::from(records - 1)).sqrt();
            assert!((0.9..1.5).contains(&ratio), "{ratio}");
        }
    }

    /// Errors are absent of what repeats turn by turn; without batches there are no errors, nor for a signal of zeros.
    #[test]
    fn errors_of_what_repeats_and_of_nothing() {
        let sine: Vec<f64> = (0..1600)
            .map(|i| (std::f64::consts::TAU * f64::from(i) / 100.0).sin())
            .collect();
        let errors_of = |x: &[f64], batches: &Batches| {
            let found = of("", x, Some(batches));
            let errors = found.into_iter().filter(|f| f.name.ends_with("_se"));
            errors.map(|f| f.value).collect::<Vec<_>>()
        };
        let sure = errors_of(&sine, &Batches::new(1600, [16.0, 57.0]));
        assert_eq!(sure.len(), 4);
        assert!(sure.iter().all(|e| e.unwrap() < 1e-12), "{sure:?}");
        assert_eq!(errors_of(&sine, &Batches::none()), [None; 4]);
        let silent = errors_of(&[0.0; 1600], &Batches::new(1600, [16.0, 57.0]));
        assert_eq!(silent, [Some(0.0), Some(0.0), None, None]);
    }
}
