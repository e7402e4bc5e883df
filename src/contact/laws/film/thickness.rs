//! Thickness of a film.

use super::conjunction::{Conjunction, Groups};

/// Film thickness of an elliptical contact by the speed it rolls at.
///
/// ```text
/// h_HD = 2.69 R_x U^0.67 G^0.53 W^−0.067 (1 − 0.61 e^{−0.73/ε})        (12.10)
/// h_f = h_HD X / (1 + L_T^0.62 X²/3.94),   X = w̃^{2/3}                 (12.11)
/// h = h_f h_oil/√(h_f² + h_oil²);  flooded: h = h_f                     (12.12)
/// ```
///
/// Source: B. J. Hamrock, D. Dowson 1977, central film; L. E. Murch, W. R. D. Wilson 1975, heat of the inlet; the form of
/// starvation of F. Chevalier and B. Damiens with exponent 2. Valid for 1/ε from 1 to 8, beyond which the ellipse's
/// factor has saturated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Thickness {
    /// h_HD \[m\].
    pub isothermal: f64,
    /// L_T^0.62/3.94.
    heat: f64,
    /// h_oil \[m\]; none: flooded.
    layer: Option<f64>,
}

impl Thickness {
    pub fn new(at: &Conjunction, groups: &Groups, layer: Option<f64>) -> Self {
        Self {
            isothermal: at.radii[0] * hamrock_dowson(groups, at.axis_ratio),
            heat: groups.heat.powf(0.62) / 3.94,
            layer,
        }
    }

    /// h_f \[m\] where there is oil enough, by X.
    pub fn flooded(&self, speed_power: f64) -> f64 {
        self.isothermal * speed_power / (1.0 + self.heat * speed_power * speed_power)
    }

    /// h \[m\] that becomes of h_f.
    pub fn starved(&self, flooded: f64) -> f64 {
        match self.layer {
            Some(layer) => flooded * layer / flooded.hypot(layer),
            None => flooded,
        }
    }
}

/// h_HD over R_x.
fn hamrock_dowson(groups: &Groups, axis_ratio: f64) -> f64 {
    let Groups {
        speed,
        material,
        load,
        ..
    } = *groups;
    let ellipse = 1.0 - 0.61 * (-0.73 / axis_ratio).exp();
    2.69 * speed.powf(0.67) * material.powf(0.53) * load.powf(-0.067) * ellipse
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The case of D-BRAIN's tests: R_x, R_y \[m\], E' \[Pa\], η \[Pa s\], u \[m/s\].
    const RADIUS: f64 = 1e-3 / (2.0 / 4.365 + 1.0 / 40.635);
    const ACROSS: f64 = 1e-3 / (2.0 / 4.365 - 1.0 / 2.3571);
    const MODULUS: f64 = 207e9 / 0.91;
    const VISCOSITY: f64 = 0.043_691;
    const SPEED: f64 = 22.360_94;

    fn groups() -> Groups {
        Groups {
            speed: VISCOSITY * SPEED / (MODULUS * RADIUS),
            material: 0.2 / 9.8067e6 * MODULUS,
            load: 136.0 / (MODULUS * RADIUS * RADIUS),
            heat: VISCOSITY * 7.5e-4 * SPEED * SPEED / 0.145,
        }
    }

    /// Literature: a test of the public bearing code D-BRAIN, to six digits.
    #[test]
    fn film_is_that_of_another_code() {
        let ellipticity = 1.0339 * (ACROSS / RADIUS).powf(0.636);
        let found = RADIUS * hamrock_dowson(&groups(), 1.0 / ellipticity);
        assert!((found / 1.334_318e-6 - 1.0).abs() < 1e-6, "{found:e}");
    }

    /// Literature: the factor of heat of the same code.
    #[test]
    fn heat_factor_is_that_of_another_code() {
        let film = Thickness {
            isothermal: 1.0,
            heat: groups().heat.powf(0.62) / 3.94,
            layer: None,
        };
        let found = film.flooded(1.0);
        assert!((found / 0.938_372 - 1.0).abs() < 1e-6, "{found}");
    }

    /// Limits: much oil is as good as flooded, little oil is the film.
    #[test]
    fn a_thin_layer_of_oil_is_the_film() {
        let film = |layer| Thickness {
            isothermal: 1.0,
            heat: 0.0,
            layer,
        };
        assert_eq!(film(Some(1e9)).starved(2.0), film(None).starved(2.0));
        assert!((film(Some(1e-9)).starved(2.0) / 1e-9 - 1.0).abs() < 1e-15);
    }
}
