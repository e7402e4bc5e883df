//! Texture: what grinding and honing leave on races and balls.

use serde::{Deserialize, Serialize};

use super::absent;
use super::numbers::{BoundedNumber, POSITIVE};

/// Many small waves around the races and balls of a row, with random phases and amplitudes that fall with their order n (`docs/model.md`,
/// *Geometry of a row*): A_n = A_30 (30/n)^slope, times √(−ln v) with v uniform between 0 and 1.
///
/// ```
/// use ballrace::scene::{Texture, presets};
/// let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
/// scene.rows[0].texture = Some(Texture::of_races(1e-9));
/// assert!(scene.validate().is_ok());
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct Texture {
    /// Amplitude of the outer race at order 30, A_30 \[m\], 0 to 1 µm.
    pub outer: f64,
    /// The same of the inner race \[m\].
    pub inner: f64,
    /// The same of the balls \[m\]. Balls as smooth as a race of radius R at equal wavelengths have A_30 (D/2R)^slope.
    pub ball: f64,
    /// Exponent by which amplitudes fall with the order, 0.5 to 4. Default 2.
    pub slope: f64,
    /// Lowest and highest order on races, 2 to 20 000; absent: from 2 to that whose waves are as long as half of a contact's width. On
    /// balls the highest order is that of waves as short on them, if it is lower.
    #[serde(skip_serializing_if = "absent::none")]
    pub orders: Option<[u32; 2]>,
    /// Seed of phases and amplitudes, 0 to 2⁵³ − 1.
    pub seed: u64,
    /// Load of the contact over whose width waves are averaged \[N\]; absent: that of the equilibrium at the start.
    #[serde(skip_serializing_if = "absent::none")]
    pub reference_load: Option<f64>,
}

impl Default for Texture {
    fn default() -> Self {
        Self {
            outer: 0.0,
            inner: 0.0,
            ball: 0.0,
            slope: 2.0,
            orders: None,
            seed: 0,
            reference_load: None,
        }
    }
}

impl Texture {
    /// Largest seed: every document holds it exactly.
    const LARGEST_SEED: u64 = (1 << 53) - 1;

    /// Numbers of the texture.
    pub(super) fn numbers(&self) -> [BoundedNumber; 6] {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            outer,
            inner,
            ball,
            slope,
            orders: _,
            seed,
            reference_load,
        } = *self;
        // At least the largest: a larger one is not exact.
        let seeds = 0.0..=Self::LARGEST_SEED as f64;
        [
            BoundedNumber::new("outer", outer, 0.0..=1e-6, "m"),
            BoundedNumber::new("inner", inner, 0.0..=1e-6, "m"),
            BoundedNumber::new("ball", ball, 0.0..=1e-6, "m"),
            BoundedNumber::new("slope", slope, 0.5..=4.0, ""),
            BoundedNumber::new("seed", seed as f64, seeds, ""),
            BoundedNumber::new("reference_load", reference_load, POSITIVE, "N"),
        ]
    }

    /// Lowest order where none is given.
    const FIRST: u32 = 2;
    /// Highest order that any may have.
    pub(crate) const LAST: u32 = 20_000;
    /// The order at which amplitudes are given.
    const AT: f64 = 30.0;

    /// The texture of both races alike, with an amplitude at order 30 \[m\], all else by default.
    pub fn of_races(amplitude: f64) -> Self {
        Self {
            outer: amplitude,
            inner: amplitude,
            ..Self::default()
        }
    }

    /// A_n of an amplitude at order 30.
    pub(crate) fn amplitude(&self, at_30: f64, order: u32) -> f64 {
        at_30 * (Self::AT / f64::from(order)).powf(self.slope)
    }

    /// Lowest and highest order on a race or ball whose contact's half-width is so much of its radius: by default waves down to
    /// that half-width.
    pub(crate) fn orders_on(&self, arc: f64) -> [u32; 2] {
        // At most 20 000.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let shortest = (std::f64::consts::TAU / arc).min(f64::from(Self::LAST)) as u32;
        let [first, last] = self.orders.unwrap_or([Self::FIRST, shortest]);
        [first, last.max(first)]
    }

    /// The same on a ball, which ends where its own waves are as short.
    pub(crate) fn orders_on_ball(&self, arc: f64) -> [u32; 2] {
        let own = Self {
            orders: None,
            ..self.clone()
        };
        let ([_, shortest], [first, last]) = (own.orders_on(arc), self.orders_on(arc));
        [first, last.min(shortest).max(first)]
    }

    /// Root mean square of a surface between two orders \[m\], of an amplitude at order 30.
    pub(crate) fn roughness(&self, at_30: f64, [first, last]: [u32; 2]) -> f64 {
        let squares = (first..=last).map(|order| self.amplitude(at_30, order).powi(2));
        (0.5 * squares.sum::<f64>()).sqrt()
    }
}
