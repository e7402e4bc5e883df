//! Values that may change in time: a number, a ramp, a sine, a table or a spline.

use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::points::{Cubic, reached};

/// A value in time: a plain number, or one of the [`Profile`]s.
///
/// In TOML: `force = 7000.0`, or `force = { ramp = { from = 0.0, to = 7000.0, start = 0.0, end = 0.1 } }`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
#[non_exhaustive]
pub enum TimeFunction {
    /// The same at all times.
    Constant(f64),
    /// Changing in time.
    Profile(Profile),
}

/// The shapes of a value that changes in time. All are right-continuous.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum Profile {
    /// Linear from one value to another, constant before and after; a jump when `start == end`.
    Ramp {
        /// Value before `start`.
        from: f64,
        /// Value from `end` on.
        to: f64,
        /// Time at which the change begins \[s\].
        start: f64,
        /// Time at which the change is over \[s\].
        end: f64,
    },
    /// `mean + amplitude · sin(2π frequency t + phase)`.
    Sine {
        /// Mean value.
        mean: f64,
        /// Amplitude.
        amplitude: f64,
        /// Frequency \[Hz\].
        frequency: f64,
        /// Phase at t = 0 \[rad\].
        phase: f64,
    },
    /// Linear between points, constant beyond them; two equal times make a jump.
    Table {
        /// Times, not decreasing \[s\].
        times: Vec<f64>,
        /// Value at each time.
        values: Vec<f64>,
    },
    /// Cubic between points, with the given rates at the points (Hermite interpolation); linear beyond them.
    Spline {
        /// Times, strictly increasing \[s\].
        times: Vec<f64>,
        /// Value at each time.
        values: Vec<f64>,
        /// Rate of change at each time, in the value's unit over seconds.
        rates: Vec<f64>,
    },
}

impl From<f64> for TimeFunction {
    fn from(value: f64) -> Self {
        Self::Constant(value)
    }
}

