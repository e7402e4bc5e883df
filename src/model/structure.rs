//! The structure around the outer ring, compiled: its modes as bodies behind all others, and the seat on which the ring stands.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::{Body, Degree, Dof, Layout, Race};
use crate::scene::{self, Compliance};

/// A structure with modes ([*A structure with modes*](crate::equations#a-structure-with-modes)).
#[derive(Debug, Clone)]
pub(crate) struct StructureModel {
    pub modes: Vec<ModeModel>,
    /// Stiffness K of ring against seat, with the residual compliance \[N/m\].
    pub stiffness: Matrix3<f64>,
    /// Damping C of ring against seat along x, y and z \[N s/m\].
    pub damping: Vector3<f64>,
    /// Stiffness K_eff on which the ring stands at rest \[N/m\].
    pub effective: Matrix3<f64>,
}

/// A mode, scaled so that its largest shape has length one: its coordinate is the largest displacement that is read of it \[m\].
#[derive(Debug, Clone)]
pub(crate) struct ModeModel {
    /// Shape Φ at the seat.
    pub seat: Vector3<f64>,
    /// Shapes Ψ at sensors.
    pub sensors: BTreeMap<String, Vector3<f64>>,
    /// \[kg\]
    pub mass: f64,
    /// m ω² \[N/m\].
    pub stiffness: f64,
    /// 2 ζ ω m \[N s/m\].
    pub damping: f64,
}

impl StructureModel {
    /// The structure that carries the outer ring.
    pub fn new(structure: &scene::Structure, outer: &Body) -> Self {
        let modes: Vec<ModeModel> = structure.modes.iter().map(ModeModel::new).collect();
        let spring = |dof: Dof| match outer.degrees[dof] {
            Degree::Free { stiffness, damping } => [stiffness, damping],
            Degree::Fixed | Degree::Driven => [0.0; 2],
        };
        let [stiffness, damping] =
            [0, 1].map(|i| Vector3::from(Dof::TRANSLATIONS.map(|dof| spring(dof)[i])));
        let mut stiffness = Matrix3::from_diagonal(&stiffness);
        if let Some(residual) = structure.static_compliance.as_ref().map(Compliance::matrix) {
            stiffness = in_series(&stiffness, &Matrix3::from_fn(|i, j| residual[i][j]));
        }
        let compliances = modes
            .iter()
            .map(|mode| mode.seat * mode.seat.transpose() / mode.stiffness);
        let compliance = compliances.sum();
        Self {
            effective: in_series(&stiffness, &compliance),
            modes,
            stiffness,
            damping,
        }
    }

    /// Bodies of the modes, which are coordinates along the first direction.
    pub fn bodies(&self) -> impl Iterator<Item = Body> {
        let modes = self.modes.iter().enumerate();
        modes.map(|(i, mode)| Body {
            name: format!("structure.mode{i}"),
            mass: [mode.mass, 0.0, 0.0, 0.0],
            degrees: [
                Degree::Free {
                    stiffness: mode.stiffness,
                    damping: mode.damping,
                },
                Degree::Fixed,
                Degree::Fixed,
                Degree::Fixed,
            ],
            nominal: [0.0; 4],
        })
    }

