//! Kinematic frequencies of defects.

use std::f64::consts::TAU;

use super::{Row, Scene, Surface};

/// Kinematic orders of Z balls of diameter D on the pitch diameter d_m at the contact angle α \[rad\], for pure rolling with
/// γ = D cos α / d_m: FTF (1 − γ)/2, BPFO Z(1 − γ)/2, BPFI Z(1 + γ)/2, BSF d_m/2D (1 − γ²), per turn of the inner ring relative to
/// the outer; FTF is that of the cage relative to the outer ring.
///
/// ```
/// // The bearing 6205 of the Case Western Reserve data; both diameters in the same unit.
/// let [ftf, bpfo, bpfi, bsf] = ballrace::scene::kinematic_orders(9.0, 7.94, 39.04, 0.0);
/// assert!((bpfo - 3.5848).abs() < 1e-4 && (bpfi - 5.4152).abs() < 1e-4);
/// assert!((ftf - 0.3983).abs() < 1e-4 && (2.0 * bsf - 4.7135).abs() < 1e-4);
/// ```
pub fn kinematic_orders(
    ball_count: f64,
    ball_diameter: f64,
    pitch_diameter: f64,
    contact_angle: f64,
) -> [f64; 4] {
    let gamma = ball_diameter * contact_angle.cos() / pitch_diameter;
    [
        (1.0 - gamma) / 2.0,
        ball_count * (1.0 - gamma) / 2.0,
        ball_count * (1.0 + gamma) / 2.0,
        pitch_diameter / (2.0 * ball_diameter) * (1.0 - gamma * gamma),
    ]
}

impl Row {
    /// Kinematic orders FTF, BPFO, BPFI and BSF at the nominal contact angle, per turn of the inner ring relative to the outer.
    pub fn orders(&self) -> [f64; 4] {
        kinematic_orders(
            self.ball_count as f64,
            self.ball_diameter,
            self.pitch_diameter,
            self.contact_angle,
        )
    }
}

impl Scene {
    /// The defect with the highest first line and that line \[Hz\]: BPFO, BPFI or, since a ball's defect meets both races,
    /// twice BSF, at the highest relative speed of the rings within a duration \[s\]; `None` without defects, or where nothing
    /// turns.
    pub(crate) fn highest_fault_line(&self, duration: f64) -> Option<(&str, f64)> {
        let shaft = self.highest_speed(duration) / TAU;
        let defects = self.defects.iter().filter(|(_, d)| d.damage.width() > 0.0);
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

    /// Largest relative speed of the rings within a duration \[s\] from t = 0, under a torque with the initial speed \[rad/s\].
    fn highest_speed(&self, duration: f64) -> f64 {
        (0..=1000)
            .map(|i| self.relative_speed(duration * f64::from(i) / 1000.0).abs())
            .fold(0.0, f64::max)
    }
}
