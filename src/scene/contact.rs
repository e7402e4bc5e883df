//! Normal law, slices, damping and friction of a ball on a race.

use serde::{Deserialize, Serialize};

use super::absent;
use super::numbers::{BoundedNumber, POSITIVE, PartNumbers, UNSAID as X, up_to};

/// Contact of a ball and a race: elastic law, slices, damping.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct Contact {
    /// Force of a slice from its penetration; Hertz's law by default.
    pub law: NormalLaw,
    /// Slices or nodes into which the ball is cut; 6 fitted nodes by default.
    pub slices: Slices,
    /// Hunt–Crossley damping α_d \[s/m\]: restitution is about 1 − α_d v at an impact speed v.
    pub damping: f64,
    /// Whether a slice that would pull is set to zero (and counted); `false` keeps the paper's bare sum.
    pub clamp_pull: bool,
    /// Film of grease or oil that damps the approach of ball and race where they do not press; absent: none.
    #[serde(skip_serializing_if = "absent::none")]
    pub squeeze: Option<SqueezeFilm>,
}

impl Contact {
    /// Numbers of the contact.
    pub(super) fn numbers(&self) -> [BoundedNumber; 1] {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            law: _,
            slices: _,
            damping,
            clamp_pull: _,
            squeeze: _,
        } = *self;
        [BoundedNumber::new("damping", damping, 0.0..=1e3, "s/m")]
    }
}

impl Default for Contact {
    fn default() -> Self {
        Self {
            law: NormalLaw::Hertz,
            slices: Slices::Fitted(6),
            damping: 0.2,
            clamp_pull: true,
            squeeze: None,
        }
    }
}

/// Squeeze film between ball and race ([`Squeeze`](crate::contact::Squeeze)): a force against the speed v at which a gap g closes,
/// c v/(1 + |g|/h), of a film that is pulled apart at most p.
///
/// It takes the rattle from balls that no load presses, and next to nothing from those that carry, whose approach is many times h.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct SqueezeFilm {
    /// Damping c where ball and race just touch \[N s/m\].
    pub damping: f64,
    /// Thickness h of the film \[m\].
    pub thickness: f64,
    /// Largest force p by which the film holds ball and race together \[N\].
    pub pull: f64,
}

impl SqueezeFilm {
    /// Numbers of the film.
    pub(super) fn numbers(&self) -> [BoundedNumber; 3] {
        let Self {
            damping,
            thickness,
            pull,
        } = *self;
        [
            BoundedNumber::new("damping", damping, 0.0..=1e4, "N s/m"),
            BoundedNumber::new("thickness", thickness, 1e-9..=1e-3, "m"),
            BoundedNumber::new("pull", pull, up_to(1e3), "N"),
        ]
    }
}

impl Default for SqueezeFilm {
    /// Starved grease in a 6205.
    fn default() -> Self {
        Self {
            damping: 15.0,
            thickness: 0.3e-6,
            pull: 0.02,
        }
    }
}

/// Elastic force of a slice.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum NormalLaw {
    /// The paper's law, after the roller slices of ISO/TS 16281: F = Σ c_s s^{10/9}. With the paper's constants ball and race
    /// approach about three times as far as by Hertz's law; [`crate::explain()`] gives the ratio at a scene's own load.
    Iso16281 {
        /// Constant of the law for lengths in metres \[N m^{−2}\]; 35948 N/mm² = 3.5948·10¹⁰.
        #[serde(default = "iso_constant")]
        constant: f64,
        /// Equivalent length of the line contact over the ball diameter, L_el / D.
        #[serde(default = "iso_length_ratio")]
        length_ratio: f64,
    },
    /// Hertz's point contact cut into slices along the common normal; exact at every load and angle.
    Hertz,
}

fn iso_constant() -> f64 {
    3.5948e10
}

fn iso_length_ratio() -> f64 {
    0.5
}

impl NormalLaw {
    /// Every law, with its usual constants.
    pub fn all() -> [Self; 2] {
        [Self::iso16281(), Self::Hertz]
    }

