//! Unknowns of the rings, each along x, y and z and its tilts, and the one place that gives their offsets.
//!
//! Tilts are lengths here: times half of the mean pitch diameter.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use crate::model::{Dof, RINGS, Race};

/// Directions of a ring that statics looks for, in their order.
const DIRECTIONS: [Dof; 5] = [Dof::X, Dof::Y, Dof::Z, Dof::TiltX, Dof::TiltY];
/// Unknowns of a ring.
pub(super) const OF_A_RING: usize = DIRECTIONS.len();
/// Unknowns of both.
pub(super) const OF_RINGS: usize = RINGS * OF_A_RING;

/// Places of both rings \[m\], or forces on them \[N\].
pub(super) type Rings = SVector<f64, OF_RINGS>;
/// Stiffness of both rings against each other \[N/m\].
pub(super) type RingStiffness = SMatrix<f64, OF_RINGS, OF_RINGS>;

/// Offset of an unknown.
#[inline]
pub(super) const fn at(race: Race, dof: Dof) -> usize {
    let own = match dof {
        Dof::TiltX => 3,
        Dof::TiltY => 4,
        _ => dof.index(),
    };
    first(race) + own
}

/// Offset of a ring's first unknown.
#[inline]
pub(super) const fn first(race: Race) -> usize {
    OF_A_RING * race as usize
}

/// Race and direction at an offset.
#[inline]
pub(super) const fn degree(at: usize) -> (Race, Dof) {
    (Race::BOTH[at / OF_A_RING], DIRECTIONS[at % OF_A_RING])
}

/// Unknowns, all of them with their offsets.
#[inline]
pub(super) fn all() -> impl Iterator<Item = (usize, Race, Dof)> {
    (0..OF_RINGS).map(|at| {
        let (race, dof) = degree(at);
        (at, race, dof)
    })
}

/// Takes from a stiffness what a ball gives that follows the rings: of all unknowns, or of places alone.
#[inline]
pub(super) fn condense(
    of: &mut RingStiffness,
    pulling: &SMatrix<f64, OF_RINGS, 2>,
    followed: &SMatrix<f64, 2, OF_RINGS>,
    spatial: bool,
) {
    let given = |a: usize, b: usize| {
        pulling[(a, 0)] * followed[(0, b)] + pulling[(a, 1)] * followed[(1, b)]
    };
    if spatial {
        *of -= RingStiffness::from_fn(given);
        return;
    }
    for a in Race::BOTH.map(first) {
        for b in Race::BOTH.map(first) {
            let mut part = of.fixed_view_mut::<3, 3>(a, b);
            part -= Matrix3::from_fn(|i, j| given(a + i, b + j));
        }
    }
}

/// Work of forces along a step, summed in the order of the unknowns: those that do not move change no bit of it.
pub(super) fn work(forces: &Rings, step: &Rings) -> f64 {
    forces
        .iter()
        .zip(step)
        .map(|(force, step)| force * step)
        .sum()
}

/// Length of a step, likewise.
pub(super) fn length(step: &Rings) -> f64 {
    work(step, step).sqrt()
}

/// Unknowns of one ring along x, y and z.
#[inline]
pub(super) fn of(rings: &Rings, race: Race) -> Vector3<f64> {
    rings.fixed_rows::<3>(first(race)).into_owned()
}

/// Adds to those of one ring along x, y and z.
#[inline]
pub(super) fn add(rings: &mut Rings, race: Race, part: &Vector3<f64>) {
    let mut of_ring = rings.fixed_rows_mut::<3>(first(race));
    of_ring += part;
}