    /// Displacement of the seat by coordinates of the modes, or its rate by theirs.
    #[inline]
    pub fn at_seat<'c>(&self, coordinates: impl Iterator<Item = &'c f64>) -> Vector3<f64> {
        let mut moved = Vector3::zeros();
        for (mode, coordinate) in self.modes.iter().zip(coordinates) {
            moved += mode.seat * *coordinate;
        }
        moved
    }

    /// Force of the ring on the seat by what stretches the ring's springs, and its rate \[N\].
    #[inline]
    pub fn force(&self, [stretch, rate]: [Vector3<f64>; 2]) -> Vector3<f64> {
        self.stiffness * stretch + self.damping.component_mul(&rate)
    }

    /// Stretch of the ring's springs in a state of all bodies \[m\], and its rate.
    pub fn stretch(&self, layout: Layout, y: &[f64]) -> [Vector3<f64>; 2] {
        let (q, v) = y.split_at(layout.half());
        [q, v].map(|half| {
            let ring = Dof::TRANSLATIONS.map(|dof| half[layout.at(Race::Outer.ring(), dof)]);
            Vector3::from(ring) - self.at_seat(coordinates(layout, half))
        })
    }

    /// Lets the modes rest under the force of the ring where it is in a state of all bodies.
    pub fn rest(&self, layout: Layout, y: &mut [f64]) {
        let force = self.effective * Vector3::from(layout.centre(y, Race::Outer.ring()));
        for (i, mode) in self.modes.iter().enumerate() {
            let body = layout.mode(i);
            y[layout.at(body, Dof::X)] = mode.seat.dot(&force) / mode.stiffness;
            y[layout.speed_at(body, Dof::X)] = 0.0;
        }
    }

    /// Shapes of a sensor, mode by mode.
    pub fn shapes(&self, sensor: &str) -> Vec<Vector3<f64>> {
        let shape = |mode: &ModeModel| mode.sensors.get(sensor).copied().unwrap_or_default();
        self.modes.iter().map(shape).collect()
    }

    /// What shapes of a sensor make of the coordinates of the modes among all places, or of their rates.
    #[inline]
    pub fn at_sensor(layout: Layout, shapes: &[Vector3<f64>], half: &[f64]) -> Vector3<f64> {
        let mut sum = Vector3::zeros();
        for (shape, coordinate) in shapes.iter().zip(coordinates(layout, half)) {
            sum += shape * *coordinate;
        }
        sum
    }

    /// Whether anything along z moves the seat in the plane of rotation, or the other way.
    pub fn couples_z(&self) -> bool {
        let both = |shape: &Vector3<f64>| shape.z != 0.0 && (shape.x != 0.0 || shape.y != 0.0);
        self.modes.iter().any(|mode| both(&mode.seat))
            || self.stiffness[(0, 2)] != 0.0
            || self.stiffness[(1, 2)] != 0.0
    }

    /// Highest frequency of a ring of a mass \[kg\] on the structure, without contacts \[rad/s\].
    pub fn frequency(&self, ring: f64) -> f64 {
        // Over the roots of the masses: of the ring along x, y and z, then of the modes.
        let count = self.modes.len();
        let mut roots = vec![ring.sqrt(); 3];
        roots.extend(self.modes.iter().map(|mode| mode.mass.sqrt()));
        let pulls = DMatrix::from_fn(3, 3 + count, |axis, at| match at.checked_sub(3) {
            None => f64::from(u8::from(axis == at)),
            Some(mode) => -self.modes[mode].seat[axis],
        });
        let mut stiffness = pulls.transpose() * self.stiffness * pulls;
        for (i, mode) in self.modes.iter().enumerate() {
            stiffness[(3 + i, 3 + i)] += mode.stiffness;
        }
        let scaled = DMatrix::from_fn(3 + count, 3 + count, |i, j| {
            stiffness[(i, j)] / (roots[i] * roots[j])
        });
        scaled.symmetric_eigenvalues().max().sqrt()
    }
}

impl ModeModel {
    fn new(mode: &scene::Mode) -> Self {
        let [seat, shapes] = [vec![&mode.seat], mode.sensors.values().collect()]
            .map(|of| of.into_iter().map(|shape| Vector3::from(*shape).norm()));
        let largest = seat.chain(shapes).fold(0.0, f64::max);
        let scale = if largest > 0.0 { largest } else { 1.0 };
        let scaled = |shape: &[f64; 3]| Vector3::from(*shape) / scale;
        let (mass, omega) = (mode.mass / (scale * scale), TAU * mode.frequency);
        let sensors = mode.sensors.iter();
        Self {
            seat: scaled(&mode.seat),
            sensors: sensors
                .map(|(name, shape)| (name.clone(), scaled(shape)))
                .collect(),
            mass,
            stiffness: mass * omega * omega,
            damping: 2.0 * mode.damping * omega * mass,
        }
    }
}

/// Coordinates of the modes among the places of all bodies, or their rates.
#[inline]
fn coordinates(layout: Layout, half: &[f64]) -> impl Iterator<Item = &f64> {
    let modes = &Layout::each(half)[layout.modes()];
    modes.iter().map(|mode| &mode[Dof::X])
}

/// Stiffness of springs in series with a compliance, (K⁻¹ + S)⁻¹, also where there is no spring along some axis.
fn in_series(springs: &Matrix3<f64>, compliance: &Matrix3<f64>) -> Matrix3<f64> {
    if *compliance == Matrix3::zeros() {
        return *springs;
    }
    let both = Matrix3::identity() + springs * compliance;
    // Positive semidefinite matrices leave it an inverse.
    let found = both
        .try_inverse()
        .map_or(*springs, |inverse| inverse * springs);
    (found + found.transpose()) / 2.0
}
