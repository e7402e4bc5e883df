//! The steady speeds of balls under friction: how fast a row orbits and its balls spin, with all bodies at given places.
//!
//! Rolling at the middle of each contact is a first guess. Across a contact the radius of the ball varies, friction slides where balls
//! pivot, films resist rolling and oil drags, and a ball that is carried round at ω_c keeps its angular velocity ω in the cage's
//! frame only if the races turn it by
//!
//! ```text
//! M = I ω_c ẑ × ω        (textbooks' gyroscopic moment is its opposite)
//! ```
//!
//! With the places of all bodies given, ω_c of a row and ω of each of its balls are found from M of every ball and from Σ F_t = 0: what single
//! balls would be ahead or behind, the cage carries. The solution is approached by implicit steps in time, as of a run, that grow as
//! the residual falls until they are Newton's: friction dissipates, so that this converges from any guess, while Newton's method
//! alone diverges where friction slides.

use nalgebra::{SMatrix, SVector, Vector3};

use super::rolling::set_turning;
use crate::contact::{ContactForce, OilForce, Sink, Wrench, cross};
use crate::forces::drag;
use crate::inspect;
use crate::model::{BodyId, Dof, Layout, Model, Race, RowModel};

/// Steps, at most, and the change of speeds, over that of the shaft, that ends them.
const STEPS: usize = 60;
const FOUND: f64 = 1e-10;
/// Differences, over the speed of the shaft.
const ASIDE: f64 = 1e-6;

/// How fast a ball goes round the centre of the outer ring \[rad/s\]: where that gives way, a ball under load is nearer to the ring's
/// centre than to the scene's, and slower by that about the latter.
pub(crate) fn orbit(layout: Layout, y: &[f64], ball: BodyId) -> f64 {
    let motion = layout.motion(y, ball);
    let from = motion.centre - layout.motion(y, BodyId::OUTER).centre;
    cross(from, motion.velocity) / from.norm_squared()
}

/// Lets a ball go round the centre of the outer ring.
fn carry(layout: Layout, y: &mut [f64], ball: BodyId, orbit: f64) {
    let from = layout.motion(y, ball).centre - layout.motion(y, BodyId::OUTER).centre;
    y[layout.speed_at(ball, Dof::X)] = -orbit * from.y;
    y[layout.speed_at(ball, Dof::Y)] = orbit * from.x;
}

/// Friction of both races on a ball in a state, in the scene's frame: forces, and moments about its centre.
pub(super) fn friction(model: &Model, y: &[f64], j: usize) -> [Wrench; 2] {
    Race::BOTH.map(|race| {
        let mut sum = Rubbed::default();
        inspect::visit(model, y, j, race, &mut sum);
        if !model.is_spatial() {
            return sum.0;
        }
        let ring = model.tilted(y, race);
        sum.0.turned(|of| ring.rotation.frame.to_scene(of))
    })
}

#[derive(Default)]
struct Rubbed(Wrench);

impl Sink for Rubbed {
    fn force(&mut self, force: &ContactForce) {
        self.0.add(&force.on_ball(0.0, 1.0));
    }

    fn oil(&mut self, oil: &OilForce) {
        self.0.add(&oil.on_ball());
    }
}

/// Brings speeds from a first guess to those at which friction keeps balls that both races press; the others of their row go round
/// with them. Returns the balls that it keeps so: none of a row without friction, or where nothing was found.
pub(crate) fn keep(model: &Model, y: &mut [f64]) -> Vec<usize> {
    let mut kept = Vec::new();
    for row in &model.rows {
        let loaded = |j: usize, race: Race| inspect::raw::contact(model, y, j, race).load > 0.0;
        let pressed = row
            .balls()
            .filter(|&j| Race::BOTH.into_iter().all(|race| loaded(j, race)));
        let pressed: Vec<usize> = pressed.collect();
        let orbit = if model.balls_turn() {
            SteadyRow::<3>::of(model, row, &pressed, y).and_then(|mut row| row.settle(y))
        } else {
            SteadyRow::<1>::of(model, row, &pressed, y).and_then(|mut row| row.settle(y))
        };
        let Some(orbit) = orbit else { continue };
        for j in row.balls().filter(|j| !pressed.contains(j)) {
            carry(model.layout(), y, BodyId::ball(j), orbit);
        }
        kept.extend(pressed);
    }
    kept
}

/// A row whose balls turn about the axis (N = 1), or about all axes: ω along z, outwards, and along the orbit.
struct SteadyRow<'a, const N: usize> {
    model: &'a Model,
    balls: &'a [usize],
    inertia: f64,
    /// Mass of all these balls times their distance from the axis \[kg m\].
    carried: f64,
    /// Orbit and angular velocities \[rad/s\].
    orbit: f64,
    spins: Vec<SVector<f64, N>>,
    /// Speed of the rings against each other \[rad/s\].
    speed: f64,
    /// Drag of oil in the balls' way (see [`drag`]).
    drag: f64,
}

/// Moments that a ball leaves along its directions of turning \[N m\], and the force along the orbit \[N\].
type Left<const N: usize> = (SVector<f64, N>, f64);