    /// The paper's law with the paper's constants.
    pub fn iso16281() -> Self {
        Self::Iso16281 {
            constant: iso_constant(),
            length_ratio: iso_length_ratio(),
        }
    }

    /// Description of the law in an explanation.
    pub(crate) fn description(&self) -> &'static str {
        match self {
            Self::Iso16281 { .. } => "roller slices after ISO/TS 16281, the paper's law",
            Self::Hertz => "Hertz's point contact",
        }
    }

    /// Whether the law's elements lie along the common tangent; such a law does not include the end of a groove.
    pub(crate) fn is_flat(&self) -> bool {
        match self {
            Self::Iso16281 { .. } => false,
            Self::Hertz => true,
        }
    }

    /// Steel by definition: whether the law has its stiffness, whatever the moduli of the materials.
    pub(super) fn is_of_steel(&self) -> bool {
        match self {
            Self::Iso16281 { .. } => *self == Self::iso16281(),
            Self::Hertz => false,
        }
    }

    /// Name of the law in a document, and its numbers.
    pub(super) fn numbers(&self) -> (&'static str, Vec<BoundedNumber>) {
        match *self {
            Self::Iso16281 {
                constant,
                length_ratio,
            } => {
                let numbers = vec![
                    BoundedNumber::new("constant", constant, 1.0..=1e16, ""),
                    BoundedNumber::new("length_ratio", length_ratio, 1e-3..=10.0, ""),
                ];
                ("iso16281", numbers)
            }
            Self::Hertz => ("hertz", Vec::new()),
        }
    }
}

/// Cutting of a ball into slices.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Slices {
    /// Slices of equal width over the whole ball, fixed in it: the paper's method. 10 to 100 000.
    Fixed(usize),
    /// Quadrature nodes on every smooth piece of the zone of contact, 2 to 64. 6 give the normal force F to a relative error of 2e-5
    /// (root mean square over loads, angles and defects) and friction to 1e-4 μF; where slip changes by more than 70 slip speeds
    /// over half a zone, friction only to some percent.
    Fitted(usize),
    /// Accuracy of fitted nodes, as many as give normal and friction force of rolling balls to this share of the normal force,
    /// 1e-9 to 1e-1; found for each race when the scene is compiled.
    Accuracy(f64),
}

impl Slices {
    /// The number of the way that cuts it, by the name of that.
    pub(super) fn numbers(&self) -> BoundedNumber {
        match *self {
            Self::Fixed(n) => BoundedNumber::new("fixed", n as f64, 10.0..=1e5, ""),
            Self::Fitted(n) => BoundedNumber::new("fitted", n as f64, 2.0..=64.0, ""),
            Self::Accuracy(share) => BoundedNumber::new("accuracy", share, 1e-9..=1e-1, ""),
        }
    }
}

/// Friction of a slice: force μ(u) F u⃗ / √(u² + v_s²) against the slip velocity u⃗.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum Friction {
    /// No friction.
    #[default]
    None,
    /// Constant coefficient.
    Coulomb {
        /// Coefficient μ.
        coefficient: f64,
        /// Slip speed v_s below which friction fades \[m/s\].
        slip_speed: f64,
    },
    /// Falls from a static to a kinetic coefficient: μ = μ_k + (μ_s − μ_k) exp(−(u/u_s)²).
    Stribeck {
        /// Static coefficient μ_s.
        static_coefficient: f64,
        /// Kinetic coefficient μ_k.
        kinetic_coefficient: f64,
        /// Stribeck speed u_s \[m/s\].
        stribeck_speed: f64,
        /// Slip speed v_s below which friction fades \[m/s\].
        slip_speed: f64,
    },
    /// A lubricated traction curve, μ = (a + b u) exp(−c u) + d (Gupta, *Advanced Dynamics of Rolling Elements*, 1984).
    Traction {
        /// a: traction at no slip, less d.
        a: f64,
        /// b: initial slope \[s/m\].
        b: f64,
        /// c: decay \[s/m\].
        c: f64,
        /// d: traction at high slip.
        d: f64,
        /// Slip speed v_s below which friction fades \[m/s\].
        slip_speed: f64,
    },
}

