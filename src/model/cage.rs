//! A cage that is a rigid ring, compiled.

use std::f64::consts::TAU;

use super::Race;
use super::body::{Body, Degree, land_radius};
use super::texture::Draw;
use crate::contact::V2;
use crate::scene::{CageGuidance, CageRing, Row, Scene};

/// Slip speed where the row has no friction of its own \[m/s\].
const SLIP_SPEED: f64 = 0.01;

/// A cage of a row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CageModel {
    /// Clearance of a ball on either side of its pocket \[m\].
    pub clearance: f64,
    /// Stiffness of a pocket's wall \[N/m\].
    pub stiffness: f64,
    /// The same \[N s/m\], from a depth on \[m\].
    pub damping: f64,
    pub depth: f64,
    /// Coefficient of friction in pockets.
    pub friction: f64,
    /// Slip speed below which friction fades \[m/s\].
    pub slip_speed: f64,
    /// Guidance: what carries the cage's centre.
    pub carried: Carried,
    /// Unbalance of the cage, its mass times the distance of its centre of mass from its centre \[kg m\], towards pocket 0.
    pub unbalance: f64,
    /// Pitch radius \[m\].
    pub radius: f64,
    /// Directions of the pockets from its centre, in its own frame.
    pub pockets: Vec<V2>,
    /// Mass of the whole and of a ball \[kg\], and its moment of inertia \[kg m²\].
    pub mass: f64,
    pub ball_mass: f64,
    pub inertia: f64,
}

/// Guidance of a cage's centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Carried {
    /// The outer ring's centre is the cage's.
    Held,
    /// A spring to the outer ring's centre.
    Spring(CentringSpring),
    /// A ring's land.
    Land(Land),
    /// The balls, in round pockets.
    Balls,
}

/// A spring that centres a cage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CentringSpring {
    /// \[N/m\]
    pub stiffness: f64,
    /// \[N s/m\]
    pub damping: f64,
}

/// A cylinder on a ring that carries a cage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Land {
    pub race: Race,
    /// \[m\]
    pub clearance: f64,
    /// \[m\]
    pub radius: f64,
    /// \[N/m\], \[N s/m\]
    pub stiffness: f64,
    pub damping: f64,
    pub friction: f64,
}

impl CageModel {
    /// Cage of a row by its number, whose balls have a mass \[kg\].
    pub fn new(scene: &Scene, ring: &CageRing, index: usize, row: &Row, ball_mass: f64) -> Self {
        let d = row.ball_diameter;
        let radius = row.pitch_diameter / 2.0;
        let mass = ring.mass(row);
        let stiffness = ring.stiffness(d);
        let half_critical = |stiffness: f64, mass: f64| (stiffness * mass).sqrt();
        let clearance = ring.pocket_clearance(d);
        let land = |race: Race| {
            Carried::Land(Land {
                race,
                clearance: ring.land_clearance.unwrap_or(clearance),
                radius: ring.land_radius.unwrap_or_else(|| land_radius(row, race)),
                stiffness: ring.land_stiffness,
                damping: half_critical(ring.land_stiffness, mass),
                friction: ring.land_friction,
            })
        };
        Self {
            clearance,
            stiffness,
            damping: ring
                .damping
                .unwrap_or_else(|| half_critical(stiffness, ball_mass)),
            depth: ring.damping_depth,
            friction: ring.friction,
            slip_speed: ring
                .slip_speed
                .or(scene.friction_of(row).slip_speed())
                .unwrap_or(SLIP_SPEED),
            carried: match ring.guided {
                CageGuidance::Centred => {
                    let stiffness = ring.centring_stiffness(row);
                    Carried::Spring(CentringSpring {
                        stiffness,
                        damping: half_critical(stiffness, mass),
                    })
                }
                CageGuidance::Held => Carried::Held,
                CageGuidance::Outer => land(Race::Outer),
                CageGuidance::Inner => land(Race::Inner),
                CageGuidance::Balls => Carried::Balls,
            },
            unbalance: mass * ring.eccentricity,
            radius,
            pockets: (0..row.ball_count)
                .map(|k| {
                    let nominal = TAU * k as f64 / row.ball_count as f64;
                    let (sin, cos) = (nominal + pocket_error(ring, index, k)).sin_cos();
                    V2::new(cos, sin)
                })
                .collect(),
            mass,
            ball_mass,
            inertia: ring.inertia(row),
        }
    }

