//! An oil at its temperature.

use crate::base::error::Result;
use crate::scene::{CENTISTOKE, Lubricant};

/// 15 °C \[K\].
const AT_15: f64 = 288.15;

/// Properties of an oil at its temperature, and what is asked of its film.
///
/// ```text
/// log10 log10(ν̂ + 0.7) = A − B log10 T                    (12.1)
/// ρ = ρ_15 [1 − 6.5e-4 (T − 288.15)],   η = ρ ν           (12.2)
/// β_T = −d ln ν/dT = B (ν̂ + 0.7) ln(ν̂ + 0.7) / (ν̂ T)     (12.3)
/// α_p = s ν̂^t · 1e-9                                       (12.4)
/// ```
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | ν, ν̂ | kinematic viscosity | m²/s, mm²/s |
/// | T | temperature | K |
/// | ρ, η | density, dynamic viscosity | kg/m³, Pa s |
/// | β_T, α_p | temperature- and pressure-viscosity coefficient | 1/K, 1/Pa |
///
/// Source: ASTM D341 (12.1); P. W. Gold et al., J. Synth. Lubr. 18 (2001) 51 (12.4). Valid from 233 to 473 K.
///
/// ```
/// use ballrace::{contact::film::Oil, scene::Lubricant};
/// let oil = Oil::new(&Lubricant::named("vg68", 328.15))?;
/// assert!((oil.viscosity - 0.029842).abs() < 1e-6);
/// # Ok::<(), ballrace::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oil {
    /// ν \[m²/s\].
    pub kinematic_viscosity: f64,
    /// ρ \[kg/m³\].
    pub density: f64,
    /// η \[Pa s\].
    pub viscosity: f64,
    /// β_T \[1/K\].
    pub temperature_viscosity: f64,
    /// α_p \[1/Pa\].
    pub pressure_viscosity: f64,
    /// Λ, limiting shear stress over pressure.
    pub limiting_stress: f64,
    /// μ_b, friction coefficient of asperities.
    pub boundary_friction: f64,
    /// k_l \[W/(m K)\].
    pub conductivity: f64,
    /// s_q, root mean square of both surfaces together \[m\].
    pub roughness: f64,
    /// h_oil, free oil in front of a contact \[m\]; none: flooded.
    pub layer: Option<f64>,
    /// α_h, hysteresis loss of the steel.
    pub hysteresis: f64,
    /// v_0 \[m/s\].
    pub slip_floor: f64,
    /// f_d \[Hz\]; none: that of the contact itself.
    pub damping_frequency: Option<f64>,
}

impl Oil {
    /// The oil of a lubricant at its temperature.
    ///
    /// # Errors
    /// Those of [`Lubricant::sheet`]; a scene that was validated has none.
    pub fn new(lubricant: &Lubricant) -> Result<Self> {
        let sheet = lubricant.sheet()?;
        let temperature = lubricant.temperature;
        let [kinematic_viscosity, temperature_viscosity] = sheet.kinematic_viscosity(temperature);
        let density = sheet.density_15.value * (1.0 - 6.5e-4 * (temperature - AT_15));
        // A base without coefficients has its α_p given, or has no sheet.
        let [s, t] = sheet.base.gold().unwrap_or_default();
        let gold = s * (kinematic_viscosity / CENTISTOKE).powf(t) * 1e-9;
        Ok(Self {
            kinematic_viscosity,
            density,
            viscosity: density * kinematic_viscosity,
            temperature_viscosity,
            pressure_viscosity: sheet.pressure_viscosity.unwrap_or(gold),
            limiting_stress: sheet.limiting_stress.value,
            boundary_friction: lubricant.boundary_friction,
            conductivity: lubricant.conductivity,
            roughness: lubricant.roughness,
            layer: lubricant.oil_layer.thickness(),
            hysteresis: lubricant.hysteresis,
            slip_floor: lubricant.slip_floor,
            damping_frequency: lubricant.damping_frequency,
        })
    }
}
