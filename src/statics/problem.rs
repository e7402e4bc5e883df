//! Problem of the static solve: loads of rings and balls, and the forces of a ball's contacts.

use nalgebra::{DVector, Matrix2, Matrix3, SMatrix, Vector2, Vector3};

use super::arms::{Arm, Push};
use super::fallen::Spacing;
use super::rolling::RaceControl;
use super::springs::{CageSpring, RowSpring};
use super::start;
use super::unknowns::{self, OF_A_RING, OF_RINGS, RingStiffness, Rings};
use crate::contact::{Tangent, V2, centrifugal};
use crate::forces::{self, gravity, load, support};
use crate::model::{BodyId, Dof, Model, Race};

pub(super) struct Problem<'m> {
    pub(super) model: &'m Model,
    /// m ω_c² of each ball: its centrifugal force over its radius \[N/m\].
    pub(super) outwards: Vec<f64>,
    /// Friction of both races on each ball that turns the axis about which it spins freely \[N\].
    pub(super) friction: Vec<[Vector3<f64>; 2]>,
    /// Moments by which a load turns each ring beside its arm to the balls' centres \[N m\].
    pub(super) couples: [Vector3<f64>; 2],
    /// Speeds of all bodies, once they are found from friction.
    pub(super) speeds: Vec<f64>,
    pub(super) control: RaceControl,
    pub(super) spacing: Spacing,
    pub(super) directions: Vec<V2>,
    /// The cage's hold on each ball.
    pub(super) cage_spring: Vec<CageSpring>,
    /// Stiffness of each ball's hold over what a row's cage has against all balls moving out together; at least what
    /// it has against one of them.
    pub(super) cage_share: f64,
    /// Free directions of the rings, as places among their unknowns.
    pub(super) free: Vec<usize>,
    /// Constant forces on the rings.
    pub(super) loads: Rings,
    /// Sum of the magnitudes of what acts.
    pub(super) magnitude: f64,
    /// How far the contacts of each row's balls give.
    pub(super) springs: Vec<RowSpring>,
    /// Places of the rings where their springs are relaxed.
    nominal: Rings,
    /// Loads that act off the rings' centres of mass.
    pub(super) pushes: Vec<Push>,
    /// Constant moments in the rings' frames \[N m\].
    pub(super) turning: [Vector3<f64>; 2],
    /// Whether forces depend on a ring's place, beside contacts and springs.
    pub(super) placed: bool,
    /// Whether the stiffness against tilts is computed: for rings that may tilt, or on request.
    pub(super) spatial: bool,
}

impl<'m> Problem<'m> {
    pub(super) fn new(model: &'m Model) -> Self {
        let mut outwards = Vec::new();
        let mut directions = Vec::new();
        let mut magnitude = 0.0;
        for (j, ball) in model.balls.iter().enumerate() {
            let body = &model.bodies[BodyId::ball(j)];
            let place = V2::new(body.nominal[Dof::X], body.nominal[Dof::Y]);
            let direction = place.normalize();
            let orbit = model.rolling_speeds(ball.row).0;
            let weight = gravity::along(model, BodyId::ball(j), direction.into());
            outwards.push(centrifugal(body.mass[Dof::X], orbit));
            directions.push(direction);
            magnitude += outwards[j] * place.norm() + weight.abs();
        }
        let (mut loads, mut turning) = (Rings::zeros(), [Vector3::zeros(); 2]);
        for race in Race::BOTH {
            for wrench in forces::ALL.map(|force| force.at_start(model, race)) {
                unknowns::add(&mut loads, race, &wrench.force);
                turning[race] += wrench.moment;
            }
        }
        let free = unknowns::all()
            .filter(|(_, race, dof)| model.degree(*race, *dof).is_free())
            .map(|(at, ..)| at)
            .collect();
        magnitude += loads.iter().map(|x| x.abs()).sum::<f64>();
        if model.tilts() {
            let of = |race: Race| load::moment(model, 0.0, race, |arm| *arm).norm();
            magnitude += (of(Race::Outer) + of(Race::Inner)) / model.radius(BodyId::INNER);
        }
        // Without any load, the contact scale keeps the tolerance from being zero.
        magnitude = magnitude.max(1e-6 * model.scales.load).max(1e-12);
        Self {
            model,
            outwards,
            friction: vec![[Vector3::zeros(); 2]; directions.len()],
            couples: [Vector3::zeros(); 2],
            speeds: Vec::new(),
            control: RaceControl::Friction,
            spacing: Spacing::default(),
            cage_spring: vec![CageSpring::default(); directions.len()],
            cage_share: 0.0,
            directions,
            free,
            loads,
            magnitude,
            springs: model
                .rows
                .iter()
                .map(|row| RowSpring::of(model, row))
                .collect(),
            nominal: Self::nominal(model),
            pushes: Push::all(model),
            turning,
            placed: model.scene.forces_of_motion().next().is_some(),
            spatial: model.tilts(),
        }
    }