    /// Body of the cage. A centre that is held has no mass.
    pub fn body(&self, row: usize, of: &Row) -> Body {
        let free = Degree::Free {
            stiffness: 0.0,
            damping: 0.0,
        };
        let (mass, along) = match self.carried {
            Carried::Held => (0.0, Degree::Fixed),
            Carried::Spring(_) | Carried::Land(_) | Carried::Balls => (self.mass, free),
        };
        Body {
            name: format!("row{row}.cage"),
            mass: [mass, mass, mass, self.inertia],
            degrees: [along, along, Degree::Fixed, free],
            nominal: [0.0, 0.0, of.axial_position, of.start_angle],
        }
    }

    /// Place of the cage's centre at rest by its weight, from that of the ring that carries it \[m\].
    pub fn sag(&self, gravity: [f64; 3]) -> V2 {
        let weight = V2::new(gravity[0], gravity[1]) * self.mass;
        let size = weight.norm();
        match &self.carried {
            Carried::Spring(spring) => weight / spring.stiffness,
            Carried::Land(land) if size > 0.0 && land.stiffness > 0.0 => {
                weight * ((land.clearance + size / land.stiffness) / size)
            }
            Carried::Held | Carried::Land(_) | Carried::Balls => V2::zeros(),
        }
    }

    /// Highest frequency at which balls and cage vibrate on the walls of the pockets, with all balls at theirs \[rad/s\].
    pub fn frequency(&self) -> f64 {
        let turning = self.pockets.len() as f64 * self.radius * self.radius / self.inertia;
        let pockets = self.stiffness * (1.0 / self.ball_mass + turning);
        let centre = match &self.carried {
            Carried::Spring(spring) => spring.stiffness / self.mass,
            Carried::Land(land) => land.stiffness / self.mass,
            Carried::Held | Carried::Balls => 0.0,
        };
        pockets.max(centre).sqrt()
    }
}

/// Errors of a pocket's angle, as given and as drawn \[rad\].
pub(super) fn pocket_error(ring: &CageRing, row: usize, pocket: usize) -> f64 {
    let given = ring.pocket_errors.get(pocket).copied().unwrap_or(0.0);
    let (phase, size) = Draw::new(ring.seed, [row as u64, 3, pocket as u64]).of(0);
    given + ring.pocket_error * 2_f64.sqrt() * size * (TAU * phase).cos()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::presets;
    use std::f64::consts::PI;

    /// Golden: what the model gives of a steel 6205, 8 g, 50 µm, 3·10⁵ N/m and 25 N s/m.
    #[test]
    fn defaults_of_a_6205() {
        let scene = presets::deep_groove_6205(500.0, 0.0, 1797.0);
        let ball = 7800.0 * PI / 6.0 * 7.94e-3_f64.powi(3);
        let cage = CageModel::new(&scene, &CageRing::default(), 0, &scene.rows[0], ball);
        assert!((cage.mass - 8.0e-3).abs() < 0.2e-3, "{}", cage.mass);
        assert!((cage.clearance - 50e-6).abs() < 1e-6);
        assert!((cage.stiffness - 3e5).abs() < 3e3);
        assert!((cage.damping - 25.0).abs() < 1.0, "{}", cage.damping);
        let frequency = cage.frequency();
        assert!((1e4..5e4).contains(&frequency), "{frequency}");
        assert_eq!(cage.inertia, cage.mass * (19.52e-3_f64).powi(2));
    }

    /// Analytic: drawn errors have the standard deviation that was asked for, and given ones add to them.
    #[test]
    fn pocket_errors_have_their_size() {
        let drawn = CageRing {
            pocket_error: 2e-3,
            seed: 5,
            ..CageRing::default()
        };
        let errors: Vec<f64> = (0..4000).map(|k| pocket_error(&drawn, 0, k)).collect();
        let square = errors.iter().map(|e| e * e).sum::<f64>() / 4000.0;
        let mean = errors.iter().sum::<f64>() / 4000.0;
        assert!((square.sqrt() / 2e-3 - 1.0).abs() < 0.04 && mean.abs() < 1e-4);
        let both = CageRing {
            pocket_errors: vec![1e-3],
            ..drawn
        };
        assert!((pocket_error(&both, 0, 0) - errors[0] - 1e-3).abs() < 1e-18);
    }
}
