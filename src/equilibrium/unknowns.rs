//! Unknowns of the rings, each along x, y and z, and the one place that says where they stand.

use nalgebra::{SMatrix, SVector, Vector3};

use crate::model::{Dof, RINGS, Race};

/// Unknowns of a ring.
pub(super) const OF_A_RING: usize = Dof::TRANSLATIONS.len();
/// Unknowns of both.
pub(super) const OF_RINGS: usize = RINGS * OF_A_RING;

/// Places of both rings \[m\], or forces on them \[N\].
pub(super) type Rings = SVector<f64, OF_RINGS>;
/// Stiffness of both rings against each other \[N/m\].
pub(super) type RingStiffness = SMatrix<f64, OF_RINGS, OF_RINGS>;

/// Where an unknown stands.
#[inline]
pub(super) const fn at(race: Race, dof: Dof) -> usize {
    first(race) + dof.index()
}

/// Where the unknowns of a ring begin.
#[inline]
pub(super) const fn first(race: Race) -> usize {
    OF_A_RING * race as usize
}

/// What stands at a place.
#[inline]
pub(super) const fn degree(at: usize) -> (Race, Dof) {
    (
        Race::BOTH[at / OF_A_RING],
        Dof::TRANSLATIONS[at % OF_A_RING],
    )
}

/// All of them with where they stand.
#[inline]
pub(super) fn all() -> impl Iterator<Item = (usize, Race, Dof)> {
    (0..OF_RINGS).map(|at| {
        let (race, dof) = degree(at);
        (at, race, dof)
    })
}

/// Those of one ring.
#[inline]
pub(super) fn of(rings: &Rings, race: Race) -> Vector3<f64> {
    rings.fixed_rows::<OF_A_RING>(first(race)).into_owned()
}

/// Adds to those of one ring.
#[inline]
pub(super) fn add(rings: &mut Rings, race: Race, part: &Vector3<f64>) {
    let mut of_ring = rings.fixed_rows_mut::<OF_A_RING>(first(race));
    of_ring += part;
}
