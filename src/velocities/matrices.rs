//! Products and inverses of the small matrices of which the contacts' matrix is made.

// Loops over matrices read as their formulae do.
#![allow(clippy::needless_range_loop)]

use nalgebra::SMatrix;

use crate::contact::{AXIAL, FREE};
use crate::simd::{Lanes, Simd, Vector};

/// A matrix for each of eight balls, of which a row is a direction of the ball.
pub(super) type LaneMatrix<const N: usize> = [[Lanes; N]; N];

/// A number for each direction of both rings.
pub(super) type OnBothRings<const N: usize> = [[f64; N]; 2];

/// A matrix times a vector, in the lanes of a register from one of them on. Loops, since closures are not compiled for the register's
/// instructions where the compiler does not take them in.
#[inline(always)]
pub(super) fn product<S: Simd, const N: usize>(
    simd: S,
    at: usize,
    a: &LaneMatrix<N>,
    x: &[Lanes; N],
) -> [Vector<S>; N] {
    let mut product = [Vector::all(simd, 0.0); N];
    for k in 0..N {
        let x = Vector::load(simd, &x[k].numbers()[at..]);
        for i in 0..N {
            let a = Vector::load(simd, &a[i][k].numbers()[at..]);
            product[i] = a.mul_add(x, product[i]);
        }
    }
    product
}

/// A vector and a matrix times another, column by column: of six directions nalgebra makes blocks for large matrices.
#[inline(always)]
pub(super) fn added<const N: usize>(
    mut to: [f64; N],
    a: &SMatrix<f64, N, N>,
    x: &[f64; N],
) -> [f64; N] {
    for (j, x) in x.iter().enumerate() {
        for i in 0..N {
            to[i] += a[(i, j)] * x;
        }
    }
    to
}

/// Replaces a matrix by its inverse (Gauss and Jordan).
///
/// There is no pivoting: 1 − D S is the unit matrix and what friction and damping add to its definite side.
#[inline(always)]
pub(super) fn invert<const FMA: bool, const N: usize>(a: &mut LaneMatrix<N>) {
    for k in 0..N {
        let inverse = Lanes::all(1.0) / a[k][k];
        a[k][k] = Lanes::all(1.0);
        for j in 0..N {
            a[k][j] = a[k][j] * inverse;
        }
        for i in (0..N).filter(|&i| i != k) {
            let factor = -a[i][k];
            a[i][k] = Lanes::ZERO;
            for j in 0..N {
                a[i][j] = factor.mul_add::<FMA>(a[k][j], a[i][j]);
            }
        }
    }
}

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
