//! Lists with one entry a race or a body, indexed by it.

use std::ops::{Index, IndexMut};

use super::{BodyId, Race};

/// Arrays with one entry a race are indexed by the race.
impl<T> Index<Race> for [T; 2] {
    type Output = T;

    #[inline]
    fn index(&self, race: Race) -> &T {
        &self[race as usize]
    }
}

impl<T> IndexMut<Race> for [T; 2] {
    #[inline]
    fn index_mut(&mut self, race: Race) -> &mut T {
        &mut self[race as usize]
    }
}

/// Vectors with one entry a body are indexed by the body.
impl<T> Index<BodyId> for Vec<T> {
    type Output = T;

    #[inline]
    fn index(&self, body: BodyId) -> &T {
        &self[body.0]
    }
}

impl<T> IndexMut<BodyId> for Vec<T> {
    #[inline]
    fn index_mut(&mut self, body: BodyId) -> &mut T {
        &mut self[body.0]
    }
}
