//! Breakpoints, and how a step is fitted in front of them.

use super::clock::ulp;
use crate::base::words::{Remembered, Words};

/// Relative amount by which a step may stretch to land on a stop.
const SLACK: f64 = 1e-9;

/// A time that a step must end on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stop {
    pub(super) time: f64,
    /// Whether the right-hand side may jump there.
    pub(super) jumps: bool,
}

impl Stop {
    /// The latest time a stage before this stop may see: functions of time are
    /// right-continuous, so the stop itself already belongs to what follows.
    pub(super) fn latest(self) -> f64 {
        if self.jumps {
            self.time.next_down()
        } else {
            self.time
        }
    }
}

/// The stops still ahead: the breakpoints inside the span, then its end.
#[derive(Debug)]
pub(super) struct Stops {
    breakpoints: Vec<f64>,
    passed: usize,
    end: f64,
}

impl Stops {
    /// Sorts the breakpoints, drops repetitions and those outside `(t0, end]`.
    pub(super) fn new(breakpoints: &[f64], t0: f64, end: f64) -> Self {
        let mut breakpoints: Vec<f64> = breakpoints
            .iter()
            .copied()
            .filter(|&t| t > t0 && t <= end)
            .collect();
        breakpoints.sort_by(f64::total_cmp);
        breakpoints.dedup();
        Self {
            breakpoints,
            passed: 0,
            end,
        }
    }

    /// The next stop.
    pub(super) fn next(&self) -> Stop {
        match self.breakpoints.get(self.passed) {
            Some(&time) => Stop { time, jumps: true },
            None => Stop {
                time: self.end,
                jumps: false,
            },
        }
    }

    /// Passes on how many were reached.
    pub(super) fn pass_on(&mut self, words: &mut Words) {
        self.passed.pass(words);
    }

    /// Marks the next stop as reached.
    pub(super) fn pass(&mut self) {
        self.passed += 1;
    }
}

/// A step size, and what decided it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plan {
    pub(super) h: f64,
    /// The step ends on the stop.
    pub(super) lands: bool,
    /// The stop, not the error, decided the size.
    pub(super) shortened: bool,
    /// The ceiling decided the size.
    pub(super) capped: bool,
}

impl Plan {
    /// Fits a step of size `free`, at most `ceiling`, between `now` and `stop`.
    ///
    /// A stop closer than two steps is reached in two equal ones, so that no
    /// sliver is left in front of it. A step may stretch by rounding's worth.
    pub(super) fn new(now: f64, stop: f64, free: f64, ceiling: f64) -> Self {
        let wish = free.min(ceiling);
        let remaining = stop - now;
        let slack = SLACK * wish + 2.0 * ulp(stop);
        let lands = remaining <= wish + slack;
        let h = if lands {
            remaining
        } else if remaining < 2.0 * wish {
            0.5 * remaining
        } else {
            wish
        };
        let shortened = h < wish - slack;
        Self {
            h,
            lands,
            shortened,
            capped: free > ceiling && !shortened,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn breakpoints_are_sorted_unique_and_inside() {
        let mut stops = Stops::new(&[2.0, -1.0, 1.0, 3.0, 2.0, 0.0, 4.0], 0.0, 3.0);
        let mut seen = Vec::new();
        for _ in 0..4 {
            seen.push((stops.next().time, stops.next().jumps));
            stops.pass();
        }
        assert_eq!(seen, [(1.0, true), (2.0, true), (3.0, true), (3.0, false)]);
    }

    #[test]
    fn latest_time_is_left_of_a_jump() {
        let stop = |jumps| Stop { time: 1.0, jumps }.latest();
        assert!(stop(true) < 1.0 && stop(true).next_up() == 1.0);
        assert_eq!(stop(false), 1.0);
    }

    #[test]
    fn far_near_and_middling_stops() {
        let plan = |stop| Plan::new(0.0, stop, 1.0, f64::INFINITY);
        let flags = |p: Plan| (p.h, p.lands, p.shortened, p.capped);
        assert_eq!(flags(plan(5.0)), (1.0, false, false, false));
        assert_eq!(flags(plan(1.5)), (0.75, false, true, false));
        assert_eq!(flags(plan(0.25)), (0.25, true, true, false));
        assert_eq!(flags(plan(1.0)), (1.0, true, false, false));
        let close = 1.0 + 1e-12;
        assert_eq!(flags(plan(close)), (close, true, false, false));
    }

    #[test]
    fn ceiling_counts_only_where_it_decides() {
        let plan = |stop| Plan::new(0.0, stop, 5.0, 1.0);
        assert_eq!((plan(9.0).h, plan(9.0).capped), (1.0, true));
        assert_eq!((plan(0.5).h, plan(0.5).capped), (0.5, false));
        assert!(!Plan::new(0.0, 9.0, 1.0, 1.0).capped);
    }
}
