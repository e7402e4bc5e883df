//! The rings' own matrix, inverted.

use nalgebra::SMatrix;

use crate::contact::{AXIAL, FREE};

/// A number for each direction of both rings.
pub(super) type OnBothRings<const N: usize> = [[f64; N]; 2];

/// The inverse of a matrix for N directions a ring by its entries, in blocks a ring; none if it is singular.
pub(super) fn inverse<const N: usize>(
    entry: impl Fn(usize, usize) -> f64,
) -> Option<[[SMatrix<f64, N, N>; 2]; 2]> {
    if N == AXIAL {
        let inverse = SMatrix::<f64, { 2 * AXIAL }, { 2 * AXIAL }>::from_fn(entry).try_inverse()?;
        Some(blocks(&inverse))
    } else {
        let inverse = SMatrix::<f64, { 2 * FREE }, { 2 * FREE }>::from_fn(entry).try_inverse()?;
        Some(blocks(&inverse))
    }
}

fn blocks<const N: usize, const BOTH: usize>(
    of: &SMatrix<f64, BOTH, BOTH>,
) -> [[SMatrix<f64, N, N>; 2]; 2] {
    [0, N].map(|i| [0, N].map(|j| of.fixed_view::<N, N>(i, j).into_owned()))
}
