//! The oil between balls and races: its data sheet, and which effects of its film are computed.

use std::ops::{Bound, RangeInclusive};

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::numbers::{BoundedNumber, NumberRange, POSITIVE, up_to};
use super::oils::{Base, NAMED_OILS, NamedOil, OilSheet, OilSource, Sourced, named_oil};
use super::word;
use crate::base::error::{Error, Result};

/// 0 °C \[K\].
const CELSIUS: f64 = 273.15;
/// Coefficients of friction.
const FRICTIONS: NumberRange = (Bound::Excluded(0.0), Bound::Excluded(0.5));
/// Density of a mineral oil at 15 °C \[kg/m³\].
const DENSITY_15: f64 = 880.0;

/// Oil of the contacts of balls and races ([*Film*](crate::equations#film)): by name, or by its data sheet.
///
/// Its traction replaces the scene's friction law in these contacts, unless [`Self::traction`] is false.
/// A document may give `temperature_c` \[°C\] in place of `temperature`.
///
/// ```
/// use ballrace::scene::Lubricant;
/// let oil = Lubricant::named("vg68", 328.15).sheet()?;
/// assert_eq!(oil.viscosity_40.value, 68e-6);
/// # Ok::<(), ballrace::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(remote = "Self", deny_unknown_fields)]
#[serde(default = "Lubricant::without_temperature")]
// Four effects that are there or not, each by itself.
#[allow(clippy::struct_excessive_bools)]
#[non_exhaustive]
pub struct Lubricant {
    /// Name of an oil of [`NAMED_OILS`]; absent: both viscosities are given.
    pub oil: Option<String>,
    /// Kinematic viscosity at 40 °C \[m²/s\]; absent: the named oil's.
    pub viscosity_40: Option<f64>,
    /// Kinematic viscosity at 100 °C \[m²/s\]; absent: the named oil's.
    pub viscosity_100: Option<f64>,
    /// Density at 15 °C \[kg/m³\]; absent: the named oil's, or 880.
    pub density_15: Option<f64>,
    /// Temperature at the inlets of the contacts \[K\], 233 to 473; constant during a run.
    pub temperature: f64,
    /// Base oil, from which pressure-viscosity and limiting stress follow; absent: the named oil's, or mineral.
    pub base: Option<Base>,
    /// Pressure-viscosity coefficient α_p \[1/Pa\]; absent: by base and viscosity, after Gold et al.
    pub pressure_viscosity: Option<f64>,
    /// Limiting shear stress over pressure Λ, above 0 and below 0.5; absent: by base.
    pub limiting_stress: Option<f64>,
    /// Friction coefficient of asperities μ_b, above 0 and below 0.5. Default 0.12.
    pub boundary_friction: f64,
    /// Thermal conductivity k_l \[W/(m K)\]. Default 0.134.
    pub conductivity: f64,
    /// Root mean square roughness of both surfaces together s_q \[m\]. Default 1e-7.
    pub roughness: f64,
    /// Free oil in front of a contact h_oil \[m\]. Default 1e-5.
    pub oil_layer: OilLayer,
    /// Share of the elastic work that the steel loses by hysteresis α_h. Default 0.007.
    pub hysteresis: f64,
    /// Lower bound v_0 of the slip speed over which traction rises \[m/s\]: numerical, larger is faster and less exact. Default 5e-4.
    pub slip_floor: f64,
    /// Frequency f_d at which the film's damping is taken \[Hz\]; absent: the contacts' own.
    pub damping_frequency: Option<f64>,
    /// Relative speed of the rings for which films are computed Ω_ref \[rad/s\]; absent: the largest that is given.
    pub reference_speed: Option<f64>,
    /// Load of a contact for which films are computed Q_ref \[N\]; absent: that of the equilibrium at the start.
    pub reference_load: Option<f64>,
    /// Volume share X_oil of oil in the space through which balls move, for their drag, 0 to 1. Default 0: no drag.
    pub fill: f64,
    /// Whether the film separates the surfaces. Default true.
    pub film: bool,
    /// Whether the film damps their approach. Default true.
    pub damping: bool,
    /// Whether the film's traction replaces dry friction. Default true.
    pub traction: bool,
    /// Whether the film resists rolling. Default true.
    pub rolling: bool,
    /// Temperature \[°C\], only while a document is read.
    #[serde(skip_serializing)]
    temperature_c: Option<f64>,
}

