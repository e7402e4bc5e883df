//! The cage's part in the equilibrium.

use std::f64::consts::TAU;

use nalgebra::Vector2;

use super::fallen::{self, Spacing};
use super::problem::Problem;
use super::springs::CageSpring;
use super::unknowns::Rings;
use crate::contact::V2;
use crate::model::{BodyId, Dof, RowModel};
use crate::scene::CageLinks;

/// Newton iterations for the length of the links, at most; three do.
const LENGTH_ITERATIONS: usize = 10;
/// Iterations for a row's tension, at most, and its precision over the sum of the acting forces.
const TENSION_ITERATIONS: usize = 60;
const TENSION: f64 = 1e-10;
/// Passes over a row's balls that let each follow its neighbours. Few: balls side by side that hang on the cage take many,
/// but under a tension that is held they would all end on one race. So the next round goes on, with a tension of its own.
const SWEEPS: usize = 4;
/// How close to a race, over the contacts' approach, a loose ball counts as lying on it.
const ON_RACE: f64 = 1e-2;

/// A row's balls as its cage sees them while the rings stand still: springs on their races; and a ball that one race
/// alone carries leaves it when it is pulled off, for the other one or to hang between them on its neighbours.
struct Chain {
    /// Length of all links, and the length at which they are slack.
    length: f64,
    slack: f64,
    /// Number of links of each ball, over two: two balls have but one link.
    links: f64,
    balls: Vec<ChainBall>,
}

struct ChainBall {
    /// Radius and z now, on the inner and on the outer race; the same where the ball cannot leave.
    place: Vector2<f64>,
    inmost: Vector2<f64>,
    outmost: Vector2<f64>,
    /// Load of the ball outwards, and the cage's pull under which it has settled.
    load: f64,
    pull: f64,
    hold: Hold,
    /// The furthest that it moves while a race still presses it.
    most: f64,
}

/// How the races hold a ball along its radius: stiffness, and the way along z for a way outwards.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Hold {
    pub(super) stiffness: f64,
    pub(super) slope: f64,
}

impl ChainBall {
    /// The next guess at its radius, from one under a tension with a pull per newton; its neighbours push it back with
    /// so much per metre.
    fn follow(&self, radius: f64, tension: f64, pull: f64, pushed: f64) -> f64 {
        let k = self.hold.stiffness;
        // What the races carried, and carry there.
        let carried = -self.load - self.pull;
        let carry = |radius: f64| carried - k * (radius - self.place.x);
        let there = radius + (self.load + tension * pull + carry(radius)) / (pushed + k);
        let there = there.clamp(self.place.x - self.most, self.place.x + self.most);
        let (lowest, highest) = (self.inmost.x, self.outmost.x);
        if k > 0.0 && (lowest == highest || carry(there) * carried > 0.0) {
            return there;
        }
        (radius + (self.load + tension * pull) / pushed).clamp(lowest, highest)
    }

    /// Place of the ball at a radius.
    fn at(&self, radius: f64) -> Vector2<f64> {
        let way = self.outmost - self.inmost;
        if way.x > 0.0 && radius >= self.inmost.x && radius <= self.outmost.x {
            return self.inmost + way * ((radius - self.inmost.x) / way.x);
        }
        self.place + Vector2::new(1.0, self.hold.slope) * (radius - self.place.x)
    }
}

impl Chain {
    fn radii(&self, of: impl Fn(&ChainBall) -> f64) -> Vec<f64> {
        self.balls.iter().map(of).collect()
    }

    /// Pull of a newton of tension on a ball outwards, less than nothing: a link of length ℓ from radius a to b points
    /// by (b² − a² − ℓ²)/(2aℓ) outwards.
    fn pull(&self, k: usize, radii: &[f64]) -> f64 {
        let last = radii.len() - 1;
        let before = radii[if k == 0 { last } else { k - 1 }];
        let after = radii[if k == last { 0 } else { k + 1 }];
        let (a, length) = (radii[k], self.length);
        let outwards = 0.5 * (before * before + after * after) - a * a - length * length;
        self.links * outwards / (a * length)
    }