    /// The rings where their supports would have them.
    pub(super) fn relaxed(&self) -> Rings {
        self.nominal
    }

    /// The same where the stiffness against tilts is looked for, whether or not they move.
    pub(super) fn with_tilts(self) -> Self {
        Self {
            spatial: true,
            ..self
        }
    }

    /// The same where a race controls how balls spin.
    pub(super) fn controlled(self, control: RaceControl) -> Self {
        Self { control, ..self }
    }

    /// The same with balls of a row so far apart.
    pub(super) fn spaced(self, spacing: Spacing) -> Self {
        Self { spacing, ..self }
    }

    /// A typical contact stiffness.
    pub(super) fn stiffness(&self) -> f64 {
        self.model.scales.load / self.model.scales.approach
    }

    pub(super) fn error(&self, residual: &DVector<f64>) -> f64 {
        residual.iter().map(|x| x.abs()).fold(0.0, f64::max) / self.magnitude
    }

    /// Weight and centrifugal force of a ball along its radius and along z, near its nominal place.
    pub(super) fn own_load(&self, j: usize) -> Vector2<f64> {
        let [x, y, ..] = self.model.bodies[BodyId::ball(j)].nominal;
        self.own_load_at(j, x.hypot(y))
    }

    /// The same at a radius, at the angle where the cage holds it.
    pub(super) fn own_load_at(&self, j: usize, radius: f64) -> Vector2<f64> {
        let ball = BodyId::ball(j);
        let weight = gravity::along(self.model, ball, self.directions[j].into());
        let [_, _, axial] = gravity::on(self.model, ball);
        Vector2::new(self.outwards[j] * radius + weight, axial)
    }

    /// A ball at a radius and an axial place between the rings: what acts on it there.
    pub(super) fn ball_at(&self, j: usize, rings: &Rings, place: Vector2<f64>) -> BallState {
        let ball = &self.model.balls[j];
        let direction = self.directions[j];
        let centre = Vector3::new(direction.x * place.x, direction.y * place.x, place.y);
        let from_rings = Race::BOTH.map(|race| self.seen(rings, race, &centre));
        let contacts = Race::BOTH.map(|race| {
            let pair = &self.model.rows[ball.row].pairs[race];
            let mut found = pair.tangent(&ball.side, &from_rings[race]);
            if self.model.tilts() {
                found = found.turned(&self.frame(rings, race));
            }
            found.force += self.friction[j][race];
            found
        });
        let arms = self
            .spatial
            .then(|| Box::new(Race::BOTH.map(|race| self.arm(rings, race, &centre))));
        let pressed = contacts[0].force + contacts[1].force;
        let own = self.own_load_at(j, place.x);
        let mut force = Vector2::new(
            pressed.xy().dot(&direction) + own.x + self.cage_spring[j].pull(place.x),
            pressed.z + own.y,
        );
        let body = &self.model.bodies[BodyId::ball(j)];
        let pull = Dof::TRANSLATIONS.map(|dof| support::at_rest(body, dof, centre[dof.index()]));
        force.x += pull[0] * direction.x;
        force.x += pull[1] * direction.y;
        force.y += pull[2];
        BallState {
            place,
            force,
            from_rings,
            contacts,
            arms,
        }
    }

