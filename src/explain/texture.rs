//! Texture of a row, and what its contacts leave of it.

use std::fmt;

use serde::Serialize;

use crate::base::quantities::number;
use crate::contact::HeightTable;
use crate::model::{Model, Race};
use crate::scene::Texture;

/// Lowest order that counts as roughness, not as form.
const ROUGH: u32 = 15;

/// The texture of one surface of a row.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TextureExplanation {
    /// Row, from 0.
    pub row: usize,
    /// Name of the surface, such as `outer race`.
    pub surface: String,
    /// Amplitude at order 30 \[m\].
    pub amplitude: f64,
    /// How amplitudes fall with the order.
    pub slope: f64,
    /// Lowest and highest order.
    pub orders: [u32; 2],
    /// Knots of its table.
    pub knots: usize,
    /// Root mean square around the circumference \[m\].
    pub roughness: f64,
    /// The same from order 15 on \[m\].
    pub fine_roughness: f64,
    /// Length of waves of which a contact leaves nothing: its width \[m\].
    pub shortest: f64,
    /// Frequency of the waves where balls roll at the drive's largest speed \[Hz\].
    pub frequency: f64,
    /// Largest step that sees them \[s\].
    pub largest_step: f64,
}

/// The explanations of all rows that have a texture.
pub(super) fn of(model: &Model) -> Vec<TextureExplanation> {
    let rows = model.scene().rows.iter().enumerate();
    let textured = rows.filter_map(|(i, row)| Some((i, row.texture.as_ref()?)));
    textured
        .flat_map(|(i, texture)| of_row(model, i, texture))
        .collect()
}

fn of_row(model: &Model, row: usize, texture: &Texture) -> Vec<TextureExplanation> {
    let widths = model.rows[row].texture_widths.unwrap_or_default();
    let arc = |race: Race| widths[race] / model.contact_radius(row, race);
    let [outer, inner] = Race::BOTH.map(|race| texture.orders_on(arc(race)));
    let ball = texture.orders_on_ball(model.ball_arc(row, widths));
    let surfaces = [
        ("outer race", texture.outer, outer, widths[Race::Outer]),
        ("inner race", texture.inner, inner, widths[Race::Inner]),
        ("balls", texture.ball, ball, widths[0].max(widths[1])),
    ];
    let speed = model.rolling_speed(row);
    surfaces
        .into_iter()
        .filter(|(_, amplitude, ..)| *amplitude > 0.0)
        .map(|(surface, amplitude, orders, width)| TextureExplanation {
            row,
            surface: surface.to_owned(),
            amplitude,
            slope: texture.slope,
            orders,
            knots: HeightTable::knots_for(orders[1]),
            roughness: texture.roughness(amplitude, orders),
            fine_roughness: texture.roughness(amplitude, [orders[0].max(ROUGH), orders[1]]),
            shortest: 2.0 * width,
            frequency: speed / (2.0 * width),
            largest_step: width / (4.0 * speed),
        })
        .collect()
}

impl fmt::Display for TextureExplanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            row,
            surface,
            orders: [first, last],
            knots,
            ..
        } = self;
        write!(
            f,
            "{surface} of row {row}: {} nm at order 30, slope {}, orders {first} to {last} on {knots} knots; Rq {:.3} µm, from order \
             {ROUGH} on {:.1} nm; of waves of {:.2} mm ({:.1} kHz) nothing is left; step ≤ {:.0} µs",
            number(1e9 * self.amplitude),
            number(self.slope),
            1e6 * self.roughness,
            1e9 * self.fine_roughness,
            1e3 * self.shortest,
            1e-3 * self.frequency,
            1e6 * self.largest_step
        )
    }
}
