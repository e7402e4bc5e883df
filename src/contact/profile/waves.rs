//! Waviness: harmonics of a race's radius.

use crate::scene::Waviness;
use crate::simd::Lanes;

/// How waves raise a race under a ball, or under eight \[m\].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Raise<T> {
    /// Of the radius.
    pub height: T,
    /// Its derivative by the angle R'(φ).
    pub slope: T,
}

impl Raise<Lanes> {
    /// Eight places one by one.
    pub(in crate::contact) fn each(of: impl Fn(usize) -> Raise<f64>) -> Self {
        let mut slope = Lanes::ZERO;
        let height = Lanes::from_fn(|lane| {
            let raise = of(lane);
            slope[lane] = raise.slope;
            raise.height
        });
        Self { height, slope }
    }

    /// Takes over a place into a lane.
    pub(crate) fn set(&mut self, lane: usize, of: Raise<f64>) {
        (self.height[lane], self.slope[lane]) = (of.height, of.slope);
    }
}

/// The harmonics of a race's radius.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Waves(pub Vec<Waviness>);

impl Waves {
    /// Whether the race is round.
    pub fn is_round(&self) -> bool {
        self.0.is_empty()
    }

    /// Raise of the radius \[m\] at an angle in the ring's own frame \[rad\].
    pub fn at(&self, angle: f64) -> f64 {
        self.0
            .iter()
            .map(|w| w.amplitude * (f64::from(w.order) * angle + w.phase).cos())
            .sum()
    }

    /// The same with its derivative by the angle.
    pub(crate) fn raise(&self, angle: f64) -> Raise<f64> {
        let mut raise = Raise::default();
        for w in &self.0 {
            let order = f64::from(w.order);
            let (sin, cos) = (order * angle + w.phase).sin_cos();
            raise.height += w.amplitude * cos;
            raise.slope -= w.amplitude * order * sin;
        }
        raise
    }

    /// Second derivative of the radius by the angle \[m\].
    pub fn bend(&self, angle: f64) -> f64 {
        let of = |w: &Waviness| {
            let order = f64::from(w.order);
            -order * order * w.amplitude * (order * angle + w.phase).cos()
        };
        self.0.iter().map(of).sum()
    }
}
