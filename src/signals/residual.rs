//! How well the recorded accelerations agree with the recorded motion.
//!
//! A sample's acceleration a is the model's at the interpolated state, and the interpolated velocity has a
//! derivative v̇ of its own. Where steps resolve the motion the two agree. Where only the method's stability limits them, the
//! state is within the tolerance, but stiff contacts turn its error into noise of the accelerations. The error estimate does not
//! include that; this residual does:
//!
//! ```text
//! residual² = Σ |a − v̇|² / Σ max(|a|², a₀²)     over samples, along x, y, z of one ring
//! ```
//!
//! A bearing without vibration is not judged by the noise that the tolerance leaves: a₀ = 0.5 m/s², a twentieth of g. A healthy
//! 7208 under 3 kN of thrust has 0.036 m/s², right to 0.1 % in the record, with 0.02 m/s² of noise beyond the record's band.
//!
//! A *filtered* record takes accelerations from the velocities, and noise beyond its band is not in it. Where the tolerance holds
//! velocities, a − v̇ is noise that is new in every step of length h, of which the share h fs lies in the band of a record at fs. Above a
//! tolerance of 1e-6 friction that the steps do not resolve drags the velocities, too, and all of it counts. Measured in 60
//! random scenes over 3 ms, slip speeds of 0.1 to 100 mm/s, against rtol 1e-10: at 1e-7 and 1e-6 42 of 113 records that
//! were right within 1 % were above 0.05 by all of it, 7 by what lies in the band, and none was off by 5 % as a whole.
//!
//! It judges steps, not runs: an error that accumulates over undamped oscillations, or that a chaotic motion amplifies,
//! does not show ([`crate::Warning::AccuracyMissed`]).

use crate::base::words::{Remembered, Words};
use crate::dynamics::Dynamics;
use crate::integrate::DenseStep;
use crate::model::{Dof, Race};

/// a₀ \[m/s²\].
const QUIET: f64 = 0.5;
/// Samples that are judged one and all, and how many of those after them one stands for: an evaluation a sample would be a
/// fifth of a run.
const ALL: usize = 500;
const EVERY: usize = 16;
/// Largest tolerance at which noise of accelerations leaves the velocities alone.
const HOLDS_VELOCITIES: f64 = 1e-6;
/// Share of a step on either side over which the velocity is differentiated.
const REACH: f64 = 0.01;

/// The sums over a run, for the outer ring or, where that is held, for the inner one.
#[derive(Default)]
pub(crate) struct AccelerationResidual {
    /// Places of its velocities among the run's states.
    velocities: Vec<usize>,
    before: Vec<f64>,
    after: Vec<f64>,
    apart: f64,
    size: f64,
    /// Sampling rate of a record whose band does not hold all of it \[Hz\].
    band: Option<f64>,
}

impl AccelerationResidual {
    /// The residual of a record that is filtered down to a sampling rate \[Hz\], or not filtered.
    pub fn new(dynamics: &Dynamics<'_>, filtered: Option<f64>) -> Self {
        let model = dynamics.model();
        let fineness = model.fineness;
        let band = filtered.filter(|_| fineness.by_band || fineness.rtol <= HOLDS_VELOCITIES);
        let mut rings = Race::BOTH.into_iter().map(Race::ring);
        let ring = rings.find(|ring| model.bodies[*ring].moves_along_axes());
        let degrees = dynamics.degrees();
        let velocities: Vec<usize> = (0..degrees.len())
            .filter(|i| {
                let (body, dof) = degrees[*i];
                Some(body) == ring && Dof::TRANSLATIONS.contains(&dof)
            })
            .map(|i| degrees.len() + i)
            .collect();
        let length = velocities.last().map_or(0, |last| last + 1);
        Self {
            before: vec![0.0; length],
            after: vec![0.0; length],
            velocities,
            apart: 0.0,
            size: 0.0,
            band,
        }
    }

    /// Goes on with another model.
    pub fn change(&mut self, dynamics: &Dynamics<'_>) {
        let other = Self::new(dynamics, self.band);
        *self = Self {
            apart: self.apart,
            size: self.size,
            band: self.band,
            ..other
        };
    }

    /// Whether a sample is judged.
    pub fn wants(sample: usize) -> bool {
        sample < ALL || sample.is_multiple_of(EVERY)
    }

    /// Adds a sample at `t` within a step, whose derivatives are `dy`.
    pub fn add(&mut self, step: &DenseStep<'_>, t: f64, dy: &[f64]) {
        let reach = REACH * step.h();
        let (from, to) = ((t - reach).max(step.t0()), (t + reach).min(step.t1()));
        step.interpolate(from, &mut self.before);
        step.interpolate(to, &mut self.after);
        let share = self.band.map_or(1.0, |fs| (step.h() * fs).min(1.0));
        let mut size: f64 = 0.0;
        for i in self.velocities.iter().copied() {
            let rate = (self.after[i] - self.before[i]) / (to - from);
            self.apart += share * (dy[i] - rate).powi(2);
            size += dy[i].powi(2);
        }
        self.size += size.max(QUIET * QUIET);
    }

    /// The residual; none without accelerations, or where both rings are held.
    pub fn value(&self) -> Option<f64> {
        (self.size > 0.0 && !self.velocities.is_empty()).then(|| (self.apart / self.size).sqrt())
    }
}

impl Remembered for AccelerationResidual {
    fn pass(&mut self, words: &mut Words) {
        self.apart.pass(words);
        self.size.pass(words);
    }
}
