//! Newton's method on rings and balls together, for what the rounds between a cage and the rest leave unbalanced.
//!
//! Rounds converge the slower the stiffer the cage is against the contacts, and the less load the balls have of their own.

use nalgebra::{DMatrix, DVector, Vector2};

use super::TOLERANCE;
use super::problem::Problem;
use super::springs::CageSpring;
use super::unknowns::{RingStiffness, Rings};
use crate::base::error::Result;
use crate::base::interrupt;
use crate::model::Race;

/// Iterations, at most.
const ITERATIONS: usize = 60;
/// Halvings of a step that makes things worse, at most.
const HALVINGS: usize = 12;
/// Stiffness, over that of a typical contact, that a ball which nothing touches is given along its free ways.
const LOOSE: f64 = 1e-9;

/// Forces on all bodies, rings first and then radius and z of each ball, and the stiffness against them.
struct WholeSystem {
    force: DVector<f64>,
    stiffness: DMatrix<f64>,
}

impl Problem<'_> {
    /// Moves rings and balls to where nothing is left, as far as Newton's method finds that; links of the cage act as what they
    /// are, at the balls' present angles.
    pub(super) fn polish(
        &mut self,
        rings: &mut Rings,
        places: &mut Vec<Vector2<f64>>,
    ) -> Result<()> {
        // They stand for the cage in the rounds.
        self.cage_spring.fill(CageSpring::default());
        let mut whole = self.whole(rings, places);
        for _ in 0..ITERATIONS {
            interrupt::check()?;
            let left = whole.force.norm();
            if left <= TOLERANCE * self.magnitude {
                break;
            }
            let Some(step) = whole.stiffness.clone().lu().solve(&whole.force) else {
                break;
            };
            // A contact is lost or found within its approach.
            let longest = step.amax() / self.model.scales.approach;
            let mut share = (1.0 / longest).min(1.0);
            let better = (0..HALVINGS).find_map(|_| {
                let moved = self.moved(rings, places, &step, share);
                let trial = self.whole(&moved.0, &moved.1);
                share /= 2.0;
                (trial.force.norm() < left).then_some((moved, trial))
            });
            let Some((moved, trial)) = better else { break };
            (*rings, *places) = moved;
            whole = trial;
        }
        let first = self.free.len();
        let pulls = self.cage_pulls(places);
        let mut against = DMatrix::zeros(first + 2 * places.len(), first + 2 * places.len());
        self.add_cage(places, &pulls, &mut against);
        let held = pulls.into_iter().zip(&*places).enumerate();
        self.cage_spring = held
            .map(|(j, (pull, place))| {
                let own = against[(first + 2 * j, first + 2 * j)];
                CageSpring::held(pull, own.max(0.0), place.x)
            })
            .collect();
        Ok(())
    }

    fn moved(
        &self,
        rings: &Rings,
        places: &[Vector2<f64>],
        step: &DVector<f64>,
        share: f64,
    ) -> (Rings, Vec<Vector2<f64>>) {
        let mut rings = *rings;
        for (a, &i) in self.free.iter().enumerate() {
            rings[i] += share * step[a];
        }
        let first = self.free.len();
        let balls = places.iter().enumerate();
        let places = balls.map(|(j, place)| {
            place + share * Vector2::new(step[first + 2 * j], step[first + 2 * j + 1])
        });
        (rings, places.collect())
    }

    fn whole(&self, rings: &Rings, places: &[Vector2<f64>]) -> WholeSystem {
        let first = self.free.len();
        let count = first + 2 * places.len();
        let mut force = DVector::zeros(count);
        let mut stiffness = DMatrix::zeros(count, count);
        let (mut on_rings, mut own_of_rings) = (self.loads, RingStiffness::zeros());
        let pulls = self.cage_pulls(places);
        for (j, &place) in places.iter().enumerate() {
            let at = first + 2 * j;
            let mut ball = self.ball_at(j, rings, place);
            let contacts = self.contact_stiffness(j, rings, &mut ball);
            ball.press(&mut on_rings);
            for race in Race::BOTH {
                ball.stiffen(race, &contacts[race], &mut own_of_rings);
            }
            let mut own = self.ball_stiffness(j, rings, &mut ball);
            own += nalgebra::Matrix2::identity() * (LOOSE * self.stiffness());
            if self.is_held(j) {
                own = nalgebra::Matrix2::identity() * self.stiffness();
            } else {
                (force[at], force[at + 1]) = (ball.force.x + pulls[j], ball.force.y);
                let (pulled, pulling) = self.coupling(j, &ball, &contacts);
                for (a, &i) in self.free.iter().enumerate() {
                    for k in 0..2 {
                        stiffness[(a, at + k)] = -pulling[(i, k)];
                        stiffness[(at + k, a)] = -pulled[(k, i)];
                    }
                }
            }
            stiffness.fixed_view_mut::<2, 2>(at, at).copy_from(&own);
        }
        self.add_cage(places, &pulls, &mut stiffness);
        self.apply(rings, &mut on_rings, &mut own_of_rings);
        self.stiffen(&mut own_of_rings);
        for (a, &i) in self.free.iter().enumerate() {
            force[a] = on_rings[i] - self.resistance(i, rings);
            for (b, &k) in self.free.iter().enumerate() {
                stiffness[(a, b)] = own_of_rings[(i, k)];
            }
        }
        WholeSystem { force, stiffness }
    }

    /// Adds what the cage has against the balls' radii, by differences.
    fn add_cage(&self, places: &[Vector2<f64>], pulls: &[f64], stiffness: &mut DMatrix<f64>) {
        let first = self.free.len();
        let aside = 1e-3 * self.model.scales.approach;
        let mut moved = places.to_vec();
        for k in (0..places.len()).filter(|k| !self.is_held(*k)) {
            moved[k].x += aside;
            let there = self.cage_pulls(&moved);
            moved[k].x = places[k].x;
            for j in (0..places.len()).filter(|j| !self.is_held(*j)) {
                stiffness[(first + 2 * j, first + 2 * k)] -= (there[j] - pulls[j]) / aside;
            }
        }
    }
}
