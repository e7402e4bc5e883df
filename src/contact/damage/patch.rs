//! Patches: the surface is absent over a length along the axis and a width along rolling.
//!
//! A slice at z has lost the arc of half-width w(z)/(2ρ) about the patch's middle. On a ball a patch lies between two planes across the
//! ring's axis, about which alone it turns.

use nalgebra::Vector3;

use super::arc::{Arc, EdgeCourse, Station};
use super::direction::ContactDirection;
use super::{Acts, AnyForm, Bed, CompiledForm, Cuts, MARGIN, SurfaceDefect};
use crate::contact::V2;
use crate::scene::{Floor, Width};

/// A patch, compiled.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CompiledPatch {
    /// Axial length \[m\].
    length: f64,
    width: Width,
    edges: CircleEdges,
}

/// Fault circles at the edges of an arc, and those of its floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CircleEdges {
    /// R_f \[m\].
    pub radius: f64,
    /// Depth \[m\] and number of the recessed circles.
    pub floor: Option<(f64, usize)>,
}

impl CircleEdges {
    pub fn new(radius: f64, floor: Option<&Floor>) -> Self {
        let floor = floor.map(|&Floor { depth, elements }| (depth, elements));
        Self { radius, floor }
    }
}

impl CompiledPatch {
    /// A patch of a surface, compiled.
    pub fn new(length: f64, width: &Width, edges: CircleEdges) -> Self {
        Self {
            length,
            width: width.clone(),
            edges,
        }
    }
}

impl CompiledForm for CompiledPatch {
    fn reach(&self, _angle: f64, bed: &Bed) -> f64 {
        MARGIN * self.width.largest() / (2.0 * bed.least)
    }

    fn pole(&self, _of: &SurfaceDefect) -> Option<Vector3<f64>> {
        None
    }

    fn half(&self, of: &SurfaceDefect, _e: Option<&Vector3<f64>>) -> f64 {
        of.reach / MARGIN
    }

    fn is_near(
        &self,
        of: &SurfaceDefect,
        direction: &ContactDirection,
        _e: Option<&Vector3<f64>>,
    ) -> bool {
        direction.offset(of).abs() <= of.reach
    }

    fn widened(&mut self, _half_width: f64) -> Option<f64> {
        None
    }

    fn mirrored(&self) -> AnyForm {
        AnyForm::Patch(Self {
            width: self.width.reversed(),
            ..self.clone()
        })
    }

    fn acts(&self) -> Acts<'_> {
        Acts::Cuts(self)
    }
}

impl Cuts for CompiledPatch {
    fn arc(
        &self,
        of: &SurfaceDefect,
        at: &Station,
        middle: f64,
        _e: Option<&Vector3<f64>>,
    ) -> Option<Arc> {
        let from_middle = at.z - of.middle;
        if (from_middle + at.beside).abs() > self.length / 2.0 {
            return None;
        }
        let (width, slope) = self.width.at(from_middle);
        (width > 0.0).then(|| {
            let course = EdgeCourse::Width { width, slope };
            let half = width / (2.0 * at.radius);
            Arc::about(middle, half, self.edges.radius + of.film_layer, course)
        })
    }

    fn length(&self) -> Option<f64> {
        Some(self.length)
    }

    fn crossings(&self, _e: &Vector3<f64>, _n: V2) -> Option<[f64; 2]> {
        None
    }

    fn floor(&self) -> Option<(f64, usize)> {
        self.edges.floor
    }
}

#[cfg(test)]
mod tests {
    use crate::contact::{Motion, SurfaceDefect};
    use crate::model::Race;
    use crate::scene::{Defect, Patch, Surface, presets};

    /// Analytic: a spall as long as the groove is wide is seen wherever a slice may meet it, and hardly further, though the race is not
    /// equally wide along it.
    #[test]
    fn a_defect_reaches_as_far_as_its_widest_slice() {
        let (width, length) = (3e-3, 5e-3);
        for (race, on) in [
            (Race::Outer, Surface::OuterRace),
            (Race::Inner, Surface::InnerRace),
        ] {
            for offset in [-0.5e-3, 0.0, 1e-3] {
                let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
                let model = crate::compile(&scene).unwrap();
                let row = &model.rows[0];
                let defect = Defect::of(
                    Patch::of_width(width).length(length).edge_radius(0.3e-3),
                    on,
                    0.0,
                )
                .at_offset(offset);
                let pair = &row.pairs[race];
                let hertz = &row.hertz[race];
                let defect = SurfaceDefect::of_race(&defect, &scene.rows[0], hertz, |z, length| {
                    pair.radii(z, length)
                });
                let mut widest = 0.0_f64;
                for k in 0..=1000 {
                    let z = offset + length * (f64::from(k) / 1000.0 - 0.5) * 0.999;
                    let radius = pair.radius_at(z).unwrap();
                    let half = width / (2.0 * radius);
                    let covers = |offset| defect.covers(z, radius, offset, &Motion::default());
                    assert!(covers(0.999 * half) && !covers(1.001 * half), "{z}");
                    widest = widest.max(half);
                }
                let over = defect.reach / widest;
                assert!((1.0..1.02).contains(&over), "{on:?}, {offset}: {over}");
            }
        }
    }
}