impl TimeFunction {
    /// Value at time `t` \[s\]; NaN where a table lacks values, which [`crate::Scene::validate`] refuses.
    ///
    /// ```
    /// use ballrace::scene::{Profile, TimeFunction};
    /// let ramp = TimeFunction::Profile(Profile::Ramp { from: 0.0, to: 8.0, start: 1.0, end: 3.0 });
    /// assert_eq!(ramp.at(0.0), 0.0);
    /// assert_eq!(ramp.at(2.0), 4.0);
    /// assert_eq!(ramp.at(9.0), 8.0);
    /// ```
    pub fn at(&self, t: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Profile(Profile::Ramp {
                from,
                to,
                start,
                end,
            }) => {
                if t >= *end {
                    *to
                } else if t <= *start {
                    *from
                } else {
                    from + (to - from) * (t - start) / (end - start)
                }
            }
            Self::Profile(Profile::Sine {
                mean,
                amplitude,
                frequency,
                phase,
            }) => mean + amplitude * (std::f64::consts::TAU * frequency * t + phase).sin(),
            Self::Profile(Profile::Table { times, values }) => {
                let value = |i: usize| values.get(i).copied().unwrap_or(f64::NAN);
                let after = reached(times, t);
                if after == 0 {
                    value(0)
                } else if after == times.len() {
                    value(after - 1)
                } else {
                    let (t0, t1) = (times[after - 1], times[after]);
                    let share = (t - t0) / (t1 - t0);
                    value(after - 1) + (value(after) - value(after - 1)) * share
                }
            }
            Self::Profile(Profile::Spline {
                times,
                values,
                rates,
            }) => Cubic::of(times, values, rates, t).at(t),
        }
    }

    /// Derivative in time at `t`, from the right at a corner.
    pub fn rate(&self, t: f64) -> f64 {
        match self {
            Self::Constant(_) => 0.0,
            Self::Profile(Profile::Ramp {
                from,
                to,
                start,
                end,
            }) => {
                if t >= *start && t < *end {
                    (to - from) / (end - start)
                } else {
                    0.0
                }
            }
            Self::Profile(Profile::Sine {
                amplitude,
                frequency,
                phase,
                ..
            }) => {
                let w = std::f64::consts::TAU * frequency;
                amplitude * w * (w * t + phase).cos()
            }
            Self::Profile(Profile::Table { times, values }) => {
                let value = |i: usize| values.get(i).copied().unwrap_or(f64::NAN);
                let after = reached(times, t);
                if after == 0 || after == times.len() {
                    0.0
                } else {
                    (value(after) - value(after - 1)) / (times[after] - times[after - 1])
                }
            }
            Self::Profile(Profile::Spline {
                times,
                values,
                rates,
            }) => Cubic::of(times, values, rates, t).rate(t),
        }
    }

    /// Second derivative in time at `t`, from the right at a corner; corners and jumps do not contribute.
    pub fn curvature(&self, t: f64) -> f64 {
        match self {
            Self::Profile(Profile::Sine {
                amplitude,
                frequency,
                phase,
                ..
            }) => {
                let w = std::f64::consts::TAU * frequency;
                -amplitude * w * w * (w * t + phase).sin()
            }
            Self::Profile(Profile::Spline {
                times,
                values,
                rates,
            }) => Cubic::of(times, values, rates, t).curvature(t),
            _ => 0.0,
        }
    }

    /// Times at which the value or its rate jumps, for a spline its curvature \[s\].
    pub fn breakpoints(&self) -> Vec<f64> {
        match self {
            Self::Profile(Profile::Ramp { start, end, .. }) => vec![*start, *end],
            Self::Profile(Profile::Table { times, .. } | Profile::Spline { times, .. }) => {
                times.clone()
            }
            _ => Vec::new(),
        }
    }

    /// Breakpoints that a step must end on: all of them, except corners of a table or spline that are closer than `apart` \[s\] to
    /// their neighbours. There the error estimate controls the step; jumps are always returned.
    pub(crate) fn breakpoints_apart(&self, apart: f64) -> Vec<f64> {
        let Self::Profile(Profile::Table { times, .. } | Profile::Spline { times, .. }) = self
        else {
            return self.breakpoints();
        };
        let ends = |i: usize| {
            let before = i
                .checked_sub(1)
                .map_or(f64::INFINITY, |k| times[i] - times[k]);
            let after = times
                .get(i + 1)
                .map_or(f64::INFINITY, |next| next - times[i]);
            before == 0.0 || after == 0.0 || before.min(after) >= apart
        };
        (0..times.len())
            .filter(|&i| ends(i))
            .map(|i| times[i])
            .collect()
    }

    /// The value of the largest magnitude, with its sign; of a spline between its ends.
    ///
    /// ```
    /// use ballrace::scene::{Profile, TimeFunction};
    /// let table = Profile::Table { times: vec![0.0, 1.0, 2.0], values: vec![0.0, -8.0, 5.0] };
    /// assert_eq!(TimeFunction::Profile(table).extreme(), -8.0);
    /// ```
    pub fn extreme(&self) -> f64 {
        let larger = |a: f64, b: &f64| if b.abs() > a.abs() { *b } else { a };
        match self {
            Self::Constant(value) => *value,
            Self::Profile(Profile::Ramp { from, to, .. }) => larger(*from, to),
            Self::Profile(Profile::Sine {
                mean, amplitude, ..
            }) => mean + amplitude.abs().copysign(*mean),
            Self::Profile(Profile::Table { values, .. }) => values.iter().fold(0.0, larger),
            Self::Profile(Profile::Spline { .. }) => self.range().iter().fold(0.0, larger),
        }
    }

    /// Least and largest value; of a spline between its ends.
    pub(super) fn range(&self) -> [f64; 2] {
        let over = |values: &mut dyn Iterator<Item = f64>| {
            let none = [f64::INFINITY, f64::NEG_INFINITY];
            values.fold(none, |[least, most], x| [least.min(x), most.max(x)])
        };
        match self {
            Self::Constant(value) => [*value; 2],
            Self::Profile(Profile::Ramp { from, to, .. }) => [from.min(*to), from.max(*to)],
            Self::Profile(Profile::Sine {
                mean, amplitude, ..
            }) => [mean - amplitude.abs(), mean + amplitude.abs()],
            Self::Profile(Profile::Table { values, .. }) => over(&mut values.iter().copied()),
            Self::Profile(Profile::Spline {
                times,
                values,
                rates,
            }) => {
                let turning = times.windows(2).flat_map(|span| {
                    let cubic = Cubic::of(times, values, rates, span[0]);
                    let within = |t: &f64| span[0] < *t && *t < span[1];
                    let level = cubic.level().into_iter().filter(within);
                    level.map(|t| cubic.at(t)).collect::<Vec<_>>()
                });
                over(&mut values.iter().copied().chain(turning))
            }
        }
    }

    /// Largest magnitude the value ever takes.
    pub fn peak(&self) -> f64 {
        self.extreme().abs()
    }
}

impl<'de> Deserialize<'de> for TimeFunction {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        number_or_map(
            deserializer,
            "a number, or one of { ramp = … }, { sine = … }, { table = … }, { spline = … }",
            Self::Constant,
            Self::Profile,
        )
    }
}

/// Reads a number or a table, with serde's own message for either (an untagged enum would only say that no variant
/// fits).
pub(super) fn number_or_map<'de, D, M, T>(
    deserializer: D,
    expecting: &'static str,
    from_number: fn(f64) -> T,
    from_map: fn(M) -> T,
) -> Result<T, D::Error>
where
    D: Deserializer<'de>,
    M: Deserialize<'de>,
{
    struct NumberOrMap<T, M> {
        expecting: &'static str,
        from_number: fn(f64) -> T,
        from_map: fn(M) -> T,
    }
    impl<'de, T, M: Deserialize<'de>> Visitor<'de> for NumberOrMap<T, M> {
        type Value = T;
        fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            f.write_str(self.expecting)
        }
        fn visit_f64<E>(self, value: f64) -> Result<T, E> {
            Ok((self.from_number)(value))
        }
        fn visit_i64<E>(self, value: i64) -> Result<T, E> {
            Ok((self.from_number)(value as f64))
        }
        fn visit_u64<E>(self, value: u64) -> Result<T, E> {
            Ok((self.from_number)(value as f64))
        }
        fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<T, A::Error> {
            M::deserialize(MapAccessDeserializer::new(map)).map(self.from_map)
        }
    }
    deserializer.deserialize_any(NumberOrMap {
        expecting,
        from_number,
        from_map,
    })
}