impl<'a, const N: usize> SteadyRow<'a, N> {
    fn of(model: &'a Model, row: &RowModel, balls: &'a [usize], y: &[f64]) -> Option<Self> {
        let rubs = Race::BOTH.map(|race| row.pairs[race].law.traction.is_some());
        let first = BodyId::ball(*balls.first()?);
        let speed = model.scene.relative_speed(0.0).abs();
        if rubs != [true; 2] || speed == 0.0 || model.mobility[first][Dof::Theta] == 0.0 {
            return None;
        }
        let layout = model.layout();
        let spins = balls.iter().map(|&j| {
            let motion = layout.motion(y, BodyId::ball(j));
            let n = motion.centre.normalize();
            let all = [motion.omega, motion.across.dot(&n), cross(n, motion.across)];
            SVector::from_fn(|i, _| all[i])
        });
        let body = &model.bodies[first];
        Some(Self {
            model,
            balls,
            inertia: body.mass[Dof::Theta],
            carried: balls.len() as f64 * body.mass[Dof::X] * layout.motion(y, first).centre.norm(),
            orbit: orbit(layout, y, first),
            spins: spins.collect(),
            speed,
            drag: row.drag,
        })
    }

    /// Moments and force that a ball leaves at speeds.
    fn left(&self, j: usize, orbit: f64, spin: &SVector<f64, N>, y: &mut [f64]) -> Left<N> {
        let (model, layout, body) = (self.model, self.model.layout(), BodyId::ball(j));
        carry(layout, y, body, orbit);
        let at = |i: usize| if i < N { spin[i] } else { 0.0 };
        set_turning(model, y, body, [at(0), at(1), at(2)]);
        let mut both = Wrench::default();
        for of in friction(model, y, j) {
            both.add(&of);
        }
        let [x, y_, _] = layout.centre(y, body);
        let n = Vector3::new(x, y_, 0.0).normalize();
        let t = Vector3::z().cross(&n);
        let velocity = Dof::TRANSLATIONS.map(|dof| y[layout.speed_at(body, dof)]);
        both.force += Vector3::from(drag::on(self.drag, velocity));
        let along = both.force.dot(&t);
        // I ω_c ẑ × (ω_n n + ω_t t).
        let carried = self.inertia * orbit;
        let moments = [
            both.moment.z,
            both.moment.dot(&n) + carried * at(2),
            both.moment.dot(&t) - carried * at(1),
        ];
        (SVector::from_fn(|i, _| moments[i]), along)
    }

    /// Moments and forces that all balls leave, and how large that is for the steps: as angular accelerations \[rad/s²\].
    fn all_left(&self, y: &mut [f64]) -> (Vec<Left<N>>, f64) {
        let each = self.balls.iter().zip(&self.spins);
        let all: Vec<_> = each
            .map(|(&j, spin)| self.left(j, self.orbit, spin, y))
            .collect();
        let mut size = (all.iter().map(|(_, along)| along).sum::<f64>() / self.carried).abs();
        for (moments, _) in &all {
            size = size.max(moments.amax() / self.inertia);
        }
        (all, size)
    }

    /// Returns the orbit; none where the speeds were not found, which are then as they were.
    fn settle(&mut self, y: &mut [f64]) -> Option<f64> {
        let before = y.to_vec();
        let (mut now, mut size) = self.all_left(y);
        if size == 0.0 {
            return Some(self.orbit);
        }
        let mut step = 0.1 * self.speed / size;
        for _ in 0..STEPS {
            let kept = (self.orbit, self.spins.clone());
            let change = self.step(&now, 1.0 / step, y);
            let (next, left) = self.all_left(y);
            if change <= FOUND * self.speed {
                return Some(self.orbit);
            }
            // Grows as the residual falls; what is thrown far is taken back.
            if left < 2.0 * size {
                step *= (1.5 * size / left).min(1e3);
                (now, size) = (next, left);
            } else {
                (self.orbit, self.spins) = kept;
                step *= 0.1;
            }
        }
        y.copy_from_slice(&before);
        None
    }

    /// Takes an implicit step in time: (M/h − J) Δ = left, ball by ball, the orbit last. Returns the largest change of a speed.
    fn step(&mut self, now: &[Left<N>], over_step: f64, y: &mut [f64]) -> f64 {
        let aside = ASIDE * self.speed;
        let (mut own, mut right) = (self.carried * over_step, 0.0);
        let mut solved = Vec::with_capacity(self.balls.len());
        for ((&j, spin), (moments, along)) in self.balls.iter().zip(&self.spins).zip(now) {
            let mut matrix = SMatrix::<f64, N, N>::identity() * (self.inertia * over_step);
            let mut by_spin = SVector::<f64, N>::zeros();
            for i in 0..N {
                let mut moved = *spin;
                moved[i] += aside;
                let (there, force) = self.left(j, self.orbit, &moved, y);
                let column = (there - moments) / aside;
                let mut of = matrix.column_mut(i);
                of -= column;
                by_spin[i] = (force - along) / aside;
            }
            let (there, force) = self.left(j, self.orbit + aside, spin, y);
            let by_orbit = (there - moments) / aside;
            let inverse = matrix.try_inverse().unwrap_or_else(SMatrix::zeros);
            let (alone, follow) = (inverse * moments, inverse * by_orbit);
            own -= (force - along) / aside + by_spin.dot(&follow);
            right += along + by_spin.dot(&alone);
            solved.push((alone, follow));
        }
        let faster = if own > 0.0 { right / own } else { 0.0 };
        self.orbit += faster;
        let mut largest = faster.abs();
        for (spin, (alone, follow)) in self.spins.iter_mut().zip(solved) {
            let change = alone + follow * faster;
            largest = largest.max(change.amax());
            *spin += change;
        }
        largest
    }
}
