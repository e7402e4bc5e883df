//! Pits: elliptic holes smaller than the contact, so deep that nothing meets their floor. What they release is in `hole`.

use nalgebra::Vector3;

use super::direction::ContactDirection;
use super::hole::{Hole, Released};
use super::small::{SmallBed, half_axes};
use super::{Acts, AnyDamage, Bed, DamageKind, Releases, SurfaceDefect};

/// A pit, compiled.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CompiledPit {
    hole: Hole,
    bed: SmallBed,
}

impl CompiledPit {
    /// A pit of a surface, compiled.
    pub fn compiled(width: f64, length: Option<f64>, bed: &Bed) -> AnyDamage {
        let half = half_axes(width, length);
        AnyDamage::Pit(Self {
            hole: Hole::new(half),
            bed: SmallBed::new(half[1], bed),
        })
    }
}

impl DamageKind for CompiledPit {
    fn reach(&self, _angle: f64, _bed: &Bed) -> f64 {
        self.bed.reach()
    }

    fn pole(&self, of: &SurfaceDefect) -> Option<Vector3<f64>> {
        Some(self.bed.pole(of))
    }

    fn half(&self, _of: &SurfaceDefect, _e: Option<&Vector3<f64>>) -> f64 {
        self.bed.span
    }

    fn is_near(
        &self,
        of: &SurfaceDefect,
        direction: &ContactDirection,
        _e: Option<&Vector3<f64>>,
    ) -> bool {
        direction.offset(of).abs() <= of.reach
    }

    fn widened(&mut self, half_width: f64) -> Option<f64> {
        Some(self.bed.widened(half_width))
    }

    fn mirrored(&self) -> AnyDamage {
        AnyDamage::Pit(self.clone())
    }

    fn acts(&self) -> Acts<'_> {
        Acts::Releases(self)
    }
}

impl Releases for CompiledPit {
    fn bed(&self) -> &SmallBed {
        &self.bed
    }

    fn across(&self) -> f64 {
        self.hole.across()
    }

    fn released(&self, race: usize, depth: f64, at: [f64; 2]) -> Released {
        Released {
            lost: self.hole.released(&self.bed.contacts[race], depth, at),
            ..Released::default()
        }
    }
}
