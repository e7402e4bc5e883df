//! Kinematic frequencies of defects.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::{Row, Scene, Surface};

/// Geometry of a row of balls on which its kinematics depends.
///
/// ```
/// use ballrace::scene::RowGeometry;
/// // The bearing 6205 of the Case Western Reserve data.
/// let row = RowGeometry { ball_count: 9.0, ball_diameter: 7.94e-3, pitch_diameter: 39.04e-3, contact_angle: 0.0 };
/// let orders = row.orders();
/// assert!((orders.bpfo - 3.5848).abs() < 1e-4 && (orders.bpfi - 5.4152).abs() < 1e-4);
/// assert!((orders.ftf - 0.3983).abs() < 1e-4 && (2.0 * orders.bsf - 4.7135).abs() < 1e-4);
/// let rates = orders.at(1797.0 / 60.0);
/// assert!((rates.bpfo - 107.36).abs() < 0.01); // Hz
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RowGeometry {
    /// Number of balls.
    pub ball_count: f64,
    /// Ball diameter D \[m\].
    pub ball_diameter: f64,
    /// Pitch diameter d_m \[m\].
    pub pitch_diameter: f64,
    /// Contact angle α \[rad\].
    pub contact_angle: f64,
}

/// Kinematic orders of a row: rates per turn of the inner ring against the outer; or, by [`Orders::at`], in hertz.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Orders {
    /// Cage against the outer ring.
    pub ftf: f64,
    /// Balls that pass a place of the outer race.
    pub bpfo: f64,
    /// Balls that pass a place of the inner race.
    pub bpfi: f64,
    /// Turns of a ball in the cage; a place of it meets the races twice a turn.
    pub bsf: f64,
}

impl RowGeometry {
    /// Orders of Z balls for pure rolling, with γ = D cos α / d_m: FTF (1 − γ)/2, BPFO Z(1 − γ)/2, BPFI Z(1 + γ)/2,
    /// BSF d_m/2D (1 − γ²).
    pub fn orders(&self) -> Orders {
        let gamma = self.ball_diameter * self.contact_angle.cos() / self.pitch_diameter;
        Orders {
            ftf: (1.0 - gamma) / 2.0,
            bpfo: self.ball_count * (1.0 - gamma) / 2.0,
            bpfi: self.ball_count * (1.0 + gamma) / 2.0,
            bsf: self.pitch_diameter / (2.0 * self.ball_diameter) * (1.0 - gamma * gamma),
        }
    }
}

impl Orders {
    /// The rates at a frequency of the inner ring against the outer, of either sign \[Hz\].
    #[must_use]
    pub fn at(&self, shaft: f64) -> Self {
        let shaft = shaft.abs();
        Self {
            ftf: self.ftf * shaft,
            bpfo: self.bpfo * shaft,
            bpfi: self.bpfi * shaft,
            bsf: self.bsf * shaft,
        }
    }
}

/// Orders FTF, BPFO, BPFI and BSF of a row.
#[deprecated(
    since = "0.4.0",
    note = "is `RowGeometry::orders`, whose numbers have names; gone in 0.5"
)]
pub fn kinematic_orders(
    ball_count: f64,
    ball_diameter: f64,
    pitch_diameter: f64,
    contact_angle: f64,
) -> [f64; 4] {
    let row = RowGeometry {
        ball_count,
        ball_diameter,
        pitch_diameter,
        contact_angle,
    };
    let Orders {
        ftf,
        bpfo,
        bpfi,
        bsf,
    } = row.orders();
    [ftf, bpfo, bpfi, bsf]
}

impl Row {
    /// Geometry of the row on which its kinematics depends, at the nominal contact angle.
    pub fn geometry(&self) -> RowGeometry {
        RowGeometry {
            ball_count: self.ball_count as f64,
            ball_diameter: self.ball_diameter,
            pitch_diameter: self.pitch_diameter,
            contact_angle: self.contact_angle,
        }
    }

    /// Orders FTF, BPFO, BPFI and BSF at the nominal contact angle.
    #[deprecated(
        since = "0.4.0",
        note = "is `Row::geometry().orders()`, whose numbers have names; gone in 0.5"
    )]
    pub fn orders(&self) -> [f64; 4] {
        let Orders {
            ftf,
            bpfo,
            bpfi,
            bsf,
        } = self.geometry().orders();
        [ftf, bpfo, bpfi, bsf]
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
            let orders = self.rows[defect.row].geometry().orders();
            let order = match defect.on {
                Surface::OuterRace => orders.bpfo,
                Surface::InnerRace => orders.bpfi,
                Surface::Ball => 2.0 * orders.bsf,
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
