//! Elastic constants and densities.

use serde::{Deserialize, Serialize};

use super::numbers::BoundedNumber;

/// Materials of the parts.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Materials {
    /// Both rings.
    #[serde(default)]
    pub rings: Material,
    /// The balls.
    #[serde(default)]
    pub balls: Material,
}

/// A linear elastic, isotropic material; the default is bearing steel ([*Normal force*](crate::equations#normal-force)).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct Material {
    /// Density \[kg/m³\], 7850.
    pub density: f64,
    /// Young's modulus E \[Pa\], 206 GPa; used by the Hertz law.
    pub youngs_modulus: f64,
    /// Poisson's ratio ν, 0.3.
    pub poisson_ratio: f64,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            density: 7850.0,
            youngs_modulus: 206e9,
            poisson_ratio: 0.3,
        }
    }
}

impl Material {
    /// Density \[kg/m³\], Young's modulus \[Pa\] and Poisson's ratio.
    pub fn new(density: f64, youngs_modulus: f64, poisson_ratio: f64) -> Self {
        Self {
            density,
            youngs_modulus,
            poisson_ratio,
        }
    }
    /// Numbers of the material.
    pub(super) fn numbers(&self) -> [BoundedNumber; 3] {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            density,
            youngs_modulus,
            poisson_ratio,
        } = *self;
        [
            BoundedNumber::new("density", density, 1.0..=1e6, "kg/m³"),
            BoundedNumber::new("youngs_modulus", youngs_modulus, 1e3..=1e15, "Pa"),
            BoundedNumber::new("poisson_ratio", poisson_ratio, 0.0..=0.499, ""),
        ]
    }
}