    /// Stiffness of each of a ball's contacts; differences are taken once.
    pub(super) fn contact_stiffness(
        &self,
        j: usize,
        rings: &Rings,
        state: &mut BallState,
    ) -> [Matrix3<f64>; 2] {
        let ball = &self.model.balls[j];
        // A thousandth of the approach: truncation 1e-6, noise 1e-9 of the stiffness.
        let step = 1e-3 * self.model.scales.approach;
        Race::BOTH.map(|race| {
            *state.contacts[race].stiffness.get_or_insert_with(|| {
                let pair = &self.model.rows[ball.row].pairs[race];
                let own = pair.stiffness_by_differences(&ball.side, &state.from_rings[race], step);
                if self.model.tilts() {
                    self.frame(rings, race).matrix_to_scene(&own)
                } else {
                    own
                }
            })
        })
    }

    /// Stiffness of a ball along its radius and z between rings that stand still.
    pub(super) fn ball_stiffness(
        &self,
        j: usize,
        rings: &Rings,
        state: &mut BallState,
    ) -> Matrix2<f64> {
        let [outer, inner] = self.contact_stiffness(j, rings, state);
        let k = outer + inner;
        let (x, y) = (self.directions[j].x, self.directions[j].y);
        let mut radial = x * x * k[(0, 0)] + y * y * k[(1, 1)] + x * y * (k[(0, 1)] + k[(1, 0)]);
        let mut axial = k[(2, 2)];
        let degrees = &self.model.bodies[BodyId::ball(j)].degrees;
        radial += degrees[Dof::X].stiffness() * (x * x);
        radial += degrees[Dof::Y].stiffness() * (y * y);
        axial += degrees[Dof::Z].stiffness();
        // The centrifugal force grows with the radius.
        radial += self.cage_spring[j].stiffness() - self.outwards[j];
        Matrix2::new(
            radial,
            x * k[(0, 2)] + y * k[(1, 2)],
            x * k[(2, 0)] + y * k[(2, 1)],
            axial,
        )
    }

    /// Stiffness of a ball (radius, z) against the places of the rings, and of these against the ball.
    pub(super) fn coupling(
        &self,
        j: usize,
        state: &BallState,
        contacts: &[Matrix3<f64>; 2],
    ) -> (SMatrix<f64, 2, OF_RINGS>, SMatrix<f64, OF_RINGS, 2>) {
        let (x, y) = (self.directions[j].x, self.directions[j].y);
        let mut pulled = SMatrix::<f64, 2, OF_RINGS>::zeros();
        let mut pulling = SMatrix::<f64, OF_RINGS, 2>::zeros();
        for race in Race::BOTH {
            let k = &contacts[race];
            for dof in Dof::TRANSLATIONS {
                let (a, i) = (unknowns::at(race, dof), dof.index());
                (pulled[(0, a)], pulled[(1, a)]) = (x * k[(0, i)] + y * k[(1, i)], k[(2, i)]);
                (pulling[(a, 0)], pulling[(a, 1)]) = (x * k[(i, 0)] + y * k[(i, 1)], k[(i, 2)]);
            }
            let Some(arms) = &state.arms else { continue };
            let by_tilts = arms[race].by_tilts(&state.contacts[race].force, k);
            for (i, dof) in Dof::TILTS.into_iter().enumerate() {
                let a = unknowns::at(race, dof);
                let column = by_tilts.column(i);
                let both = (x * column[0] + y * column[1], column[2]);
                (pulled[(0, a)], pulled[(1, a)]) = both;
                (pulling[(a, 0)], pulling[(a, 1)]) = both;
            }
        }
        (pulled, pulling)
    }

    /// Stiffness of a ring's own spring.
    fn own_spring(&self, race: Race, dof: Dof) -> f64 {
        let stiffness = self.model.degree(race, dof).stiffness();
        if dof.is_rotation() {
            stiffness / (self.lever() * self.lever())
        } else {
            stiffness
        }
    }

    /// Entry of the stiffness of the rings' supports: of an outer ring on a structure that of both in series, else the spring's.
    pub(super) fn support(&self, a: usize, b: usize) -> f64 {
        let ((race, dof), (other, along)) = (unknowns::degree(a), unknowns::degree(b));
        match &self.model.structure {
            Some(structure)
                if [race, other] == [Race::Outer; 2]
                    && !dof.is_rotation()
                    && !along.is_rotation() =>
            {
                structure.effective[(dof.index(), along.index())]
            }
            _ if a == b => self.own_spring(race, dof),
            _ => 0.0,
        }
    }

