//! Integrals over time of values that may change; those of a table are summed once.

use super::points::{Cubic, reached};
use super::time::{Profile, TimeFunction};

/// Integral of a [`TimeFunction`], with what it needs besides the function itself: of a ramp or a table the integrals from its
/// first corner to each of them, and to t = 0, of a spline from its first point.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Antiderivative {
    areas: Vec<f64>,
    at_zero: f64,
}

impl Antiderivative {
    /// The integral of a function that has been validated.
    pub fn new(of: &TimeFunction) -> Self {
        let mut made = Self::default();
        match of {
            TimeFunction::Profile(Profile::Ramp {
                from,
                to,
                start,
                end,
            }) => made.sum(&[*start, *end], &[*from, *to]),
            TimeFunction::Profile(Profile::Table { times, values }) => made.sum(times, values),
            TimeFunction::Profile(Profile::Spline {
                times,
                values,
                rates,
            }) => {
                let mut area = 0.0;
                made.areas.push(area);
                for span in times.windows(2) {
                    area += Cubic::of(times, values, rates, span[0]).integral(span[1]);
                    made.areas.push(area);
                }
                made.at_zero = made.to_of_spline(times, values, rates, 0.0);
            }
            _ => {}
        }
        made
    }

    fn sum(&mut self, times: &[f64], values: &[f64]) {
        let mut area = 0.0;
        self.areas.push(area);
        for (span, value) in times.windows(2).zip(values.windows(2)) {
            area += (span[1] - span[0]) * (value[0] + 0.5 * (value[1] - value[0]));
            self.areas.push(area);
        }
        self.at_zero = self.to(times, values, 0.0);
    }

    /// Integral of the same function from 0 to `t` ≥ 0.
    pub fn at(&self, of: &TimeFunction, t: f64) -> f64 {
        match of {
            TimeFunction::Constant(value) => value * t,
            TimeFunction::Profile(Profile::Sine {
                mean,
                amplitude,
                frequency,
                phase,
            }) => {
                let w = std::f64::consts::TAU * frequency;
                if w == 0.0 {
                    return of.at(0.0) * t;
                }
                mean * t + amplitude / w * (phase.cos() - (w * t + phase).cos())
            }
            TimeFunction::Profile(Profile::Ramp {
                from,
                to,
                start,
                end,
            }) => self.to(&[*start, *end], &[*from, *to], t) - self.at_zero,
            TimeFunction::Profile(Profile::Table { times, values }) => {
                self.to(times, values, t) - self.at_zero
            }
            TimeFunction::Profile(Profile::Spline {
                times,
                values,
                rates,
            }) => self.to_of_spline(times, values, rates, t) - self.at_zero,
        }
    }

    /// Integral of a spline from its first point to `t`, before it too.
    fn to_of_spline(&self, times: &[f64], values: &[f64], rates: &[f64], t: f64) -> f64 {
        let before = reached(times, t).saturating_sub(1);
        self.areas[before] + Cubic::of(times, values, rates, t).integral(t)
    }

    /// Integral from the first corner to `t`, before it too, of what is linear between corners and constant beyond: whole
    /// trapezia, and a part of one. A jump is two corners at one time.
    fn to(&self, times: &[f64], values: &[f64], t: f64) -> f64 {
        let after = reached(times, t);
        if after == 0 {
            return values[0] * (t - times[0]);
        }
        let within = t - times[after - 1];
        let slope = match times.get(after) {
            Some(next) => (values[after] - values[after - 1]) / (next - times[after - 1]),
            None => 0.0,
        };
        self.areas[after - 1] + within * (values[after - 1] + 0.5 * slope * within)
    }
}

impl TimeFunction {
    /// Integral from 0 to `t` ≥ 0. A run sums a table once, not at every call.
    ///
    /// ```
    /// use ballrace::scene::{Profile, TimeFunction};
    /// let ramp = TimeFunction::Profile(Profile::Ramp { from: 0.0, to: 8.0, start: 1.0, end: 3.0 });
    /// assert_eq!([0.5, 2.0, 3.0, 4.0].map(|t| ramp.integral(t)), [0.0, 2.0, 8.0, 16.0]);
    /// ```
    pub fn integral(&self, t: f64) -> f64 {
        Antiderivative::new(self).at(self, t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Analytic: trapezia, by hand, with a jump at 2 and a start before 0.
    #[test]
    fn tables_are_integrated_from_zero() {
        let table = TimeFunction::Profile(Profile::Table {
            times: vec![-1.0, 1.0, 2.0, 2.0, 4.0],
            values: vec![0.0, 4.0, 4.0, 1.0, 3.0],
        });
        let found = [0.0, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0].map(|t| table.integral(t));
        assert_eq!(found, [0.0, 3.0, 5.0, 7.0, 8.5, 11.0, 17.0]);
    }

    /// Truth: bisection over all times. Even, uneven, repeated times and a single one.
    #[test]
    fn the_place_in_a_table_is_that_of_a_bisection() {
        let even: Vec<f64> = (0..1000).map(|k| f64::from(k) * 0.1).collect();
        let uneven: Vec<f64> = even.iter().map(|t| (t * t).round()).collect();
        for times in [even, uneven, vec![0.0, 0.0, 0.0], vec![1.0]] {
            let between = times.windows(2).map(|pair| f64::midpoint(pair[0], pair[1]));
            let beside = times.iter().flat_map(|t| [t.next_down(), *t, t.next_up()]);
            for t in between.chain(beside).chain([-1e300, 1e300]) {
                assert_eq!(
                    reached(&times, t),
                    times.partition_point(|&x| x <= t),
                    "{t}"
                );
            }
        }
    }

    /// A corner of a dense table is none for the steps, a jump always is.
    #[test]
    fn dense_corners_do_not_hold_steps() {
        let table = TimeFunction::Profile(Profile::Table {
            times: vec![0.0, 1.0, 1.1, 1.2, 1.2, 1.3, 5.0],
            values: vec![0.0, 1.0, 2.0, 3.0, 7.0, 3.0, 1.0],
        });
        assert_eq!(table.breakpoints_apart(0.5), [0.0, 1.2, 1.2, 5.0]);
        assert_eq!(table.breakpoints_apart(0.0), table.breakpoints());
    }
}
