//! A ball and a race under the reference load, and the numbers of their film.

use super::oil::Oil;
use crate::contact::laws::elastic::elliptic;
use crate::contact::laws::elastic::hertz::Hertz;

/// A race of a row as its film sees it, without the film's thickness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LubricatedRace {
    /// σ: +1 outer, −1 inner.
    pub sigma: f64,
    /// D \[m\].
    pub ball_diameter: f64,
    /// d_m \[m\].
    pub pitch_diameter: f64,
    /// r_g \[m\].
    pub groove_radius: f64,
    /// α₀ \[rad\].
    pub contact_angle: f64,
    /// E' of 2/E' = Σ (1 − ν_P²)/E \[Pa\].
    pub reduced_modulus: f64,
}

impl LubricatedRace {
    /// γ = D cos α₀/d_m.
    fn gamma(&self) -> f64 {
        self.ball_diameter * self.contact_angle.cos() / self.pitch_diameter
    }

    /// 1/R_x = 2/D − 2σγ/(D(1 + σγ)) and 1/R_y = 2/D − 1/r_g (12.6) \[1/m\].
    fn curvatures(&self) -> [f64; 2] {
        let (d, turned) = (self.ball_diameter, self.sigma * self.gamma());
        let along = 2.0 / d - 2.0 * turned / (d * (1.0 + turned));
        [along, 2.0 / d - 1.0 / self.groove_radius]
    }

    /// The least load that a film is computed for, 1e-6 E'R_x² (12.7) \[N\].
    pub(crate) fn least_load(&self) -> f64 {
        let [along, _] = self.curvatures();
        1e-6 * self.reduced_modulus / (along * along)
    }

    /// u_ref = Ω d_m (1 − γ²)/4: mean surface speed at a contact of balls that roll, the rings turning against each other at
    /// a speed \[rad/s\].
    pub(crate) fn entrainment(&self, speed: f64) -> f64 {
        speed.abs() * self.pitch_diameter * (1.0 - self.gamma().powi(2)) / 4.0
    }
}

/// Ball and race under the reference load: Hertz's contact, and how they roll at the reference speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Conjunction {
    /// R_x and R_y \[m\].
    pub radii: [f64; 2],
    /// a \[m\].
    pub half_length: f64,
    /// b \[m\].
    pub half_width: f64,
    /// ε = b/a.
    pub axis_ratio: f64,
    /// Ê, complete elliptic integral of the second kind of modulus √(1 − ε²).
    pub elliptic: f64,
    /// p_0 \[Pa\].
    pub pressure: f64,
    /// Q_ref \[N\].
    pub load: f64,
    /// E' \[Pa\].
    pub modulus: f64,
    /// u_ref \[m/s\].
    pub entrainment: f64,
}

impl Conjunction {
    pub fn new(race: &LubricatedRace, load: f64, speed: f64) -> Self {
        let [along, across] = race.curvatures();
        let hertz = Hertz::of_curvatures(along, across, 0.5 * race.reduced_modulus);
        let axis_ratio = hertz.half_width / hertz.half_length;
        Self {
            radii: [1.0 / along, 1.0 / across],
            half_length: hertz.half_length * load.cbrt(),
            half_width: hertz.half_width * load.cbrt(),
            axis_ratio,
            elliptic: elliptic::complete(1.0 - axis_ratio * axis_ratio).1,
            pressure: hertz.pressure(load),
            load,
            modulus: race.reduced_modulus,
            entrainment: race.entrainment(speed),
        }
    }

    /// The dimensionless groups with an oil.
    pub fn groups(&self, oil: &Oil) -> Groups {
        let [along, _] = self.radii;
        Groups {
            speed: oil.viscosity * self.entrainment / (self.modulus * along),
            material: oil.pressure_viscosity * self.modulus,
            load: self.load / (self.modulus * along * along),
            heat: oil.viscosity * oil.temperature_viscosity * self.entrainment.powi(2)
                / oil.conductivity,
        }
    }
}

/// Dimensionless groups of a film at the reference load and speed (12.8).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Groups {
    /// U = η u_ref/(E'R_x).
    pub speed: f64,
    /// G = α_p E'.
    pub material: f64,
    /// W = Q_ref/(E'R_x²).
    pub load: f64,
    /// L_T = η β_T u_ref²/k_l.
    pub heat: f64,
}

impl Groups {
    /// U_s = 2 U, by the sum of the surfaces' speeds.
    pub fn sum_speed(&self) -> f64 {
        2.0 * self.speed
    }

    /// Moes' L = G U_s^{1/4}.
    pub fn moes(&self) -> f64 {
        self.material * self.sum_speed().powf(0.25)
    }
}
