//! Corrections of velocities by the matrix of the contacts' friction, damping and stiffness, once a step, for
//! [`Adams`](crate::integrate::Adams).

use super::apart::Apart;
use super::matrix::{ContactMatrix, NOWHERE, Velocity};
use crate::base::words::{Remembered, Unfit, Words};
use crate::contact::{AXIAL, FREE};
use crate::dynamics::{Dynamics, RingView, View};
use crate::forces::{self, State};
use crate::integrate::{LinearlyImplicit, System};
use crate::model::RowModel;

/// Steps that a matrix serves at most. On 64 scenes (two presets, random bearings) 8, 32, 128 and 512 gave errors alike and
/// step counts within half a percent; a new one costs about six evaluations (a profile of the wheel bearing).
const SERVES: usize = 128;
/// The same where velocities decay by this much and more in γh: how fast they do changes with how much of a contact sticks. Twice as
/// many as 32 save 6 % of a 6205 in VG 68 and cost three steps in 7650.
const SERVES_FAST: usize = 64;
const FAST: f64 = 1.2;

/// Share that contact damping takes off a velocity in a step, under the loads at the start, up to which balls without friction do without a
/// matrix. Measured on balls that moved along their radii alone, as versions up to 0.3 had them: at 0.43 runs took 0.87 of their time
/// without one, at 0.73 1.25 times.
const BEARS: f64 = 0.5;

/// A right-hand side with the matrix of its contacts' friction, damping and stiffness, made now and then.
#[derive(Debug)]
pub(crate) struct Damped<'d, 'm> {
    pub dynamics: &'d mut Dynamics<'m>,
    /// Matrix of the contacts; none where no force of a contact depends on velocities.
    matrix: Option<Box<dyn Corrects>>,
    longest: f64,
}

/// How much a change of an acceleration moves velocities and places within a step.
#[derive(Debug, Clone, Copy, Default)]
struct Corrector {
    /// Correction of a velocity over that of its acceleration \[s\].
    gamma_h: f64,
    /// Correction of a place with its velocity \[s\].
    reach: f64,
}

