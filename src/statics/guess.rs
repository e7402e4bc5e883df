//! A first guess of the rings' places: every ball a spring between the centres of its grooves.
//!
//! The usual model of a bearing at rest (T. A. Harris, *Rolling Bearing Analysis*, ch. 7): no centrifugal force turns
//! a ball's two contacts against each other. It costs a hundredth of the contacts themselves.

use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, Vector2, Vector3};

use super::problem::Problem;
use super::search::search;
use super::unknowns::{self, OF_A_RING, RingStiffness, Rings};
use crate::model::{BodyId, Race};

/// Newton iterations at most, and the residual over the sum of the acting forces that is good enough.
const ITERATIONS: usize = 40;
const GOOD: f64 = 1e-3;

impl Problem<'_> {
    /// Places of the rings where such springs carry the load.
    pub(super) fn guess(&self) -> Option<Rings> {
        let longest = 0.02 * self.model.balls[0].side.radius;
        let mut rings = self.relaxed();
        let mut state = self.sprung(&rings);
        for _ in 0..ITERATIONS {
            let (forces, stiffness) = &state;
            let residual = DVector::from_fn(self.free.len(), |a, _| forces[self.free[a]]);
            if self.error(&residual) <= GOOD {
                return Some(rings);
            }
            let stiffness = DMatrix::from_fn(residual.len(), residual.len(), |a, b| {
                stiffness[(self.free[a], self.free[b])]
            });
            let step = self.newton_step(&stiffness, &residual, longest);
            let found = search(unknowns::work(forces, &step), |t| {
                let moved = rings + step * t;
                let trial = self.sprung(&moved);
                Some((unknowns::work(&trial.0, &step), (moved, trial)))
            });
            (rings, state) = found?;
        }
        None
    }

    /// Forces on the rings, and the stiffness against them.
    fn sprung(&self, rings: &Rings) -> (Rings, RingStiffness) {
        let mut forces = self.loads;
        let mut tied = Matrix3::zeros();
        let mut stiffness = RingStiffness::zeros();
        for (j, ball) in self.model.balls.iter().enumerate() {
            let (x, y) = (self.directions[j].x, self.directions[j].y);
            let in_space = |v: Vector2<f64>| Vector3::new(v.x * x, v.x * y, v.y);
            let own = in_space(self.own_load(j));
            unknowns::add(&mut forces, self.towards(j), &own);
            for line in self.lines(j, rings).filter(|line| line.approach > 0.0) {
                let (force, slope) = self.springs[ball.row].force(line.approach);
                let unit = in_space(line.unit);
                for race in Race::BOTH {
                    unknowns::add(&mut forces, race, &(unit * (race.sigma() * force)));
                }
                let pressed = unit * force;
                // Stiff along the line; aside, in the meridional plane, the force turns with it.
                let aside = force / line.length;
                let plane = Matrix3::new(x * x, x * y, 0.0, x * y, y * y, 0.0, 0.0, 0.0, 1.0);
                let own = unit * unit.transpose() * (slope - aside) + plane * aside;
                tied += own;
                if self.model.tilts() {
                    self.add_tilt(j, rings, &pressed, &own, &mut forces, &mut stiffness);
                }
            }
        }
        for a in Race::BOTH {
            for b in Race::BOTH {
                let (row, column) = (unknowns::first(a), unknowns::first(b));
                let mut part = stiffness.fixed_view_mut::<3, 3>(row, column);
                part += tied * (a.sigma() * b.sigma());
            }
        }
        for (a, ..) in unknowns::all() {
            forces[a] -= self.resistance(a, rings);
        }
        self.stiffen(&mut stiffness);
        self.apply(rings, &mut forces, &mut stiffness);
        (forces, stiffness)
    }

    /// Adds what a spring between the groove centres at a ball does to tilts, which carry the rings' points there along; its
    /// stiffness against places is there already.
    fn add_tilt(
        &self,
        j: usize,
        rings: &Rings,
        pressed: &Vector3<f64>,
        own: &Matrix3<f64>,
        forces: &mut Rings,
        stiffness: &mut RingStiffness,
    ) {
        let [x, y, z, _] = self.model.bodies[BodyId::ball(j)].nominal;
        let arms = Race::BOTH.map(|race| self.arm(rings, race, &Vector3::new(x, y, z)));
        // How a ring's point at the ball moves by its unknowns.
        let moves = arms.map(|arm| {
            let mut moves = SMatrix::<f64, 3, OF_A_RING>::identity();
            let by_tilts = -arm.from.cross_matrix() * arm.turning;
            moves.fixed_view_mut::<3, 2>(0, 3).copy_from(&by_tilts);
            moves
        });
        for a in Race::BOTH {
            let k = unknowns::first(a);
            let on_ring = moves[a].tr_mul(pressed) * a.sigma();
            for i in 3..OF_A_RING {
                forces[k + i] += on_ring[i];
            }
            for b in Race::BOTH {
                let sign = a.sigma() * b.sigma();
                let mut part = moves[a].tr_mul(&(own * moves[b])) * sign;
                part.fixed_view_mut::<3, 3>(0, 0).fill(0.0);
                let (row, column) = (unknowns::first(a), unknowns::first(b));
                let mut of_rings = stiffness.fixed_view_mut::<OF_A_RING, OF_A_RING>(row, column);
                of_rings += part;
            }
        }
    }
}
