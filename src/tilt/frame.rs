//! The frame of a ring: it turns ẑ into the ring's axis by the shortest way, and does not spin with the ring.
//!
//! ```text
//! F = [ 1 − τ_y² k    τ_x τ_y k     τ_y ]
//!     [ τ_x τ_y k     1 − τ_x² k   −τ_x ]     k = 1/(1 + w)
//!     [ −τ_y           τ_x            w ]
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::simd::Number;

/// Orientation of a ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Frame {
    /// τ_x and τ_y.
    pub tilt: [f64; 2],
    /// w, the axis along z.
    pub(super) along: f64,
    /// k.
    pub(super) k: f64,
    matrix: Matrix3<f64>,
}

impl Frame {
    /// The frame of a ring that tilts; its tilt is shorter than 1.
    pub fn new([x, y]: [f64; 2]) -> Self {
        let along = (1.0 - x * x - y * y).max(0.0).sqrt();
        let k = 1.0 / (1.0 + along);
        Self {
            tilt: [x, y],
            along,
            k,
            matrix: Matrix3::new(
                1.0 - y * y * k,
                x * y * k,
                y,
                x * y * k,
                1.0 - x * x * k,
                -x,
                -y,
                x,
                along,
            ),
        }
    }

    /// The ring's axis a.
    pub fn axis(&self) -> Vector3<f64> {
        self.matrix.column(2).into_owned()
    }

    /// A vector of the ring's frame, in the scene's.
    pub fn to_scene(self, v: &Vector3<f64>) -> Vector3<f64> {
        self.matrix * v
    }

    /// A vector of the scene's frame, in the ring's.
    pub fn to_ring(self, v: &Vector3<f64>) -> Vector3<f64> {
        self.matrix.tr_mul(v)
    }

    /// Vectors side by side, turned as by [`Self::to_scene`].
    #[inline(always)]
    pub fn all_to_scene<T: Number, const FMA: bool>(&self, v: [T; 3]) -> [T; 3] {
        let m = &self.matrix;
        [
            product::<T, FMA>([m.m11, m.m12, m.m13], v),
            product::<T, FMA>([m.m21, m.m22, m.m23], v),
            product::<T, FMA>([m.m31, m.m32, m.m33], v),
        ]
    }

    /// Vectors side by side, turned as by [`Self::to_ring`].
    #[inline(always)]
    pub fn all_to_ring<T: Number, const FMA: bool>(&self, v: [T; 3]) -> [T; 3] {
        let m = &self.matrix;
        [
            product::<T, FMA>([m.m11, m.m21, m.m31], v),
            product::<T, FMA>([m.m12, m.m22, m.m32], v),
            product::<T, FMA>([m.m13, m.m23, m.m33], v),
        ]
    }

    /// A matrix that acts on vectors of the ring's frame, for those of the scene's.
    pub fn matrix_to_scene(&self, of: &Matrix3<f64>) -> Matrix3<f64> {
        self.matrix * of * self.matrix.transpose()
    }
}

/// Scalar product with vectors side by side.
#[inline(always)]
fn product<T: Number, const FMA: bool>(with: [f64; 3], [x, y, z]: [T; 3]) -> T {
    let in_plane = y.mul_add::<FMA>(y.same(with[1]), x * with[0]);
    z.mul_add::<FMA>(z.same(with[2]), in_plane)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Truth: a rotation, about the tilt itself.
    #[test]
    fn a_frame_is_the_shortest_rotation_to_the_axis() {
        let frame = Frame::new([0.3, -0.4]);
        let product = frame.matrix * frame.matrix.transpose();
        assert!((product - Matrix3::identity()).norm() < 1e-15);
        assert!((frame.matrix.determinant() - 1.0).abs() < 1e-15);
        let lies = Vector3::new(0.3, -0.4, 0.0);
        assert!((frame.to_scene(&lies) - lies).norm() < 1e-15);
        assert!((frame.axis() - Vector3::new(-0.4, -0.3, 0.75_f64.sqrt())).norm() < 1e-15);
        assert!((frame.to_ring(&frame.axis()) - Vector3::z()).norm() < 1e-15);
        let v = Vector3::new(0.7, -0.2, 1.1);
        let there: [f64; 3] = frame.all_to_ring::<_, false>(v.into());
        assert!((Vector3::from(there) - frame.to_ring(&v)).norm() < 1e-15);
        let back: [f64; 3] = frame.all_to_scene::<_, false>(there);
        assert!((Vector3::from(back) - v).norm() < 1e-15);
    }

    /// Limits: without a tilt nothing is turned, bit by bit.
    #[test]
    fn without_a_tilt_it_is_the_scene() {
        assert_eq!(Frame::new([0.0; 2]).matrix, Matrix3::identity());
    }
}
