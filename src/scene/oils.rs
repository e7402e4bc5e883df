//! Named oils, properties of base oils, and an oil's data sheet.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A base oil.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Base {
    /// Paraffinic mineral oil.
    #[default]
    Mineral,
    /// Naphthenic mineral oil.
    Naphthenic,
    /// Polyalphaolefin.
    Pao,
    /// Polyalkylene glycol.
    Pag,
    /// An ester, whose pressure-viscosity and limiting stress must be given.
    Ester,
}

impl Base {
    /// s and t of the pressure-viscosity coefficient α_p = s ν̂^t · 1e-9 1/Pa, with ν̂ in mm²/s; `None` for an ester.
    ///
    /// Source: P. W. Gold, A. Schmidt, H. Dicke, J. Loos, C. Assmann, J. Synth. Lubr. 18 (2001) 51.
    pub fn gold(self) -> Option<[f64; 2]> {
        match self {
            Self::Mineral | Self::Naphthenic => Some([9.904, 0.139]),
            Self::Pao => Some([7.382, 0.1335]),
            Self::Pag => Some([5.489, 0.1485]),
            Self::Ester => None,
        }
    }

    /// Limiting shear stress over pressure Λ; `None` for an ester.
    ///
    /// Source: E. Höglund's measurements, from A. Arana et al. 2019.
    pub fn limiting_stress(self) -> Option<f64> {
        match self {
            Self::Mineral => Some(0.047),
            Self::Naphthenic => Some(0.053),
            Self::Pao => Some(0.035),
            Self::Pag => Some(0.044),
            Self::Ester => None,
        }
    }
}

impl fmt::Display for Base {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Mineral => "mineral",
            Self::Naphthenic => "naphthenic",
            Self::Pao => "pao",
            Self::Pag => "pag",
            Self::Ester => "ester",
        })
    }
}

/// An oil that has a name.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct NamedOil {
    /// Name of the oil in a document.
    pub name: &'static str,
    /// Kinematic viscosity at 40 °C \[m²/s\].
    pub viscosity_40: f64,
    /// Kinematic viscosity at 100 °C \[m²/s\].
    pub viscosity_100: f64,
    /// Density at 15 °C \[kg/m³\].
    pub density_15: f64,
    /// Base oil.
    pub base: Base,
    /// Source of the oil's numbers.
    pub source: &'static str,
}

/// The oils that a document may name: mineral oils of ISO viscosity grades, and a reference oil of gear research.
pub const NAMED_OILS: [NamedOil; 5] = [
    grade("vg32", 32e-6, 5.4e-6),
    grade("vg68", 68e-6, 8.7e-6),
    grade("vg100", 100e-6, 11e-6),
    grade("vg220", 220e-6, 19e-6),
    NamedOil {
        name: "fva3",
        viscosity_40: 96e-6,
        viscosity_100: 10.6e-6,
        density_15: 882.0,
        base: Base::Mineral,
        source: "data sheet of the reference oil FVA 3",
    },
];

/// A mineral oil of an ISO viscosity grade.
const fn grade(name: &'static str, viscosity_40: f64, viscosity_100: f64) -> NamedOil {
    NamedOil {
        name,
        viscosity_40,
        viscosity_100,
        density_15: 880.0,
        base: Base::Mineral,
        source: "ISO 3448 viscosity grade, viscosity index about 95",
    }
}

/// The oil of a name, if there is one.
pub fn named_oil(name: &str) -> Option<&'static NamedOil> {
    NAMED_OILS.iter().find(|oil| oil.name == name)
}

/// Source of a number of an oil.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum OilSource {
    /// The lubricant gives it.
    #[serde(rename = "given")]
    Given,
    /// Number of the named oil.
    #[serde(rename = "named oil")]
    NamedOil,
    /// Number of the base oil.
    #[serde(rename = "base")]
    Base,
    /// Number by viscosity and base oil, after P. W. Gold et al. 2001.
    #[serde(rename = "Gold et al. 2001")]
    Gold,
    /// Default of the document.
    #[serde(rename = "default")]
    Default,
}

/// A number of an oil and where it comes from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Sourced {
    /// The number, SI.
    pub value: f64,
    /// Source of the number.
    pub source: OilSource,
}

/// Properties of an oil, by name or as given.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct OilSheet {
    /// Kinematic viscosity at 40 °C \[m²/s\].
    pub viscosity_40: Sourced,
    /// Kinematic viscosity at 100 °C \[m²/s\].
    pub viscosity_100: Sourced,
    /// Density at 15 °C \[kg/m³\].
    pub density_15: Sourced,
    /// Base oil.
    pub base: Base,
    /// Pressure-viscosity coefficient α_p \[1/Pa\], if it is given; else it follows from viscosity and base.
    pub pressure_viscosity: Option<f64>,
    /// Limiting shear stress over pressure Λ.
    pub limiting_stress: Sourced,
}

/// Unit of kinematic viscosity, 1 mm²/s, in which viscosities stand in ASTM D341 and in Gold's formula \[m²/s\].
pub(crate) const CENTISTOKE: f64 = 1e-6;
/// 40 and 100 °C \[K\].
const AT_40: f64 = 313.15;
const AT_100: f64 = 373.15;

impl OilSheet {
    /// Kinematic viscosity ν \[m²/s\] and its slope β_T = −d ln ν/dT \[1/K\] at a temperature \[K\].
    ///
    /// ```text
    /// log10 log10(ν̂ + 0.7) = A − B log10 T                     (12.1), ν̂ in mm²/s
    /// β_T = B (ν̂ + 0.7) ln(ν̂ + 0.7) / (ν̂ T)                   (12.3)
    /// ```
    ///
    /// Source: ASTM D341, for viscosities above 0.3 mm²/s.
    pub fn kinematic_viscosity(&self, temperature: f64) -> [f64; 2] {
        let doubled = |of: Sourced| (of.value / CENTISTOKE + 0.7).log10().log10();
        let (warm, hot) = (doubled(self.viscosity_40), doubled(self.viscosity_100));
        let slope = (warm - hot) / (AT_100 / AT_40).log10();
        let shifted = 10_f64.powf(10_f64.powf(warm - slope * (temperature / AT_40).log10()));
        let viscosity = shifted - 0.7;
        let steepness = slope * shifted * shifted.ln() / (viscosity * temperature);
        [viscosity * CENTISTOKE, steepness]
    }

    /// Source of the pressure-viscosity coefficient.
    pub fn pressure_viscosity_source(&self) -> OilSource {
        match self.pressure_viscosity {
            Some(_) => OilSource::Given,
            None => OilSource::Gold,
        }
    }
}
