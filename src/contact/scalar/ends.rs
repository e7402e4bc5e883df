//! Ends of the zones of elements inside a defect: places at which a penetration changes its sign.
//!
//! The penetration is evaluated at equal steps over a piece of a contact's zone. Where the middle one of three values is nearest to
//! zero, the extremum of the penetration, which is nearly a parabola, is found. Otherwise a zone shorter than a step, such as that
//! of a far edge or of what is left of the race, would begin with a jump of the force, and an equilibrium there could not be found.

use super::{Line, OneContact};

/// Places at which a piece inside a defect is looked at for the ends of the elements' zones.
const LOOKS: usize = 12;
/// How well an end is found \[m\]: forces vanish there like the depth to a power above one, so what is cut a thousandth of a node's distance
/// beside it errs by less than 1e-6 of what that node carries.
const CLOSE: f64 = 1e-9;
/// Ends of zones in one piece that are kept; a bed of floor circles can have more, at some loss of accuracy.
const MOST_ENDS: usize = 16;

/// A place that was looked at, and the penetration there \[m\].
#[derive(Clone, Copy)]
struct Crossing {
    u: f64,
    value: f64,
}

impl OneContact<'_> {
    /// Places where a penetration of any element changes its sign within a piece, in order.
    pub(super) fn zone_ends(
        &self,
        line: &Line,
        [low, high]: [f64; 2],
    ) -> ([f64; MOST_ENDS], usize) {
        let mut ends = [0.0; MOST_ENDS];
        let mut count = 0;
        // Not quite from end to end: a defect's own end may count as outside.
        let inset = 1e-9 * (high - low);
        let low = low + inset;
        let step = (high - inset - low) / LOOKS as f64;
        let at = |u: f64| {
            self.node(line, u, 0.0)
                .map(|node| self.facing.penetrations(&node))
        };
        let mut keep = |of: &dyn Fn(f64) -> f64, a: Crossing, b: Crossing| {
            if (a.value > 0.0) != (b.value > 0.0) && count < MOST_ENDS {
                ends[count] = root(of, a, b);
                count += 1;
            }
        };
        let [mut last, mut before] = [None, at(low)];
        for k in 1..=LOOKS {
            let u = low + step * k as f64;
            let now = at(u);
            if let (Some(b), Some(c)) = (&before, &now) {
                let shared = if b.count == c.count { b.count } else { 0 };
                let first = last.as_ref().filter(|a| a.count == shared);
                for i in 0..shared {
                    let penetration = |u: f64| at(u).map_or(0.0, |found| found.values[i]);
                    let [b, c] = [(u - step, b), (u, c)].map(|(u, found)| Crossing {
                        u,
                        value: found.values[i],
                    });
                    keep(&penetration, b, c);
                    let Some(a) = first.map(|a| Crossing {
                        u: u - 2.0 * step,
                        value: a.values[i],
                    }) else {
                        continue;
                    };
                    // Between looks it may touch and part again, or the reverse.
                    if let Some(turn) = turning_point([a, b, c].map(|look| look.value)) {
                        let u = b.u + step * turn;
                        let value = penetration(u);
                        let there = Crossing { u, value };
                        keep(&penetration, a, there);
                        keep(&penetration, there, c);
                    }
                }
            }
            (last, before) = (before, now);
        }
        ends[..count].sort_by(f64::total_cmp);
        (ends, count)
    }
}

/// Place where a parabola through three values, a step apart, turns nearest to zero, in steps from the middle one; none where they
/// differ in sign or the middle one is not the nearest.
fn turning_point([a, b, c]: [f64; 3]) -> Option<f64> {
    let alike = (a > 0.0) == (b > 0.0) && (b > 0.0) == (c > 0.0);
    let nearest = b.abs() <= a.abs() && b.abs() <= c.abs();
    let bend = a - 2.0 * b + c;
    (alike && nearest && bend != 0.0).then(|| 0.5 * (a - c) / bend)
}

/// A zero between two places of opposite sign, by the Illinois variant of regula falsi.
fn root(f: impl Fn(f64) -> f64, mut a: Crossing, mut b: Crossing) -> f64 {
    for _ in 0..12 {
        let u = (a.u * b.value - b.u * a.value) / (b.value - a.value);
        let value = f(u);
        if value == 0.0 || (b.u - a.u).abs() < CLOSE {
            return u;
        }
        if (value > 0.0) == (b.value > 0.0) {
            a.value /= 2.0;
        } else {
            a = b;
        }
        b = Crossing { u, value };
    }
    b.u
}