    /// Adds the stiffness of the rings' supports.
    pub(super) fn stiffen(&self, stiffness: &mut RingStiffness) {
        for a in 0..OF_RINGS {
            stiffness[(a, a)] += self.support(a, a);
        }
        if self.model.structure.is_some() {
            for (a, b) in [(0, 1), (0, 2), (1, 2)] {
                let dofs = [a, b].map(|i| unknowns::at(Race::Outer, Dof::TRANSLATIONS[i]));
                let coupled = self.support(dofs[0], dofs[1]);
                stiffness[(dofs[0], dofs[1])] += coupled;
                stiffness[(dofs[1], dofs[0])] += coupled;
            }
        }
    }

    /// Resistance of a ring's support where the ring is.
    pub(super) fn resistance(&self, at: usize, rings: &Rings) -> f64 {
        let by = |other: usize| self.support(at, other) * (rings[other] - self.nominal[other]);
        if self.model.structure.is_none() {
            return by(at);
        }
        (0..OF_RINGS).map(by).sum()
    }

    /// Whether a support holds a ball at its nominal place.
    pub(super) fn is_held(&self, j: usize) -> bool {
        let body = &self.model.bodies[BodyId::ball(j)];
        Dof::TRANSLATIONS
            .iter()
            .any(|dof| !body.degrees[*dof].is_free())
    }

    pub(super) fn state(&self, rings: &Rings, balls: &[Vector2<f64>]) -> Vec<f64> {
        let mut y = vec![0.0; self.model.dim()];
        let layout = self.model.layout();
        for (at, race, dof) in unknowns::all() {
            if !dof.is_rotation() {
                y[layout.at(race.ring(), dof)] = rings[at];
            } else if layout.has(race.ring(), dof) {
                y[layout.at(race.ring(), dof)] = rings[at] / self.lever();
            }
        }
        for (j, ball) in balls.iter().enumerate() {
            let place = self.directions[j] * ball.x;
            for (dof, of) in Dof::TRANSLATIONS
                .into_iter()
                .zip([place.x, place.y, ball.y])
            {
                y[layout.at(BodyId::ball(j), dof)] = of;
            }
        }
        start::seat_cages(self.model, &mut y);
        if let Some(structure) = &self.model.structure {
            structure.rest(layout, &mut y);
        }
        y
    }
}

/// A ball at a place between the rings.
#[derive(Debug, Clone)]
pub(super) struct BallState {
    /// Radius and axial place of the ball.
    pub(super) place: Vector2<f64>,
    /// Force on it along these.
    pub(super) force: Vector2<f64>,
    /// Place of the ball from the centres of outer and inner ring, in their frames.
    pub(super) from_rings: [Vector3<f64>; 2],
    /// Contacts of the ball with the races.
    pub(super) contacts: [Tangent; 2],
    /// Arms of the ball from the rings, where tilts are looked for.
    pub(super) arms: Option<Box<[Arm; 2]>>,
}

impl BallState {
    /// Adds what it does to the rings to the forces on them.
    pub(super) fn press(&self, on_rings: &mut Rings) {
        for race in Race::BOTH {
            let force = &self.contacts[race].force;
            unknowns::add(on_rings, race, &-force);
            if let Some(arms) = &self.arms {
                let on_tilts = arms[race].on_tilts(force);
                for (dof, on) in Dof::TILTS.into_iter().zip(on_tilts.iter()) {
                    on_rings[unknowns::at(race, dof)] += on;
                }
            }
        }
    }

    /// Adds the stiffness of a ring against its contact.
    pub(super) fn stiffen(&self, race: Race, own: &Matrix3<f64>, of_rings: &mut RingStiffness) {
        let k = unknowns::first(race);
        match &self.arms {
            None => {
                let mut part = of_rings.fixed_view_mut::<3, 3>(k, k);
                part += own;
            }
            Some(arms) => {
                let mut part = of_rings.fixed_view_mut::<OF_A_RING, OF_A_RING>(k, k);
                part += arms[race].stiffness(&self.contacts[race].force, own);
            }
        }
    }

    /// Size of the contact forces.
    pub(super) fn pressed(&self) -> f64 {
        let [outer, inner] = &self.contacts;
        outer.force.norm().hypot(inner.force.norm())
    }
}
