//! How a ring turns: angular velocity, energy, and accelerations under moments.
//!
//! ```text
//! ω = a × ȧ + (θ̇ + χ) a       χ = k (τ_y τ̇_x − τ_x τ̇_y)       ȧ = (τ̇_y, −τ̇_x, ẇ)       ẇ = −(τ_x τ̇_x + τ_y τ̇_y)/w
//!
//! ä = (M − L_s ȧ) × a / I_t − |ȧ|² a,      τ̈_y = ä_x,  τ̈_x = −ä_y      L_s = I_p (θ̇ + χ)
//! θ̈ = M·a / I_p − χ̇,      χ̇ = k (τ_y τ̈_x − τ_x τ̈_y) − k² ẇ (τ_y τ̇_x − τ_x τ̇_y)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | I_p, I_t | moments of inertia about the axis and across it, about the centre of mass | kg m² |
//! | M | moment about the centre of mass | N m |
//! | θ | spin about the axis, against the ring's frame | rad |
//!
//! −L_s ȧ × a is the gyroscopic term. The constraint of a direction that is held or driven acts on its own coordinate only: it
//! does no work on the others.

use nalgebra::{Matrix3, Vector3};

use super::Frame;

/// Moments of inertia of a ring about its centre of mass \[kg m²\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Inertia {
    /// Moment of inertia about the axis.
    pub polar: f64,
    /// Moment of inertia across the axis.
    pub transverse: f64,
}

/// A ring that tilts and turns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rotation {
    pub frame: Frame,
    /// Rates of τ_x and τ_y.
    rates: [f64; 2],
    /// θ̇ \[rad/s\].
    spin: f64,
    /// ȧ.
    axis_rate: Vector3<f64>,
    /// χ, what the motion of the tilt adds to the spin \[rad/s\].
    drift: f64,
}

impl Rotation {
    /// The rotation of a ring with a tilt, its rates and a spin \[rad/s\].
    pub fn new(tilt: [f64; 2], rates: [f64; 2], spin: f64) -> Self {
        let frame = Frame::new(tilt);
        let ([x, y], [vx, vy]) = (tilt, rates);
        Self {
            frame,
            rates,
            spin,
            axis_rate: Vector3::new(vy, -vx, -(x * vx + y * vy) / frame.along),
            drift: frame.k * (y * vx - x * vy),
        }
    }

    /// ω, in the scene's frame \[rad/s\].
    pub fn angular_velocity(&self) -> Vector3<f64> {
        let axis = self.frame.axis();
        axis.cross(&self.axis_rate) + axis * (self.spin + self.drift)
    }

    /// Kinetic energy of the rotation \[J\].
    pub fn kinetic_energy(&self, inertia: &Inertia) -> f64 {
        let about = self.spin + self.drift;
        0.5 * (inertia.polar * about * about + inertia.transverse * self.axis_rate.norm_squared())
    }

    /// The moment of generalised forces on τ_x, τ_y and θ \[N m\]: what does their work.
    pub fn moment_of(&self, [on_x, on_y, on_spin]: [f64; 3]) -> Vector3<f64> {
        let (axis, [x, y]) = (self.frame.axis(), self.frame.tilt);
        let tilted = on_spin * self.frame.k;
        let across = Vector3::new(on_y + tilted * x, tilted * y - on_x, 0.0);
        axis * on_spin + axis.cross(&across)
    }

    /// Accelerations of τ_x, τ_y and θ under a moment about the centre of mass \[N m\], where some are prescribed.
    pub fn accelerations(
        &self,
        inertia: &Inertia,
        moment: &Vector3<f64>,
        prescribed: &[Option<f64>; 3],
    ) -> [f64; 3] {
        if let [Some(x), Some(y), Some(spin)] = *prescribed {
            return [x, y, spin];
        }
        let free = self.free(inertia, moment);
        if *prescribed == [None; 3] {
            return free.into();
        }
        // Accelerations are linear in the forces of the holds.
        if let [None, None, Some(spin)] = *prescribed {
            // Most rings that tilt are held or driven about their axis: one division, and no matrix.
            let by_hold = self.response(inertia, &self.moment_of([0.0, 0.0, 1.0]));
            let [x, y, _] = (free + by_hold * ((spin - free.z) / by_hold.z)).into();
            return [x, y, spin];
        }
        let mut against = Matrix3::identity();
        let mut wanted = Vector3::zeros();
        let mut response = Matrix3::zeros();
        for i in 0..3 {
            let mut unit = [0.0; 3];
            unit[i] = 1.0;
            response.set_column(i, &self.response(inertia, &self.moment_of(unit)));
        }
        for (i, prescribed) in prescribed.iter().enumerate() {
            if let Some(acceleration) = prescribed {
                against.set_row(i, &response.row(i));
                wanted[i] = acceleration - free[i];
            }
        }
        let holds = against.lu().solve(&wanted).unwrap_or_default();
        let mut found = free + response * holds;
        for (found, prescribed) in found.iter_mut().zip(prescribed) {
            // But for rounding it is there.
            *found = prescribed.unwrap_or(*found);
        }
        found.into()
    }

    /// Response to a moment where nothing is prescribed: of the same form as [`Self::free`], at rest.
    fn response(&self, inertia: &Inertia, moment: &Vector3<f64>) -> Vector3<f64> {
        let (axis, [x, y]) = (self.frame.axis(), self.frame.tilt);
        let turning = moment.cross(&axis) / inertia.transverse;
        let (ax, ay) = (-turning.y, turning.x);
        let drift_rate = self.frame.k * (y * ax - x * ay);
        Vector3::new(ax, ay, moment.dot(&axis) / inertia.polar - drift_rate)
    }

    /// Acceleration where nothing is prescribed.
    fn free(&self, inertia: &Inertia, moment: &Vector3<f64>) -> Vector3<f64> {
        let (axis, rate) = (self.frame.axis(), self.axis_rate);
        let ([x, y], [vx, vy]) = (self.frame.tilt, self.rates);
        let (k, spinning) = (self.frame.k, inertia.polar * (self.spin + self.drift));
        let turning = (moment - rate * spinning).cross(&axis) / inertia.transverse
            - axis * rate.norm_squared();
        let (ax, ay) = (-turning.y, turning.x);
        let drift_rate = k * (y * ax - x * ay) - k * k * rate.z * (y * vx - x * vy);
        Vector3::new(ax, ay, moment.dot(&axis) / inertia.polar - drift_rate)
    }
}

#[cfg(test)]
mod tests;
