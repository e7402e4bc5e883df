//! Bodies: mass, how each direction is held, and masses from geometry.

use std::f64::consts::PI;

use super::{DOFS, Dof, Race};
use crate::scene::{Mount, Ring, Row, Scene};

/// A body compiled.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Body {
    /// Name of the body, as in the names of the states.
    pub name: String,
    /// Mass along x, y, z \[kg\] and moment of inertia about z \[kg m²\].
    pub mass: [f64; DOFS],
    /// How each direction moves.
    pub degrees: [Degree; DOFS],
    /// Nominal place x, y, z \[m\] and angle \[rad\]: rings at the origin or where a given motion begins, balls on the pitch
    /// circle.
    pub nominal: [f64; DOFS],
}

impl Body {
    /// Whether forces move it along any axis.
    pub(crate) fn moves_along_axes(&self) -> bool {
        Dof::TRANSLATIONS
            .iter()
            .any(|dof| self.degrees[*dof].is_free())
    }

    /// Inverse of the mass where a direction is free, 0 where it is not.
    pub(super) fn mobility(&self) -> [f64; DOFS] {
        std::array::from_fn(|i| match self.degrees[i] {
            Degree::Free { .. } => 1.0 / self.mass[i],
            Degree::Fixed | Degree::Driven => 0.0,
        })
    }
}

/// How one direction of a body moves.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Degree {
    /// A direction that moves by the forces on it, with a spring and a damper to the frame (both 0 when free).
    Free {
        /// \[N/m\], about z \[N m/rad\].
        stiffness: f64,
        /// \[N s/m\], about z \[N m s/rad\].
        damping: f64,
    },
    /// A direction that does not move.
    Fixed,
    /// A direction that moves as a given motion prescribes, about z a given speed.
    Driven,
}

impl Degree {
    /// Whether forces move it.
    pub(crate) fn is_free(&self) -> bool {
        matches!(self, Self::Free { .. })
    }

    /// Stiffness of the spring to the frame \[N/m\], about z \[N m/rad\]; 0 where nothing moves by forces.
    pub(crate) fn stiffness(&self) -> f64 {
        match self {
            Self::Free { stiffness, .. } => *stiffness,
            Self::Fixed | Self::Driven => 0.0,
        }
    }
}

impl From<Mount> for Degree {
    fn from(mount: Mount) -> Self {
        match mount {
            Mount::Free => Self::Free {
                stiffness: 0.0,
                damping: 0.0,
            },
            Mount::Fixed => Self::Fixed,
            Mount::Spring { stiffness, damping } => Self::Free { stiffness, damping },
            Mount::Given(_) => Self::Driven,
        }
    }
}

/// Mass and moment of inertia of a ball of the given diameter.
pub(super) fn ball_mass(scene: &Scene, row: &Row, diameter: f64) -> (f64, f64) {
    let mass = row
        .ball_mass
        .unwrap_or_else(|| scene.ball_material_of(row).density * PI * diameter.powi(3) / 6.0);
    (
        mass,
        row.ball_inertia.unwrap_or(0.1 * mass * diameter * diameter),
    )
}

/// Mass of a ring, its moments of inertia about the axis and across it; given values first.
///
/// From geometry: a hollow cylinder between boundary and land, less the grooves' circular segments. The
/// land is at the shoulder angle, or 0.3 D beyond the pitch radius; in the mean of unlike rows. Without geometry the ring is as
/// short across as it is thin.
pub(super) fn ring_mass(scene: &Scene, ring: &Ring, race: Race) -> (f64, f64, f64) {
    let sigma = race.sigma();
    let geometry = || {
        let (boundary, width) = (ring.diameter? / 2.0, ring.width?);
        let density = scene.materials.rings.density;
        let land = mean(scene, |row| land_radius(row, race));
        let (inside, outside) = match race {
            Race::Outer => (land, boundary),
            Race::Inner => (boundary, land),
        };
        let cylinder = density * PI * width * (outside.powi(2) - inside.powi(2));
        let mut mass = cylinder;
        let mut inertia = cylinder * (outside.powi(2) + inside.powi(2)) / 2.0;
        // Of places along the axis: what it has beside half of the inertia.
        let mut along = cylinder * width * width / 12.0;
        for row in &scene.rows {
            let r = groove_radius(row, race);
            let bottom = f64::midpoint(row.pitch_diameter, sigma * row.ball_diameter);
            let depth = (sigma * (bottom - land)).clamp(0.0, r);
            let area = r * r * (1.0 - depth / r).acos()
                - (r - depth) * (2.0 * r * depth - depth * depth).sqrt();
            let centre = f64::midpoint(bottom, land);
            let groove = density * area * 2.0 * PI * centre;
            mass -= groove;
            inertia -= groove * centre * centre;
            along -= groove * row.axial_position * row.axial_position;
        }
        Some((mass, inertia, along))
    };
    let computed = geometry();
    let mass = ring.mass.or(computed.map(|(mass, ..)| mass)).unwrap_or(1.0);
    let inertia = ring.inertia.unwrap_or_else(|| match computed {
        Some((computed_mass, inertia, _)) => inertia * mass / computed_mass,
        None => mass * mean(scene, |row| row.pitch_diameter / 2.0).powi(2),
    });
    let transverse = ring.transverse_inertia.unwrap_or_else(|| {
        let width = ring.width.unwrap_or_default();
        inertia / 2.0
            + match computed {
                Some((computed_mass, _, along)) => along * mass / computed_mass,
                None => mass * width * width / 12.0,
            }
    });
    (mass, inertia, transverse)
}

/// Mean of all rows.
pub(super) fn mean(scene: &Scene, of: impl Fn(&Row) -> f64) -> f64 {
    scene.rows.iter().map(of).sum::<f64>() / scene.rows.len() as f64
}

/// Groove radius of a race over the ball diameter.
pub(super) fn conformity(row: &Row, race: Race) -> f64 {
    match race {
        Race::Outer => row.outer_conformity,
        Race::Inner => row.inner_conformity,
    }
}

/// Groove radius of a race \[m\].
pub(super) fn groove_radius(row: &Row, race: Race) -> f64 {
    row.ball_diameter * conformity(row, race)
}

/// Radius of a ring's shoulders \[m\]; 0.3 D beyond the pitch circle where a race has none.
pub(super) fn land_radius(row: &Row, race: Race) -> f64 {
    let shoulders = match race {
        Race::Outer => row.outer_shoulders,
        Race::Inner => row.inner_shoulders,
    };
    let r = groove_radius(row, race);
    let height = match shoulders {
        Some([low, high]) => row.ball_diameter / 2.0 - r * (1.0 - low.max(high).cos()),
        None => 0.3 * row.ball_diameter,
    };
    row.pitch_diameter / 2.0 + race.sigma() * height
}
