//! The cage's part in the equilibrium.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::problem::Problem;
use crate::contact::V2;
use crate::scene::Cage;

/// Newton iterations for the length of the links, at most; three do.
const LENGTH_ITERATIONS: usize = 10;

/// The cage's hold on a ball along its radius: its pull where the ball stood, and a stiffness that keeps a
/// loose ball from jumping between the races from one round to the next.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct CageSpring {
    force: f64,
    stiffness: f64,
    radius: f64,
}

impl CageSpring {
    pub(super) fn pull(&self, radius: f64) -> f64 {
        self.force - self.stiffness * (radius - self.radius)
    }

    pub(super) fn stiffness(&self) -> f64 {
        self.stiffness
    }
}

impl Problem<'_> {
    /// The cage's part at the balls' present radii: angles at which all links of a row are equally long, and
    /// the links' pull on the balls.
    ///
    /// Balls pressed outwards stretch the cage; left out, its tension would shake the bearing at the start.
    pub(super) fn engage(&mut self, cage: &Cage, balls: &[Vector2<f64>]) {
        for row in self.model.rows.iter().filter(|row| row.count > 2) {
            let radii: Vec<f64> = (0..row.count).map(|k| balls[row.first + k].x).collect();
            let next = |k: usize| (k + 1) % row.count;
            // Law of cosines: the angle that a link of this length spans.
            let span = |k: usize, length: f64| {
                let (a, b) = (radii[k], radii[next(k)]);
                ((a * a + b * b - length * length) / (2.0 * a * b))
                    .clamp(-1.0, 1.0)
                    .acos()
            };
            // All spans together make the circle, and each grows with the length ℓ by ℓ/(a b sin span).
            let mut length = row.cage_distance;
            for _ in 0..LENGTH_ITERATIONS {
                let (mut sum, mut slope) = (0.0, 0.0);
                for k in 0..row.count {
                    let span = span(k, length);
                    sum += span;
                    slope += length / (radii[k] * radii[next(k)] * span.sin());
                }
                let step = (TAU - sum) / slope;
                length += step;
                if step.abs() <= f64::EPSILON * length {
                    break;
                }
            }
            let extension = length - row.cage_distance;
            let beyond = (extension.abs() - cage.play / 2.0)
                .max(0.0)
                .copysign(extension);
            let tension = cage.stiffness * beyond;
            // The mean of the shifts is zero.
            let pitch = TAU / row.count as f64;
            let mut shift = vec![0.0; row.count];
            for k in 1..row.count {
                shift[k] = shift[k - 1] + span(k - 1, length) - pitch;
            }
            let mean = shift.iter().sum::<f64>() / row.count as f64;
            for (k, shift) in shift.into_iter().enumerate() {
                let body = &self.model.bodies[2 + row.first + k];
                let angle = body.nominal[1].atan2(body.nominal[0]) + shift - mean;
                self.directions[row.first + k] = V2::new(angle.cos(), angle.sin());
            }
            let place = |k: usize| self.directions[row.first + k] * radii[k];
            for (k, &radius) in radii.iter().enumerate() {
                let before = (k + row.count - 1) % row.count;
                let pull = ((place(next(k)) - place(k)).normalize()
                    + (place(before) - place(k)).normalize())
                    * tension;
                let j = row.first + k;
                // What the row's cage has against all balls moving out together.
                let chord = row.cage_distance / radius;
                self.cage_spring[j] = CageSpring {
                    force: pull.dot(&self.directions[j]),
                    stiffness: if tension == 0.0 {
                        0.0
                    } else {
                        cage.stiffness * chord * chord
                    },
                    radius,
                };
            }
        }
    }
}
