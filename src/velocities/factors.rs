//! The rings' own matrix, factorised.

use nalgebra::{Const, LU, SMatrix, SVector};

use crate::contact::{AXIAL, FREE};

/// A number for each direction of both rings.
pub(super) type OnBothRings<const N: usize> = [[f64; N]; 2];

type RingMatrix<const R: usize> = SMatrix<f64, R, R>;
type Factorised<const R: usize> = LU<f64, Const<R>, Const<R>>;

/// Factors of both rings' directions: those of parallel rings, or all.
// A matrix has one of them; in a box the larger would be allocated for every matrix.
#[allow(clippy::large_enum_variant)]
#[derive(Debug, Clone)]
pub(super) enum Factors {
    Axial(Factorised<{ 2 * AXIAL }>),
    Free(Factorised<{ 2 * FREE }>),
}

impl Factors {
    /// The factors of a matrix for N directions a ring, by its entries.
    pub fn of<const N: usize>(entry: impl Fn(usize, usize) -> f64) -> Self {
        if N == AXIAL {
            Self::Axial(RingMatrix::<{ 2 * AXIAL }>::from_fn(entry).lu())
        } else {
            Self::Free(RingMatrix::<{ 2 * FREE }>::from_fn(entry).lu())
        }
    }

    /// The unknowns for a right-hand side; none if the matrix is singular.
    pub fn solve<const N: usize>(&self, right: &OnBothRings<N>) -> Option<OnBothRings<N>> {
        let mut unknowns = *right;
        let of = |i: usize, _: usize| right.as_flattened()[i];
        match self {
            Self::Axial(factors) => {
                let found = factors.solve(&SVector::from_fn(of))?;
                unknowns
                    .as_flattened_mut()
                    .copy_from_slice(found.as_slice());
            }
            Self::Free(factors) => {
                let found = factors.solve(&SVector::from_fn(of))?;
                unknowns
                    .as_flattened_mut()
                    .copy_from_slice(found.as_slice());
            }
        }
        Some(unknowns)
    }
}