/// Slip \[m/s\] at the only stationary point of a traction curve (a + b u) exp(−c u) + d; 0 where it has none.
pub(super) fn extreme_slip([a, b, c]: [f64; 3]) -> f64 {
    if b == 0.0 || c == 0.0 {
        0.0
    } else {
        (1.0 / c - a / b).max(0.0)
    }
}

impl Friction {
    /// The slip speed below which it fades \[m/s\]; none without friction.
    pub(crate) fn slip_speed(&self) -> Option<f64> {
        match *self {
            Self::None => None,
            Self::Coulomb { slip_speed, .. }
            | Self::Stribeck { slip_speed, .. }
            | Self::Traction { slip_speed, .. } => Some(slip_speed),
        }
    }

    /// Name of the law in a document, and its numbers; none without friction.
    pub(super) fn numbers(&self) -> Option<(&'static str, Vec<BoundedNumber>)> {
        let slip = |speed: f64| BoundedNumber::new("slip_speed", speed, 1e-9..=1e3, "m/s");
        let number = |field, value: f64| BoundedNumber::new(field, value, 0.0..=1e6, "");
        // A traction curve may begin at or fall to less than nothing, if another part makes up for it.
        let signed = |field, value: f64| BoundedNumber::new(field, value, -1e6..=1e6, "");
        Some(match *self {
            Self::None => return None,
            Self::Coulomb {
                coefficient,
                slip_speed,
            } => {
                let numbers = vec![number("coefficient", coefficient), slip(slip_speed)];
                ("coulomb", numbers)
            }
            Self::Stribeck {
                static_coefficient,
                kinetic_coefficient,
                stribeck_speed,
                slip_speed,
            } => {
                let numbers = vec![
                    BoundedNumber::new("stribeck_speed", stribeck_speed, POSITIVE, "m/s"),
                    number("static_coefficient", static_coefficient),
                    number("kinetic_coefficient", kinetic_coefficient),
                    slip(slip_speed),
                ];
                ("stribeck", numbers)
            }
            Self::Traction {
                a,
                b,
                c,
                d,
                slip_speed,
            } => {
                let own = [
                    signed("a", a),
                    signed("b", b),
                    number("c", c),
                    number("d", d),
                ];
                (
                    "traction",
                    own.into_iter().chain([slip(slip_speed)]).collect(),
                )
            }
        })
    }
}

/// Numbers of contacts and their laws, for the schema.
pub(super) fn parts() -> Vec<PartNumbers> {
    let coulomb = Friction::Coulomb {
        coefficient: X,
        slip_speed: X,
    };
    let stribeck = Friction::Stribeck {
        static_coefficient: X,
        kinetic_coefficient: X,
        stribeck_speed: X,
        slip_speed: X,
    };
    let traction = Friction::Traction {
        a: X,
        b: X,
        c: X,
        d: X,
        slip_speed: X,
    };
    let friction = |of: Friction| of.numbers().map_or_else(Vec::new, |(_, numbers)| numbers);
    vec![
        ("Contact", Contact::default().numbers().into()),
        ("SqueezeFilm", SqueezeFilm::default().numbers().into()),
        ("Iso16281", NormalLaw::iso16281().numbers().1),
        ("FixedSlices", vec![Slices::Fixed(1).numbers()]),
        ("FittedSlices", vec![Slices::Fitted(1).numbers()]),
        ("AccurateSlices", vec![Slices::Accuracy(X).numbers()]),
        ("Coulomb", friction(coulomb)),
        ("Stribeck", friction(stribeck)),
        ("Traction", friction(traction)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Truth: the words that a document may have, as a refused one lists them.
    #[test]
    fn all_laws_are_every_law() {
        let refused = serde_json::from_str::<NormalLaw>("\"none\"").unwrap_err();
        let refused = refused.to_string();
        let words: Vec<&str> = refused.split('`').skip(3).step_by(2).collect();
        let all = NormalLaw::all();
        let names: Vec<&str> = all.iter().map(|law| law.numbers().0).collect();
        assert_eq!(names, words, "{refused}");
    }
}