/// Free oil in front of a contact: a number, or `"flooded"`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = r#"a number [m], or "flooded""#)]
#[non_exhaustive]
pub enum OilLayer {
    /// A layer of this thickness \[m\], which bounds the film.
    Thickness(f64),
    /// Oil as much as the film needs.
    #[serde(with = "word::flooded")]
    Flooded,
}

impl OilLayer {
    /// Thickness of the layer \[m\]; `None` where the contact is flooded.
    pub fn thickness(self) -> Option<f64> {
        match self {
            Self::Thickness(value) => Some(value),
            Self::Flooded => None,
        }
    }
}

impl From<f64> for OilLayer {
    fn from(value: f64) -> Self {
        Self::Thickness(value)
    }
}

impl Lubricant {
    /// Viscosities \[m²/s\] from the lower limit of ASTM D341 to that above which no oil flows into a contact.
    pub(super) const VISCOSITIES: RangeInclusive<f64> = 0.3e-6..=0.1;

    /// Numbers of the oil by its data sheet, where it has them; by name or as given.
    pub(super) fn numbers_of_oil(&self) -> [BoundedNumber; 6] {
        let viscosity = |field, value| {
            let unit = "m²/s; a viscosity of 68 mm²/s is 68e-6";
            BoundedNumber::new(field, value, Self::VISCOSITIES, unit)
        };
        // Temperatures at which the formulas of oils hold.
        let (temperatures, kelvin) = (233.0..=473.0, "K, which is -40 to 200 °C");
        let coefficient = self.pressure_viscosity;
        [
            BoundedNumber::new("temperature", self.temperature, temperatures, kelvin),
            viscosity("viscosity_40", self.viscosity_40),
            viscosity("viscosity_100", self.viscosity_100),
            BoundedNumber::new("density_15", self.density_15, 100.0..=1e4, "kg/m³"),
            BoundedNumber::new("pressure_viscosity", coefficient, 1e-10..=1e-6, "1/Pa"),
            BoundedNumber::new("limiting_stress", self.limiting_stress, FRICTIONS, ""),
        ]
    }

    /// Numbers of the lubricant beside those of its oil.
    pub(super) fn numbers(&self) -> [BoundedNumber; 10] {
        let layer = self.oil_layer.thickness();
        let [frequency, speed, load] = [
            self.damping_frequency,
            self.reference_speed,
            self.reference_load,
        ];
        [
            BoundedNumber::new("boundary_friction", self.boundary_friction, FRICTIONS, ""),
            BoundedNumber::new("conductivity", self.conductivity, 1e-3..=1e3, "W/(m K)"),
            BoundedNumber::new("roughness", self.roughness, up_to(1.0), "m"),
            BoundedNumber::new("oil_layer", layer, up_to(1.0), "m"),
            BoundedNumber::new("hysteresis", self.hysteresis, 0.0..=1.0, ""),
            BoundedNumber::new("slip_floor", self.slip_floor, 1e-9..=1e3, "m/s"),
            BoundedNumber::new("fill", self.fill, 0.0..=1.0, ""),
            BoundedNumber::new("damping_frequency", frequency, POSITIVE, "Hz"),
            BoundedNumber::new("reference_speed", speed, POSITIVE, "rad/s"),
            BoundedNumber::new("reference_load", load, POSITIVE, "N"),
        ]
    }

    /// Whether the oil does anything: all of its effects may be left out.
    pub(crate) fn acts(&self) -> bool {
        self.film || self.damping || self.traction || self.rolling || self.fill > 0.0
    }

    /// An oil of [`NAMED_OILS`] at a temperature \[K\], all else by default.
    pub fn named(oil: &str, temperature: f64) -> Self {
        Self {
            oil: Some(oil.to_owned()),
            temperature,
            ..Self::without_temperature()
        }
    }

    /// A mineral oil of kinematic viscosities at 40 and 100 °C \[m²/s\] at a temperature \[K\], all else by default.
    pub fn new(viscosity_40: f64, viscosity_100: f64, temperature: f64) -> Self {
        Self {
            viscosity_40: Some(viscosity_40),
            viscosity_100: Some(viscosity_100),
            temperature,
            ..Self::without_temperature()
        }
    }

