//! Moments of a contact on the tilts of its ring, and its stiffness against tilts.
//!
//! With D = c_b − c_r from a ring's centre of mass to a ball, f on the ball, K its contact's stiffness in the scene's frame, and a
//! ring that turns by δφ,
//!
//! ```text
//! δf = δφ × f − K (δD − δφ × D),        M = −D × f,        δM = −δD × f − D × δf
//! ```
//!
//! Tilts are expressed as lengths, times half of the pitch diameter, and moments as forces, over it: so they have the scales of
//! places.

use nalgebra::{Matrix3, Matrix3x2, SMatrix, SVector, Vector2, Vector3};

use super::unknowns::OF_A_RING;
use crate::forces::load;
use crate::model::{Model, Race};

/// Forces on a ring along its unknowns.
pub(super) type OnRing = SVector<f64, OF_A_RING>;
/// Stiffness of a ring's unknowns against each other.
pub(super) type OfRing = SMatrix<f64, OF_A_RING, OF_A_RING>;

/// How a ball stands from a ring.
#[derive(Debug, Clone)]
pub(super) struct Arm {
    /// Vector from the ring's centre of mass \[m\].
    pub from: Vector3<f64>,
    /// The ring's angular velocity by the rates of its tilts, expressed as lengths \[1/m\].
    pub turning: Matrix3x2<f64>,
}

impl Arm {
    /// Moment on the ring's tilts by a force on the ball, less itself.
    pub fn on_tilts(&self, force: &Vector3<f64>) -> Vector2<f64> {
        self.turning.tr_mul(&-self.from.cross(force))
    }

    /// The force on the ball by the ring's tilts, where the contact has a force and a stiffness.
    pub fn by_tilts(&self, force: &Vector3<f64>, stiffness: &Matrix3<f64>) -> Matrix3x2<f64> {
        -(force.cross_matrix() + stiffness * self.from.cross_matrix()) * self.turning
    }

    /// The stiffness of the ring against the contact.
    pub fn stiffness(&self, force: &Vector3<f64>, stiffness: &Matrix3<f64>) -> OfRing {
        let mut all = OfRing::zeros();
        let by_tilts = self.by_tilts(force, stiffness);
        all.fixed_view_mut::<3, 3>(0, 0).copy_from(stiffness);
        all.fixed_view_mut::<3, 2>(0, 3).copy_from(&by_tilts);
        all.fixed_view_mut::<2, 3>(3, 0)
            .copy_from(&by_tilts.transpose());
        let of_tilts = self.turning.tr_mul(&self.from.cross_matrix()) * by_tilts;
        all.fixed_view_mut::<2, 2>(3, 3).copy_from(&of_tilts);
        all
    }
}

/// Force on a ring at a point of it, in its frame.
#[derive(Debug, Clone)]
pub(super) struct Push {
    pub race: Race,
    /// Vector from the centre of mass, in the ring's frame \[m\].
    pub arm: Vector3<f64>,
    /// Force in the scene's frame \[N\].
    pub force: Vector3<f64>,
}

impl Push {
    /// The loads of a model that act off the centres of mass of rings, at t = 0.
    pub fn all(model: &Model) -> Vec<Self> {
        let loads = model.loads.iter().filter_map(|load| {
            Some(Self {
                race: load.ring,
                arm: load.arm?,
                force: load::at(load, 0.0),
            })
        });
        loads.collect()
    }
}
