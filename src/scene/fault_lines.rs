//! Kinematic frequencies at which defects are heard.

use std::f64::consts::TAU;

use super::{Drive, Row, Scene, Surface};

impl Row {
    /// Kinematic orders at the nominal contact angle, outer ring at rest, with γ = D cos α / d_m:
    /// FTF (1 − γ)/2, BPFO Z(1 − γ)/2, BPFI Z(1 + γ)/2, BSF d_m/2D (1 − γ²), in turns of the inner ring.
    pub fn orders(&self) -> [f64; 4] {
        let gamma = self.ball_diameter * self.contact_angle.cos() / self.pitch_diameter;
        let count = self.ball_count as f64;
        [
            (1.0 - gamma) / 2.0,
            count * (1.0 - gamma) / 2.0,
            count * (1.0 + gamma) / 2.0,
            self.pitch_diameter / (2.0 * self.ball_diameter) * (1.0 - gamma * gamma),
        ]
    }
}

impl Scene {
    /// The defect with the highest first line and that line \[Hz\]: BPFO, BPFI or, since a ball strikes both races,
    /// twice BSF, at the highest speed that a drive has within a duration \[s\]; absent without defects, or where
    /// nothing turns.
    pub(crate) fn highest_fault_line(&self, duration: f64) -> Option<(&str, f64)> {
        let shaft = self.drive.highest_speed(duration) / TAU;
        let defects = self.defects.iter().filter(|(_, d)| d.width.largest() > 0.0);
        let lines = defects.map(|(name, defect)| {
            let [_, bpfo, bpfi, bsf] = self.rows[defect.row].orders();
            let order = match defect.on {
                Surface::OuterRace => bpfo,
                Surface::InnerRace => bpfi,
                Surface::Ball => 2.0 * bsf,
            };
            (name.as_str(), order * shaft)
        });
        lines
            .filter(|(_, line)| *line > 0.0)
            .max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl Drive {
    /// Largest magnitude of the speed within a duration \[s\] from t = 0; that at the start where a torque is given
    /// \[rad/s\].
    fn highest_speed(&self, duration: f64) -> f64 {
        match self {
            Self::Speed(speed) => (0..=1000)
                .map(|i| speed.at(duration * f64::from(i) / 1000.0).abs())
                .fold(0.0, f64::max),
            Self::Torque { initial_speed, .. } => initial_speed.abs(),
        }
    }
}
