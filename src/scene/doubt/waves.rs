//! Listed waves that are too short for their contacts.

use super::{Doubt, millimetres};
use crate::base::quantities::number;
use crate::scene::{Row, Scene, Waviness};

/// n b/R from which a contact would take a tenth and more of a wave away, 1 − sin x/x.
const SHORT: f64 = 0.8;

impl Doubt {
    /// Of waves that a contact is too wide for. `arcs` are half-widths of the most heavily loaded contact along the outer and
    /// the inner race over the race's radius, b/R.
    ///
    /// A wave n whose contact keeps its pressure's shape gives the mean of its height under a flat punch, a share
    /// sin κ/κ, κ = n b/R (model section 14.1). The model has no such filter for listed waves yet.
    pub(crate) fn waves(scene: &Scene, arcs: [f64; 2]) -> Vec<Self> {
        let mut found = Vec::new();
        for (i, row) in scene.rows.iter().enumerate() {
            let races = [
                ("outer_waviness", &row.outer_waviness, 1.0, arcs[0]),
                ("inner_waviness", &row.inner_waviness, -1.0, arcs[1]),
            ];
            for (field, waves, sigma, arc) in races {
                for (k, wave) in waves
                    .iter()
                    .enumerate()
                    .filter(|(_, of)| of.amplitude != 0.0)
                {
                    let path = format!("rows[{i}].{field}[{k}].order");
                    found.extend(Self::wave(path, wave, radius(row, sigma), arc));
                }
            }
        }
        found
    }

    fn wave(path: String, wave: &Waviness, radius: f64, arc: f64) -> Option<Self> {
        let order = f64::from(wave.order);
        let share = order * arc;
        (share > SHORT).then(|| {
            let usual = format!(
                "waves {} long under a contact {} wide, which would take them for {} of their height; the run feels them in \
                 full and shakes too much; keep to orders below {}",
                millimetres(std::f64::consts::TAU * radius / order),
                millimetres(2.0 * arc * radius),
                number(share.sin() / share),
                number((SHORT / arc).floor())
            );
            Self::new(path, number(order), usual)
        })
    }
}

/// Of a race where its balls nominally run \[m\].
fn radius(row: &Row, sigma: f64) -> f64 {
    row.pitch_diameter / 2.0 + sigma * row.ball_diameter / 2.0 * row.contact_angle.cos()
}