    /// Places of the balls under a tension, one after the other.
    fn hang(&self, tension: f64) -> Vec<f64> {
        let mut radii = self.radii(|ball| ball.place.x);
        // Pushed out of line, two links under a tension T push back with 2T/ℓ per metre.
        let pushed = (2.0 * tension.abs() / self.length).max(f64::MIN_POSITIVE);
        for _ in 0..SWEEPS {
            for (k, ball) in self.balls.iter().enumerate() {
                radii[k] = ball.follow(radii[k], tension, self.pull(k, &radii), pushed);
            }
        }
        radii
    }

    /// The tension at these radii: a ball that moves out lengthens all links.
    fn stretched(&self, cage: &CageLinks, radii: &[f64]) -> f64 {
        let count = self.balls.len() as f64;
        let moved = self.balls.iter().zip(radii);
        let more = moved.map(|(ball, radius)| (radius / ball.place.x - 1.0) / count);
        let extension = self.length * (1.0 + more.sum::<f64>()) - self.slack;
        let beyond = (extension.abs() - cage.play / 2.0).max(0.0);
        cage.stiffness * beyond.copysign(extension)
    }

    /// The tension under which the balls are where it needs them, to a precision, sought from another.
    fn tension(&self, cage: &CageLinks, from: f64, precision: f64) -> f64 {
        let excess = |tension: f64| self.stretched(cage, &self.hang(tension)) - tension;
        // The higher, the further in the balls and the less stretched the links: regula falsi (Illinois) between one, and
        // as much as the links have where that acts on the balls.
        let (mut a, mut at_a) = (from, excess(from));
        let mut b = a + at_a;
        let mut at_b = excess(b);
        for _ in 0..TENSION_ITERATIONS {
            // Balls next to no load hover on a tension that hardly changes from race to race: its last digits matter.
            if at_b.abs() <= precision || (a - b).abs() <= f64::EPSILON * b.abs() {
                break;
            }
            let next = b - at_b * (b - a) / (at_b - at_a);
            let at_next = excess(next);
            if at_next * at_b <= 0.0 {
                (a, at_a) = (b, at_b);
            } else {
                at_a /= 2.0;
            }
            (b, at_b) = (next, at_next);
        }
        b
    }
}

/// The angle that a link of a length spans from a ball of a row, at its radius, to the next one: law of cosines.
fn span(balls: &[Vector2<f64>], k: usize, length: f64) -> f64 {
    let (a, b) = (balls[k].x, balls[(k + 1) % balls.len()].x);
    let cos = (a * a + b * b - length * length) / (2.0 * a * b);
    cos.clamp(-1.0, 1.0).acos()
}

/// The mean length with which links that are longer than it by so much close the circle.
fn closing(balls: &[Vector2<f64>], longer: &[f64], guess: f64) -> f64 {
    let count = balls.len();
    let mut mean = guess;
    for _ in 0..LENGTH_ITERATIONS {
        let (mut sum, mut slope) = (0.0, 0.0);
        for k in 0..count {
            let length = mean + longer[k];
            let span = span(balls, k, length);
            sum += span;
            // Each span grows with the length ℓ by ℓ/(a b sin span).
            slope += length / (balls[k].x * balls[(k + 1) % count].x * span.sin());
        }
        let step = (TAU - sum) / slope;
        mean += step;
        if step.abs() <= f64::EPSILON * mean {
            break;
        }
    }
    mean
}

