//! Functions of time given by points: how many lie before a time, and cubics between them.

/// A piece of a spline: c₀ + c₁ d + c₂ d² + c₃ d³ of the time d since it begins.
pub(super) struct Cubic {
    begins: f64,
    c: [f64; 4],
}

impl Cubic {
    /// The piece at a time; beyond the points a straight line.
    pub fn of(times: &[f64], values: &[f64], rates: &[f64], t: f64) -> Self {
        let after = reached(times, t);
        let before = after.saturating_sub(1);
        let straight = Self {
            begins: times[before],
            c: [values[before], rates[before], 0.0, 0.0],
        };
        if after == 0 || after == times.len() {
            return straight;
        }
        let h = times[after] - times[before];
        let slope = (values[after] - values[before]) / h;
        let c2 = (3.0 * slope - 2.0 * rates[before] - rates[after]) / h;
        let c3 = (rates[before] + rates[after] - 2.0 * slope) / (h * h);
        Self {
            c: [values[before], rates[before], c2, c3],
            ..straight
        }
    }

    pub fn at(&self, t: f64) -> f64 {
        let (d, [c0, c1, c2, c3]) = (t - self.begins, self.c);
        c0 + d * (c1 + d * (c2 + d * c3))
    }

    pub fn rate(&self, t: f64) -> f64 {
        let (d, [_, c1, c2, c3]) = (t - self.begins, self.c);
        c1 + d * (2.0 * c2 + d * 3.0 * c3)
    }

    pub fn curvature(&self, t: f64) -> f64 {
        2.0 * self.c[2] + 6.0 * self.c[3] * (t - self.begins)
    }

    /// Integral from the function's beginning to a time.
    pub fn integral(&self, t: f64) -> f64 {
        let (d, [c0, c1, c2, c3]) = (t - self.begins, self.c);
        d * (c0 + d * (c1 / 2.0 + d * (c2 / 3.0 + d * c3 / 4.0)))
    }

    /// Times at which its rate is 0, of the whole cubic.
    pub fn level(&self) -> Vec<f64> {
        let [_, c, b, a] = self.c;
        let (a, b) = (3.0 * a, 2.0 * b);
        // Without the difference of nearly equal numbers: q over a, and c over q.
        let q = -0.5 * (b + (b * b - 4.0 * a * c).max(0.0).sqrt().copysign(b));
        let real = b * b >= 4.0 * a * c;
        let roots = [q / a, c / q].into_iter();
        let found = roots.filter(|d| real && d.is_finite());
        found.map(|d| self.begins + d).collect()
    }
}

/// Number of times, which do not decrease, that lie at or before `t`. Of evenly spaced ones, as most tables have, the
/// place follows from the time itself; of others by bisection.
pub(super) fn reached(times: &[f64], t: f64) -> usize {
    let (Some(first), Some(last)) = (times.first(), times.last()) else {
        return 0;
    };
    let share = (t - first) / (last - first) * (times.len() - 1) as f64;
    // Saturates; not a number where all times are one becomes 0.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let guess = share as usize;
    for after in guess..=guess.saturating_add(2).min(times.len()) {
        let passed = after == 0 || times[after - 1] <= t;
        if passed && times.get(after).is_none_or(|next| *next > t) {
            return after;
        }
    }
    times.partition_point(|&x| x <= t)
}