    fn without_temperature() -> Self {
        Self {
            oil: None,
            viscosity_40: None,
            viscosity_100: None,
            density_15: None,
            temperature: f64::NAN,
            base: None,
            pressure_viscosity: None,
            limiting_stress: None,
            boundary_friction: 0.12,
            conductivity: 0.134,
            roughness: 1e-7,
            oil_layer: OilLayer::Thickness(1e-5),
            hysteresis: 0.007,
            slip_floor: 5e-4,
            damping_frequency: None,
            reference_speed: None,
            reference_load: None,
            fill: 0.0,
            film: true,
            damping: true,
            traction: true,
            rolling: true,
            temperature_c: None,
        }
    }

    /// The oil's data sheet: each number as given, else that of the named oil, else that of the base oil.
    ///
    /// # Errors
    /// [`Error::Scene`] for an unknown name, and for a number that is missing.
    pub fn sheet(&self) -> Result<OilSheet> {
        self.sheet_at("lubricant")
    }

    /// The same of a lubricant at a path of the document.
    pub(crate) fn sheet_at(&self, path: &str) -> Result<OilSheet> {
        let named = self.named_at(path)?;
        let base = self.base.or(named.map(|oil| oil.base)).unwrap_or_default();
        let viscosity = |field, given: Option<f64>, of: fn(&NamedOil) -> f64| {
            sourced(given, named.map(of)).ok_or_else(|| {
                let allowed = "a kinematic viscosity [m²/s], or the name of an oil in `oil`";
                Error::scene(format!("{path}.{field}"), "absent", allowed)
            })
        };
        let density = sourced(self.density_15, named.map(|oil| oil.density_15));
        Ok(OilSheet {
            viscosity_40: viscosity("viscosity_40", self.viscosity_40, |oil| oil.viscosity_40)?,
            viscosity_100: viscosity("viscosity_100", self.viscosity_100, |oil| oil.viscosity_100)?,
            density_15: density.unwrap_or(Sourced {
                value: DENSITY_15,
                source: OilSource::Default,
            }),
            base,
            pressure_viscosity: self.pressure_viscosity(path, base)?,
            limiting_stress: self.limiting_stress(path, base)?,
        })
    }

    fn named_at(&self, path: &str) -> Result<Option<&'static NamedOil>> {
        let Some(name) = &self.oil else {
            return Ok(None);
        };
        let known = || NAMED_OILS.map(|oil| oil.name).join(", ");
        match named_oil(name) {
            Some(oil) => Ok(Some(oil)),
            None => Err(Error::scene(
                format!("{path}.oil"),
                name,
                format!(
                    "one of {}, or absent where viscosity_40 and viscosity_100 are given",
                    known()
                ),
            )),
        }
    }

    fn pressure_viscosity(&self, path: &str, base: Base) -> Result<Option<f64>> {
        if self.pressure_viscosity.is_none() && base.gold().is_none() {
            return Err(of_no_base(path, "pressure_viscosity", base));
        }
        Ok(self.pressure_viscosity)
    }

    fn limiting_stress(&self, path: &str, base: Base) -> Result<Sourced> {
        let given = self.limiting_stress.map(|value| (value, OilSource::Given));
        let of_base = base.limiting_stress().map(|value| (value, OilSource::Base));
        match given.or(of_base) {
            Some((value, source)) => Ok(Sourced { value, source }),
            None => Err(of_no_base(path, "limiting_stress", base)),
        }
    }
}

fn sourced(given: Option<f64>, named: Option<f64>) -> Option<Sourced> {
    let given = given.map(|value| (value, OilSource::Given));
    let (value, source) = given.or(named.map(|value| (value, OilSource::NamedOil)))?;
    Some(Sourced { value, source })
}

fn of_no_base(path: &str, field: &str, base: Base) -> Error {
    Error::scene(
        format!("{path}.{field}"),
        "absent",
        format!("a number, since oils of base {base} differ too much for a formula"),
    )
}

impl Serialize for Lubricant {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        Self::serialize(self, serializer)
    }
}

impl<'de> Deserialize<'de> for Lubricant {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        let mut read = Self::deserialize(deserializer)?;
        let refuse = |text| Err(serde::de::Error::custom(text));
        match (read.temperature.is_nan(), read.temperature_c.take()) {
            (true, None) => {
                return refuse("missing field `temperature` [K] or `temperature_c` [°C]");
            }
            (false, Some(_)) => return refuse("`temperature` and `temperature_c`: give one"),
            (true, Some(celsius)) => read.temperature = celsius + CELSIUS,
            (false, None) => {}
        }
        Ok(read)
    }
}