impl Problem<'_> {
    /// The cage's part at the balls' present places: angles at which all links of a row are equally long, their
    /// tension, and where the balls are under it. Returns how far the forces on a ball were from that.
    ///
    /// Balls pressed outwards stretch the cage; left out, its tension would shake the bearing at the start.
    pub(super) fn engage(
        &mut self,
        cage: &CageLinks,
        rings: &Rings,
        places: &mut [Vector2<f64>],
        holds: &[Hold],
    ) -> f64 {
        let model = self.model;
        let mut left: f64 = 0.0;
        for row in model.rows.iter().filter(|row| row.count > 1) {
            let places = &mut places[row.balls()];
            let (length, turned) = self.spread(row, rings, places);
            left = left.max(self.share() * turned);
            let balls = places.iter().enumerate();
            let chain = Chain {
                length,
                slack: row.cage_distance,
                links: row.links().count() as f64 / row.count as f64,
                balls: balls
                    .map(|(k, &place)| {
                        let j = row.first + k;
                        self.chain_ball(j, rings, place, holds[j])
                    })
                    .collect(),
            };
            let radii = chain.radii(|ball| ball.place.x);
            let tension = chain.stretched(cage, &radii);
            for (k, ball) in chain.balls.iter().enumerate() {
                left = left.max((tension * chain.pull(k, &radii) - ball.pull).abs());
            }
            let tension = chain.tension(cage, tension, TENSION * self.magnitude);
            let radii = chain.hang(tension);
            for (k, &radius) in radii.iter().enumerate() {
                // The stiffness of the row's cage against all balls moving out together.
                let chord = row.cage_distance / radius;
                let together = cage.stiffness * chain.links * chord * chord;
                let share = self.cage_share.max(1.0 / row.count as f64);
                let mut spring = CageSpring::default();
                if tension != 0.0 {
                    places[k] = chain.balls[k].at(radius);
                    let pull = tension * chain.pull(k, &radii);
                    spring = CageSpring::held(pull, share * together, radius);
                }
                self.cage_spring[row.first + k] = spring;
            }
        }
        left
    }

    /// Turns the balls of a row to where all links are equally long, or as far from it as its spacing says; returns their mean length
    /// and the largest turn.
    fn spread(&mut self, row: &RowModel, rings: &Rings, balls: &[Vector2<f64>]) -> (f64, f64) {
        if let [first, second] = balls {
            return (first.x + second.x, 0.0);
        }
        let equal = vec![0.0; row.count];
        let mut length = closing(balls, &equal, row.cage_distance);
        // Where all balls are held none can fall.
        let fall = |row: &RowModel| row.balls().any(|j| self.loose(j, rings).is_some());
        let longer = match self.spacing {
            Spacing::Fallen if fall(row) => fallen::longer_links(self.model, row, length),
            _ => None,
        };
        let longer = longer.unwrap_or(equal);
        if longer.iter().any(|longer| *longer != 0.0) {
            length = closing(balls, &longer, length);
        }
        // The mean of the shifts is zero.
        let pitch = TAU / row.count as f64;
        let mut shift = vec![0.0; row.count];
        for k in 1..row.count {
            shift[k] = shift[k - 1] + span(balls, k - 1, length + longer[k - 1]) - pitch;
        }
        let mean = shift.iter().sum::<f64>() / row.count as f64;
        let mut turned: f64 = 0.0;
        for (k, shift) in shift.into_iter().enumerate() {
            let nominal = &self.model.bodies[BodyId::ball(row.first + k)].nominal;
            let angle = nominal[Dof::Y].atan2(nominal[Dof::X]) + shift - mean;
            let direction = V2::new(angle.cos(), angle.sin());
            turned = turned.max((direction - self.directions[row.first + k]).norm());
            self.directions[row.first + k] = direction;
        }
        (length, turned)
    }

    fn chain_ball(&self, j: usize, rings: &Rings, place: Vector2<f64>, hold: Hold) -> ChainBall {
        let mut ball = ChainBall {
            place,
            inmost: place,
            outmost: place,
            load: self.own_load_at(j, place.x).x,
            pull: self.cage_spring[j].pull(place.x),
            hold,
            most: self.model.scales.approach,
        };
        if let Some([outmost, inmost]) = self.loose(j, rings).filter(|_| !self.is_held(j)) {
            // On the race, or even beyond it where a defect or waves make room, is as far as it goes.
            let near = ON_RACE * self.model.scales.approach;
            if place.x < outmost.x - near {
                ball.outmost = outmost;
            }
            if place.x > inmost.x + near {
                ball.inmost = inmost;
            }
        }
        ball
    }
}
