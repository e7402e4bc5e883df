//! Rings that tilt: orientation and equations of a symmetric rigid body with an axis.
//!
//! A ring has a unit axis a. Its **tilt** (τ_x, τ_y) is the part of ẑ × a in the plane, so that positive τ_x tips the axis as
//! a right-handed rotation about +x does:
//!
//! ```text
//! a = (τ_y, −τ_x, w),  w = √(1 − τ_x² − τ_y²)
//! ```
//!
//! To third order it is the rotation vector; its length is the sine of the angle between a and ẑ. The two numbers are a vector
//! in the plane: there is no order of axes, they are regular to 90°, and their rates are velocities. The rotation about the
//! ring's axis is the spin θ.
//!
//! `frame` has the ring's frame, which tilts but does not spin, `rotation` its angular velocity and its equations of motion.
//! Nothing here depends on a scene or on the layout of a state.

mod frame;
mod rotation;

pub(crate) use frame::Frame;
pub(crate) use rotation::{Inertia, Rotation};