/// The matrix of the contacts, of balls of any number of directions.
trait Corrects: std::fmt::Debug {
    /// Prepares as [`LinearlyImplicit::prepare`].
    fn prepare(&mut self, dynamics: &Dynamics<'_>, t: f64, y: &[f64], by: Corrector);

    /// Relaxation as of [`LinearlyImplicit::relaxation`].
    fn relaxation(&self) -> f64;

    /// Solves as [`LinearlyImplicit::solve`].
    fn solve(&mut self, dynamics: &Dynamics<'_>, r: &mut [f64]);

    /// Passes on what the matrix was made of, and makes it anew where that is loaded.
    fn pass_on(&mut self, dynamics: &mut Dynamics<'_>, words: &mut Words);
}

/// A matrix of all bodies, also where the run leaves some out.
#[derive(Debug)]
struct BodyMatrix<const N: usize> {
    matrix: ContactMatrix<N>,
    /// Places of velocities by body, among those of the run or of `apart`.
    places: Vec<[usize; N]>,
    /// Velocities of all bodies, where those of the run are not simply some of them.
    apart: Option<Apart<N>>,
    /// The last state of all bodies, as a run's vector and as the contacts read it.
    full: Vec<f64>,
    state: State,
    /// Views of all balls by the rings, where these may tilt.
    rings: Option<[RingView; 2]>,
    /// Material of the matrix, once it was made.
    made: Option<MadeOf>,
    /// Steps that it has served.
    served: usize,
    /// Rate of the fastest velocity when it was made \[1/s\].
    relaxation: f64,
}

/// Material from which a matrix was made.
#[derive(Debug, Clone, Default)]
struct MadeOf {
    t: f64,
    /// State of the run.
    y: Vec<f64>,
    by: Corrector,
    /// Speed of films that follow it.
    film_speed: Option<f64>,
}

impl Remembered for MadeOf {
    fn pass(&mut self, words: &mut Words) {
        self.t.pass(words);
        self.y.pass(words);
        self.by.gamma_h.pass(words);
        self.by.reach.pass(words);
        self.film_speed.pass(words);
    }
}

impl<'d, 'm> Damped<'d, 'm> {
    /// The correction for steps up to a longest one \[s\].
    pub fn new(dynamics: &'d mut Dynamics<'m>, longest: f64) -> Self {
        let matrix = is_stiff(dynamics, longest).then(|| {
            if dynamics.tilts() {
                BodyMatrix::<FREE>::boxed(dynamics)
            } else {
                BodyMatrix::<AXIAL>::boxed(dynamics)
            }
        });
        Self {
            dynamics,
            matrix,
            longest,
        }
    }

    /// Memory of the matrix; nothing without one.
    pub fn remembered(&mut self) -> Vec<u64> {
        Words::saved(self)
    }

    /// Makes the matrix that another one remembered.
    pub fn remember(&mut self, words: &[u64]) -> Result<(), Unfit> {
        Words::load(words, self)
    }
}

impl Remembered for Damped<'_, '_> {
    fn pass(&mut self, words: &mut Words) {
        if let Some(matrix) = &mut self.matrix {
            matrix.pass_on(self.dynamics, words);
        }
    }
}

/// Whether velocities decay by contacts faster than explicit steps up to the longest one can follow.
fn is_stiff(dynamics: &Dynamics<'_>, longest: f64) -> bool {
    let model = dynamics.model();
    let has_traction = |row: &RowModel| row.pairs.iter().any(|pair| pair.law.traction.is_some());
    let rubs = model.rows.iter().any(has_traction);
    let bears = !rubs && !model.has_films() && forces::damping(model) * longest < BEARS;
    model.rows.iter().any(RowModel::resists_motion) && !bears
}

impl System for Damped<'_, '_> {
    fn dim(&self) -> usize {
        self.dynamics.dim()
    }

    fn rhs(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        self.dynamics.rhs(t, y, dy);
    }
}

impl LinearlyImplicit for Damped<'_, '_> {
    fn prepare(&mut self, t: f64, y: &[f64], gamma_h: f64, reach: f64) {
        if let Some(matrix) = &mut self.matrix {
            matrix.prepare(self.dynamics, t, y, Corrector { gamma_h, reach });
        }
    }

    fn solve(&mut self, r: &mut [f64]) {
        if let Some(matrix) = &mut self.matrix {
            matrix.solve(self.dynamics, r);
        }
    }

    fn relaxation(&self) -> f64 {
        self.matrix
            .as_ref()
            .map_or(0.0, |matrix| matrix.relaxation())
    }

    fn longest(&self) -> f64 {
        self.longest
    }
}

impl<const N: usize> Corrects for BodyMatrix<N> {
    fn prepare(&mut self, dynamics: &Dynamics<'_>, t: f64, y: &[f64], by: Corrector) {
        let is_fast = self.relaxation * by.gamma_h > FAST;
        let serves = if is_fast { SERVES_FAST } else { SERVES };
        if self.served >= serves || !self.matrix.is_like(by.gamma_h) {
            let made = self.made.get_or_insert_default();
            (made.t, made.by, made.film_speed) = (t, by, dynamics.film_speed());
            made.y.clear();
            made.y.extend_from_slice(y);
            self.renew(dynamics, t, y, by);
        }
        self.served += 1;
    }

    fn pass_on(&mut self, dynamics: &mut Dynamics<'_>, words: &mut Words) {
        self.made.pass(words);
        if words.loads()
            && let Some(of) = self.made.take().filter(|of| of.y.len() == dynamics.dim())
        {
            dynamics.set_film_speed(of.film_speed);
            self.renew(dynamics, of.t, &of.y, of.by);
            self.made = Some(of);
        }
        self.served.pass(words);
    }

    fn relaxation(&self) -> f64 {
        self.relaxation
    }

    /// Directions that the run leaves out are not corrected. A singular matrix corrects nothing.
    fn solve(&mut self, dynamics: &Dynamics<'_>, r: &mut [f64]) {
        let model = dynamics.model();
        let Some(apart) = &mut self.apart else {
            self.matrix.correct(model, r);
            return;
        };
        self.matrix.correct(model, apart.read(dynamics, r));
        apart.write(r);
    }
}

impl<const N: usize> BodyMatrix<N> {
    fn boxed(dynamics: &Dynamics<'_>) -> Box<dyn Corrects> {
        let (model, state) = (dynamics.model(), dynamics.state().clone());
        let mut full = vec![0.0; model.dim()];
        state.write(&mut full);
        let apart = Apart::of(dynamics);
        let mut places = vec![[NOWHERE; N]; model.bodies.len()];
        if apart.is_some() {
            let all = places.as_flattened_mut().iter_mut().enumerate();
            all.for_each(|(at, place)| *place = at);
        } else {
            for (at, (body, dof)) in dynamics.degrees().into_iter().enumerate() {
                if let Some(Velocity { place, .. }) = Velocity::of(at, body, dof) {
                    places[body.index()][place] = at;
                }
            }
        }
        Box::new(Self {
            matrix: ContactMatrix::new(model),
            places,
            apart,
            full,
            state,
            rings: RingView::both(model).filter(|_| dynamics.tilts()),
            made: None,
            served: 0,
            relaxation: 0.0,
        })
    }

    /// Takes the slopes of the contacts at a state of the run.
    fn renew(&mut self, dynamics: &Dynamics<'_>, t: f64, y: &[f64], by: Corrector) {
        dynamics.expand(t, y, &mut self.full);
        self.state.read(&self.full);
        let views = match &mut self.rings {
            Some(rings) => RingView::look(rings, dynamics.model(), &self.state),
            None => View::parallel(&self.state),
        };
        self.matrix.find_elements(dynamics, &views);
        self.matrix.find_slopes(dynamics, &views, by.reach);
        self.matrix.factorise(dynamics, &views, by.gamma_h);
        self.matrix.locate(&self.places);
        self.served = 0;
        self.relaxation = self.matrix.stiffest() / by.gamma_h;
    }
}

/// The truth is the right-hand side itself.
#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Drive, TimeFunction};
    use crate::statics::start::{Start, start};
    use crate::velocities::tests::{compiled, oiled_wheel, rolling, scenes, spatial, state};

    /// (1 − γh (∂a/∂v + ρ ∂a/∂q)) x = r holds for the correction x of any r to a share of its size, with derivatives by central
    /// differences.
    fn is_corrected_by_the_derivative(
        dynamics: &mut Dynamics<'_>,
        y: &[f64],
        reach: f64,
        step: f64,
        share: f64,
    ) {
        let half = y.len() / 2;
        let gamma_h = 1e-6;
        let r: Vec<f64> = (0..half).map(|i| (1.0 + i as f64).sin()).collect();
        let mut x = r.clone();
        let mut damped = Damped::new(dynamics, 1.0);
        damped.prepare(0.0, y, gamma_h, reach);
        damped.solve(&mut x);
        // Speeds of surfaces: a ball that is pushed by 1 m/s rolls away by hundreds of rad/s.
        let model = dynamics.model();
        let of = dynamics.degrees().into_iter();
        let levers: Vec<f64> = of.map(|(body, dof)| model.lever(body, dof)).collect();
        let sizes = x.iter().zip(&levers).map(|(x, lever)| (x * lever).abs());
        let size = sizes.fold(0.0, f64::max);
        let mut at = |step: f64| {
            let mut moved = y.to_vec();
            let (places, velocities) = moved.split_at_mut(half);
            for ((q, v), x) in places.iter_mut().zip(velocities).zip(&x) {
                *v += step * x / size;
                *q += reach * step * x / size;
            }
            let mut rates = vec![0.0; y.len()];
            dynamics.rhs(0.0, &moved, &mut rates);
            rates.split_off(half)
        };
        let (up, down) = (at(step), at(-step));
        for (i, (body, dof)) in dynamics.degrees().into_iter().enumerate() {
            let slope = (up[i] - down[i]) / (2.0 * step) * size;
            let off = x[i] - gamma_h * slope - r[i];
            assert!(
                off.abs() * levers[i] < share * size,
                "{} {body:?} {dof:?}: {off:e} of {size}",
                dynamics.model().scene().name
            );
        }
    }

    #[test]
    fn velocities_are_corrected_by_the_derivative() {
        for scene in scenes().into_iter().chain([oiled_wheel(), rolling()]) {
            let model = compiled(&scene);
            is_corrected_by_the_derivative(
                &mut Dynamics::new(&model),
                &state(&model),
                0.0,
                1e-5,
                1e-5,
            );
        }
    }

    /// Rings that tilt and balls that spin freely, to 1e-5 of the largest angular acceleration. Gyroscopic moments of the rings
    /// are not in the matrix.
    #[test]
    fn velocities_in_space_are_corrected_by_the_derivative() {
        for mut scene in spatial() {
            scene.drive = Drive::Speed(TimeFunction::Constant(1.0));
            let model = compiled(&scene);
            is_corrected_by_the_derivative(
                &mut Dynamics::new(&model),
                &state(&model),
                0.0,
                1e-6,
                3e-3,
            );
        }
    }

    /// Elastic stiffness of the contacts is in the matrix; how their directions turn, some 1e-2 of it, is not. Without the stiffness
    /// corrections err by 0.16 of their size and more.
    #[test]
    fn places_are_corrected_by_the_stiffness() {
        for scene in scenes().into_iter().chain([oiled_wheel()]) {
            let model = compiled(&scene);
            let y = start(&model, &Start::Equilibrium).unwrap();
            is_corrected_by_the_derivative(&mut Dynamics::new(&model), &y, 3e-6, 1e-5, 0.05);
        }
    }
}
