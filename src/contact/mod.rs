//! Laws of one ball on one race, without indices and without the state of a run.
//!
//! `profile` has the races and the zone where a ball touches one ([*Geometry of a row*](crate::equations#geometry-of-a-row) and
//! [*Slices*](crate::equations#slices)), `laws` the forces of an element of the zone (sections 4 and 5), `quadrature` where the elements
//! lie, `kernel` combines these: the force of an element, and the elements of a whole contact; `frames` has the ball in the frame of its
//! ring, `spatial` the wrench of a contact on its ball, `slip` the slip along a zone, from which `quadrature` computes the weights of
//! friction. The kernel's callers:
//!
//! * `scalar` — [`Pair::evaluate`]: one contact with defects and ends of its zone, every single force to a [`Sink`];
//! * `batch` — eight whole contacts at once;
//! * `held` — contacts held at one place for any velocities, with slopes by these: what implicit methods need;
//! * `stiffness` — force at rest and its derivative by the place: what statics need.
//!
//! What is public beside the laws is hidden from the documentation: it is for the crate's own tests, and changes without notice.
//!
//! `damage` has the kinds of damage, one file each, the elements that a slice meets where a surface is absent, what a
//! contact loses to holes smaller than it, and what makes these forces conservative.

mod batch;
mod damage;
mod dual;
mod frames;
mod held;
mod kernel;
pub mod laws;
mod oil;
mod profile;
mod quadrature;
mod scalar;
mod slip;
mod spatial;
mod stiffness;

use nalgebra::{Vector2, Vector3};

pub(crate) use batch::{
    Across, BatchForces, Constants, EightContacts, FrictionWeights, Places, RingLanes,
};
#[doc(hidden)]
pub use damage::SurfaceDefect;
pub(crate) use damage::{ContactDirection, MOST_AT_ONCE, met_at_once};
#[doc(hidden)]
pub use frames::Motion;
pub(crate) use frames::{TiltedRing, attitude_accelerations, attitude_rates, centrifugal};
pub(crate) use held::{
    AXIAL, Around, FREE, HeldContacts, HeldElements, HeldSlope, SlicePack, SlicePacking, in_contact,
};
pub use laws::elastic::{elliptic, hertz, iso16281};
pub use laws::film;
#[doc(hidden)]
pub use laws::film::Oiled;
pub(crate) use laws::film::{FilmEffect, FilmNumbers};
pub use laws::{Cut, Elastic};
#[doc(hidden)]
pub use laws::{Damping, Law, Squeeze, Traction};
#[doc(hidden)]
pub use oil::OilForce;
pub(crate) use profile::{Before, Contour, Curve, HeightTable, Raise, Section};
#[doc(hidden)]
pub use profile::{Torus, Waves};
#[doc(hidden)]
pub use quadrature::{Rules, ZoneSlices};
pub(crate) use scalar::DefectContact;
#[doc(hidden)]
pub use scalar::{BallSide, Pair, Shape};
pub(crate) use spatial::{Wrench, WrenchSum};
pub(crate) use stiffness::Tangent;

/// A vector in the x-y plane.
pub(crate) type V2 = Vector2<f64>;

/// ẑ × v: a quarter turn counter-clockwise.
pub(crate) fn turned(v: V2) -> V2 {
    V2::new(-v.y, v.x)
}

/// z component of a × b.
pub(crate) fn cross(a: V2, b: V2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// Angle brought into −π … π.
pub fn wrapped(angle: f64) -> f64 {
    angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
}

/// A force between ball and ring: a slice on the race or on a fault circle.
#[doc(hidden)]
#[derive(Debug, Clone, Copy)]
pub struct ContactForce {
    /// Place of the slice along the ball, from its centre \[m\].
    pub zeta: f64,
    /// Place of the slice in the ring's frame \[m\].
    pub z: f64,
    /// Width of the slice along z, or of the node along the common tangent (Hertz law) \[m\].
    pub width: f64,
    /// Penetration that the law saw \[m\].
    pub depth: f64,
    /// Weight of friction here over the normal force, about 1 (see `quadrature`).
    pub friction_weight: f64,
    /// Elastic part of the normal force \[N\].
    pub elastic: f64,
    /// Normal force with damping, after clamping \[N\].
    pub normal: f64,
    /// Elastic energy \[J\].
    pub energy: f64,
    /// Approach speed v_n \[m/s\].
    pub approach: f64,
    /// Unit vector in the plane, out of the ball at the contact.
    pub(crate) n_e: V2,
    /// Shares of the normal force in the plane and along the axis, over its magnitude: (1, tan α), Hertz law: (cos α', sin α').
    pub share: (f64, f64),
    /// Friction on the ball in the plane \[N\].
    pub(crate) friction: V2,
    /// Friction on the ball along z \[N\].
    pub friction_z: f64,
    /// Slip speed \[m/s\].
    pub slip: f64,
    /// Power that friction takes out \[W\]; of a whole contact at least 0.
    pub friction_power: f64,
    /// Contact point from the ball's centre \[m\].
    pub(crate) arm_ball: V2,
    /// Axis about which rotations of the ball turn it along its slice: ẑ but at the edges of a cap (see `damage::cap`).
    pub(crate) turn_axis: Vector3<f64>,
    /// Whether damping wanted to pull.
    pub pull: bool,
}

/// A force between ball and ring at one point.
///
/// By itself, what makes elastic forces the gradient of their energy beside those along normals: of waves, and of the
/// axial ends of defects. Damping and friction do not follow it.
#[doc(hidden)]
#[derive(Debug, Clone, Copy)]
pub struct PointForce {
    /// Force on the ball in the plane \[N\].
    pub(crate) plane: V2,
    /// Force on the ball along z \[N\].
    pub(crate) axial: f64,
    /// The point from the ball's centre \[m\].
    pub(crate) arm_ball: V2,
    /// Axis as of a [`ContactForce`].
    pub(crate) turn_axis: Vector3<f64>,
    /// Moment on the ball across the ring's axis beside that \[N m\].
    pub(crate) across: V2,
}

/// Receives the single forces of a contact.
#[doc(hidden)]
pub trait Sink {
    /// Whether [`ContactForce::energy`] is needed; it costs a power a slice.
    fn asks_energy(&self) -> bool {
        false
    }

    /// Takes one force.
    fn force(&mut self, force: &ContactForce);

    /// A force beside those along normals.
    fn point(&mut self, _force: &PointForce) {}

    /// Takes what the oil does in the contact, after its single forces.
    fn oil(&mut self, _oil: &OilForce) {}

    /// A slice would touch but lies beyond a shoulder.
    fn truncated(&mut self) {}
}
