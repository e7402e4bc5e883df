//! The rings' part in their contacts: velocities of a ring in its frame, and wrenches of the contacts on it.
//!
//! Contacts are held in the frames of their rings, with wrenches and twists about the frame's origin. Where rings are parallel those
//! are the scene's own, and nothing is turned.

// Loops over matrices read as their formulae do.
#![allow(clippy::needless_range_loop)]

use nalgebra::{SMatrix, Vector3};

use super::matrices::LaneMatrix;
use crate::contact::AXIAL;
use crate::dynamics::{RingView, View, turning_accelerations};
use crate::model::{DOFS, Degree, Dof, Model, Race};
use crate::simd::Lanes;
use crate::tilt::{Frame, Rotation};

/// Offsets of directions along x, y and z: of forces, and of moments about them.
const ALONG: [usize; 3] = [0, 1, 2];
const ABOUT: [usize; 3] = [AXIAL, AXIAL + 1, 3];

/// Map from a ring's velocities X to what its contacts see, and from their wrench to γh of its accelerations.
#[derive(Debug, Clone, Copy)]
pub(super) struct Carrier<const N: usize> {
    /// J.
    pub seen: SMatrix<f64, N, N>,
    /// L.
    pub scale: SMatrix<f64, N, N>,
}

impl<const N: usize> Default for Carrier<N> {
    fn default() -> Self {
        Self {
            seen: SMatrix::identity(),
            scale: SMatrix::zeros(),
        }
    }
}

impl<const N: usize> Carrier<N> {
    /// The carrier of the ring of a race and its mobility, as it is seen.
    pub fn new(
        model: &Model,
        race: Race,
        mobility: [f64; DOFS],
        view: &View<'_>,
        gamma_h: f64,
    ) -> Self {
        let mut carrier = Self::default();
        for (i, mobility) in mobility.iter().enumerate() {
            carrier.scale[(i, i)] = gamma_h * mobility;
        }
        if let Some(ring) = view.tilted {
            carrier.tilt(model, race, ring, gamma_h);
        }
        carrier
    }

    /// 1 + d: the unit matrix and the dampers of its mount.
    pub fn diagonal(&self, model: &Model, race: Race) -> [f64; N] {
        let dofs = [Dof::X, Dof::Y, Dof::Z, Dof::Theta, Dof::TiltX, Dof::TiltY];
        std::array::from_fn(|i| match model.degree(race, dofs[i]) {
            Degree::Free { damping, .. } => 1.0 + self.scale[(i, i)] * damping,
            Degree::Fixed | Degree::Driven => 1.0,
        })
    }

    /// The same of a ring that may tilt.
    fn tilt(&mut self, model: &Model, race: Race, view: &RingView, gamma_h: f64) {
        let (ring, frame) = (&view.ring, view.frame());
        let turns = |rates: [f64; 3]| {
            let [spin, x, y] = rates;
            let turning = Rotation::new(frame.tilt, [x, y], spin).angular_velocity();
            frame.to_ring(&turning)
        };
        let mobility = self.scale;
        let at_rest = turning_accelerations(model, race, ring, &Vector3::zeros(), [0.0; 3]);
        for k in 0..3 {
            let mut unit = Vector3::zeros();
            unit[k] = 1.0;
            let seen = frame.to_ring(&unit);
            // Forces act at the frame's origin, and turn the ring about its centre of mass.
            let [force, moment] = ring.about_centre(&unit, &Vector3::zeros());
            let by_force = turning_accelerations(model, race, ring, &moment, [0.0; 3]);
            let turned = frame.to_scene(&unit);
            let by_moment = turning_accelerations(model, race, ring, &turned, [0.0; 3]);
            let mut rates = [0.0; 3];
            rates[k] = 1.0;
            let turning = turns(rates);
            let moving = ring.moved_at_origin(&turning);
            for i in 0..3 {
                self.seen[(ALONG[i], ALONG[k])] = seen[i];
                self.seen[(ABOUT[i], 3 + k)] = turning[i];
                self.seen[(ALONG[i], 3 + k)] = moving[i];
                let along = ALONG[i];
                self.scale[(along, ALONG[k])] = mobility[(along, along)] * force[i];
                let spun =
                    |by: [f64; 3]| [by[2] - at_rest[2], by[0] - at_rest[0], by[1] - at_rest[1]];
                self.scale[(3 + i, ALONG[k])] = gamma_h * spun(by_force)[i];
                self.scale[(3 + i, ABOUT[k])] = gamma_h * spun(by_moment)[i];
            }
        }
    }
}

/// Φ: a twist or wrench of balls in a ring's frame and in the scene's. Balls that do not spin freely turn about the axis of the ring that
/// they touch.
#[derive(Clone, Copy)]
pub(super) struct RingRotation<'a> {
    frame: &'a Frame,
    balls_turn: bool,
}

impl<'a> RingRotation<'a> {
    /// The carrier of a ring that may tilt.
    pub fn new(view: &'a RingView) -> Self {
        Self {
            frame: view.frame(),
            balls_turn: view.balls_turn(),
        }
    }

    /// The carrier of balls that spin freely.
    #[cfg(test)]
    pub fn of(frame: &'a Frame) -> Self {
        Self {
            frame,
            balls_turn: true,
        }
    }

    /// Turns a vector of these into the scene's frame.
    #[inline(always)]
    fn out<const FMA: bool, const N: usize>(&self, of: &mut [Lanes; N]) {
        for at in [ALONG, ABOUT]
            .iter()
            .take(if self.balls_turn { 2 } else { 1 })
        {
            let [x, y, z] = *at;
            let turned = self.frame.all_to_scene::<_, FMA>([of[x], of[y], of[z]]);
            (of[x], of[y], of[z]) = (turned[0], turned[1], turned[2]);
        }
    }

    /// Φ times a matrix.
    #[inline(always)]
    pub fn rows<const FMA: bool, const N: usize>(&self, of: &mut LaneMatrix<N>) {
        for k in 0..N {
            let mut column = [Lanes::ZERO; N];
            for i in 0..N {
                column[i] = of[i][k];
            }
            self.out::<FMA, N>(&mut column);
            for i in 0..N {
                of[i][k] = column[i];
            }
        }
    }

    /// A matrix times Φᵀ.
    #[inline(always)]
    pub fn columns<const FMA: bool, const N: usize>(&self, of: &mut LaneMatrix<N>) {
        for i in 0..N {
            self.out::<FMA, N>(&mut of[i]);
        }
    }
}
